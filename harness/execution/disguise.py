"""The disguise of a run: drawn names and payloads, different in each run, so that a framework cannot hard-code answers.

Traces are judged in the disguised spelling, against the disguised scenario; only what people read is revealed.
A name the framework made up stays as it is and therefore never equals a name of the scenario.
"""

from __future__ import annotations

import functools
import random
import re
import string
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeVar

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum, Interface
from ucm_cts.adapters.contract.data_values import read_spelled
from ucm_cts.adapters.contract.scenario import Action, Declaration, Policy, Scenario
from ucm_cts.adapters.contract.traits import Binds, Names, Subject, fields
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.execution.naming import Naming
from ucm_cts.harness.execution.revealing import Revealing
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.payloads import EDGES, LARGEST
from ucm_cts.harness.results.foreign import one_line

T = TypeVar("T")
S = TypeVar("S", bound=Value)

LONGEST_NAME = 100
"""Characters that the pattern of names of port elements may have."""

_WORD = re.compile(r"\w{2,32}")
"""An attribute value that says nothing but its name."""


class Disguise:
    """A reversible renaming of all names and payloads, drawn from ``seed``; grows as scenarios are disguised.

    ``port_element_name`` is the framework's own way to make one name of ``{port}`` and ``{element}``; raises
    ``WrongUse`` if it does not say how.
    """

    def __init__(self, seed: int, port_element_name: str) -> None:
        _check(port_element_name)
        self._random = random.Random(seed)
        self._naming = Naming(self._random)
        self._port_element_name = port_element_name
        self._tokens: dict[str, str] = {}
        self._words: dict[str, str] = {}
        self._ports: dict[str, str] = {}
        self._values: dict[int, int] = {}
        self._revealing = Revealing()

    def scenario(self, scenario: Scenario) -> Scenario:
        """``scenario`` in disguise."""
        for interface in scenario.interfaces.values():
            self._name_alike(interface.methods)
        for declaration in scenario.components.values():
            ports = (*declaration.provides, *declaration.requires)
            self._name_alike(element for _, _, element in (port.partition(".") for port in ports) if element)
        return Scenario(
            {self._name(name): self._declaration(d) for name, d in scenario.components.items()},
            tuple(map(self._named, scenario.steps)),
            scenario.patience,
            {
                self._name(name): Interface(
                    {self._method(m): what for m, what in interface.methods.items()},
                    tuple(map(self._method, interface.inherited)),
                )
                for name, interface in scenario.interfaces.items()
            },
            types={self._name(name): types for name, types in scenario.types.items()},
        )

    def reveal(self, value: T) -> T:
        """``value``, any message value or finding, in the script's own names and payloads."""
        return _read_again(self._revealing.reveal(_text(value)), value)

    def words_in(self, value: object) -> dict[str, str]:
        """The drawn names and payloads in ``value``, each with what it stands for: all that ``revealed_by`` needs to reveal it."""
        return self._revealing.words_in(_text(value))

    def _remember(self, disguised: str, plain: str) -> None:
        self._revealing.add(_as_json(disguised), _as_json(plain))

    def _name(self, plain: str) -> str:
        token = self._tokens.get(plain)
        if token is None:
            token = self._tokens[plain] = self._naming.name()
            self._remember(token, plain)
        return token

    def _word(self, plain: str) -> str:
        """The beginning of a message: letters only, and always as many."""
        token = self._words.get(plain)
        if token is None:
            token = self._words[plain] = self._naming.word()
            self._remember(token, plain)
        return token

    def _name_alike(self, names: Iterable[str]) -> None:
        """If a name begins with a shorter one, its drawn name does so, too. For methods of an interface, and elements of ports."""
        known = sorted({*names} - s.STANDARD_METHODS - s.STANDARD_ELEMENTS, key=lambda name: (len(name), name))
        for number, name in enumerate(known):
            beginnings = [other for other in known[:number] if name.startswith(other)]
            if beginnings and name not in self._tokens:
                token = self._tokens[name] = self._naming.longer(self._name(beginnings[-1]))
                self._remember(token, name)

    def _port(self, plain: str) -> str:
        spelled = self._ports.get(plain)
        if spelled is None:
            port, _, element = plain.partition(".")
            spelled = self._name(port)
            if element:
                known = element if element in s.STANDARD_ELEMENTS else self._name(element)
                spelled = self._port_element_name.format(port=spelled, element=known)
            self._ports[plain] = spelled
            self._remember(spelled, plain)
        return spelled

    def _value(self, plain: int) -> int:
        if plain in EDGES:
            return plain
        value = self._values.get(plain)
        if value is None:
            value = self._random.randrange(10**9, LARGEST)
            while str(value) in self._revealing:
                value = self._random.randrange(10**9, LARGEST)
            if plain < 0:
                value = ~value
            self._values[plain] = value
            self._remember(str(value), str(plain))
            self._remember(str(~value), str(~plain))
        return value

    def _declaration(self, d: Declaration) -> Declaration:
        return Declaration(
            tuple(map(self._port, d.provides)),
            tuple(map(self._port, d.requires)),
            self._attributes(d.attributes),
            d.connectable,
            d.fragment,
            {hook: tuple(map(self._action, actions)) for hook, actions in d.plan.items()},
            tuple(map(self._policy, d.policies)),
            {self._port(port): self._name(interface) for port, interface in d.ports.items()},
            self._attributes(d.defaults),
            tuple(map(self._port, d.handlers)),
        )

    def _attributes(self, values: Mapping[str, str]) -> dict[str, str]:
        return {self._name(name): self._configured(value) for name, value in values.items()}

    def _configured(self, plain: str) -> str:
        """Only words are disguised: some frameworks parse values of types, and other texts are there for what they look like."""
        return self._name(plain) if _is_word(plain) else plain

    def _policy(self, policy: Policy) -> Policy:
        """Definitions keep their standard names."""
        parameters = dict(policy.parameters)
        if s.METHODS_TO_TRACE in parameters:
            named = parameters[s.METHODS_TO_TRACE]
            parameters[s.METHODS_TO_TRACE] = re.sub(r"\w+", lambda method: self._method(method.group()), named)
        return msgspec.structs.replace(
            policy,
            port=self._port(policy.port) if policy.port is not None else None,
            element=self._port(policy.element) if policy.element is not None else None,
            parameters=parameters,
        )

    def _method(self, plain: str) -> str:
        """Methods of 10.1 have standard names."""
        return plain if plain in s.STANDARD_METHODS else self._name(plain)

    def _action(self, action: Action) -> Action:
        named = self._named(action)
        if isinstance(named, s.CallMethod):
            remembered = tuple(map(self._named, named.remembered))
            clock = self._named(named.from_clock) if named.from_clock is not None else None
            timer = self._named(named.on) if named.on is not None else None
            return msgspec.structs.replace(
                named, arguments=self._arguments(named), remembered=remembered, from_clock=clock, on=timer
            )
        return named

    def _arguments(self, call: s.CallMethod) -> tuple[Datum, ...]:
        """Messages for the log begin with a word."""
        match call.method, call.arguments:
            case "log", (severity, str(message)):
                return severity, re.sub(r"^[A-Za-z]+", lambda name: self._word(name.group()), message)
            case _:
                return call.arguments

    def _named(self, value: S) -> S:
        """A step or an action in disguise. Variables, gates and workers keep their names, because no framework sees them."""
        changed: dict[str, str | int | dict[str, str]] = {}
        for field, trait in _disguised_fields(type(value)):
            plain = getattr(value, field)
            if plain is None:
                continue
            if isinstance(trait, Names):
                changed[field] = _IN_DISGUISE[trait.subject](self, plain)
            elif not plain:
                changed[field] = getattr(value, trait.otherwise)
        return msgspec.structs.replace(value, **changed) if changed else value


_IN_DISGUISE: Mapping[Subject, Callable[[Disguise, Any], str | int | dict[str, str]]] = {
    "implementation": Disguise._name,
    "component": Disguise._name,
    "interface": Disguise._name,
    "port element": Disguise._port,
    "method": Disguise._method,
    "payload": Disguise._value,
    "attribute": Disguise._attributes,
}
"""How each kind of subject is disguised. Gates and workers are not."""


@functools.lru_cache(1000)
def _is_word(text: str) -> bool:
    return bool(_WORD.fullmatch(text)) and read_spelled(text) is None


@functools.cache
def _disguised_fields(kind: type[Value]) -> tuple[tuple[str, Names | Binds], ...]:
    """The fields that a disguise may change."""
    return tuple(
        (field, trait)
        for field, trait in fields(kind)
        if (isinstance(trait, Names) and trait.subject in _IN_DISGUISE)
        or (isinstance(trait, Binds) and trait.otherwise)
    )


def revealed_by(words: Mapping[str, str], value: T) -> T:
    """``value`` with each of ``words`` replaced. Raises ``msgspec.MsgspecError`` if it is then no value of its type."""
    revealing = Revealing()
    for drawn, plain in words.items():
        revealing.add(drawn, plain)
    return _read_again(revealing.reveal(_text(value)), value)


def _text(value: object) -> str:
    return msgspec.json.encode(value).decode()


def _read_again(text: str, value: T) -> T:
    return msgspec.json.decode(text.encode(), type=type(value))


def _as_json(text: str) -> str:
    """``text`` as it stands between the quotes of JSON."""
    return msgspec.json.encode(text).decode()[1:-1]


def _check(port_element_name: str) -> None:
    """Only ``{port}`` and ``{element}`` as they are: a format specification or conversion can take any time and memory."""
    try:
        parts = [part[1:] for part in string.Formatter().parse(port_element_name) if part[1] is not None]
    except ValueError:
        parts = []
    plain = sorted(parts) == [("element", "", None), ("port", "", None)]
    if not plain or len(port_element_name) > LONGEST_NAME or not port_element_name.isprintable():
        raise WrongUse(
            f"the adapter spells port elements '{one_line(port_element_name, 80)}'; that must hold {{port}} and {{element}} "
            f"once each, without a format, in at most {LONGEST_NAME} printable characters"
        )
