#include "execution/interception.hpp"

#include <utility>

namespace lwucm {

namespace {

/// Stands before a port element that can be called by name.
class Intercepted final : public DynamicPortElement {
  public:
    Intercepted(std::shared_ptr<DynamicPortElement> target, std::shared_ptr<Interceptor> interceptor)
        : target_(std::move(target)), interceptor_(std::move(interceptor)) {}

    const InterfacePtr& get_interface() const override { return target_->get_interface(); }

    Values call(const std::string& method, const Values& arguments) override {
        Values results;
        interceptor_->call(method, [&] { results = target_->call(method, arguments); });
        return results;
    }

  private:
    const std::shared_ptr<DynamicPortElement> target_;
    const std::shared_ptr<Interceptor> interceptor_;
};

}  // namespace

PortTraces::PortTraces(std::vector<PortTrace> traces, componentId component, const Platform& platform)
    : traces_(std::move(traces)),
      component_("component " + std::to_string(component) + ": "),
      log_(platform.trace),
      records_(platform.options.port_trace) {}

void PortTraces::returned(const std::string& method) const {
    if (records_ == Options::PortTrace::call_and_return) {
        record("return of ", method);
    }
}

void PortTraces::record(const char* what, const std::string& method) const {
    for (const PortTrace& trace : traces_) {
        if (trace.methods.count(method) != 0) {
            const std::string text = component_ + what + method;
            log_->add(trace.severity, std::u32string(text.begin(), text.end()));
        }
    }
}

Interception::Interception(std::shared_ptr<const PortTraces> traces, std::shared_ptr<Guard> guard)
    : traces_(std::move(traces)), guard_(std::move(guard)) {}

void Interception::call(const std::string& method, const std::function<void()>& code) {
    if (traces_) {
        traces_->called(method);
    }
    if (guard_) {
        guard_->call(code);
    } else {
        code();
    }
    if (traces_) {
        traces_->returned(method);
    }
}

std::shared_ptr<PortElementObject> intercepted(const std::string& port,
                                               const std::shared_ptr<PortElementObject>& target,
                                               const std::shared_ptr<Interceptor>& interceptor,
                                               const Policies& generated) {
    if (const auto dynamic = std::dynamic_pointer_cast<DynamicPortElement>(target)) {
        return std::make_shared<Intercepted>(dynamic, interceptor);
    }
    if (!generated.intercept) {
        throw UCM_ERROR("nothing was generated to stand before a port element");
    }
    return generated.intercept(port, target, interceptor);
}

}  // namespace lwucm
