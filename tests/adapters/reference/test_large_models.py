"""Large models: an element costs the same work in all of them, and they are read without being in memory."""

from __future__ import annotations

import io
import os
import random
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Named, walk
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope, each_element
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.adapters.reference.toolchain.checking import Rule, check
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.adapters.reference.toolchain.reaching import Reaching
from ucm_cts.harness.bench.large_model import MIX, block, model_of
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

PROGRAM = reference()

GROWTH = 1.03
"""How much more an element may cost where models are twice as large."""


def _expected(task: str, text: bytes) -> object:
    model = read_model(text, "m.xml").model
    return expected_idl(model) if task == "idl" else expected_cpp(model, "cpp11", {})


WORKS: dict[str, Callable[[bytes], object]] = {
    "check": lambda text: PROGRAM.check(text, "m.xml"),
    **{task: lambda text, task=task: PROGRAM.generate(task, text, "m.xml") for task in ("idl", "cpp11", "cpp03")},
    **{f"expected {task}": lambda text, task=task: _expected(task, text) for task in ("idl", "cpp11")},
}
"""What is done with models, and what the harness expects of what is generated."""


def _of_blocks(number: int) -> Model:
    return model_of(block(one, {**MIX, "STRUCTURES": 8, "INTERFACES": 4, "COMPOSITES": 1}) for one in range(number))


def _of_one_block(number: int) -> Model:
    times = {what: number * count for what, count in {"STRUCTURES": 14, "INTERFACES": 4, "TYPES": 8}.items()}
    return model_of([block(0, {**MIX, **times, "PARTS": 8, "COMPOSITES": number})])


def _of_one_composite(number: int) -> Model:
    parts = {"TYPES": 8 * number, "PARTS": 8 * number}
    return model_of([block(0, {**MIX, **parts, "STRUCTURES": 8, "INTERFACES": 4, "COMPOSITES": 1})])


def _in_a_row(number: int) -> Model:
    """Structures, each with a field of the one before."""
    first = c.PrimitiveInteger(name="type_0", kind="LONG")
    row = (
        c.Structure(name=f"type_{n}", fields=(c.StructureField(name="f", type=f"type_{n - 1}"),) * 1)
        for n in range(1, 60 * number)
    )
    return Model(modules=(c.ContractModule(name="row", data_types=(first, *row)),))


def _calls(work: Callable[[bytes], object], text: bytes) -> int:
    """How many functions ``work`` calls, those of the interpreter included."""
    count = 0

    def called(_frame: object, event: str, _argument: Any) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    work(text)  # what is done only once is done before
    sys.setprofile(called)
    try:
        work(text)
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize("task", WORKS)
@pytest.mark.parametrize("shape", [_of_blocks, _of_one_block, _of_one_composite, _in_a_row])
def test_an_element_costs_the_same_work_in_larger_models(task: str, shape: Callable[[int], Model]) -> None:
    """What twice as many elements more cost is twice what the first cost: no search of everything for each of them."""
    models = [shape(number) for number in (1, 2, 4)]
    sizes = [sum(1 for _ in walk(model)) for model in models]
    work = [_calls(WORKS[task], write_model(model)) for model in models]
    first, second = ((work[n + 1] - work[n]) / (sizes[n + 1] - sizes[n]) for n in (0, 1))
    assert second <= first * GROWTH, work


def test_elements_of_some_classes_are_found_where_all_are() -> None:
    model = model_of([block(0)])
    names = Names(model)
    everything = [*each_element(model, names)]
    for kinds in ((mc.AbstractTypeBinding,), (c.DataType, c.Method), MODULES, (Named,), (c.Annotation,)):
        assert [*each_element(model, names, *kinds)] == [(e, s) for e, s in everything if isinstance(e, kinds)]


WRONG = """<ContractModule name="m">
  <Structure name="s">
    <StructureField name="a" type="missing"/>
    <StructureField name="b" type="missing"/><StructureField name="" type="missing"/>
    <StructureField name="d" type="i"/>
    <StructureField name="" type="i"/>
  </Structure>
  <Interface name="i"><Attribute name="a" type="missing" mode="READ"/></Interface>
  <ContractModule name="inner">
    <PrimitiveInteger name="missing" kind="LONG"/>
    <Structure name="s"><StructureField name="a" type="missing"/></Structure>
  </ContractModule>
</ContractModule>
"""


def test_elements_that_are_alike_are_all_refused_and_only_where_they_are_wrong() -> None:
    _, reported = PROGRAM.check(WRONG.encode(), "m.xml")
    assert [(d.line, d.requirement) for d in reported] == [
        (3, "R-9.2.2.4-03"),
        (4, "R-9.2.2.4-03"),
        (4, "R-9.2.2.4-03"),
        (4, "R-9.2.4.3-03"),
        (5, "R-9.2.2.4-04"),
        (6, "R-9.2.2.4-04"),
        (6, "R-9.2.4.3-03"),
        (8, "R-9.2.2.5-01"),
    ]


def test_what_rules_look_at_decides_what_they_say() -> None:
    """Where a rule says what it looks at, the model is judged as if it did not."""
    told = {name: Rule(r.name, r.requirement, r.kinds, r.complaints) for name, r in PROGRAM.rules.items()}
    for text in (WRONG, write_model(_of_one_block(1)).decode().replace('type="structure_3"', 'type="structure_x"')):
        model = read_model(text.encode(), "m.xml").model
        once, always = check(model, "m.xml", PROGRAM.rules, {}), check(model, "m.xml", told, {})
        assert once
        assert once == always


def _numbered(links: dict[int, list[int]]) -> tuple[dict[int, Declared], Callable[[Declared], list[Declared]]]:
    scope = Scope()
    declared = {number: Declared(c.Structure(name=str(number)), scope) for number in links}
    return declared, lambda one: [declared[number] for number in links[int(one.element.name)]]


@pytest.mark.parametrize("seed", range(20))
def test_what_declarations_lead_to_is_found_in_circles_too(seed: int) -> None:
    draw = random.Random(seed)
    links = {n: [draw.randrange(8) for _ in range(draw.randrange(3))] for n in range(8)}
    declared, next_ones = _numbered(links)
    reaching = Reaching(next_ones, lambda one: one.element.name if int(one.element.name) % 2 else "")
    for start in draw.sample(range(8), 8):
        met: set[int] = set()
        waiting = [*links[start]]
        while waiting:
            here = waiting.pop()
            if here not in met:
                met.add(here)
                waiting += links[here]
        assert reaching.marks(declared[start]) == {str(number) for number in met if number % 2}


def test_long_rows_of_declarations_are_generated_from() -> None:
    """They lead as deep as no program may call itself."""
    depth = 2000
    interfaces = (
        *(c.Interface(name=f"i{n}", methods=(_returning(f"i{n + 1}"),)) for n in range(depth)),
        c.Interface(name=f"i{depth}"),
    )
    structures = (
        c.Structure(name=f"s{n}", fields=(c.StructureField(name="f", type=f"s{n + 1}"),)) for n in range(depth)
    )
    last = c.PrimitiveBoolean(name=f"s{depth}")
    model = Model(modules=(c.ContractModule(name="m", interfaces=interfaces, data_types=(*structures, last)),))
    for task in ("idl", "cpp11", "cpp03"):
        files, reported = PROGRAM.generate(task, write_model(model), "m.xml")
        assert (bool(files), reported) == (True, [])


def _returning(type_: str) -> c.Method:
    return c.Method(name="m", parameters=(c.Parameter(name="p", direction="RETURN", type=type_),))


def test_files_are_read_in_pieces() -> None:
    """The longest piece that was read is much shorter than the file."""
    text = write_model(model_of(block(number) for number in range(12)))
    taken: list[int] = []

    class Told(io.BytesIO):
        def read(self, size: int | None = -1, /) -> bytes:
            taken.append(len(piece := super().read(size)))
            return piece

    assert read_model(Told(text), "m.xml") == read_model(text, "m.xml")
    assert 0 < max(taken) <= 1 << 20 < len(text)


def test_text_that_belongs_nowhere_is_found_in_files_too() -> None:
    text = b'<ContractModule name="m">\nwords</ContractModule>'
    assert read_model(io.BytesIO(text), "m.xml") == read_model(text, "m.xml")
    assert [problem.kind for problem in read_model(io.BytesIO(text), "m.xml").problems] == ["text"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_models_are_checked_from_pipes(tmp_path: Path) -> None:
    """In what cannot be read twice there is no going back, so it is read at once."""
    pipe = tmp_path / "pipe.xml"
    os.mkfifo(pipe)
    writer = threading.Thread(target=lambda: pipe.write_text(WRONG))
    writer.start()
    command = [sys.executable, "-m", "ucm_cts.adapters.reference.toolchain", "check", "pipe.xml"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    writer.join()
    assert (done.returncode, done.stderr, len(done.stdout.splitlines())) == (1, "", 8)
    assert done.stdout.startswith("pipe.xml:3: error: ")
