// JSON in: a strict reader that names the place of an error.
#ifndef UCM_CTS_JSON_HPP
#define UCM_CTS_JSON_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
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

enum class Kind : std::uint8_t { null, boolean, integer, too_large, floating, string, array, object };

inline const char* name_of(Kind kind) {
    static const char* const names[] = {"null", "bool", "int", "int", "float", "str", "array", "object"};
    return names[static_cast<std::size_t>(kind)];
}

/// One line of JSON as a flat list of nodes in the order of the text; kept between messages to reuse its memory.
class Document {
  public:
    struct Node {
        Kind kind;
        std::uint32_t size;  // characters of a string, members of an array or object
        std::size_t next;    // node after this one and all it contains
        std::size_t text;    // where a string begins
        std::size_t key;     // where its key begins, if it is a member of an object
        std::uint32_t key_size;
        std::int64_t integer;  // of one that is too large or floating, the bits
    };

    /// Replaces the content. Throws ProtocolError if `text` is not one JSON value in UTF-8.
    void parse(const char* text, std::size_t size) {
        nodes_.clear();
        open_.clear();
        texts_.clear();
        key_ = key_size_ = 0;
        Events events(*this);
        nlohmann::json::sax_parse(text, text + size, &events);
    }

    const Node& node(std::size_t index) const { return nodes_[index]; }
    const char* text(std::size_t begin) const { return texts_.data() + begin; }

  private:
    // what the parser calls; each member function returns whether to go on
    class Events {
      public:
        explicit Events(Document& document) : document_(document) {}
        bool null() { return document_.add(Kind::null); }
        bool boolean(bool value) { return document_.add(Kind::boolean, value ? 1 : 0); }
        bool number_integer(std::int64_t value) { return document_.add(Kind::integer, value); }
        bool number_unsigned(std::uint64_t value) {
            const std::uint64_t largest = static_cast<std::uint64_t>(INT64_MAX);
            return document_.add(value > largest ? Kind::too_large : Kind::integer, static_cast<std::int64_t>(value));
        }
        bool number_float(double value, const std::string&) {
            std::int64_t bits = 0;
            static_assert(sizeof bits == sizeof value, "a double has 64 bits");
            std::memcpy(&bits, &value, sizeof bits);
            return document_.add(Kind::floating, bits);
        }
        bool string(const std::string& value) { return document_.add_string(value); }
        bool binary(const std::vector<std::uint8_t>&) { return false; }
        bool start_object(std::size_t) { return document_.open(Kind::object); }
        bool start_array(std::size_t) { return document_.open(Kind::array); }
        bool end_object() { return document_.close(); }
        bool end_array() { return document_.close(); }
        bool key(const std::string& name) {
            document_.key_ = document_.texts_.size();
            document_.key_size_ = name.size();
            document_.texts_ += name;
            return true;
        }
        template <class Error>
        bool parse_error(std::size_t, const std::string&, const Error& error) {
            throw ProtocolError(std::string("JSON is malformed: ") + error.what());
        }

      private:
        Document& document_;
    };

    bool add(Kind kind, std::int64_t integer = 0) {
        if (!open_.empty()) {
            ++nodes_[open_.back()].size;
        }
        nodes_.push_back(
            Node{kind, 0, nodes_.size() + 1, 0, key_, static_cast<std::uint32_t>(key_size_), integer});
        return true;
    }

    bool add_string(const std::string& value) {
        add(Kind::string);
        nodes_.back().text = texts_.size();
        nodes_.back().size = static_cast<std::uint32_t>(value.size());
        texts_ += value;
        return true;
    }

    bool open(Kind kind) {
        if (open_.size() >= DEEPEST) {
            throw ProtocolError("JSON is nested too deeply");
        }
        add(kind);
        open_.push_back(nodes_.size() - 1);
        return true;
    }

    bool close() {
        nodes_[open_.back()].next = nodes_.size();
        open_.pop_back();
        return true;
    }

    static const std::size_t DEEPEST = 500;  // what is nested is read by functions that call themselves

    std::vector<Node> nodes_;
    std::vector<std::size_t> open_;
    std::string texts_;
    std::size_t key_ = 0;
    std::size_t key_size_ = 0;
};

/// A value inside a document, and the way that leads to it.
class Value {
  public:
    explicit Value(const Document& document) : Value(document, 0, nullptr, 0) {}

    Kind kind() const { return node().kind; }
    std::size_t index() const { return index_; }

    std::string text() const {
        expect(Kind::string, "str");
        return std::string(document_->text(node().text), node().size);
    }

    /// Which of `known` the string is.
    std::size_t word(const Words& known, const char* problem = "Invalid enum value") const {
        const std::string given = text();
        for (std::size_t n = 0; n < known.size; ++n) {
            if (given == known.begin[n]) {
                return n;
            }
        }
        fail(problem + (" '" + given) + "'");
    }

    bool boolean() const {
        expect(Kind::boolean, "bool");
        return node().integer != 0;
    }

    std::int64_t integer() const {
        if (kind() == Kind::too_large) {
            fail("Expected a 64-bit `int`");
        }
        expect(Kind::integer, "int");
        return node().integer;
    }

    /// Whatever stands there, as a tree.
    nlohmann::json tree() const {
        switch (kind()) {
            case Kind::null:
                return nullptr;
            case Kind::boolean:
                return boolean();
            case Kind::integer:
                return integer();
            case Kind::too_large:
                return static_cast<std::uint64_t>(node().integer);
            case Kind::floating: {
                double value = 0;
                std::memcpy(&value, &node().integer, sizeof value);
                return value;
            }
            case Kind::string:
                return text();
            case Kind::array: {
                nlohmann::json all = nlohmann::json::array();
                for_each_element([&all](const Value& value) { all.push_back(value.tree()); });
                return all;
            }
            case Kind::object: {
                nlohmann::json all = nlohmann::json::object();
                for_each_member([&all](const Value& value) { all[value.key()] = value.tree(); });
                return all;
            }
        }
        return nullptr;
    }

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
        expect(Kind::array, "array");
        std::size_t at = index_ + 1;
        for (std::size_t n = 0; n < node().size; ++n) {
            visit(Value(*document_, at, this, n));
            at = document_->node(at).next;
        }
    }

    /// Calls `visit(value)` for each member of the object; its name is `value.key()`.
    template <class Visit>
    void for_each_member(Visit visit) const {
        expect(Kind::object, "object");
        std::size_t at = index_ + 1;
        for (std::size_t n = 0; n < node().size; ++n) {
            visit(Value(*document_, at, this, IS_MEMBER));
            at = document_->node(at).next;
        }
    }

    std::string key() const { return std::string(document_->text(node().key), node().key_size); }
    bool has_key(const char* name) const { return equal(document_->text(node().key), node().key_size, name); }

    [[noreturn]] void fail(const std::string& what) const {
        const std::string where = path();
        throw ProtocolError(where == "$" ? what : what + " - at `" + where + "`");
    }

    void expect(Kind wanted, const char* name) const {
        if (kind() != wanted) {
            fail(std::string("Expected `") + name + "`, got `" + name_of(kind()) + "`");
        }
    }

  private:
    friend class Fields;
    static const std::size_t IS_MEMBER = static_cast<std::size_t>(-1);

    Value(const Document& document, std::size_t index, const Value* parent, std::size_t position)
        : document_(&document), index_(index), parent_(parent), position_(position) {}

    static bool equal(const char* text, std::size_t size, const char* other) {
        return std::strlen(other) == size && std::memcmp(text, other, size) == 0;
    }

    const Document::Node& node() const { return document_->node(index_); }

    std::string path() const {
        if (parent_ == nullptr) {
            return "$";
        }
        return parent_->path() + (position_ == IS_MEMBER ? "." + key() : "[" + std::to_string(position_) + "]");
    }

    const Document* document_;
    std::size_t index_;
    const Value* parent_;  // on the stack of the caller: a value must not outlive the visit it was made for
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
    if (kind == Kind::null || kind == Kind::floating || kind == Kind::object) {
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
        into.emplace_back(member.key(), member.kind() == Kind::too_large ? member.tree() : nlohmann::json(member.integer()));
    });
}

inline void read_key(const Value& member, std::string& into) { into = member.key(); }

template <class Enumeration>
void read_key(const Value& member, Enumeration& into) {
    const Words known = words_of(into);
    for (std::size_t n = 0; n < known.size; ++n) {
        if (member.has_key(known.begin[n])) {
            into = static_cast<Enumeration>(n);
            return;
        }
    }
    member.fail("Invalid enum value '" + member.key() + "'");
}

/// Of members of the same name the last one counts.
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

/// The members of one object, each to be asked for by name; `end` complains of those that nobody asked for.
class Fields {
  public:
    explicit Fields(const Value& object) : object_(object) { object.expect(Kind::object, "object"); }

    /// Reads the member if it is there, `how` as the functions `read` take it. Was it?
    template <class T, class... How>
    bool optional(const char* name, T& into, How... how) {
        const std::size_t found = find(name);
        if (found != 0) {
            read(member(found), into, how...);
        }
        return found != 0;
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
        const std::size_t found = find(name);
        const bool given = found != 0 && member(found).kind() != Kind::null;
        if (given) {
            read(member(found), into);
        }
        return given;
    }

    /// To be called when all members that the protocol knows have been asked for.
    void end() const {
        if (taken_ == object_.node().size) {
            return;
        }
        object_.for_each_member([this](const Value& member) {
            for (std::size_t n = 0; n < asked_; ++n) {
                if (member.has_key(known_[n])) {
                    return;
                }
            }
            object_.fail("Object contains unknown field `" + member.key() + "`");
        });
    }

  private:
    // where the member stands, or 0; of members of the same name the last one counts
    std::size_t find(const char* name) {
        std::size_t at = object_.index_ + 1;
        std::size_t found = 0;
        for (std::size_t n = 0; n < object_.node().size; ++n) {
            if (member(at).has_key(name)) {
                found = at;
                ++taken_;
            }
            at = object_.document_->node(at).next;
        }
        known_[asked_++] = name;
        return found;
    }

    Value member(std::size_t at) const { return Value(*object_.document_, at, &object_, Value::IS_MEMBER); }

    const Value& object_;
    std::size_t taken_ = 0;
    std::size_t asked_ = 0;
    const char* known_[16];  // more than any object of the protocol has
};

}  // namespace json
}  // namespace ucm_cts

#endif
