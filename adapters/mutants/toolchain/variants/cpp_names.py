"""Tool chains whose C++ has other names of component classes and getters, or other parameters of on_startup, and declare it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

import msgspec

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, walk
from ucm_cts.adapters.contract.metamodel.components import AtomicComponentImplementation, ComponentTechnicalPolicy
from ucm_cts.adapters.contract.metamodel.contracts import Attribute, Constant, Method
from ucm_cts.adapters.contract.metamodel.interactions import PortElement
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import named, variant
from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, Files, sentence
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier
from ucm_cts.adapters.reference.toolchain.program import Program

E = TypeVar("E", bound=Element)
_M = TypeVar("_M", bound=Element)

Rewrite = Callable[[Model, Files], Files]
"""Makes other files of those that the reference tool chain makes of a model."""


def all_of(model: Model, kind: type[E]) -> Iterator[E]:
    """All elements of ``kind``."""
    found = (element for module in model.modules for element in walk(module))
    return (element for element in found if isinstance(element, kind))


def _changed(element: _M, change: Callable[[Element], Element]) -> _M:
    """``element`` after ``change`` of all that is inside, and of itself."""
    fields = {name: getattr(element, name) for name in element.__struct_fields__}
    inner = {
        name: tuple(_changed(one, change) if isinstance(one, Element) else one for one in value)
        for name, value in fields.items()
        if isinstance(value, tuple)
    }
    changed = change(msgspec.structs.replace(element, **inner))
    assert isinstance(changed, type(element))
    return changed


def _last(path: str) -> str:
    return path.rpartition("::")[2]


def _classes_with_suffix(model: Model, files: Files) -> Files:
    """Classes of components have the suffix that the example of 13.7 has."""
    names = "|".join({re.escape(identifier(one.name)) for one in all_of(model, AtomicComponentImplementation)})
    return {n: re.sub(rf"\bAbstract_({names})\b", r"\1_Abstract", t) for n, t in files.items()} if names else files


def one_of_each(text: str) -> str:
    """``text``, a class, without getters of policies that are there already."""
    lines: list[str] = []
    for line in text.splitlines(keepends=True):
        if "get_tp_" not in line or line not in lines:
            lines.append(line)
    return "".join(lines)


def _getters_named(model: Model, files: Files, called: Callable[[ComponentTechnicalPolicy, str], str]) -> Files:
    """``called`` names the getters of a policy, in the class of a component with the type of that name."""
    policies = {identifier(one.name): one for one in all_of(model, ComponentTechnicalPolicy)}
    types = {identifier(one.name): _last(one.type) for one in all_of(model, AtomicComponentImplementation)}
    longest_first = "|".join(sorted(map(re.escape, policies), key=len, reverse=True))

    def of_class(found: re.Match[str]) -> str:
        def getter(match: re.Match[str]) -> str:
            return f" get_tp_{identifier(called(policies[match[1]], types[found[1]]))}_"

        return one_of_each(re.sub(rf" get_tp_({longest_first})_", getter, found[0]))

    shape = r"class Abstract_(\w+) \{\n(?:(?!\};\n).)*\};\n"
    return {n: re.sub(shape, of_class, t, flags=re.DOTALL) if policies else t for n, t in files.items()}


def _getters_named_after_definitions(model: Model, files: Files) -> Files:
    """Getters of policies have the names of their definitions."""
    return _getters_named(model, files, lambda policy, _: _last(policy.technical_policy_definition))


def _getters_named_as_in_the_example(model: Model, files: Files) -> Files:
    """Getters of policies have the component type's name before the policy's, as an example of 12.8.5 has it."""
    return _getters_named(model, files, lambda policy, type_: f"{type_}{policy.name}")


def _services_without_parameters(model: Model, files: Files) -> Files:
    """What a policy offers a component is no parameter of its on_startup."""
    names = "|".join({re.escape(identifier(one.name)) for one in all_of(model, ComponentTechnicalPolicy)})

    def startup(match: re.Match[str]) -> str:
        kept = (one for one in match[1].split(", ") if not re.match(rf"const (?:{names})_\w+_Connection& ", one))
        return f"on_startup({', '.join(kept)})"

    return {n: re.sub(r"on_startup\(([^)]*)\)", startup, t) for n, t in files.items()} if names else files


def _constant_accessors(model: Model, files: Files) -> Files:
    """All accessors of attributes are for constant objects, too."""
    methods = {identifier(one.name) for one in all_of(model, Method)}
    names = {identifier(one.name) for one in all_of(model, Attribute)} - methods
    shape = rf"(virtual [^;()]+ (?:{'|'.join(map(re.escape, names))})\(\)) = 0"
    return {n: re.sub(shape, r"\1 const = 0", t) for n, t in files.items()} if names else files


REWRITTEN: Mapping[str, tuple[Rewrite, str]] = {
    "component_classes_with_suffix": (_classes_with_suffix, "cpp-component-class=suffix"),
    "policy_getters_named_after_definitions": (_getters_named_after_definitions, "cpp-get-tp-name=definition"),
    "policy_getters_named_as_in_the_example": (_getters_named_as_in_the_example, "cpp-get-tp-name=component-instance"),
    "services_without_parameters": (_services_without_parameters, "cpp-policy-connections=none"),
    "constant_accessors": (_constant_accessors, "cpp-accessors=const"),
}


def _other_hyphens(element: Element) -> Element:
    """Names have two underscores for a hyphen; what constants are worth stays."""
    if isinstance(element, Constant):
        return msgspec.structs.replace(element, name=_spelt(element.name), type=_spelt(element.type))
    fields = {name: getattr(element, name) for name in element.__struct_fields__}
    return msgspec.structs.replace(element, **{n: _spelt(v) for n, v in fields.items() if isinstance(v, str)})


def _spelt(name: str) -> str:
    return re.sub(r"(?<=\w)-(?=[^\W\d])", "_x_", name)


def _policy_s_side(element: Element) -> Element:
    """A policy definition says what the policy has: it requires what the component provides."""
    if not isinstance(element, TechnicalPolicyDefinition):
        return element
    turned = (_other_kind(one) for one in element.port_elements)
    return msgspec.structs.replace(element, port_elements=tuple(turned))


def _other_kind(element: PortElement) -> PortElement:
    return msgspec.structs.replace(element, kind="REQUIRED" if element.kind == "PROVIDED" else "PROVIDED")


MODELS_READ: Mapping[str, tuple[Callable[[Element], Element], str]] = {
    "hyphens_become_something_else": (_other_hyphens, "cpp-hyphen=other"),
    "policies_require_what_has_getters": (_policy_s_side, "cpp-policy-getters=policy"),
}
"""Tool chains that generate as the reference does, from what they take the model to say."""


def generating(program: Program, task: str, rewrite: Rewrite) -> Program:
    """``program`` whose files for ``task`` are rewritten."""
    generate = program.generators[task]
    return replace(program, generators={**program.generators, task: lambda model: rewrite(model, generate(model))})


def _reading(program: Program, task: str, change: Callable[[Element], Element]) -> Program:
    generate = program.generators[task]
    return replace(program, generators={**program.generators, task: lambda model: generate(_changed(model, change))})


def rewriting(says: str, rewrite: Rewrite, *declares: str) -> None:
    """Make a variant of each C++ task: a tool chain whose files are rewritten, and that declares these readings."""
    for task in BOTH:
        derive = named(
            lambda program, task=task: generating(program, task, rewrite),  # type: ignore[misc]
            f"{says}_{task}",
            rewrite.__doc__,
        )
        variant(task=task, declares=declares)(derive)


for _says, (_rewrite, _value) in REWRITTEN.items():
    rewriting(_says, _rewrite, _value)

for _task in BOTH:
    for _says, (_change, _value) in MODELS_READ.items():
        _derive = named(
            lambda program, task=_task, change=_change: _reading(program, task, change),  # type: ignore[misc]
            f"{_says}_{_task}",
            _change.__doc__ or sentence(_says),
        )
        variant(task=_task, declares=(_value,))(_derive)
