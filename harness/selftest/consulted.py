"""Which options of the interpretations decide something about what is generated from a model."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.generation import OPEN, mapping_models
from ucm_cts.harness.toolchains.idl.comparing import compare
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl


class ConsultedReadings(dict[str, str]):
    """The default readings, but for those ``declared``; ``consulted`` are the options that somebody asked for."""

    def __init__(self, consulted: set[str], declared: Mapping[str, str] = {}) -> None:
        super().__init__(default_statement().readings | dict(declared))
        self.consulted = consulted

    def __getitem__(self, option: str) -> str:
        self.consulted.add(option)
        return super().__getitem__(option)

    def get(self, option: str, default: str = "") -> str:  # type: ignore[override]
        self.consulted.add(option)
        return super().get(option, default)


@functools.cache
def consulted_for(task: str) -> Mapping[str, frozenset[str]]:
    """By the name of each model that code is generated from for ``task``: the options on which the comparison of its files depends."""
    return {name: _consulted(task, text, name) for name, text in mapping_models().items() if not name.startswith(OPEN)}


def _consulted(task: str, text: str, name: str) -> frozenset[str]:
    consulted: set[str] = set()
    model = read_model(text.encode(), name).model
    readings = ConsultedReadings(consulted)
    if task == "idl":
        compare(expected_idl(model), reference().generators[task](model), readings)
    else:
        expected_cpp(model, "cpp03" if task == "cpp03" else "cpp11", readings)
    return frozenset(consulted)
