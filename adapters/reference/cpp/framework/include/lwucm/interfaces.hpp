// Interfaces (9.2.7) as data, and port elements whose methods are called by name.
#ifndef LWUCM_INTERFACES_HPP
#define LWUCM_INTERFACES_HPP

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lwucm/component.hpp"
#include "lwucm/errors.hpp"
#include "lwucm/types.hpp"
#include "lwucm/value.hpp"

namespace lwucm {

enum class Direction { in, out, inout, result };

/// A parameter of a method; that of direction `result` (RETURN) is what it returns.
struct Parameter {
    std::string name;
    Direction direction;
    TypePtr type;
};

class Method {
  public:
    /// `raises` are the structures that the method may raise as exceptions. BAD_PARAMETER if there is a parameter or an
    /// exception without type.
    Method(std::string name, std::vector<Parameter> parameters, std::vector<TypePtr> raises = std::vector<TypePtr>());

    const std::string& name() const { return name_; }
    const std::vector<Parameter>& parameters() const { return parameters_; }
    const std::vector<TypePtr>& raises() const { return raises_; }

    /// Types of what the caller sends (IN and INOUT) and of what comes back (OUT, INOUT and RETURN), in the order of
    /// declaration.
    const std::vector<TypePtr>& arguments() const { return arguments_; }
    const std::vector<TypePtr>& results() const { return results_; }

  private:
    std::string name_;
    std::vector<Parameter> parameters_;
    std::vector<TypePtr> raises_;
    std::vector<TypePtr> arguments_;
    std::vector<TypePtr> results_;
};

class Interface;
typedef std::shared_ptr<const Interface> InterfacePtr;

/// Methods by name: its own, and those of the interfaces that it inherits.
class Interface {
  public:
    /// BAD_PARAMETER if two methods have the same name and are not the same.
    explicit Interface(const std::vector<Method>& own, const std::vector<InterfacePtr>& inherited = {});

    const std::map<std::string, Method>& methods() const { return methods_; }

    /// BAD_PARAMETER if there is no such method.
    const Method& method(const std::string& name) const;

  private:
    void add(const Method& method);

    std::map<std::string, Method> methods_;
};

/// Do both declare the same, part by part, names included?
bool operator==(const Parameter& one, const Parameter& other);
bool operator==(const Method& one, const Method& other);

/// Do both have the same methods?
bool same_interface(const Interface& one, const Interface& other);

/// An exception that the called method declares.
class DeclaredException : public Exception {
  public:
    explicit DeclaredException(const std::string& its_name, Values its_fields = Values())
        : Exception(its_name), name(its_name), fields(std::move(its_fields)) {}

    std::string name;
    Values fields;
};

/// A port element that code can call which knows its interface at run time only. Generated code derives its typed port
/// elements from it, and binds typed references to it.
class DynamicPortElement : public PortElementObject {
  public:
    /// Never null.
    virtual const InterfacePtr& get_interface() const = 0;

    /// Calls a method with its IN and INOUT values; returns those of OUT, INOUT and RETURN. Throws DeclaredException.
    virtual Values call(const std::string& method, const Values& arguments) = 0;
};

}  // namespace lwucm

#endif
