"""Each scenario gets an answer or an incident from any host; no process or descriptor is left over."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from files import SUPPORT

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Refused, Run, Traced
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.adapters.contract.trace import Call, Create
from ucm_cts.adapters.sdk.python.loading import load
from ucm_cts.harness.hosting.hosts import Answer, Hosts, HostUnavailable, Limits
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.results.values import Incident

sys.path.insert(0, str(SUPPORT / "hostile"))
import speakers

pytestmark = pytest.mark.slow

REFERENCE = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"
CALM = Scenario({"calm": Declaration()}, (s.AddComponent("calm"), s.Start()))
TRIGGER = Scenario({"calm": Declaration(), "trigger": Declaration()}, (s.AddComponent("trigger"),))
IN_THREAD = Scenario({"trigger": Declaration()}, (s.AddComponent("trigger", thread="w"),), patience=20)
LIMITS = Limits(seconds=2, memory=200, line=1 << 20, welcome_seconds=2)
PATIENT = Limits(seconds=20, memory=200, line=1 << 20)


@pytest.fixture(autouse=True)
def in_hostile_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(SUPPORT / "hostile")


@pytest.fixture
def no_leaks() -> Iterator[None]:
    before = set(os.listdir("/proc/self/fd")), children(os.getpid())
    yield
    assert set(os.listdir("/proc/self/fd")) <= before[0]
    assert children(os.getpid()) <= before[1]


def children(pid: int, recursive: bool = False) -> set[int]:
    return {child.pid for child in psutil.Process(pid).children(recursive)}


def around_trigger(adapter: str, limits: Limits, trigger: Scenario = TRIGGER) -> tuple[Answer, list[Answer]]:
    """The answer to a scenario that provokes the adapter, and to those before and after it, all pipelined."""
    scenarios = [CALM, trigger, CALM, CALM]
    with Hosts(locate(adapter), limits) as hosts:
        answers = list(hosts.run(Run(10 + n, scenario) for n, scenario in enumerate(scenarios)))
    assert [answer.id for answer in answers] == [10, 11, 12, 13]
    return answers.pop(1), answers


def incident_of(adapter: str, limits: Limits) -> Incident:
    answer, others = around_trigger(adapter, limits)
    assert all(isinstance(other.reply, Traced) for other in others)
    assert isinstance(answer.reply, Incident)
    return answer.reply


@pytest.mark.parametrize(
    ("adapter", "kind", "detail", "stack"),
    [
        ("ReadsNullPointer", "crash", "SIGSEGV", "in misbehave"),
        ("Aborts", "crash", "SIGABRT", "in misbehave"),
        ("IsKilled", "crash", "SIGKILL", ""),
        ("LeavesChildren", "crash", "SIGABRT", "in misbehave"),
        ("Leaves", "exit", "exit status 0", ""),
        ("LeavesWithThree", "exit", "exit status 3", ""),
        ("EatsMemory", "memory", "200 MiB allowed", ""),
    ],
)
@pytest.mark.usefixtures("no_leaks")
def test_end_of_a_host_is_an_incident(adapter: str, kind: str, detail: str, stack: str) -> None:
    incident = incident_of(f"misbehaving:{adapter}", PATIENT)
    assert incident.kind == kind
    assert detail in incident.detail
    assert stack in incident.stacks


@pytest.mark.parametrize("adapter", ["Hangs", "HangsNatively"])
@pytest.mark.usefixtures("no_leaks")
def test_hang_is_an_incident_with_stacks(adapter: str) -> None:
    incident = incident_of(f"misbehaving:{adapter}", LIMITS)
    assert (incident.kind, incident.detail) == ("hang", "no answer within 2 s")
    assert "in misbehave" in incident.stacks


@pytest.mark.usefixtures("no_leaks")
def test_machine_that_stands_still_is_no_hang() -> None:
    with Hosts(locate("misbehaving:Dawdles"), Limits(seconds=3)) as hosts:
        hosts.start_fresh()
        every = f"{os.getpid()} {' '.join(map(str, children(os.getpid(), recursive=True)))}"
        stopper = f"sleep 0.3; kill -STOP {every}; sleep 3.5; kill -CONT {every}"
        with subprocess.Popen(["/bin/sh", "-c", stopper], start_new_session=True):
            (answer,) = hosts.run([Run(1, TRIGGER)])
    assert isinstance(answer.reply, Traced), answer.reply


@pytest.mark.usefixtures("no_leaks")
def test_stuck_thread_is_reported_and_the_host_replaced() -> None:
    answer, others = around_trigger("misbehaving:HangsOnWorkers", PATIENT, IN_THREAD)
    assert isinstance(answer.reply, Traced)
    assert answer.reply.stuck == ("w",)
    assert all(isinstance(other.reply, Traced) for other in others)


@pytest.mark.parametrize("adapter", ["Prints", "FloodsStandardError", "ExitsByException"])
def test_output_and_exit_of_a_framework_do_not_reach_the_protocol(adapter: str) -> None:
    answer, others = around_trigger(f"misbehaving:{adapter}", PATIENT)
    assert all(isinstance(each.reply, Traced) for each in (answer, *others))


@pytest.mark.parametrize(
    ("adapter", "reason"),
    [
        ("GivesTextForAnId", "add_component returned 'number one'; it returns an integer"),
        ("HasNoRuntime", "licence server"),
    ],
)
def test_adapter_that_breaks_its_contract_is_refused(adapter: str, reason: str) -> None:
    answer, _ = around_trigger(f"misbehaving:{adapter}", PATIENT)
    assert isinstance(answer.reply, Refused)
    assert reason in answer.reply.reason


@pytest.mark.parametrize(
    ("speaker", "kind", "detail"),
    [
        (speakers.SaysGarbage, "garbage", "DEBUG: container started"),
        (speakers.SaysBinary, "garbage", "not a JSON message"),
        (speakers.MistakesTypes, "protocol", "$.events[0].n"),
        (speakers.AddsFields, "protocol", "unknown field `mood`"),
        (speakers.MistakesId, "protocol", "id 12 where 11 is due"),
        (speakers.StreamsUnasked, "protocol", "event where trace is due"),
        (speakers.StopsInTheMiddle, "exit", "exit status 0 after 12 bytes of an answer"),
        (speakers.NeverEndsALine, "flood", "more than 1 MiB"),
        (speakers.HangsUp, "exit", "closed its output"),
    ],
)
@pytest.mark.usefixtures("no_leaks")
def test_breach_of_protocol_is_an_incident(
    tmp_path: Path, speaker: type[speakers.Speaker], kind: str, detail: str
) -> None:
    incident = incident_of(str(speakers.wrap(speaker, tmp_path)), PATIENT)
    assert incident.kind == kind
    assert detail in incident.detail


def test_stream_without_end_is_a_hang(tmp_path: Path) -> None:
    with Hosts(locate(str(speakers.wrap(speakers.StreamsForEver, tmp_path))), LIMITS) as hosts:
        answer = hosts.run_again(Run(1, TRIGGER))
    assert isinstance(answer.reply, Incident)
    assert answer.reply.kind == "hang"
    assert answer.happened


@pytest.mark.parametrize(
    ("speaker", "kind", "detail"),
    [
        (speakers.SaysNothing, "hang", "does not answer hello: hang, no answer within 2 s"),
        (speakers.SpeaksAnotherProtocol, "protocol", "speaks protocol 3, the harness 2"),
        (speakers.HasNoName, "protocol", "Expected `str` of length >= 1 - at `$.product`"),
        (speakers.DiesAtOnce, "exit", "exit status 4\ncannot read my configuration"),
        (speakers.DiesLoudly, "exit", "noise 4999"),
    ],
)
@pytest.mark.usefixtures("no_leaks")
def test_without_a_welcome_there_is_no_host(
    tmp_path: Path, speaker: type[speakers.Speaker], kind: str, detail: str
) -> None:
    with (
        Hosts(locate(str(speakers.wrap(speaker, tmp_path))), LIMITS) as hosts,
        pytest.raises(HostUnavailable) as caught,
    ):
        list(hosts.run([Run(1, CALM)]))
    assert caught.value.incident.kind == kind
    assert detail in str(caught.value)
    assert len(str(caught.value).splitlines()) <= 22, "only the end of what was printed"
    assert "\x1b" not in str(caught.value)


@pytest.mark.usefixtures("no_leaks")
def test_second_run_streams_the_events_before_a_crash() -> None:
    scenario = Scenario(TRIGGER.components, (s.AddComponent("calm"), s.AddComponent("trigger")))
    with Hosts(locate("misbehaving:Aborts"), PATIENT) as hosts:
        first = next(hosts.run([Run(1, scenario)]))
        second = hosts.run_again(Run(2, scenario))
    assert isinstance(first.reply, Incident)
    assert first.happened == ()
    assert isinstance(second.reply, Incident)
    assert [type(event) for event in second.happened][:2] == [Call, Create]
    assert isinstance(second.happened[-1], Call)
    assert second.happened[-1].step == 1


@pytest.mark.usefixtures("no_leaks")
def test_second_run_may_come_between_answers() -> None:
    seen = []
    with Hosts(locate("misbehaving:Aborts"), PATIENT) as hosts:
        for answer in hosts.run(Run(n, TRIGGER if n % 7 == 3 else CALM) for n in range(100)):
            crashed = isinstance(answer.reply, Incident)
            seen.append((answer.id, crashed))
            if crashed or answer.id % 10 == 0:
                again = hosts.run_again(Run(1000, TRIGGER if crashed else CALM))
                assert isinstance(again.reply, Incident) == crashed
    assert seen == [(n, n % 7 == 3) for n in range(100)]


@pytest.mark.usefixtures("no_leaks")
def test_long_pipelines_do_not_lock_up() -> None:
    long = Scenario({"calm": Declaration(attributes={"a": "x" * 200_000})}, (s.AddComponent("calm"),))
    with Hosts(locate(REFERENCE), PATIENT) as hosts:
        answers = list(hosts.run((Run(n, long) for n in range(100)), window=50))
    assert [answer.id for answer in answers] == list(range(100))


@pytest.mark.usefixtures("no_leaks")
def test_abandoned_answers_are_not_mixed_up() -> None:
    with Hosts(locate(REFERENCE), PATIENT) as hosts:
        for _ in hosts.run(Run(n, CALM) for n in range(20)):
            break
        assert [answer.id for answer in hosts.run(Run(n, CALM) for n in range(50, 60))] == list(range(50, 60))


@pytest.mark.usefixtures("no_leaks")
def test_fresh_host_after_a_crash_is_a_fork_of_the_same_template() -> None:
    """A fork costs a fraction of a start; ``tox -e bench`` has the figures."""
    others = children(os.getpid())  # what tests before this one have left
    with Hosts(locate("misbehaving:Aborts"), PATIENT) as hosts:
        assert hosts.welcome.product
        template = children(os.getpid()) - others
        for answer in hosts.run(Run(n, TRIGGER) for n in range(21)):
            assert isinstance(answer.reply, Incident)
            assert children(os.getpid()) - others == template
    assert len(template) == 1


def test_lost_template_is_replaced() -> None:
    others = children(os.getpid())  # what tests before this one have left
    with Hosts(locate(REFERENCE), PATIENT) as hosts:
        assert isinstance(next(hosts.run([Run(1, CALM)])).reply, Traced)
        (template,) = children(os.getpid()) - others
        (host,) = children(template)
        gone = os.pidfd_open(host)
        os.kill(template, signal.SIGKILL)
        assert select.select([gone], [], [], 5)[0]
        os.close(gone)
        first, second = hosts.run([Run(2, CALM), Run(3, CALM)])
    assert isinstance(first.reply, Incident)
    assert isinstance(second.reply, Traced)


def test_nothing_survives_a_killed_harness() -> None:
    script = """
import os
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Run
from ucm_cts.harness.hosting.hosts import Hosts, Limits
from ucm_cts.harness.hosting.locate import locate
hosts = Hosts(locate("misbehaving:Hangs"), Limits(seconds=600))
hosts.welcome
print("ready", flush=True)
list(hosts.run([Run(1, s.Scenario({"trigger": s.Declaration()}, (s.AddComponent("trigger"),)))]))
"""
    harness = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE)
    try:
        assert harness.stdout
        assert harness.stdout.readline() == b"ready\n"
        (template,) = children(harness.pid)
        handles = [os.pidfd_open(pid) for pid in (template, *children(template))]
        assert len(handles) == 2
    finally:
        harness.kill()
        harness.wait()
        harness.stdout.close()  # type: ignore[union-attr]
    for handle in handles:
        assert select.select([handle], [], [], 5)[0]
        os.close(handle)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:0", "unix:{}/socket"])
def test_listening_host(tmp_path: Path, address: str) -> None:
    command = [
        sys.executable,
        "-m",
        "ucm_cts.adapters.sdk.python.host",
        "misbehaving:Aborts",
        "--listen",
        address.format(tmp_path),
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
        try:
            assert server.stdout
            endpoint = server.stdout.readline().decode().removeprefix("listening on ").strip()
            incident = incident_of(endpoint, PATIENT)
            assert (incident.kind, incident.detail) == ("exit", "the connection was closed")
        finally:
            server.kill()


def test_address_without_listener(tmp_path: Path) -> None:
    with (
        Hosts(locate(f"unix:{tmp_path}/nobody")) as hosts,
        pytest.raises(HostUnavailable, match="is the adapter running"),
    ):
        hosts.welcome  # noqa: B018


def test_in_process_gives_the_same_events() -> None:
    def events(in_process: bool) -> list[str]:
        with Hosts(locate(REFERENCE, in_process)) as hosts:
            answer = hosts.run_again(Run(1, CALM))
            assert isinstance(answer.reply, Traced)
            assert answer.reply.events == answer.happened
            return [type(event).__name__ for event in answer.happened]

    assert events(True) == events(False)


@pytest.fixture
def short_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    info = tmp_path / "friendly-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: friendly\nVersion: 1\n")
    published = {
        "as-class": REFERENCE,
        "as-path": "friendly:EXECUTABLE",
        "as-module": "misbehaving",
        "broken": "friendly:NO_SUCH",
    }
    (info / "entry_points.txt").write_text(
        "[ucm_cts.adapters]\n" + "\n".join(f"{k} = {v}" for k, v in published.items())
    )
    executable = speakers.wrap(speakers.SaysGarbage, tmp_path)
    (tmp_path / "friendly.py").write_text(f"from pathlib import Path\nEXECUTABLE = Path({str(executable)!r})\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")


@pytest.mark.usefixtures("short_names")
def test_short_names_name_any_endpoint() -> None:
    assert (locate("as-class").kind, locate("as-class").target) == ("python", REFERENCE)
    assert (locate("as-module").kind, locate("as-module").target) == ("python", "misbehaving")
    assert (locate("as-path").kind, locate("as-path").text) == ("executable", "as-path")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("ucm_cts.adapters.reference_py.adapter:ReferenceAdapter", REFERENCE),
        ("ucm_cts.adapters.derived:serialises_calls", "ucm_cts.adapters.mutants.python:serialises_calls"),
    ],
)
def test_old_names_of_bundled_adapters_still_work(old: str, new: str) -> None:
    with pytest.warns(FutureWarning, match="is deprecated: use ucm_cts.adapters"):
        endpoint = locate(old)
    assert (endpoint.text, endpoint.target) == (old, new)
    with pytest.warns(FutureWarning, match="is deprecated: use ucm_cts.adapters"):
        assert load(old)(b"{}", lambda line: None)


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("as-clas", "Did you mean 'as-class'?"),
        ("broken", "friendly:NO_SUCH, which fails"),
        ("nonsense", "Short names here: "),
        ("no_such_module:Class", "there is no module no_such_module"),
        ("./no/such/file", "there is no file"),
        ("misbehaving.py", "misbehaving:Class"),
        ("/etc/passwd", "not executable"),
        ("/etc", "is no file"),
        ("tcp://127.0.0.1", "write tcp://HOST:PORT"),
        ("tcp://host:port", "write tcp://HOST:PORT"),
        ("unix:", "write unix:/PATH"),
        ("", "no ADAPTER is named"),
        ("a b:c", "names no adapter"),
    ],
)
@pytest.mark.usefixtures("short_names")
def test_wrong_names_get_advice(text: str, advice: str) -> None:
    with pytest.raises(WrongUse) as caught:
        locate(text)
    assert advice in str(caught.value)


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("misbehaving:NoSuch", "has no NoSuch; there is"),
        ("misbehaving:_Hostile.x", "names no adapter"),
        ("misbehaving", "did you mean misbehaving:"),
        ("speakers:Speaker", "is not a subclass"),
        ("os.nothing", "there is no module os.nothing"),
    ],
)
def test_wrong_classes_get_advice(text: str, advice: str) -> None:
    for in_process in (False, True):
        with pytest.raises(WrongUse) as caught, Hosts(locate(text, in_process)) as hosts:
            hosts.welcome  # noqa: B018
        assert advice in str(caught.value)
