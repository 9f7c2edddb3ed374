// Values of UCM data types, as code sees them that does not know the types when it is compiled.
#ifndef LWUCM_VALUE_HPP
#define LWUCM_VALUE_HPP

#include <cstdint>
#include <cstring>
#include <cstring>
#include <string>
#include <vector>

namespace lwucm {

/// The `To` that has the bits of `from`, which has the same size.
template <class To, class From>
To same_bits(const From& from) {
    static_assert(sizeof(To) == sizeof(From), "the sizes differ");
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

class Value;
typedef std::vector<Value> Values;

/// A value of one of the shapes that data types have. It says nothing of its type: an integer of any kind is an
/// `integer` (beyond 2^63-1 a `natural`), characters and strings hold code points, structures, arrays (dimension by
/// dimension) and sequences are a `list`, and so are unions: enumerator, then the value of the case that it selects, if
/// it has one.
class Value {
  public:
    enum class Kind { boolean, integer, natural, single, real, character, string, enumerator, list };

    Value() = default;
    static Value boolean(bool value);
    static Value integer(std::int64_t value);
    static Value natural(std::uint64_t value);
    static Value single(float value);
    static Value real(double value);
    static Value character(char32_t value);
    static Value string(std::u32string value);
    static Value enumerator(std::string name);
    static Value list(Values items = Values());

    Kind kind() const { return kind_; }

    // What the value holds; BAD_PARAMETER if it is not of that kind. An integer that is not negative is a natural, too.
    bool as_boolean() const;
    std::int64_t as_integer() const;
    std::uint64_t as_natural() const;
    float as_single() const;
    double as_real() const;
    char32_t as_character() const;
    const std::u32string& as_string() const;
    const std::string& as_enumerator() const;
    const Values& as_list() const;

    /// Floats are the same if their bits are.
    friend bool operator==(const Value& one, const Value& other);

  private:
    Value(Kind kind, std::uint64_t bits) : kind_(kind), bits_(bits) {}

    void expect(Kind kind, const char* what) const;

    Kind kind_ = Kind::list;
    std::uint64_t bits_ = 0;
    std::u32string string_;
    std::string name_;
    Values items_;
};

inline bool operator!=(const Value& one, const Value& other) { return !(one == other); }

}  // namespace lwucm

#endif
