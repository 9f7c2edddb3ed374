// The request-response connector (10.4.1). Requests of synchronous clients to a synchronous server are calls of it; all
// others have a number until they are answered. A request that is open when its client or server is stopped is dropped.
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "containers/container_impl.hpp"
#include "containers/names.hpp"
#include "links/connectors.hpp"
#include "links/lane.hpp"
#include "links/request_response_interfaces.hpp"

namespace lwucm {

namespace {

Value code(const char* name) { return Value::enumerator(name); }

class RequestResponse;

/// A port element of a port that is attached. `of` is the port.
class PortEnd : public End {
  public:
    PortEnd(Instance& instance, bool is_required, const std::string& element, std::string port, RequestResponse& link,
            bool server)
        : End(instance, is_required ? Role::client : Role::server, element),
          of(std::move(port)), is_server(server), connector(link) {}

    void stopping() override;
    void left() override;

    const std::string of;
    const bool is_server;

  protected:
    RequestResponse& connector;
};

/// A port element that the connector calls.
class CalledEnd final : public PortEnd {
  public:
    CalledEnd(Instance& instance, const std::string& element, const std::string& port, RequestResponse& link,
              bool server, std::shared_ptr<DynamicPortElement> called)
        : PortEnd(instance, false, element, port, link, server), called_(std::move(called)) {}

    void started() override {
        admission_.open();
        lane_.open();
    }
    void stopping() override {
        PortEnd::stopping();
        lane_.shut();
        admission_.shut();
    }
    void await_calls() override {
        lane_.await_calls();
        admission_.await_leaving();
    }
    void left() override {
        PortEnd::left();
        admission_.shut();
        lane_.shut();
        lane_.end();
    }

    bool is_open() { return admission_.is_open(); }

    /// UCM_ERROR if the component is not operational.
    Values call(const char* method, const Values& arguments) {
        const Admission::Call call(admission_);
        if (!call.admitted()) {
            throw UCM_ERROR("the component is not operational");
        }
        return called_->call(method, arguments);
    }

    /// On the thread of the end, after what came before; forgotten if the component is not operational then.
    void call_later(std::function<void()> call) { lane_.put(std::move(call)); }

  private:
    const std::shared_ptr<DynamicPortElement> called_;
    Admission admission_;
    Lane lane_;
};

/// A request that waits for its response. `callback` is null if its client waits.
struct OpenRequest {
    const Instance* client;
    std::shared_ptr<CalledEnd> callback;
    bool is_over = false;
    bool is_answered = false;
    Value response;
};

class RequestResponse final : public LinkImpl {
  public:
    RequestResponse(std::shared_ptr<Shared> shared, const BoundTypes& types)
        : LinkImpl(std::move(shared)), types_(types), nothing_(any_value(*response_type(types))) {
        port_elements(Role::rr_synchronous_server, types);  // are they the right ones?
    }

    void attach(Role role, const std::shared_ptr<Container>& container, componentId component,
                const std::string& port) override {
        Operation operation(*shared_);
        const ContainerImpl& its_container = own(container);
        const std::shared_ptr<Instance> instance = find(its_container, component);
        const PortElements elements = port_elements(role, types_);
        const std::string provided = elements.provided.empty() ? "" : port + "_" + elements.provided;
        const std::string required = elements.required.empty() ? "" : port + "_" + elements.required;
        if (!provided.empty()) {
            check_port(*instance, false, provided, *elements.provided_interface);
        }
        if (!required.empty()) {
            check_port(*instance, true, required, *elements.required_interface);
        }
        check_configuring(its_container);
        if (!required.empty() && instance->is_connected(required)) {
            throw UCM_ERROR(quoted(required) + " is already connected");
        }
        std::shared_ptr<CalledEnd> called;
        if (!provided.empty()) {
            called = std::make_shared<CalledEnd>(*instance, provided, port, *this, elements.is_server,
                                                 ask(*instance, provided));
        }
        if (elements.is_server) {
            claim(called, !required.empty());
        }
        if (!required.empty()) {
            connect(*instance, elements, port, required, called);
        }
        if (called) {
            add(called);
        }
    }

    void detach(const std::shared_ptr<Container>& container, componentId component, const std::string& port) override {
        Operation operation(*shared_);
        const ContainerImpl& its_container = own(container);
        const std::shared_ptr<Instance> instance = find(its_container, component);
        std::vector<std::shared_ptr<End>> leaving;
        for (const std::shared_ptr<End>& end : ends()) {
            if (&end->instance() == instance.get() && static_cast<const PortEnd&>(*end).of == port) {
                leaving.push_back(end);
            }
        }
        if (leaving.empty()) {
            throw NOT_FOUND(quoted(port) + " is no end of the link");
        }
        check_configuring(its_container);
        Attempts attempts;
        for (const std::shared_ptr<End>& end : leaving) {
            remove(end, attempts);
        }
        attempts.check();
    }

    bool needs(const Instance&) const override { return false; }

    /// Drops the open requests of a component, or all if it is the server.
    void abandon(const Instance& instance) {
        std::lock_guard<std::mutex> lock(mutex_);
        const bool all = server_ && &server_->instance() == &instance;
        for (auto one = open_.begin(); one != open_.end();) {
            const bool is_dropped = all || one->second->client == &instance;
            one->second->is_over = one->second->is_over || is_dropped;
            one = is_dropped ? open_.erase(one) : std::next(one);
        }
        over_.notify_all();
    }

  protected:
    void forget(const End& end) override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_.get() == &end) {
            server_ = nullptr;
        }
    }

  private:
    /// What a required port element is connected to.
    class Element final : public DynamicPortElement {
      public:
        typedef std::function<Values(const Values&)> Send;

        Element(std::shared_ptr<RequestResponse> connector, InterfacePtr interface, Send send)
            : connector_(std::move(connector)), interface_(std::move(interface)), send_(std::move(send)) {}

        const InterfacePtr& get_interface() const override { return interface_; }

        Values call(const std::string& method, const Values& arguments) override {
            interface_->method(method);
            return send_(arguments);
        }

      private:
        const std::shared_ptr<RequestResponse> connector_;
        const InterfacePtr interface_;
        const Send send_;
    };

    void claim(const std::shared_ptr<CalledEnd>& called, bool answers_later) {
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_) {
            throw UCM_ERROR("the connection has a server already");
        }
        server_ = called;
        answers_later_ = answers_later;
    }

    void connect(Instance& instance, const PortElements& elements, const std::string& port, const std::string& required,
                 const std::shared_ptr<CalledEnd>& called) {
        RequestResponse* const self = this;
        const Instance* const client = &instance;
        Element::Send send;
        if (elements.is_server) {
            send = [self](const Values& given) { return Values{code(self->respond(given.at(0), given.at(1)))}; };
        } else if (called) {
            send = [self, client, called](const Values& given) { return self->ask_later(client, called, given.at(0)); };
        } else {
            send = [self, client](const Values& given) { return self->ask_and_wait(client, given.at(0)); };
        }
        const auto element = std::make_shared<Element>(
            std::static_pointer_cast<RequestResponse>(shared_from_this()), elements.required_interface, send);
        Attempts attempts;
        attempts.make("on_connect", [&] { instance.connect(required, element); });
        try {
            attempts.check();
        } catch (...) {
            if (elements.is_server) {
                forget(*called);
            }
            throw;
        }
        add(std::make_shared<PortEnd>(instance, true, required, port, *this, elements.is_server));
    }

    const char* fault() {
        const Condition condition = transport_.condition();
        return condition == Condition::sound              ? nullptr
               : condition == Condition::transport_broken ? "comm_error"
                                                          : "internal_error";
    }

    std::shared_ptr<CalledEnd> server(bool& answers_later) {
        std::lock_guard<std::mutex> lock(mutex_);
        answers_later = answers_later_;
        return server_ && server_->is_open() ? server_ : nullptr;
    }

    Values ask_and_wait(const Instance* client, const Value& request) {
        if (const char* const failure = fault()) {
            return {nothing_, code(failure)};
        }
        bool later = false;
        const std::shared_ptr<CalledEnd> its_server = server(later);
        if (!its_server) {
            return {nothing_, code("internal_error")};
        }
        if (!later) {
            return its_server->call(REQUEST, {request});
        }
        const auto opened = std::make_shared<OpenRequest>();
        opened->client = client;
        const std::uint32_t number = open(opened);
        give(*its_server, number, request);
        std::unique_lock<std::mutex> lock(mutex_);
        over_.wait(lock, [&opened] { return opened->is_over; });
        if (!opened->is_answered) {
            return {nothing_, code("internal_error")};
        }
        return {opened->response, code("ok")};
    }

    Values ask_later(const Instance* client, const std::shared_ptr<CalledEnd>& callback, const Value& request) {
        const Value none = Value::integer(0);
        if (const char* const failure = fault()) {
            return {none, code(failure)};
        }
        bool later = false;
        const std::shared_ptr<CalledEnd> its_server = server(later);
        if (!its_server) {
            return {none, code("internal_error")};
        }
        const auto opened = std::make_shared<OpenRequest>();
        opened->client = client;
        opened->callback = callback;
        const std::uint32_t number = open(opened);
        CalledEnd* const called = its_server.get();  // its lane ends before it does
        its_server->call_later([this, called, number, request, later] {
            if (later) {
                give(*called, number, request);
            } else {
                respond_for(*called, number, request);
            }
        });
        return {Value::integer(number), code("ok")};
    }

    /// A synchronous server answers as its method returns; if it fails there is no response.
    void respond_for(CalledEnd& its_server, std::uint32_t number, const Value& request) {
        Values given;
        try {
            given = its_server.call(REQUEST, {request});
        } catch (...) {
            drop(number);
            throw;
        }
        respond(given.at(0), Value::integer(number));
    }

    /// Gives a request to an asynchronous server; one that raises will not answer.
    void give(CalledEnd& its_server, std::uint32_t number, const Value& request) {
        try {
            its_server.call(REQUEST, {request, Value::integer(number)});
        } catch (...) {
            drop(number);
            throw;
        }
    }

    std::uint32_t open(const std::shared_ptr<OpenRequest>& opened) {
        std::lock_guard<std::mutex> lock(mutex_);
        while (open_.count(++last_) != 0) {
        }
        open_[last_] = opened;
        return last_;
    }

    void drop(std::uint32_t number) {
        std::lock_guard<std::mutex> lock(mutex_);
        open_.erase(number);
    }

    /// The code for the server.
    const char* respond(const Value& response, const Value& id) {
        if (const char* const failure = fault()) {
            return failure;
        }
        std::shared_ptr<OpenRequest> opened;
        {
            std::lock_guard<std::mutex> lock(mutex_);
            const auto found = open_.find(static_cast<std::uint32_t>(id.as_natural()));
            if (found == open_.end()) {
                return "internal_error";
            }
            opened = found->second;
            open_.erase(found);
            opened->response = response;
            opened->is_answered = opened->is_over = true;
            over_.notify_all();
        }
        if (opened->callback) {
            CalledEnd* const client = opened->callback.get();
            client->call_later([client, response, id] { client->call(RESPONSE, {response, id}); });
        }
        return "ok";
    }

    const BoundTypes types_;
    const Value nothing_;
    mutable std::mutex mutex_;
    std::condition_variable over_;  // a request was answered or dropped
    std::shared_ptr<CalledEnd> server_;
    bool answers_later_ = false;
    std::map<std::uint32_t, std::shared_ptr<OpenRequest>> open_;
    std::uint32_t last_ = 0;
};

void PortEnd::stopping() { connector.abandon(instance()); }

void PortEnd::left() { connector.abandon(instance()); }

}  // namespace

std::shared_ptr<Link> make_request_response_connector(std::shared_ptr<Shared> shared, const BoundTypes& types) {
    return std::make_shared<RequestResponse>(std::move(shared), types);
}

}  // namespace lwucm
