#include "links/connectors.hpp"

#include <atomic>
#include <utility>

#include "containers/instance.hpp"
#include "values/marshalling.hpp"

namespace lwucm {

namespace {

// how a reply begins
const std::uint64_t RESULTS = 0;
const std::uint64_t DECLARED_EXCEPTION = 1;  // which one, and its fields
const std::uint64_t FAILURE = 2;             // what happened, in words

Bytes failure(const std::string& text) {
    Writer reply;
    reply.number(FAILURE, 1);
    reply.text(text);
    return reply.take();
}

Bytes exception_reply(const Method& method, const DeclaredException& exception) {
    for (std::size_t index = 0; index < method.raises().size(); ++index) {
        const Type& declared = *method.raises()[index];
        if (declared.name == exception.name) {
            Writer reply;
            reply.number(DECLARED_EXCEPTION, 1);
            reply.number(index, 4);
            reply.fields(declared, exception.fields);
            return reply.take();
        }
    }
    return failure(method.name() + " does not declare exception " + exception.name);
}

Values read_reply(const Method& method, const Bytes& bytes) {
    Reader reply(bytes);
    const std::uint64_t kind = reply.number(1);
    if (kind == FAILURE) {
        throw UCM_ERROR(reply.text());
    }
    if (kind == DECLARED_EXCEPTION) {
        const Type& declared = *method.raises().at(static_cast<std::size_t>(reply.number(4)));
        Values fields = reply.fields(declared);
        reply.end();
        throw DeclaredException(declared.name, std::move(fields));
    }
    Values results = reply.values(method.results());
    reply.end();
    return results;
}

/// Calls of clients are carried out by the server, and the clients wait.
class ServiceConnector final : public ElementLink {
  public:
    using ElementLink::ElementLink;

    bool needs(const Instance& instance) const override {
        const std::shared_ptr<Server> its_server = server();
        if (!its_server || &its_server->instance() != &instance) {
            return false;
        }
        for (const std::shared_ptr<End>& end : ends()) {
            if (&end->instance() != &instance) {
                return true;
            }
        }
        return false;
    }

  protected:
    bool has_role(Role role) const override { return role == Role::client || role == Role::server; }

    std::shared_ptr<End> make_sender(Instance& instance, const std::string& port,
                                     std::shared_ptr<PortElementObject>& element) override {
        const auto client = std::make_shared<Client>(instance, port, *this);
        element = std::make_shared<ClientElement>(std::static_pointer_cast<ServiceConnector>(shared_from_this()), client);
        return client;
    }

    std::shared_ptr<End> make_taker(Instance& instance, const std::string& port,
                                    const std::shared_ptr<DynamicPortElement>& element) override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_) {
            throw UCM_ERROR("the service has a server already");
        }
        server_ = std::make_shared<Server>(instance, port, *this, element);
        return server_;
    }

    void forget(const End& end) override {
        std::lock_guard<std::mutex> lock(mutex_);
        if (server_.get() == &end) {
            server_ = nullptr;
        }
    }

  private:
    class Client final : public End {
      public:
        Client(Instance& instance, const std::string& port, ServiceConnector& connector)
            : End(instance, Role::client, port), connector_(connector) {}

        bool is_usable() const override { return connector_.server() != nullptr; }
        void starting() override { patient_ = true; }
        void stopping() override { hang_up(); }
        void left() override { hang_up(); }

        /// May its calls wait until communication is possible?
        bool is_patient() const { return patient_; }

      private:
        void hang_up() {
            patient_ = false;
            connector_.transport_.reconsider();
        }

        ServiceConnector& connector_;
        std::atomic<bool> patient_{false};
    };

    /// What the client's required port element is connected to.
    class ClientElement final : public DynamicPortElement {
      public:
        ClientElement(std::shared_ptr<ServiceConnector> connector, std::shared_ptr<Client> client)
            : connector_(std::move(connector)), client_(std::move(client)) {}

        const InterfacePtr& get_interface() const override { return connector_->get_interface(); }

        Values call(const std::string& method, const Values& arguments) override {
            return connector_->request(*client_, method, arguments);
        }

      private:
        const std::shared_ptr<ServiceConnector> connector_;
        const std::shared_ptr<Client> client_;
    };

    class Server final : public End {
      public:
        Server(Instance& instance, const std::string& port, ServiceConnector& connector,
               std::shared_ptr<DynamicPortElement> element)
            : End(instance, Role::server, port), connector_(connector), element_(std::move(element)) {}

        void starting() override { admission_.open(); }
        void shutting_down() override {
            left();
            admission_.await_leaving();
        }
        void left() override {
            admission_.shut();
            connector_.transport_.reconsider();
        }

        bool is_open() { return admission_.is_open(); }

        /// Carries out a request. UCM_ERROR if the server is not operational.
        Bytes serve(const Bytes& bytes) {
            const Admission::Call call(admission_);
            if (!call.admitted()) {
                throw UCM_ERROR("the server is not operational");
            }
            try {
                Reader request(bytes);
                const Method& method = element_->get_interface()->method(request.text());
                const Values arguments = request.values(method.arguments());
                request.end();
                return carry_out(method, arguments);
            } catch (const std::exception& error) {
                return failure(error.what());
            } catch (...) {
                return failure("the server failed");
            }
        }

      private:
        Bytes carry_out(const Method& method, const Values& arguments) {
            try {
                const Values results = element_->call(method.name(), arguments);
                Writer reply;
                reply.number(RESULTS, 1);
                reply.values(method.results(), results);
                return reply.take();
            } catch (const DeclaredException& exception) {
                return exception_reply(method, exception);
            }
        }

        ServiceConnector& connector_;
        const std::shared_ptr<DynamicPortElement> element_;
        Admission admission_;
    };

    std::shared_ptr<Server> server() const {
        std::lock_guard<std::mutex> lock(mutex_);
        return server_;
    }

    Values request(Client& client, const std::string& method, const Values& arguments) {
        const Method& called = get_interface()->method(method);
        Writer request;
        request.text(method);
        request.values(called.arguments(), arguments);
        const std::shared_ptr<Server> its_server = server();
        if (!its_server) {
            throw UCM_ERROR("the service has no server");
        }
        cross(client, *its_server);
        const Bytes reply = its_server->serve(request.take());
        cross(client, *its_server);
        return read_reply(called, reply);
    }

    /// The bytes have crossed the transport when this returns.
    void cross(Client& client, Server& server) {
        if (transport_.condition() == Condition::sound) {
            return;
        }
        const bool waits = shared_->platform.options.service_failure == Options::ServiceFailure::wait;
        if (!waits || !transport_.await_sound([&] { return !client.is_patient() || !server.is_open(); })) {
            throw UCM_ERROR("the server cannot be reached");
        }
    }

    mutable std::mutex mutex_;
    std::shared_ptr<Server> server_;
};

}  // namespace

std::shared_ptr<Link> make_service_connector(std::shared_ptr<Shared> shared, InterfacePtr interface) {
    return std::make_shared<ServiceConnector>(std::move(shared), std::move(interface));
}

}  // namespace lwucm
