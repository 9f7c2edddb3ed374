"""What the code behind an adapter can do to the harness, its user and the machine: nothing, in a sandbox."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
from command_line import report_of, ucm_cts

from ucm_cts.adapters.contract.messages import Run
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.hosting import sandbox, view
from ucm_cts.harness.hosting.host_channels import HostUnavailable
from ucm_cts.harness.hosting.hosts import Hosts, Limits
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.hosting.view import MANIFEST, clean_environment, view_of
from ucm_cts.harness.results.values import Incident

REQUIREMENT = "R-11.2.2.1-13"
LIMITS = Limits(seconds=20, memory=256)

needs_sandbox = pytest.mark.skipif(bool(sandbox.why_none()), reason=f"no sandbox here: {sandbox.why_none()}")
pytestmark = [pytest.mark.usefixtures("here")]

ADAPTER = """
import ctypes, os, signal, subprocess, sys, time
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

{top}

class Mine(ReferenceAdapter):
    def create_runtime(self, implementations):
        {each}
        return super().create_runtime(implementations)
"""


def adapter(folder: Path, each: str = "pass", top: str = "") -> str:
    """An adapter that does ``top`` when it is loaded, and ``each`` in each scenario; what it prints is kept."""
    (folder / "mine.py").write_text(ADAPTER.format(top=top, each=each))
    return "mine:Mine"


def said(folder: Path, question: str) -> str:
    """What the Python expression ``question`` is in a host."""
    text = f"version = repr({question})"
    (folder / "asked.py").write_text(ADAPTER.format(top="", each="pass") + f"    {text}\n")
    with Hosts(locate("asked:Mine", hidden=[folder / "out"]), LIMITS) as hosts:
        return hosts.welcome.version


def inside(folder: Path, command: str) -> str:
    """What a shell command prints in a sandbox whose current folder is ``folder``."""
    started = sandbox.start(["sh", "-c", command], view_of([]), folder=folder, error=subprocess.STDOUT)
    assert started.process.stdout is not None
    printed = started.process.stdout.read().decode()
    started.end()
    started.process.stdout.close()
    return printed


# what it sees


@needs_sandbox
def test_homes_reports_and_the_harness_are_hidden(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home = here / "home"
    (home / ".ssh").mkdir(parents=True)
    (home / ".ssh" / "key").write_text("secret")
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("ACME_TOKEN", "secret")
    for name in ("out", "earlier"):
        (here / name).mkdir()
        (here / name / MANIFEST).write_text("{}")
    (here / "vendor").mkdir()
    package = Path(sandbox.__file__).parents[2]
    question = (
        f"[sorted(os.listdir(p)) for p in ('out', 'earlier', {str(package / 'harness')!r}, {str(package / 'suite')!r})]"
    )
    assert said(here, question) == "[[], [], [], []]"
    assert said(here, "[os.environ.get('ACME_TOKEN'), os.path.isdir('vendor')]") == "[None, True]"
    view._hidden_places.cache_clear()
    try:
        assert said(here, "os.path.exists(os.path.expanduser('~/.ssh/key'))") == "False"
    finally:
        view._hidden_places.cache_clear()


@needs_sandbox
def test_processes_of_the_harness_are_not_seen(here: Path) -> None:
    numbers = said(here, "sorted(int(n) for n in os.listdir('/proc') if n.isdecimal())")
    assert set(json.loads(numbers)) <= set(range(1, 30))
    lines = said(here, "[open(f'/proc/{n}/cmdline').read() for n in os.listdir('/proc') if n.isdecimal()]")
    assert "pytest" not in lines
    assert "ucm_cts.harness" not in lines


@needs_sandbox
def test_nothing_but_scratch_can_be_written_and_nothing_of_that_stays(here: Path) -> None:
    (here / "kept").write_text("as it is")
    before = set(os.listdir(here))
    printed = inside(here, 'for f in kept new "$HOME/new" /tmp/new /usr/new; do echo x >> $f && echo wrote $f; done')
    assert re.findall("(?m)^wrote (.*)$", printed) == ["new", f"{os.path.expanduser('~')}/new", "/tmp/new"]
    assert (here / "kept").read_text() == "as it is"
    assert set(os.listdir(here)) == before
    assert not Path("/tmp/new").exists()


@needs_sandbox
def test_what_is_of_the_whole_system_cannot_be_written(here: Path) -> None:
    """A root without capabilities may write to ``/proc/sys``, which names a program that the system runs when a process crashes."""
    printed = inside(here, "find /proc /sys -type f -not -path '/proc/[0-9]*' -not -path '/proc/pressure/*' -writable")
    assert [line for line in printed.splitlines() if line.startswith("/")] == []


def test_secrets_in_the_environment_are_left_out() -> None:
    given = {"PATH": "/bin", "GITHUB_TOKEN": "x", "DB_PASSWORD": "x", "SSH_AUTH_SOCK": "/s", "JAVA_HOME": "/j"}
    assert clean_environment(given) == {"PATH": "/bin", "JAVA_HOME": "/j"}


# what a host needs


@needs_sandbox
@pytest.mark.parametrize("linked", [False, True])
def test_links_relative_paths_and_neighbours_of_an_adapter_work(
    here: Path, monkeypatch: pytest.MonkeyPatch, linked: bool
) -> None:
    there = here / "real" / "project"
    (there / "data").mkdir(parents=True)
    (there / "data" / "words").write_text("found")
    (here / "way").symlink_to(there)
    adapter(there, top="assert (Path(__file__).parent / 'data' / 'words').read_text() == 'found'")
    (here / "elsewhere").mkdir()
    monkeypatch.chdir(here / "elsewhere")
    monkeypatch.setenv("PYTHONPATH", "../way" if linked else "../real/project")
    monkeypatch.syspath_prepend(there)
    with Hosts(locate("mine:Mine"), LIMITS) as hosts:
        assert hosts.welcome.product
        assert hosts.isolation == "bubblewrap"


@needs_sandbox
def test_hosts_may_write_where_programs_write(here: Path) -> None:
    places = "os.environ.get('TMPDIR', '/tmp'), os.path.expanduser('~'), '.', '/dev/shm', '/var/tmp'"
    wrote = f"[Path(p, 'log').write_text('x') for p in ({places})]"
    assert said(here, wrote) == "[1, 1, 1, 1, 1]"


@needs_sandbox
def test_an_adapter_that_misses_something_is_told_of_the_sandbox(here: Path) -> None:
    hidden = here / "earlier"
    hidden.mkdir()
    (hidden / MANIFEST).write_text("{}")
    (hidden / "words").write_text("x")
    outcome = ucm_cts("run", adapter(here, top=f"open({str(hidden / 'words')!r})"), "-k", REQUIREMENT)
    assert outcome.status == 2
    assert f"the sandbox hides {hidden / 'words'}" in outcome.err
    assert "--no-sandbox" in outcome.err
    assert len(outcome.err.splitlines()) == 1
    assert ucm_cts("run", "mine:Mine", "-k", REQUIREMENT, "--no-sandbox").status == 0


@needs_sandbox
def test_an_executable_that_misses_something_is_told_of_the_sandbox(here: Path) -> None:
    hidden = here / "earlier"
    hidden.mkdir()
    (hidden / MANIFEST).write_text("{}")
    (here / "host.sh").write_text(f"#!/bin/sh\ncat {hidden / MANIFEST}\n")
    (here / "host.sh").chmod(0o755)
    with pytest.raises(HostUnavailable, match="the sandbox hides"), Hosts(locate("./host.sh"), LIMITS) as hosts:
        assert hosts.welcome


# what it says


@needs_sandbox
def test_reports_say_where_the_code_ran(here: Path) -> None:
    for options, isolation in ([], "bubblewrap"), (["--no-sandbox"], "process"), (["--in-process"], "none"):
        ucm_cts("run", "reference-py", "-k", REQUIREMENT, "--out", "out", *options)
        report = report_of(here / "out")
        assert report["isolation"] == isolation
        assert any("isolation: process" in w for w in report["warnings"]) == (isolation == "process")


def test_without_bubblewrap_a_run_goes_on_and_says_so(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "PROGRAM", "no-such-program")
    sandbox.why_none.cache_clear()
    try:
        assert ucm_cts("run", "reference-py", "-k", REQUIREMENT, "--out", "out").status == 0
    finally:
        sandbox.why_none.cache_clear()
    report = report_of(here / "out")
    assert report["isolation"] == "process"
    (warning,) = report["warnings"]
    assert "bubblewrap is not installed" in warning


# what it cannot do


ATTACKS = {
    "kills its parents": "[os.kill(n, 9) for n in range(2, 5) if n != os.getpid()]",
    "kills everything": "os.kill(-1, 9)",
    "kills the runner": "[os.kill(int(w), 9) for w in os.environ['VICTIMS'].split() if os.path.exists('/proc/' + w)]",
}


@needs_sandbox
@pytest.mark.parametrize("attack", ATTACKS.values(), ids=ATTACKS)
def test_the_harness_cannot_be_killed(here: Path, monkeypatch: pytest.MonkeyPatch, attack: str) -> None:
    monkeypatch.setenv("VICTIMS", f"{os.getpid()} {os.getppid()}")
    once = f"Path('done').exists() or Path('done').touch() or {attack}"
    outcome = ucm_cts("run", adapter(here, once), "-k", REQUIREMENT, "--out", "out")
    assert outcome.status in (0, 1)
    assert report_of(here / "out")["isolation"] == "bubblewrap"


@needs_sandbox
def test_reports_cannot_be_rewritten_during_or_after_a_run(here: Path) -> None:
    rewrites = (
        "import os\n"
        "for d, _, names in os.walk('.'):\n"
        "    for n in names:\n"
        "        if n == 'report.json': open(os.path.join(d, n), 'w').write('{}')\n"
    )
    daemon = f"import time\nfor _ in range(100):\n    exec({rewrites!r})\n    time.sleep(0.1)\n"
    at_once = f"subprocess.run([sys.executable, '-c', {rewrites!r}], check=False, stderr=subprocess.DEVNULL)"
    later = f"subprocess.Popen([sys.executable, '-c', {daemon!r}], start_new_session=True)"
    older = here / "older" / "report.json"
    older.parent.mkdir()
    older.write_text("of another run")
    ucm_cts("run", adapter(here, later, at_once), "-k", REQUIREMENT, "--out", "out")
    before = (here / "out" / "report.json").read_bytes()
    time.sleep(1)
    assert (here / "out" / "report.json").read_bytes() == before
    assert json.loads(before)["product"]
    assert older.read_text() == "of another run"


@needs_sandbox
def test_nothing_outlives_a_run(here: Path) -> None:
    nap = "98765.25"
    twice = f"os.fork() or (os.setsid(), os.fork() or os.execve('/bin/sleep', ['sleep', '{nap}'], {{}}), os._exit(0))"
    top = f"subprocess.Popen(['/bin/sleep', '{nap}'], start_new_session=True, env={{}})"
    with Hosts(locate(adapter(here, twice, top)), LIMITS) as hosts:
        assert hosts.welcome.product
    assert not [p for p in psutil.process_iter() if nap in _command_line(p)]


def _command_line(process: psutil.Process) -> list[str]:
    try:
        return process.cmdline()
    except psutil.Error:
        return []


@needs_sandbox
def test_the_terminal_of_the_harness_cannot_be_written_to(here: Path) -> None:
    assert said(here, "os.path.exists('/proc/self/fd/0') and os.readlink('/proc/self/fd/0')") in (
        "'/dev/null'",
        "False",
    )
    started = subprocess.run(
        [
            *(sys.executable, "-c", "import pty, sys; pty.spawn(sys.argv[1:])"),
            *(sys.executable, "-m", "ucm_cts", "run", adapter(here, "", _WRITES), "-k", REQUIREMENT, "--out", "out"),
        ],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert "CONFORMANT" in started.stdout
    assert "gotcha" not in started.stdout


_WRITES = """
for place in ('/dev/tty', '/dev/console', *(f'/dev/pts/{n}' for n in range(9)), '/proc/1/fd/1', '/proc/1/fd/2'):
    try:
        with open(place, 'w') as terminal:
            terminal.write('gotcha')
    except OSError:
        pass
"""


@needs_sandbox
def test_memory_is_that_of_all_processes(here: Path) -> None:
    takes = "bytearray(os.urandom(1)) * (90 << 20)"
    each = f"[(os.fork() or (exec('x = {takes}'), time.sleep(60), os._exit(0))) for _ in range(4)]; time.sleep(60)"
    with Hosts(locate(adapter(here, each)), LIMITS) as hosts:
        (answer,) = hosts.run([_run()])
    assert isinstance(answer.reply, Incident)
    assert answer.reply.kind == "memory"
    assert "processes" in answer.reply.detail


@needs_sandbox
def test_processes_are_limited(here: Path) -> None:
    each = "[os.fork() or (time.sleep(60), os._exit(0)) for _ in range(60)]; time.sleep(60)"
    with Hosts(locate(adapter(here, each)), Limits(seconds=20, processes=20)) as hosts:
        (answer,) = hosts.run([_run()])
    assert isinstance(answer.reply, Incident)
    assert answer.reply.kind == "memory"
    assert "20 allowed" in answer.reply.detail


@needs_sandbox
def test_processes_and_threads_are_limited_by_the_system(here: Path) -> None:
    assert int(inside(here, "bash -c 'ulimit -u'")) <= sandbox.MOST_TASKS


def _run() -> Run:
    return Run(0, Scenario({}, ()))


# published names


PUBLISHED = """
import sys
from pathlib import Path
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

if "ucm_cts.harness.hosting" in sys.modules or "pytest" in sys.modules:
    Path(__file__).with_name("loaded-in-the-harness").touch()

class Mine(ReferenceAdapter):
    pass

HERE = Path(__file__).with_name("statement.toml")
"""


@pytest.fixture
def published(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a package that publishes an adapter and a statement."""
    place = here / "site"
    info = place / "acme-1.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme\nVersion: 1\n")
    (info / "entry_points.txt").write_text(
        "[ucm_cts.adapters]\nacme = acme_adapter:Mine\nfails = acme_adapter:Nobody\n"
        "[ucm_cts.statements]\nacme = acme_adapter:HERE\n"
    )
    (place / "acme_adapter.py").write_text(PUBLISHED)
    (place / "statement.toml").write_text('profiles = ["container"]\n')
    monkeypatch.syspath_prepend(place)
    monkeypatch.setenv("PYTHONPATH", str(place))
    return place


def test_what_a_package_publishes_is_not_loaded_into_the_harness(published: Path, here: Path) -> None:
    outcome = ucm_cts("run", "acme", "-k", REQUIREMENT, "--out", str(here / "out"), "--no-sandbox")
    assert outcome.status == 0, outcome
    assert "acme_adapter" not in sys.modules
    assert not (published / "loaded-in-the-harness").exists()
    assert report_of(here / "out")["statement"]["source"] == "statement.toml"
    with pytest.raises(WrongUse, match=r"'fails' stands for acme_adapter:Nobody, which fails: AttributeError"):
        locate("fails")


def test_modules_beside_an_adapter_do_not_replace_those_of_the_harness(here: Path) -> None:
    (here / "rich.py").write_text("raise SystemExit('replaced')\n")
    done = subprocess.run(
        [sys.executable, "-m", "ucm_cts", "run", "reference-py", "-k", REQUIREMENT],
        env={**os.environ, "PYTHONPATH": str(here)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")


@needs_sandbox
def test_what_bubblewrap_cannot_mount_is_one_line(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sandbox, "_DEVICES", ("--ro-bind", "/no/such/place", "/x"))
    with (
        pytest.raises(HostUnavailable, match="could not make the sandbox; --no-sandbox"),
        Hosts(locate("reference-py")) as hosts,
    ):
        assert hosts.welcome
