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
#include "ucm_cts/json.hpp"
#include "ucm_cts/json_text.hpp"
#include "ucm_cts/scenario_reading.hpp"

namespace ucm_cts {

const std::int64_t PROTOCOL = 1;

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
            document_.parse(message, size);
            const json::Value value(document_);
            std::string type;
            json::Fields(value).text("type", type);
            if (type == "hello") {
                hello(value);
            } else if (type == "run") {
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
        std::int64_t protocol = 0;
        std::string type;
        json::Fields fields(message);
        fields.text("type", type);
        fields.required("protocol", [&protocol](const json::Value& value) { protocol = value.integer(); });
        fields.end();
        if (protocol != PROTOCOL) {
            throw ProtocolError("the harness speaks protocol " + std::to_string(protocol) + ", this host speaks " +
                                std::to_string(PROTOCOL));
        }
        try {
            const std::string names = make_adapter_()->port_element_name();
            out_ += "{\"type\":\"welcome\",\"protocol\":";
            json::append_integer(out_, PROTOCOL);
            json::append_name(out_, "product");
            json::append_text(out_, product_.name);
            json::append_name(out_, "version");
            json::append_text(out_, product_.version);
            json::append_name(out_, "port_element_name");
            json::append_text(out_, names);
            out_ += '}';
        } catch (const std::exception& error) {
            refuse(std::string("the adapter could not be made: ") + error.what());
        } catch (...) {
            refuse("the adapter could not be made");
        }
    }

    void run(const json::Value& message) {
        std::string type;
        bool stream = false;
        const std::shared_ptr<Scenario> scenario = std::make_shared<Scenario>();
        json::Fields fields(message);
        fields.text("type", type);
        fields.required("id", [this](const json::Value& value) {
            id_ = value.integer();
            has_id_ = true;
        });
        fields.required("scenario", [&scenario](const json::Value& value) { *scenario = read_scenario(value); });
        fields.optional("stream", [&stream](const json::Value& value) { stream = value.boolean(); });
        fields.end();
        const std::shared_ptr<Engine> engine = set_up(scenario, stream);
        if (!engine) {
            return;
        }
        out_ += "{\"type\":\"trace\",\"id\":";
        json::append_integer(out_, id_);
        json::append_name(out_, "events");
        const std::vector<std::string> names = engine->run(out_);
        if (!names.empty()) {
            stuck_ = true;
            json::append_name(out_, "stuck");
            json::append_array(out_, names,
                               [](std::string& out, const std::string& name) { json::append_text(out, name); });
        }
        out_ += '}';
        const std::string complaint = engine->complaint();
        if (!complaint.empty()) {
            refuse("the adapter broke its contract: " + complaint);
        }
    }

    // Null, and the answer says why, if the adapter cannot set up its framework.
    std::shared_ptr<Engine> set_up(const std::shared_ptr<Scenario>& scenario, bool stream) {
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
            std::string line = "{\"type\":\"event\",\"id\":";
            json::append_integer(line, id);
            json::append_name(line, "event");
            line += event;
            line += "}\n";
            emit(line);
        };
    }

    void refuse(const std::string& reason) {
        out_ = "{\"type\":\"refused\",\"reason\":";
        json::append_text(out_, reason);
        if (has_id_) {
            json::append_name(out_, "id");
            json::append_integer(out_, id_);
        }
        out_ += '}';
    }

    const Product product_;
    const AdapterFactory make_adapter_;
    const Emit emit_;
    json::Document document_;
    std::string out_;
    std::int64_t id_ = 0;
    bool has_id_ = false;
    bool stuck_ = false;
};

}  // namespace ucm_cts

#endif
