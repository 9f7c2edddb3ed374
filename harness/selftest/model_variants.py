"""Conformant models: each has what one reading of an open place of clause 10 makes of the printed ones."""

from __future__ import annotations

import functools
import re
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from ucm_cts.harness.catalogue.requirements import CLAIMABLE
from ucm_cts.harness.models.core_models import CORE, EXTENSIONS, compare
from ucm_cts.harness.selftest.matrix import Kill, VariantResult

Edits = tuple[tuple[str, str], ...]
"""Patterns, and what stands for each match."""


@dataclass(frozen=True)
class ModelVariant:
    """Models that differ from the suite's own in what an option leaves open.

    ``name``: its name.
    ``option``, ``value``: the reading that its vendor declares.
    ``edits``: of our own models.
    ``files``: the models that are edited, as a pattern without ``.xml``.
    ``root``: where they stand, or those of the extensions if there are any: none, core or both, as in option core-root.
    ``concerned``: the requirements that fail if the vendor declares nothing, or the first value, and that is not ``observed``;
    otherwise those that fail if the vendor declares another value.
    ``parts``: what is claimed of 10.2 to 10.5; without any there are only models of 10.1.
    """

    name: str
    option: str
    value: str
    edits: Edits = ()
    files: str = "*"
    root: str = "none"
    concerned: frozenset[str] = frozenset()
    parts: tuple[str, ...] = ()

    def write(self, folder: Path) -> Sequence[Path]:
        """Write the models into ``folder``, which is empty; returns the folders that hold them."""
        moved = EXTENSIONS if self.parts else CORE
        for models in (CORE, *((EXTENSIONS,) if self.parts else ())):
            for name in _FOLDERS[self.root if models is moved else "none"]:
                (folder / name).mkdir(exist_ok=True)
                for path in models.glob("*.xml"):
                    (folder / name / path.name).write_text(self._edited(path, below_core=name == "core"))
        return sorted(folder.iterdir())

    def _edited(self, path: Path, below_core: bool) -> str:
        text = path.read_text()
        for pattern, replacement in self.edits if path.match(f"{self.files}.xml") else ():
            text = re.sub(pattern, replacement, text, flags=re.DOTALL)
        if not below_core:
            return text
        inner = re.sub(r"<\?xml.*?\?>", "", text)
        return f'<InteractionModule name="core">{inner}</InteractionModule>'


_FOLDERS = {"none": ("root",), "core": ("core",), "both": ("root", "core")}


def _requirements(clause: str, *numbers: int) -> frozenset[str]:
    return frozenset(f"R-{clause}-{number:02}" for number in numbers)


_FIVE: Edits = (
    ('<Enumerator name="trace".*?>', ""),
    ("critical", "fatal"),
    *((f'value="{n}"', f'value="{n - 1}"') for n in range(1, 6)),
)
_NARROW = '<StringType charBase="CHAR8" maxSize="255" name="log_message_t"/>'
_ROOTS = frozenset({"R-10.1.2-03", "R-10.1.3.1-02", "R-10.1.4.2-07", "R-10.1.5.2-01", "R-10.1.6.2-01"})
_EXTENSION_ROOTS = frozenset({"R-10.2-03", "R-10.3-07", "R-10.4.1.1-01", "R-10.4.2.1-01", "R-10.5.1-01"})

_OTHERWISE = (
    ModelVariant(
        "microseconds_of_idl",
        "clock-usec-field",
        "ucm_usec",
        (('name="utv_usec"', 'name="ucm_usec"'),),
        concerned=_requirements("10.1.4.2", 16),
    ),
    ModelVariant(
        "client_item_as_printed",
        "service-client-item",
        "verbatim",
        (('(client".*?item=")service_intf', r"\1service_intf_t"),),
        "services*",
        concerned=_requirements("10.1.5.2", 6),
    ),
    ModelVariant(
        "service_ports_without_type",
        "service-port-api",
        "absent",
        (('api="service_[a-z]*_tport"', ""),),
        concerned=_requirements("10.1.5.2", 15, 16),
    ),
    ModelVariant(
        "codes_indexed_by_kind",
        "comm-ecode-index",
        "kind",
        (('indexType="comm_ecode_enumerator_t"', 'indexType="BYTE"'),),
        concerned=_requirements("10.1.2", 4),
    ),
    ModelVariant(
        "five_severities",
        "log-severity-set",
        "idl-5",
        _FIVE,
        "container*",
        concerned=_requirements("10.1.4.2", *range(39, 45)),
    ),
    ModelVariant(
        "severities_indexed_by_kind",
        "log-severity-index",
        "BYTE",
        (('indexType="ULONG"', 'indexType="BYTE"'),),
        concerned=_requirements("10.1.4.2", 38),
    ),
    ModelVariant(
        "severities_indexed_by_the_unused_type",
        "log-severity-index",
        "BYTE",
        (('indexType="ULONG"', 'indexType="log_severity_enumerator_t"'),),
        concerned=_requirements("10.1.4.2", 38),
    ),
    ModelVariant(
        "narrow_messages",
        "log-message",
        "narrow-255",
        (("<String32[^>]*>", _NARROW),),
        concerned=_requirements("10.1.4.2", 46),
    ),
    ModelVariant(
        "active_components",
        "protected-active-applicability",
        "onComponent",
        (("onPort", "onComponent"),),
        "component*",
        concerned=_requirements("10.1.3.1", 7),
    ),
    ModelVariant(
        "active_ports_or_components",
        "protected-active-applicability",
        "onBoth",
        (("onPort", "onBoth"),),
        "component*",
        concerned=_requirements("10.1.3.1", 7),
    ),
    ModelVariant(
        "traces_of_ports_or_components",
        "port-trace-applicability",
        "onBoth",
        (("onPort", "onBoth"),),
        "container*",
        concerned=_requirements("10.1.4.2", 30),
    ),
    ModelVariant(
        "traces_of_components", "port-trace-applicability", "onComponent", (("onPort", "onComponent"),), "container*"
    ),
    ModelVariant(
        "traces_without_parameters",
        "port-trace-parameters",
        "none",
        (("<ConfigurationParameter[^>]*>", ""),),
        concerned=_requirements("10.1.4.2", 31, 34),
    ),
    ModelVariant("below_a_module_core", "core-root", "core", root="core", concerned=_ROOTS),
    ModelVariant("in_both_places", "core-root", "both", root="both"),
    ModelVariant(
        "extensions_below_a_module_core",
        "extension-root",
        "core",
        root="core",
        concerned=_EXTENSION_ROOTS,
        parts=CLAIMABLE,
    ),
    ModelVariant("extensions_in_both_places", "extension-root", "both", root="both", parts=CLAIMABLE),
    ModelVariant(
        "active_components_with_periods",
        "protected-active-applicability",
        "onComponent",
        (("onPort", "onComponent"),),
        "*execution_policies",
        concerned=_requirements("10.1.3.1", 7) | _requirements("10.5.1", 9, 12),
        parts=CLAIMABLE,
    ),
    ModelVariant(
        "active_ports_or_components_with_periods",
        "protected-active-applicability",
        "onBoth",
        (("onPort", "onBoth"),),
        "*execution_policies",
        concerned=_requirements("10.1.3.1", 7) | _requirements("10.5.1", 9, 12),
        parts=CLAIMABLE,
    ),
    ModelVariant(
        "one_shot_without_slip",
        "one-shot-name",
        "schedule_trigger",
        (("scheduler_trigger", "schedule_trigger"),),
        concerned=_requirements("10.3.1", 14),
        parts=("object-timers",),
    ),
    ModelVariant(
        "repeated_timer_is_returned",
        "repeated-result",
        "timer",
        (
            (
                '(name="max_rounds"[^>]*>)',
                r'\1<Parameter name="timer" direction="RETURN" type="::timer::ott_timer::ucm_ott::ott_timer"/>',
            ),
        ),
        concerned=_requirements("10.3.1", 15),
        parts=("object-timers",),
    ),
)

_AS_PRINTED = {
    "clock-usec-field": "utv_usec",
    "comm-ecode-index": "declared-type",
    "core-models": "shipped",
    "core-root": "none",
    "log-severity-index": "ULONG",
    "log-severity-set": "model-6",
    "service-client-item": "service_intf",
    "service-port-api": "explicit",
}
_EXTENSIONS_AS_PRINTED = {"extension-root": "root", "one-shot-name": "scheduler_trigger", "repeated-result": "printed"}
"""What a vendor may declare of models that are as the suite's own."""


@functools.cache
def model_variants() -> Mapping[str, ModelVariant]:
    """All of them, by name."""
    printed = (
        ModelVariant(f"printed {option}", option, value, parts=parts)
        for values, parts in ((_AS_PRINTED, ()), (_EXTENSIONS_AS_PRINTED, CLAIMABLE))
        for option, value in values.items()
    )
    return {variant.name: variant for variant in (*_OTHERWISE, *printed)}


def examine_model_variant(name: str) -> VariantResult:
    """The requirements that the models of this variant fail, although none may, or that they leave open."""
    began = time.monotonic()
    variant = model_variants()[name]
    with TemporaryDirectory() as folder:
        compared = compare(variant.write(Path(folder)), {variant.option: variant.value}, variant.parts)
    wrong = [result for result in compared.results if result.status in ("broken", "unclear")]
    met = compared.readings.get(variant.option)
    failed = tuple(Kill(r.requirement, f"models: {name}", r.check, r.expected, r.observed, (), True, 1) for r in wrong)
    trouble = "" if met is None or variant.value in met else f"the models show {', '.join(sorted(met))}"
    return VariantResult(f"models: {name}", failed, (), 1, round(time.monotonic() - began, 3), trouble)
