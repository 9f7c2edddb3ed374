// A framework in the shape of 12.10 whose structures are classes with accessors (13.2.1), and whose port elements are named in
// another way. One container, one connection a component, and hardly a check.
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <ucm_cts/main.hpp>
#include <ucm_cts/shaped.hpp>

namespace accessors {

struct NOT_FOUND {};
struct BAD_PARAMETER {};
struct UCM_ERROR {};

struct PortElementObject {
    virtual ~PortElementObject() = default;
};
typedef std::shared_ptr<PortElementObject> Element;

// a structure as IDL to C++11 maps it
class PortConnection {
  public:
    PortConnection() = default;
    PortConnection(std::string port, std::vector<Element> to) : from_port_(std::move(port)), to_port_(std::move(to)) {}
    const std::string& from_port() const { return from_port_; }
    std::string& from_port() { return from_port_; }
    void from_port(const std::string& value) { from_port_ = value; }
    const std::vector<Element>& to_port() const { return to_port_; }
    std::vector<Element>& to_port() { return to_port_; }
    void to_port(const std::vector<Element>& value) { to_port_ = value; }

  private:
    std::string from_port_;
    std::vector<Element> to_port_;
};

// the template of 13.7 with accessors
struct TypedConnection {
    const std::string& port_name() const;
    const Element& ref() const;
};

template <int N>
using Rank = ucm_cts::detail::Rank<N>;
static_assert(std::is_same<decltype(ucm_cts::detail::port_of(TypedConnection(), Rank<3>())), std::string>::value &&
                  std::is_same<decltype(ucm_cts::detail::references_of(TypedConnection(), Rank<3>())),
                               const Element&>::value,
              "its accessors are found");

// without a constructor of all fields
class Property {
  public:
    const std::string& name() const { return name_; }
    std::string& name() { return name_; }
    void name(const std::string& value) { name_ = value; }
    const std::string& value() const { return value_; }
    std::string& value() { return value_; }
    void value(const std::string& value) { value_ = value; }

  private:
    std::string name_;
    std::string value_;
};
typedef std::vector<Property> Properties;

// without functions that set
class Reachable {
  public:
    const std::string& name() const { return name_; }
    std::string& name() { return name_; }
    const std::string& value() const { return value_; }
    std::string& value() { return value_; }

  private:
    std::string name_;
    std::string value_;
};

struct ComponentObject {
    virtual ~ComponentObject() = default;
    virtual void on_init() = 0;
    virtual void on_remove() = 0;
    virtual void on_startup(const std::vector<PortConnection>& dependencies) = 0;
    virtual void on_shutdown() = 0;
    virtual Element get_portElement(const std::string& provided) = 0;
};

struct Container;

struct FragmentObject {
    virtual ~FragmentObject() = default;
    virtual void set_container_interface(const std::shared_ptr<Container>& container) = 0;
};

struct Connectable {
    virtual ~Connectable() = default;
    virtual void on_connect(const std::string& port_name, const Element& required) = 0;
    virtual void on_disconnect(const std::string& port_name) = 0;
};

struct Container {
    typedef ucm_cts::ShapedImplementation<struct Traits> Known;

    int add_component(const Properties& configuration);
    void remove_component(int id) {
        bodies.at(id)->on_remove();
        bodies.erase(id);
    }
    Element get_port_element(int id, const std::string& port) { return bodies.at(id)->get_portElement(port); }
    int connect(int id, const std::string& port, const Element& to) {
        connections[id] = PortConnection(port, {to});
        return id;
    }
    void disconnect(int id) { connections.erase(id); }
    void start() {
        for (const auto& each : bodies) {
            const auto connection = connections.find(each.first);
            each.second->on_startup(connection != connections.end() ? std::vector<PortConnection>{connection->second}
                                                                    : std::vector<PortConnection>());
        }
    }
    void stop() {
        for (const auto& each : bodies) {
            each.second->on_shutdown();
        }
    }
    std::vector<int> get_components() const { return {}; }

    std::vector<Known> known;
    std::map<int, std::shared_ptr<ComponentObject>> bodies;
    std::map<int, PortConnection> connections;
};

struct ContainerManager : Container {
    std::shared_ptr<Container> create_container(const Properties&) { throw UCM_ERROR(); }
    void remove_container(const std::shared_ptr<Container>&) { throw NOT_FOUND(); }
    void destroy() { bodies.clear(); }
};

struct Traits {
    typedef accessors::PortElementObject PortElementObject;
    typedef accessors::ComponentObject ComponentObject;
    typedef accessors::FragmentObject FragmentObject;
    typedef accessors::Connectable Connectable;
    typedef accessors::Container Container;
    typedef accessors::ContainerManager ContainerManager;
    typedef accessors::NOT_FOUND NOT_FOUND;
    typedef accessors::BAD_PARAMETER BAD_PARAMETER;
    typedef accessors::UCM_ERROR UCM_ERROR;

    static std::shared_ptr<ContainerManager> create_runtime(const std::vector<Container::Known>& implementations) {
        const auto manager = std::make_shared<ContainerManager>();
        manager->known = implementations;
        return manager;
    }

    static Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        const auto same = ucm_cts::properties<std::vector<Reachable>>("type", implementation, attributes);
        const auto made = ucm_cts::properties<Properties>("type", implementation, attributes);
        for (std::size_t index = 0; index < made.size(); ++index) {
            if (same.at(index).name() != made[index].name() || same.at(index).value() != made[index].value()) {
                throw std::logic_error("the properties differ");
            }
        }
        return made;
    }

    static std::string port_element_name() { return "{element} of {port}"; }
};

inline int Container::add_component(const Properties& configuration) {
    for (const Known& one : known) {
        if (one.name == configuration.at(0).value()) {
            const int id = static_cast<int>(bodies.size()) + 1;
            bodies[id] = one.create();
            for (std::size_t index = 1; index < configuration.size(); ++index) {
                one.set_attribute(*bodies[id], configuration[index].name(), configuration[index].value());
            }
            bodies[id]->on_init();
            return id;
        }
    }
    throw UCM_ERROR();
}

}  // namespace accessors

UCM_CTS_ADAPTER(ucm_cts::ShapedAdapter<accessors::Traits>, "accessor classes", "1.0");
