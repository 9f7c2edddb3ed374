"""The settings of machines: a few named components in containers, and the inputs.

An input has a name and stands for the same steps wherever it is given. Names are the tester's: ``remove client`` uses the
id that was got last for the client, and an id that was never given out before there is one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import ContainerCall, Declaration

SERVER = Declaration(provides=("in.api",), connectable=True)
CLIENT = Declaration(requires=("out.api",), connectable=True)
RELAY = Declaration(("in.api",), ("out.api",), {}, True)


@dataclass(frozen=True)
class Input:
    """``step`` is the input; the steps that ``follow`` prepare later ones, and their output is ignored."""

    name: str
    step: ContainerCall
    follow: tuple[ContainerCall, ...] = ()

    @property
    def steps(self) -> tuple[ContainerCall, ...]:
        """All of them."""
        return (self.step, *self.follow)


@dataclass(frozen=True)
class Setting:
    """A system that a machine is derived for.

    ``name``: for ids.
    ``text``: for readers.
    ``components``: by name.
    ``inputs``: of the machine.
    """

    name: str
    text: str
    components: Mapping[str, Declaration]
    inputs: tuple[Input, ...]


def one() -> Setting:
    """One container, one component."""
    inputs = (*_member("server", s.MANAGER, SERVER), *_container(s.MANAGER), _end())
    return Setting("one", "one container with one component", {"server": SERVER}, inputs)


def two() -> Setting:
    """One container, two components, one of which needs the other."""
    inputs = (
        *_member("server", s.MANAGER, SERVER),
        *_member("client", s.MANAGER, CLIENT),
        *_links("client", s.MANAGER, ("server",)),
        *_wrong("client", s.MANAGER, "server"),
        *_container(s.MANAGER),
        _end(),
    )
    return Setting("two", "one container with two components and a connection", _PAIR, inputs)


def below() -> Setting:
    """The same in a sub-container that comes and goes."""
    inputs = (
        *_box(),
        *_member("server", "box", SERVER),
        *_member("client", "box", CLIENT),
        *_links("client", "box", ("server",)),
        *_wrong("client", "box", "server"),
        *_container("box"),
        _end(),
    )
    return Setting("below", "a sub-container with two components and a connection", _PAIR, inputs)


def across() -> Setting:
    """A client in the manager, its server in a sub-container."""
    inputs = (
        *_box(),
        *_member("server", "box", SERVER),
        *_member("client", s.MANAGER, CLIENT),
        *_links("client", s.MANAGER, ("server",)),
        *_wrong("client", s.MANAGER, "server"),
        *_container("box"),
        *_container(s.MANAGER),
        _end(),
    )
    return Setting("across", "a client in the manager, its server in a sub-container", _PAIR, inputs)


def relays(count: int) -> Setting:
    """So many components in one container, each of which may be connected to any."""
    names = tuple(f"relay{n}" for n in range(1, count + 1))
    inputs: list[Input] = []
    for name in names:
        inputs += [_add(name, s.MANAGER, RELAY), Input(f"remove {name}", s.RemoveComponent(name))]
        inputs += _links(name, s.MANAGER, names)
    inputs += [Input("start", s.Start()), Input("stop", s.Stop())]
    text = f"{count} components in one container, each connected to any"
    return Setting(f"relays-{count}", text, dict.fromkeys(names, RELAY), tuple(inputs))


_PAIR: Mapping[str, Declaration] = {"server": SERVER, "client": CLIENT}


def _member(name: str, container: str, declaration: Declaration) -> Iterator[Input]:
    yield _add(name, container, declaration)
    yield Input(f"remove {name}", s.RemoveComponent(name, container))
    for port in (*declaration.provides, *declaration.requires, "else.where"):
        yield Input(f"get {name} {port}", s.GetPortElement(name, port, f"{name} {port} again", container))


def _add(name: str, container: str, declaration: Declaration) -> Input:
    found = tuple(s.GetPortElement(name, port, _element(name), container) for port in declaration.provides)
    return Input(f"add {name}", s.AddComponent(name, container), found)


def _element(name: str) -> str:
    return f"{name} element"


def _links(client: str, container: str, servers: tuple[str, ...]) -> Iterator[Input]:
    for server in servers:
        connect = s.Connect(client, "out.api", _element(server), f"{client} link", container)
        yield Input(f"connect {client} to {server}", connect)
    yield Input(f"disconnect {client}", s.Disconnect(f"{client} link", container))


def _wrong(client: str, container: str, server: str) -> Iterator[Input]:
    """Connects that can only be refused."""
    for port, to in (("out.api", s.NIL), ("else.where", _element(server))):
        connect = s.Connect(client, port, to, "never", container)
        yield Input(f"connect {client} {port} to {'nothing' if to == s.NIL else server}", connect)


def _container(name: str) -> Iterator[Input]:
    where = "" if name == s.MANAGER else f" {name}"
    yield Input(f"start{where}", s.Start(name))
    yield Input(f"stop{where}", s.Stop(name))
    yield Input(f"list{where}", s.GetComponents(name))
    yield Input(f"add nobody{where}", s.AddComponent("nobody", name, "nobody"))


def _box() -> Iterator[Input]:
    yield Input("create box", s.CreateContainer("box"))
    yield Input("remove box", s.RemoveContainer("box"))


def _end() -> Input:
    return Input("destroy", s.Destroy())
