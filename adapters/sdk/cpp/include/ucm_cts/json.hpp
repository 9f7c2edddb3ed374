// JSON in: a strict reader that names the place of an error.
#ifndef UCM_CTS_JSON_HPP
#define UCM_CTS_JSON_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "ucm_cts/words.hpp"

namespace ucm_cts {

/// A message that breaks the protocol; the text says what is wrong and where, for instance ``at `$.scenario.steps[0]` ``.
class ProtocolError : public std::runtime_error {
  public:
    explicit ProtocolError(const std::string& what) : std::runtime_error(what) {}
};

namespace json {

/// One line of JSON; the members of objects are in the order of the text, and of those of one name the last one counts.
typedef nlohmann::ordered_json Document;
typedef Document::value_t Kind;

/// What errors call a kind of value; an unsigned integer is one that does not fit 64 bits signed.
inline const char* name_of(Kind kind) {
    static const char* const names[] = {"null", "object", "array", "str", "bool", "int", "int", "float"};
    return names[static_cast<std::size_t>(kind)];
}

/// Throws ProtocolError if `text` is not one JSON value in UTF-8. Integers are unsigned only if they do not fit 64 bits signed.
inline Document parsed(const char* text, std::size_t size) {
    const int deepest = 500;  // what is nested is read by functions that call themselves
    try {
        return Document::parse(text, text + size, [](int depth, Document::parse_event_t, Document& json) {
            if (depth > deepest) {
                throw ProtocolError("JSON is nested too deeply");
            }
            if (json.is_number_unsigned() && json.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)) {
                json = json.get<std::int64_t>();
            }
            return true;
        });
    } catch (const Document::exception& error) {
        throw ProtocolError(std::string("JSON is malformed: ") + error.what());
    }
}

/// A value inside a document, and the way that leads to it.
class Value {
  public:
    explicit Value(const Document& document) : Value(document, nullptr, nullptr, 0) {}

    Kind kind() const { return json_.type(); }

    std::string text() const {
        expect(Kind::string);
        return json_.get<std::string>();
    }

    /// Which of `known` the string is.
    std::size_t word(const Words& known, const char* problem = "Invalid enum value") const {
        return index(text(), known, problem);
    }

    /// Which of `known` the value's key is.
    std::size_t key_word(const Words& known) const { return index(key(), known, "Invalid enum value"); }

    bool boolean() const {
        expect(Kind::boolean);
        return json_.get<bool>();
    }

    std::int64_t integer() const {
        if (kind() == Kind::number_unsigned) {
            fail("Expected a 64-bit `int`");
        }
        expect(Kind::number_integer);
        return json_.get<std::int64_t>();
    }

    /// The value, of any kind.
    nlohmann::json tree() const { return json_; }

    std::int32_t integer32() const {
        const std::int64_t value = integer();
        if (value < INT32_MIN || value > INT32_MAX) {
            fail("Expected a 32-bit `int`");
        }
        return static_cast<std::int32_t>(value);
    }

    /// Calls `visit(value)` for each element of the array.
    template <class Visit>
    void for_each_element(Visit visit) const {
        expect(Kind::array);
        for (std::size_t n = 0; n < json_.size(); ++n) {
            visit(Value(json_[n], this, nullptr, n));
        }
    }

    /// Calls `visit(value)` for each member of the object; its name is `value.key()`.
    template <class Visit>
    void for_each_member(Visit visit) const {
        expect(Kind::object);
        for (const auto& member : json_.items()) {
            visit(Value(member.value(), this, &member.key(), 0));
        }
    }

    const std::string& key() const { return *key_; }

    [[noreturn]] void fail(const std::string& what) const {
        const std::string where = path();
        throw ProtocolError(where == "$" ? what : what + " - at `" + where + "`");
    }

    void expect(Kind wanted) const {
        if (kind() != wanted) {
            fail(std::string("Expected `") + name_of(wanted) + "`, got `" + name_of(kind()) + "`");
        }
    }

  private:
    friend class Fields;

    Value(const Document& json, const Value* parent, const std::string* key, std::size_t position)
        : json_(json), parent_(parent), key_(key), position_(position) {}

    std::size_t index(const std::string& given, const Words& known, const char* problem) const {
        const auto end = known.begin + known.size;
        const auto found = std::find(known.begin, end, given);
        if (found == end) {
            fail(problem + (" '" + given) + "'");
        }
        return static_cast<std::size_t>(found - known.begin);
    }

    std::string path() const {
        if (parent_ == nullptr) {
            return "$";
        }
        return parent_->path() + (key_ != nullptr ? "." + key() : "[" + std::to_string(position_) + "]");
    }

    const Document& json_;
    const Value* parent_;  // on the stack of the caller: a value must not outlive the visit it was made for
    const std::string* key_;
    std::size_t position_;
};

// Each `read(value, into)` reads a value of one type; those of the messages are generated.

inline void read(const Value& value, bool& into) { into = value.boolean(); }
inline void read(const Value& value, std::int32_t& into) { into = value.integer32(); }
inline void read(const Value& value, std::int64_t& into) { into = value.integer(); }
inline void read(const Value& value, std::string& into) { into = value.text(); }
inline void read(const Value& value, std::string& into, const Words& known) { into = known.begin[value.word(known)]; }

inline void read(const Value& value, nlohmann::json& into) {
    const Kind kind = value.kind();
    if (kind == Kind::null || kind == Kind::number_float || kind == Kind::object) {
        value.fail(std::string("Expected `bool | int | str | array`, got `") + name_of(kind) + "`");
    }
    into = value.tree();
}

template <class Enumeration>
typename std::enable_if<std::is_enum<Enumeration>::value>::type read(const Value& value, Enumeration& into,
                                                                     const char* problem = "Invalid enum value") {
    into = static_cast<Enumeration>(value.word(words_of(into), problem));
}

/// Reads with a function of the type's own.
template <class T>
void read(const Value& value, T& into, void (*read_it)(const Value&, T&)) {
    read_it(value, into);
}

template <class T>
void read(const Value& value, std::shared_ptr<const T>& into) {
    const std::shared_ptr<T> made = std::make_shared<T>();
    read(value, *made);
    into = made;
}

template <class T>
void read(const Value& value, std::vector<T>& into) {
    into.clear();
    value.for_each_element([&into](const Value& element) {
        into.emplace_back();
        read(element, into.back());
    });
}

template <class T, void (*read_one)(const Value&, T&)>
void read_each(const Value& value, std::vector<T>& into) {
    into.clear();
    value.for_each_element([&into](const Value& element) {
        into.emplace_back();
        read_one(element, into.back());
    });
}

template <class T>
void read(const Value& value, std::vector<std::pair<std::string, T>>& into) {
    into.clear();
    value.for_each_member([&into](const Value& member) {
        into.emplace_back(member.key(), T());
        read(member, into.back().second);
    });
}

/// Integers of any size, by name.
inline void read_integers(const Value& value, std::vector<std::pair<std::string, nlohmann::json>>& into) {
    into.clear();
    value.for_each_member([&into](const Value& member) {
        into.emplace_back(member.key(), member.kind() == Kind::number_unsigned ? member.tree() : nlohmann::json(member.integer()));
    });
}

inline void read_key(const Value& member, std::string& into) { into = member.key(); }

template <class Enumeration>
void read_key(const Value& member, Enumeration& into) {
    into = static_cast<Enumeration>(member.key_word(words_of(into)));
}

template <class Key, class T>
void read(const Value& value, std::map<Key, T>& into) {
    into.clear();
    value.for_each_member([&into](const Value& member) {
        Key key;
        read_key(member, key);
        T read_now;
        read(member, read_now);
        into[key] = std::move(read_now);
    });
}

/// The members of one object, each to be asked for by name; `end` refuses an object with any other member.
class Fields {
  public:
    explicit Fields(const Value& object) : object_(object) { object.expect(Kind::object); }

    /// Reads the member if it is there, `how` as the functions `read` take it. Was it?
    template <class T, class... How>
    bool optional(const char* name, T& into, How... how) {
        const auto found = find(name);
        const bool given = found != object_.json_.end();
        if (given) {
            read(Value(*found, &object_, &found.key(), 0), into, how...);
        }
        return given;
    }

    template <class T, class... How>
    void required(const char* name, T& into, How... how) {
        if (!optional(name, into, how...)) {
            object_.fail(std::string("Object missing required field `") + name + "`");
        }
    }

    /// Reads the member if it is there and not null. Was it?
    template <class T>
    bool nullable(const char* name, T& into) {
        const auto found = find(name);
        const bool given = found != object_.json_.end() && !found->is_null();
        if (given) {
            read(Value(*found, &object_, &found.key(), 0), into);
        }
        return given;
    }

    /// To be called when all members that the protocol knows have been asked for.
    void end() const {
        if (taken_ == object_.json_.size()) {
            return;
        }
        object_.for_each_member([this](const Value& member) {
            if (std::find(known_, known_ + asked_, member.key()) == known_ + asked_) {
                object_.fail("Object contains unknown field `" + member.key() + "`");
            }
        });
    }

  private:
    Document::const_iterator find(const char* name) {
        const auto found = object_.json_.find(name);
        taken_ += found != object_.json_.end() ? 1 : 0;
        known_[asked_++] = name;
        return found;
    }

    const Value& object_;
    std::size_t taken_ = 0;
    std::size_t asked_ = 0;
    const char* known_[16];  // more than any object of the protocol has
};

}  // namespace json
}  // namespace ucm_cts

#endif
