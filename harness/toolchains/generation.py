"""The examination of the profiles that generate: compares files generated from legal models with the mapping."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

import msgspec
from lxml import etree

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.catalogue.documents import read_text
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, FactEvidence
from ucm_cts.harness.toolchains.campaign import Fact
from ucm_cts.harness.toolchains.commands.processing import Response
from ucm_cts.harness.toolchains.corpus.decoration import PREFIX, decorated
from ucm_cts.harness.toolchains.corpus.documentation import DOCUMENTATION, DOCUMENTED, WITHOUT, documented_models
from ucm_cts.harness.toolchains.corpus.uncontested import PREFIX as UNCONTESTED
from ucm_cts.harness.toolchains.corpus.uncontested import uncontested, understood
from ucm_cts.harness.toolchains.cpp.probes.check import HEADERS
from ucm_cts.harness.toolchains.differences import Comparison, Difference
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.harness.toolchains.same_code import Piece, first_change, pieces
from ucm_cts.harness.toolchains.unspecified_spellings import refused_for_spelling
from ucm_cts.reference_models.findings import Finding

FOLDERS = (SUITE / "models" / "mapping", SUITE / "models" / "legal")

OPEN = "open_"
"""How the names of models begin that may be refused, because their names have no equals in the target language: what is generated of
them, if anything is, must be valid, whatever it is called."""

VALID = frozenset(("R-12.1-03", *HEADERS.values()))
"""The requirements that what is generated is IDL, or compiles."""

DECORATED = ("interfaces", "ports")
"""The models that are asked with annotations and comments, too."""

AROUND = 3
"""Lines of a generated file shown before and after the one that is wrong."""

LONGEST_PIECE = 200
"""Characters shown of a piece of code."""


Compare = Callable[[Model, Mapping[str, str]], Comparison]
"""Holds the files, by name, that were made of a model against what must be in them."""

IsCode = Callable[[str], bool]
"""Whether the file of this name is code, rather than a document or a description of what to build."""


def _renaming_for(model: str, renaming: Renaming) -> Renaming:
    """``renaming`` for ``model``: names that are words of a target language would be none with other endings."""
    return dataclasses.replace(renaming, seed=None) if model.startswith(OPEN) else renaming


class Generation:
    """Asks for the files of each model and compares them as soon as they are there."""

    def __init__(
        self,
        compare: Compare,
        generates: tuple[str, str],
        decoration: tuple[str, str],
        renaming: Renaming,
        expression: str = "",
        only: Collection[str] | None = None,
        not_applicable: Mapping[str, str] = {},
        may_be_refused: Mapping[str, str] = {},
        is_code: IsCode = lambda name: True,
        meets: Callable[[str], bool] = lambda reading: True,
    ) -> None:
        """``generates`` are the requirement, and its rule, that files can be had of a legal model at all; ``decoration`` are those
        that annotations and comments change nothing. Of the models
        only those of ``only``, if there is such a list, whose name holds a word of ``expression``, or all if none does: then
        only what is said of requirements that hold one of the words. ``not_applicable`` are requirements that do not apply, and why, and
        ``may_be_refused`` models that a vendor may refuse, by name, and the interpretation that says so. ``is_code`` is asked of
        files that are made of documented models. ``meets`` says which readings of the text are declared: a model that needs another one may
        be refused, and is asked without what is contested.
        """
        self.not_applicable = not_applicable
        self._may_be_refused = dict(may_be_refused)
        self._accepted: dict[str, bool | None] = {}
        self._is_code = is_code
        self._compare = compare
        self._generates = generates
        self._decoration = decoration
        wanted = None if only is None else {*only, *(name.removeprefix(PREFIX) for name in only)}
        known = {**mapping_models(), **documentation_models()}
        chosen = {name: text for name, text in known.items() if wanted is None or name in wanted}
        chosen |= {name: understood(text, meets) for name, text in chosen.items() if name not in documentation_models()}
        chosen |= dict(self._without_the_contested(chosen, meets))
        models = {name: _renaming_for(name, renaming).apply(text) for name, text in chosen.items()}
        words = [word.strip().lower() for word in expression.split(" or ") if word.strip()]
        named = {name: text for name, text in models.items() if any(word in name.lower() for word in words)}
        self._texts = named or models
        self._words = [] if named else words

    @property
    def models(self) -> Sequence[tuple[str, str]]:
        """Name and text of each model."""
        return tuple(self._texts.items())

    def examine(self, name: str, response: Response) -> tuple[Fact, ...]:
        """The facts that the files of one model show; those of documented models are compared with each other only."""
        self._accepted[name] = response.accepted
        if name in documentation_models() or self._is_needless(name):
            return ()
        return tuple(fact for fact in self._facts(name, response) if self._is_wanted(fact.requirement))

    def judge(self, responses: Mapping[str, Response], shown: Mapping[str, tuple[Fact, ...]]) -> Iterator[Fact]:
        """All facts."""
        misspelt = refused_for_spelling(self._texts, {name: one.accepted for name, one in responses.items()})
        for name in responses:
            if name in documentation_models():
                yield from self._of_documentation(name, responses, misspelt.get(name, ""))
            elif self._is_needless(name):
                continue
            elif name in misspelt:
                said = responses[name].first_line or "nothing"
                yield Fact(self._generates[0], (name,), undecided=f"{misspelt[name]}; the tool chain said: {said}")
            elif name.startswith(PREFIX):
                yield from self._of_decoration(name, responses[name], shown)
            else:
                yield from shown[name]

    def _without_the_contested(
        self, models: Mapping[str, str], meets: Callable[[str], bool]
    ) -> Iterator[tuple[str, str]]:
        """The models that are asked if others are refused, which their vendor may do then."""
        for name in (one for one in models if one not in documentation_models()):
            rest, allowed_by = uncontested(models[name], meets)
            if allowed_by:
                self._may_be_refused.setdefault(name.removeprefix(PREFIX), ", ".join(allowed_by))
                if not name.startswith(PREFIX):
                    yield f"{UNCONTESTED}{name}", rest

    def _is_needless(self, name: str) -> bool:
        """Is it a model without what is contested, and the whole one was accepted?"""
        return name.startswith(UNCONTESTED) and self._accepted.get(name.removeprefix(UNCONTESTED)) is True

    def _of_decoration(self, name: str, response: Response, shown: Mapping[str, tuple[Fact, ...]]) -> Iterator[Fact]:
        """Whether the files show nothing wrong that those of the model without decoration do not show."""
        plain = name.removeprefix(PREFIX)
        requirement, rule = self._decoration
        if not self._is_wanted(requirement):
            return
        known = {fact.requirement for fact in shown.get(plain, ()) if fact.finding is not None}
        new = [f.finding for f in shown[name] if f.finding is not None and f.requirement not in known]
        if not new and any(fact.undecided for fact in shown[name]):
            return
        if not new:
            yield Fact(requirement, (plain, name), measure="decorated models generated from")
            return
        expected = f"the same of {plain} with annotations and comments as without: {new[0].expected}"
        finding = Finding(requirement, rule, "decoration", expected, new[0].observed)
        evidence = FactEvidence(response.processed, self._texts.get(plain, ""))
        yield Fact(requirement, (plain, name), finding, evidence=evidence)

    def _of_documentation(self, name: str, responses: Mapping[str, Response], misspelt: str) -> Iterator[Fact]:
        """Whether the files of the model ``name`` hold the code that is made of it without documentation; ``misspelt`` is why a refusal
        decides nothing.
        """
        requirement, rule = DOCUMENTATION
        if name == WITHOUT or WITHOUT not in responses or not self._is_wanted(requirement):
            return
        response = responses[name]
        before, after = (self._code_of(responses[one]) for one in (WITHOUT, name))
        undecided = misspelt or _lost(response) or ("" if before else f"no code is made of {WITHOUT}")
        if undecided:
            yield Fact(requirement, (WITHOUT, name), undecided=undecided)
            return
        change = first_change(before, after)
        if change is None:
            yield Fact(requirement, (WITHOUT, name), measure="documented models generated from")
            return
        expected = f"the code that is made of {WITHOUT}, which is the same model without documentation"
        observed = f"{'added' if change.is_new else 'missing'}: {change.piece.text[:LONGEST_PIECE]}"
        place = (change.piece.file, change.piece.line) if change.is_new else ("", 0)
        if not after:
            observed, place = _unmade(response), ("", 0)
        evidence = _evidence(response, Difference(requirement, rule, "", 0, expected, observed, *place))
        evidence = msgspec.structs.replace(evidence, twin=self._texts[WITHOUT])
        finding = Finding(requirement, rule, "documentation", expected, observed)
        yield Fact(requirement, (WITHOUT, name), finding, evidence=evidence)

    def _code_of(self, response: Response) -> tuple[Piece, ...]:
        return pieces({name: text for name, text in response.files.items() if self._is_code(name)})

    def _is_wanted(self, requirement: str) -> bool:
        return not self._words or any(word in requirement.lower() for word in self._words)

    def _facts(self, name: str, response: Response) -> Iterator[Fact]:
        requirement, rule = self._generates
        lost = _lost(response)
        if lost:
            yield Fact(requirement, (name,), undecided=lost)
            return
        allowed_by = "safe-names" if name.startswith(OPEN) else self._may_be_refused.get(name.removeprefix(PREFIX), "")
        if response.accepted is False and allowed_by:
            why = f"it was refused, which is allowed (interpretation {allowed_by})"
            yield Fact(requirement, (name,), undecided=why, leaves_others=True, measure="models that may be refused")
            return
        if not response.accepted or not response.files:
            finding = Finding(requirement, rule, name, "files are made of this legal model", _unmade(response))
            yield Fact(requirement, (name,), finding, evidence=FactEvidence(response.processed))
            return
        yield Fact(requirement, (name,), measure="models generated from")
        yield from self._compared(name, response)

    def _compared(self, name: str, response: Response) -> Iterator[Fact]:
        model = read_model(self._texts[name].encode(), name).model
        comparison = self._compare(model, response.files)
        if name.startswith(OPEN):
            comparison = _validity_of(comparison)
        broken: dict[str, list[Difference]] = {}
        for difference in comparison.differences:
            broken.setdefault(difference.requirement, []).append(difference)
        for requirement, times in comparison.exercised.items():
            for _ in range(times - len(broken.get(requirement, ()))):
                yield Fact(requirement, (name,), measure="declarations as they should be")
        yield from (Fact("", (name,), measure=remark) for remark in comparison.remarks)
        for requirement, why in comparison.unjudged.items():
            yield Fact(requirement, (name,), undecided=why)
        for requirement, differences in broken.items():
            for difference in differences:
                yield Fact(requirement, (name,), self._finding(difference), evidence=_evidence(response, difference))

    def _finding(self, difference: Difference) -> Finding:
        of = f" for {difference.element}" if difference.element else ""
        line = f" (line {difference.line_in_model} of the model)" if difference.line_in_model else ""
        expected = f"{difference.expected}{of}{line}"
        cause = difference.element.rpartition("::")[2] or difference.expected
        return Finding(difference.requirement, difference.rule, cause, expected, difference.observed)


def _lost(response: Response) -> str:
    """Why ``response`` decides nothing, which is not the tool chain's doing; empty if it is an answer."""
    incident = response.processed.incident
    if incident is None or incident.kind in FRAMEWORK_INCIDENTS - {"exit"}:
        return ""
    return f"no answer: {incident.kind}: {incident.detail}"


def _unmade(response: Response) -> str:
    """Why no files were made of a model."""
    incident = response.processed.incident
    if response.accepted:
        return "no file was written"
    return f"{incident.kind}: {incident.detail}" if incident else f"refused: {response.first_line or 'no diagnostic'}"


def _validity_of(comparison: Comparison) -> Comparison:
    """What ``comparison`` says of the files as such."""
    differences = tuple(one for one in comparison.differences if one.requirement in VALID)
    exercised = {requirement: times for requirement, times in comparison.exercised.items() if requirement in VALID}
    return Comparison(exercised, differences, remarks=comparison.remarks)


def mapping_models() -> dict[str, str]:
    """The models that code is generated from, by name, small ones first."""
    paths = [path for folder in FOLDERS for path in sorted(folder.glob("*.xml"))]
    texts = {path.stem: read_text(path) for path in paths}
    plain = {name: etree.tostring(etree.fromstring(text.encode()), encoding="unicode") for name, text in texts.items()}
    plain |= {f"{PREFIX}{name}": decorated(plain[name]) for name in DECORATED}
    return dict(sorted(plain.items(), key=lambda item: len(item[1])))


@functools.cache
def documentation_models() -> Mapping[str, str]:
    """The models of which the same code must come, for those who claim the standard properties (10.2), by name."""
    return documented_models(mapping_models()[DOCUMENTED])


def _evidence(response: Response, difference: Difference) -> FactEvidence:
    """The response with the wrong place in the vendor's file."""
    if not difference.file:
        return FactEvidence(response.processed)
    lines = response.files.get(difference.file, "").splitlines()
    first = max(0, difference.line - 1 - AROUND)
    shown = enumerate(lines[first : difference.line + AROUND], first + 1)
    excerpt = "\n".join(f"{'>' if number == difference.line else ' '} {number:>4}  {line}" for number, line in shown)
    place = f"{difference.file}:{difference.line}" if difference.line else difference.file
    return FactEvidence(response.processed, place=place, excerpt=excerpt)
