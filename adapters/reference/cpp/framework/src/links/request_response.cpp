// The request-response connector (10.4.1). Requests of synchronous clients to a synchronous server are calls of it; all
// others have a number until they are answered. A request that is open when its client or server is stopped is dropped.
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "containers/container_impl.hpp"
#include "links/connectors.hpp"
#include "links/open_requests.hpp"
#include "links/request_response_interfaces.hpp"
#include "platform/parts.hpp"

namespace lwucm {

namespace {

class RequestResponse final : public PortLink {
  public:
    RequestResponse(std::shared_ptr<Shared> shared, const BoundTypes& types)
        : PortLink(std::move(shared)), types_(types), nothing_(any_value(*response_type(types))) {
        request_response_elements(Role::rr_synchronous_server, types);  // are they the right ones?
    }

    /// Drops the open requests of a component, or all if it is the server.
    void abandon(const Instance& instance) override {
        requests_->abandon(is_of_server(instance) ? nullptr : &instance);
    }

  protected:
    void forget(const End& end) override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_.get() == &end) {
            server_ = nullptr;
        }
    }

    PortElements elements_of(Role role) const override { return request_response_elements(role, types_); }

    void join(const AttachedPort& port) override {
        if (!is_server(port.role)) {
            return;
        }
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_) {
            throw UCM_ERROR("the connection has a server already");
        }
        server_ = port.called;
        answers_later_ = port.role == Role::rr_asynchronous_server;
    }

    Values carry_out(const AttachedPort& port, const std::string&, const Values& given) override {
        if (is_server(port.role)) {
            return {code(respond(given.at(0), given.at(1)))};
        }
        return port.called ? ask_later(port.instance, port.called, given.at(0)) : ask_and_wait(port.instance, given.at(0));
    }

  private:
    bool is_of_server(const Instance& instance) {
        std::lock_guard<std::mutex> lock(mutex_);
        return server_ && &server_->instance() == &instance;
    }

    static bool is_server(Role role) {
        return role == Role::rr_synchronous_server || role == Role::rr_asynchronous_server;
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
        const auto opened = std::make_shared<OpenRequest>(client, nullptr);
        give(*its_server, requests_->open(opened), request);
        if (!requests_->await(*opened)) {
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
        const std::uint32_t number = requests_->open(std::make_shared<OpenRequest>(client, callback));
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
            requests_->drop(number);
            throw;
        }
        respond(given.at(0), Value::integer(number));
    }

    /// Gives a request to an asynchronous server; one that raises will not answer.
    void give(CalledEnd& its_server, std::uint32_t number, const Value& request) {
        try {
            its_server.call(REQUEST, {request, Value::integer(number)});
        } catch (...) {
            requests_->drop(number);
            throw;
        }
    }

    /// The code for the server.
    const char* respond(const Value& response, const Value& id) {
        if (const char* const failure = fault()) {
            return failure;
        }
        const std::shared_ptr<OpenRequest> opened =
            requests_->answer(static_cast<std::uint32_t>(id.as_natural()), response);
        if (!opened) {
            return "internal_error";
        }
        if (opened->callback) {
            CalledEnd* const client = opened->callback.get();
            client->call_later([client, opened, id] { client->call(RESPONSE, {opened->response, id}); });
        }
        return "ok";
    }

    const BoundTypes types_;
    const Value nothing_;
    const std::unique_ptr<OpenRequests> requests_ = Parts::open_requests();
    std::mutex mutex_;
    std::shared_ptr<CalledEnd> server_;
    bool answers_later_ = false;
};

}  // namespace

std::shared_ptr<Link> make_request_response_connector(std::shared_ptr<Shared> shared, const BoundTypes& types) {
    return std::make_shared<RequestResponse>(std::move(shared), types);
}

}  // namespace lwucm
