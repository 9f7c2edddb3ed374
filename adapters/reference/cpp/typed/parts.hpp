// The probes with what 10.3 to 10.5 give to components, written against what is generated from parts.xml.
#ifndef REFERENCE_CPP_TYPED_PARTS_HPP
#define REFERENCE_CPP_TYPED_PARTS_HPP

#include <algorithm>
#include <memory>
#include <string>

#include "../object_timers.hpp"
#include "probes.hpp"

namespace reference_cpp {

typedef ::core::timer::itt_timer::ucm_itt::Abstract_itt_callback_intf TimerCallback;
typedef ::core::component_execution_policies::execution_policies_api::Abstract_component_execution_intf TypedExecution;

/// What getters return, without what makes it shared.
template <class Getter>
using Returned = typename ucm_cts::detail::Result<Getter>::element_type;

/// The interfaces of object timers as they are generated.
struct TypedTimers {
    typedef ::core::timer::ott_timer::ucm_ott::Abstract_ott_scheduler Scheduler;
    typedef ::core::timer::ott_timer::ucm_ott::Abstract_ott_timer Timer;
    typedef ::core::timer::ott_timer::ucm_ott::Abstract_ott_handler Handler;
    typedef ::core::container_services::clock_service::clock_api::ucm_timeval_t Time;
    static ucm_cts::TimeValue value(const Time& time) { return {time.utv_sec(), time.utv_usec()}; }
};

template <>
struct Given<TypedTimers::Scheduler> {
    static ucm_cts::Reference wrap(const std::shared_ptr<TypedTimers::Scheduler>& typed) {
        return typed ? std::make_shared<WrappedScheduler<TypedTimers>>(typed) : nullptr;
    }
};

/// A probe that requires one port element, whichever it is.
template <class Probe>
class Requires : public Probe {
    typedef decltype(&Probe::Abstract::on_startup) Startup;

  public:
    using Probe::Probe;
    void on_startup(ucm_cts::detail::Argument<Startup, 0> given) override { this->core.start(given); }
};

/// A probe with a second provided port element, which links call and which `Getter` gives.
template <class Probe, class Getter>
class CalledByLinks : public Probe {
  public:
    explicit CalledByLinks(const Shaped& from) : Probe(from), element(this->core.template called_by_links<Interface>(1)) {}

  protected:
    typedef Returned<Getter> Interface;

    const std::shared_ptr<Interface> element;
};

/// A server of synchronous clients, with `ask.server_p`.
template <class Probe>
class ProvidesAnswer : public CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_server_p)> {
    typedef CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_server_p)> Base;

  public:
    using Base::Base;
    std::shared_ptr<typename Base::Interface> get_ask_server_p() override { return this->element; }
};

/// A client that is called back, with `ask.client_resp_p`.
template <class Probe>
class ProvidesResponse : public CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_client_resp_p)> {
    typedef CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_client_resp_p)> Base;

  public:
    using Base::Base;
    std::shared_ptr<typename Base::Interface> get_ask_client_resp_p() override { return this->element; }
};

/// A server that answers by a call, with `ask.server_req_p`.
template <class Probe>
class ProvidesRequest : public CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_server_req_p)> {
    typedef CalledByLinks<Probe, decltype(&Probe::Abstract::get_ask_server_req_p)> Base;

  public:
    using Base::Base;
    std::shared_ptr<typename Base::Interface> get_ask_server_req_p() override { return this->element; }
};

/// A reader of shared data, with `get.notification_p`.
template <class Probe>
class ProvidesNotification : public CalledByLinks<Probe, decltype(&Probe::Abstract::get_get_notification_p)> {
    typedef CalledByLinks<Probe, decltype(&Probe::Abstract::get_get_notification_p)> Base;

  public:
    using Base::Base;
    std::shared_ptr<typename Base::Interface> get_get_notification_p() override { return this->element; }
};

/// A probe with index timers, which it is called back by.
template <class Probe>
class CalledBack : public Probe {
  public:
    explicit CalledBack(const Shaped& from)
        : Probe(from),
          callback_(lwucm::TypedReference<TimerCallback>::to(
              Lwucm::typed(this->core.body->get_policy_port(ucm_cts::INDEX_TIMERS, ucm_cts::TIMER_CALLBACK),
                           ucm_cts::timer_callback_interface()))) {}
    std::shared_ptr<TimerCallback> get_tp_itt_timer_timer_callback() override { return callback_; }

  private:
    const std::shared_ptr<TimerCallback> callback_;
};

/// A probe that executes itself, by whichever policy.
template <class Probe>
class Runs : public Probe {
  public:
    explicit Runs(const Shaped& from) : Probe(from), policy_(self_execution_of(from)) {}

    std::shared_ptr<TypedExecution> get_tp_self_executing_self_execution_api() override {
        const auto execution = this->core.body->get_policy_element(policy_, ucm_cts::SELF_EXECUTION_API);
        return execution ? std::make_shared<ucm_cts::ShapedExecution<TypedExecution>>(execution) : nullptr;
    }

  private:
    static std::string self_execution_of(const Shaped& from) {
        const auto found = std::find_if(from.policies.begin(), from.policies.end(), [](const ucm_cts::Policy& one) {
            return ucm_cts::is_self_executing(one.definition);
        });
        return found != from.policies.end() ? found->definition : "";
    }

    const std::string policy_;
};

typedef ProvidesOne<Requires<TypedProbe< ::parts::Abstract_asker_body>>> Asker;
typedef ProvidesResponse<ProvidesOne<Requires<TypedProbe< ::parts::Abstract_later_asker_body>>>> LaterAsker;
typedef ProvidesAnswer<ProvidesOne<RequiresNothing<TypedProbe< ::parts::Abstract_answerer_body>>>> Answerer;
typedef ProvidesRequest<ProvidesOne<Requires<TypedProbe< ::parts::Abstract_later_answerer_body>>>> LaterAnswerer;
typedef ProvidesOne<Requires<TypedProbe< ::parts::Abstract_setter_body>>> Setter;
typedef ProvidesNotification<ProvidesOne<Requires<TypedProbe< ::parts::Abstract_getter_body>>>> Getter;
typedef CalledBack<ProvidesTwo<Requires<TypedProbe< ::parts::Abstract_counting_body>>>> Counting;
typedef ProvidesTwo<Requires<TypedProbe< ::parts::Abstract_scheduling_body>>> Scheduling;
typedef Runs<ProvidesTwo<RequiresNothing<TypedProbe< ::parts::Abstract_running_body>>>> Running;

}  // namespace reference_cpp

#endif
