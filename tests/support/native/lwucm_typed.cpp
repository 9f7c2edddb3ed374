// lwucm hosts typed bodies that are generated from schools.xml. Says nothing and exits with 0 if all is well.
#include <lwucm/runtime.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>

#include "schools_lwucm.hpp"

namespace {

using namespace lwucm;

int failures = 0;

#define CHECK(condition) \
    ((condition) ? void() : (++failures, void(std::fprintf(stderr, "line %d: %s\n", __LINE__, #condition))))

/// Is this UCM_ERROR?
template <class Code>
bool refused(Code code) {
    try {
        code();
    } catch (const UCM_ERROR&) {
        return true;
    }
    return false;
}

std::vector<std::string> told;  // what bodies were told, in order

class Lesson final : public school_api::Abstract_lesson {
  public:
    explicit Lesson(std::string title) : title_(std::move(title)) {}

    std::string mood() override { return mood_; }
    void mood(const std::string& value) override { mood_ = value; }

    std::string greet(const std::string& name) override {
        if (name.empty()) {
            throw school_api::asleep(title_);
        }
        return name + " is in " + title_;
    }

    std::int32_t learn(std::int32_t result, school_api::texts_t& lines, std::string& last) override {
        last = lines.back();
        lines.push_back(title_);
        return result + 1;
    }

    void end() override { told.push_back("end of " + title_); }

  private:
    const std::string title_;
    std::string mood_ = "calm";
};

class Break final : public school_api::Abstract_break_intf {
  public:
    void run() override { ++runs; }
    std::atomic<int> runs{0};
};

class Pupil : public schools::Abstract_Pupil_Impl {
  public:
    void on_init() override { told.push_back(nick_ + " comes"); }
    void on_startup(const schools::main_api_Connection& main_api,
                    const schools::extra_api_Connection& extra_api) override {
        names = {main_api.port_name, extra_api.port_name};
        main = main_api.ref;
        extra = extra_api.ref;
    }
    void on_shutdown() override { main = extra = nullptr; }
    void on_remove() override { told.push_back(nick_ + " goes"); }

    std::string nick() override { return nick_; }
    void nick(const std::string& value) override { nick_ = value; }
    std::uint8_t age() override { return age_; }
    void age(std::uint8_t value) override { age_ = value; }
    std::int32_t number() override { return 1; }
    std::int32_t debts() override { return debts_; }
    void debts(std::int32_t value) override { debts_ = value; }
    std::uint64_t hairs() override { return hairs_; }
    void hairs(std::uint64_t value) override { hairs_ = value; }
    double weight() override { return weight_; }
    void weight(double value) override { weight_ = value; }
    bool keen() override { return keen_; }
    void keen(bool value) override { keen_ = value; }
    char mark() override { return mark_; }
    void mark(char value) override { mark_ = value; }
    school_api::texts_t books() override { return {}; }
    void books(const school_api::texts_t&) override {}
    std::shared_ptr<school_api::Abstract_greeting> get_main_hello() override { return hello; }
    std::shared_ptr<school_api::Abstract_greeting> get_extra_hello() override { return other; }
    std::shared_ptr<school_api::Abstract_break_intf> get_tp_Breaks_self_execution_api() override { return breaks; }

    const std::shared_ptr<Lesson> hello = std::make_shared<Lesson>("main");
    const std::shared_ptr<Lesson> other = std::make_shared<Lesson>("extra");
    const std::shared_ptr<Break> breaks = std::make_shared<Break>();
    std::vector<std::string> names;
    std::shared_ptr<school_api::Abstract_lesson> main, extra;

  private:
    std::string nick_;
    std::uint8_t age_ = 0;
    std::int32_t debts_ = 0;
    std::uint64_t hairs_ = 0;
    double weight_ = 0;
    bool keen_ = false;
    char mark_ = ' ';
};

/// The typed way to be a fragment that hears of each connection.
class Head final : public schools::Abstract_Head_Impl, public Connectable, public FragmentObject {
  public:
    void on_init() override { CHECK(container); }
    void on_startup(const schools::class_hello_Connection& class_hello,
                    const schools::office_hello_Connection& office_hello) override {
        answers = {class_hello.ref->greet("head"), office_hello.ref->greet("head")};
    }
    void on_shutdown() override {}
    void on_remove() override { container = nullptr; }
    std::shared_ptr<school_api::Abstract_lesson> get_class_api() override { return lesson; }
    std::shared_ptr<school_api::Abstract_lesson> get_office_api() override { return office; }

    void on_connect(const std::string& port_name, std::shared_ptr<PortElementObject>) override {
        told.push_back("+" + port_name);
    }
    void on_disconnect(const std::string& port_name) override { told.push_back("-" + port_name); }
    void set_container_interface(std::shared_ptr<Container> given) override { container = given; }

    const std::shared_ptr<Lesson> lesson = std::make_shared<Lesson>("class");
    const std::shared_ptr<Lesson> office = std::make_shared<Lesson>("office");
    std::shared_ptr<Container> container;
    std::vector<std::string> answers;
};

class Warden final : public schools::Abstract_Warden_Impl {
  public:
    void on_init() override {}
    void on_startup(const schools::Bell_clock_api_Connection& Bell_clock_api) override { CHECK(!Bell_clock_api.ref); }
    void on_shutdown() override {}
    void on_remove() override {}
};

/// A runtime with one pupil and one head, each connected to the other.
struct School {
    explicit School(const std::vector<Policy>& of_pupils = {}, const std::vector<Policy>& of_heads = {}) {
        told.clear();
        Policies pupils, heads;
        pupils.applied = of_pupils;
        heads.applied = of_heads;
        Repository repository;
        repository.add(typed_implementation<schools::Abstract_Pupil_Impl>("Pupil", [this] { return pupil; }, pupils));
        repository.add(typed_implementation<schools::Abstract_Head_Impl>("Head", [this] { return head; }, heads));
        repository.add(typed_implementation<schools::Abstract_Warden_Impl>("Warden", [] { return std::make_shared<Warden>(); }));
        repository.add(typed_implementation<schools::Abstract_Warden_Impl>("Nobody", [] { return nullptr; }));
        runtime = create_runtime(repository);
    }
    ~School() {
        try {
            runtime->destroy();
        } catch (const UCM_ERROR&) {  // a test has done so
        }
    }

    void open(const Properties& configuration = {{"implementation", "Pupil"}}) {
        a_pupil = runtime->add_component(configuration);
        a_head = runtime->add_component({{"implementation", "Head"}});
        connect(a_pupil, "main_api", a_head, "class_api");
        connect(a_pupil, "extra_api", a_head, "office_api");
        connect(a_head, "class_hello", a_pupil, "main_hello");
        connect(a_head, "office_hello", a_pupil, "extra_hello");
        runtime->start();
    }

    void connect(componentId client, const std::string& required, componentId server, const std::string& provided) {
        runtime->connect(client, required, runtime->get_port_element(server, provided));
    }

    const std::shared_ptr<Pupil> pupil = std::make_shared<Pupil>();
    const std::shared_ptr<Head> head = std::make_shared<Head>();
    std::shared_ptr<Runtime> runtime;
    componentId a_pupil = 0, a_head = 0;
};

void bodies_are_connected_by_their_types() {
    School school;
    school.open({{"implementation", "Pupil"}, {"nick", "Ann"}});
    CHECK(school.pupil->main == school.head->lesson);
    CHECK(school.pupil->extra == school.head->office);
    CHECK((school.pupil->names == std::vector<std::string>{"main_api", "extra_api"}));
    CHECK((school.head->answers == std::vector<std::string>{"head is in main", "head is in extra"}));
    school.runtime->stop();
    CHECK(!school.pupil->main);
    school.runtime->destroy();
    CHECK(told.size() == 6);
    CHECK((std::vector<std::string>(told.begin(), told.begin() + 3) ==
           std::vector<std::string>{"Ann comes", "+class_hello", "+office_hello"}));
    CHECK(std::count(told.begin(), told.end(), "-class_hello") == 1);
    CHECK(std::count(told.begin(), told.end(), "Ann goes") == 1);
    CHECK(!school.head->container);
}

void attributes_are_configured() {
    School school;
    school.open({{"implementation", "Pupil"},
                 {"nick", "a b"},
                 {"age", "255"},
                 {"debts", "-2147483648"},
                 {"hairs", "18446744073709551615"},
                 {"weight", "0.5"},
                 {"keen", "true"},
                 {"mark", "1"}});
    Pupil& pupil = *school.pupil;
    CHECK(pupil.nick() == "a b");
    CHECK(pupil.age() == 255);
    CHECK(pupil.debts() == -2147483647 - 1);
    CHECK(pupil.hairs() == UINT64_MAX);
    CHECK(pupil.weight() == 0.5);
    CHECK(pupil.keen());
    CHECK(pupil.mark() == '1');
    const Properties wrong = {{"age", "256"},  {"age", "-1"},   {"age", ""},     {"debts", "1.5"}, {"debts", " 1"},
                              {"hairs", "-1"}, {"keen", "yes"}, {"mark", "12"},  {"number", "1"},  {"books", "x"},
                              {"debts", "2147483648"}};
    for (const Property& one : wrong) {
        School other;
        CHECK(refused([&] { other.runtime->add_component({{"implementation", "Pupil"}, one}); }));
    }
}

void what_stands_between_has_the_same_interface() {
    School school({}, {{"protected_active_component", "class_api", {}, "", {}}});
    school.open();
    school_api::Abstract_lesson& lesson = *school.pupil->main;
    CHECK(school.pupil->main != school.head->lesson);
    CHECK(lesson.mood() == "calm");
    lesson.mood("wild");
    CHECK(school.head->lesson->mood() == "wild");
    school_api::texts_t lines = {"a", "b"};
    std::string last;
    CHECK(lesson.learn(6, lines, last) == 7);
    CHECK((lines == school_api::texts_t{"a", "b", "class"}));
    CHECK(last == "b");
    lesson.end();
    CHECK(told.back() == "end of class");
    try {
        lesson.greet("");
        CHECK(!"asleep was raised");
    } catch (const school_api::asleep& exception) {
        CHECK(exception.why() == "class");
    }
}

void only_traced_port_elements_have_a_stand_in() {
    School school({{"port_trace", "main_api", {{"methods_to_trace", "end"}, {"log_severity", "info"}}, "", {}}});
    school.open();
    CHECK(school.pupil->main != school.head->lesson);
    CHECK(school.pupil->extra == school.head->office);
    school.pupil->main->end();
    school.pupil->extra->end();
    CHECK(school.runtime->trace_records().size() == 1);

    School guarded({{"protected_passive_component", "", {}, "", {}}});
    guarded.open();
    const auto hello = guarded.runtime->get_port_element(guarded.a_pupil, "main_hello");
    CHECK(std::dynamic_pointer_cast<school_api::Abstract_greeting>(hello));
    CHECK(!std::dynamic_pointer_cast<school_api::Abstract_lesson>(hello));  // the object is one, the port element is not
}

void components_execute_themselves() {
    School school({{"protected_self-executing_component", "", {}, "", {}}});
    school.open();
    while (school.pupil->breaks->runs < 3) {
    }
    school.runtime->stop();
    const int runs = school.pupil->breaks->runs;
    school.runtime->start();
    while (school.pupil->breaks->runs == runs) {
    }
}

void what_does_not_fit_is_refused() {
    School school;
    const componentId pupil = school.runtime->add_component({{"implementation", "Pupil"}});
    const componentId head = school.runtime->add_component({{"implementation", "Head"}});
    school.connect(pupil, "main_api", head, "class_api");
    school.connect(pupil, "extra_api", head, "office_api");
    school.connect(head, "class_hello", pupil, "main_hello");
    school.connect(head, "office_hello", pupil, "extra_hello");
    bool found = true;
    try {
        school.runtime->get_port_element(head, "class_hello");
    } catch (const NOT_FOUND&) {
        found = false;
    }
    CHECK(!found);
    CHECK(refused([&] { school.runtime->add_component({{"implementation", "Nobody"}}); }));
    school.runtime->add_component({{"implementation", "Warden"}});
    school.runtime->start();  // a warden that was promised no clock has none

    School executing({}, {{"protected_self-executing_component", "", {}, "", {}}});
    CHECK(refused([&] { executing.runtime->add_component({{"implementation", "Head"}}); }));
    School timed({}, {{"itt_timer", "", {}, "timers", {}}});
    CHECK(refused([&] { timed.runtime->add_component({{"implementation", "Head"}}); }));

    class Foreign final : public PortElementObject {};
    School strange;
    const componentId other = strange.runtime->add_component({{"implementation", "Pupil"}});
    strange.runtime->connect(other, "main_api", std::make_shared<Foreign>());
    strange.runtime->connect(other, "extra_api", std::make_shared<Lesson>("extra"));
    CHECK(refused([&] { strange.runtime->start(); }));
}

}  // namespace

int main() {
    bodies_are_connected_by_their_types();
    attributes_are_configured();
    what_stands_between_has_the_same_interface();
    only_traced_port_elements_have_a_stand_in();
    components_execute_themselves();
    what_does_not_fit_is_refused();
    return failures == 0 ? 0 : 1;
}
