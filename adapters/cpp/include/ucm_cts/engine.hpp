// Engine: runs one scenario against one adapter.
#ifndef UCM_CTS_ENGINE_HPP
#define UCM_CTS_ENGINE_HPP

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <typeinfo>
#include <utility>
#include <vector>

#if defined(__GNUG__)
#include <cxxabi.h>
#endif

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/probe.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/variables.hpp"
#include "ucm_cts/workers.hpp"

namespace ucm_cts {

/// One run of one scenario. Threads that get stuck keep it alive.
class Engine : public std::enable_shared_from_this<Engine> {
  public:
    Engine(std::shared_ptr<Adapter> adapter, std::shared_ptr<const Scenario> scenario, Recorder::Sink sink)
        : adapter_(std::move(adapter)),
          scenario_(std::move(scenario)),
          stage_(std::make_shared<Stage>(std::move(sink), scenario_->patience)),
          cast_(std::make_shared<Cast>()),
          manager_(adapter_->create_runtime(implementations())),
          variables_(manager_),
          workers_(patience_of(scenario_->patience)) {}

    /// Runs all steps, appends the events to `trace` as a JSON array, and returns the names of the threads that are stuck.
    std::vector<std::string> run(std::string& trace) {
        for (std::size_t number = 0; number < scenario_->steps.size(); ++number) {
            const Step& step = scenario_->steps[number];
            if (step.has_thread) {
                const std::shared_ptr<Engine> self = shared_from_this();
                workers_.queue(step.thread, [self, number] { self->perform(number); });
            } else {
                perform(number);
            }
        }
        stage_->gates.open_all();
        const std::vector<std::string> stuck = workers_.finish();
        stage_->recorder.take(trace);
        if (stuck.empty()) {
            clean_up();
        }
        return stuck;
    }

  private:
    // the probes that the framework has had made
    struct Cast {
        std::mutex mutex;
        std::map<std::string, int> instances;
        std::vector<std::weak_ptr<Probe>> probes;
    };

    std::vector<Implementation> implementations() const {
        std::vector<Implementation> all;
        all.reserve(scenario_->components.size());
        for (const Declaration& declaration : scenario_->components) {
            std::vector<std::string> attributes;
            for (const auto& attribute : declaration.attributes) {
                attributes.push_back(attribute.first);
            }
            const Declaration* const what = &declaration;
            const std::shared_ptr<Stage> stage = stage_;
            const std::shared_ptr<const Scenario> scenario = scenario_;
            const std::shared_ptr<Cast> cast = cast_;
            all.push_back(Implementation{declaration.name, declaration.provided, declaration.required,
                                         std::move(attributes), declaration.connectable, declaration.fragment,
                                         [what, stage, scenario, cast] { return make(*what, stage, scenario, *cast); },
                                         declaration.policies, Interfaces()});
        }
        return all;
    }

    static std::shared_ptr<Body> make(const Declaration& declaration, const std::shared_ptr<Stage>& stage,
                                      const std::shared_ptr<const Scenario>& scenario, Cast& cast) {
        std::lock_guard<std::mutex> lock(cast.mutex);
        const int instance = ++cast.instances[declaration.name];
        const std::shared_ptr<Probe> probe = std::make_shared<Probe>(stage, scenario, declaration, instance);
        cast.probes.push_back(probe);
        return std::make_shared<ProbeBody>(probe);
    }

    void perform(std::size_t number) {
        const Step& step = scenario_->steps[number];
        Arguments arguments;
        switch (step.operation) {
            case Operation::open:
                stage_->gates.open(step.subject, [this, &step] {
                    stage_->recorder.record("opened", [&step](std::string& out) {
                        json::append_name(out, "gate");
                        json::append_text(out, step.subject);
                    });
                });
                return;
            case Operation::reach:
                check_patience(number, stage_->gates.reach(step.subject, step.value));
                return;
            case Operation::settle:
                settle(step.subject);
                return;
            case Operation::join:
                check_patience(number, workers_.join(step.subject));
                return;
            default:
                if (resolve(number, step, arguments)) {
                    call(number, step, arguments);
                }
        }
    }

    void settle(const std::string& worker) {
        const char* const where =
            workers_.settle(worker, [this](std::thread::id thread) { return stage_->gates.holds(thread); });
        stage_->recorder.record("settled", [&worker, where](std::string& out) {
            json::append_name(out, "worker");
            json::append_text(out, worker);
            json::append_name(out, "where");
            json::append_text(out, where);
        });
    }

    void check_patience(std::size_t number, bool in_time) {
        if (!in_time) {
            stage_->recorder.record("timeout", [number](std::string& out) { append_step(out, number); });
        }
    }

    struct Arguments {
        ContainerHandle container;
        ContainerHandle sub_container;
        Id id = 0;
        Reference reference;
    };

    // Looks up what the step needs, in the order of its arguments; records `skip` for the first that is not there.
    bool resolve(std::size_t number, const Step& step, Arguments& arguments) {
        if (!variables_.container(step.container, arguments.container)) {
            return skip(number, step.container);
        }
        switch (step.operation) {
            case Operation::remove_component:
            case Operation::get_port_element:
            case Operation::disconnect:
                return variables_.id(step.subject, arguments.id) || skip(number, step.subject);
            case Operation::connect:
                return (variables_.id(step.subject, arguments.id) || skip(number, step.subject)) &&
                       (variables_.reference(step.to, arguments.reference) || skip(number, step.to));
            case Operation::remove_container:
                return variables_.container(step.subject, arguments.sub_container) || skip(number, step.subject);
            case Operation::invoke:  // nothing can be called through a null reference
                return (variables_.reference(step.subject, arguments.reference) && arguments.reference) ||
                       skip(number, step.subject);
            default:
                return true;
        }
    }

    bool skip(std::size_t number, const std::string& variable) {
        stage_->recorder.record("skip", [number, &variable](std::string& out) {
            append_step(out, number);
            json::append_name(out, "variable");
            json::append_text(out, variable);
        });
        return false;
    }

    void call(std::size_t number, const Step& step, const Arguments& arguments) {
        stage_->recorder.record("call", [number](std::string& out) { append_step(out, number); });
        try {
            operate(number, step, arguments);
        } catch (const NotFound& error) {
            raised(number, "NOT_FOUND", error.what());
        } catch (const BadParameter& error) {
            raised(number, "BAD_PARAMETER", error.what());
        } catch (const UcmError& error) {
            raised(number, "UCM_ERROR", error.what());
        } catch (const std::exception& error) {
            raised(number, "UNDECLARED", (type_of(error) + ": " + error.what()).c_str());
        } catch (...) {
            raised(number, "UNDECLARED", "an exception that is no std::exception");
        }
    }

    static std::string type_of(const std::exception& error) {
        const char* const name = typeid(error).name();
#if defined(__GNUG__)
        int status = 0;
        const std::unique_ptr<char, void (*)(void*)> readable(abi::__cxa_demangle(name, nullptr, nullptr, &status),
                                                              std::free);
        if (readable) {
            return readable.get();
        }
#endif
        return name;
    }

    void operate(std::size_t number, const Step& step, const Arguments& with) {
        switch (step.operation) {
            case Operation::add_component: {
                const Declaration* const declaration = scenario_->find(step.component);
                const Id id = adapter_->add_component(
                    with.container, step.component, declaration != nullptr ? declaration->attributes : Attributes());
                variables_.bind_id(step.bind, id);
                returned(number, [id](std::string& out) { json::append_integer(out, id); });
                break;
            }
            case Operation::remove_component:
                adapter_->remove_component(with.container, with.id);
                returned(number);
                break;
            case Operation::get_port_element: {
                const Reference reference = adapter_->get_port_element(with.container, with.id, step.port);
                variables_.bind_reference(step.bind, reference);
                returned(number, [&reference](std::string& out) { append_reference(out, reference); });
                break;
            }
            case Operation::connect: {
                const Id id = adapter_->connect(with.container, with.id, step.port, with.reference);
                variables_.bind_id(step.bind, id);
                returned(number, [id](std::string& out) { json::append_integer(out, id); });
                break;
            }
            case Operation::disconnect:
                adapter_->disconnect(with.container, with.id);
                returned(number);
                break;
            case Operation::start:
                adapter_->start(with.container);
                returned(number);
                break;
            case Operation::stop:
                adapter_->stop(with.container);
                returned(number);
                break;
            case Operation::get_components: {
                const std::vector<Id> ids = adapter_->get_components(with.container);
                variables_.saw(ids);
                returned(number, [&ids](std::string& out) { json::append_array(out, ids, json::append_integer); });
                break;
            }
            case Operation::create_container:
                variables_.bind_container(step.bind, adapter_->create_container(manager_));
                returned(number);
                break;
            case Operation::remove_container:
                adapter_->remove_container(manager_, with.sub_container);
                returned(number);
                break;
            case Operation::destroy:
                adapter_->destroy(manager_);
                destroyed_ = true;
                returned(number);
                break;
            case Operation::invoke: {
                const std::int32_t result = with.reference->exchange(step.value);
                returned(number, [result](std::string& out) { json::append_integer(out, result); });
                break;
            }
            case Operation::open:
            case Operation::reach:
            case Operation::settle:
            case Operation::join:
                break;
        }
    }

    void returned(std::size_t number) {
        stage_->recorder.record("return", [number](std::string& out) { append_step(out, number); });
    }

    template <class AppendValue>
    void returned(std::size_t number, AppendValue append_value) {
        stage_->recorder.record("return", [number, &append_value](std::string& out) {
            append_step(out, number);
            json::append_name(out, "value");
            append_value(out);
        });
    }

    void raised(std::size_t number, const char* error, const char* detail) {
        const std::string text = json::shortened(detail != nullptr ? detail : "", 200);
        stage_->recorder.record("raise", [number, error, &text](std::string& out) {
            append_step(out, number);
            json::append_name(out, "error");
            json::append_text(out, error);
            json::append_name(out, "detail");
            json::append_text(out, text);
        });
    }

    static void append_step(std::string& out, std::size_t number) {
        json::append_name(out, "step");
        json::append_integer(out, static_cast<std::int64_t>(number));
    }

    void clean_up() {
        if (!destroyed_) {
            try {
                adapter_->destroy(manager_);
            } catch (...) {  // the scenario did not ask for it, so nobody asks what came of it
            }
        }
        std::lock_guard<std::mutex> lock(cast_->mutex);
        for (const std::weak_ptr<Probe>& each : cast_->probes) {
            if (const std::shared_ptr<Probe> probe = each.lock()) {
                probe->forget();
            }
        }
    }

    const std::shared_ptr<Adapter> adapter_;
    const std::shared_ptr<const Scenario> scenario_;
    const std::shared_ptr<Stage> stage_;
    const std::shared_ptr<Cast> cast_;
    const ContainerHandle manager_;
    Variables variables_;
    Workers workers_;
    std::atomic<bool> destroyed_{false};
};

}  // namespace ucm_cts

#endif
