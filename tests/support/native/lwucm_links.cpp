// What the suite cannot see of lwucm's links, services and timers: how they refuse, what waits and what ends it, and how code
// that was generated for an interface is bound to them. Says nothing and exits with 0 if all is well.
#include "lwucm_application.hpp"
#include "lwucm_object_timers.hpp"
#include "lwucm_timers.hpp"

#include <atomic>
#include <future>
#include <thread>

namespace {

void types_that_are_none_are_refused() {
    const TypePtr colour = enumeration_type("colour", IntegerKind::BYTE, {{"red", -128}, {"green", 127}});
    CHECK(raises<BAD_PARAMETER>([] { enumeration_type("e", IntegerKind::UBYTE, {{"a", 256}}); }));
    CHECK(raises<BAD_PARAMETER>([] { enumeration_type("e", IntegerKind::UBYTE, {{"a", 1}, {"b", 1}}); }));
    CHECK(raises<BAD_PARAMETER>([] { structure_type("s", {{"a", LONGLONG}, {"a", LONGLONG}}); }));
    CHECK(raises<BAD_PARAMETER>([] { union_type("u", LONGLONG, {}); }));
    CHECK(raises<BAD_PARAMETER>([&] { union_type("u", colour, {{"a", LONGLONG, {"blue"}, false}}); }));
    CHECK(raises<BAD_PARAMETER>([] { array_type(LONGLONG, {}); }));
    CHECK(raises<BAD_PARAMETER>([] { sequence_type(LONGLONG, -2); }));
    CHECK(raises<BAD_PARAMETER>([] { Interface({Method("m", {}), Method("m", {{"a", Direction::in, LONGLONG}})}); }));
    CHECK(raises<BAD_PARAMETER>([] { parse_options("ids=unique"); }));
    CHECK(raises<BAD_PARAMETER>([] { parse_options("ids"); }));
    CHECK(parse_options("inbox=7,ids=reused").inbox == 7);
}

void only_fitting_ends_are_attached() {
    Application application;
    const componentId bank = application.add("Bank");
    const componentId other = application.add("Bank");
    const componentId client = application.add("Client");
    const auto service = application.service();
    const auto root = application.runtime;
    CHECK(raises<BAD_PARAMETER>([&] { root->create_link("simple_service_connector", nullptr); }));
    CHECK(raises<BAD_PARAMETER>([&] { root->create_link("wire", ACCOUNT); }));
    CHECK(raises<BAD_PARAMETER>([&] { root->create_link(SIMPLE_MESSAGE_CONNECTOR, ACCOUNT); }));
    CHECK(raises<BAD_PARAMETER>([&] { service->attach(Role::receiver, root, bank, "account"); }));
    CHECK(raises<BAD_PARAMETER>([&] { service->attach(Role::server, root, bank, "news"); }));
    CHECK(raises<BAD_PARAMETER>([&] { service->attach(Role::server, root, client, "bank"); }));
    CHECK(raises<NOT_FOUND>([&] { service->attach(Role::server, root, 99, "account"); }));
    CHECK(raises<BAD_PARAMETER>([&] { service->attach(Role::server, nullptr, bank, "account"); }));
    CHECK(raises<NOT_FOUND>([&] { service->detach(root, bank, "account"); }));
    service->attach(Role::server, root, bank, "account");
    CHECK(raises<UCM_ERROR>([&] { service->attach(Role::server, root, other, "account"); }));
    CHECK(raises<UCM_ERROR>([&] { service->attach(Role::server, root, bank, "account"); }));
    service->attach(Role::client, root, client, "bank");
    CHECK(raises<UCM_ERROR>([&] { application.service()->attach(Role::client, root, client, "bank"); }));
    CHECK(raises<UCM_ERROR>([&] { root->remove_component(bank); }));
    service->detach(root, bank, "account");
    CHECK(raises<UCM_ERROR>([&] { root->start(); }));
    service->attach(Role::server, root, other, "account");
    root->start();
    CHECK(raises<UCM_ERROR>([&] { service->detach(root, client, "bank"); }));
}

void values_and_exceptions_cross() {
    Application application;
    const auto service = application.service();
    service->attach(Role::server, application.runtime, application.add("Bank"), "account");
    service->attach(Role::client, application.runtime, application.add("Client"), "bank");
    application.runtime->start();
    Body& bank = *application.bodies.at(0);
    DynamicPortElement& account = application.bodies.at(1)->element("bank");
    CHECK(withdraw(account, 42) == -42);
    bank.on_withdraw = [](std::int64_t amount) -> std::int64_t { throw Overdrawn{amount + 1}; };
    try {
        withdraw(account, 41);
        CHECK(false);
    } catch (const Overdrawn& exception) {
        CHECK(exception.missing == 42);
    }
    bank.on_withdraw = [](std::int64_t) -> std::int64_t { throw 42; };
    CHECK(raises<UCM_ERROR>([&] { withdraw(account, 1); }));
    CHECK(raises<BAD_PARAMETER>([&] { account.call("withdraw", {Value::boolean(true)}); }));
    CHECK(raises<BAD_PARAMETER>([&] { account.call("withdraw", {}); }));
    CHECK(raises<BAD_PARAMETER>([&] { account.call("deposit", {}); }));
}

void who_waits_for_a_transport_is_let_go_by_stop() {
    Application application("service-failure=wait");
    const auto servers = application.runtime->create_container({});
    const auto service = application.service();
    service->attach(Role::server, servers, application.add("Bank", servers), "account");
    service->attach(Role::client, application.runtime, application.add("Client"), "bank");
    servers->start();
    application.runtime->start();
    const auto element = application.bodies.at(1)->references.at("bank");
    DynamicPortElement& account = dynamic_cast<DynamicPortElement&>(*element);
    for (const std::shared_ptr<Container>& stopped : {servers, std::shared_ptr<Container>(application.runtime)}) {
        service->break_transport();
        auto call = std::async(std::launch::async, [&] { return withdraw(account, 1); });
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        CHECK(call.wait_for(std::chrono::seconds(0)) == std::future_status::timeout);
        stopped->stop();
        CHECK(raises<UCM_ERROR>([&] { call.get(); }));
        service->mend();
        stopped->start();
        CHECK(withdraw(account, 1) == -1);
    }
    service->break_connector();
    auto call = std::async(std::launch::async, [&] { return withdraw(account, 2); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    service->mend();
    CHECK(call.get() == -2);
}

void stop_waits_for_calls_and_called_components_may_not_stop() {
    Application application;
    const auto service = application.service();
    service->attach(Role::server, application.runtime, application.add("Bank"), "account");
    service->attach(Role::client, application.runtime, application.add("Client"), "bank");
    application.runtime->start();
    Gate gate;
    std::atomic<bool> left(false);
    application.bodies.at(0)->on_withdraw = [&](std::int64_t amount) {
        CHECK(raises<UCM_ERROR>([&] { application.runtime->stop(); }));
        gate.pass();
        left = true;
        return amount;
    };
    const auto element = application.bodies.at(1)->references.at("bank");
    auto call = std::async(std::launch::async,
                           [&] { return withdraw(dynamic_cast<DynamicPortElement&>(*element), 3); });
    gate.await(1);
    auto stop = std::async(std::launch::async, [&] {
        application.runtime->stop();
        return left.load();
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    gate.open();
    CHECK(stop.get());
    CHECK(call.get() == 3);
    CHECK(raises<UCM_ERROR>([&] { withdraw(dynamic_cast<DynamicPortElement&>(*element), 3); }));
}

/// Two authors and two receivers; each receiver gets what each author wrote, in order.
void messages_come_once_and_in_order(const std::string& options, bool to_itself) {
    const int count = 2000;
    Application application(options, {{"protected_passive_component", "", {}, ""}});
    const auto news = application.messages();
    std::vector<std::vector<std::u32string>> got(2);
    Gate complete;
    complete.open();
    for (std::size_t index = 0; index < 2; ++index) {
        news->attach(Role::receiver, application.runtime, application.add("Bank"), "news");
        application.bodies.back()->on_push = [&, index](const std::u32string& text) {
            got[index].push_back(text);
            if (to_itself && text == U"a0") {
                CHECK(push(application.bodies.at(2)->element("editor"), U"c") == "ok");
            }
            if (got[index].size() == 2U * count + (to_itself ? 2 : 0)) {
                complete.pass();
            }
        };
    }
    for (int author = 0; author < 2; ++author) {
        news->attach(Role::emitter, application.runtime, application.add("Author"), "editor");
    }
    application.runtime->start();
    const auto write = [&](std::size_t author, char32_t letter) {
        DynamicPortElement& editor = application.bodies.at(author)->element("editor");
        for (int number = 0; number < count; ++number) {
            const std::string digits = std::to_string(number);
            CHECK(push(editor, letter + std::u32string(digits.begin(), digits.end())) == "ok");
        }
    };
    auto other = std::async(std::launch::async, [&] { write(3, U'b'); });
    write(2, U'a');
    other.get();
    complete.await(2);
    application.runtime->stop();
    for (const std::vector<std::u32string>& texts : got) {
        for (const char32_t letter : {U'a', U'b'}) {
            int next = 0;
            for (const std::u32string& text : texts) {
                if (text[0] == letter) {
                    const std::string digits = std::to_string(next++);
                    CHECK(text.substr(1) == std::u32string(digits.begin(), digits.end()));
                }
            }
            CHECK(next == count);
        }
    }
}

void codes_tell_what_happened() {
    Application application;
    const auto news = application.messages();
    news->attach(Role::emitter, application.runtime, application.add("Author"), "editor");
    application.runtime->start();
    DynamicPortElement& editor = application.bodies.at(0)->element("editor");
    CHECK(push(editor, U"12345678") == "ok");
    CHECK(push(editor, U"123456789") == "internal_error");
    CHECK(push(editor, U"\u20ac") == "internal_error");
    CHECK(editor.call("push", {}).at(0).as_enumerator() == "internal_error");
    CHECK(raises<BAD_PARAMETER>([&] { editor.call("pull", {}); }));
    news->break_transport();
    CHECK(push(editor, U"1") == "comm_error");
    news->break_connector();
    CHECK(push(editor, U"1") == "internal_error");
    news->mend();
    CHECK(push(editor, U"1") == "ok");
}

void what_waits_for_a_receiver_is_treated_as_chosen(const std::string& options, const std::vector<std::u32string>& due,
                                                    const std::string& code) {
    Application application(options);
    const auto receivers = application.runtime->create_container({});
    const auto news = application.messages();
    news->attach(Role::emitter, application.runtime, application.add("Author"), "editor");
    news->attach(Role::receiver, receivers, application.add("Bank", receivers), "news");
    application.runtime->start();
    std::vector<std::u32string> got;
    Gate gate;
    application.bodies.at(1)->on_push = [&](const std::u32string& text) {
        gate.pass();
        got.push_back(text);
    };
    DynamicPortElement& editor = application.bodies.at(0)->element("editor");
    CHECK(push(editor, U"early") == code);
    receivers->start();
    CHECK(push(editor, U"one") == "ok");
    CHECK(push(editor, U"two") == "ok");
    gate.await(1);
    auto stop = std::async(std::launch::async, [&] { receivers->stop(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    gate.open();
    stop.get();
    const std::size_t before = got.size();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(got.size() == before);
    receivers->start();
    CHECK(push(editor, U"three") == "ok");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    receivers->stop();
    CHECK(got == due);
}

void a_full_inbox_makes_emitters_wait() {
    Application application("inbox=2");
    const auto news = application.messages();
    news->attach(Role::emitter, application.runtime, application.add("Author"), "editor");
    news->attach(Role::receiver, application.runtime, application.add("Bank"), "news");
    application.runtime->start();
    Gate gate;
    std::atomic<int> got(0);
    application.bodies.at(1)->on_push = [&](const std::u32string&) {
        gate.pass();
        ++got;
    };
    auto author = std::async(std::launch::async, [&] {
        for (int number = 0; number < 5; ++number) {
            CHECK(push(application.bodies.at(0)->element("editor"), U"x") == "ok");
        }
    });
    gate.await(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(author.wait_for(std::chrono::seconds(0)) == std::future_status::timeout);
    gate.open();
    author.get();
    gate.await(5);
}

void services_are_there_by_policy() {
    const std::vector<Policy> policies = {
        {"clock", "", {}, "time"},
        {"component_trace", "", {}, ""},
        {"port_trace", "account", {{"methods_to_trace", "deposit, withdraw"}, {"log_severity", "warning"}}, ""},
        {"protected_passive_component", "", {}, ""}};
    Application application("", policies);
    const componentId bank = application.add("Bank");
    const auto account = application.runtime->get_port_element(bank, "account");
    application.runtime->start();
    Body& body = *application.bodies.at(0);
    const auto clock = std::dynamic_pointer_cast<clock_service_intf>(body.references.at("time"));
    const auto trace = std::dynamic_pointer_cast<trace_service_intf>(body.references.at("component_trace_trace_api"));
    ucm_timeval_t local = {0, 0};
    ucm_timeval_t synchronized = {0, 0};
    clock->get_local_time(local);
    clock->get_synchronized_time(synchronized);
    CHECK(local.utv_usec >= 0 && local.utv_usec < 1000000);
    CHECK(synchronized.utv_sec >= local.utv_sec);
    trace->log(log_severity_t::critical, U"\U0001F514");
    CHECK(withdraw(dynamic_cast<DynamicPortElement&>(*account), 1) == -1);
    const std::vector<LogRecord> records = application.runtime->trace_records();
    CHECK(records.size() == 2);
    CHECK(records.at(0).severity == log_severity_t::critical && records.at(0).message == U"\U0001F514");
    CHECK(records.at(1).severity == log_severity_t::warning);
    CHECK(records.at(1).message.find(U"withdraw") != std::u32string::npos);
    for (const Policy& wrong : std::vector<Policy>{{"clock", "account", {}, ""},
                                                   {"component_trace", "", {{"a", "b"}}, ""},
                                                   {"port_trace", "account", {{"methods_to_trace", "m"}}, ""},
                                                   {"port_trace", "", {}, ""},
                                                   {"timer", "", {}, ""}}) {
        Application refusing("", {wrong});
        CHECK(raises<UCM_ERROR>([&] { refusing.add("Bank"); }));
    }
    Application two_clocks("", {{"clock", "", {}, "a"}, {"clock", "", {}, "b"}});
    CHECK(raises<UCM_ERROR>([&] { two_clocks.add("Bank"); }));
}

/// Each calls the next one and the last one the first, and each has a thread of its own.
void calls_may_come_back_in_a_circle() {
    Application application("executor=component", {{"protected_passive_component", "", {}, ""}});
    const componentId first = application.add("Bank");
    const componentId second = application.add("Bank");
    application.runtime->start();
    const auto to_first = application.runtime->get_port_element(first, "account");
    const auto to_second = application.runtime->get_port_element(second, "account");
    const auto call = [](const std::shared_ptr<PortElementObject>& element, std::int64_t amount) {
        return withdraw(dynamic_cast<DynamicPortElement&>(*element), amount);
    };
    application.bodies.at(0)->on_withdraw = [&](std::int64_t amount) {
        return amount == 0 ? 0 : 1 + call(to_second, amount - 1);
    };
    application.bodies.at(1)->on_withdraw = [&](std::int64_t amount) { return 1 + call(to_first, amount); };
    auto other = std::async(std::launch::async, [&] { return call(to_first, 10); });
    CHECK(call(to_first, 10) == 20);
    CHECK(other.get() == 20);
}

}  // namespace

int main() {
    types_that_are_none_are_refused();
    only_fitting_ends_are_attached();
    values_and_exceptions_cross();
    who_waits_for_a_transport_is_let_go_by_stop();
    stop_waits_for_calls_and_called_components_may_not_stop();
    for (const char* const options : {"", "inbox=3", "delivery=synchronous", "executor=shared", "executor=component"}) {
        messages_come_once_and_in_order(options, false);
        messages_come_once_and_in_order(options, true);
    }
    codes_tell_what_happened();
    what_waits_for_a_receiver_is_treated_as_chosen("", {U"early", U"one", U"two", U"three"}, "ok");
    what_waits_for_a_receiver_is_treated_as_chosen("not-ready=drop", {U"one", U"two", U"three"}, "ok");
    what_waits_for_a_receiver_is_treated_as_chosen("not-ready=drop,pending=drop", {U"one", U"three"}, "ok");
    what_waits_for_a_receiver_is_treated_as_chosen("not-ready=error,pending=deliver", {U"one", U"two", U"three"},
                                                   "comm_error");
    a_full_inbox_makes_emitters_wait();
    services_are_there_by_policy();
    calls_may_come_back_in_a_circle();
    timers_do_what_they_are_set_to();
    object_timers_do_what_they_are_made_for();
    return failures == 0 ? 0 : 1;
}
