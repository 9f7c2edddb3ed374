"""Component types and atomic implementations as the classes that component bodies implement (13.7 to 13.9)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel import components, contracts, interactions
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage
from ucm_cts.reference_models.mapping.cpp import claims, classes
from ucm_cts.reference_models.mapping.cpp.context import DATA, INTERFACES, Context, expect, plain, spelled
from ucm_cts.reference_models.mapping.cpp.expected import Expected
from ucm_cts.reference_models.mapping.cpp.interfaces import (
    Bindings,
    Interfaces,
    Unsayable,
    depends_on_bindings,
    interface_class,
    single_line,
)

LANGUAGES = ("c++", "cpp")
"""The beginnings of the names of languages of this mapping, in any case; 9.4.4.2 leaves the names to the vendor."""

LIFE_CYCLE = {"on_init": "R-13.7-05", "on_shutdown": "R-13.7-06", "on_remove": "R-13.7-07"}


@dataclass(frozen=True)
class Use:
    """A port element as a component has it: ``owner`` is its port or policy, ``key`` what its interface is implemented by."""

    owner: components.Port | components.TechnicalPolicy
    prefix: str
    element: interactions.PortElement
    interface: Declared
    bindings: Bindings
    key: str

    @property
    def name(self) -> str:
        """``<port>_<element>``."""
        return f"{self.prefix}_{plain(self.element.name)}"

    @property
    def expected_class(self) -> str:
        """The class of the interface; nothing if its name depends on what it is bound to, which the text does not say."""
        return "" if depends_on_bindings(self.interface) else interface_class(self.interface)


class Components:
    """What is expected of the implementations of a model."""

    def __init__(self, context: Context, interfaces: Interfaces) -> None:
        self._context = context
        self._interfaces = interfaces
        self.abstract: list[classes.Abstract] = []

    def expected(self) -> Iterator[Expected]:
        """What is expected of all atomic implementations in C++, unless the vendor has generic bodies only (13.9)."""
        if self._context.reading("cpp-bodies") == "generic":
            return
        for declared in self._context.declared:
            element = declared.element
            if isinstance(element, components.AtomicComponentImplementation) and _is_cpp(element.language):
                type_ = declared.scope.find(element.type, components.ComponentType)
                if type_ is not None and self._context.is_sayable(declared.path):
                    try:
                        yield from list(self._implementation(declared, type_))
                    except Unsayable:
                        continue

    def class_of(self, declared: Declared) -> str:
        """The class of an implementation: 13.7 says prefix, its example has a suffix."""
        if self._context.reading("cpp-component-class", "prefix") == "suffix":
            return spelled(declared, suffix="_Abstract")
        return spelled(declared, "Abstract_")

    def _implementation(self, declared: Declared, type_: Declared) -> Iterator[Expected]:
        ports = list(self._ports(type_))
        policies = list(self._policies(declared))
        abstract = self._abstract(declared, type_, ports, policies)
        owner = self.class_of(declared)
        yield expect("R-13.7-01", declared, claims.IsAbstract(classes.Named(owner)))
        yield expect("R-13.7-03", declared, claims.Declares(owner))
        yield expect("R-13.3-02", declared, claims.Declares(owner))
        yield expect("R-13-03", declared, claims.NotCorba(classes.Named(owner)))
        yield from self._life_cycle(declared, owner, abstract)
        for use in ports:
            yield from self._port(declared, owner, abstract, use)
        yield from self._startup(declared, owner, abstract)
        for claim in self._attributes(type_, owner, abstract.key):
            yield expect("R-13.7-13", declared, claim)
        getters = self._policy_getters(policies)
        for use in getters:
            yield from self._getter(declared, owner, abstract, use, f"get_tp_{use.name}", ("17", "18", "19"))
        yield expect("R-13.7-20", declared, claims.NothingElse(classes.Named(owner), _members(abstract)))
        yield expect("R-13.7-02", declared, claims.Implemented(classes.Named(owner), abstract.key))
        yield expect("R-13.9-01", declared, claims.Implemented(classes.Named(owner), abstract.key))
        yield expect("R-13.9-04", declared, claims.Runs(owner, abstract.key))

    def _ports(self, type_: Declared) -> Iterator[Use]:
        for ancestor in reversed(lineage(type_)):
            assert isinstance(ancestor.element, components.ComponentType)
            for port in ancestor.element.ports:
                if port.refines_port:
                    raise Unsayable(port.name)
                for spec in port.specs:
                    if isinstance(spec, components.PortTypeSpec):
                        yield from self._port_type(port, spec, ancestor.scope)

    def _port_type(self, port: components.Port, spec: components.PortTypeSpec, scope: Scope) -> Iterator[Use]:
        found = scope.find(spec.type, interactions.PortType)
        if found is None or not isinstance(found.element, interactions.PortType):
            raise Unsayable(spec.type)
        bindings = _bindings(spec.bindings, scope)
        for element in found.element.port_elements:
            yield self._use(port, port.name, element, found.scope, bindings)

    def _policies(self, declared: Declared) -> Iterator[Use]:
        assert isinstance(declared.element, components.AtomicComponentImplementation)
        for named in declared.element.policies:
            policy = declared.scope.find(named.name, components.ComponentTechnicalPolicy)
            if policy is None or not isinstance(policy.element, components.ComponentTechnicalPolicy):
                raise Unsayable(named.name)
            definition = policy.scope.find(policy.element.technical_policy_definition, TechnicalPolicyDefinition)
            if definition is None:
                raise Unsayable(policy.element.technical_policy_definition)
            prefix = self._policy_name(policy, definition, declared)
            bindings = _bindings(policy.element.bindings, policy.scope)
            for ancestor in reversed(lineage(definition)):
                assert isinstance(ancestor.element, TechnicalPolicyDefinition)
                for element in ancestor.element.port_elements:
                    yield self._use(named, prefix, element, ancestor.scope, bindings)

    def _policy_name(self, policy: Declared, definition: Declared, declared: Declared) -> str:
        match self._context.reading("cpp-get-tp-name", "instance"):
            case "definition":
                return definition.element.name
            case "component-instance":
                assert isinstance(declared.element, components.AtomicComponentImplementation)
                return f"{declared.element.type.rpartition('::')[2]}{policy.element.name}"
        return policy.element.name

    def _use(
        self,
        owner: components.Port | components.TechnicalPolicy,
        prefix: str,
        element: interactions.PortElement,
        scope: Scope,
        bindings: Bindings,
    ) -> Use:
        found = scope.find(element.interface, *INTERFACES)
        if found is not None and isinstance(found.element, contracts.AbstractInterface):
            found = next((actual for path, actual in bindings if path == found.path), None)
        if found is None or not isinstance(found.element, contracts.Interface):
            raise Unsayable(element.interface)
        if not self._context.is_sayable(found.path, prefix, element.name):
            raise Unsayable(element.name)
        return Use(owner, plain(prefix), element, found, bindings, self._interfaces.key(found, bindings))

    def _policy_getters(self, policies: list[Use]) -> list[Use]:
        kind = "REQUIRED" if self._context.reading("cpp-policy-getters", "component") == "policy" else "PROVIDED"
        return [use for use in policies if use.element.kind == kind]

    def _abstract(self, declared: Declared, type_: Declared, ports: list[Use], policies: list[Use]) -> classes.Abstract:
        methods: list[classes.Method] = []
        for ancestor in reversed(lineage(type_)):
            assert isinstance(ancestor.element, components.ComponentType)
            methods += self._interfaces.members.of_attributes(ancestor.element.attributes, ancestor, ())
        provided = [classes.Getter(f"get_{u.name}", u.key) for u in ports if u.element.kind == "PROVIDED"]
        getters = dict.fromkeys(classes.Getter(f"get_tp_{u.name}", u.key) for u in self._policy_getters(policies))
        if len({getter.name for getter in getters}) < len(getters):  # policies of one definition, with other bindings
            raise Unsayable(declared.element.name)
        offered = [u for u in policies if u not in self._policy_getters(policies)]
        abstract = classes.Abstract(
            f"component_{len(self.abstract)}",
            tuple(methods),
            (*provided, *getters),
            True,
            tuple(classes.Connection(f"{u.name}_Connection", u.key) for u in ports if u.element.kind == "REQUIRED"),
            () if self._context.reading("cpp-policy-connections") == "none" else tuple(u.key for u in offered),
            alike=len(offered) - len({u.name for u in offered}),
            owner=self.class_of(declared),
        )
        self.abstract.append(abstract)
        return abstract

    def _life_cycle(self, declared: Declared, owner: str, abstract: classes.Abstract) -> Iterator[Expected]:
        for function, requirement in LIFE_CYCLE.items():
            forms = classes.Forms(("void",), ((),))
            yield expect(requirement, declared, claims.Arity(classes.Named(owner), function, 0, forms))
            yield expect(requirement, declared, claims.Passed(classes.Named(owner), function, 0, 0, ("void",), forms))
            yield expect(requirement, declared, claims.Pure(classes.Named(owner), abstract.key, function, 0))

    def _startup(self, declared: Declared, owner: str, abstract: classes.Abstract) -> Iterator[Expected]:
        yield expect("R-13.7-04", declared, claims.Pure(classes.Named(owner), abstract.key, "on_startup", -1))
        yield expect("R-13.7-12", declared, self._startup_of(abstract))

    def _startup_of(self, abstract: classes.Abstract) -> claims.Startup:
        count, more = len(abstract.startup), len(abstract.more)
        must = self._context.reading("cpp-policy-connections") == "on_startup"
        least = count + more - abstract.alike if must else count
        return claims.Startup(abstract.owner, least, count + more, tuple(c.name for c in abstract.startup))

    def _port(self, declared: Declared, owner: str, abstract: classes.Abstract, use: Use) -> Iterator[Expected]:
        if use.element.kind == "PROVIDED":
            yield from self._getter(declared, owner, abstract, use, f"get_{use.name}", ("14", "15", "16"))
            return
        name = f"{use.name}_Connection"
        for requirement, claim in (
            ("R-13.7-08", claims.DeclaresConnection(owner, name)),
            ("R-13.7-09", claims.ConnectionTemplate(owner, name)),
            ("R-13.7-10", claims.ConnectionShape(owner, name)),
            ("R-13.7-11", claims.ConnectionTo(owner, name, use.expected_class)),
            ("R-13.7-12", claims.StartupTakes(owner, name, self._startup_of(abstract))),
        ):
            yield expect(requirement, declared, claim, _named(use))
        yield from self._element(declared, use, classes.Connected(owner, name))

    def _getter(
        self,
        declared: Declared,
        owner: str,
        abstract: classes.Abstract,
        use: Use,
        name: str,
        numbers: tuple[str, str, str],
    ) -> Iterator[Expected]:
        there, pure, reference = (f"R-13.7-{number}" for number in numbers)
        yield expect(there, declared, claims.Arity(classes.Named(owner), name, 0), _named(use))
        yield expect(pure, declared, claims.Pure(classes.Named(owner), abstract.key, name, 0), _named(use))
        yield expect(reference, declared, claims.ReturnsReference(owner, name, use.expected_class), _named(use))
        yield from self._element(declared, use, classes.Returned(owner, name))

    def _element(self, declared: Declared, use: Use, reached: classes.Class) -> Iterator[Expected]:
        """What is expected of the class of a port element's interface (13.8)."""
        yield expect("R-13.8-02", declared, claims.InheritsElement(reached), _named(use))
        yield expect("R-13.8-03", declared, claims.NoOperations(reached, "PortElementObject"), _named(use))
        if use.expected_class:
            return
        yield expect("R-13.8-01", declared, claims.Implemented(reached, use.key), _named(use))
        for each in single_line(use.interface):
            assert isinstance(each.element, contracts.Interface)
            for method in each.element.methods:
                yield from self._interfaces.method_expected(method, each, reached, use.key, use.bindings)

    def _attributes(self, type_: Declared, owner: str, key: str) -> Iterator[claims.Claim]:
        for ancestor in reversed(lineage(type_)):
            assert isinstance(ancestor.element, components.ComponentType)
            for attribute in ancestor.element.attributes:
                requirements = ("", "", "", "")
                found = self._interfaces.attribute_claims(attribute, ancestor, classes.Named(owner), key, requirements)
                yield from (claim for _, claim in found)


def _named(use: Use) -> interactions.PortElement:
    return interactions.PortElement(name=use.name, line=use.owner.line)


def _members(abstract: classes.Abstract) -> tuple[str, ...]:
    life_cycle = (*LIFE_CYCLE, "on_startup")
    return (*life_cycle, *(m.name for m in abstract.methods), *(g.name for g in abstract.getters))


def _bindings(given: tuple[components.AbstractTypeBinding, ...], scope: Scope) -> Bindings:
    found = []
    for binding in given:
        abstract = scope.find(binding.abstract_type, *DATA, *INTERFACES)
        stands = scope.find(binding.actual_type, *DATA, *INTERFACES)
        if abstract is not None and stands is not None:
            found.append((abstract.path, stands))
    return tuple(found)


def _is_cpp(language: str) -> bool:
    name = language.rpartition("::")[2].lower()
    return not name or name.startswith(LANGUAGES)
