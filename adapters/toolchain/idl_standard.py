"""The declarations that clause 12 prints, which all generated IDL includes: annotations (14), the container programming model
(12.10) and the interfaces of standard policies (12.11).
"""

STANDARD = """\
#ifndef UCM_IDL
#define UCM_IDL

@annotation int8 {
};
@annotation uint8 {
};
@annotation MemoryFootprint {
    unsigned long max;
};
@annotation IndexType {
    string typeid;
};
@annotation DefaultValue {
    string val;
};

struct Property {
    string name;
    string value;
};
typedef sequence<Property> Properties;
typedef long componentId;
typedef sequence<componentId> componentIds;
typedef long connectionId;

exception NOT_FOUND {
};
exception BAD_PARAMETER {
};
exception UCM_ERROR {
};

interface PortElementObject {
};
typedef sequence<PortElementObject> PortElementObjects;

struct PortConnection {
    string from_port;
    PortElementObjects to_port;
};
typedef sequence<PortConnection> PortConnections;

interface ComponentObject {
    void on_init();
    void on_remove();
    void on_startup(in PortConnections dependencies);
    void on_shutdown();
    PortElementObject get_portElement(in string provided);
};

interface Container;

interface FragmentObject {
    void set_container_interface(in Container container_interface);
};

interface Connectable {
    void on_connect(in string port_name, in PortElementObject required);
    void on_disconnect(in string port_name);
};

interface Container {
    componentId add_component(in Properties configValues) raises (UCM_ERROR);
    void remove_component(in componentId comp_instance) raises (NOT_FOUND, UCM_ERROR);
    PortElementObject get_port_element(in componentId comp_instance, in string port_name)
        raises (NOT_FOUND, UCM_ERROR);
    connectionId connect(in componentId instance, in string port_name, in PortElementObject to_port)
        raises (NOT_FOUND, BAD_PARAMETER, UCM_ERROR);
    void disconnect(in connectionId connection) raises (NOT_FOUND, UCM_ERROR);
    void start() raises (UCM_ERROR);
    void stop() raises (UCM_ERROR);
    componentIds get_components() raises (UCM_ERROR);
};

interface ContainerManager : Container {
    Container create_container(in Properties configValues) raises (UCM_ERROR);
    void remove_container(in Container subContainer) raises (NOT_FOUND, UCM_ERROR);
    void destroy() raises (UCM_ERROR);
};

module standard_execution_policies {
    module execution_policies_api {
        interface component_execution_intf : ::PortElementObject {
            void run();
        };
    };
};

module standard_services {
    module standard_services_api {
        typedef unsigned long ucm_time_t;
        typedef long ucm_suseconds_t;
        typedef string<255> log_message_t;
        struct ucm_timeval_t {
            ucm_time_t utv_sec;
            ucm_suseconds_t utv_usec;
        };
        enum log_severity_t {
            debug,
            info,
            warning,
            error,
            fatal
        };
        interface clock_service_intf : ::PortElementObject {
            void get_local_time(out ucm_timeval_t local_time);
            void get_synchronized_time(out ucm_timeval_t local_time);
        };
        interface trace_service_intf : ::PortElementObject {
            void log(in log_severity_t severity, in log_message_t message);
        };
    };
};

module timer_service {
    module timer_contracts {
        enum timeout_enum_t {
            ABSOLUTE_TIME,
            RELATIVE_TIME
        };
        struct timeout_t {
            ::standard_services::standard_services_api::ucm_time_t time_val;
            timeout_enum_t flag;
        };
        typedef unsigned long timer_number_t;
        typedef boolean timer_bool_t;
        interface timer_callback_intf : ::PortElementObject {
            void on_timeout(in timeout_t time, in timer_number_t timer_number);
        };
        interface timer_service_intf : ::PortElementObject {
            void start_periodic_scheduler(in timer_number_t timer_number, in timeout_t delay_time, in timeout_t rate);
            void start_sporadic_scheduler(in timer_number_t timer_number, in timeout_t time);
            void cancel_timer(in timer_number_t timer_number);
            timer_bool_t is_canceled(in timer_number_t timer_number);
        };
    };
};

#endif
"""
