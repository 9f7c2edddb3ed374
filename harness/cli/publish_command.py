"""``ucm-cts publish``: a static site of certificates."""

from __future__ import annotations

import os
import re
from pathlib import Path

import click

from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.cli.options import CONFORMANT, Folder, Seconds, leave
from ucm_cts.harness.cli.results_command import keep, write_pages
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.publishing.collecting import Verifier, collect, verifying_command
from ucm_cts.harness.publishing.pages import FILES, site_files
from ucm_cts.harness.publishing.remembering import Memory, circumstances
from ucm_cts.harness.publishing.site import Site, site_of
from ucm_cts.harness.report.out_folder import Copy, OutFolder
from ucm_cts.harness.report.published import PublishedResult
from ucm_cts.harness.results.foreign import one_line

_URL = re.compile(r"https?://[A-Za-z0-9.-]+(:\d+)?(/[A-Za-z0-9._~/-]*)?")

SHOWN = 20
"""The most certificates that do not stand that are told on the terminal; the site has all."""


@click.command()
@click.argument("certificates", type=click.Path(path_type=Path))
@click.option("--out", type=Folder(file_okay=False, path_type=Path), required=True, help="The folder of the site.")
@click.option(
    "--trust", type=click.Path(path_type=Path), required=True, help="The keys that are trusted: a folder or a file."
)
@click.option("--auditor", type=click.Path(path_type=Path), help="The keys that are trusted as auditors.")
@click.option("--suite", type=click.Choice(["newer"]), help="Judge old certificates by the rules of this suite, too.")
@click.option(
    "--remember",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Keep in this file what was verified, and verify only what is new.",
)
@click.option(
    "--results",
    type=click.Path(file_okay=False, path_type=Path),
    help="A folder of results, as 'ucm-cts results' keeps: it gets the verdicts of what stands.",
)
@click.option("--url", default="", help="Where the site will be: https://example.org/ucm/")
@click.option(
    "--time", "seconds", type=Seconds(min=1), default=600, show_default=True, help="Seconds each verification may take."
)
@click.option(
    "--memory",
    type=click.IntRange(min=256),
    default=4096,
    show_default=True,
    help="MiB that each verification may use.",
)
def publish(
    certificates: Path,
    out: Path,
    trust: Path,
    auditor: Path | None,
    suite: str | None,
    remember: Path | None,
    results: Path | None,
    url: str,
    seconds: float,
    memory: int,
) -> None:
    """Make a static site of certificates.

    Each *.ucmcert in the folder CERTIFICATES is verified; the site shows those that stand, and lists the others with the
    reasons. It needs no server: open index.html in it.
    """
    need("certificates", "publishing")
    if not certificates.is_dir():
        raise WrongUse(f"there is no folder '{certificates}'; name the one with the certificates")
    keys = [trust, *([auditor] if auditor else [])]
    for place in keys:
        if not place.exists():
            raise WrongUse(f"there are no keys at '{place}'; name a public key (PEM), or a folder of them")
    if url and not _URL.fullmatch(url):
        raise WrongUse(f"'{one_line(url, 80)}' is no address of a site; write it as https://example.org/ucm/")
    options = [*(["--auditor", str(auditor.absolute())] if auditor else []), *(["--suite", suite] if suite else [])]
    known = Memory()
    if remember is not None:
        known = Memory.read(remember, circumstances(keys, [suite or ""]))
    console = Output()
    verifier = Verifier(verifying_command(trust, *options), seconds, memory)
    with OutFolder(out, FILES) as folder, ends_like_interrupts():
        with console.status("") as status:
            stand, fall, archives = collect(
                certificates,
                verifier,
                known,
                max(1, len(os.sched_getaffinity(0))),
                lambda done, of: status.update(f"{done} of {of} verified"),
            )
        site = site_of(stand, fall, load_requirements())
        verdicts = _verdicts(site) if results is not None else []
        if remember is not None:
            known.write(remember)
        try:
            files: dict[str, bytes | Copy] = {one.archive: Copy(archives[one.digest], one.digest) for one in stand}
            files |= site_files(site, load_requirements(), url and url.rstrip("/") + "/")
            folder.save(files, FILES)
        except OSError as error:
            raise WrongUse(f"the site cannot be written to '{out}': {error.strerror}; choose another --out") from None
    if results is not None:
        for verdict in verdicts:
            keep(verdict, results)
        write_pages(results)
    for fallen in fall[:SHOWN]:
        reasons = "; ".join(f"{p.check}: {one_line(p.detail, 300)}" for p in fallen.problems[:3])
        console.say(f"{fallen.file} does not stand: {reasons}")
    if len(fall) > SHOWN:
        console.say(f"and {len(fall) - SHOWN} more, which the site lists")
    console.say(f"{len(stand)} of {len(stand) + len(fall)} certificates stand; {out / 'index.html'} shows them")
    leave(console, CONFORMANT)


def _verdicts(site: Site) -> list[PublishedResult]:
    """What the certificates in the matrix say that were judged by their own rules. Raises ``WrongUse`` if different keys signed
    for one product and version: a folder of results has one place for them.
    """
    found: dict[tuple[str, str], Certificate] = {}
    for one in (cell for row in site.versions.rows for cell in row.held if not cell.is_delta):
        other = found.setdefault((one.result.folder, one.profile), one)
        if other is not one:
            keys = " and ".join(one_line(", ".join(signed.signers), 80) for signed in (other, one))
            raise WrongUse(
                f"{keys} signed certificates of {one.name}, profile {one.profile}; for --results trust one of them"
            )
    return [one.result for one in found.values()]
