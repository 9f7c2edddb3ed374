"""The declarations of clause 12 that all generated IDL includes.

These are annotations (14), the container programming model (12.10) and the interfaces of standard policies (12.11).
"""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import indent

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
    head = f"    {result} {name}({taken})"
    raises = f"raises ({', '.join(raised)})" if raised else ""
    if not raises:
        return f"{head};"
    return f"{head} {raises};" if len(head) + len(raises) < _WIDTH else f"{head}\n        {raises};"


Declared = tuple[str, str, tuple[str, ...]]
"""A keyword, what follows it up to the body, and what stands in the body; a typedef has none."""


def _sequence(element: str, name: str) -> Declared:
    return "typedef", f"sequence<{element}> {name}", ()


_STRING = "string {}".format
_ANNOTATIONS = {
    "int8": (),
    "uint8": (),
    "MemoryFootprint": ("unsigned long max",),
    "IndexType": (_STRING("typeid"),),
    "DefaultValue": (_STRING("val"),),
}

GROUPS: tuple[tuple[Declared, ...], ...] = (
    tuple(("@annotation", name, members) for name, members in _ANNOTATIONS.items()),
    (
        ("struct", "Property", (_STRING("name"), _STRING("value"))),
        _sequence("Property", "Properties"),
        ("typedef", "long componentId", ()),
        _sequence("componentId", "componentIds"),
        ("typedef", "long connectionId", ()),
    ),
    tuple(("exception", name, ()) for name in (_NOT_FOUND, _BAD, _ERROR)),
    (("interface", "PortElementObject", ()), _sequence("PortElementObject", "PortElementObjects")),
    (
        ("struct", "PortConnection", (_STRING("from_port"), "PortElementObjects to_port")),
        _sequence("PortConnection", "PortConnections"),
    ),
)
"""The annotations, and the types and exceptions of 12.10; an empty line stands between groups."""

_PORT = " : ::PortElementObject"

_EXECUTION: tuple[Declared, ...] = (("interface", f"component_execution_intf{_PORT}", ("void run()",)),)

_SERVICES: tuple[Declared, ...] = (
    ("typedef", "unsigned long ucm_time_t", ()),
    ("typedef", "long ucm_suseconds_t", ()),
    ("typedef", "string<255> log_message_t", ()),
    ("struct", "ucm_timeval_t", ("ucm_time_t utv_sec", "ucm_suseconds_t utv_usec")),
    ("enum", "log_severity_t", ("debug", "info", "warning", "error", "fatal")),
    (
        "interface",
        f"clock_service_intf{_PORT}",
        tuple(f"void get_{which}_time(out ucm_timeval_t local_time)" for which in ("local", "synchronized")),
    ),
    (
        "interface",
        f"trace_service_intf{_PORT}",
        ("void log(in log_severity_t severity, in log_message_t message)",),
    ),
)

_NUMBER = "in timer_number_t timer_number"
_TIME = "in timeout_t"

_TIMERS: tuple[Declared, ...] = (
    ("enum", "timeout_enum_t", ("ABSOLUTE_TIME", "RELATIVE_TIME")),
    (
        "struct",
        "timeout_t",
        ("::standard_services::standard_services_api::ucm_time_t time_val", "timeout_enum_t flag"),
    ),
    ("typedef", "unsigned long timer_number_t", ()),
    ("typedef", "boolean timer_bool_t", ()),
    ("interface", f"timer_callback_intf{_PORT}", (f"void on_timeout({_TIME} time, {_NUMBER})",)),
    (
        "interface",
        f"timer_service_intf{_PORT}",
        (
            f"void start_periodic_scheduler({_NUMBER}, {_TIME} delay_time, {_TIME} rate)",
            f"void start_sporadic_scheduler({_NUMBER}, {_TIME} time)",
            f"void cancel_timer({_NUMBER})",
            f"timer_bool_t is_canceled({_NUMBER})",
        ),
    ),
)

POLICIES: tuple[tuple[str, str, tuple[Declared, ...]], ...] = (
    ("standard_execution_policies", "execution_policies_api", _EXECUTION),
    ("standard_services", "standard_services_api", _SERVICES),
    ("timer_service", "timer_contracts", _TIMERS),
)
"""The modules of 12.11, one in the other, and what they hold."""


def _policies() -> Iterator[str]:
    for outer, inner, declared in POLICIES:
        body = indent("\n".join(map(_declaration, declared)), " " * 8)
        yield f"module {outer} {{\n    module {inner} {{\n{body}\n    }};\n}};\n"


def _declaration(declared: Declared) -> str:
    keyword, head, body = declared
    if keyword == "typedef":
        return f"{keyword} {head};"
    members = ",\n".join(body) if keyword == "enum" else "\n".join(f"{member};" for member in body)
    return "\n".join((f"{keyword} {head} {{", *indent(members, " " * 4).splitlines(), "};"))


_TYPES = ("\n".join(map(_declaration, group)) + "\n" for group in GROUPS)

STANDARD = "\n".join(("#ifndef UCM_IDL\n#define UCM_IDL\n", *_TYPES, *_interfaces(), *_policies(), "#endif\n"))
