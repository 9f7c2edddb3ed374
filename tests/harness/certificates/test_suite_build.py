"""The digest of the suite has all that can change a verdict, and nothing else."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from workshop import Workshop

import ucm_cts
from ucm_cts.harness.certificates.suite_build import suite_files

ROOT = Path(ucm_cts.__file__).parent
VERIFIES = """
import sys
from pathlib import Path
used = set()
sys.addaudithook(lambda event, given: used.add(str(given[0])) if event == "open" else None)
from ucm_cts.harness.certificates import toolchain_rejudging
from ucm_cts.harness.certificates.judging import judged_again
from ucm_cts.harness.certificates.keys import trust_in
from ucm_cts.harness.certificates.verifying import Verifier
verified = Verifier(trust_in(Path(sys.argv[2])), judged_again).verify(Path(sys.argv[1]).read_bytes())
assert verified.stands, verified.problems
used |= {module.__file__ for name, module in sys.modules.items() if name.startswith("ucm_cts.") and module.__file__}
print(*sorted(used), sep="\\n")
"""


def test_every_file_that_a_verifier_uses_is_in_it(workshop: Workshop) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", VERIFIES, workshop.certificate, workshop.folder / "keys"],
        capture_output=True,
        text=True,
        check=True,
    )
    paths = [Path(line) for line in ended.stdout.splitlines()]
    used = {
        path.relative_to(ROOT) for path in paths if path.is_relative_to(ROOT) and path.suffix not in (".pyc", ".so")
    }
    product = {path for path in used if path.is_relative_to("adapters/reference")}
    packages = {path for path in used if path.name == "__init__.py"}
    known = {path.relative_to(ROOT) for path in suite_files()}
    assert len(used & known) > 200
    assert used - known - product - packages == set()


def test_what_only_shows_keeps_or_tries_is_not_in_it() -> None:
    known = [path.relative_to(ROOT).as_posix() for path in suite_files()]
    assert {Path(path).suffix for path in known} <= {".py", ".yaml", ".json", ".xml", ".xsd", ".lark"}
    for room in ("cli", "publishing", "history", "selftest", "bench", "report/html.py"):
        assert (ROOT / "harness" / room).exists()
        assert not any(path.startswith(f"harness/{room}") for path in known)
    assert len(known) == len(set(known))
