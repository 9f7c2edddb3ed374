"""Names as developers give them, drawn at random: ``pump_controller``, ``leftValve2``, ``OrderTracker``.

No name holds another one, whatever the case of letters, so that each is found in a text without doubt; none is a keyword or a word
of an interface of UCM. All are identifiers of IDL, C++, Java and Python of at most 32 characters.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterable, Sequence


def _listed(words: str) -> Sequence[str]:
    return tuple(words.split())


_THINGS = _listed("""
pump valve motor tank brake wheel wing rotor turbine boiler furnace chiller heater fan duct door gate lift crane belt
conveyor robot gripper camera radar lidar sonar gyro compass antenna beacon lamp signal siren battery charger inverter grid
solar meter breaker relay fuse pressure torque speed altitude heading depth level flow humidity vibration voltage current
power fuel coolant oil water steam air smoke cabin cockpit engine gear flap rudder throttle cruise lane parking traffic
train track platform ticket passenger cargo parcel pallet truck fleet route depot dock harbour vessel buoy order invoice
payment basket shipment customer account loan ledger tariff booking hotel flight seat menu recipe oven patient ward dose
infusion heart blood oxygen lung scan image video audio speech weather wind rain river flood soil crop harvest tractor
greenhouse mill kiln press lathe drill weld paint
""")
"""Words of applications, and none of frameworks: a framework may name its own parts after those."""

_ROLES = _listed("""
controller monitor planner tracker logger estimator filter mixer switcher selector scheduler watcher guard governor
regulator driver reader keeper store archive board panel display dialog station desk office agent broker router bridge hub
sampler sensor actuator supervisor coordinator dispatcher inspector counter analyzer detector predictor simulator
calibrator limiter balancer optimizer converter translator printer scanner feeder sorter picker packer loader washer dryer
cutter limit rate gain offset mode state target setpoint alarm trend report summary history forecast profile curve map zone
area unit cell rack drive
""")
_PLACES = _listed("left right front rear upper lower inner outer main spare north south primary backup local remote")
_MORE = _listed("now again once twice soon later fully partly first last")
"""What makes a longer name of one for a method."""

_LETTERS = 9
"""The length of words of letters only."""

_SHORTEST = 5
LONGEST = 32


def _snake(words: Iterable[str]) -> str:
    return "_".join(words)


def _camel(words: Iterable[str]) -> str:
    first, *others = words
    return first + "".join(map(str.capitalize, others))


def _pascal(words: Iterable[str]) -> str:
    return "".join(map(str.capitalize, words))


_STYLES: tuple[Callable[[Iterable[str]], str], ...] = (_snake, _camel, _pascal)
_NINE = tuple(pair for pair in itertools.product(_THINGS, _ROLES) if len("".join(pair)) == _LETTERS)


class NameIndex:
    """Finds names in texts. All have at least five characters."""

    def __init__(self) -> None:
        self._by_start: dict[str, list[str]] = {}

    def add(self, name: str) -> None:
        """One more name to be found."""
        alike = self._by_start.setdefault(name[:_SHORTEST], [])
        alike.append(name)
        alike.sort(key=len, reverse=True)

    def at(self, text: str, place: int) -> str | None:
        """The longest name that begins at ``place`` of ``text``."""
        alike = self._by_start.get(text[place : place + _SHORTEST], ())
        return next((name for name in alike if text.startswith(name, place)), None)


class Naming:
    """Draws names from ``source``, never the same twice."""

    def __init__(self, source: random.Random) -> None:
        self._random = source
        self._known = NameIndex()
        self._text = "\n"

    def name(self) -> str:
        """One more name."""
        return self._new(self._compound)

    def word(self) -> str:
        """One more name, of nine letters and nothing else."""
        return self._new(lambda: self._random.choice(_STYLES[1:])(self._random.choice(_NINE)))

    def longer(self, name: str) -> str:
        """One more name, which begins with ``name`` and therefore with all that this begins with."""
        more = self._random.choice(_MORE)
        longer = f"{name}_{more}" if "_" in name else name + more.capitalize()
        for number in itertools.count(2):
            if longer.casefold() not in self._text:
                break
            longer = f"{longer.rstrip('0123456789')}{number}"
        self._keep(longer)
        return longer

    def _compound(self) -> str:
        draw = self._random
        style, words, form = draw.choice(_STYLES), [draw.choice(_THINGS)], draw.random()
        if form < 0.1:
            return f"{style(words)}{draw.randrange(2, 100)}"
        words.append(draw.choice(_ROLES))
        if form < 0.5:
            return style([draw.choice(_PLACES), *words])
        return style(words) if form < 0.7 else f"{style(words)}{draw.randrange(1, 65)}"

    def _new(self, draw: Callable[[], str]) -> str:
        for attempt in itertools.count():
            name = draw()
            if attempt > 50:  # names become rare in endless runs
                name += f"{'_' if name[-1].isdigit() else ''}{self._random.randrange(100, 100 + attempt * attempt)}"
            if _SHORTEST <= len(name) <= LONGEST and not self._clashes(name.casefold()):
                self._keep(name)
                return name
        raise AssertionError

    def _clashes(self, name: str) -> bool:
        """Whether ``name`` holds a known name, or one holds it."""
        return name in self._text or any(self._known.at(name, place) for place in range(len(name)))

    def _keep(self, name: str) -> None:
        self._known.add(name.casefold())
        self._text += f"{name.casefold()}\n"
