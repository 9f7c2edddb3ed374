"""What 12.10 and 12.11 declare apart from any model, each declaration with its requirement.

Slips of the printing are mended (interpretation standard-idl). Parameters have no names here, since those are free.
"""

from __future__ import annotations

import msgspec

from ucm_cts.reference_models.mapping.idl import declarations as idl


class Standard(msgspec.Struct, frozen=True):
    """A declaration, whose requirement it is, and the modules around it, the outermost first."""

    requirement: str
    modules: tuple[str, ...]
    declaration: idl.Declaration

    @property
    def wrapped(self) -> idl.Declaration:
        """The declaration inside its modules."""
        whole = self.declaration
        for name in reversed(self.modules):
            whole = idl.Module(name=name, body=(whole,))
        return whole


_BASIC = {name: idl.Basic(name) for name in ("void", "boolean", "long", "unsigned long")}
_NOT_FOUND, _BAD, _ERROR = "NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"
_OBJECT = "PortElementObject"


def _type(name: str) -> idl.Type:
    if name == "string":
        return idl.Text()
    return _BASIC.get(name) or idl.Named(name)


def _alias(name: str, type_: str | idl.Type) -> idl.Typedef:
    return idl.Typedef(name=name, type=_type(type_) if isinstance(type_, str) else type_)


def _struct(name: str, /, **members: str) -> idl.Struct:
    return idl.Struct(name=name, members=tuple(idl.Member(name=m, type=_type(t)) for m, t in members.items()))


def _enum(name: str, *values: str) -> idl.Enum:
    return idl.Enum(name=name, enumerators=tuple(idl.Enumerator(name=value) for value in values))


def _operation(
    name: str, *taken: str, out: tuple[str, ...] = (), returns: str = "void", raises: tuple[str, ...] = ()
) -> idl.Operation:
    """``taken`` are types, or types and names where only the name tells two parameters apart."""
    split = [one.partition(" ") for one in taken]
    parameters = [idl.Parameter(name=named, direction="in", type=_type(type_)) for type_, _, named in split]
    parameters += [idl.Parameter(name="", direction="out", type=_type(one)) for one in out]
    return idl.Operation(name=name, returns=_type(returns), parameters=tuple(parameters), raises=raises)


def _interface(name: str, *operations: idl.Operation, base: str = "") -> idl.Interface:
    return idl.Interface(name=name, bases=(base,) if base else (), body=operations)


_CONTAINER_MODEL: tuple[tuple[str, idl.Declaration], ...] = (
    ("R-12.10-29", _struct("Property", name="string", value="string")),
    ("R-12.10-29", _alias("Properties", idl.SequenceOf(idl.Named("Property")))),
    ("R-12.10-30", _alias("componentId", "long")),
    ("R-12.10-30", _alias("componentIds", idl.SequenceOf(idl.Named("componentId")))),
    ("R-12.10-30", _alias("connectionId", "long")),
    *(("R-12.10-31", idl.Exception_(name=name)) for name in (_NOT_FOUND, _BAD, _ERROR)),
    ("R-12.10-32", _interface(_OBJECT)),
    ("R-12.10-32", _alias("PortElementObjects", idl.SequenceOf(idl.Named(_OBJECT)))),
    ("R-12.10-33", _struct("PortConnection", from_port="string", to_port="PortElementObjects")),
    ("R-12.10-33", _alias("PortConnections", idl.SequenceOf(idl.Named("PortConnection")))),
    (
        "R-12.10-34",
        _interface(
            "ComponentObject",
            _operation("on_init"),
            _operation("on_remove"),
            _operation("on_startup", "PortConnections"),
            _operation("on_shutdown"),
            _operation("get_portElement", "string", returns=_OBJECT),
        ),
    ),
    ("R-12.10-35", _interface("FragmentObject", _operation("set_container_interface", "Container"))),
    (
        "R-12.10-36",
        _interface("Connectable", _operation("on_connect", "string", _OBJECT), _operation("on_disconnect", "string")),
    ),
    (
        "R-12.10-37",
        _interface(
            "Container",
            _operation("add_component", "Properties", returns="componentId", raises=(_ERROR,)),
            _operation("remove_component", "componentId", raises=(_NOT_FOUND, _ERROR)),
            _operation("get_port_element", "componentId", "string", returns=_OBJECT, raises=(_NOT_FOUND, _ERROR)),
            _operation(
                "connect", "componentId", "string", _OBJECT, returns="connectionId", raises=(_NOT_FOUND, _BAD, _ERROR)
            ),
            _operation("disconnect", "connectionId", raises=(_NOT_FOUND, _ERROR)),
            _operation("start", raises=(_ERROR,)),
            _operation("stop", raises=(_ERROR,)),
            _operation("get_components", returns="componentIds", raises=(_ERROR,)),
        ),
    ),
    (
        "R-12.10-38",
        _interface(
            "ContainerManager",
            _operation("create_container", "Properties", returns="Container", raises=(_ERROR,)),
            _operation("remove_container", "Container", raises=(_NOT_FOUND, _ERROR)),
            _operation("destroy", raises=(_ERROR,)),
            base="Container",
        ),
    ),
)

_EXECUTION: tuple[tuple[str, idl.Declaration], ...] = (
    ("R-12.11.1-01", _interface("component_execution_intf", _operation("run"))),
)

_SERVICES: tuple[tuple[str, idl.Declaration], ...] = (
    ("R-12.11.2-01", _alias("ucm_time_t", "unsigned long")),
    ("R-12.11.2-02", _alias("ucm_suseconds_t", "long")),
    ("R-12.11.2-03", _alias("log_message_t", idl.Text(bound=idl.Literal("integer", "255")))),
    ("R-12.11.2-04", _struct("ucm_timeval_t", utv_sec="ucm_time_t", utv_usec="ucm_suseconds_t")),
    ("R-12.11.2-05", _enum("log_severity_t", "debug", "info", "warning", "error", "fatal")),
    (
        "R-12.11.2-06",
        _interface(
            "clock_service_intf",
            _operation("get_local_time", out=("ucm_timeval_t",)),
            _operation("get_synchronized_time", out=("ucm_timeval_t",)),
            base=_OBJECT,
        ),
    ),
    (
        "R-12.11.2-07",
        _interface("trace_service_intf", _operation("log", "log_severity_t", "log_message_t"), base=_OBJECT),
    ),
)

_TIMERS: tuple[tuple[str, idl.Declaration], ...] = (
    ("R-12.11.3-01", _enum("timeout_enum_t", "ABSOLUTE_TIME", "RELATIVE_TIME")),
    (
        "R-12.11.3-02",
        _struct("timeout_t", time_val="standard_services::standard_services_api::ucm_time_t", flag="timeout_enum_t"),
    ),
    ("R-12.11.3-03", _alias("timer_number_t", "unsigned long")),
    ("R-12.11.3-03", _alias("timer_bool_t", "boolean")),
    (
        "R-12.11.3-04",
        _interface("timer_callback_intf", _operation("on_timeout", "timeout_t", "timer_number_t"), base=_OBJECT),
    ),
    (
        "R-12.11.3-05",
        _interface(
            "timer_service_intf",
            _operation(
                "start_periodic_scheduler", "timer_number_t timer_number", "timeout_t delay_time", "timeout_t rate"
            ),
            _operation("start_sporadic_scheduler", "timer_number_t", "timeout_t"),
            _operation("cancel_timer", "timer_number_t"),
            _operation("is_canceled", "timer_number_t", returns="timer_bool_t"),
            base=_OBJECT,
        ),
    ),
)

_MODULES = {
    (): _CONTAINER_MODEL,
    ("standard_execution_policies", "execution_policies_api"): _EXECUTION,
    ("standard_services", "standard_services_api"): _SERVICES,
    ("timer_service", "timer_contracts"): _TIMERS,
}

STANDARD = tuple(
    Standard(requirement, modules, declaration)
    for modules, declared in _MODULES.items()
    for requirement, declaration in declared
)
"""All of them."""
