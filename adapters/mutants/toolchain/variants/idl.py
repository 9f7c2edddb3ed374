"""Conformant tool chains that generate other IDL than the reference does: each uses a freedom of clause 12."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TypeVar

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element, walk
from ucm_cts.adapters.contract.metamodel.components import ComponentTechnicalPolicy
from ucm_cts.adapters.contract.metamodel.contracts import Annotation
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.checking import refusing_text
from ucm_cts.adapters.mutants.toolchain.registry import named, variant
from ucm_cts.adapters.mutants.toolchain.variants.cpp_names import one_of_each
from ucm_cts.adapters.reference.toolchain.idl.names import identifier
from ucm_cts.adapters.reference.toolchain.program import Program


class Freedom(Value, frozen=True):
    """``edits`` of the IDL in ``file``, ``*`` for every file; ``declares`` are the readings that the tool chain claims."""

    edits: dict[str, str]
    file: str = rw.MODEL
    declares: tuple[str, ...] = ()


for _name, _freedom in rw.table("variants/idl.yaml", dict[str, Freedom]).items():
    _derive = rw.edited("idl", _freedom.edits) if _freedom.file == "*" else rw.replacing(_freedom.edits, _freedom.file)
    variant(task="idl", declares=_freedom.declares)(named(_derive, _name))

_derive = rw.replaced(r'@DefaultValue\(val="(\d+)"\)', lambda m: f'@DefaultValue(val="0x{int(m[1]):X}")')
variant(task="idl")(named(_derive, "values_in_hexadecimal"))


@variant(task="idl", declares=("idl-policy-getters=definition",))
def definitions_declared(program: Program) -> Program:
    """Getters of policies are named after definitions; those of one definition are one getter."""
    generate = program.generators["idl"]

    def rewrite(model: Model) -> rw.Files:
        files = generate(model)
        policies = [
            one for module in model.modules for one in walk(module) if isinstance(one, ComponentTechnicalPolicy)
        ]
        called = {identifier(one.name): one.technical_policy_definition.rpartition("::")[2] for one in policies}
        names = "|".join(sorted(map(re.escape, called), key=len, reverse=True)) or "(?!)"
        text = re.sub(rf"\bget_tp_({names})_", lambda m: f"get_tp_{identifier(called[m[1]])}_", files[rw.MODEL])
        bodies = re.sub(r"interface \w+_Body[^{};]*\{[^}]*\}", lambda body: one_of_each(body[0]), text)
        return {**files, rw.MODEL: bodies}

    return replace(program, generators={**program.generators, "idl": rewrite})


@variant(task="idl")
def standard_declarations_in_a_module(program: Program) -> Program:
    """What 12.10 prints stands in a module."""
    names = r"::(?=PortElementObject|ComponentObject)"

    def rewrite(files: rw.Files) -> rw.Files:
        text = files[rw.STANDARD].replace("\nstruct Property", "\nmodule ucm {\nstruct Property", 1)
        text = text.replace("\nmodule standard_execution", "\n};\nmodule standard_execution", 1)
        return {rw.STANDARD: re.sub(names, "::ucm::", text), rw.MODEL: re.sub(names, "::ucm::", files[rw.MODEL])}

    return rw.rewritten(program, rewrite)


@variant(task="idl", declares=("idl-standard-files=elsewhere",))
@rw.rewriting
def standard_files_elsewhere(files: rw.Files) -> rw.Files:
    """The file with what clause 12 prints comes with the framework and is not generated."""
    return {rw.MODEL: files[rw.MODEL]}


def _without(files: rw.Files, file: str, *modules: str) -> rw.Files:
    """``files`` without the outermost ``modules`` of ``file``."""
    text = files[file]
    for name in modules:
        text = re.sub(rf"^module {name} \{{\n.*?^\}};\n", "", text, flags=re.MULTILINE | re.DOTALL)
    return {**files, file: text}


@variant(task="idl", declares=("standard-idl=model",))
@rw.rewriting
def standard_modules_of_the_models(files: rw.Files) -> rw.Files:
    """Nothing of 12.11 is generated but what follows from the models of clause 10."""
    return _without(files, rw.STANDARD, "standard_execution_policies", "standard_services", "timer_service")


@variant(task="idl", declares=("standard-idl=printed",))
@rw.rewriting
def standard_modules_as_printed(files: rw.Files) -> rw.Files:
    """Policies and services of 12.11 stand in place of what follows from their models; the timers follow from theirs."""
    files = _without(files, rw.STANDARD, "timer_service")
    return _without(files, rw.MODEL, "container_services", "component_execution_policies")


@variant(task="idl", declares=("standard-idl=printed-with-timers",))
@rw.rewriting
def standard_modules_and_timers_as_printed(files: rw.Files) -> rw.Files:
    """All that 12.11 prints stands in place of what follows from the models."""
    return _without(files, rw.MODEL, "container_services", "component_execution_policies", "timer")


@variant(task="idl")
@rw.rewriting
def local_interfaces(files: rw.Files) -> rw.Files:
    """Interfaces have the keyword local."""
    return {n: re.sub(r"\binterface (?=\w+(?: :| \{|;))", "local interface ", t) for n, t in files.items()}


@variant(task="idl")
def other_order(program: Program) -> Program:
    """What stands first in the model stands last, as far as IDL allows."""
    generate = program.generators["idl"]
    generators = {**program.generators, "idl": lambda model: generate(_reversed(model))}
    return replace(program, generators=generators)


_M = TypeVar("_M", bound=Element)


def _reversed(element: _M) -> _M:
    """Modules, and what they hold, the other way round; what is inside of that is not touched."""
    fields = {name: getattr(element, name) for name in element.__struct_fields__}
    turned = {
        name: tuple(_reversed(one) if isinstance(one, MODULES) else one for one in reversed(value))
        for name, value in fields.items()
        if isinstance(value, tuple)
    }
    return msgspec.structs.replace(element, **turned)


@variant(task="idl")
@rw.rewriting
def a_file_for_each_module(files: rw.Files) -> rw.Files:
    """Each piece of a top module has its own file, and one includes them all."""
    head, *pieces = re.split(r"^(?=module )", files[rw.MODEL].removesuffix(rw.GUARD), flags=re.MULTILINE)
    names = {f"part_{n}.idl": f'#include "{rw.STANDARD}"\n{piece}' for n, piece in enumerate(pieces)}
    includes = "".join(f'#include "{name}"\n' for name in names)
    return {rw.STANDARD: files[rw.STANDARD], **names, rw.MODEL: f"{head}{includes}{rw.GUARD}"}


_HEAD = r"interface (\w+)((?: : [^{]*)?) \{\n"
_GETTER = r" *\S+ get_(?!tp_)\w+\(\);\n"


@variant(task="idl")
@rw.rewriting
def getters_in_bodies(files: rw.Files) -> rw.Files:
    """Getters of ports are declared in each body interface instead of the equivalent interface."""
    text = files[rw.MODEL]
    blocks = re.findall(rf"{_HEAD}((?:.*\n)*?) *\}};\n", text)
    getters = {name: re.findall(_GETTER, body, re.MULTILINE) for name, _, body in blocks}
    bases = {name: re.findall(r"\w+(?=,|$)", heads) for name, heads, _ in blocks}

    def all_of(name: str) -> list[str]:
        return [*getters.get(name, []), *(g for base in bases.get(name, []) for g in all_of(base))]

    text = re.sub(_GETTER, "", text)
    moved = re.sub(_HEAD, lambda m: m[0] + "".join(all_of(m[1]) if m[1].endswith("_Body") else []), text)
    return {**files, rw.MODEL: moved}


@variant(task="idl")
@rw.rewriting
def templates_around_templates(files: rw.Files) -> rw.Files:
    """A module around a template is a template with the same parameter, and instances are made one by one."""
    text = re.sub(
        r"module messages \{(?=\n *module message_api<)", "module messages<typename MESSAGE_TYPE_T> {", files[rw.MODEL]
    )
    text = re.sub(
        r"module (\S*::messages)::message_api(<\S+>) (\w+);",
        r"module \1\2 \3_around;\n        module \3_around::message_api\2 \3;",
        text,
    )
    return {**files, rw.MODEL: text}


@variant(task="idl")
@rw.rewriting
def interfaces_of_their_own_for_bindings(files: rw.Files) -> rw.Files:
    """Instead of an instance of a template there is an interface with the types that are bound."""
    text = re.sub(
        r"module \S+::message_api<(\S+)> (\w+);",
        r"interface \2_intf : ::PortElementObject {\n"
        r"            ::bindings_platform::return_codes::comm_ecode push(in \1 message);\n        };",
        files[rw.MODEL],
    )
    return {**files, rw.MODEL: re.sub(r"(\w+_message_api)::message_intf (?=get_)", r"\1_intf ", text)}


@variant(task="idl")
def refuses_keywords(program: Program) -> Program:
    """Refuses a model with names that are words of IDL."""
    return refusing_text(program, rb'name="(module|struct|interface)"')


@variant(task="idl")
def annotations_as_remarks(program: Program) -> Program:
    """Says in a remark how many annotations the model has."""
    generate = program.generators["idl"]

    def remarking(model: Model) -> rw.Files:
        files = generate(model)
        number = sum(isinstance(element, Annotation) for module in model.modules for element in walk(module))
        return {**files, rw.MODEL: f"// annotations: {number}\n{files[rw.MODEL]}"} if number else files

    return replace(program, generators={**program.generators, "idl": remarking})
