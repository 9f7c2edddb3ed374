"""Classes that implement what was generated: once for each interface and component, and once more without each function."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.harness.toolchains.cpp.probes.overloads import found_function, ways_to_startup
from ucm_cts.harness.toolchains.cpp.probes.text import class_text, connection_text
from ucm_cts.reference_models.mapping.cpp.claims import Implemented, Runs
from ucm_cts.reference_models.mapping.cpp.classes import Abstract, Connected, Method, Returned

LIFE_CYCLE = ("on_init", "on_shutdown", "on_remove")


def implementation(abstract: Abstract) -> str:
    """Class templates whose parameter is the class that is implemented: ``KEY``, and ``KEY_lacks_FUNCTION_PARAMETERS``."""
    members = list(_members(abstract))
    lines = [_startup_found(abstract)] if abstract.life_cycle else []
    lines.append(_template(abstract.key, [text for _, text in members], len(members)))
    for left_out, _ in members:
        rest = [text for name, text in members if name != left_out]
        lines.append(_template(f"{abstract.key}_lacks_{left_out}", rest, len(members)))
    return "namespace ucts {\n" + "\n".join(lines) + "\n}\n"


def _template(name: str, members: list[str], count: int) -> str:
    return (
        f"template <class B> struct {name} : B {{ mutable int ucts_calls[{count + 1}];"
        f" {name}() : ucts_calls() {{}} {' '.join(members)} }};"
    )


def _members(abstract: Abstract) -> Iterator[tuple[str, str]]:
    """Each function with how it is told apart from others of its name; its calls are counted in the order of functions."""
    position = 0
    for method in abstract.methods:
        yield f"{method.name}_{len(method.parameters)}", _method(method, position)
        position += 1
    for getter in abstract.getters:
        yield f"{getter.name}_0", _getter(getter.name, getter.interface, position)
        position += 1
    if abstract.life_cycle:
        for name in LIFE_CYCLE:
            yield f"{name}_0", f"virtual void {name}() {{ ++ucts_calls[{position}]; }}"
            position += 1
        yield "on_startup", _startup(abstract, position)


def _method(method: Method, position: int) -> str:
    result = method.result.type if method.result is not None else "void"
    body = f"++ucts_calls[{position}];"
    for number, parameter in enumerate(method.parameters, 1):
        body += f" a{number} = {parameter.sample.second};" if parameter.written else f" (void)a{number};"
    if method.result is not None:
        body += f" return {method.result.first};"
    return " ".join(
        f"virtual {result} {method.name}({', '.join(f'{t} a{i}' for i, t in enumerate(types, 1))})"
        f"{' const' * constant} {{ {body} }}"
        for types in method.signatures()
        for constant in method.constant
    )


def _getter(name: str, interface: str, position: int) -> str:
    function = f"typename ::ucts::bare<UCTS_TYPE(::ucts::of_0(&B::{name}))>::type"
    result = f"typename ::ucts::bare<{function}::result>::type"
    made = f"typedef {result} result; typedef typename ::ucts::pointee<result>::type pointed;"
    return f"virtual {result} {name}() {{ ++ucts_calls[{position}]; {made} return result(new ::ucts::{interface}<pointed>); }}"


def _startup(abstract: Abstract, position: int) -> str:
    least, most = len(abstract.startup), len(abstract.startup) + len(abstract.more)
    forms = []
    for count in range(least, most + 1):
        function = f"typename ::ucts::{abstract.key}_startup<B>::function"
        taken = ", ".join(f"{function}::a{i} a{i}" for i in range(1, count + 1))
        kept = " ".join(f"::ucts::keep(a{i});" for i in range(1, count + 1))
        text = f"virtual void on_startup({taken}) {{ ++ucts_calls[{position}]; {kept} }}"
        forms.append(text)
    if least == most:
        return forms[0]
    # keeping what is no connection does not compile: the numbers of parameters that are not there take something else
    return " ".join(form.replace("::ucts::keep(", "::ucts::keep_if_connection(") for form in forms)


def _startup_found(abstract: Abstract) -> str:
    least, most = len(abstract.startup), len(abstract.startup) + len(abstract.more)
    connections = [connection_text(abstract.owner, connection.name) for connection in abstract.startup]
    name = f"{abstract.key}_startup"
    return found_function(name, "on_startup", ways_to_startup(name, least, most, connections))


def implemented(claim: Implemented, abstract: Abstract) -> tuple[str, str]:
    """Declares the implementation, and calls each of its functions, as a class and as what it implements.

    What is inherited is called as the class alone, because ancestors that are there twice make it ambiguous otherwise.
    """
    owner = class_text(claim.owner)
    declared = (
        f"typedef {owner} owner; typedef ::ucts::{abstract.key}<owner> body;"
        " typedef ::ucts::holds<(!__is_abstract(body))>::yes checked;"
    )
    if abstract.life_cycle:
        return declared, "body object; (void)object;"
    calls = ["body object; owner& used = object; (void)used;"]
    for position, method in enumerate(abstract.methods):
        through = "object" if position < abstract.inherited else "used"
        if through == "object" and len(method.signatures()) > 1:
            continue  # each way of passing is a function of its own there
        calls.append(_called(through, method, f"object.ucts_calls[{position}]"))
    return declared, " ".join(calls)


def _called(through: str, method: Method, counted: str) -> str:
    """Calls ``method`` once and looks at what came of it."""
    lines, given = [], []
    for number, parameter in enumerate(method.parameters, 1):
        lines.append(f"{parameter.sample.type} a{number} = {parameter.sample.first};")
        given.append(f"a{number}")
    call = f"{through}.{method.name}({', '.join(given)})"
    result = method.result
    if result is not None and result.comparable:
        lines.append(f'::ucts::require({call} == {result.first}, "{method.name} returns something else");')
    else:
        lines.append(f"{call};")
    for number, parameter in enumerate(method.parameters, 1):
        if parameter.written and parameter.sample.comparable:
            message = f"{method.name} does not hand back what was written to its parameter {number}"
            lines.append(f'::ucts::require(a{number} == {parameter.sample.second}, "{message}");')
    lines.append(f'::ucts::require({counted} == 1, "calls of {method.name} do not come to the implementation");')
    return "{ " + " ".join(lines) + " }"


def runs(claim: Runs, abstract: Abstract, interfaces: dict[str, Abstract]) -> tuple[str, str]:
    """Declares a component and lives its life: started with connections, asked for its port elements, called, stopped."""
    declared = f"typedef {claim.owner} owner; typedef ::ucts::{abstract.key}<owner> body;"
    lines = ["body object; owner& component = object;"]
    lines += [_attribute(method, position) for position, method in enumerate(abstract.methods)]
    lines.append("component.on_init();")
    lines += [_connected(claim.owner, c.name, c.interface, number) for number, c in enumerate(abstract.startup)]
    startup = f"::ucts::{abstract.key}_startup<owner>::function::pointer"
    lines.append(f"::ucts::start(component, static_cast< {startup} >(&owner::on_startup));")
    one_each = {connection.interface: number for number, connection in enumerate(abstract.startup)}
    for number in one_each.values():
        connection = abstract.startup[number]
        reached = class_text(Connected(claim.owner, connection.name))
        lines.append(_used(number, reached, connection.interface, interfaces))
    for getter in abstract.getters:
        reached = class_text(Returned(claim.owner, getter.name))
        lines.append(_got(getter.name, reached, getter.interface, interfaces))
    lines.append("component.on_shutdown(); component.on_remove();")
    declared += _one_class(claim.owner, abstract, interfaces)
    count = len(abstract.methods) + len(abstract.getters)
    for position, name in enumerate((*LIFE_CYCLE, "on_startup"), count):
        message = f"calls of {name} do not come to the implementation"
        lines.append(f'::ucts::require(object.ucts_calls[{position}] == 1, "{message}");')
    return declared, " ".join(lines)


def _one_class(owner: str, abstract: Abstract, interfaces: dict[str, Abstract]) -> str:
    """One class implements the body and its port elements (12.12), as far as no two of them have a function of one name."""
    taken = {"on_startup", *LIFE_CYCLE, *(m.name for m in abstract.methods), *(g.name for g in abstract.getters)}
    elements: dict[str, str] = {}
    for getter in abstract.getters:
        names = {method.name for method in interfaces[getter.interface].methods}
        if names and not names & taken:
            taken |= names
            reached = class_text(Returned(owner, getter.name))
            elements[getter.interface] = f", ::ucts::{getter.interface}<{reached} >"
    if not elements:
        return ""
    return (
        f" struct one_class : body{''.join(elements.values())} {{}};"
        " typedef ::ucts::holds<(!__is_abstract(one_class))>::yes whole;"
    )


def _attribute(method: Method, position: int) -> str:
    return _called("component", method, f"object.ucts_calls[{position}]")


def _connected(owner: str, connection: str, interface: str, number: int) -> str:
    type_ = connection_text(owner, connection)
    reached = class_text(Connected(owner, connection))
    return (
        f"typedef {type_} connection_{number}; typedef UCTS_TYPE(::ucts::member_of(&connection_{number}::ref)) of_{number};"
        f" typedef ::ucts::{interface}<{reached} > target_{number};"
        f" target_{number}* const aim_{number} = new target_{number};"
        f" ::ucts::slot<connection_{number}>::value ="
        f' new connection_{number}(::std::string("{connection}"), of_{number}::member(aim_{number}));'
    )


def _used(number: int, reached: str, interface: str, interfaces: dict[str, Abstract]) -> str:
    kept = f"::ucts::kept<connection_{number}>::value"
    text = f'::ucts::require({kept} != 0 && {kept}->ref.get() != 0, "on_startup does not hand over the connection");'
    method = _own_method(interfaces[interface])
    if method is None:
        return text
    position, called = method
    cast = f"dynamic_cast< ::ucts::{interface}<{reached} >&>(*{kept}->ref).ucts_calls[{position}]"
    return f"{text} {{ {_called(f'(*{kept}->ref)', called, cast)} }}"


def _got(getter: str, reached: str, interface: str, interfaces: dict[str, Abstract]) -> str:
    text = f"UCTS_TYPE(component.{getter}()) got = component.{getter}();"
    text += f' ::ucts::require(got.get() != 0, "{getter} does not return what the component made");'
    method = _own_method(interfaces[interface])
    if method is not None:
        position, called = method
        cast = f"dynamic_cast< ::ucts::{interface}<{reached} >&>(*got).ucts_calls[{position}]"
        text += f" {_called('(*got)', called, cast)}"
    return f"{{ {text} }}"


def _own_method(abstract: Abstract) -> tuple[int, Method] | None:
    """A method to try a reference with, if there is one that is not inherited."""
    own = range(abstract.inherited, len(abstract.methods))
    return next(((position, abstract.methods[position]) for position in own), None)
