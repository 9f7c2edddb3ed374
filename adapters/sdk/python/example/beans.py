"""Beans, a toy framework for docs/adapter-python.md: ids are texts, a link is an object, errors are two exceptions."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping
from typing import Any

NUMBERS = itertools.count(1)


class Missing(Exception):
    """There is no bean, link or pod of that name."""


class Trouble(Exception):
    """Any other error."""


class Link:
    def __init__(self, owner: Any, port: str, target: object) -> None:
        self.owner, self.port, self.target = owner, port, target


class Pod:
    """Holds beans that are started, stopped and removed together."""

    def __init__(self, kinds: Mapping[str, tuple[Callable[[], Any], Iterable[str]]]) -> None:
        self.kinds = kinds  # name -> (factory of a bean, ports that must be tied)
        self.beans: dict[str, Any] = {}
        self.links: list[Link] = []
        self.pods: list[Pod] = []
        self.running: list[Any] = []

    def plant(self, kind: str, settings: Mapping[str, str], before_init: Callable[[Any], None]) -> str:
        if kind not in self.kinds or self.running:
            raise Trouble(f"cannot plant {kind}")
        make, bean_wants = self.kinds[kind]
        bean = make()
        bean.wants = bean_wants
        for name, value in settings.items():
            bean.set_attribute(name, value)
        try:
            before_init(bean)
            bean.on_init()
        except Exception as error:
            raise Trouble(f"{kind} does not want to live: {error}") from error
        name = f"bean-{next(NUMBERS)}"
        self.beans[name] = bean
        return name

    def bean(self, name: str) -> Any:
        if name not in self.beans:
            raise Missing(name)
        return self.beans[name]

    def pull(self, name: str) -> None:
        bean = self.bean(name)
        if bean in self.running or any(link.owner is bean for link in self.links):
            raise Trouble(f"{name} is in use")
        bean.on_remove()
        del self.beans[name]

    def tie(self, name: str, port: str, target: object) -> Link:
        if port not in self.bean(name).wants:
            raise Missing(port)
        if target is None:
            raise Trouble("nothing to tie to")
        link = Link(self.bean(name), port, target)
        self.links.append(link)
        if hasattr(link.owner, "on_connect"):
            link.owner.on_connect(port, target)
        return link

    def untie(self, link: Link | None) -> None:
        if link not in self.links:
            raise Missing("link")
        self.links.remove(link)
        if hasattr(link.owner, "on_disconnect"):
            link.owner.on_disconnect(link.port)

    def wake(self, describe: Callable[[Link], object]) -> None:
        for bean in self.beans.values():
            bean.on_startup([describe(link) for link in self.links if link.owner is bean])
            self.running.append(bean)

    def sleep(self) -> None:
        while self.running:
            self.running.pop().on_shutdown()

    def drop(self, pod: Pod) -> None:
        if pod not in self.pods:
            raise Missing("pod")
        self.pods.remove(pod)
        pod.clear()

    def clear(self) -> None:
        for pod in self.pods:
            pod.clear()
        self.sleep()
        while self.links:
            self.untie(self.links[-1])
        for name in list(self.beans):
            self.pull(name)
