#include "values/marshalling.hpp"

#include <algorithm>

#include "lwucm/errors.hpp"

namespace lwucm {

namespace {

const std::size_t LENGTH = 4;

std::size_t size_of(IntegerKind kind) { return static_cast<std::size_t>(bits_of(kind)) / 8; }

std::size_t size_of_character(const Type& type) {
    return type.kind == Type::Kind::string8 || type.kind == Type::Kind::character8 ? 1 : 4;
}

std::uint64_t bits_of_integer(IntegerKind kind, const Value& value) {
    const int bits = bits_of(kind);
    if (!is_signed(kind)) {
        const std::uint64_t number = value.as_natural();
        if (bits < 64 && (number >> bits) != 0) {
            throw BAD_PARAMETER("the integer is too large for its type");
        }
        return number;
    }
    const std::int64_t number = value.as_integer();
    const std::int64_t limit = std::int64_t(1) << (std::min(bits, 63) - 1);
    if (bits < 64 && (number >= limit || number < -limit)) {
        throw BAD_PARAMETER("the integer is out of the range of its type");
    }
    return static_cast<std::uint64_t>(number);
}

Value integer_of_bits(IntegerKind kind, std::uint64_t bits) {
    const int count = bits_of(kind);
    if (!is_signed(kind)) {
        return Value::natural(bits);
    }
    const bool negative = ((bits >> (count - 1)) & 1) != 0;
    if (negative && count < 64) {
        bits |= ~std::uint64_t(0) << count;
    }
    return Value::integer(same_bits<std::int64_t>(bits));
}

std::uint64_t checked_character(std::size_t size, char32_t character) {
    const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    if (character > (size == 1 ? 0xFFU : 0x10FFFFU) || (size != 1 && surrogate)) {
        throw BAD_PARAMETER("a character is none of its type");
    }
    return character;
}

std::vector<TypePtr> types_of(const std::vector<Field>& fields) {
    std::vector<TypePtr> types;
    for (const Field& field : fields) {
        types.push_back(field.type);
    }
    return types;
}

const Enumerator& enumerator_called(const Type& enumeration, const std::string& name) {
    for (const Enumerator& enumerator : enumeration.enumerators) {
        if (enumerator.name == name) {
            return enumerator;
        }
    }
    throw BAD_PARAMETER(enumeration.name + " has no enumerator '" + name + "'");
}

}  // namespace

void Writer::number(std::uint64_t bits, std::size_t size) {
    bytes_.resize((bytes_.size() + size - 1) / size * size);
    for (std::size_t place = 0; place < size; ++place) {
        bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * place)));
    }
}

void Writer::text(const std::string& characters) {
    number(characters.size(), LENGTH);
    bytes_.insert(bytes_.end(), characters.begin(), characters.end());
}

void Writer::value(const Type& type, const Value& value) {
    const Type& meant = resolved(type);
    switch (meant.kind) {
        case Type::Kind::integer:
            return number(bits_of_integer(meant.integer, value), size_of(meant.integer));
        case Type::Kind::single:
            return number(same_bits<std::uint32_t>(value.as_single()), 4);
        case Type::Kind::real:
            return number(same_bits<std::uint64_t>(value.as_real()), 8);
        case Type::Kind::character8:
        case Type::Kind::character32:
            return number(checked_character(size_of_character(meant), value.as_character()), size_of_character(meant));
        case Type::Kind::boolean:
            return number(value.as_boolean() ? 1 : 0, 1);
        case Type::Kind::string8:
        case Type::Kind::string32:
            return characters(meant, value.as_string());
        case Type::Kind::enumeration:
            return number(static_cast<std::uint64_t>(enumerator_called(meant, value.as_enumerator()).value),
                          size_of(meant.integer));
        case Type::Kind::structure:
            return fields(meant, value.as_list());
        case Type::Kind::union_type: {
            const Values& parts = value.as_list();
            const Case* const active = parts.empty() ? nullptr : selected_case(meant, parts[0].as_enumerator());
            if (parts.size() != (active != nullptr ? 2U : 1U)) {
                throw BAD_PARAMETER(meant.name + " is an enumerator and the value that it selects");
            }
            this->value(*meant.of, parts[0]);
            return active != nullptr ? this->value(*active->type, parts[1]) : void();
        }
        case Type::Kind::array:
            return dimension(meant, 0, value);
        case Type::Kind::sequence: {
            const Values& items = value.as_list();
            if (meant.bound != UNBOUNDED && items.size() > static_cast<std::uint64_t>(meant.bound)) {
                throw BAD_PARAMETER("the sequence is longer than its bound");
            }
            number(items.size(), LENGTH);
            for (const Value& item : items) {
                this->value(*meant.of, item);
            }
            return;
        }
        case Type::Kind::alias:
            break;  // is resolved
    }
}

void Writer::values(const std::vector<TypePtr>& types, const Values& values) {
    if (types.size() != values.size()) {
        throw BAD_PARAMETER(std::to_string(types.size()) + " values are due, not " + std::to_string(values.size()));
    }
    for (std::size_t index = 0; index < types.size(); ++index) {
        value(*types[index], values[index]);
    }
}

void Writer::fields(const Type& structure, const Values& values) { this->values(types_of(structure.fields), values); }

void Writer::characters(const Type& type, const std::u32string& text) {
    if (type.bound != UNBOUNDED && text.size() > static_cast<std::uint64_t>(type.bound)) {
        throw BAD_PARAMETER("the string is longer than its bound");
    }
    const std::size_t size = size_of_character(type);
    number(text.size(), LENGTH);
    for (const char32_t character : text) {
        number(checked_character(size, character), size);
    }
}

void Writer::dimension(const Type& type, std::size_t depth, const Value& value) {
    if (depth == type.sizes.size()) {
        return this->value(*type.of, value);
    }
    const Values& items = value.as_list();
    if (items.size() != type.sizes[depth]) {
        throw BAD_PARAMETER("the array has " + std::to_string(type.sizes[depth]) + " elements there");
    }
    for (const Value& item : items) {
        dimension(type, depth + 1, item);
    }
}

std::uint64_t Reader::number(std::size_t size) {
    at_ = (at_ + size - 1) / size * size;
    if (at_ + size > bytes_.size()) {
        throw UCM_ERROR("what arrived is too short");
    }
    std::uint64_t bits = 0;
    for (std::size_t place = 0; place < size; ++place) {
        bits |= static_cast<std::uint64_t>(bytes_[at_ + place]) << (8 * place);
    }
    at_ += size;
    return bits;
}

std::string Reader::text() {
    const std::size_t count = length(UNBOUNDED, 1);
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += count;
    return std::string(begin, begin + static_cast<std::ptrdiff_t>(count));
}

Value Reader::value(const Type& type) {
    const Type& meant = resolved(type);
    switch (meant.kind) {
        case Type::Kind::integer:
            return integer_of_bits(meant.integer, number(size_of(meant.integer)));
        case Type::Kind::single:
            return Value::single(same_bits<float>(static_cast<std::uint32_t>(number(4))));
        case Type::Kind::real:
            return Value::real(same_bits<double>(number(8)));
        case Type::Kind::character8:
        case Type::Kind::character32:
            return Value::character(static_cast<char32_t>(number(size_of_character(meant))));
        case Type::Kind::boolean:
            return Value::boolean(number(1) != 0);
        case Type::Kind::string8:
        case Type::Kind::string32:
            return characters(meant);
        case Type::Kind::enumeration: {
            const std::size_t size = size_of(meant.integer);
            const std::uint64_t bits = number(size);
            for (const Enumerator& enumerator : meant.enumerators) {
                const std::uint64_t own = static_cast<std::uint64_t>(enumerator.value);
                if (own == bits || (size < 8 && (own & ((std::uint64_t(1) << (8 * size)) - 1)) == bits)) {
                    return Value::enumerator(enumerator.name);
                }
            }
            throw UCM_ERROR("what arrived is no enumerator of " + meant.name);
        }
        case Type::Kind::structure:
            return Value::list(fields(meant));
        case Type::Kind::union_type: {
            Values parts(1, value(*meant.of));
            const Case* const active = selected_case(meant, parts[0].as_enumerator());
            if (active != nullptr) {
                parts.push_back(value(*active->type));
            }
            return Value::list(std::move(parts));
        }
        case Type::Kind::array:
            return dimension(meant, 0);
        case Type::Kind::sequence: {
            Values items;
            const std::size_t count = length(meant.bound, 0);
            items.reserve(std::min(count, bytes_.size()));
            while (items.size() < count) {
                items.push_back(value(*meant.of));
            }
            return Value::list(std::move(items));
        }
        case Type::Kind::alias:
            break;  // is resolved
    }
    throw UCM_ERROR("there are no values of such a type");
}

Values Reader::values(const std::vector<TypePtr>& types) {
    Values result;
    result.reserve(types.size());
    for (const TypePtr& type : types) {
        result.push_back(value(*type));
    }
    return result;
}

Values Reader::fields(const Type& structure) { return values(types_of(structure.fields)); }

void Reader::end() const {
    if (at_ != bytes_.size()) {
        throw UCM_ERROR("what arrived is too long");
    }
}

std::size_t Reader::length(std::int64_t bound, std::size_t least_size) {
    const std::uint64_t count = number(LENGTH);
    if (bound != UNBOUNDED && count > static_cast<std::uint64_t>(bound)) {
        throw UCM_ERROR("what arrived is longer than its bound");
    }
    if (count * least_size > bytes_.size() - at_) {
        throw UCM_ERROR("what arrived is too short");
    }
    return static_cast<std::size_t>(count);
}

Value Reader::characters(const Type& type) {
    const std::size_t size = size_of_character(type);
    const std::size_t count = length(type.bound, size);
    std::u32string text;
    text.reserve(count);
    while (text.size() < count) {
        text.push_back(static_cast<char32_t>(number(size)));
    }
    return Value::string(std::move(text));
}

Value Reader::dimension(const Type& type, std::size_t depth) {
    if (depth == type.sizes.size()) {
        return value(*type.of);
    }
    Values items;
    items.reserve(type.sizes[depth]);
    while (items.size() < type.sizes[depth]) {
        items.push_back(dimension(type, depth + 1));
    }
    return Value::list(std::move(items));
}

}  // namespace lwucm
