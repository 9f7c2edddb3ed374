"""Loads a Python adapter by name, as a function that answers wire messages."""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.util
import inspect
import os
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import cast

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.sdk.python.engine import Emit, Engine

Answer = Callable[[bytes, Emit], bytes]
"""Answers one line of the wire protocol; may send lines ahead of the answer when a run is streamed."""


_MOVED = {
    "ucm_cts.adapters.derived": "ucm_cts.adapters.mutants.python",
    "ucm_cts.adapters.gstreamer": "ucm_cts.adapters.integrations.gstreamer",
    "ucm_cts.adapters.ipopo": "ucm_cts.adapters.integrations.ipopo",
    "ucm_cts.adapters.reference_py": "ucm_cts.adapters.reference.python",
}
"""Deprecated names of packages with bundled adapters, and what they are called now (docs/decisions/0011)."""


class CannotLoad(Exception):
    """The text names no adapter; the message has the reason and the remedy."""


def load(spec: str) -> Answer:
    """What ``spec`` names: ``package.module:Class``, ``package.module`` or the path of an extension module.

    The class is a subclass of ``Adapter``, the module has a function ``answer(message: bytes) -> bytes`` which may take
    a second parameter ``emit`` as ``Engine.answer`` does. The current directory is searched too. Raises ``CannotLoad``.
    """
    spec = current_name(spec)
    module_name, colon, class_name = spec.partition(":")
    if colon:
        cls = _find_class(_import(module_name), class_name)
        return Engine(cls).answer
    module = _import_file(Path(spec)) if _is_path(spec) else _import(spec)
    return _answer_of(module)


def current_name(spec: str) -> str:
    """``spec``, with the present name of its package. Warns of a deprecated one."""
    for old, new in _MOVED.items():
        if spec.startswith((f"{old}.", f"{old}:")):
            warnings.warn(f"{old} is deprecated: use {new}", FutureWarning, stacklevel=2)
            return spec.replace(old, new, 1)
    return spec


def _answer_of(module: ModuleType) -> Answer:
    answer = getattr(module, "answer", None)
    if not callable(answer):
        adapters = _complete_adapters(module)
        hint = f"; did you mean {module.__name__}:{adapters[0]}" if adapters else ""
        raise CannotLoad(f"module {module.__name__} has no function answer(bytes) -> bytes{hint}")
    if _can_stream(answer):
        return cast(Answer, answer)
    return lambda line, emit: cast(bytes, answer(line))


def _can_stream(answer: Callable[..., object]) -> bool:
    try:
        return "emit" in inspect.signature(answer).parameters
    except ValueError:  # functions of extension modules say it in the first line of their documentation
        return "emit" in (answer.__doc__ or "").partition("\n")[0]


def _is_path(spec: str) -> bool:
    return os.sep in spec or spec.endswith((".so", ".pyd"))


def _import(name: str) -> ModuleType:
    if "" not in sys.path and os.getcwd() not in sys.path:
        sys.path.insert(0, os.getcwd())
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and (name == error.name or name.startswith(error.name + ".")):
            raise CannotLoad(
                f"there is no module {error.name}; searched: {os.getcwd()}, on PYTHONPATH and among the "
                f"packages of {sys.prefix}"
            ) from None
        raise CannotLoad(f"importing {name} failed: {error}; install what it needs beside ucm-cts") from error
    except (Exception, SystemExit) as error:
        raise CannotLoad(f"importing {name} failed: {type(error).__name__}: {error}") from error


def _import_file(path: Path) -> ModuleType:
    name = path.name.partition(".")[0]
    try:
        loader = importlib.machinery.ExtensionFileLoader(name, str(path.resolve()))
        spec = importlib.util.spec_from_loader(name, loader)
        assert spec
        module = importlib.util.module_from_spec(spec)
        loader.exec_module(module)
    except Exception as error:
        raise CannotLoad(f"{path} is no extension module of this Python ({type(error).__name__}: {error})") from error
    return module


def _find_class(module: ModuleType, name: str) -> type[Adapter]:
    found = getattr(module, name, None)
    if found is None:
        adapters = _complete_adapters(module)
        there = f"; there is {', '.join(adapters)}" if adapters else ""
        raise CannotLoad(f"module {module.__name__} has no {name}{there}")
    if not _is_adapter(found):
        raise CannotLoad(f"{module.__name__}:{name} is not a subclass of ucm_cts.adapters.contract.adapter.Adapter")
    cls: type[Adapter] = found
    if cls.__abstractmethods__:
        missing = ", ".join(sorted(cls.__abstractmethods__))
        raise CannotLoad(f"{module.__name__}:{name} does not implement {missing}")
    for field in ("product", "version", "port_element_name"):
        if not _is_text(getattr(cls, field)):
            raise CannotLoad(
                f'{module.__name__}:{name} has a {field} that is no text; write {field} = "..." in the class'
            )
    return cls


def _is_text(value: object) -> bool:
    """Whether ``value`` is a text that a message can hold, so without halves of characters."""
    return isinstance(value, str) and not any("\ud800" <= character <= "\udfff" for character in value)


def _complete_adapters(module: ModuleType) -> list[str]:
    """Names of the adapters in ``module`` that lack no operation, as the base classes do that it imports."""
    return [name for name, value in vars(module).items() if _is_adapter(value) and not value.__abstractmethods__]


def _is_adapter(value: object) -> bool:
    return inspect.isclass(value) and issubclass(value, Adapter)
