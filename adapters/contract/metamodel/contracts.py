"""Data types, constants, interfaces, exceptions, annotations and configuration (9.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.common import Element, Named

INTEGER_RANGES = {
    "BYTE": (-(2**7), 2**7 - 1),
    "SHORT": (-(2**15), 2**15 - 1),
    "LONG": (-(2**31), 2**31 - 1),
    "LONGLONG": (-(2**63), 2**63 - 1),
    "UBYTE": (0, 2**8 - 1),
    "USHORT": (0, 2**16 - 1),
    "ULONG": (0, 2**32 - 1),
    "ULONGLONG": (0, 2**64 - 1),
}
"""PrimitiveIntegerKind and the bounds of each (9.2.3.2)."""

FLOAT_KINDS = ("FLOAT", "DOUBLE", "LONGDOUBLE")
CHAR_KINDS = ("CHAR8", "CHAR32")

UNBOUNDED = -1
"""``max_size`` of what has no greatest size (9.2.5.1)."""


class ConfigurationParameterValue(Element, frozen=True, kw_only=True):
    """A value for a parameter (9.2.9.2).

    ``configuration_parameter``: reference to the parameter, as ``definition.parameter``.
    ``value``: in the syntax of IDL constants.
    """

    configuration_parameter: str = ""
    value: str = ""


class Annotation(Element, frozen=True, kw_only=True):
    """The use of an annotation definition (9.2.9.4).

    ``annotation_definition``: reference to the definition.
    ``configuration_values``: the values of the definition's parameters.
    """

    annotation_definition: str = ""
    configuration_values: tuple[ConfigurationParameterValue, ...] = ()


class Annotable(Named, frozen=True, kw_only=True):
    """What may carry annotations (9.2.2.8)."""

    annotations: tuple[Annotation, ...] = ()


class ConfigurationParameter(Named, frozen=True, kw_only=True):
    """A setting of a platform element or of an annotation (9.2.9.1).

    ``type``: reference to its data type.
    ``default_value``: in the syntax of IDL constants; None if there is none.
    """

    type: str = ""
    default_value: str | None = None


class AnnotationDefinition(Named, frozen=True, kw_only=True):
    """What annotations may say; 10.2 calls it a property definition (9.2.9.3)."""

    configuration_parameters: tuple[ConfigurationParameter, ...] = ()


class DataType(Annotable, frozen=True, kw_only=True):
    """Ancestor of all concrete data types (9.2.2.2, 9.2.3.1)."""


class PrimitiveInteger(DataType, frozen=True, kw_only=True):
    """``kind`` is one of ``INTEGER_RANGES`` (9.2.3.2)."""

    kind: str = ""


class PrimitiveFloat(DataType, frozen=True, kw_only=True):
    """``kind`` is one of ``FLOAT_KINDS`` (9.2.3.3)."""

    kind: str = ""


class PrimitiveChar(DataType, frozen=True, kw_only=True):
    """``kind`` is one of ``CHAR_KINDS`` (9.2.3.4)."""

    kind: str = ""


class PrimitiveBoolean(DataType, frozen=True, kw_only=True):
    """The truth values (9.2.3.5)."""


class Alias(DataType, frozen=True, kw_only=True):
    """Another name for a data type (9.2.4.2)."""

    type: str = ""


class StructureField(Annotable, frozen=True, kw_only=True):
    """A named part of a structure (9.2.4.4)."""

    type: str = ""


class Structure(DataType, frozen=True, kw_only=True):
    """At least one field (9.2.4.3)."""

    fields: tuple[StructureField, ...] = ()


class SelectorValue(Element, frozen=True, kw_only=True):
    """An enumerator of the union's selector, by its bare name (9.2.4.6)."""

    enumerator: str = ""


class UnionCase(Annotable, frozen=True, kw_only=True):
    """What a union holds for some values of its selector (9.2.4.6).

    ``type``: reference to the data type.
    ``selector_values``: the enumerators that select it.
    ``default_case``: whether all other enumerators select it, too.
    """

    type: str = ""
    selector_values: tuple[SelectorValue, ...] = ()
    default_case: bool = False


class Union(DataType, frozen=True, kw_only=True):
    """A union; at least one case in a legal model (9.2.4.5).

    ``selector_name``: the name of the selector.
    ``selector_type``: reference to an enumeration.
    ``cases``: its alternatives.
    """

    selector_name: str = ""
    selector_type: str = ""
    cases: tuple[UnionCase, ...] = ()


class Enumerator(Named, frozen=True, kw_only=True):
    """A value of an enumeration (9.2.4.8).

    ``value``: its index; None if the model gives none.
    """

    value: int | None = None


class Enumeration(DataType, frozen=True, kw_only=True):
    """An enumeration; at least one enumerator in a legal model (9.2.4.7).

    ``index_type``: an integer kind, or reference to a PrimitiveInteger.
    ``enumerators``: its values.
    """

    index_type: str = ""
    enumerators: tuple[Enumerator, ...] = ()


class ArrayDimension(Element, frozen=True, kw_only=True):
    """One dimension of an array (9.2.4.11).

    ``size``: the number of elements; None if the model gives none.
    ``index_type``: an integer kind, or reference to a PrimitiveInteger.
    """

    size: int | None = None
    index_type: str = ""


class Array(DataType, frozen=True, kw_only=True):
    """At least one dimension (9.2.4.9)."""

    type: str = ""
    dimensions: tuple[ArrayDimension, ...] = ()


class StringType(DataType, frozen=True, kw_only=True):
    """A string (9.2.5.2).

    ``char_base``: one of ``CHAR_KINDS``.
    ``max_size``: the greatest number of characters; may be ``UNBOUNDED``, None if the model gives none.
    """

    char_base: str = ""
    max_size: int | None = None


class NativeType(DataType, frozen=True, kw_only=True):
    """A type of the programming language (9.2.5.3).

    ``max_size``: the greatest number of bytes; None if the model gives none.
    """

    max_size: int | None = None


class Sequence(DataType, frozen=True, kw_only=True):
    """Elements of one type (9.2.5.4).

    ``type``: reference to the type of its elements.
    ``index_type``: an integer kind, or reference to a PrimitiveInteger.
    ``max_size``: the greatest number of elements; may be ``UNBOUNDED``, None if the model gives none.
    """

    type: str = ""
    index_type: str = ""
    max_size: int | None = None


class Constant(Annotable, frozen=True, kw_only=True):
    """A value of a data type, in the syntax of IDL constants (9.2.6.1)."""

    type: str = ""
    value: str = ""


class ExceptionField(Named, frozen=True, kw_only=True):
    """A named part of an exception (9.2.7.6)."""

    type: str = ""


class Exception_(Named, frozen=True, kw_only=True):
    """What a method raises, the text's class Exception (9.2.7.5)."""

    fields: tuple[ExceptionField, ...] = ()


class Parameter(Named, frozen=True, kw_only=True):
    """A parameter of a method (9.2.7.3).

    ``direction``: IN, OUT, INOUT or RETURN.
    ``type``: reference to a data type or an interface.
    """

    direction: str = ""
    type: str = ""


class RaisedException(Element, frozen=True, kw_only=True):
    """An exception that a method may raise (9.2.7.2)."""

    exception: str = ""


class Method(Annotable, frozen=True, kw_only=True):
    """A method's signature (9.2.7.2)."""

    parameters: tuple[Parameter, ...] = ()
    raised_exceptions: tuple[RaisedException, ...] = ()


class Attribute(Annotable, frozen=True, kw_only=True):
    """An attribute of a component type or an interface (9.2.7.4).

    ``type``: reference to its data type.
    ``mode``: READ or READWRITE, empty if the model gives none.
    ``default_value``: in the syntax of IDL constants; None if there is none.
    """

    type: str = ""
    mode: str = ""
    default_value: str | None = None


class InheritedInterface(Element, frozen=True, kw_only=True):
    """An interface that another one inherits (9.2.7.1)."""

    interface: str = ""


class Interface(Annotable, frozen=True, kw_only=True):
    """Methods and attributes, and those of the interfaces inherited (9.2.7.1)."""

    inherited_interfaces: tuple[InheritedInterface, ...] = ()
    attributes: tuple[Attribute, ...] = ()
    methods: tuple[Method, ...] = ()


class AbstractDataType(Named, frozen=True, kw_only=True):
    """A placeholder for a data type (9.2.8.1)."""


class AbstractInterface(Named, frozen=True, kw_only=True):
    """A placeholder for an interface (9.2.8.2)."""


class ContractModule(Named, frozen=True, kw_only=True):
    """Declarations of contracts (9.2.2.15).

    ``contract_modules``: modules inside it.
    ``data_types``: data types, also abstract ones.
    ``constants``: constants.
    ``exceptions``: exceptions.
    ``interfaces``: interfaces, also abstract ones.
    ``annotation_definitions``: annotation definitions.
    """

    contract_modules: tuple[ContractModule, ...] = ()
    data_types: tuple[DataType | AbstractDataType, ...] = ()
    constants: tuple[Constant, ...] = ()
    exceptions: tuple[Exception_, ...] = ()
    interfaces: tuple[Interface | AbstractInterface, ...] = ()
    annotation_definitions: tuple[AnnotationDefinition, ...] = ()
