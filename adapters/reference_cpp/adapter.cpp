// Binds the C++ reference framework: the only file that knows both it and the SDK.
#include <lwucm/runtime.hpp>
#include <ucm_cts/main.hpp>
#include <ucm_cts/shaped.hpp>

struct Lwucm {
    typedef lwucm::PortElementObject PortElementObject;
    typedef lwucm::ComponentObject ComponentObject;
    typedef lwucm::FragmentObject FragmentObject;
    typedef lwucm::Connectable Connectable;
    typedef lwucm::Container Container;
    typedef lwucm::ContainerManager ContainerManager;
    typedef lwucm::component_execution_intf ComponentExecution;
    typedef lwucm::NOT_FOUND NOT_FOUND;
    typedef lwucm::BAD_PARAMETER BAD_PARAMETER;
    typedef lwucm::UCM_ERROR UCM_ERROR;

    static std::shared_ptr<ContainerManager> create_runtime(
        const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations);

    static lwucm::Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        return ucm_cts::properties<lwucm::Properties>("implementation", implementation, attributes);
    }
};

// What a code generator would make of the probes' interface, to stand before port elements of protected components.
class GuardedExchange final : public ucm_cts::ShapedExchange<Lwucm> {
    typedef ucm_cts::ShapedExchange<Lwucm> Exchange;

  public:
    GuardedExchange(const std::shared_ptr<lwucm::PortElementObject>& target, std::shared_ptr<lwucm::Guard> guard)
        : target_(std::dynamic_pointer_cast<Exchange>(target)), guard_(std::move(guard)) {}

    std::int32_t exchange(std::int32_t value) override {
        std::int32_t result = 0;
        guard_->call([&] { result = target_->exchange(value); });
        return result;
    }

    static std::shared_ptr<lwucm::PortElementObject> make(const std::shared_ptr<lwucm::PortElementObject>& target,
                                                          const std::shared_ptr<lwucm::Guard>& guard) {
        return std::make_shared<GuardedExchange>(target, guard);
    }

  private:
    const std::shared_ptr<Exchange> target_;
    const std::shared_ptr<lwucm::Guard> guard_;
};

inline std::shared_ptr<lwucm::ContainerManager> Lwucm::create_runtime(
    const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations) {
    lwucm::Repository repository;
    for (const auto& one : implementations) {
        lwucm::Policies policies = {{}, one.get_policy_element, GuardedExchange::make};
        for (const ucm_cts::Policy& policy : one.policies) {
            policies.applied.push_back({policy.definition, policy.port, policy.parameters});
        }
        repository.add(
            {one.name, one.provided, one.required, one.attributes, one.create, one.set_attribute, policies});
    }
    return lwucm::create_runtime(repository);
}

UCM_CTS_ADAPTER(ucm_cts::ShapedAdapter<Lwucm>, "lwucm reference framework (C++)", "0.1.0");
