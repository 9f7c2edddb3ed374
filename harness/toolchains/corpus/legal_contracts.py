"""Draws contracts that keep all rules of 9.2: the first half of ``legal_models``."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeVar

import msgspec
from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element, Named, SimpleComment

Path = tuple[str, ...]

_STEMS = st.sampled_from(["alpha", "Beta", "gamma_", "x", "Long_Name_", "d2_", "with-hyphen_"])
_WORDS = st.sampled_from(["said", "a < b & c", '"quoted"', "two\nlines", "é"])
_KINDS = st.sampled_from(sorted(c.INTEGER_RANGES))
_SMALL = st.integers(1, 100)
SOME = st.integers(0, 2)


T = TypeVar("T", bound=Element)


@dataclass(frozen=True)
class Known:
    """Something with a name that can be referred to, and where it is declared: ``path`` leads to it from the root."""

    path: Path
    element: Any


@dataclass
class Drawing:
    """One model that is being drawn. Every name is drawn once, so that references mean what they are meant to."""

    draw: st.DrawFn
    names: int = 0
    data_types: list[Known] = field(default_factory=list)
    interfaces: list[Known] = field(default_factory=list)
    constants: list[Known] = field(default_factory=list)
    annotations: list[Known] = field(default_factory=list)

    def name(self) -> str:
        """A name that nothing else in the model has."""
        self.names += 1
        return f"{self.draw(_STEMS)}{self.names}"

    def one(self, known: list[Known]) -> Known:
        """One of ``known``."""
        return known[self.draw(st.integers(0, len(known) - 1))]

    def refer(self, target: Path, here: Path) -> str:
        """``target`` as one may write it in the module ``here``: from the root, or from here or anything around it."""
        common = 0
        while common < min(len(here), len(target) - 1) and here[common] == target[common]:
            common += 1
        forms = ["::" + "::".join(target), *("::".join(target[start:]) for start in range(common + 1))]
        return self.draw(st.sampled_from(forms))

    def annotated(self, element: T, here: Path) -> T:
        """``element``, perhaps with a comment, and with an annotation if it may have one."""
        changes: dict[str, Any] = {}
        if isinstance(element, Named) and not self.draw(st.integers(0, 4)):
            changes["comments"] = (SimpleComment(text=self.draw(_WORDS)),)
        if isinstance(element, c.Annotable) and self.annotations and not self.draw(st.integers(0, 4)):
            definition = self.one(self.annotations)
            values = tuple(
                c.ConfigurationParameterValue(
                    configuration_parameter=f"{self.refer(definition.path, here)}.{parameter.name}",
                    value=self.value_of(parameter.type, here),
                )
                for parameter in definition.element.configuration_parameters
                if self.draw(st.booleans())
            )
            annotation = c.Annotation(
                annotation_definition=self.refer(definition.path, here), configuration_values=values
            )
            changes["annotations"] = (annotation,)
        return msgspec.structs.replace(element, **changes) if changes else element

    # data types and values

    def contract_module(self, here: Path, deep: int = 1) -> c.ContractModule:
        """A contract module called like the last of ``here``."""
        primitives = [
            self._declare(self.data_types, self._primitive(), here) for _ in range(self.draw(st.integers(1, 3)))
        ]
        definitions = [
            self._declare(self.annotations, self._annotation_definition(here), here) for _ in range(self.draw(SOME))
        ]
        inner = [self.contract_module((*here, self.name()), deep - 1) for _ in range(self.draw(SOME) if deep else 0)]
        made = [self._declare(self.data_types, self._complex(here), here) for _ in range(self.draw(st.integers(0, 4)))]
        constants = [self._declare(self.constants, self._constant(here), here) for _ in range(self.draw(SOME))]
        exceptions = [self._exception(here) for _ in range(self.draw(SOME))]
        raised = [(*here, exception.name) for exception in exceptions]
        interfaces = [
            self._declare(self.interfaces, self.interface(here, raised), here) for _ in range(self.draw(SOME))
        ]
        return self.annotated(
            c.ContractModule(
                name=here[-1],
                contract_modules=tuple(inner),
                data_types=tuple(self.draw(st.permutations([*primitives, *made]))),
                constants=tuple(constants),
                exceptions=tuple(exceptions),
                interfaces=tuple(self.draw(st.permutations(interfaces))),
                annotation_definitions=tuple(definitions),
            ),
            here,
        )

    def _declare(self, known: list[Known], element: Any, here: Path) -> Any:
        element = self.annotated(element, here)
        known.append(Known((*here, element.name), element))
        return element

    def _primitive(self) -> c.DataType:
        name, kind = self.name(), self.draw(st.integers(0, 5))
        if kind == 0:
            return c.PrimitiveFloat(name=name, kind=self.draw(st.sampled_from(c.FLOAT_KINDS)))
        if kind == 1:
            return c.PrimitiveChar(name=name, kind=self.draw(st.sampled_from(c.CHAR_KINDS)))
        if kind == 2:
            return c.PrimitiveBoolean(name=name)
        if kind == 3:
            size = self.draw(st.none() | st.just(c.UNBOUNDED) | _SMALL)
            return c.StringType(name=name, char_base=self.draw(st.sampled_from(c.CHAR_KINDS)), max_size=size)
        return c.PrimitiveInteger(name=name, kind=self.draw(_KINDS))

    def _complex(self, here: Path) -> c.DataType:
        """A type over those that there are, so that none contains itself."""
        name, type_ = self.name(), self.data_type(here)
        make = self.draw(st.sampled_from(["alias", "structure", "union", "enumeration", "array", "sequence", "native"]))
        if make == "alias":
            return c.Alias(name=name, type=type_)
        if make == "structure":
            fields = [c.StructureField(name=f"field{n}", type=self.data_type(here)) for n in range(self.draw(_FEW))]
            return c.Structure(name=name, fields=tuple(self.annotated(f, here) for f in fields))
        if make == "union":
            return self._union(name, here)
        if make == "enumeration":
            return self._enumeration(name, here)
        if make == "array":
            dimensions = [
                c.ArrayDimension(size=self.draw(_SMALL), index_type=self._index_type(here))
                for _ in range(self.draw(_FEW))
            ]
            return c.Array(name=name, type=type_, dimensions=tuple(dimensions))
        if make == "sequence":
            size = self.draw(st.just(c.UNBOUNDED) | _SMALL)
            return c.Sequence(name=name, type=type_, index_type=self._index_type(here), max_size=size)
        return c.NativeType(name=name, max_size=self.draw(_SMALL))

    def data_type(self, here: Path) -> str:
        """A reference to some data type that was drawn already."""
        return self.refer(self.one(self.data_types).path, here)

    def _index_type(self, here: Path) -> str:
        integers = [known for known in self.data_types if isinstance(known.element, c.PrimitiveInteger)]
        if bool(integers) and self.draw(st.booleans()):
            return self.refer(self.one(integers).path, here)
        return self.draw(_KINDS)

    def _enumeration(self, name: str, here: Path) -> c.Enumeration:
        values = self.draw(st.lists(st.integers(0, 127), min_size=1, max_size=4, unique=True))
        literals = tuple(c.Enumerator(name=f"{self.name()}_literal", value=value) for value in values)
        return c.Enumeration(name=name, index_type=self._index_type(here), enumerators=literals)

    def _union(self, name: str, here: Path) -> c.DataType:
        selectors = [known for known in self.data_types if isinstance(known.element, c.Enumeration)]
        if not selectors:
            return self._enumeration(name, here)
        selector = self.one(selectors)
        literals = [enumerator.name for enumerator in selector.element.enumerators]
        cut = self.draw(st.integers(1, len(literals)))
        heaps = [literals[:cut]]
        if bool(literals[cut:]) and self.draw(st.booleans()):
            heaps.append(literals[cut:])
        cases = tuple(
            c.UnionCase(
                name=f"case{n}",
                type=self.data_type(here),
                selector_values=tuple(c.SelectorValue(enumerator=literal) for literal in heap),
                default_case=n == len(heaps) - 1 and self.draw(st.booleans()),
            )
            for n, heap in enumerate(heaps)
        )
        return c.Union(name=name, selector_name="selector", selector_type=self.refer(selector.path, here), cases=cases)

    def valued(self) -> list[Known]:
        """The types of which values can be written."""
        kinds = (c.PrimitiveInteger, c.PrimitiveFloat, c.PrimitiveChar, c.PrimitiveBoolean, c.StringType, c.Enumeration)
        return [known for known in self.data_types if isinstance(known.element, kinds)]

    def value(self, known: Known) -> str:
        """A value of a type, as IDL writes it."""
        element = known.element
        if isinstance(element, c.PrimitiveInteger):
            return str(self.draw(st.integers(*c.INTEGER_RANGES[element.kind])))
        if isinstance(element, c.PrimitiveFloat):
            return self.draw(st.sampled_from(["1.5", "-0.25", "1e3"]))
        if isinstance(element, c.PrimitiveChar):
            return "'a'" if element.kind == "CHAR8" else self.draw(st.sampled_from(["'a'", "L'a'"]))
        if isinstance(element, c.PrimitiveBoolean):
            return self.draw(st.sampled_from(["TRUE", "FALSE"]))
        if isinstance(element, c.StringType):
            return '"a"'
        return str(self.draw(st.sampled_from(element.enumerators)).name)

    def value_of(self, reference: str, here: Path) -> str:
        """A value of the type that ``reference`` means; names are drawn once, so its last part tells."""
        return self.value(next(k for k in self.data_types if k.path[-1] == reference.rpartition("::")[2]))

    def _constant(self, here: Path) -> c.Constant:
        known = self.one(self.valued())
        return c.Constant(name=self.name(), type=self.refer(known.path, here), value=self.value(known))

    def parameters(self, here: Path) -> tuple[c.ConfigurationParameter, ...]:
        """Configuration parameters, with and without defaults."""
        drawn = []
        for _ in range(self.draw(SOME)):
            known = self.one(self.valued())
            default = self.value(known) if self.draw(st.booleans()) else None
            drawn.append(
                c.ConfigurationParameter(name=self.name(), type=self.refer(known.path, here), default_value=default)
            )
        return tuple(drawn)

    def _annotation_definition(self, here: Path) -> c.AnnotationDefinition:
        return c.AnnotationDefinition(name=self.name(), configuration_parameters=self.parameters(here))

    # interfaces

    def _exception(self, here: Path) -> c.Exception_:
        fields = (c.ExceptionField(name=f"detail{n}", type=self.data_type(here)) for n in range(self.draw(SOME)))
        return self.annotated(c.Exception_(name=self.name(), fields=tuple(fields)), here)

    def interface(self, here: Path, raised: list[Path], types: tuple[Path, ...] = ()) -> c.Interface:
        """An interface whose methods take ``types`` and others, and inherit at most one that was drawn before."""
        inherits = bool(self.interfaces) and self.draw(st.booleans())
        ancestors = (self.refer(self.one(self.interfaces).path, here),) if inherits else ()
        methods = [self._method(here, raised, ()) for _ in range(self.draw(SOME))]
        if types:
            methods.append(self._method(here, raised, types))
        return c.Interface(
            name=self.name(),
            inherited_interfaces=tuple(c.InheritedInterface(interface=ancestor) for ancestor in ancestors),
            attributes=tuple(self.attribute(here) for _ in range(self.draw(SOME))),
            methods=tuple(self.annotated(method, here) for method in methods),
        )

    def attribute(self, here: Path) -> c.Attribute:
        """An attribute of an interface or a component type."""
        known = self.one(self.valued())
        attribute = c.Attribute(
            name=self.name(),
            type=self.refer(known.path, here),
            mode=self.draw(st.sampled_from(["READ", "READWRITE"])),
            default_value=self.value(known) if self.draw(st.booleans()) else None,
        )
        return self.annotated(attribute, here)

    def _method(self, here: Path, raised: list[Path], types: tuple[Path, ...]) -> c.Method:
        given = [self.refer(path, here) for path in types] + [self.data_type(here) for _ in range(self.draw(SOME))]
        directions = [self.draw(st.sampled_from(["IN", "OUT", "INOUT"])) for _ in given]
        if bool(given) and self.draw(st.booleans()):
            directions[-1] = "RETURN"
        thrown = [self.refer(path, here) for path in raised if self.draw(st.booleans())]
        return c.Method(
            name=self.name(),
            parameters=tuple(
                c.Parameter(name=f"parameter{n}", direction=direction, type=type_)
                for n, (direction, type_) in enumerate(zip(directions, given, strict=True))
            ),
            raised_exceptions=tuple(c.RaisedException(exception=exception) for exception in thrown),
        )


_FEW = st.integers(1, 3)
