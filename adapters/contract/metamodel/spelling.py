"""How the classes of the meta-model are written in XML: tags, attributes, words, and the other spellings that the text prints.

What a class contains and which values an attribute takes follow from the class; the table below says the rest.
"""

from __future__ import annotations

import functools
import types
import typing
from collections.abc import Mapping

import msgspec

from ucm_cts.adapters.contract.metamodel import aspects, common, components, contracts, interactions, modules
from ucm_cts.adapters.contract.metamodel.common import Element, Named


def _words(text: str, *by_prose: str) -> dict[str, str]:
    """Each of the words of ``text`` for itself, and for the spellings that prose gives them."""
    words = text.split()
    return {word: word for word in words} | {word.lower(): word for word in words if word.lower() in by_prose}


INTEGER_KINDS = {kind: kind for kind in contracts.INTEGER_RANGES}
TRUTHS = {"true": True, "false": False, "1": True, "0": False}

LITERALS: Mapping[type[Element], Mapping[str, Mapping[str, str]]] = {
    contracts.PrimitiveInteger: {"kind": INTEGER_KINDS},
    contracts.PrimitiveFloat: {"kind": _words(" ".join(contracts.FLOAT_KINDS))},
    contracts.PrimitiveChar: {"kind": _words(" ".join(contracts.CHAR_KINDS))},
    contracts.StringType: {"char_base": _words(" ".join(contracts.CHAR_KINDS))},
    contracts.Parameter: {"direction": _words("IN OUT INOUT RETURN", "in", "out", "inout", "return")},
    contracts.Attribute: {"mode": _words("READ READWRITE", "read", "readwrite")},
    interactions.InteractionItem: {"nature": _words("DATA INTERFACE", "data", "interface")},
    interactions.PortElement: {"kind": _words("PROVIDED REQUIRED", "provided", "required")},
    aspects.TechnicalAspect: {
        "multiplicity": _words("anyNumber atMostOne exactlyOne atLeastOne") | {"anyNumer": "anyNumber"}
    },
    aspects.TechnicalPolicyDefinition: {"applicability": _words("onComponent onPort onBoth")},
}
"""The words that an attribute may hold, and what each means; a word that means itself is the canonical one."""

SHORT_STRINGS = {"String8": "CHAR8", "String32": "CHAR32"}
"""Tags that stand for a StringType of these characters (10.1.4.2)."""

IGNORED = {(interactions.InteractionModule, "extends")}
"""Attributes that a printed schema has, although the class has no such field (9.3.2.2)."""

_PRINTED_INDEX_TYPES = {f"{at}{kind.lower()}": kind for kind in INTEGER_KINDS for at in ("", "@")}
OTHER_WORDS: Mapping[tuple[type[Element], str], Mapping[str, str]] = {
    (contracts.Enumeration, "type"): _PRINTED_INDEX_TYPES
}
"""What values of an attribute in another spelling mean (13.2.3)."""


class Spelling(msgspec.Struct, frozen=True, kw_only=True):
    """The XML spelling of one class.

    ``cls``: the class.
    ``clause``: the clause that defines it.
    ``tag``: its tag.
    ``other_tags``: other tags that the text prints for it.
    ``attributes``: fields by the names of attributes.
    ``other_attributes``: fields by other names that the text prints for attributes.
    ``required``: the fields that must be given.
    ``numbers``: the fields that hold numbers.
    ``truths``: the fields that hold truth values.
    ``contained``: the classes of children, by the fields that hold them.
    """

    cls: type[Element]
    clause: str
    tag: str
    other_tags: tuple[str, ...]
    attributes: dict[str, str]
    other_attributes: dict[str, str]
    required: frozenset[str]
    numbers: frozenset[str]
    truths: frozenset[str]
    contained: dict[str, tuple[type[Element], ...]]

    @property
    def literals(self) -> Mapping[str, Mapping[str, str]]:
        """The words of those fields that hold words."""
        return LITERALS.get(self.cls, {})

    def attribute(self, field: str) -> str:
        """What ``field`` is called in XML."""
        return next(name for name, known in self.attributes.items() if known == field)


def _spelling(
    cls: type[Element], clause: str, required: str = "", tag: str = "", also: str = "", **others: str
) -> Spelling:
    """``required`` and ``also`` (tags) are lists of words; ``others`` maps other names of attributes to fields."""
    hints = typing.get_type_hints(cls)
    fields = [field for field in cls.__struct_fields__ if field != "line"]
    held = {field: _classes(hints[field]) for field in fields}
    plain = [field for field in fields if not held[field]]
    return Spelling(
        cls=cls,
        clause=clause,
        tag=tag or cls.__name__,
        other_tags=tuple(also.split()),
        attributes={_camel(field): field for field in plain},
        other_attributes=({"identifier": "name"} if issubclass(cls, Named) else {}) | others,
        required=frozenset(required.split()),
        numbers=frozenset(field for field in plain if int in typing.get_args(hints[field])),
        truths=frozenset(field for field in plain if hints[field] is bool),
        contained={field: classes for field, classes in held.items() if classes},
    )


def _classes(hint: object) -> tuple[type[Element], ...]:
    """What a field that is so annotated may contain; nothing if it is an attribute."""
    if typing.get_origin(hint) is not tuple:
        return ()
    inner = typing.get_args(hint)[0]
    return typing.get_args(inner) if isinstance(inner, types.UnionType) else (inner,)


def _camel(field: str) -> str:
    first, *others = field.split("_")
    return first + "".join(other.capitalize() for other in others)


_SIZE = {"size": "max_size"}
_PRIMITIVE = {"aliasedPrimitive": "kind"}
_POLICY = {"definition": "technical_policy_definition"}

SPELLINGS: Mapping[type[Element], Spelling] = {
    spelling.cls: spelling
    for spelling in (
        # 9.1
        _spelling(common.SimpleComment, "9.1.4.3", "text", Text="text"),
        _spelling(modules.ApplicationModule, "9.1.4.7", "name"),
        _spelling(modules.PlatformModule, "9.1.4.8", "name"),
        _spelling(modules.Model, "9.1.4.4"),
        # 9.2
        _spelling(contracts.ContractModule, "9.2.2.15", "name"),
        _spelling(contracts.PrimitiveInteger, "9.2.3.2", "name kind", also="PrimitiveType", **_PRIMITIVE),
        _spelling(contracts.PrimitiveFloat, "9.2.3.3", "name kind", **_PRIMITIVE),
        _spelling(contracts.PrimitiveChar, "9.2.3.4", "name kind", **_PRIMITIVE),
        _spelling(contracts.PrimitiveBoolean, "9.2.3.5", "name"),
        _spelling(contracts.Alias, "9.2.4.2", "name type"),
        _spelling(contracts.Structure, "9.2.4.3", "name"),
        _spelling(contracts.StructureField, "9.2.4.4", "name type"),
        _spelling(contracts.Union, "9.2.4.5", "name selector_name selector_type"),
        _spelling(contracts.UnionCase, "9.2.4.6", "name type"),
        _spelling(contracts.SelectorValue, "9.2.4.6", "enumerator"),
        _spelling(contracts.Enumeration, "9.2.4.7", "name index_type", type="index_type"),
        _spelling(contracts.Enumerator, "9.2.4.8", "name value", indexValue="value"),
        _spelling(contracts.Array, "9.2.4.9", "name type", also="ArrayType"),
        _spelling(contracts.ArrayDimension, "9.2.4.11", "size index_type"),
        _spelling(contracts.StringType, "9.2.5.2", "name char_base", baseChar="char_base", **_SIZE),
        _spelling(contracts.NativeType, "9.2.5.3", "name max_size", **_SIZE),
        _spelling(contracts.Sequence, "9.2.5.4", "name type index_type max_size", also="SequenceType", **_SIZE),
        _spelling(contracts.Constant, "9.2.6.1", "name type value"),
        _spelling(contracts.Interface, "9.2.7.1", "name"),
        _spelling(contracts.InheritedInterface, "9.2.7.1", "interface"),
        _spelling(contracts.Method, "9.2.7.2", "name"),
        _spelling(contracts.RaisedException, "9.2.7.2", "exception"),
        _spelling(contracts.Parameter, "9.2.7.3", "name direction type"),
        _spelling(contracts.Attribute, "9.2.7.4", "name type"),
        _spelling(contracts.Exception_, "9.2.7.5", "name", tag="Exception"),
        _spelling(contracts.ExceptionField, "9.2.7.6", "name type"),
        _spelling(contracts.AbstractDataType, "9.2.8.1", "name", also="DataTypeTemplateParameter"),
        _spelling(
            contracts.AbstractInterface,
            "9.2.8.2",
            "name",
            also="InterfaceTypeTemplateParameter InterfaceTemplateParameter",
        ),
        _spelling(contracts.ConfigurationParameter, "9.2.9.1", "name type"),
        _spelling(contracts.ConfigurationParameterValue, "9.2.9.2", "configuration_parameter value"),
        _spelling(contracts.AnnotationDefinition, "9.2.9.3", "name", also="PropertyDefinition"),
        _spelling(contracts.Annotation, "9.2.9.4", "annotation_definition"),
        # 9.3
        _spelling(interactions.InteractionModule, "9.3.2.1", "name", also="InteractionDefinitionModule"),
        _spelling(interactions.InteractionPattern, "9.3.3.2", "name"),
        _spelling(interactions.InteractionItem, "9.3.3.3", "name nature"),
        _spelling(interactions.InteractionRole, "9.3.3.4", "name lower_multiplicity upper_multiplicity"),
        _spelling(interactions.InvolvedItem, "9.3.3.4", "item"),
        _spelling(interactions.ConnectorDefinition, "9.3.4.6", "name pattern"),
        _spelling(interactions.ConnectorPort, "9.3.4.6", "name port_role", also="ConnectorPortDefinition"),
        _spelling(interactions.ItemBinding, "9.3.4.6", "interaction_item connector_item"),
        _spelling(interactions.PortType, "9.3.5.1", "name", also="TemplatedPort"),
        _spelling(interactions.PortElement, "9.3.5.2", "name interface kind", intf="interface"),
        # 9.4
        _spelling(
            aspects.NonfunctionalAspectModule, "9.4.2.1", "name", also="TechnicalPolicyModule TechnicalAspectModule"
        ),
        _spelling(aspects.TechnicalAspect, "9.4.3.1", "name multiplicity"),
        _spelling(aspects.TechnicalPolicyDefinition, "9.4.3.2", "name technical_aspect applicability"),
        _spelling(aspects.ProgrammingLanguages, "9.4.4.1"),
        _spelling(aspects.Language, "9.4.4.2", "name"),
        # 9.5
        _spelling(components.ComponentModule, "9.5.2.1", "name"),
        _spelling(components.ComponentType, "9.5.3.1", "name"),
        _spelling(components.Port, "9.5.3.2", "name"),
        _spelling(components.PortRoleSpec, "9.5.3.4", "role"),
        _spelling(components.InteractionItemBinding, "9.5.3.5", "item actual_type"),
        _spelling(components.PortTypeSpec, "9.5.3.6", "type"),
        _spelling(components.AbstractTypeBinding, "9.5.3.7", "abstract_type actual_type"),
        _spelling(
            components.AtomicComponentImplementation,
            "9.5.4.1",
            "name type language",
            programmingLanguage="language",
        ),
        _spelling(components.TechnicalPolicy, "9.5.4.1", "name"),
        _spelling(components.ComponentTechnicalPolicy, "9.5.4.2", "name technical_policy_definition", **_POLICY),
        _spelling(components.ManagedComponent, "9.5.4.2", "name"),
        _spelling(components.ComponentPortTechnicalPolicy, "9.5.4.3", "name technical_policy_definition", **_POLICY),
        _spelling(components.ManagedPort, "9.5.4.3", "name"),
        _spelling(components.CompositeComponentImplementation, "9.5.5.2", "name type"),
        _spelling(
            components.AssemblyPart, "9.5.5.3", "name instance_of", "Part", "AssemblyPart", instanceof="instance_of"
        ),
        _spelling(components.Connection, "9.5.5.4", "name definition", connectionDefinition="definition"),
        _spelling(components.ConnectionEnd, "9.5.5.5", "part port"),
        _spelling(components.PortDelegation, "9.5.5.6", "port", externalPort="port"),
    )
}
"""All classes that a model can hold. ``PortDelegation`` may have no name; a rule asks for that of ``ConnectionEnd``."""


@functools.cache
def contained(cls: type[Element]) -> Mapping[type[Element], str]:
    """What may stand in a ``cls``, and the field that it goes to."""
    return {
        inner: field
        for field, classes in SPELLINGS[cls].contained.items()
        for inner in SPELLINGS
        if issubclass(inner, classes)
    }


@functools.cache
def containers(cls: type[Element]) -> tuple[str, ...]:
    """The tags of what a ``cls`` may stand in, in the order of clause 9; none if it can only be outermost."""
    return tuple(outer.tag for outer in SPELLINGS.values() if cls in contained(outer.cls))


@functools.cache
def fields_towards(cls: type[Element], kinds: tuple[type[Element], ...]) -> tuple[str, ...]:
    """The fields of a ``cls`` in which an element of ``kinds`` may stand, directly or deeper; of no kinds, all that hold elements."""
    held = contained(cls)
    wanted = {
        field for inner, field in held.items() if not kinds or any(issubclass(one, kinds) for one in _within(inner))
    }
    return tuple(field for field in common.child_fields(cls) if field in wanted)


@functools.cache
def _within(cls: type[Element]) -> frozenset[type[Element]]:
    """``cls``, and what may stand in it, however deep."""
    found = {cls}
    waiting = [cls]
    while waiting:
        new = contained(waiting.pop()).keys() - found
        found |= new
        waiting += new
    return frozenset(found)


TAGS: Mapping[str, type[Element]] = {
    tag: spelling.cls for spelling in SPELLINGS.values() for tag in (spelling.tag, *spelling.other_tags)
} | {tag: contracts.StringType for tag in SHORT_STRINGS}
"""The class of each tag, canonical or not."""
