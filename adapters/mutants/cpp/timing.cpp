// Mutants of timers (10.3) and of components that are executed at times of their own (10.5).
#include <atomic>
#include <chrono>
#include <memory>
#include <utility>

#include "registry.hpp"

namespace derived {

namespace {

using lwucm::Pacing;
using lwucm::Timer;
using lwucm::Timers;
using std::chrono::milliseconds;

typedef std::vector<std::string> Requirements;

// policies of 10.5

const Requirements OF_RUNS = {"R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-03", "R-10.5.2-04", "R-10.5.2-21", "R-10.5.1-31"};
const Requirements OF_PERIODIC_CALLS = {"R-10.5.2-10", "R-10.5.2-11", "R-10.5.2-12", "R-10.5.2-21"};
const Requirements OF_SPORADIC_CALLS = {"R-10.5.2-15", "R-10.5.2-16", "R-10.5.2-17", "R-10.5.2-21"};

Pacing with_period(Pacing pacing, int numerator, int denominator) {
    pacing.period = pacing.period * numerator / denominator;
    return pacing;
}

Pacing without_offset(Pacing pacing) {
    pacing.offset = pacing.offset.zero();
    return pacing;
}

const bool a = [] {
    breaks_pacing("halves_periods_of_runs", {"R-10.5.2-03"}, "A periodic component runs twice a period.", OF_RUNS)
        .pacing_of_runs = [](Pacing pacing) { return with_period(pacing, 1, 2); };
    breaks_pacing("stretches_periods_of_runs", {"R-10.5.2-01"}, "The period of runs is a third longer.", OF_RUNS)
        .pacing_of_runs = [](Pacing pacing) { return with_period(pacing, 4, 3); };
    breaks_pacing("forgets_offsets_of_runs", {"R-10.5.1-28", "R-10.5.1-29"}, "Runs begin without an offset.",
                  {"R-10.5.2-03", "R-10.5.2-21"})
        .pacing_of_runs = without_offset;
    breaks_pacing("runs_in_the_background_for_ever", {"R-10.5.2-05"},
                  "A background component runs again each 80 milliseconds.", {"R-10.5.2-06", "R-10.5.2-21"})
        .pacing_of_runs = [](Pacing pacing) {
        if (pacing.kind == Pacing::Kind::background) {
            pacing.kind = Pacing::Kind::periodic;
            pacing.period = milliseconds(80);
        }
        return pacing;
    };
    breaks_pacing("runs_beside_calls", {"R-10.5.2-18"}, "A run and a call of one component meet.", OF_RUNS)
        .keeps_runs_apart = false;
    breaks_pacing("forgets_offsets_of_calls", {"R-10.5.1-30"}, "Periodic calls are executed without an offset.",
                  OF_PERIODIC_CALLS)
        .pacing_of_calls = without_offset;
    breaks_pacing("stretches_periods_of_calls", {"R-10.5.2-10"}, "The period of calls is twice as long.",
                  {"R-10.5.2-11", "R-10.5.2-12", "R-10.5.2-15", "R-10.5.2-16", "R-10.5.2-17", "R-10.5.2-21"})
        .pacing_of_calls = [](Pacing pacing) {
        return pacing.kind == Pacing::Kind::periodic ? with_period(pacing, 2, 1) : pacing;
    };
    breaks_pacing("halves_distances_of_calls", {"R-10.5.2-15"}, "The least distance of calls is half as long.",
                  OF_SPORADIC_CALLS)
        .pacing_of_calls = [](Pacing pacing) {
        return pacing.kind == Pacing::Kind::sporadic ? with_period(pacing, 1, 2) : pacing;
    };
    breaks_pacing("doubles_distances_of_calls", {"R-10.5.2-17"}, "The least distance of calls is twice as long.",
                  OF_SPORADIC_CALLS)
        .pacing_of_calls = [](Pacing pacing) {
        return pacing.kind == Pacing::Kind::sporadic ? with_period(pacing, 2, 1) : pacing;
    };
    breaks_pacing("executes_paced_calls_side_by_side", {"R-10.5.2-19"},
                  "Calls of an active component with a policy of 10.5 meet.", {"R-10.5.2-12", "R-10.5.2-17"})
        .keeps_calls_apart = false;
    return true;
}();

// timers

const Requirements OF_EXPIRY = {
    "R-10.3.1-18", "R-10.3.1-19", "R-10.3.1-20", "R-10.3.1-21", "R-10.3.1-22", "R-10.3.1-23", "R-10.3.1-26", "R-10.3.1-27",
    "R-10.3.1-30", "R-10.3.1-31", "R-10.3.1-32", "R-10.3.1-33", "R-10.3.1-34", "R-10.3.1-35", "R-10.3.1-36", "R-10.3.2-21",
    "R-10.3.2-22", "R-10.3.2-25", "R-10.3.2-26", "R-10.3.2-27", "R-10.3.2-28", "R-10.3.2-30", "R-10.3.2-31", "R-10.3.2-32",
    "R-10.3.2-33", "R-10.3.2-35", "R-10.3.2-36", "R-10.3.2-37", "R-10.3.2-38", "R-10.3.2-39", "R-10.3.2-40", "R-10.3.2-44",
    "R-10.3-04"};

class PassesTheGuard final : public Timers {
  public:
    explicit PassesTheGuard(const std::shared_ptr<lwucm::Guard>&) : Timers(nullptr) {}
};
const bool b = breaks<PassesTheGuard>("timers_pass_the_guard", {"R-10.3.2-43", "R-10.3.1-36"},
                                      "A timer calls back although its protected component is executed.",
                                      {"R-10.3.2-26", "R-10.3.2-44", "R-10.3.1-18"});

class CancelsNone final : public Timers {
  public:
    using Timers::Timers;

    void cancel(Name) override {}
};
const bool c = breaks<CancelsNone>("timers_are_not_cancelled", {"R-10.3.2-38", "R-10.3.1-31"}, "Cancelling does nothing.",
                                   {"R-10.3.2-22", "R-10.3.2-25", "R-10.3.2-26", "R-10.3.2-29", "R-10.3.2-33",
                                    "R-10.3.2-40", "R-10.3-04", "R-10.3.1-18", "R-10.3.1-20", "R-10.3.1-23",
                                    "R-10.3.1-30", "R-10.3.1-33"});

/// Shifts the first instant of each timer.
template <int Milliseconds>
class Shifts final : public Timers {
  public:
    using Timers::Timers;

    bool set(Name name, std::unique_ptr<Timer> timer) override {
        timer->due += milliseconds(Milliseconds);
        return Timers::set(name, std::move(timer));
    }
};
const bool d = breaks<Shifts<-20>>("timers_are_early", {"R-10.3.2-25", "R-10.3.1-19"}, "Timers expire 20 ms early.",
                                   OF_EXPIRY);
const bool e = breaks<Shifts<400>>("timers_are_late", {"R-10.3.2-26", "R-10.3.1-20"}, "Timers expire 400 ms late.",
                                   OF_EXPIRY);

class DropsTheNext final : public Timers {
  public:
    using Timers::Timers;

    bool set(Name name, std::unique_ptr<Timer> timer) override {
        return ++number_ % 3 == 0 || Timers::set(name, std::move(timer));
    }

  private:
    std::atomic<int> number_{0};
};
const bool f = breaks<DropsTheNext>("each_third_timer_is_lost", {"R-10.3.2-21", "R-10.3.1-18"},
                                    "Each third timer of a component never expires.", OF_EXPIRY);

}  // namespace

}  // namespace derived
