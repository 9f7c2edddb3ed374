"""libclang finds declarations as user code does, wherever headers declare them, and headers cannot deceive it."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from mapping_subjects import expectations, model

from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.toolchains.cpp.compiling import Compiler, Headers
from ucm_cts.harness.toolchains.cpp.listing import LISTED, Listed, listed

pytestmark = pytest.mark.native

CLASS = r"(class Abstract_\w+ (?::[^{]*)?\{.*?\n\};)"
FORWARD = r"\n(class Abstract_\w+;)"
ROOTS = "".join(f"using ::framework::{name}Exception; " for name in ("", "User", "System"))
CONNECTIONS = r"((?:typedef ::ucm::PortConnection<[^\n]*\n)+)(class Abstract_(\w+)) \{"

LEGAL = {
    "inline namespace": ("interfaces", ((CLASS, r"inline namespace v1 {\n\1\n}"), (FORWARD, r"\ninline namespace v1 { \1 }"))),
    "linkage": ("interfaces", ((CLASS, r'extern "C++" {\n\1\n}'),)),
    "using-declarations": (
        "interfaces",
        ((CLASS, r"namespace made {\n\1\n}"), (r"\nclass (Abstract_\w+);", r"\nnamespace made { class \1; }\nusing made::\1;")),
    ),
    "alias of the namespace": (
        "interfaces",
        ((r"namespace UCM \{", "namespace ucm {"), (r"(\}  // namespace UCM\n)", r"\1namespace UCM = ucm;\n")),
    ),
    "roots elsewhere": (
        "interfaces",
        (
            (r"namespace UCM \{", "namespace framework {"),
            (r"(\}  // namespace UCM\n)", rf"\1namespace UCM {{ {ROOTS}}}\n"),
        ),
    ),
    "connections in a base class": ("bindings", ((CONNECTIONS, r"struct With_\3 {\n\1};\n\2 : public With_\3 {"),)),
    "connections around": (
        "bindings",
        ((CONNECTIONS, r"}\n\1namespace filters {\n\2 {"),),
    ),
}  # fmt: skip

EXPONENTIAL = """
template <int N, int M> struct exponential { enum { v = exponential<N - 1, M>::v + exponential<N - 1, M + (1 << N)>::v }; };
template <int M> struct exponential<0, M> { enum { v = M }; };
enum { exploded = exponential<28, 0>::v };
"""


def look(folder: Path, name: str, *edits: tuple[str, str], seconds: float = 60.0) -> Listed:
    """What is listed for the C++11 of a model after ``edits``, each of which must change something."""
    files = dict(reference().generators["cpp11"](model(name)))
    for pattern, becomes in edits:
        edited = {n: re.sub(pattern, becomes, text, flags=re.DOTALL) for n, text in files.items()}
        assert edited != files, pattern
        files = edited
    for file, text in files.items():
        (folder / file).write_text(text)
    headers = Headers(folder, tuple(n for n in sorted(files) if n.endswith(".hpp")))
    return listed(expectations(name), headers, Compiler(seconds=seconds))


@pytest.mark.parametrize("way", LEGAL)
def test_other_forms_of_declarations_are_found(tmp_path: Path, way: str) -> None:
    name, edits = LEGAL[way]
    differences, counted, unjudged = look(tmp_path, name, *edits)
    assert ([str(d) for d in differences], unjudged) == ([], {})
    assert counted == Counter(e.requirement for e in expectations(name).expected if isinstance(e.claim, LISTED))


def test_code_hidden_from_clang_is_found(tmp_path: Path) -> None:
    hidden = "namespace CORBA { class Object {}; }\n#ifdef __clang__\n#define BASE\n#else\n#define BASE : ::CORBA::Object\n#endif\n"
    edits = (
        (r"(#define UCM_SUPPORT_HPP\n)", rf"\1{hidden}"),
        (r"class Abstract_root \{", "class Abstract_root BASE {"),
    )
    differences, _, _ = look(tmp_path, "interfaces", *edits)
    assert {d.requirement for d in differences} == {"R-13-03"}
    assert {d.observed for d in differences} == {"it derives from ::CORBA::Object"}


def test_undeclared_classes_are_not_judged(tmp_path: Path) -> None:
    differences, _, unjudged = look(tmp_path, "interfaces", (r"Abstract_root\b", "Abstract_stem"))
    assert differences == []
    assert "Abstract_root" in unjudged["R-13.6-04"]


def test_headers_that_libclang_cannot_parse_are_not_judged(tmp_path: Path) -> None:
    look(tmp_path, "modules")  # after which it is known where the system's headers are
    differences, counted, unjudged = look(tmp_path, "modules", (r"#endif\n$", f"{EXPONENTIAL}#endif\n"), seconds=0.5)
    assert (differences, counted) == ([], {})
    assert unjudged["R-13.6-04"] == "libclang does not come to an end with the headers: no end after 0.5 s"
