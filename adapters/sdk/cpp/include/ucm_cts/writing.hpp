// Writing: JSON objects member by member, and how what adapters and probes have stands in them.
#ifndef UCM_CTS_WRITING_HPP
#define UCM_CTS_WRITING_HPP

#include <map>
#include <string>
#include <vector>

#include "ucm_cts/adapter.hpp"
#include "ucm_cts/json_text.hpp"

namespace ucm_cts {
namespace json {

/// JSON that is written already; the text must outlive it.
struct Written {
    const std::string& text;
};

inline void append(std::string& out, const Written& value) { out += value.text; }

}  // namespace json

/// Appends a reference as it stands in a trace: whose it is, `"opaque"`, or null.
inline void append(std::string& out, const Reference& reference) {
    const Identity* const identity = reference ? reference->identity() : nullptr;
    if (identity == nullptr) {
        out += reference ? "\"opaque\"" : "null";
        return;
    }
    out += "{\"component\":";
    json::append(out, identity->component);
    json::append_name(out, "instance");
    json::append(out, identity->instance);
    json::append_name(out, "port");
    json::append(out, identity->port);
    out += '}';
}

inline void append(std::string& out, const PortConnection& connection) {
    out += "{\"port\":";
    json::append(out, connection.from_port);
    json::append_name(out, "references");
    json::append(out, connection.to_port);
    out += '}';
}

inline void append(std::string& out, const LogRecord& record) {
    out += "{\"severity\":";
    json::append(out, record.severity);
    json::append_name(out, "message");
    json::append(out, record.message);
    out += '}';
}

inline void append(std::string& out, Hook hook) { json::append(out, word_of(hook)); }

/// The members of a JSON object, but for the first, which is the tag.
class Members {
  public:
    const std::string& text() const { return text_; }

  protected:
    template <class T>
    void field(const char* name, const T& value) {
        using json::append;
        json::append_name(text_, name);
        append(text_, value);
    }

  private:
    std::string text_;
};

/// An event without what the recorder adds: the number, the time, and the thread.
class Event : public Members {
  public:
    const char* kind() const { return kind_; }

  protected:
    explicit Event(const char* kind) : kind_(kind) {}

  private:
    const char* const kind_;
};

/// A message to the harness.
class Answer : public Members {
  public:
    /// The message, without newline.
    std::string line() const { return std::string("{\"type\":\"") + type_ + '"' + text() + '}'; }

  protected:
    explicit Answer(const char* type) : type_(type) {}

  private:
    const char* const type_;
};

}  // namespace ucm_cts

#endif
