// lwucm calls typed bodies by name that are generated from libraries.xml, and they call by name without knowing. Says nothing and exits
// with 0 if all is well.
#include <lwucm/runtime.hpp>

#include <cstdio>

#include "libraries_lwucm.hpp"

namespace {

using namespace lwucm;
using library_api::book_t;

int failures = 0;

#define CHECK(condition) \
    ((condition) ? void() : (++failures, void(std::fprintf(stderr, "line %d: %s\n", __LINE__, #condition))))

/// Does `code` throw `Exception`?
template <class Exception, class Code>
bool throws(Code code) {
    try {
        code();
    } catch (const Exception&) {
        return true;
    }
    return false;
}

const book_t& atlas() {
    static const book_t one(L"\u00fc\U0001f600", library_api::atlas, library_api::place_t(255, '\xfc'),
                            {{{{1, -2, 3}}, {{4, 5, -2147483647 - 1}}}}, {"", "torn"}, 0.1, 1.5f, L'\U0001f600', true);
    return one;
}

class Desk final : public library_api::Abstract_desk {
  public:
    void ring() override { ++rings; }

    bool lend(book_t& book, const std::string& reader, uint64_t& number) override {
        if (reader == "nobody") {
            throw library_api::closed();
        }
        if (reader == "late") {
            throw library_api::missing(book, -3);
        }
        received = book;
        book.title(L"lent");
        book.kind(library_api::novel);
        number = UINT64_MAX;
        return reader == "Ann";
    }

    int rings = 0;
    book_t received;
};

class Archive final : public library_api::Abstract_archive {
  public:
    int32_t size() override { return 1; }
};

class Scales final : public library_api::Abstract_scales {
  public:
    long double weigh() override { return 1; }
};

class Guide final : public library_api::Abstract_guide {
  public:
    void show(std::shared_ptr<library_api::Abstract_door>) override {}
};

class Shortlist final : public library_api::Abstract_shortlist {
  public:
    std::array<int32_t, 2> list() override { return {{1, 2}}; }
};

class Library final : public libraries::Abstract_Library_Impl {
  public:
    void on_init() override {}
    void on_startup() override {}
    void on_shutdown() override {}
    void on_remove() override {}
    std::shared_ptr<library_api::Abstract_desk> get_hall_desk() override { return desk; }
    std::shared_ptr<library_api::Abstract_archive> get_hall_archive() override { return std::make_shared<Archive>(); }
    std::shared_ptr<library_api::Abstract_scales> get_hall_scales() override { return std::make_shared<Scales>(); }
    std::shared_ptr<library_api::Abstract_guide> get_hall_guide() override { return std::make_shared<Guide>(); }
    std::shared_ptr<library_api::Abstract_shortlist> get_hall_shortlist() override { return std::make_shared<Shortlist>(); }

    const std::shared_ptr<Desk> desk = std::make_shared<Desk>();
};

class Reader final : public libraries::Abstract_Reader_Impl {
  public:
    void on_init() override {}
    void on_startup(const libraries::hall_desk_Connection& hall_desk, const libraries::Watch_clock_api_Connection& watch,
                    const libraries::Diary_trace_api_Connection& diary_api) override {
        desk = hall_desk.ref;
        clock = watch.ref;
        diary = diary_api.ref;
    }
    void on_shutdown() override {}
    void on_remove() override {}

    std::shared_ptr<library_api::Abstract_desk> desk;
    std::shared_ptr<library_api::Abstract_clock_service_intf> clock;
    std::shared_ptr<library_api::Abstract_trace_service_intf> diary;
};

const Policies SERVICES({{"clock", "", {}, "Watch_clock_api", {}}, {"component_trace", "", {}, "Diary_trace_api", {}}}, nullptr,
                        nullptr);

/// A library and a reader on a service connector.
struct Town {
    explicit Town(const std::vector<Policy>& of_library = {}) {
        Policies policies;
        policies.applied = of_library;
        Repository repository;
        repository.add(typed_implementation<libraries::Abstract_Library_Impl>("Library", [this] { return lender; }, policies,
                                                                              {"hall_desk"}));
        repository.add(typed_implementation<libraries::Abstract_Reader_Impl>("Reader", [this] { return reader; }, SERVICES,
                                                                             {"hall_desk"}));
        runtime = create_runtime(repository);
        a_library = runtime->add_component({{"implementation", "Library"}});
        a_reader = runtime->add_component({{"implementation", "Reader"}});
        link = runtime->create_link(SIMPLE_SERVICE_CONNECTOR, interfaces_of<libraries::Abstract_Reader_Impl>().at("hall_desk"));
        link->attach(Role::server, runtime, a_library, "hall_desk");
        link->attach(Role::client, runtime, a_reader, "hall_desk");
        runtime->start();
    }
    ~Town() { runtime->destroy(); }

    const std::shared_ptr<Library> lender = std::make_shared<Library>();
    const std::shared_ptr<Reader> reader = std::make_shared<Reader>();
    std::shared_ptr<Runtime> runtime;
    std::shared_ptr<Link> link;
    componentId a_library = 0, a_reader = 0;
};

void check_calls(const Town& town) {
    library_api::Abstract_desk& desk = *town.reader->desk;
    CHECK(town.reader->desk != town.lender->desk);
    book_t book = atlas();
    uint64_t number = 0;
    CHECK(desk.lend(book, "Ann", number));
    CHECK(town.lender->desk->received == atlas());
    CHECK(book.title() == L"lent");
    CHECK(book.kind() == library_api::novel);
    CHECK(book.marks() == atlas().marks());
    CHECK(number == UINT64_MAX);
    CHECK(!desk.lend(book, "Bob", number));
    desk.ring();
    CHECK(town.lender->desk->rings == 1);
    CHECK(throws<library_api::closed>([&] { desk.lend(book, "nobody", number); }));
    book = atlas();
    try {
        desk.lend(book, "late", number);
        CHECK(!"missing was raised");
    } catch (const library_api::missing& exception) {
        CHECK(exception.book() == atlas());
        CHECK(exception.days() == -3);
    }
    book.title(std::wstring(41, L'x'));
    CHECK(throws<BAD_PARAMETER>([&] { desk.lend(book, "Ann", number); }));  // the model says 40
}

void links_carry_typed_calls() {
    const Town town;
    check_calls(town);
    const Town guarded({{"protected_passive_component", "", {}, "", {}}});
    check_calls(guarded);
}

void services_come_typed() {
    const Town town;
    library_api::ucm_timeval_t first, second;
    town.reader->clock->get_local_time(first);
    town.reader->clock->get_local_time(second);
    CHECK(first.utv_sec() != 0 || first.utv_usec() != 0);
    CHECK(second.utv_sec() - first.utv_sec() < 10);
    town.reader->diary->log(library_api::info, L"\u00fc");
    const auto records = town.runtime->trace_records();
    CHECK(records.size() == 1);
    CHECK(records.at(0).severity == log_severity_t::info);
    CHECK(records.at(0).message == U"\u00fc");
}

void one_port_element_is_one_object() {
    const Town town;
    const auto element = town.runtime->get_port_element(town.a_library, "hall_desk");
    CHECK(element == town.runtime->get_port_element(town.a_library, "hall_desk"));
    DynamicPortElement& desk = dynamic_cast<DynamicPortElement&>(*element);
    CHECK(desk.call("ring", {}).empty());
    CHECK(throws<BAD_PARAMETER>([&] { desk.call("ring", {Value::boolean(true)}); }));
    CHECK(throws<BAD_PARAMETER>([&] { desk.call("knock", {}); }));
    CHECK(throws<BAD_PARAMETER>([&] { desk.call("lend", {Value::list(), Value::string(U"Ann")}); }));
    CHECK(!std::dynamic_pointer_cast<DynamicPortElement>(town.runtime->get_port_element(town.a_library, "hall_archive")));
}

void values_outside_their_types_are_refused() {
    typedef TypedValue<library_api::place_t> Places;
    CHECK(Places::from(Value::list({Value::integer(7), Value::character('x')})) == library_api::place_t(7, 'x'));
    for (const Value& wrong : {Value::integer(256), Value::integer(-1), Value::boolean(true)}) {
        CHECK(throws<BAD_PARAMETER>([&] { Places::from(Value::list({wrong, Value::character('x')})); }));
    }
    CHECK(throws<BAD_PARAMETER>([] { Places::from(Value::list({Value::integer(1), Value::character(256)})); }));
    CHECK(throws<BAD_PARAMETER>([] { Places::from(Value::list({Value::integer(1)})); }));
    CHECK(throws<BAD_PARAMETER>([] { TypedValue<library_api::kind_t>::from(Value::enumerator("map")); }));
    CHECK(throws<BAD_PARAMETER>([] { TypedValue<library_api::kind_t>::to(static_cast<library_api::kind_t>(4)); }));
    CHECK(throws<BAD_PARAMETER>([] { TypedValue<std::array<int32_t, 2>>::from(Value::list({Value::integer(1)})); }));
    CHECK(throws<BAD_PARAMETER>([] { TypedValue<int32_t>::from(Value::integer(INT64_C(2147483648))); }));
}

void what_cannot_be_called_by_name_is_no_end_of_links() {
    for (const char* const port : {"hall_archive", "hall_scales", "hall_guide", "hall_shortlist", "hall_attic"}) {
        CHECK(throws<BAD_PARAMETER>([port] {
            typed_implementation<libraries::Abstract_Library_Impl>("Library", [] { return nullptr; }, Policies(), {port});
        }));
    }
    CHECK(interfaces_of<libraries::Abstract_Library_Impl>().size() == 1);
}

/// Runs one of the checks above; none of them lets an exception out.
void run(void (*check)(), int line) {
    try {
        check();
    } catch (const std::exception& exception) {
        ++failures;
        std::fprintf(stderr, "line %d: %s\n", line, exception.what());
    }
}

}  // namespace

int main() {
    run(links_carry_typed_calls, __LINE__);
    run(services_come_typed, __LINE__);
    run(one_port_element_is_one_object, __LINE__);
    run(values_outside_their_types_are_refused, __LINE__);
    run(what_cannot_be_called_by_name_is_no_end_of_links, __LINE__);
    return failures == 0 ? 0 : 1;
}
