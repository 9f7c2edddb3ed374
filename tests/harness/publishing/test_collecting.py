"""Each archive is verified in a process of its own: whatever it does, the others are published, and it has its line."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import msgspec
import psutil
import pytest
from certified import VERIFIER, WAIVER, put, report, verified

from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import Uncovered, Verified
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.publishing import remembering
from ucm_cts.harness.publishing.certificate import Certificate, Fallen
from ucm_cts.harness.publishing.collecting import LARGEST_ARCHIVE, Verifier, collect
from ucm_cts.harness.publishing.remembering import Memory, circumstances


def collected(
    folder: Path, verifier: Verifier | None = None, memory: Memory | None = None
) -> tuple[list[Certificate], list[Fallen]]:
    stand, fall, archives = collect(
        folder, verifier or Verifier(VERIFIER, 60), memory or Memory(), 2, lambda done, of: None
    )
    assert {digest: hashlib.sha256(path.read_bytes()).hexdigest() for digest, path in archives.items()} == {
        one.digest: one.digest for one in stand
    }
    return stand, fall


def only_fallen(folder: Path, verifier: Verifier | None = None) -> Problem:
    """The one problem of the one archive in ``folder``."""
    stand, (fallen,) = collected(folder, verifier)
    assert not stand
    (problem,) = fallen.problems
    return problem


def changed(of: Verified, **fields: object) -> bytes:
    """An archive whose verification lies about ``fields``."""
    return msgspec.json.encode({**msgspec.to_builtins(of), "lie": fields})


def test_archives_of_all_folders_are_found_and_each_counts_once(tmp_path: Path) -> None:
    put(tmp_path, "one", verified())
    put(tmp_path / "deep" / "deeper", "two", verified(report(version="1.1")))
    put(tmp_path / "again", "one", verified())
    (tmp_path / "other.zip").write_bytes(b"hang")
    stand, fall = collected(tmp_path)
    assert (sorted(one.version for one in stand), fall) == (["1.0", "1.1"], [])
    assert next(one.file for one in stand if one.version == "1.0") in ("one.ucmcert", "again/one.ucmcert")


@pytest.mark.parametrize(
    ("content", "check", "detail"),
    [
        (b"crash", "verification", "signal 11"),
        (b"memory", "verification", "exit status 1: MemoryError"),
        (b"babble", "verification", "printed no result"),
        (b"deep", "verification", "printed no result"),
        (b"complain", "verification", "ucm-cts: the archive is cut"),
        (b"flood", "verification", "prints too much"),
        (changed(verified(), digest="ef" * 32), "verification", "of another archive"),
        (changed(verified(), version="9.9"), "verification", "differ in version"),
        (changed(verified(), profile="all"), "verification", "of no profile"),
        (
            changed(verified(report(verdicts={"R-11.2.2.1-13": "fail"})), verdict="conformant"),
            "verification",
            "differ in",
        ),
        (changed(verified(), report=None), "verification", "has no report"),
        (changed(verified(), signers=[]), "verification", "no trusted key"),
        (changed(verified(), issued="yesterday"), "verification", "is no time"),
        (changed(verified(), issued="2031-02-03T04:05:06"), "verification", "is no time"),
        (changed(verified(), status=1), "verification", "another status than it prints"),
        (changed(verified(), uncovered={"untestable": ["../x"]}), "verification", "requirements that are none"),
        (changed(verified(), subjects=[{"name": "x", "sha256": "?"}]), "verification", "digest of a subject"),
    ],
)
def test_what_crashes_or_lies_is_a_line(tmp_path: Path, content: bytes, check: str, detail: str) -> None:
    put(tmp_path, "bad", content)
    problem = only_fallen(tmp_path, Verifier(VERIFIER, 60, 512))
    assert problem.check == check
    assert detail in problem.detail


def test_a_verdict_that_does_not_follow_from_its_results_is_a_lie(tmp_path: Path) -> None:
    put(tmp_path, "bad", verified(report(verdicts={"R-11.2.2.1-13": "fail"}, verdict="conformant")))
    assert "does not follow" in only_fallen(tmp_path).detail


def test_what_hangs_is_ended_with_all_that_it_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LEFT", str(tmp_path / "left"))
    put(tmp_path, "bad", b"hang")
    put(tmp_path, "good", verified())
    stand, (fallen,) = collected(tmp_path, Verifier(VERIFIER, 8))
    assert len(stand) == 1
    assert fallen.problems == (Problem("time", "verification did not end within 8 s"),)
    assert (tmp_path / "left").exists()
    started = [p for p in psutil.process_iter(["cmdline"]) if str(tmp_path / "left") in str(p.info["cmdline"] or "")]
    assert psutil.wait_procs(started, 30)[1] == [], "what is killed takes a moment to end on a busy machine"


def test_what_is_no_plain_file_is_a_line(tmp_path: Path) -> None:
    put(tmp_path / "certificates", "good", verified())
    folder = tmp_path / "certificates"
    os.mkfifo(folder / "fifo.ucmcert")
    (folder / "link.ucmcert").symlink_to(folder / "good.ucmcert")
    (folder / "folder.ucmcert").mkdir()
    with open(folder / "large.ucmcert", "wb") as large:
        large.truncate(LARGEST_ARCHIVE + 1)
    stand, fall = collected(folder)
    assert len(stand) == 1
    assert [(one.file, one.problems[0].check) for one in fall] == [
        (f"{name}.ucmcert", "file") for name in ("fifo", "folder", "large", "link")
    ]


def test_problems_that_verification_found_are_kept(tmp_path: Path) -> None:
    problems = (Problem("signature", "no key"), Problem("record", "cut"))
    put(tmp_path, "bad", verified(problems=problems))
    stand, (fallen,) = collected(tmp_path)
    assert (stand, fallen.problems, fallen.says) == ([], problems, "Acme UCM 1.0, container")


def test_names_of_files_are_never_options(tmp_path: Path) -> None:
    put(tmp_path, "--help", verified())
    put(tmp_path, "\udcff\n<b>", verified(report(version="2")))
    stand, fall = collected(tmp_path)
    assert (len(stand), fall) == (2, [])
    assert all("\n" not in one.file for one in stand)


def test_memory_is_for_one_archive_one_set_of_keys_and_one_suite(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(tmp_path / "c", "one", verified())
    keys, kept = tmp_path / "keys", tmp_path / "kept"
    keys.mkdir()
    (keys / "acme.pem").write_text("key")
    never = Verifier(("false",))

    def again(options: tuple[str, ...] = ()) -> int:
        return len(collected(tmp_path / "c", never, Memory.read(kept, circumstances([keys], options)))[0])

    memory = Memory.read(kept, circumstances([keys], ()))
    first = collected(tmp_path / "c", None, memory)[0]
    memory.write(kept)
    assert collected(tmp_path / "c", never, Memory.read(kept, circumstances([keys], ())))[0] == first
    assert again(("newer",)) == 0
    (keys / "acme.pem").write_text("another key")
    assert again() == 0
    (keys / "acme.pem").write_text("key")
    assert again() == 1
    monkeypatch.setattr(remembering, "suite_digest", lambda: "another build")
    assert again() == 0
    put(tmp_path / "c", "one", verified(report(version="1.1")))
    assert again() == 0


def test_what_fell_or_holds_for_a_time_is_verified_anew(tmp_path: Path) -> None:
    put(tmp_path, "waived", verified(uncovered=Uncovered(waivers=(WAIVER,))))
    put(tmp_path, "fallen", verified(problems=(Problem("digest", "wrong"),)))
    memory = Memory("some")
    collected(tmp_path, None, memory)
    assert not memory.used


@pytest.mark.parametrize("harm", ["others", "link", "text", "foreign"])
def test_memory_that_others_could_have_written_is_refused(tmp_path: Path, harm: str) -> None:
    kept = tmp_path / "kept"
    Memory("some").write(kept)
    assert kept.stat().st_mode & 0o777 == 0o600
    if harm == "others":
        kept.chmod(0o666)
    elif harm == "link":
        kept.rename(tmp_path / "real")
        kept.symlink_to(tmp_path / "real")
    elif harm == "text":
        kept.write_bytes(b"{}")
    elif os.geteuid() == 0:
        os.chown(kept, 12345, 12345)
    else:
        pytest.skip("only root can give a file away")
    with pytest.raises(WrongUse, match=r"remember|others can write|no memory"):
        Memory.read(kept, "some")
