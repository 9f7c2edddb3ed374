// Cells: a framework with names for ids, sockets for references and connectors that are made of fragments, bound with binding.hpp
// and fragments.hpp. It checks hardly anything.
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <ucm_cts/binding.hpp>
#include <ucm_cts/fragments.hpp>
#include <ucm_cts/main.hpp>

using ucm_cts::Data;
typedef ucm_cts::ContainerHandle Handle;

namespace cells {

struct Unknown : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct Wrong {};
struct Refused {};

struct Socket {
    std::function<int(int)> ask;
    std::function<Data(const std::string&, const Data&)> call;
};
typedef std::shared_ptr<const Socket> Plug;
typedef std::vector<std::pair<std::string, Plug>> Plugs;

// what is in a box: functions that the framework calls
struct Cell {
    std::function<void(const Plugs&)> begin;
    std::function<void()> end;
    std::function<void()> remove;
    std::function<Plug(const std::string&)> socket;
    Plugs plugs;
};

struct Box {
    Cell& cell(const std::string& name) {
        const auto found = cells.find(name);
        return found != cells.end() ? found->second : throw Unknown(name);
    }

    std::map<std::string, Cell> cells;
    bool running = false;
};

}  // namespace cells

namespace {

struct Reference : ucm_cts::Wrapped<cells::Plug> {
    using Wrapped::Wrapped;
    std::int32_t exchange(std::int32_t value) override { return own->ask(value); }
    Data call(const std::string& method, const Data& arguments) override { return own->call(method, arguments); }
};

cells::Plug plug(const ucm_cts::Reference& element) {
    return std::make_shared<cells::Socket>(cells::Socket{
        [element](int value) { return element->exchange(value); },
        [element](const std::string& method, const Data& arguments) { return element->call(method, arguments); }});
}

// A timer that tells which handler it has, and is not to be cancelled.
struct Bell : ucm_cts::ObjectTimer {
    explicit Bell(bool is_same) : is_same_handler(is_same) {}
    std::int64_t rounds() override { return INT64_MAX; }
    std::string id() override { return is_same_handler ? "same" : "other"; }
    void cancel() override { throw cells::Refused(); }
    bool is_cancelled() override { return false; }

    const bool is_same_handler;
};

// A scheduler that triggers at once: with a timer that it returns, or without any.
struct Scheduler : ucm_cts::TimerScheduler {
    std::shared_ptr<ucm_cts::ObjectTimer> scheduler_trigger(const std::shared_ptr<ucm_cts::TimerHandler>& handler,
                                                            const ucm_cts::TimeValue& delay) override {
        const bool is_same = last_ == handler;
        last_ = handler;
        const auto bell = delay.seconds > 0 ? std::make_shared<Bell>(is_same) : nullptr;
        handler->on_trigger(bell, delay, delay.microseconds);
        return bell;
    }

    std::shared_ptr<ucm_cts::ObjectTimer> schedule_repeated_trigger(const std::shared_ptr<ucm_cts::TimerHandler>&,
                                                                    const ucm_cts::TimeValue&,
                                                                    const ucm_cts::TimeValue&,
                                                                    std::int64_t max_rounds) override {
        return max_rounds > 0 ? nullptr : throw ucm_cts::DeclaredException("no rounds");
    }

  private:
    std::shared_ptr<ucm_cts::TimerHandler> last_;
};

class CellsAdapter final : public ucm_cts::FragmentConnectors<ucm_cts::BareAdapter> {
  public:
    Handle create_runtime(const std::vector<ucm_cts::Implementation>& implementations) override {
        for (const ucm_cts::Implementation& one : implementations) {
            implementations_.emplace(one.name, one);
        }
        return std::make_shared<cells::Box>();
    }

    ucm_cts::Id add_component(const Handle& box, const std::string& implementation,
                              const ucm_cts::Attributes& attributes) override {
        return translate([&] {
            const std::string name = implementation + " " + std::to_string(++last_);
            const bool is_end = implementation == "client" || implementation == "server";
            of(box).cells[name] = is_end ? end(channels_[attributes.at("link")], implementation == "server")
                                         : cell(implementations_.at(implementation), box, attributes);
            return ids_.number(name);
        });
    }

    void remove_component(const Handle& box, ucm_cts::Id id) override {
        translate([&] {
            of(box).cell(ids_.own(id)).remove();
            of(box).cells.erase(ids_.own(id));
        });
    }

    ucm_cts::Reference get_port_element(const Handle& box, ucm_cts::Id id, const std::string& port) override {
        return translate([&] { return std::make_shared<Reference>(of(box).cell(ids_.own(id)).socket(port)); });
    }

    ucm_cts::Id connect(const Handle& box, ucm_cts::Id id, const std::string& port,
                        const ucm_cts::Reference& to) override {
        return translate([&] {
            const cells::Plug target = Reference::unwrap(to);
            of(box).cell(ids_.own(id)).plugs.emplace_back(port, target ? target : throw cells::Wrong());
            return connections_.number(std::make_pair(ids_.own(id), port));
        });
    }

    void disconnect(const Handle& box, ucm_cts::Id connection) override {
        translate([&] {
            if (of(box).running) {
                throw cells::Refused();
            }
            of(box).cell(connections_.own(connection).first).plugs.clear();
        });
    }

    void start(const Handle& box) override {
        translate([&] {
            for (auto& each : of(box).cells) {
                each.second.begin(each.second.plugs);
            }
        });
        of(box).running = true;
    }

    void stop(const Handle& box) override {
        for (auto& each : of(box).cells) {
            each.second.end();
        }
        of(box).running = false;
    }

    std::vector<ucm_cts::Id> get_components(const Handle& box) override {
        std::vector<std::string> names;
        for (const auto& each : of(box).cells) {
            names.push_back(each.first);
        }
        return ids_.numbers(names);
    }

    Handle create_container(const Handle&) override { return std::make_shared<cells::Box>(); }

    void remove_container(const Handle&, const Handle& box) override {
        if (of(box).running) {
            stop(box);
        }
        of(box).cells.clear();
    }

    void destroy(const Handle& box) override { of(box).cells.clear(); }

  protected:
    bool offers(const std::string& connector) override { return connector == "simple_service_connector"; }

    ucm_cts::EndFragment end_fragment(const ucm_cts::FragmentLink&, const std::string& role) override {
        return {role, "end"};
    }

  private:
    static cells::Box& of(const Handle& box) { return *static_cast<cells::Box*>(box.get()); }

    template <class Operation>
    static auto translate(Operation operation) -> decltype(operation()) {
        return ucm_cts::translated<cells::Unknown, cells::Wrong, cells::Refused>(operation);
    }

    cells::Cell cell(const ucm_cts::Implementation& one, const Handle& box, const ucm_cts::Attributes& attributes) {
        const std::shared_ptr<ucm_cts::Body> body = one.create();
        const ucm_cts::Policies policies(one.policies);
        initialise(*body, one, attributes, std::make_shared<ucm_cts::ContainerMembers>(*this, box));
        cells::Cell made;
        made.begin = [body, policies](const cells::Plugs& plugs) {
            std::vector<std::pair<std::string, ucm_cts::Reference>> pairs;
            for (const auto& each : plugs) {
                pairs.emplace_back(each.first, std::make_shared<Reference>(each.second));
            }
            for (const auto& each : policies.elements) {
                if (each.second == ucm_cts::OBJECT_TIMERS) {
                    pairs.emplace_back(each.first, std::make_shared<Scheduler>());
                } else {
                    pairs.emplace_back(each.first, std::make_shared<ucm_cts::Methods>(ucm_cts::Methods::Functions{
                        {"get_local_time", [](const Data&) { return Data(1, Data{1, 2}); }}}));
                }
            }
            body->on_startup(ucm_cts::port_connections(pairs));
        };
        made.end = [body] { body->on_shutdown(); };
        made.remove = [body] { body->on_remove(); };
        made.socket = [body](const std::string& port) {
            const ucm_cts::Reference element = body->get_portElement(port);
            return element ? plug(element) : throw cells::Unknown(port);
        };
        return made;
    }

    // the fragment at one end of a link
    static cells::Cell end(std::shared_ptr<cells::Plug>& channel, bool serves) {
        if (!channel) {
            channel = std::make_shared<cells::Plug>();
        }
        const std::shared_ptr<cells::Plug> shared = channel;
        cells::Cell made;
        made.begin = [shared, serves](const cells::Plugs& plugs) {
            if (serves) {
                *shared = *shared ? throw cells::Refused() : plugs.at(0).second;
            }
        };
        made.end = [shared, serves] {
            if (serves) {
                shared->reset();
            }
        };
        made.remove = [] {};
        made.socket = [shared](const std::string&) {
            return std::make_shared<cells::Socket>(cells::Socket{
                [](int) -> int { throw cells::Refused(); },
                [shared](const std::string& method, const Data& arguments) {
                    return *shared ? (*shared)->call(method, arguments) : throw cells::Refused();
                }});
        };
        return made;
    }

    std::map<std::string, ucm_cts::Implementation> implementations_;
    std::map<std::string, std::shared_ptr<cells::Plug>> channels_;
    ucm_cts::Ids<std::string> ids_{"nobody"};
    ucm_cts::Ids<std::pair<std::string, std::string>> connections_;
    std::atomic<int> last_{0};
};

}  // namespace

UCM_CTS_ADAPTER(CellsAdapter, "cells", "1.0");
