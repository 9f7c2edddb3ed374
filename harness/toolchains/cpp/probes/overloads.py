"""One member function among others of its name, as C++ text: the only one with so many parameters, or one of those expected."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from ucm_cts.reference_models.mapping.cpp.classes import Forms

_MOST_ORDERS = 4
"""Up to so many parameters are tried in every order."""


@dataclass(frozen=True)
class Way:
    """How the function may be found: ``template`` declares what ``expression`` needs, whose type is that of a ``signature``."""

    expression: str
    function: str
    template: str = ""


def found_function(name: str, method: str, ways: Sequence[Way]) -> str:
    """Declares ``NAME<T>``, whose member ``function`` is the signature of ``method`` of the class T in the first way that works."""
    text = []
    for number, way in enumerate(ways):
        text.append(
            f"{way.template} template <class T> ::ucts::yes_type {name}_{number}(char (*)[sizeof({way.expression})]);"
            f" template <class T> ::ucts::no_type {name}_{number}(...);"
        )
    text.append(f"template <class T, int Way> struct {name}_at {{}};")
    for number, way in enumerate(ways):
        text.append(f"template <class T> struct {name}_at<T, {number}> {{ typedef {way.function} function; }};")
    chosen = "-1"
    for number in range(len(ways) - 1, -1, -1):
        chosen = f"(sizeof({name}_{number}<T>(0)) == sizeof(::ucts::yes_type) ? {number} : {chosen})"
    text.append(f"template <class T> struct {name} : {name}_at<T, {chosen}> {{}};")
    return " ".join(text).replace("{method}", method)


def ways_to(name: str, parameters: int, forms: Forms) -> list[Way]:
    """The only function with so many ``parameters``; else the one that is declared in one of ``forms``, which is not found among
    templates if it comes from a virtual base, and with any result only if there are no templates.
    """
    ways = [_alone(f"of_{'constant_' * constant}{parameters}") for constant in forms.constant]
    exact, cast = [], []
    for number, (signature, constant) in enumerate(itertools.product(forms.signatures, forms.constant)):
        taken = f"({', '.join(signature)}){' const' * constant}"
        of_any_class = f"R (C::*){taken}"
        helper = (
            f"template <class R, class C> ::ucts::signature<{of_any_class}> {name}_exactly_{number}({of_any_class});"
        )
        call = f"{name}_exactly_{number}(&T::{{method}})"
        exact.append(Way(call, f"UCTS_TYPE({call})", helper))
        for result in forms.results:
            pointer = f"{result} (T::*){taken}"
            cast.append(Way(f"static_cast<{pointer}>(&T::{{method}})", f"::ucts::signature<{pointer}>"))
    return [*ways, *exact, *cast]


def ways_to_startup(name: str, least: int, most: int, connections: Sequence[str]) -> list[Way]:
    """``on_startup``: the only one with ``most`` to ``least`` parameters, or the one that takes ``connections`` and no more."""
    alone = [_alone(f"of_{count}") for count in range(most, least - 1, -1)]
    if len(connections) > _MOST_ORDERS or least != len(connections):
        return alone
    constant = [f"const {connection}&" for connection in connections]
    forms = Forms(("void",), tuple(dict.fromkeys(itertools.permutations(constant))))
    return [*alone, *ways_to(name, least, forms)[1:]]


def _alone(function: str) -> Way:
    call = f"::ucts::{function}(&T::{{method}})"
    return Way(call, f"UCTS_TYPE({call})")
