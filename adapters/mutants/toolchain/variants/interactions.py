"""Tool chains that read the open places of 9.2.7 to 9.3 otherwise than the reference one, and say so."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import refusing, without
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule, variant
from ucm_cts.adapters.reference.toolchain.program import Program


@variant(declares=("inherited-names=allowed",))
def inherited_names_may_recur(program: Program) -> Program:
    """Lets an interface declare what it inherits once more."""
    return replacing_rule(program, "inherited_names_differ", None)


@variant(declares=("method-overloading=allowed",))
def methods_may_be_overloaded(program: Program) -> Program:
    """Tells methods apart by their parameters."""
    return replacing_rule(program, "methods_differ_in_name", None)


@variant(declares=("attribute-mode-absent=readwrite",))
def mode_may_be_absent(program: Program) -> Program:
    """Takes an attribute without mode for one that can be read and written, as the reference tool chain does."""
    return program


@variant(declares=("abstract-types-elsewhere=allowed",))
def abstract_types_may_be_anywhere(program: Program) -> Program:
    """Lets fields have abstract types."""
    return replacing_rule(program, "abstract_types_serve_interfaces_only", None)


@variant(declares=("module-extension=allowed",))
def modules_may_extend_modules(program: Program) -> Program:
    """Takes notice of modules that extend others, and has nothing against them."""
    return program


@variant(declares=("item-redefinition=allowed",))
def items_may_be_redefined(program: Program) -> Program:
    """Lets a pattern declare an item of its parent again."""
    return replacing_rule(program, "items_are_not_redefined", None)


@variant(declares=("connector-port-api=optional",))
def ports_may_do_without_api(program: Program) -> Program:
    """Lets a connector port do without a port type, as 10.1.5.2 prints them."""
    return replacing_rule(program, "ports_have_apis", None)


@variant(declares=("unbound-items=optional",))
def items_may_be_unbound(program: Program) -> Program:
    """Lets a connector leave items of its roles unbound."""
    return replacing_rule(program, "items_of_roles_are_bound", None)


@variant()
@refusing
def connectors_have_ports(connector: ConnectorDefinition, _: Scope) -> object:
    """Refuses connectors without ports, as the fragment of 9.3.4.6 does."""
    return not connector.ports


@variant()
def negative_multiplicities_are_unbounded(program: Program) -> Program:
    """Takes any negative multiplicity for none at all, and says nothing of it."""
    return without(program, "multiplicities_are_not_negative")


@variant(declares=("negative-multiplicities=accepted",))
def negative_multiplicities_are_said_to_be_unbounded(program: Program) -> Program:
    """The same, and says so."""
    return without(program, "multiplicities_are_not_negative")


@variant()
def items_may_have_two_types(program: Program) -> Program:
    """Lets connectors and ports bind one item to two types, and says nothing of it."""
    return without(program, "items_are_bound_to_one_type", "items_have_one_actual_type")


@variant(declares=("repeated-item-bindings=accepted",))
def items_are_said_to_have_several_types(program: Program) -> Program:
    """The same, and says so."""
    return without(program, "items_are_bound_to_one_type", "items_have_one_actual_type")


@variant(declares=("negative-multiplicities=refused", "repeated-item-bindings=refused", "unbound-items=required"))
def interactions_are_strict(program: Program) -> Program:
    """Refuses what is open about multiplicities and items, as the reference tool chain does."""
    return program
