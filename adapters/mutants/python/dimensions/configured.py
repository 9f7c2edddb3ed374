"""Configuration values: of each instance, that mean nothing to its implementation, and absent ones with defaults."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import takewhile

from ucm_cts.adapters.contract.programming_model import FragmentObject, Implementation
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Member

Values = Mapping[str, str]

_CONFIGURED, _DEFAULT, _CLAUSES = "R-11.2.1.2-05", "R-9.2.7.4-04", ("9.2.7.4",)


def _once(container: Container, member: Member, values: Values) -> dict[str, str]:
    """The values that were given first for the implementation of ``member``."""
    known: dict[str, dict[str, str]] = container.manager.__dict__.setdefault("known", {})
    return known.setdefault(member.implementation.name, dict(values))


# of each instance


@replaces("_set_attributes", _CONFIGURED)
def configures_implementations(self: Base, member: Member, values: Values) -> None:
    """The values of the first instance hold for all instances of its implementation."""
    Base._set_attributes(self, member, _once(self, member, values))


@replaces("_set_attributes", _CONFIGURED)
def keeps_first_values_below(self: Base, member: Member, values: Values) -> None:
    """A sub-container configures all instances of an implementation as the first one of the runtime was."""
    first = _once(self, member, values)
    Base._set_attributes(self, member, first if is_below(self) else values)


@replaces("_set_attributes", _CONFIGURED)
def keeps_values_that_were_the_same(self: Base, member: Member, values: Values) -> None:
    """If one value of a later instance is as the first one's, the first one's other values are taken, too."""
    first = _once(self, member, values)
    Base._set_attributes(self, member, first if set(first.items()) & set(values.items()) else values)


# that mean nothing


@replaces("_find_implementation", "R-12.10-04")
def breaks_at_meaningless_values(self: Base, name: str, values: Values) -> Implementation:
    """A value for an attribute that the implementation does not have ends add_component in an undeclared exception."""
    found = Base._find_implementation(self, name, {})
    for each in values:
        list(found.attributes).index(each)
    return found


@replaces("_find_implementation", "R-11.2.2.1-14")
def keeps_what_it_refused(self: Base, name: str, values: Values) -> Implementation:
    """What is refused because of a value that means nothing is a member all the same."""
    found = self.manager.implementations.get(name)
    if found is not None and set(values).difference(found.attributes):
        member = Member(self._new_id(), found, self._instantiate(found), self)
        self._configure(member, {})
        self.members[member.id] = member
    return Base._find_implementation(self, name, values)


@replaces("_find_implementation")
def ignores_meaningless_values(self: Base, name: str, _values: Values) -> Implementation:
    """Values for attributes that the implementation does not have reach the body, which has no use for them."""
    return Base._find_implementation(self, name, {})


@breaks(_CONFIGURED)
class stops_at_meaningless_values(Base):
    """What follows a value that means nothing is not set."""

    def _find_implementation(self, name: str, _values: Values) -> Implementation:
        return super()._find_implementation(name, {})

    def _set_attributes(self, member: Member, values: Values) -> None:
        meaning = takewhile(lambda value: value[0] in member.implementation.attributes, values.items())
        super()._set_attributes(member, dict(meaning))


@breaks(_CONFIGURED)
class gives_meaningless_values_to_others(Base):
    """A value that means nothing is taken for the first attribute of the implementation."""

    def _find_implementation(self, name: str, _values: Values) -> Implementation:
        return super()._find_implementation(name, {})

    def _set_attributes(self, member: Member, values: Values) -> None:
        own = member.implementation.attributes
        foreign = [value for name, value in values.items() if name not in own]
        meant = {name: value for name, value in values.items() if name in own}
        super()._set_attributes(member, {**meant, **dict(zip(own, foreign, strict=False))})


# absent ones


@replaces("_set_attributes", _DEFAULT, clauses=_CLAUSES)
def forgets_defaults(self: Base, member: Member, values: Values) -> None:
    """Default values are not set."""
    for name, value in values.items():
        member.body.set_attribute(name, value)


@replaces("_set_attributes", _CONFIGURED, clauses=_CLAUSES)
def prefers_defaults(self: Base, member: Member, values: Values) -> None:
    """Default values replace configured ones."""
    Base._set_attributes(self, member, {**values, **member.implementation.defaults})


@replaces("_set_attributes", _DEFAULT, clauses=_CLAUSES)
def sets_defaults_of_unconfigured_components_only(self: Base, member: Member, values: Values) -> None:
    """Defaults are set only if nothing at all is configured."""
    for name, value in (values or member.implementation.defaults).items():
        member.body.set_attribute(name, value)


@replaces("_set_attributes", _DEFAULT, clauses=_CLAUSES)
def takes_earlier_values_for_defaults(self: Base, member: Member, values: Values) -> None:
    """What an earlier instance was configured with is the default of later ones."""
    known: dict[str, dict[str, str]] = self.manager.__dict__.setdefault("known", {})
    last = known.setdefault(member.implementation.name, {})
    last.update(values)
    Base._set_attributes(self, member, last)


@replaces("_configure", _DEFAULT, clauses=_CLAUSES)
def sets_defaults_after_on_init(self: Base, member: Member, values: Values) -> None:
    """Default values are set when on_init is over."""
    for name, value in values.items():
        member.body.set_attribute(name, value)
    if isinstance(member.body, FragmentObject):
        member.body.set_container_interface(self)
    self._initialise(member)
    Base._set_attributes(self, member, values)


@replaces("_set_attributes", clauses=_CLAUSES, readings={"attribute-defaults": "unasked"})
def leaves_defaults_to_bodies(self: Base, member: Member, values: Values) -> None:
    """Only configured values are set."""
    for name, value in values.items():
        member.body.set_attribute(name, value)
