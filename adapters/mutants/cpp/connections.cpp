// Mutants of request-response and shared data (10.4).
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "registry.hpp"

namespace derived {

namespace {

using lwucm::Draft;
using lwucm::OpenRequest;
using lwucm::OpenRequests;
using lwucm::Value;
using lwucm::View;

typedef std::map<std::string, std::string> Readings;
typedef std::shared_ptr<OpenRequest> Request;

// request-response

class NumbersModuloTwo final : public OpenRequests {
  public:
    std::uint32_t open(const Request& request) override {
        std::lock_guard<std::mutex> lock(mutex_);
        last_ = last_ % 2 + 1;
        open_[last_] = request;
        return last_;
    }

  private:
    std::uint32_t last_ = 0;
};
const bool a = breaks<NumbersModuloTwo>("two_open_requests_have_one_number", {"R-10.4.1.2-12"}, "Two open requests have one number.",
                                        {"R-10.4.1.2-08", "R-10.4.1.2-09", "R-10.4.1.2-11", "R-10.4.1.2-13",
                                         "R-10.4.1.1-10", "R-10.4.1.2-10", "R-10.4.1.2-02", "R-10.4.1.2-03",
                                         "R-10.4.1.2-21", "R-10.4.1.2-07"},
                                        Readings{{"unknown-id", "observed"}});

class AnswersTheFirst final : public OpenRequests {
  public:
    Request answer(std::uint32_t number, const Value& response) override {
        return OpenRequests::answer(first_unless_unknown(number), response);
    }

  private:
    std::uint32_t first_unless_unknown(std::uint32_t number) {
        std::lock_guard<std::mutex> lock(mutex_);
        return open_.count(number) != 0 ? open_.begin()->first : number;
    }
};
const bool b = breaks<AnswersTheFirst>("answers_the_first_request", {"R-10.4.1.2-13"},
                                       "A response goes to the client that has waited longest.",
                                       {"R-10.4.1.2-03", "R-10.4.1.2-07", "R-10.4.1.2-11", "R-10.4.1.2-10"});

template <bool ToWaitingOnes>
class RepeatsResponses final : public OpenRequests {
  public:
    Request answer(std::uint32_t number, const Value& response) override {
        if (is_of_waiting_one(number) != ToWaitingOnes) {
            return OpenRequests::answer(number, response);
        }
        const Request answered = OpenRequests::answer(number, any_ ? first_ : response);
        if (answered && !any_) {
            first_ = response;
            any_ = true;
        }
        return answered;
    }

  private:
    bool is_of_waiting_one(std::uint32_t number) {
        std::lock_guard<std::mutex> lock(mutex_);
        const auto found = open_.find(number);
        return found != open_.end() && !found->second->callback;
    }

    Value first_;
    bool any_ = false;
};
const bool c = breaks<RepeatsResponses<true>>("repeats_the_first_result", {"R-10.4.1.2-03"},
                                              "All waiting clients of a connection get its first response.");
const bool p = breaks<RepeatsResponses<false>>("repeats_the_first_response", {"R-10.4.1.2-07"},
                                               "All clients that are called back get the first response of the connection.");

class TakesSecondAnswers final : public OpenRequests {
  public:
    Request answer(std::uint32_t number, const Value& response) override {
        const Request answered = OpenRequests::answer(number, response);
        if (!answered) {
            return answered_[number];
        }
        return answered_[number] = answered;
    }

  private:
    std::map<std::uint32_t, Request> answered_;
};
const bool d = breaks<TakesSecondAnswers>("passes_on_second_responses", {"R-10.4.1.2-17"},
                                          "A second response to a request is passed on.");

class TakesUnknownAnswers final : public OpenRequests {
  public:
    Request answer(std::uint32_t number, const Value& response) override {
        const Request answered = OpenRequests::answer(number, response);
        return answered ? answered : std::make_shared<OpenRequest>(nullptr, nullptr);
    }
};
const bool e = breaks<TakesUnknownAnswers>("takes_unknown_responses", {"R-10.4.1.2-16"},
                                           "A response to a request that is not open is taken.", {"R-10.4.1.2-17"},
                                           Readings{{"unknown-id", "refused"}});

class ForgetsTheThird final : public OpenRequests {
  public:
    std::uint32_t open(const Request& request) override {
        const std::uint32_t number = OpenRequests::open(request);
        if (request->callback && number % 3 == 0) {
            drop(number);
        }
        return number;
    }
};
const bool f = breaks<ForgetsTheThird>("forgets_each_third_request", {"R-10.4.1.2-07"},
                                       "Each third request of an asynchronous client has no response.",
                                       {"R-10.4.1.2-08", "R-10.4.1.2-09", "R-10.4.1.1-10"});

// shared data: writers

class CancelsNothing final : public Draft {
  public:
    bool cancel() override { return is_set(); }
};
const bool g = breaks<CancelsNothing>("cancels_no_data", {"R-10.4.2.2-18"}, "Cancelling data does nothing.",
                                      {"R-10.4.2.2-19", "R-10.4.2.2-03"});

class KeepsTheFirst final : public Draft {
  public:
    void write(const Value& value) override {
        if (!is_set()) {
            Draft::write(value);
        }
    }
};
const bool h = breaks<KeepsTheFirst>("keeps_the_first_data", {"R-10.4.2.2-16"}, "What is set again keeps its first value.",
                                     {"R-10.4.2-04", "R-10.4.2.2-17", "R-10.4.2.2-06", "R-10.4.2.2-12", "R-10.4.2-05",
                                      "R-10.4.2.2-09", "R-10.4.2.2-15", "R-10.4.2-01", "R-10.4-04", "R-10.4.2.2-08",
                                      "R-10.4.2-02", "R-10.4.2-06", "R-10.4.2-08"});

class SetsNoneAfterCancelling final : public Draft {
  public:
    void write(const Value& value) override {
        if (!is_cancelled_) {
            Draft::write(value);
        }
    }

    bool cancel() override {
        is_cancelled_ = true;
        return Draft::cancel();
    }

  private:
    bool is_cancelled_ = false;
};
const bool i = breaks<SetsNoneAfterCancelling>("sets_no_data_after_cancelling", {"R-10.4.2.1-22"},
                                               "Who has cancelled data cannot set any.",
                                               {"R-10.4.2.2-02", "R-10.4.2.2-06", "R-10.4.2.2-17", "R-10.4.2-04",
                                                "R-10.4.2.2-20"});

// shared data: readers

class FreezesNothing final : public View {
  public:
    using View::View;

    bool take(const Value& value) override {
        current_ = value;
        return true;
    }
};
const bool j = breaks<FreezesNothing>("freezes_no_data", {"R-10.4.2.2-09"}, "What a frozen reader reads changes.",
                                      {"R-10.4.2.2-13", "R-10.4.2.2-02", "R-10.4.2.2-03", "R-10.4.2.2-12"});

class FreezesOnce final : public View {
  public:
    using View::View;

    void freeze() override { depth_ = 1; }
};
const bool k = breaks<FreezesOnce>("freezes_data_once", {"R-10.4.2.2-09"}, "The first release ends all freezes.",
                                   {"R-10.4.2.2-13", "R-10.4.2.2-02", "R-10.4.2.1-22"});

class KeepsTheFirstMissed final : public View {
  public:
    using View::View;

    bool take(const Value& value) override { return has_missed_ ? false : View::take(value); }
};
const bool l = breaks<KeepsTheFirstMissed>("releases_to_the_first_missed_data", {"R-10.4.2.2-12"},
                                           "After a release a reader reads the first value that it has missed.",
                                           {"R-10.4.2-05"});

class CatchesUpNever final : public View {
  public:
    using View::View;

    bool catch_up() override {
        has_missed_ = false;
        return false;
    }
};
const bool m = breaks<CatchesUpNever>("misses_data_while_frozen", {"R-10.4.2.2-12"},
                                      "What is published while a reader is frozen never reaches it.",
                                      {"R-10.4.2.2-13", "R-10.4.2-05", "R-10.4.2-02", "R-10.4.2.2-02"});

class ReadsOnce final : public View {
  public:
    explicit ReadsOnce(const Value& at_first) : View(at_first), at_first_(at_first) {}

    Value read() override {
        const Value value = current_;
        current_ = at_first_;
        return value;
    }

  private:
    const Value at_first_;
};
const bool n = breaks<ReadsOnce>("forgets_data_that_was_read", {"R-10.4.2-06"}, "A value can be read once.",
                                 {"R-10.4.2.2-07", "R-10.4.2-08", "R-10.4.2-03", "R-10.4.2-02", "R-10.4.2.2-06",
                                  "R-10.4.2-05", "R-10.4.2.2-17", "R-10.4.2.2-12", "R-10.4.2-01", "R-10.4.2.2-09"});

class GoesBack final : public View {
  public:
    using View::View;

    bool take(const Value& value) override {
        previous_ = current_;
        has_previous_ = has_current_;
        has_current_ = true;
        return View::take(value);
    }

    Value read() override { return has_previous_ && ++reads_ % 2 == 0 ? previous_ : current_; }

  private:
    Value previous_;
    bool has_current_ = false;
    bool has_previous_ = false;
    int reads_ = 0;
};
const bool q = breaks<GoesBack>("reads_go_back", {"R-10.4.2.2-07"}, "Each second time the value before the current one is read.",
                                {"R-10.4.2.2-06", "R-10.4.2-05", "R-10.4.2.2-09", "R-10.4.2.2-12", "R-10.4.2.2-17"});

class CannotRelease final : public View {
  public:
    using View::View;

    bool release() override { return false; }
};
const bool o = breaks<CannotRelease>("cannot_release_data", {"R-10.4.2.2-12"}, "A frozen reader cannot be released.",
                                     {"R-10.4.2.2-01", "R-10.4.2.2-13", "R-10.4.2-05", "R-10.4.2-02", "R-10.4.2.1-22",
                                      "R-10.4.2.2-02"});

}  // namespace

}  // namespace derived
