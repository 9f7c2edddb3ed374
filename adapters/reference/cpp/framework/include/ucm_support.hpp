#ifndef UCM_SUPPORT_HPP
#define UCM_SUPPORT_HPP

#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace UCM {

/// Root of all exceptions (13.4).
class Exception : public ::std::exception {
  public:
    virtual ~Exception() noexcept {}
    virtual void _raise() const = 0;
    virtual const char* _name() const = 0;
    virtual const char* what() const noexcept { return _name(); }
};

/// Root of the exceptions that models declare.
class UserException : public Exception {
  public:
    virtual ~UserException() noexcept {}
};

/// Root of the exceptions of the platform at run time.
class SystemException : public Exception {
  public:
    virtual ~SystemException() noexcept {}
};

}  // namespace UCM

namespace ucm {

/// What interfaces of port elements derive from (13.8).
class PortElementObject {
  public:
    virtual ~PortElementObject() {}
};

/// A required port element and what it is connected to (13.7).
template <class T>
struct PortConnection {
    ::std::string port_name;
    ::std::shared_ptr<T> ref;

    PortConnection(::std::string name, ::std::shared_ptr<T> reference) : port_name(name), ref(reference) {}
};

}  // namespace ucm

#endif
