// Messages: one line from the harness in, one line out.
#ifndef UCM_CTS_MESSAGES_HPP
#define UCM_CTS_MESSAGES_HPP

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/engine.hpp"
#include "ucm_cts/generated/events.hpp"
#include "ucm_cts/generated/messages_reading.hpp"
#include "ucm_cts/json.hpp"

namespace ucm_cts {

const std::int64_t PROTOCOL = 2;

/// What a host says of the framework it has inside.
struct Product {
    std::string name;
    std::string version;
};

/// Answers messages, each with a fresh adapter. Keeps buffers between messages; use one for each thread.
class Answerer {
  public:
    /// Receives the lines that a streamed run sends ahead of its answer, each with its newline.
    typedef std::function<void(const std::string& line)> Emit;

    Answerer(Product product, AdapterFactory make_adapter, Emit emit)
        : product_(std::move(product)), make_adapter_(std::move(make_adapter)), emit_(std::move(emit)) {}

    /// The answer to one message, without the newline; valid until the next call. Never throws for what a message says.
    const std::string& answer(const char* message, std::size_t size) {
        out_.clear();
        stuck_ = false;
        has_id_ = false;
        try {
            const json::Document document = json::parsed(message, size);
            const json::Value value(document);
            std::string type;
            json::Fields fields(value);
            fields.required("type", type);
            if (type == "hello") {
                hello(value);
            } else if (type == "run") {
                fields.required("id", id_);
                has_id_ = true;
                run(value);
            } else {
                throw ProtocolError("Invalid value '" + type + "' - at `$.type`");
            }
        } catch (const ProtocolError& error) {
            refuse(error.what());
        } catch (const std::exception& error) {  // no memory, no threads
            refuse(std::string("the host failed: ") + error.what());
        }
        return out_;
    }

    /// Did the last answer name stuck threads? Then the process is of no use any more.
    bool stuck() const { return stuck_; }

  private:
    void hello(const json::Value& message) {
        Hello spoken;
        read(message, spoken);
        if (spoken.protocol != PROTOCOL) {
            throw ProtocolError("the harness speaks protocol " + std::to_string(spoken.protocol) +
                                ", this host speaks " + std::to_string(PROTOCOL));
        }
        try {
            const std::string names = make_adapter_()->port_element_name();
            out_ = events::Welcome(PROTOCOL, product_.name, product_.version).port_element_name(names).line();
        } catch (const std::exception& error) {
            refuse(std::string("the adapter could not be made: ") + error.what());
        } catch (...) {
            refuse("the adapter could not be made");
        }
    }

    void run(const json::Value& message) {
        const std::shared_ptr<Run> asked = std::make_shared<Run>();
        read(message, *asked);
        detail::check(asked->scenario);
        const std::shared_ptr<Engine> engine = set_up({asked, &asked->scenario}, asked->stream);
        if (!engine) {
            return;
        }
        trace_.clear();
        const std::vector<std::string> names = engine->run(trace_);
        stuck_ = !names.empty();
        events::Traced traced(id_, json::Written{trace_});
        if (stuck_) {
            traced.stuck(names);
        }
        out_ = traced.line();
        const std::string complaint = engine->complaint();
        if (!complaint.empty()) {
            refuse("the adapter broke its contract: " + complaint);
        }
    }

    // Null, and the answer says why, if the adapter cannot set up its framework.
    std::shared_ptr<Engine> set_up(const std::shared_ptr<const Scenario>& scenario, bool stream) {
        try {
            return std::make_shared<Engine>(make_adapter_(), scenario, stream && emit_ ? streaming() : Recorder::Sink());
        } catch (const std::exception& error) {
            refuse(std::string("the adapter could not create a runtime: ") + error.what());
        } catch (...) {
            refuse("the adapter could not create a runtime");
        }
        return nullptr;
    }

    Recorder::Sink streaming() const {
        const Emit emit = emit_;
        const std::int64_t id = id_;
        return [emit, id](const std::string& event) {
            emit(events::Happened(id, json::Written{event}).line() + '\n');
        };
    }

    void refuse(const std::string& reason) {
        events::Refused refused(reason);
        if (has_id_) {
            refused.id(id_);
        }
        out_ = refused.line();
    }

    const Product product_;
    const AdapterFactory make_adapter_;
    const Emit emit_;
    std::string out_;
    std::string trace_;
    std::int64_t id_ = 0;
    bool has_id_ = false;
    bool stuck_ = false;
};

}  // namespace ucm_cts

#endif
