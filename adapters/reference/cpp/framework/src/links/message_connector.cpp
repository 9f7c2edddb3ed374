#include "links/connectors.hpp"

#include <algorithm>
#include <utility>

#include "containers/instance.hpp"
#include "links/inbox.hpp"
#include "platform/parts.hpp"

namespace lwucm {

namespace {

const char* const PUSH = "push";
const char* const OK = "ok";
const char* const INTERNAL_ERROR = "internal_error";
const char* const COMM_ERROR = "comm_error";

bool has_codes(const Type& type) {
    const auto known = [&type](const std::string& name) {
        return std::any_of(type.enumerators.begin(), type.enumerators.end(),
                           [&name](const Enumerator& enumerator) { return enumerator.name == name; });
    };
    return known(OK) && known(INTERNAL_ERROR) && known(COMM_ERROR);
}

void check_is_message_interface(const Interface& interface) {
    const auto push = interface.methods().find(PUSH);
    if (interface.methods().size() != 1 || push == interface.methods().end() ||
        push->second.parameters().size() != 2 || push->second.arguments().size() != 1 ||
        push->second.results().size() != 1 || !has_codes(resolved(*push->second.results()[0]))) {
        throw BAD_PARAMETER("the interface of messages is message_intf, bound to a type");
    }
}

class Receiver : public End {
  public:
    Receiver(Instance& instance, const std::string& port, std::shared_ptr<DynamicPortElement> element)
        : End(instance, Role::receiver, port), element_(std::move(element)) {}

    /// A message for it; false if it cannot be transmitted.
    virtual bool take(const Message& message) = 0;

  protected:
    void deliver(const Bytes& bytes) const {
        Reader message(bytes);
        const Values arguments = message.values(element_->get_interface()->method(PUSH).arguments());
        message.end();
        element_->call(PUSH, arguments);
    }

  private:
    const std::shared_ptr<DynamicPortElement> element_;
};

/// Gets messages on a thread of its own, after push has returned.
class LaterReceiver final : public Receiver {
  public:
    LaterReceiver(Instance& instance, const std::string& port, std::shared_ptr<DynamicPortElement> element,
                  const Options& options)
        : Receiver(instance, port, std::move(element)),
          inbox_(Parts::inbox([this](const Bytes& message) { deliver(message); }, options)) {}

    bool take(const Message& message) override { return inbox_->put(message); }
    void started() override { inbox_->open(); }
    void stopping() override { inbox_->shut(); }
    void await_calls() override { inbox_->await_delivery(); }
    void left() override { inbox_->end(); }

  private:
    const std::unique_ptr<Inbox> inbox_;
};

/// Gets messages on the emitter's thread, before push returns.
class ImmediateReceiver final : public Receiver {
  public:
    ImmediateReceiver(Instance& instance, const std::string& port, std::shared_ptr<DynamicPortElement> element,
                      const Options& options)
        : Receiver(instance, port, std::move(element)), not_ready_(options.not_ready) {}

    bool take(const Message& message) override {
        const Admission::Call call(admission_);
        if (!call.admitted()) {
            return not_ready_ != Options::NotReady::error;
        }
        try {
            deliver(*message);
        } catch (...) {  // no concern of the emitter or of other receivers
        }
        return true;
    }

    void started() override { admission_.open(); }
    void shutting_down() override {
        admission_.shut();
        admission_.await_leaving();
    }
    void left() override { admission_.shut(); }

  private:
    const Options::NotReady not_ready_;
    Admission admission_;
};

/// Each message that an emitter pushes goes to each receiver.
class MessageConnector final : public ElementLink {
  public:
    /// BAD_PARAMETER if the interface is not message_intf.
    MessageConnector(std::shared_ptr<Shared> shared, InterfacePtr interface)
        : ElementLink(std::move(shared), std::move(interface)), receivers_(std::make_shared<const Receivers>()) {
        check_is_message_interface(*get_interface());
    }

    bool needs(const Instance&) const override { return false; }

  protected:
    bool has_role(Role role) const override { return role == Role::emitter || role == Role::receiver; }

    std::shared_ptr<End> make_sender(Instance& instance, const std::string& port,
                                     std::shared_ptr<PortElementObject>& element) override {
        element = std::make_shared<EmitterElement>(std::static_pointer_cast<MessageConnector>(shared_from_this()));
        return std::make_shared<End>(instance, Role::emitter, port);
    }

    std::shared_ptr<End> make_taker(Instance& instance, const std::string& port,
                                    const std::shared_ptr<DynamicPortElement>& element) override {
        const Options& options = shared_->platform.options;
        std::shared_ptr<Receiver> receiver;
        if (options.delivery == Options::Delivery::synchronous) {
            receiver = std::make_shared<ImmediateReceiver>(instance, port, element, options);
        } else {
            receiver = std::make_shared<LaterReceiver>(instance, port, element, options);
        }
        std::lock_guard<std::mutex> lock(mutex_);
        const auto more = std::make_shared<Receivers>(*receivers_);
        more->push_back(receiver);
        receivers_ = more;
        return receiver;
    }

    void forget(const End& end) override {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto fewer = std::make_shared<Receivers>();
        for (const std::shared_ptr<Receiver>& receiver : *receivers_) {
            if (receiver.get() != &end) {
                fewer->push_back(receiver);
            }
        }
        receivers_ = fewer;
    }

  private:
    typedef std::vector<std::shared_ptr<Receiver>> Receivers;

    /// What the emitter's required port element is connected to.
    class EmitterElement final : public DynamicPortElement {
      public:
        explicit EmitterElement(std::shared_ptr<MessageConnector> connector) : connector_(std::move(connector)) {}

        const InterfacePtr& get_interface() const override { return connector_->get_interface(); }

        Values call(const std::string& method, const Values& arguments) override {
            get_interface()->method(method);
            return {Value::enumerator(connector_->push(arguments))};
        }

      private:
        const std::shared_ptr<MessageConnector> connector_;
    };

    std::shared_ptr<const Receivers> receivers() const {
        std::lock_guard<std::mutex> lock(mutex_);
        return receivers_;
    }

    /// The return code.
    const char* push(const Values& arguments) {
        const Condition condition = transport_.condition();
        if (condition != Condition::sound) {
            return condition == Condition::connector_broken ? INTERNAL_ERROR : COMM_ERROR;
        }
        Writer writer;
        try {
            writer.values(get_interface()->method(PUSH).arguments(), arguments);
        } catch (const BAD_PARAMETER&) {
            return INTERNAL_ERROR;
        }
        const Message message = std::make_shared<const Bytes>(writer.take());
        bool all = true;
        for (const std::shared_ptr<Receiver>& receiver : *receivers()) {
            all = receiver->take(message) && all;
        }
        return all ? OK : COMM_ERROR;
    }

    mutable std::mutex mutex_;
    std::shared_ptr<const Receivers> receivers_;
};

}  // namespace

TypePtr comm_ecode_type() {
    return enumeration_type("comm_ecode", IntegerKind::BYTE, {{OK, 0}, {INTERNAL_ERROR, 1}, {COMM_ERROR, 2}});
}

InterfacePtr message_interface(const TypePtr& message_type) {
    return std::make_shared<const Interface>(std::vector<Method>{Method(
        PUSH, {{"message", Direction::in, message_type}, {"ecode", Direction::result, comm_ecode_type()}})});
}

std::shared_ptr<Link> make_message_connector(std::shared_ptr<Shared> shared, InterfacePtr interface) {
    return std::make_shared<MessageConnector>(std::move(shared), std::move(interface));
}

}  // namespace lwucm
