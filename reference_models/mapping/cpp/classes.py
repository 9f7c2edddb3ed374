"""The subjects of claims about C++: classes, their members, and values to test them with."""

from __future__ import annotations

import itertools

from ucm_cts.adapters.contract.value import Value


class Named(Value, frozen=True):
    """A class that C++ code can name."""

    name: str


class Returned(Value, frozen=True):
    """The class that the reference points to which the function ``getter`` of ``owner`` returns."""

    owner: str
    getter: str


class Connected(Value, frozen=True):
    """The class that a member ``ref`` of the connection type points to; ``connection`` is looked up in the class ``owner``."""

    owner: str
    connection: str


Class = Named | Returned | Connected


class Sample(Value, frozen=True):
    """Two different values of a type.

    ``type``: the type.
    ``first``, ``second``: C++ expressions of the values.
    ``comparable``: whether the type has ``==``.
    """

    type: str
    first: str
    second: str
    comparable: bool


class Parameter(Value, frozen=True):
    """``types`` are all ways in which it may be passed; ``written`` if the callee gives it a value."""

    types: tuple[str, ...]
    sample: Sample
    written: bool


class Method(Value, frozen=True):
    """A member function; ``result`` is None for void; ``constant`` says whether it may be ``const``, or not."""

    name: str
    result: Sample | None
    parameters: tuple[Parameter, ...]
    constant: tuple[bool, ...] = (False,)

    def signatures(self) -> list[tuple[str, ...]]:
        """The types of the parameters in every way in which they may be passed."""
        return list(itertools.product(*(p.types for p in self.parameters)))


class Forms(Value, frozen=True):
    """The declarations that a function may have: one of ``results``, the types of one of ``signatures``, ``const`` or not."""

    results: tuple[str, ...] = ()
    signatures: tuple[tuple[str, ...], ...] = ()
    constant: tuple[bool, ...] = (False,)


class Getter(Value, frozen=True):
    """A member function that returns a reference to an interface; ``interface`` is the key of what is implemented."""

    name: str
    interface: str


class Connection(Value, frozen=True):
    """The type that connections of a required port element have."""

    name: str
    interface: str


class Abstract(Value, frozen=True):
    """A class that user code implements, with inherited members.

    ``key``: its key, unique in the model.
    ``methods``: its member functions, inherited ones first.
    ``getters``: the functions that return its port elements.
    ``life_cycle``: whether it has the life cycle of a component.
    ``startup``: the connections that a component is started with.
    ``more``: types of connections that policies may add.
    ``alike``: how many of ``more`` have the name of another one, and may be one with it.
    ``inherited``: the number of inherited ``methods``.
    ``owner``: the class of a component, empty for interfaces.
    """

    key: str
    methods: tuple[Method, ...] = ()
    getters: tuple[Getter, ...] = ()
    life_cycle: bool = False
    startup: tuple[Connection, ...] = ()
    more: tuple[str, ...] = ()
    alike: int = 0
    inherited: int = 0
    owner: str = ""
