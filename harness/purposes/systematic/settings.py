"""The settings of machines (``suite/systematic_settings.yaml``): a few named components in containers, and the inputs."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import ContainerCall, Declaration
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.tables import read_table

NAMES = ("one", "two", "below", "across")
"""The settings of the file."""


class Input(Value, frozen=True):
    """An input of a machine.

    ``name``: for readers.
    ``step``: the input.
    ``follow``: steps that prepare later inputs; their output is ignored.
    """

    name: str
    step: ContainerCall
    follow: tuple[ContainerCall, ...] = ()

    @property
    def steps(self) -> tuple[ContainerCall, ...]:
        """All of them."""
        return (self.step, *self.follow)


class Setting(Value, frozen=True):
    """A system that a machine is derived for.

    ``name``: for ids.
    ``text``: for readers.
    ``components``: by name.
    ``inputs``: of the machine.
    """

    name: str
    text: str
    components: dict[str, Declaration]
    inputs: tuple[Input, ...]


@functools.cache
def _settings() -> dict[str, Setting]:
    return {setting.name: setting for setting in read_table(SUITE / "systematic_settings.yaml", Setting)}


def setting(name: str) -> Setting:
    """The setting of that name. Raises ``DocumentError``."""
    return _settings()[name]


def relays(count: int) -> Setting:
    """So many components in one container, each of which may be connected to any."""
    names = tuple(f"relay{n}" for n in range(1, count + 1))
    inputs: list[Input] = []
    for name in names:
        found = s.GetPortElement(name, "in.api", f"{name} element")
        inputs += [
            Input(f"add {name}", s.AddComponent(name), (found,)),
            Input(f"remove {name}", s.RemoveComponent(name)),
        ]
        for server in names:
            connect = s.Connect(name, "out.api", f"{server} element", f"{name} link")
            inputs.append(Input(f"connect {name} to {server}", connect))
        inputs.append(Input(f"disconnect {name}", s.Disconnect(f"{name} link")))
    inputs += [Input("start", s.Start()), Input("stop", s.Stop())]
    text = f"{count} components in one container, each connected to any"
    relay = Declaration(("in.api",), ("out.api",), {}, True)
    return Setting(f"relays-{count}", text, dict.fromkeys(names, relay), tuple(inputs))
