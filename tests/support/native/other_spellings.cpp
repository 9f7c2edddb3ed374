// A framework in the shape of 12.10 that takes every freedom ShapedAdapter allows: strings by value, FragmentObject
// extends ComponentObject (11.2.1.4), PortConnection as in 13.7, exceptions that are no std::exception, wider ids,
// raw pointers to containers, const and noexcept operations. One container, and hardly a check.
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <ucm_cts/main.hpp>
#include <ucm_cts/shaped.hpp>

namespace other {

struct NOT_FOUND {};
struct BAD_PARAMETER {};
struct UCM_ERROR {};

struct PortElementObject {
    virtual ~PortElementObject() = default;
};
typedef std::shared_ptr<PortElementObject> Element;

struct PortConnection {
    std::string port_name;
    Element ref;
};

class Container;

struct ComponentObject {
    virtual ~ComponentObject() = default;
    virtual void on_init() = 0;
    virtual void on_remove() = 0;
    virtual void on_startup(std::list<PortConnection> dependencies) = 0;
    virtual void on_shutdown() = 0;
    virtual Element get_portElement(std::string provided) = 0;
};

struct FragmentObject : ComponentObject {
    virtual void set_container_interface(Container* container) = 0;
};

struct Connectable {
    virtual ~Connectable() = default;
    virtual void on_connect(std::string port_name, const Element& required) = 0;
    virtual void on_disconnect(std::string port_name) = 0;
};

struct Property {
    std::string name;
    std::string value;
};
typedef std::list<Property> Properties;

class Container {
  public:
    typedef ucm_cts::ShapedImplementation<struct Traits> Known;

    void know(const Known& known);
    long add_component(Properties configuration);
    void remove_component(long id) {
        member(id).body->on_remove();
        members_.erase(id);
    }
    Element get_port_element(long id, const std::string& port) const {
        const Element element = member(id).body->get_portElement(port);
        return element ? element : throw NOT_FOUND();
    }
    long connect(long id, std::string port, Element to) {
        if (!to) {
            throw BAD_PARAMETER();
        }
        member(id).connections.push_back(PortConnection{port, to});
        if (Connectable* const connectable = dynamic_cast<Connectable*>(member(id).body.get())) {
            connectable->on_connect(port, to);
        }
        return id;  // one connection an instance will do
    }
    void disconnect(long id) {
        const std::string port = member(id).connections.back().port_name;
        member(id).connections.pop_back();
        if (Connectable* const connectable = dynamic_cast<Connectable*>(member(id).body.get())) {
            connectable->on_disconnect(port);
        }
    }
    void start() {
        for (auto& each : members_) {
            each.second.body->on_startup(each.second.connections);
        }
    }
    void stop() {
        for (auto& each : members_) {
            each.second.body->on_shutdown();
        }
    }
    std::list<long> get_components() const noexcept {
        std::list<long> ids;
        for (const auto& each : members_) {
            ids.push_back(each.first);
        }
        return ids;
    }

  protected:
    struct Member {
        std::shared_ptr<ComponentObject> body;
        std::list<PortConnection> connections;
    };

    const Member& member(long id) const {
        const auto found = members_.find(id);
        return found != members_.end() ? found->second : throw NOT_FOUND();
    }
    Member& member(long id) { return const_cast<Member&>(static_cast<const Container*>(this)->member(id)); }

    std::vector<Known> known_;
    std::map<long, Member> members_;
    long last_ = 1L << 40;  // not what 12.10 has, and the suite will say so
};

class ContainerManager : public Container {
  public:
    std::shared_ptr<Container> create_container(const Properties&) { throw UCM_ERROR(); }
    void remove_container(const std::shared_ptr<Container>&) { throw NOT_FOUND(); }
    void destroy() noexcept { members_.clear(); }
};

struct Traits {
    typedef other::PortElementObject PortElementObject;
    typedef other::ComponentObject ComponentObject;
    typedef other::FragmentObject FragmentObject;
    typedef other::Connectable Connectable;
    typedef other::Container Container;
    typedef other::ContainerManager ContainerManager;
    typedef other::NOT_FOUND NOT_FOUND;
    typedef other::BAD_PARAMETER BAD_PARAMETER;
    typedef other::UCM_ERROR UCM_ERROR;

    static std::shared_ptr<ContainerManager> create_runtime(const std::vector<Container::Known>& implementations) {
        const auto manager = std::make_shared<ContainerManager>();
        for (const Container::Known& known : implementations) {
            manager->know(known);
        }
        return manager;
    }

    static Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        return ucm_cts::properties<Properties>("type", implementation, attributes);
    }
};

inline void Container::know(const Known& known) { known_.push_back(known); }

inline long Container::add_component(Properties configuration) {
    for (const Known& known : known_) {
        if (known.name == configuration.front().value) {
            const std::shared_ptr<ComponentObject> body = known.create();
            configuration.pop_front();
            for (const Property& attribute : configuration) {
                known.set_attribute(*body, attribute.name, attribute.value);
            }
            if (FragmentObject* const fragment = dynamic_cast<FragmentObject*>(body.get())) {
                fragment->set_container_interface(this);
            }
            body->on_init();
            members_[++last_] = Member{body, {}};
            return last_;
        }
    }
    throw UCM_ERROR();
}

}  // namespace other

UCM_CTS_ADAPTER(ucm_cts::ShapedAdapter<other::Traits>, "other spellings", "1.0");
