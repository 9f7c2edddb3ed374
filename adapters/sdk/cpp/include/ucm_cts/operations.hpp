// Operations: the steps that the adapter carries out, and what is recorded of them.
#ifndef UCM_CTS_OPERATIONS_HPP
#define UCM_CTS_OPERATIONS_HPP

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <typeinfo>
#include <utility>
#include <vector>

#if defined(__GNUG__)
#include <cxxabi.h>
#endif

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/stage.hpp"
#include "ucm_cts/variables.hpp"

namespace ucm_cts {

/// A step of the protocol that this version of the SDK does not carry out: a mistake of the SDK, not of the framework.
class UnknownStep : public std::logic_error {
  public:
    explicit UnknownStep(const std::string& step) : std::logic_error("the SDK cannot carry out step '" + step + "'") {}
};

/// Looks up what a step needs, has the adapter do it, and records call and outcome. Steps of several threads come at once.
class Operations {
  public:
    Operations(std::shared_ptr<Adapter> adapter, std::shared_ptr<const Scenario> scenario, std::shared_ptr<Stage> stage,
               ContainerHandle manager)
        : adapter_(std::move(adapter)),
          scenario_(std::move(scenario)),
          stage_(std::move(stage)),
          manager_(std::move(manager)),
          variables_(manager_) {}

    void perform(std::int64_t number, const Step& step) {
        Arguments arguments;
        if (begin(number, step, arguments)) {
            call(number, step, arguments);
        }
    }

    /// The references of these names that are not null; false, and `skip` is recorded, if one was never bound.
    bool references(std::int64_t number, const std::vector<std::string>& names, std::vector<Reference>& found) {
        for (const std::string& name : names) {
            Reference reference;
            if (!variables_.reference(name, reference)) {
                return skip(number, name);
            }
            if (reference) {
                found.push_back(reference);
            }
        }
        return true;
    }

    /// Has the scenario destroyed the runtime?
    bool destroyed() const { return destroyed_; }

  private:
    struct Arguments {
        LinkHandle link;
        ContainerHandle container;
        ContainerHandle sub_container;
        Id id = 0;
        Reference reference;
    };

    // In one turn, so that the trace has a variable bound before it has it used.
    bool begin(std::int64_t number, const Step& step, Arguments& arguments) {
        std::lock_guard<std::mutex> lock(turn_);
        const bool complete = resolve(number, step, arguments);
        if (complete) {
            stage_->recorder.record(events::Call(number));
        }
        return complete;
    }

    // Looks up what the step needs, in the order of its arguments; records `skip` for the first that is not there.
    bool resolve(std::int64_t number, const Step& step, Arguments& arguments) {
        if (is_about_a_link(step.kind) && !variables_.link(step.link, arguments.link)) {
            return skip(number, step.link);
        }
        if (step.kind != Operation::remove_container && !variables_.container(step.container, arguments.container)) {
            return skip(number, step.container);
        }
        switch (step.kind) {
            case Operation::attach:
            case Operation::detach:
            case Operation::remove_component:
            case Operation::get_port_element:
                return variables_.id(step.id, arguments.id) || skip(number, step.id);
            case Operation::disconnect:
                return variables_.id(step.connection, arguments.id) || skip(number, step.connection);
            case Operation::connect:
                return (variables_.id(step.id, arguments.id) || skip(number, step.id)) &&
                       (variables_.reference(step.to, arguments.reference) || skip(number, step.to));
            case Operation::remove_container:
                return variables_.container(step.container, arguments.sub_container) || skip(number, step.container);
            case Operation::invoke:  // nothing can be called through a null reference
                return (variables_.reference(step.ref, arguments.reference) && arguments.reference) ||
                       skip(number, step.ref);
            default:
                return true;
        }
    }

    static bool is_about_a_link(Operation operation) {
        return operation == Operation::attach || operation == Operation::detach || operation == Operation::break_link ||
               operation == Operation::mend_link;
    }

    bool skip(std::int64_t number, const std::string& variable) {
        stage_->recorder.record(events::Skip(number, variable));
        return false;
    }

    void call(std::int64_t number, const Step& step, const Arguments& arguments) {
        try {
            operate(number, step, arguments);
        } catch (const UnknownStep&) {
            throw;
        } catch (const NotOffered&) {
            skip(number, word_of(step.kind));
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

    // Carries the step out and records its result.
    void operate(std::int64_t number, const Step& step, const Arguments& with) {
        switch (step.kind) {
            case Operation::add_component: {
                const Declaration* const declaration = declared(step.component);
                Attributes attributes = step.attributes;
                if (declaration != nullptr) {
                    attributes.insert(declaration->attributes.begin(), declaration->attributes.end());
                }
                const Id id = adapter_->add_component(with.container, step.component, attributes);
                std::lock_guard<std::mutex> lock(turn_);
                variables_.bind_id(step.bind.empty() ? step.component : step.bind, id);
                return returned(number, id);
            }
            case Operation::remove_component:
                adapter_->remove_component(with.container, with.id);
                break;
            case Operation::get_port_element: {
                const Reference reference = adapter_->get_port_element(with.container, with.id, step.port);
                std::lock_guard<std::mutex> lock(turn_);
                variables_.bind_reference(step.bind, reference);
                return returned(number, reference);
            }
            case Operation::connect: {
                const Id id = adapter_->connect(with.container, with.id, step.port, with.reference);
                std::lock_guard<std::mutex> lock(turn_);
                variables_.bind_id(step.bind, id);
                return returned(number, id);
            }
            case Operation::disconnect:
                adapter_->disconnect(with.container, with.id);
                break;
            case Operation::start:
                adapter_->start(with.container);
                break;
            case Operation::stop:
                adapter_->stop(with.container);
                break;
            case Operation::get_components: {
                const std::vector<Id> ids = adapter_->get_components(with.container);
                if (is_too_much(ids.size(), "get_components", "ids")) {
                    break;
                }
                std::lock_guard<std::mutex> lock(turn_);
                variables_.saw(ids);
                return returned(number, ids);
            }
            case Operation::create_container: {
                const ContainerHandle container = adapter_->create_container(manager_);
                std::lock_guard<std::mutex> lock(turn_);
                variables_.bind_container(step.bind, container);
                return stage_->recorder.record(events::Return(number));
            }
            case Operation::remove_container:
                adapter_->remove_container(manager_, with.sub_container);
                break;
            case Operation::destroy:
                adapter_->destroy(manager_);
                destroyed_ = true;
                break;
            case Operation::invoke:
                return returned(number, with.reference->exchange(step.value));
            case Operation::link: {
                const auto types = scenario_->types.find(step.interface);
                const LinkHandle link =
                    types != scenario_->types.end()
                        ? adapter_->link_with_types(manager_, step.connector, types->second)
                        : adapter_->link(manager_, step.connector, scenario_->interfaces.at(step.interface));
                std::lock_guard<std::mutex> lock(turn_);
                variables_.bind_link(step.bind, link);
                return stage_->recorder.record(events::Return(number));
            }
            case Operation::attach:
                adapter_->attach(with.link, step.role, with.container, with.id, step.port);
                break;
            case Operation::detach:
                adapter_->detach(with.link, with.container, with.id, step.port);
                break;
            case Operation::break_link:
                adapter_->break_link(with.link, step.where);
                break;
            case Operation::mend_link:
                adapter_->mend_link(with.link);
                break;
            case Operation::read_log:
                return stage_->recorder.record(events::Return(number).records(read_log(step.records)));
            case Operation::advance:
                adapter_->advance(manager_, step.milliseconds);
                break;
            default:
                throw UnknownStep(word_of(step.kind));
        }
        stage_->recorder.record(events::Return(number));
    }

    // No event says that a record has been written, so this reads until there are enough.
    std::vector<LogRecord> read_log(std::int64_t enough) {
        const auto deadline = std::chrono::steady_clock::now() + stage_->patience;
        while (true) {
            std::vector<LogRecord> records = adapter_->read_log(manager_);
            if (is_too_much(records.size(), "read_log", "records")) {
                return {};
            }
            if (static_cast<std::int64_t>(records.size()) >= enough || std::chrono::steady_clock::now() >= deadline) {
                return records;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    // Says so if the adapter returned what no scenario can have led to.
    bool is_too_much(std::size_t size, const char* call, const char* what) {
        if (size > MOST) {
            stage_->complain(std::string(call) + " returned " + too_many(what) + ", which no scenario can have led to");
        }
        return size > MOST;
    }

    // Null for a component that the scenario does not declare.
    const Declaration* declared(const std::string& name) const {
        for (const Component& component : scenario_->components) {
            if (component.first == name) {
                return &component.second;
            }
        }
        return nullptr;
    }

    template <class Value>
    void returned(std::int64_t number, const Value& value) {
        stage_->recorder.record(events::Return(number).value(value));
    }

    void raised(std::int64_t number, const char* error, const char* detail) {
        const std::string text = json::shortened(detail != nullptr ? detail : "", 200);
        stage_->recorder.record(events::Raise(number, error).detail(text));
    }

    const std::shared_ptr<Adapter> adapter_;
    const std::shared_ptr<const Scenario> scenario_;
    const std::shared_ptr<Stage> stage_;
    const ContainerHandle manager_;
    std::mutex turn_;
    Variables variables_;
    std::atomic<bool> destroyed_{false};
};

}  // namespace ucm_cts

#endif
