"""What lwucm needs to call the operations of typed port elements by name, and to be called so: its links and services are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.names import Declared
from ucm_cts.adapters.reference.toolchain.cpp import interfaces
from ucm_cts.adapters.reference.toolchain.cpp.lwucm_values import (
    described,
    field_names,
    fields_from,
    fields_to,
    from_value,
    is_known,
    parts,
    structure,
    to_value,
)
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance, qualified
from ucm_cts.adapters.reference.toolchain.cpp.types import CPP11, find

_DIRECTIONS = {"IN": "in", "OUT": "out", "INOUT": "inout", "RETURN": "result"}


@dataclass(frozen=True)
class Operation:
    """A method of an interface, with the types of its parameters and the exceptions that it raises."""

    method: contracts.Method
    types: Sequence[Declared]
    raised: Sequence[Declared]

    def those(self, *directions: str) -> Iterator[tuple[int, contracts.Parameter, Declared]]:
        """The parameters of these directions, each with its number and type."""
        for number, (parameter, type_) in enumerate(zip(self.method.parameters, self.types, strict=True)):
            if parameter.direction in directions:
                yield number, parameter, type_

    @property
    def result(self) -> Declared | None:
        """The type of what it returns."""
        return next((type_ for _, _, type_ in self.those("RETURN")), None)


def operations(interface: Declared, bindings: interfaces.Bindings) -> Sequence[Operation]:
    """All methods of ``interface``, those it inherits first; none if it cannot be called by name: it has attributes, or lwucm has no
    values of a type in its signatures.
    """
    found = []
    for one in interfaces.family(interface):
        element, scope = one.element, one.scope
        assert isinstance(element, contracts.Interface)
        if element.attributes:
            return ()
        for method in element.methods:
            types = [interfaces.resolve(p.type, scope, bindings) for p in method.parameters]
            raised = [find(r.exception, scope, contracts.Exception_) for r in method.raised_exceptions]
            if not all(map(is_known, [*types, *(part for exception in raised for part in parts(exception))])):
                return ()
            found.append(Operation(method, types, raised))
    return found


def types_in(found: Sequence[Operation]) -> Iterator[Declared]:
    """The types in the signatures of these operations."""
    for operation in found:
        yield from operation.types
        for exception in operation.raised:
            yield from parts(exception)


def calls(class_: str, found: Sequence[Operation]) -> str:
    """Specialisations of ``TypedCalls`` and ``TypedReference`` for the interface ``class_``."""
    made = ", ".join(f'Method("{one.method.name}", {{{_parameters(one)}}}, {{{_raised(one)}}})' for one in found)
    lines = [
        "template <>",
        f"struct {instance('TypedCalls', class_)} {{",
        "    static InterfacePtr description() {",
        f"        return ::std::make_shared<const Interface>(::std::vector<Method>{{{made}}});",
        "    }",
        "",
        f"    static Values call({class_}& target, const ::std::string& method, const Values& arguments) {{",
    ]
    for operation in found:
        lines += [f'        if (method == "{operation.method.name}") {{', *_call(operation), "        }"]
    lines += [
        """        throw BAD_PARAMETER("there is no method '" + method + "'");""",
        "    }",
        "};",
        "",
        "template <>",
        f"struct {instance('TypedReference', class_)} {{",
        f"    class Called final : public {class_} {{",
        "      public:",
        "        explicit Called(::std::shared_ptr<DynamicPortElement> target) : target_(::std::move(target)) {}",
    ]
    for operation in found:
        lines += _called(operation)
    pointer = f"::std::shared_ptr< {class_} >"
    lines += [
        "",
        "      private:",
        "        const ::std::shared_ptr<DynamicPortElement> target_;",
        "    };",
        "",
        f"    static {pointer} to(const ::std::shared_ptr<PortElementObject>& element) {{",
        f"        const auto target = {instance('callable', class_)}(element);",
        "        return target ? ::std::make_shared<Called>(target) : nullptr;",
        "    }",
        "};",
    ]
    return "\n".join(lines) + "\n"


def _parameters(operation: Operation) -> str:
    return ", ".join(
        f'{{"{parameter.name}", Direction::{_DIRECTIONS[parameter.direction]}, {described(type_)}}}'
        for _, parameter, type_ in operation.those(*_DIRECTIONS)
    )


def _raised(operation: Operation) -> str:
    return ", ".join(map(structure, operation.raised))


def _call(operation: Operation) -> Iterator[str]:
    """Carries out an operation of the target that is called by name."""
    taken = list(operation.those("IN", "INOUT"))
    yield f"            expect_values(arguments, {len(taken)});"
    place = {number: n for n, (number, _, _) in enumerate(taken)}
    for number, parameter, type_ in operation.those("IN", "INOUT", "OUT"):
        value = from_value(type_, f"arguments[{place[number]}]") if number in place else f"{qualified(type_)}()"
        const = "const " if parameter.direction == "IN" else ""
        yield f"            {const}{qualified(type_)} a{number} = {value};"
    given = ", ".join(f"a{number}" for number, _, _ in operation.those("IN", "INOUT", "OUT"))
    called = f"target.{identifier(operation.method.name)}({given})"
    back = ", ".join(
        to_value(type_, "result" if parameter.direction == "RETURN" else f"a{number}")
        for number, parameter, type_ in operation.those("OUT", "INOUT", "RETURN")
    )
    returned = operation.result
    carried_out = [f"const {qualified(returned)} result = {called};" if returned is not None else f"{called};"]
    carried_out.append(f"return {{{back}}};" if back else "return Values();")
    if not operation.raised:
        yield from (f"            {line}" for line in carried_out)
        return
    yield "            try {"
    yield from (f"                {line}" for line in carried_out)
    for exception in operation.raised:
        name = " raised" if field_names(exception) else ""
        yield f"            }} catch (const {qualified(exception)}&{name}) {{"
        fields = f"Values{{{fields_to(exception, 'raised')}}}"
        yield f'                throw DeclaredException("{exception.element.name}", {fields});'
    yield "            }"


def _called(operation: Operation) -> Iterator[str]:
    """An operation that calls the target by name."""
    result = qualified(operation.result) if operation.result is not None else "void"
    taken = ", ".join(
        f"{interfaces.passed(type_, parameter.direction, (), CPP11)} a{number}"
        for number, parameter, type_ in operation.those("IN", "INOUT", "OUT")
    )
    given = ", ".join(to_value(type_, f"a{number}") for number, _, type_ in operation.those("IN", "INOUT"))
    yield f"        {result} {identifier(operation.method.name)}({taken}) override {{"
    call = f'this->target_->call("{operation.method.name}", {{{given}}})'
    back = list(operation.those("OUT", "INOUT", "RETURN"))
    if back:
        call = f"const Values results = {call}"
    if operation.raised:
        yield from _raising(operation, call, bool(back))
    else:
        yield f"            {call};"
    last = ""
    for place, (number, parameter, type_) in enumerate(back):
        value = from_value(type_, f"results.at({place})")
        if parameter.direction == "RETURN":
            last = f"            return {value};"
        else:
            yield f"            a{number} = {value};"
    if last:
        yield last
    yield "        }"


def _raising(operation: Operation, call: str, gives: bool) -> Iterator[str]:
    """``call`` with the exceptions that the target declares as those of the interface; it may give ``results``."""
    if gives:
        yield "            Values results;"
    yield "            try {"
    yield f"                {call.removeprefix('const Values ')};"
    yield "            } catch (const DeclaredException& raised) {"
    for exception in operation.raised:
        yield f'                if (raised.name == "{exception.element.name}") {{'
        if field_names(exception):
            yield f"                    expect_values(raised.fields, {len(field_names(exception))});"
        yield f"                    throw {qualified(exception)}({fields_from(exception, 'raised.fields')});"
        yield "                }"
    yield "                throw;"
    yield "            }"
