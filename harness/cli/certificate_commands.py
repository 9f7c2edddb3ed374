"""``ucm-cts key``, ``certify``, ``verify``, ``commit`` and ``challenge``: certificates (docs/certificates.md).

The libraries that sign are an extra: modules that need them are imported when a command runs.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from pathlib import Path

import click

from ucm_cts.harness.cli import options
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.driver import Limits
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse

STANDS_NOT_CONFORMANT = 4
"""The exit status of ``verify`` for a certificate that stands, and does not say that the product is conformant."""

_FILE = click.Path(dir_okay=False, path_type=Path)
_key_option = click.option("--key", required=True, type=_FILE, help="Your private key; 'ucm-cts key NAME' makes one.")
_artifact_option = click.option(
    "--artifact", "artifacts", multiple=True, type=_FILE, help="A file of the product; it is named with its digest."
)


@click.command()
@click.argument("name")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path(),
    show_default="this folder",
    help="The folder for both files.",
)
def key(name: str, out: Path) -> None:
    """Make a pair of keys, to sign certificates.

    NAME.pem signs and is yours alone; NAME.pub is for those who trust you.
    """
    need("certificates", "making keys")
    from ucm_cts.harness.certificates.keys import make_key

    private, public = make_key(name, out)
    console = Output()
    console.say(f"{private} signs: keep it, and show it to nobody. {public} is for those who trust you")
    options.leave(console, options.CONFORMANT)


@click.command()
@options.adapter_argument
@options.profile_option
@_key_option
@_artifact_option
@options.out_file("certificate.ucmcert", "The certificate. A file that is there is never written over.")
@click.option(
    "--report",
    type=options.Folder(file_okay=False, path_type=Path),
    default=Path("ucm-cts-report"),
    show_default=True,
    help="The folder for the report.",
)
@options.ics_option
@options.known_failures_option
@options.toolchain_option
@options.no_sandbox_option
@options.seed_option
@click.option("--challenge", type=_FILE, help="An auditor's challenge, which gives the seed.")
@click.option("--witness", is_flag=True, help="You are the auditor, and --key is yours.")
@options.timeout_option
@options.memory_option
@options.incident_time_option
@options.systematic_option
@options.explore_option
@options.everything_option
@click.pass_context
def certify(
    context: click.Context,
    adapter: str,
    profile: str,
    key: Path,
    artifacts: Sequence[Path],
    out: Path,
    report: Path,
    ics: Path | None,
    known_failures: Path | None,
    toolchain: Path | None,
    no_sandbox: bool,
    seed: int | None,
    challenge: Path | None,
    witness: bool,
    timeout: float,
    memory: int,
    incident_time: float,
    systematic: int,
    explore: options.Budget,
    everything: bool,
) -> None:
    """Test a product, and sign the outcome as a certificate.

    The test is that of 'ucm-cts run'. The certificate holds everything from which 'ucm-cts verify' derives each verdict
    again. A run that is not conformant is certified, too, and the certificate says so; an incomplete one is not. Exit status: that of 'ucm-cts run'.
    """
    need("certificates", "certifying")
    from ucm_cts.harness.cli.certificate_run import CertificateKeeper, Wanted, certify_toolchain_run
    from ucm_cts.harness.cli.framework_run import FrameworkRun, certify_framework
    from ucm_cts.harness.cli.toolchain_command import ToolChainRun

    wanted = Wanted(key, tuple(artifacts), out, challenge, witness)
    if challenge is not None and (seed is not None or witness):
        raise WrongUse("the challenge gives the seed, and is for vendors: leave out --seed and --witness")
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    profile = options.profile_for(context, toolchain, profile)
    if toolchain is not None:
        certify_toolchain_run(
            wanted,
            ToolChainRun(
                toolchain,
                profile,
                "",
                report,
                known_failures,
                ics,
                drawn,
                everything,
                sandbox=not no_sandbox,
                hidden=(key, out),
            ),
        )
    keeper = CertificateKeeper(wanted, profile, systematic)
    certify_framework(
        FrameworkRun(
            adapter=adapter,
            profile=profile,
            expression="",
            seed=keeper.seed if keeper.seed is not None else drawn,
            out=report,
            known_failures=known_failures,
            ics=ics,
            repeat=1,
            in_process=False,
            virtual_time=False,
            jobs=1,  # a record has one host after the other
            sandbox=not no_sandbox,
            limits=Limits(timeout, memory, incident_seconds=incident_time),
            systematic=systematic,
            explore=explore,
            everything=everything,
            failed_first=False,
            resume=False,
            is_seeded=True,
            hidden=(key, out),
        ),
        keeper,
    )


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--trust",
    type=click.Path(path_type=Path),
    help="The public keys that you rely on: a folder or a file. Needed: a certificate cannot vouch for its own keys.",
)
@click.option("--auditor", type=click.Path(path_type=Path), help="The public keys of auditors that you rely on.")
@click.option(
    "--suite",
    type=click.Choice(("same", "newer")),
    default="same",
    show_default=True,
    help="newer: judge a certificate of another suite by the rules of this one, and say what would change.",
)
@click.option("--json", "as_json", is_flag=True, help="Print what was found out as JSON.")
@click.option("--all", "everything", is_flag=True, help="Print every list whole.")
def verify(file: Path, trust: Path | None, auditor: Path | None, suite: str, as_json: bool, everything: bool) -> None:
    """Check a certificate, and derive its verdicts again.

    It needs neither network nor product. All problems are told at once. Exit status: 0 it stands and says conformant, 1 it
    does not stand, 4 it stands and says something else than conformant, 2 wrong use, 3 UCM-CTS itself failed.
    """
    need("certificates", "verifying")
    from ucm_cts.harness.certificates.judging import judged_again
    from ucm_cts.harness.certificates.keys import NOBODY, trust_in
    from ucm_cts.harness.certificates.reading import content_of
    from ucm_cts.harness.certificates.telling import safe, told
    from ucm_cts.harness.certificates.verified import encoded
    from ucm_cts.harness.certificates.verifying import Verifier

    if trust is None and auditor is None:
        raise WrongUse(
            "whose keys do you trust? Give the public keys with --trust; a certificate cannot vouch for its own keys"
        )
    auditors = trust_in(auditor) if auditor is not None else NOBODY
    trusted = trust_in(trust) if trust is not None else NOBODY
    verified = Verifier(trusted, judged_again, auditors, "newer" if suite == "newer" else "same").verify(
        content_of(file)
    )
    console = Output()
    if as_json:
        console.out(encoded(verified).decode(), end="", highlight=False)
    else:
        for line in safe(told(verified, str(file), everything)):
            console.say(line)
    if not verified.stands:
        options.leave(console, options.NOT_CONFORMANT)
    is_good = verified.verdict == "conformant" and not verified.is_delta
    options.leave(console, options.CONFORMANT if is_good else STANDS_NOT_CONFORMANT)


@click.command()
@options.adapter_argument
@options.profile_option
@_key_option
@_artifact_option
@options.ics_option
@options.known_failures_option
@options.toolchain_option
@options.no_sandbox_option
@options.systematic_option
@options.out_file("commitment.json", "The commitment, for the auditor.")
@click.pass_context
def commit(
    context: click.Context,
    adapter: str,
    profile: str,
    key: Path,
    artifacts: Sequence[Path],
    ics: Path | None,
    known_failures: Path | None,
    toolchain: Path | None,
    no_sandbox: bool,
    systematic: int,
    out: Path,
) -> None:
    """Commit to a product before the seed is known.

    The commitment names its files, statement and profile. An auditor answers with 'ucm-cts challenge', and 'ucm-cts certify
    --challenge' runs with the seed that follows from both.
    """
    need("certificates", "committing")
    from ucm_cts.harness.certificates.challenges import committed
    from ucm_cts.harness.certificates.keys import signer_of
    from ucm_cts.harness.cli.certificate_run import Committing, check_new, write_new

    signer = signer_of(key)
    check_new(out)
    commitment = Committing(
        adapter,
        toolchain,
        options.profile_for(context, toolchain, profile),
        tuple(artifacts),
        ics,
        known_failures,
        systematic,
        sandbox=not no_sandbox,
        hidden=(key, out),
    ).commitment()
    write_new(out, committed(commitment, [signer]))
    console = Output()
    console.say(
        f"{out} commits to {len(commitment.subjects)} files of {options.name_of(commitment)}; give it to the auditor"
    )
    options.leave(console, options.CONFORMANT)


@click.command()
@click.argument("commitment", type=_FILE)
@_key_option
@click.option(
    "--trust",
    type=click.Path(path_type=Path),
    help="The public keys of vendors, a folder or a file: one of them must have signed the commitment.",
)
@options.out_file("challenge.json", "The challenge, for the vendor.")
def challenge(commitment: Path, key: Path, trust: Path | None, out: Path) -> None:
    """Answer a vendor's commitment, as an auditor.

    The challenge has a random number that decides the seed. The ledger beside the key counts the challenges for each product:
    a vendor who asks often may be choosing.
    """
    need("certificates", "challenging")
    from ucm_cts.harness.certificates.challenges import challenged, read_small
    from ucm_cts.harness.certificates.keys import NOBODY, signer_of, trust_in
    from ucm_cts.harness.certificates.problems import Unreadable
    from ucm_cts.harness.cli.certificate_run import check_new, write_new

    signer = signer_of(key)
    check_new(out)
    vendors = trust_in(trust) if trust is not None else NOBODY
    try:
        content = read_small(commitment, "a commitment of 'ucm-cts commit'")
        answer, given, signers = challenged(content, signer, key, vendors)
    except Unreadable as wrong:
        raise WrongUse(f"'{commitment}': {wrong}") from None
    write_new(out, answer)
    console = Output()
    console.say(
        f"{out} is challenge number {given.number} for this product, version and profile; give it to the vendor"
    )
    console.say(
        f"the commitment is signed by {', '.join(signers)}"
        if signers
        else "nobody checked who signed the commitment: --trust KEYS, with the vendor's public key, does"
    )
    options.leave(console, options.CONFORMANT)


CERTIFICATE_COMMANDS = (key, certify, verify, commit, challenge)
"""All commands about certificates."""
