// What tests of lwucm by itself have in common: two interfaces, what would be generated for them, and applications.
#ifndef UCM_CTS_TESTS_LWUCM_APPLICATION_HPP
#define UCM_CTS_TESTS_LWUCM_APPLICATION_HPP

#include <lwucm/runtime.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>

namespace {

using namespace lwucm;

std::atomic<int> failures(0);

#define CHECK(condition) \
    ((condition) ? void() : (++failures, void(std::fprintf(stderr, "line %d: %s\n", __LINE__, #condition))))

/// Does `code` end with exactly this exception?
template <class Error>
bool raises(const std::function<void()>& code) {
    try {
        code();
    } catch (const Error&) {
        return true;
    } catch (...) {
    }
    return false;
}

// what a generator makes of an interface with method withdraw, which raises Overdrawn

const TypePtr LONGLONG = integer_type(IntegerKind::LONGLONG);
const TypePtr OVERDRAWN = structure_type("Overdrawn", {{"missing", LONGLONG}});
const InterfacePtr ACCOUNT = std::make_shared<const Interface>(std::vector<Method>{Method(
    "withdraw", {{"amount", Direction::in, LONGLONG}, {"left", Direction::result, LONGLONG}}, {OVERDRAWN})});
const InterfacePtr NEWS = message_interface(string8_type(8));

struct Overdrawn {
    std::int64_t missing;
};

/// A server's port element: methods by name become methods.
class AccountElement final : public DynamicPortElement {
  public:
    explicit AccountElement(std::function<std::int64_t(std::int64_t)> withdraw) : withdraw_(std::move(withdraw)) {}
    const InterfacePtr& get_interface() const override { return ACCOUNT; }
    Values call(const std::string&, const Values& arguments) override {
        try {
            return {Value::integer(withdraw_(arguments.at(0).as_integer()))};
        } catch (const Overdrawn& exception) {
            throw DeclaredException("Overdrawn", {Value::integer(exception.missing)});
        }
    }

  private:
    const std::function<std::int64_t(std::int64_t)> withdraw_;
};

/// A client's reference: methods become methods by name.
std::int64_t withdraw(DynamicPortElement& account, std::int64_t amount) {
    try {
        return account.call("withdraw", {Value::integer(amount)}).at(0).as_integer();
    } catch (const DeclaredException& exception) {
        throw Overdrawn{exception.fields.at(0).as_integer()};
    }
}

class NewsElement final : public DynamicPortElement {
  public:
    explicit NewsElement(std::function<void(const std::u32string&)> push) : push_(std::move(push)) {}
    const InterfacePtr& get_interface() const override { return NEWS; }
    Values call(const std::string&, const Values& arguments) override {
        push_(arguments.at(0).as_string());
        return {Value::enumerator("internal_error")};
    }

  private:
    const std::function<void(const std::u32string&)> push_;
};

std::string push(DynamicPortElement& news, const std::u32string& text) {
    return news.call("push", {Value::string(text)}).at(0).as_enumerator();
}

/// A component that keeps its references and does at its port elements what the test wants.
class Body final : public ComponentObject {
  public:
    void on_init() override {}
    void on_remove() override {}
    void on_startup(const PortConnections& dependencies) override {
        for (const PortConnection& dependency : dependencies) {
            references[dependency.from_port] = dependency.to_port.at(0);
        }
    }
    void on_shutdown() override { references.clear(); }
    std::shared_ptr<PortElementObject> get_portElement(const std::string& provided) override {
        if (provided == "account") {
            return std::make_shared<AccountElement>([this](std::int64_t amount) { return on_withdraw(amount); });
        }
        return std::make_shared<NewsElement>([this](const std::u32string& text) { on_push(text); });
    }

    DynamicPortElement& element(const std::string& port) {
        return dynamic_cast<DynamicPortElement&>(*references.at(port));
    }

    std::map<std::string, std::shared_ptr<PortElementObject>> references;
    std::function<std::int64_t(std::int64_t)> on_withdraw = [](std::int64_t amount) { return -amount; };
    std::function<void(const std::u32string&)> on_push = [](const std::u32string&) {};
};

/// A runtime in the making, with the bodies of its components in the order in which they were added.
struct Application {
    explicit Application(const std::string& options = "", const std::vector<Policy>& policies = {}) {
        const auto create = [this] {
            bodies.push_back(std::make_shared<Body>());
            return bodies.back();
        };
        const std::map<std::string, InterfacePtr> interfaces = {
            {"account", ACCOUNT}, {"bank", ACCOUNT}, {"news", NEWS}, {"editor", NEWS}};
        Policies applied;
        applied.applied = policies;
        Repository repository;
        repository.add({"Bank", {"account", "news"}, {}, {}, create, nullptr, applied, interfaces});
        repository.add({"Client", {}, {"bank"}, {}, create, nullptr, {}, interfaces});
        repository.add({"Author", {"account"}, {"editor"}, {}, create, nullptr, {}, interfaces});
        runtime = create_runtime(repository, parse_options(options));
    }
    ~Application() { runtime->destroy(); }

    componentId add(const std::string& implementation, const std::shared_ptr<Container>& container) {
        return container->add_component({{"implementation", implementation}});
    }
    componentId add(const std::string& implementation) { return add(implementation, runtime); }

    std::shared_ptr<Link> service() { return runtime->create_link(SIMPLE_SERVICE_CONNECTOR, ACCOUNT); }
    std::shared_ptr<Link> messages() { return runtime->create_link(SIMPLE_MESSAGE_CONNECTOR, NEWS); }

    std::vector<std::shared_ptr<Body>> bodies;
    std::shared_ptr<Runtime> runtime;
};

/// A gate: threads wait until it is opened.
class Gate {
  public:
    void pass() {
        std::unique_lock<std::mutex> lock(mutex_);
        ++arrived_;
        changed_.notify_all();
        changed_.wait(lock, [this] { return open_; });
    }
    void await(int count) {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this, count] { return arrived_ >= count; });
    }
    void open() {
        std::lock_guard<std::mutex> lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int arrived_ = 0;
    bool open_ = false;
};

}  // namespace

#endif
