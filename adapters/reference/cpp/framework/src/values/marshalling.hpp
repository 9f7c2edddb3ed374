// Values as bytes: how connectors send them. Little endian, each number at a multiple of its size, lengths as ULONG.
#ifndef LWUCM_SRC_MARSHALLING_HPP
#define LWUCM_SRC_MARSHALLING_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lwucm/types.hpp"
#include "lwucm/value.hpp"

namespace lwucm {

typedef std::vector<std::uint8_t> Bytes;

class Writer {
  public:
    /// Appends a number of `size` bytes.
    void number(std::uint64_t bits, std::size_t size);

    void text(const std::string& characters);

    /// Appends `value`. BAD_PARAMETER if it is not a value of `type`.
    void value(const Type& type, const Value& value);

    /// Appends one value of each type. BAD_PARAMETER also if there are more or fewer values than types.
    void values(const std::vector<TypePtr>& types, const Values& values);

    /// BAD_PARAMETER if they are not the values of a structure's fields.
    void fields(const Type& structure, const Values& values);

    Bytes take() { return std::move(bytes_); }

  private:
    void characters(const Type& type, const std::u32string& text);
    void dimension(const Type& type, std::size_t depth, const Value& value);

    Bytes bytes_;
};

/// Reads in the order of writing. UCM_ERROR where the bytes are not what a Writer makes of the type.
class Reader {
  public:
    explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

    std::uint64_t number(std::size_t size);
    std::string text();
    Value value(const Type& type);
    Values values(const std::vector<TypePtr>& types);
    Values fields(const Type& structure);

    /// UCM_ERROR if something is left.
    void end() const;

  private:
    std::size_t length(std::int64_t bound, std::size_t least_size);
    Value characters(const Type& type);
    Value dimension(const Type& type, std::size_t depth);

    const Bytes& bytes_;
    std::size_t at_ = 0;
};

}  // namespace lwucm

#endif
