// Engine: runs one scenario against one adapter.
#ifndef UCM_CTS_ENGINE_HPP
#define UCM_CTS_ENGINE_HPP

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/operations.hpp"
#include "ucm_cts/probe_body.hpp"
#include "ucm_cts/scenario.hpp"
#include "ucm_cts/stress.hpp"
#include "ucm_cts/workers.hpp"

namespace ucm_cts {

/// One run of one scenario. Threads that get stuck keep it alive.
class Engine : public std::enable_shared_from_this<Engine> {
  public:
    Engine(std::shared_ptr<Adapter> adapter, std::shared_ptr<const Scenario> scenario, Recorder::Sink sink)
        : adapter_(std::move(adapter)),
          scenario_(std::move(scenario)),
          stage_(std::make_shared<Stage>(std::move(sink), scenario_->patience)),
          configuration_(std::make_shared<Configuration>()),
          manager_(adapter_->create_runtime(implementations())),
          operations_(adapter_, scenario_, stage_, manager_),
          workers_(patience_of(scenario_->patience)) {}

    /// Runs all steps, appends the events to `trace` as a JSON array, and returns the names of the threads that are stuck.
    std::vector<std::string> run(std::string& trace) {
        std::int64_t number = 0;
        for (const Step& step : scenario_->steps) {
            if (step.has_thread) {
                const std::shared_ptr<Engine> self = shared_from_this();
                workers_.queue(step.thread, [self, number] { self->perform(number); });
            } else {
                perform(number);
            }
            ++number;
        }
        stage_->gates.open_all();
        const std::vector<std::string> stuck = workers_.finish();
        stage_->recorder.take(trace);
        if (stuck.empty()) {
            clean_up();
        }
        return stuck;
    }

    /// How the adapter broke the contract; empty if it did not.
    std::string complaint() const { return stage_->complaint(); }

  private:
    // the probes that the framework has made so far
    struct Configuration {
        std::mutex mutex;
        std::map<std::string, int> instances;
        std::vector<std::weak_ptr<Probe>> probes;
    };

    std::vector<Implementation> implementations() const {
        std::vector<Implementation> all;
        all.reserve(scenario_->components.size());
        for (const Component& component : scenario_->components) {
            const Declaration& declaration = component.second;
            std::vector<std::string> attributes;
            for (const auto& attribute : declaration.attributes) {
                attributes.push_back(attribute.first);
            }
            for (const auto& attribute : declaration.defaults) {
                if (declaration.attributes.count(attribute.first) == 0) {
                    attributes.push_back(attribute.first);
                }
            }
            const Component* const what = &component;
            const std::shared_ptr<Stage> stage = stage_;
            const std::shared_ptr<const Scenario> scenario = scenario_;
            const std::shared_ptr<Configuration> configuration = configuration_;
            Interfaces interfaces;
            for (const auto& port : declaration.ports) {
                interfaces[port.first] = scenario_->interfaces.at(port.second);
            }
            all.push_back(Implementation{component.first, declaration.provided, declaration.required,
                                         std::move(attributes), declaration.connectable, declaration.fragment,
                                         [what, stage, scenario, configuration] {
                                             return make(*what, stage, scenario, *configuration);
                                         },
                                         declaration.policies, std::move(interfaces), declaration.defaults});
        }
        return all;
    }

    static std::shared_ptr<Body> make(const Component& component, const std::shared_ptr<Stage>& stage,
                                      const std::shared_ptr<const Scenario>& scenario, Configuration& configuration) {
        std::lock_guard<std::mutex> lock(configuration.mutex);
        const int instance = ++configuration.instances[component.first];
        const std::shared_ptr<Probe> probe = std::make_shared<Probe>(stage, scenario, component, instance);
        configuration.probes.push_back(probe);
        return std::make_shared<ProbeBody>(probe);
    }

    void perform(std::int64_t number) {
        const Step& step = scenario_->steps[number];
        switch (step.kind) {
            case Operation::open:
                stage_->gates.open(step.gate, [this, &step] { stage_->recorder.record(events::Opened(step.gate)); });
                return;
            case Operation::reach:
                check_patience(number, stage_->gates.reach(step.gate, step.more, step.total));
                return;
            case Operation::settle:
                settle(step.worker);
                return;
            case Operation::join:
                check_patience(number, workers_.join(step.worker));
                return;
            case Operation::pause:
                pause(number, step.milliseconds);
                return;
            case Operation::await_messages:
                await_messages(number, step);
                return;
            case Operation::stress:
                stress(number, step);
                return;
            default:
                operations_.perform(number, step);
        }
    }

    void pause(std::int64_t number, std::int32_t milliseconds) {
        std::this_thread::sleep_for(std::chrono::milliseconds(std::max(milliseconds, 0)));
        const auto calendar = std::chrono::system_clock::now().time_since_epoch();
        stage_->recorder.record(
            events::Paused(number, std::chrono::duration_cast<std::chrono::nanoseconds>(calendar).count()));
    }

    void await_messages(std::int64_t number, const Step& step) {
        const MessageCount::Numbers counted = stage_->messages.of(step.component, step.instance)
                                                  ->wait(step.count, std::chrono::steady_clock::now() + stage_->patience);
        stage_->recorder.record(events::Counted(number, step.component, step.instance, counted.received,
                                                counted.distinct, counted.disordered)
                                    .least(counted.least)
                                    .greatest(counted.greatest));
    }

    void stress(std::int64_t number, const Step& step) {
        std::vector<Reference> references;
        if (!operations_.references(number, step.refs, references)) {
            return;
        }
        const std::shared_ptr<Stress> stress = std::make_shared<Stress>(stage_, references);
        std::vector<std::string> workers;
        for (const std::function<void()>& task : stress->tasks()) {
            workers.push_back("stress " + std::to_string(workers.size()));
            workers_.queue(workers.back(), task);
        }
        stress->conduct(std::chrono::milliseconds(std::max(step.milliseconds, 0)), stage_->patience);
        for (const std::string& worker : workers) {
            workers_.join(worker);
        }
        const Stress::Numbers found = stress->end();
        stage_->recorder.record(events::Stressed(number, found.calls, found.overlaps, found.control_calls,
                                                 found.control_overlaps)
                                    .failed(found.failed));
    }

    void settle(const std::string& worker) {
        const char* const where =
            workers_.settle(worker, [this](std::thread::id thread) { return stage_->gates.holds(thread); });
        stage_->recorder.record(events::Settled(worker, where));
    }

    void check_patience(std::int64_t number, bool in_time) {
        if (!in_time) {
            stage_->recorder.record(events::Timeout(number));
        }
    }

    void clean_up() {
        if (!operations_.destroyed()) {
            try {
                adapter_->destroy(manager_);
            } catch (...) {  // no step of the scenario, so its outcome is not recorded
            }
        }
        std::lock_guard<std::mutex> lock(configuration_->mutex);
        for (const std::weak_ptr<Probe>& each : configuration_->probes) {
            if (const std::shared_ptr<Probe> probe = each.lock()) {
                probe->forget();
            }
        }
    }

    const std::shared_ptr<Adapter> adapter_;
    const std::shared_ptr<const Scenario> scenario_;
    const std::shared_ptr<Stage> stage_;
    const std::shared_ptr<Configuration> configuration_;
    const ContainerHandle manager_;
    Operations operations_;
    Workers workers_;
};

}  // namespace ucm_cts

#endif
