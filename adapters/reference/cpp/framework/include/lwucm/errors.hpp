// The three exceptions of 12.10, and their common root.
#ifndef LWUCM_ERRORS_HPP
#define LWUCM_ERRORS_HPP

#include <stdexcept>
#include <string>

namespace lwucm {

/// Root of everything that leaves an operation of this runtime.
class Exception : public std::runtime_error {
  public:
    explicit Exception(const std::string& why) : std::runtime_error(why) {}
};

class NOT_FOUND : public Exception {
  public:
    explicit NOT_FOUND(const std::string& why) : Exception(why) {}
};

class BAD_PARAMETER : public Exception {
  public:
    explicit BAD_PARAMETER(const std::string& why) : Exception(why) {}
};

class UCM_ERROR : public Exception {
  public:
    explicit UCM_ERROR(const std::string& why) : Exception(why) {}
};

}  // namespace lwucm

#endif
