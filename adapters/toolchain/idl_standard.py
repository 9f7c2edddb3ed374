"""The declarations that clause 12 prints, which all generated IDL includes: annotations (14), the container programming model
(12.10) and the interfaces of standard policies (12.11).
"""

from __future__ import annotations

from collections.abc import Iterator

Operation = tuple[str, str, dict[str, str], tuple[str, ...]]
"""What it returns, its name, its parameters (all of them IN) with their types, and what it raises."""

_NOT_FOUND, _BAD, _ERROR = "NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"
_WIDTH = 110

CONTAINER_MODEL: tuple[tuple[str, tuple[Operation, ...]], ...] = (
    (
        "ComponentObject",
        (
            ("void", "on_init", {}, ()),
            ("void", "on_remove", {}, ()),
            ("void", "on_startup", {"dependencies": "PortConnections"}, ()),
            ("void", "on_shutdown", {}, ()),
            ("PortElementObject", "get_portElement", {"provided": "string"}, ()),
        ),
    ),
    ("Container", ()),
    ("FragmentObject", (("void", "set_container_interface", {"container_interface": "Container"}, ()),)),
    (
        "Connectable",
        (
            ("void", "on_connect", {"port_name": "string", "required": "PortElementObject"}, ()),
            ("void", "on_disconnect", {"port_name": "string"}, ()),
        ),
    ),
    (
        "Container",
        (
            ("componentId", "add_component", {"configValues": "Properties"}, (_ERROR,)),
            ("void", "remove_component", {"comp_instance": "componentId"}, (_NOT_FOUND, _ERROR)),
            (
                "PortElementObject",
                "get_port_element",
                {"comp_instance": "componentId", "port_name": "string"},
                (_NOT_FOUND, _ERROR),
            ),
            (
                "connectionId",
                "connect",
                {"instance": "componentId", "port_name": "string", "to_port": "PortElementObject"},
                (_NOT_FOUND, _BAD, _ERROR),
            ),
            ("void", "disconnect", {"connection": "connectionId"}, (_NOT_FOUND, _ERROR)),
            ("void", "start", {}, (_ERROR,)),
            ("void", "stop", {}, (_ERROR,)),
            ("componentIds", "get_components", {}, (_ERROR,)),
        ),
    ),
    (
        "ContainerManager : Container",
        (
            ("Container", "create_container", {"configValues": "Properties"}, (_ERROR,)),
            ("void", "remove_container", {"subContainer": "Container"}, (_NOT_FOUND, _ERROR)),
            ("void", "destroy", {}, (_ERROR,)),
        ),
    ),
)
"""The interfaces of 12.10, with what they inherit; one without operations is only announced."""


def _interfaces() -> Iterator[str]:
    for name, operations in CONTAINER_MODEL:
        if operations:
            yield "\n".join([f"interface {name} {{", *map(_operation, operations), "};\n"])
        else:
            yield f"interface {name};\n"


def _operation(operation: Operation) -> str:
    result, name, parameters, raised = operation
    taken = ", ".join(f"in {kind} {parameter}" for parameter, kind in parameters.items())
    told = f"    {result} {name}({taken})"
    raises = f"raises ({', '.join(raised)})" if raised else ""
    if not raises:
        return f"{told};"
    return f"{told} {raises};" if len(told) + len(raises) < _WIDTH else f"{told}\n        {raises};"


_BEFORE = """\
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
"""

_POLICIES = """\
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

STANDARD = "\n".join((_BEFORE, *_interfaces(), _POLICIES))
