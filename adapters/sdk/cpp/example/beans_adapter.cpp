// The adapter of the second example in docs/adapter-cpp.md: a framework with names for ids and codes for exceptions.
#include <atomic>

#include <beans.hpp>
#include <ucm_cts/binding.hpp>
#include <ucm_cts/main.hpp>

struct ServiceReference : ucm_cts::Wrapped<beans::Service> {
    using Wrapped::Wrapped;
    std::int32_t exchange(std::int32_t value) override { return own(value); }
    ucm_cts::Data call(const std::string& method, const ucm_cts::Data& arguments) override {
        const beans::Speaker* const line = own.target<beans::Speaker>();
        if (line == nullptr) {
            return PortElement::call(method, arguments);  // throws: a service has no methods
        }
        const ucm_cts::Datum answer = ucm_cts::Datum::parse(line->talk(method, ucm_cts::Datum(arguments).dump()));
        if (answer.at(0).is_string()) {
            throw ucm_cts::DeclaredException(answer[0], answer.at(1));
        }
        return answer.at(1);
    }
};

// What the framework cannot do fails with UcmError: the operations that BareAdapter keeps.
class BeansAdapter : public ucm_cts::BareAdapter {
  public:
    ucm_cts::ContainerHandle create_runtime(const std::vector<ucm_cts::Implementation>& implementations) override {
        for (const ucm_cts::Implementation& one : implementations) {
            kernel_->define(one.name, beans::Kind{one.required, [one] { return bean(one); }});
        }
        return kernel_;
    }

    ucm_cts::Id add_component(const ucm_cts::ContainerHandle&, const std::string& implementation,
                              const ucm_cts::Attributes&) override {
        const ucm_cts::Id id = ++last_;
        check(kernel_->load(std::to_string(id), implementation));
        return id;
    }

    void remove_component(const ucm_cts::ContainerHandle&, ucm_cts::Id id) override {
        check(kernel_->unload(std::to_string(id)));
    }

    ucm_cts::Reference get_port_element(const ucm_cts::ContainerHandle&, ucm_cts::Id id,
                                        const std::string& port) override {
        beans::Service service;
        check(kernel_->service(std::to_string(id), port, service));
        return std::make_shared<ServiceReference>(service);
    }

    ucm_cts::Id connect(const ucm_cts::ContainerHandle&, ucm_cts::Id id, const std::string& port,
                        const ucm_cts::Reference& to) override {
        int wire = 0;
        check(kernel_->wire(std::to_string(id), port, ServiceReference::unwrap(to), wire));
        return wire;
    }

    void disconnect(const ucm_cts::ContainerHandle&, ucm_cts::Id connection) override {
        check(kernel_->unwire(static_cast<int>(connection)));
    }

    void start(const ucm_cts::ContainerHandle&) override { check(kernel_->run()); }
    void stop(const ucm_cts::ContainerHandle&) override { check(kernel_->halt()); }
    void destroy(const ucm_cts::ContainerHandle&) override { check(kernel_->halt()); }

    ucm_cts::LinkHandle link(const ucm_cts::ContainerHandle&, const std::string& connector,
                             const ucm_cts::SharedInterface&) override {
        if (connector != "simple_service_connector") {
            throw ucm_cts::NotOffered();
        }
        return std::make_shared<Line>(Line{kernel_->line(), {}});
    }

    void attach(const ucm_cts::LinkHandle& link, const std::string& role, const ucm_cts::ContainerHandle&,
                ucm_cts::Id id, const std::string& port) override {
        Line& line = *static_cast<Line*>(link.get());
        if (role == "server") {
            check(kernel_->answer(line.number, std::to_string(id), port));
            return;
        }
        int wire = 0;
        check(kernel_->call(line.number, std::to_string(id), port, wire));
        line.wires[std::make_pair(id, port)] = wire;
    }

    void detach(const ucm_cts::LinkHandle& link, const ucm_cts::ContainerHandle&, ucm_cts::Id id,
                const std::string& port) override {
        Line& line = *static_cast<Line*>(link.get());
        const auto wire = line.wires.find(std::make_pair(id, port));
        if (wire == line.wires.end()) {
            kernel_->hang_up(line.number);
            return;
        }
        check(kernel_->unwire(wire->second));
        line.wires.erase(wire);
    }

    void break_link(const ucm_cts::LinkHandle& link, const std::string&) override {
        kernel_->cut(static_cast<Line*>(link.get())->number, true);
    }

    void mend_link(const ucm_cts::LinkHandle& link) override {
        kernel_->cut(static_cast<Line*>(link.get())->number, false);
    }

    struct Line {
        int number;
        std::map<std::pair<ucm_cts::Id, std::string>, int> wires;
    };

  private:
    static beans::Bean bean(const ucm_cts::Implementation& one) {
        const std::shared_ptr<ucm_cts::Body> body = one.create();
        beans::Bean bean;
        for (const std::string& port : one.provided) {
            const ucm_cts::Reference element = body->get_portElement(port);
            bean.offers[port] = [element](int value) { return element->exchange(value); };
            bean.answers[port] = [element](const std::string& method, const std::string& text) {
                try {
                    return ucm_cts::Datum::array({nullptr, element->call(method, ucm_cts::Datum::parse(text))}).dump();
                } catch (const ucm_cts::DeclaredException& error) {
                    return ucm_cts::Datum::array({error.name, error.fields}).dump();
                }
            };
        }
        bean.prepare = [body] { body->on_init(); };
        bean.activate = [body](const beans::Services& needs) {
            std::vector<std::pair<std::string, ucm_cts::Reference>> pairs;
            for (const auto& need : needs) {
                pairs.emplace_back(need.first, std::make_shared<ServiceReference>(need.second));
            }
            body->on_startup(ucm_cts::port_connections(pairs));
        };
        bean.deactivate = [body] { body->on_shutdown(); };
        bean.dispose = [body] { body->on_remove(); };
        return bean;
    }

    static void check(beans::Code code) {
        switch (code) {
            case beans::Code::ok: return;
            case beans::Code::no_such_bean: throw ucm_cts::NotFound("no such bean");
            case beans::Code::no_such_service: throw ucm_cts::NotFound("no such service");
            case beans::Code::no_such_wire: throw ucm_cts::NotFound("no such wire");
            case beans::Code::not_now: throw ucm_cts::UcmError("not now");
            case beans::Code::bean_failed: throw ucm_cts::UcmError("a bean failed");
        }
    }

    const std::shared_ptr<beans::Kernel> kernel_ = std::make_shared<beans::Kernel>();
    std::atomic<ucm_cts::Id> last_{0};
};

UCM_CTS_ADAPTER(BeansAdapter, "beans", "1.0");
