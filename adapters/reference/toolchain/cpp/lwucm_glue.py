"""What lwucm, the C++ reference framework, needs to host typed bodies (13.9): a header beside the one of ``cpp11``.

It has a glue for each abstract class of component bodies, which asks the body by numbers for what lwucm asks by names, a
stand-in for each interface of their port elements, which policies of execution and trace put before port elements, and calls by
name, by which links and the services of containers reach port elements and are reached.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ucm_cts.adapters.contract.metamodel import components, contracts
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, each_element, lineage
from ucm_cts.adapters.reference.toolchain.cpp import interfaces
from ucm_cts.adapters.reference.toolchain.cpp.components import Body, Used, body_of
from ucm_cts.adapters.reference.toolchain.cpp.generator import header_name, is_ours
from ucm_cts.adapters.reference.toolchain.cpp.lwucm_calls import calls, operations, types_in
from ucm_cts.adapters.reference.toolchain.cpp.lwucm_values import conversions
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance, qualified
from ucm_cts.adapters.reference.toolchain.cpp.types import CPP11, DATA, find

SELF_EXECUTING, SELF_EXECUTION_API = "protected_self-executing_component", "self-execution_api"
"""The policy of 10.1.3 by which a component provides ``run`` to its container, and the port element that has it."""

OBJECT_TIMERS, TIMER_SCHEDULER = "ott_timer", "timer_scheduler"
"""The policy of 10.3.1 by which a component requires a scheduler, and the port element that it is."""


def generate_lwucm(model: Model) -> Mapping[str, str]:
    """The header by its path; it includes what ``generate_cpp11`` makes of the same model."""
    names = Names(model)
    bodies = [
        body_of(Declared(element, scope))
        for element, scope in each_element(model, names)
        if isinstance(element, components.AtomicComponentImplementation) and is_ours(element)
    ]
    header = header_name(model)
    guard = f"{header.upper()}_LWUCM_HPP"
    used = [one for body in bodies for one in body.used if one.interface is not None]
    stand_ins = {_class(one): _stand_in(one) for one in used if not one.of_policy}
    by_name = {_class(one): operations(one.interface, one.bindings) for one in used if one.interface is not None}
    callable_ = {class_: found for class_, found in by_name.items() if found}
    schedulers = {text: None for body in bodies for text in _schedulers(body)}
    pieces = [
        *conversions(type_ for found in callable_.values() for type_ in types_in(found)),
        *(calls(class_, found) for class_, found in callable_.items()),
        *schedulers,
        *stand_ins.values(),
        *map(_glue, bodies),
    ]
    text = (
        f"#ifndef {guard}\n#define {guard}\n\n#include <lwucm/typed.hpp>\n\n"
        f'#include "{header}.hpp"\n\nnamespace lwucm {{\n\n' + "\n".join(pieces) + "\n}\n\n#endif\n"
    )
    return {f"{header}_lwucm.hpp": text}


def _class(used: Used) -> str:
    """The abstract class of the interface of a port element that has one."""
    assert used.interface is not None
    return interfaces.qualified_class(used.interface, used.bindings)


def _stand_in(used: Used) -> str:
    assert used.interface is not None
    type_ = _class(used)
    target = f"::std::shared_ptr< {type_} >"
    lines = [
        "template <>",
        f"class {instance('TypedStandIn', type_)} final : public {type_} {{",
        "  public:",
        f"    TypedStandIn(const {target}& target, const ::std::shared_ptr<Interceptor>& interceptor)",
        "        : target_(target), interceptor_(interceptor) {}",
        *_operations(used.interface, used.bindings),
        "",
        "  private:",
        f"    const {target} target_;",
        "    const ::std::shared_ptr<Interceptor> interceptor_;",
        "};",
    ]
    return "\n".join(lines) + "\n"


def _operations(interface: Declared, bindings: interfaces.Bindings) -> Iterator[str]:
    """All functions of ``interface``, those it inherits first."""
    for one in interfaces.family(interface):
        element, scope = one.element, one.scope
        assert isinstance(element, contracts.Interface)
        for attribute in element.attributes:
            found = interfaces.resolve(attribute.type, scope, bindings)
            yield from _operation(attribute.name, interfaces.value_type(found, bindings, CPP11), [])
            if attribute.mode != "READ":
                passed = interfaces.passed(found, "IN", bindings, CPP11)
                yield from _operation(attribute.name, "void", [(passed, "value")])
        for method in element.methods:
            result, taken = "void", []
            for parameter in method.parameters:
                found = interfaces.resolve(parameter.type, scope, bindings)
                if parameter.direction == "RETURN":
                    result = interfaces.value_type(found, bindings, CPP11)
                else:
                    passed = interfaces.passed(found, parameter.direction, bindings, CPP11)
                    taken.append((passed, identifier(parameter.name)))
            yield from _operation(method.name, result, taken)


def _operation(name: str, result: str, taken: Sequence[tuple[str, str]]) -> Iterator[str]:
    parameters = ", ".join(f"{type_} {parameter}" for type_, parameter in taken)
    call = f"this->target_->{identifier(name)}({', '.join(parameter for _, parameter in taken)})"
    yield f"    {result} {identifier(name)}({parameters}) override {{"
    if result == "void":
        yield f'        this->interceptor_->call("{name}", [&] {{ {call}; }});'
    else:
        local = "result"
        while local in (parameter for _, parameter in taken):
            local += "_"
        yield f"        {result} {local} = {result}();"
        yield f'        this->interceptor_->call("{name}", [&] {{ {local} = {call}; }});'
        yield f"        return {local};"
    yield "    }"


def _glue(body: Body) -> str:
    class_ = qualified(body.declared, interfaces.PREFIX)
    provided = [u for u in body.used if u.kind == "PROVIDED" and u.interface is not None and not u.of_policy]
    lines = [
        "template <>",
        f"struct {instance('TypedGlue', class_)} {{",
        f"    typedef {class_} Body;",
        "",
        *_names(body, provided),
        *_described(provided, [u for u in body.required if not u.of_policy]),
        *_provided(provided),
        *_by_name(provided),
        *_startup(body),
        *_set_attribute(body),
        *_execution(body),
        *_policy_ports(body),
        *_intercept("intercept_provided", provided),
        *_intercept("intercept_required", [u for u in body.required if not u.of_policy]),
        "};",
    ]
    return "\n".join(lines) + "\n"


def _names(body: Body, provided: Sequence[Used]) -> Iterator[str]:
    required = [u.called for u in body.required if not u.of_policy]
    services = [u.called for u in body.required if u.of_policy]
    attributes = [a.name for a, _ in _written(body)]
    lists = ", ".join(_list(names) for names in ([u.called for u in provided], required, attributes, services))
    yield f"    static TypedNames names() {{ return {{{lists}}}; }}"


def _list(names: Sequence[str]) -> str:
    return "{" + ", ".join(f'"{name}"' for name in names) + "}"


def _written(body: Body) -> Iterator[tuple[contracts.Attribute, Declared]]:
    """The attributes that can be configured, and what their types are."""
    for ancestor in reversed(lineage(body.component_type)):
        assert isinstance(ancestor.element, components.ComponentType)
        for attribute in ancestor.element.attributes:
            if attribute.mode != "READ":
                yield attribute, find(attribute.type, ancestor.scope, *DATA)


def _choice(head: str, parameter: str, cases: Sequence[str], otherwise: str) -> Iterator[str]:
    """A function of a body and a number; ``cases`` are statements by number."""
    if not cases:
        yield f"    static {head.format(body='', n='', value='')} {{{f' {otherwise} ' if otherwise else ''}}}"
        return
    yield f"    static {head.format(body=' body', n=' n', value=parameter)} {{"
    yield "        switch (n) {"
    for number, statement in enumerate(cases):
        yield f"            case {number}: {statement}"
    yield "        }"
    if otherwise:
        yield f"        {otherwise}"
    yield "    }"


def _provided(provided: Sequence[Used]) -> Iterator[str]:
    head = "::std::shared_ptr<PortElementObject> provided(Body&{body}, ::std::size_t{n})"
    yield from _choice(head, "", [f"return body.get_{u.name}();" for u in provided], "return nullptr;")


def _described(*sides: Sequence[Used]) -> Iterator[str]:
    lists = ", ".join(
        "{" + ", ".join(f"{instance('TypedCalls', _class(one))}::description()" for one in side) + "}" for side in sides
    )
    yield f"    static TypedInterfaces interfaces() {{ return {{{lists}}}; }}"


def _by_name(provided: Sequence[Used]) -> Iterator[str]:
    element = " element" * bool(provided)
    yield (
        f"    static ::std::shared_ptr<PortElementObject> by_name(::std::size_t{' n' * bool(provided)}, "
        f"const ::std::shared_ptr<PortElementObject>&{element}) {{"
    )
    if provided:
        yield "        switch (n) {"
    for number, one in enumerate(provided):
        yield f"            case {number}: return lwucm::{instance('by_name', _class(one))}(element);"
    if provided:
        yield "        }"
    yield "        return nullptr;"
    yield "    }"


def _set_attribute(body: Body) -> Iterator[str]:
    head = "void set_attribute(Body&{body}, ::std::size_t{n}, const ::std::string&{value})"
    cases = [
        f"body.{identifier(a.name)}({instance('attribute_value', qualified(type_))}(value)); return;"
        for a, type_ in _written(body)
    ]
    yield from _choice(head, " value", cases, "")


def _startup(body: Body) -> Iterator[str]:
    numbers = {True: 0, False: 0}
    given = []
    for used in body.required:
        kind = "service" if used.of_policy else "required"
        type_ = _class(used)
        given.append(f"connections.{instance(kind, type_)}({numbers[used.of_policy]})")
        numbers[used.of_policy] += 1
    name = " connections" if given else ""
    yield f"    static void on_startup(Body& body, const TypedConnections&{name}) {{"
    yield f"        body.on_startup({', '.join(given)});"
    yield "    }"


def _execution(body: Body) -> Iterator[str]:
    running = {f"{name}_{SELF_EXECUTION_API}" for name, kinds in _policies(body) if SELF_EXECUTING in kinds}
    getters = [f"get_tp_{u.name}" for u in body.used if u.of_policy and u.called in running]
    result = f"as_execution(body.{getters[0]}())" if getters else "nullptr"
    name = " body" * bool(getters)
    yield f"    static ::std::shared_ptr<component_execution_intf> execution(Body&{name}) {{ return {result}; }}"


def _policies(body: Body) -> Iterator[tuple[str, list[str]]]:
    """The technical policies of a body: their names, and the names of their definitions, those that they extend last."""
    implementation, scope = body.declared.element, body.declared.scope
    assert isinstance(implementation, components.AtomicComponentImplementation)
    for named in implementation.policies:
        policy = find(named.name, scope, components.ComponentTechnicalPolicy)
        assert isinstance(policy.element, components.ComponentTechnicalPolicy)
        definition = find(policy.element.technical_policy_definition, policy.scope, TechnicalPolicyDefinition)
        yield policy.element.name, [one.element.name for one in lineage(definition)]


def _schedulers(body: Body) -> Iterator[str]:
    """The specialisations by which a body gets lwucm's scheduler of object timers in the interfaces of its model."""
    called = {f"{name}_{TIMER_SCHEDULER}" for name, kinds in _policies(body) if OBJECT_TIMERS in kinds}
    for used in body.used:
        if used.of_policy and used.called in called and used.interface is not None:
            yield from _scheduler(used.interface)


def _scheduler(interface: Declared) -> Iterator[str]:
    """``schedule_repeated_trigger`` has all types that ``TypedScheduler`` wants; an interface without it is not that of 10.3.1."""
    element, class_ = interface.element, interfaces.qualified_class(interface, ())
    assert isinstance(element, contracts.Interface)
    for method in element.methods:
        types = {p.name: interfaces.resolve(p.type, interface.scope, ()) for p in method.parameters}
        timers = [types[p.name] for p in method.parameters if p.direction == "RETURN"]
        if (
            method.name != "schedule_repeated_trigger"
            or not timers
            or not {"trigger_handler", "interval"} <= set(types)
        ):
            continue
        named = [interfaces.qualified_class(one, ()) for one in (timers[0], types["trigger_handler"])]
        scheduler = instance("TypedScheduler", class_, *named, qualified(types["interval"]))
        yield (
            f"template <>\nstruct {instance('TypedReference', class_)} {{\n"
            f"    static ::std::shared_ptr< {class_} > to(const ::std::shared_ptr<PortElementObject>& element) {{\n"
            f"        return {scheduler}::to(element);\n    }}\n}};\n"
        )


def _policy_ports(body: Body) -> Iterator[str]:
    """What policies other than those of execution make a body provide."""
    cases = []
    for name, kinds in _policies(body):
        for used in body.used:
            element = used.called.removeprefix(f"{name}_")
            provides = used.of_policy and used.kind == "PROVIDED" and used.interface is not None
            if provides and used.called == f"{name}_{element}" and SELF_EXECUTING not in kinds:
                asked = " || ".join(f'policy == "{kind}"' for kind in kinds)
                result = f"lwucm::{instance('by_name', _class(used))}(body.get_tp_{used.name}())"
                cases.append(f'        if (({asked}) && element == "{element}") {{ return {result}; }}')
    names = (" body", " policy", " element") if cases else ("", "", "")
    taken = zip(("Body&", "const ::std::string&", "const ::std::string&"), names, strict=True)
    head = ", ".join(type_ + name for type_, name in taken)
    yield f"    static ::std::shared_ptr<PortElementObject> policy_port({head}) {{"
    yield from cases
    yield "        return nullptr;"
    yield "    }"


def _intercept(which: str, used: Sequence[Used]) -> Iterator[str]:
    """A function that puts a stand-in before a port element, which is the number of ``used``."""
    pointers = [f"const ::std::shared_ptr<{type_}>&" for type_ in ("PortElementObject", "Interceptor")]
    named = zip(pointers, (" target", " interceptor") if used else ("", ""), strict=True)
    taken = ", ".join(("::std::size_t" + " n" * bool(used), *(type_ + name for type_, name in named)))
    yield f"    static ::std::shared_ptr<PortElementObject> {which}({taken}) {{"
    if used:
        yield "        switch (n) {"
    for number, one in enumerate(used):
        stand_in = instance("stand_in", _class(one))
        yield f"            case {number}: return {stand_in}(target, interceptor);"
    if used:
        yield "        }"
    yield "        return nullptr;"
    yield "    }"
