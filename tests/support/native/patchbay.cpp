// Patchbay: the least framework that has connectors, clock and trace, for tests of the SDK. One container, nothing checked.
//
// Port elements whose name tells so make it a bad framework: a service connector "keeps" the arguments of a call and
// delivers those of the call before, or "forges" results that are no values; callers that get one that "hangs" never come
// back, and those that get one that "throws" come back with an exception.
#include <ucm_cts/main.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using ucm_cts::Data;
using ucm_cts::Id;
using ucm_cts::Reference;
typedef ucm_cts::ContainerHandle Handle;

// a connection with a connector
struct Link {
    struct End {
        Id component;
        std::string port;
        std::string role;
        Reference element;
    };

    std::vector<End> takers() const {
        std::vector<End> found;
        std::copy_if(ends.begin(), ends.end(), std::back_inserter(found),
                     [](const End& end) { return end.element != nullptr; });
        return found;
    }

    bool of_messages;
    ucm_cts::SharedInterface interface;
    std::vector<End> ends;
    std::string broken;
    const Data* kept = nullptr;
};

// what a client or emitter is connected to
class LinkElement final : public ucm_cts::PortElement {
  public:
    explicit LinkElement(std::shared_ptr<Link> link) : link_(std::move(link)) {}

    std::int32_t exchange(std::int32_t) override { throw ucm_cts::UcmError("the port element has another interface"); }

    Data call(const std::string& method, const Data& arguments) override {
        if (link_->interface->methods.count(method) == 0) {
            throw ucm_cts::UcmError("no such method");
        }
        if (link_->of_messages) {
            return push(method, arguments);
        }
        if (!link_->broken.empty()) {
            throw ucm_cts::UcmError("broken");
        }
        const Link::End server = link_->takers().at(0);
        if (server.port == "keeps") {
            const Data* const before = link_->kept;
            link_->kept = &arguments;
            return before != nullptr ? server.element->call(method, *before) : Data();
        }
        if (server.port == "forges") {
            return Data(1, nullptr);
        }
        return server.element->call(method, arguments);
    }

  private:
    Data push(const std::string& method, const Data& arguments) {
        if (!link_->broken.empty()) {
            return Data(1, link_->broken == "transport" ? "comm_error" : "internal_error");
        }
        for (const Link::End& receiver : link_->takers()) {
            try {
                receiver.element->call(method, arguments);
            } catch (...) {  // no caller could receive it
            }
        }
        return Data(1, "ok");
    }

    const std::shared_ptr<Link> link_;
};

// what a component requires by the clock and the trace
class Service final : public ucm_cts::PortElement {
  public:
    explicit Service(std::vector<ucm_cts::LogRecord>& log) : log_(log) {}

    std::int32_t exchange(std::int32_t) override { throw ucm_cts::UcmError("the port element has another interface"); }

    Data call(const std::string& method, const Data& arguments) override {
        if (method == "log") {
            log_.push_back({arguments.at(0), arguments.at(1)});
            return Data();
        }
        return Data(1, Data{1, 2});
    }

  private:
    std::vector<ucm_cts::LogRecord>& log_;
};

// what callers get instead of a port element whose name tells so
class Bad final : public ucm_cts::PortElement {
  public:
    explicit Bad(bool hangs) : hangs_(hangs) {}

    std::int32_t exchange(std::int32_t) override {
        while (hangs_) {
            std::this_thread::sleep_for(std::chrono::seconds(1));
        }
        throw 42;
    }

  private:
    const bool hangs_;
};

class Patchbay final : public ucm_cts::Adapter {
  public:
    Handle create_runtime(const std::vector<ucm_cts::Implementation>& all) override {
        for (const ucm_cts::Implementation& one : all) {
            implementations_.emplace(one.name, one);
        }
        return std::make_shared<int>(0);
    }

    Id add_component(const Handle&, const std::string& implementation, const ucm_cts::Attributes&) override {
        const ucm_cts::Implementation& made = implementations_.at(implementation);
        const Member member = {&made, made.create(), {}};
        member.body->on_init();
        members_.emplace(++last_, member);
        return last_;
    }

    void remove_component(const Handle&, Id id) override {
        members_.at(id).body->on_remove();
        members_.erase(id);
    }

    Reference get_port_element(const Handle&, Id id, const std::string& port) override {
        if (port == "hangs" || port == "throws") {
            return std::make_shared<Bad>(port == "hangs");
        }
        return members_.at(id).body->get_portElement(port);
    }

    Id connect(const Handle&, Id id, const std::string& port, const Reference& to) override {
        members_.at(id).connections.push_back({port, {to}});
        return ++last_;
    }

    void disconnect(const Handle&, Id) override {}

    void start(const Handle&) override {
        for (auto& entry : members_) {
            std::vector<ucm_cts::PortConnection> dependencies = entry.second.connections;
            for (const ucm_cts::Policy& policy : entry.second.implementation->policies) {
                if (!policy.element.empty()) {
                    dependencies.push_back({policy.element, {std::make_shared<Service>(log_)}});
                }
            }
            entry.second.body->on_startup(dependencies);
        }
    }

    void stop(const Handle&) override {
        for (auto entry = members_.rbegin(); entry != members_.rend(); ++entry) {
            entry->second.body->on_shutdown();
        }
    }

    std::vector<Id> get_components(const Handle&) override { return std::vector<Id>(); }
    Handle create_container(const Handle&) override { throw ucm_cts::UcmError("no"); }
    void remove_container(const Handle&, const Handle&) override { throw ucm_cts::UcmError("no"); }

    void destroy(const Handle&) override {
        for (; !members_.empty(); members_.erase(std::prev(members_.end()))) {
            std::prev(members_.end())->second.body->on_remove();
        }
    }

    ucm_cts::LinkHandle link(const Handle&, const std::string& connector,
                             const ucm_cts::SharedInterface& interface) override {
        const std::shared_ptr<Link> made = std::make_shared<Link>();
        made->of_messages = connector == "simple_message_connector";
        made->interface = interface;
        return made;
    }

    void attach(const ucm_cts::LinkHandle& handle, const std::string& role, const Handle&, Id id,
                const std::string& port) override {
        const std::shared_ptr<Link> link = std::static_pointer_cast<Link>(handle);
        if (role == "server" && !link->takers().empty()) {
            throw ucm_cts::UcmError("the connection has a server already");
        }
        const bool takes = role == "server" || role == "receiver";
        link->ends.push_back({id, port, role, takes ? members_.at(id).body->get_portElement(port) : nullptr});
        if (!takes) {
            members_.at(id).connections.push_back({port, {std::make_shared<LinkElement>(link)}});
        }
    }

    void detach(const ucm_cts::LinkHandle& handle, const Handle&, Id id, const std::string& port) override {
        std::vector<Link::End>& ends = static_cast<Link*>(handle.get())->ends;
        const auto is_it = [&](const Link::End& end) { return end.component == id && end.port == port; };
        if (std::none_of(ends.begin(), ends.end(), is_it)) {
            throw ucm_cts::NotFound("no such end");
        }
        ends.erase(std::remove_if(ends.begin(), ends.end(), is_it), ends.end());
    }

    void break_link(const ucm_cts::LinkHandle& link, const std::string& where) override {
        static_cast<Link*>(link.get())->broken = where;
    }

    void mend_link(const ucm_cts::LinkHandle& link) override { static_cast<Link*>(link.get())->broken.clear(); }

    // one record more each time: a wait for records must ask again
    std::vector<ucm_cts::LogRecord> read_log(const Handle&) override {
        read_ = std::min(read_ + 1, log_.size());
        return std::vector<ucm_cts::LogRecord>(log_.begin(), log_.begin() + static_cast<std::ptrdiff_t>(read_));
    }

  private:
    struct Member {
        const ucm_cts::Implementation* implementation;
        std::shared_ptr<ucm_cts::Body> body;
        std::vector<ucm_cts::PortConnection> connections;
    };

    std::map<std::string, ucm_cts::Implementation> implementations_;
    std::map<Id, Member> members_;
    std::vector<ucm_cts::LogRecord> log_;
    std::size_t read_ = 0;
    Id last_ = 0;
};

}  // namespace

UCM_CTS_ADAPTER(Patchbay, "patchbay", "0");
