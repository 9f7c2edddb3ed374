"""Adapters that attack: each gets its one clear line, other scenarios their answers, and nothing is left running."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from aftermath import nothing_left  # noqa: F401 - a fixture
from files import SUPPORT

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Refused, Run, Traced
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.hosts import Answer, Hosts, HostUnavailable, Limits
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.results.values import Incident

pytestmark = pytest.mark.usefixtures("nothing_left")

LIMITS = Limits(seconds=2, memory=250, line=1 << 20, welcome_seconds=10)
PATIENT = Limits(seconds=20, memory=250, line=1 << 20, welcome_seconds=10)
COMPONENTS = {"calm": Declaration(), "trigger": Declaration()}
CALM = Scenario(COMPONENTS, (s.AddComponent("calm"), s.Start()))
TRIGGER = Scenario(COMPONENTS, (s.AddComponent("trigger"), s.GetComponents(), s.ReadLog()), patience=20)
CONTROL = "the control channel of its host; an adapter leaves descriptors alone that it has not opened"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(SUPPORT / "hostile")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.syspath_prepend(tmp_path)
    return tmp_path


def answers(adapter: str, limits: Limits, scenarios: Sequence[Scenario]) -> tuple[list[Answer], Hosts]:
    with Hosts(locate(adapter), limits) as hosts:
        found = list(hosts.run(Run(number, scenario) for number, scenario in enumerate(scenarios)))
    assert [answer.id for answer in found] == list(range(len(scenarios))), "no answer is lost"
    return found, hosts


def line_of(answer: Answer) -> str:
    """What became of a scenario, on one line."""
    match answer.reply:
        case Incident(kind=kind, detail=detail):
            line = f"{kind}: {detail}"
        case Refused(reason=reason):
            line = f"refused: {reason}"
        case Traced(events=events):
            details = [event.detail for event in events if isinstance(event, Raise)]
            line = "traced" + "".join(f", raised {detail}" for detail in details)
    assert "\n" not in line
    assert len(line) < 400
    return line


TOO_MANY = "more than 10000 {}, which no scenario can have led to"
ATTACKS: dict[str, tuple[str, str]] = {
    "HasAGreedyChild": (r"memory: \d+ MiB in 2 processes, 250 MiB allowed", "a fork of the host"),
    "HasModestChildren": (r"memory: \d+ MiB in [56] processes, 250 MiB allowed", "a fork of the host"),
    "HasAGreedyDaemon": (r"memory: \d+ MiB in [23] processes, 250 MiB allowed", "a fork of the host"),
    "SharesMemory": ("traced", "a fork of the host"),
    "LeavesAChild": ("traced", "/bin/sleep 600"),
    "LeavesADaemon": ("traced", "/bin/sleep 600"),
    "LeavesAStranger": ("traced", "/bin/sleep 600"),
    "LeavesAForkAndCrashes": ("crash: SIGABRT", "a fork of the host"),
    "StopsItself": ("hang: no answer within 2.02 s", ""),
    "StopsItsParent": ("exit: closed its output", ""),
    "KillsItsParent": ("crash: SIGKILL", ""),
    "ClosesEverything": ("exit: (closed its output|exit status 70)", ""),
    "RaisesAnInterrupt": ("exit: exit status 70", ""),
    "RaisesAnUnprintable": ("traced, raised Odd", ""),
    "RaisesANovel": ("traced, raised RuntimeError: x.{50,300}", ""),
    "RecursesForEver": ("traced, raised RecursionError: .{10,200}", ""),
    "ListsVeryMany": (f"refused: ContractBroken: get_components returned {TOO_MANY.format('ids')}", ""),
    "ListsForEver": (f"refused: ContractBroken: get_components returned {TOO_MANY.format('ids')}", ""),
    "ListsNothing": ("refused: ContractBroken: get_components returned 7; it returns a sequence of integers", ""),
    "ListsAnUnprintable": ("refused: ContractBroken: get_components returned <Odd .*>; it returns an integer", ""),
    "ListsANovel": (r"refused: ContractBroken: get_components returned 'x+\.\.\.x+'; it returns an integer", ""),
    "ReadsForEver": (f"refused: ContractBroken: read_log returned {TOO_MANY.format('records')}", ""),
}
"""What each does is said in tests/support/hostile/attacking.py; its line, and the process that it leaves behind."""


@pytest.mark.parametrize(("attack", "line", "left"), [(a, *row) for a, row in ATTACKS.items()], ids=ATTACKS)
def test_attack_gets_one_line_and_costs_no_other_answer(attack: str, line: str, left: str) -> None:
    limits = LIMITS if attack.startswith("Stops") else PATIENT
    (before, attacked, after), hosts = answers(f"attacking:{attack}", limits, [CALM, TRIGGER, CALM])
    assert re.fullmatch(line, line_of(attacked)), line_of(attacked)
    assert [line_of(other) for other in (before, after)] == ["traced", "traced"]
    assert set(hosts.left_behind) == ({left} if left else set())


IMPORTS: dict[str, tuple[str, str]] = {
    "writes to the control channel": (
        "os.write(control(), b'junk\\n')",
        f"'evil:Evil' writes to {CONTROL}",
    ),
    "plays the control channel": (
        "os.write(control(), b'ready\\nforked 1\\n')",
        f"'evil:Evil' gives no hosts: the adapter writes to {CONTROL}",
    ),
    "plays the end of a host": (
        "os.write(control(), b'ready\\nended 1 0 nothing\\n')",
        f"'evil:Evil' gives no hosts: the adapter writes to {CONTROL}",
    ),
    "floods the control channel": (
        "os.write(control(), b'x' * 100_000)",
        f"'evil:Evil' writes to {CONTROL}",
    ),
    "gives a reason that is none": ("os.write(control(), b'failed {\\n')", f"'evil:Evil' writes to {CONTROL}"),
    "closes all descriptors": ("os.closerange(3, control() + 1)", f"'evil:Evil' has closed {CONTROL}"),
    "leaves": ("os._exit(7)", "'evil:Evil' ended while it was loaded: exit status 7"),
    "is killed": ("os.kill(os.getpid(), 9)", "'evil:Evil' ended while it was loaded: SIGKILL"),
    "is interrupted": ("raise KeyboardInterrupt", "'evil:Evil' ended while it was loaded: exit status 0"),
    "stands still": (
        "os.kill(os.getpid(), signal.SIGSTOP)",
        r"'evil:Evil' was not loaded: it is stopped \(SIGSTOP\), for 2 s",
    ),
    "has no licence": (
        "sys.exit('no licence')",
        "'evil:Evil': importing evil failed: SystemExit: no licence",
    ),
    "has no product": (
        "Evil.product = None",
        r"'evil:Evil': evil:Evil has a product that is no text; write product = \"\.\.\.\" in the class",
    ),
    "has half a character in its product": (
        "Evil.product = '\\udc80'",
        r"'evil:Evil': evil:Evil has a product that is no text; write product = \"\.\.\.\" in the class",
    ),
    "has a number for a version": (
        "Evil.version = 1",
        r"'evil:Evil': evil:Evil has a version that is no text; write version = \"\.\.\.\" in the class",
    ),
}
EVIL = """
import os, signal, subprocess, sys
from attacking import Attack

def control():
    line = open("/proc/self/cmdline").read().split("\\0")
    return int(line[line.index("--control") + 1])

class Evil(Attack):
    pass

subprocess.Popen(["/bin/sleep", "600"], start_new_session=True)
"""
"""A module that starts a process of its own session when it is loaded."""


@pytest.mark.parametrize(("attack", "line"), IMPORTS.values(), ids=IMPORTS)
def test_module_that_attacks_while_it_is_loaded_gets_one_line(here: Path, attack: str, line: str) -> None:
    (here / "evil.py").write_text(f"{EVIL}{attack}\n")
    with Hosts(locate("evil:Evil"), LIMITS) as hosts, pytest.raises((HostUnavailable, WrongUse)) as caught:
        hosts.welcome  # noqa: B018
    text = str(caught.value)
    assert re.fullmatch(line, text), text


def test_process_that_an_adapter_starts_when_it_is_loaded_serves_all_hosts_and_ends_with_them(here: Path) -> None:
    stranger = EVIL.replace("start_new_session=True", "start_new_session=True, env={}")
    (here / "evil.py").write_text(stranger.replace("pass", "attack = lambda self: os.abort()"))
    with Hosts(locate("evil:Evil"), PATIENT) as hosts:
        crashed, traced = hosts.run([Run(1, TRIGGER), Run(2, CALM)])
        assert (line_of(crashed), line_of(traced)) == ("crash: SIGABRT", "traced")
        assert hosts.left_behind == {}


SPEAKERS: dict[str, tuple[str, str]] = {
    "says empty lines": ("b'\\n' * 3", "garbage: not a JSON message: ''"),
    "nests without end": ("b'[' * 100_000 + b'\\n'", "protocol: Expected `object`, got `array`"),
    "has a number without end": ("b'9' * 100_000 + b'\\n'", "(garbage|protocol): .*"),
    "holds a NUL": ('b\'{"type":"trace\\0"}\\n\'', r"garbage: not a JSON message: '.*x00.*'"),
    "says hello back": (
        'b\'{"type":"welcome","protocol":2,"product":"p","version":""}\\n\'',
        "protocol: welcome where trace is due",
    ),
    "has a huge line": ("b' ' * (3 << 20)", "flood: a line of more than 1 MiB"),
    "has an odd id": ('b\'{"type":"trace","id":1e308,"events":[]}\\n\'', "protocol: .*`\\$.id`"),
}
SPEAKER = """#!{python} -S
import os, sys
for line in sys.stdin:
    if '"hello"' in line:
        text = b'{{"type":"welcome","protocol":2,"product":"speaker","version":"1"}}\\n'
    elif '"trigger"' in line.partition('"steps"')[2]:
        text = {said}
    else:
        text = b'{{"type":"trace","id":%s,"events":[]}}\\n' % line.partition('"id":')[2].partition(",")[0].encode()
    while text:
        text = text[os.write(1, text):]
"""


def program(here: Path, text: str) -> str:
    path = here / "speaker"
    path.write_text(text)
    path.chmod(0o755)
    return str(path)


@pytest.mark.parametrize(("said", "line"), SPEAKERS.values(), ids=SPEAKERS)
def test_program_that_says_nonsense_gets_one_line(here: Path, said: str, line: str) -> None:
    adapter = program(here, SPEAKER.format(python=sys.executable, said=said))
    (before, attacked, after), _ = answers(adapter, PATIENT, [CALM, TRIGGER, CALM])
    assert re.fullmatch(line, line_of(attacked)), line_of(attacked)
    assert [line_of(other) for other in (before, after)] == ["traced", "traced"]


@pytest.mark.parametrize(
    ("text", "line"),
    [("not a program", "Exec format error"), ("#!/no/such/interpreter\n", "No such file or directory")],
)
def test_program_that_cannot_be_run_gets_one_line(here: Path, text: str, line: str) -> None:
    adapter = program(here, text)
    with Hosts(locate(adapter), LIMITS) as hosts, pytest.raises(HostUnavailable) as caught:
        hosts.welcome  # noqa: B018
    first, second = str(caught.value).splitlines()
    assert first.startswith(f"'{adapter}' does not answer hello: exit, exit status 127")
    assert second == f"{adapter} cannot be run: {line}"


@pytest.mark.parametrize(
    ("product", "line"),
    [
        (
            'b\'{{"type":"welcome","protocol":2,"product":"p","version":"%d"}}\\n\' % os.getpid()',
            r"the host is of 'p \d+', and the first host of this run was of 'p \d+'; a product must not change during a run",
        ),
        (
            'b\'{{"type":"welcome","protocol":2,"product":"p","version":"1","port_element_name":"{{port}}.%d.{{element}}"}}\\n\' % os.getpid()',
            "the host says other things of 'p 1' than the first host of this run; it must not change during a run",
        ),
    ],
    ids=["version", "spelling"],
)
def test_product_that_changes_during_a_run_gets_one_line(here: Path, product: str, line: str) -> None:
    usual = """b'{{"type":"welcome","protocol":2,"product":"speaker","version":"1"}}\\n'"""
    adapter = program(here, SPEAKER.replace(usual, product).format(python=sys.executable, said="sys.exit(3)"))
    (before, attacked, *after), _ = answers(adapter, PATIENT, [CALM, TRIGGER, CALM, CALM])
    assert (line_of(before), line_of(attacked)) == ("traced", "exit: exit status 3")
    for other in after:
        assert re.fullmatch(f"unreachable: {line}", line_of(other)), line_of(other)


@pytest.mark.parametrize(
    "spelling",
    [
        "{port!r:>9999999}{element}",
        "{port:>9999999}_{element}",
        "{port!s}_{element}",
        "{port.__class__}{element}",
        "{port[0]}{element}",
        "{0}{1}",
        "{port}{port}{element}",
        "{port}{element}" + "x" * 1000,
        "{port}\0{element}",
        "{port}{element",
    ],
)
def test_name_of_port_elements_is_made_of_two_plain_parts(spelling: str) -> None:
    with pytest.raises(
        WrongUse, match=r"must hold \{port\} and \{element\} once each, without a format, in at most 100"
    ):
        Disguise(1, spelling)


@pytest.mark.parametrize("lie", ["Mine.__module__ = 'abc'", "__file__ = '/etc/hostname'"])
def test_an_adapter_cannot_name_the_file_of_another(here: Path, monkeypatch: pytest.MonkeyPatch, lie: str) -> None:
    """Certificates have the digest of the file: once a product was certified with that of a module of Python."""
    (here / "theirs").mkdir()
    (here / "theirs" / "mine.py").write_text(
        "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter\n"
        f"class Mine(ReferenceAdapter):\n    product = 'Mine'\n{lie}\n"
    )
    monkeypatch.chdir(here)
    with Driver(locate("theirs.mine:Mine"), seed=1) as driver:
        assert driver.identity.product == "Mine"
        assert driver.adapter_file == str(here / "theirs" / "mine.py")


def test_adapter_of_the_same_name_is_named(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The current directory comes before PYTHONPATH, which once certified the wrong adapter."""
    near, far = here / "near", here / "far"
    for folder, product in ((near, "near"), (far, "far")):
        folder.mkdir()
        (folder / "mine.py").write_text(
            "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter\n"
            f"class Mine(ReferenceAdapter):\n    product = {product!r}\n"
        )
    monkeypatch.chdir(near)
    monkeypatch.setenv("PYTHONPATH", str(far))
    monkeypatch.syspath_prepend(far)
    with Driver(locate("mine:Mine"), seed=1) as driver:
        assert driver.identity.product == "near"
        assert driver.adapter_file == str(near / "mine.py")
        assert driver.warnings == (f"the adapter is {near / 'mine.py'}; another of its name is {far / 'mine.py'}",)
