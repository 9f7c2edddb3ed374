"""What the C++ guide tells a vendor to do works as printed."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from command_line import blameless, report_of, ucm_cts
from files import ROOT
from pages import (
    FRAMEWORK,
    PACKAGE,
    commands,
    marked,
    shell,
    text_of,
    write_files,
)

pytestmark = pytest.mark.usefixtures("here")


@pytest.fixture
def vendor(here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the C++ guide's files and the headers of the frameworks that it takes for given."""
    if not all(map(shutil.which, ("g++", "ar", "cmake"))) or not (PACKAGE / "include").exists():
        pytest.skip("needs cmake, g++ and the installed package")
    write_files("docs/adapter-cpp.md")
    (here / "acme").mkdir()
    (here / "acme" / "ucm.hpp").write_text("#include <lwucm/runtime.hpp>\nnamespace acme = lwucm;\n")
    (here / "acmeConfig.cmake").write_text("add_library(acme::ucm INTERFACE IMPORTED)\n")
    monkeypatch.setenv("acme_DIR", str(here))
    headers = (here, FRAMEWORK / "include", ROOT / "adapters" / "sdk" / "cpp" / "example")
    monkeypatch.setenv("CPLUS_INCLUDE_PATH", ":".join(map(str, headers)))
    monkeypatch.setenv("LIBRARY_PATH", str(here))
    return here


def test_cpp_guide_with_cmake(vendor: Path) -> None:
    """The project is configured as the guide says; what comes of it when built is for test_cpp_guide.py."""
    (configure,) = commands("cmake -S")
    targets = "cmake --build build --target help"
    shell(configure)
    assert {"acme_adapter", "acme_adapter_host"} <= set(shell(targets).split())
    lists = marked("docs/adapter-cpp.md", "file: CMakeLists.txt").replace("target_link_libraries(acme_adapter ", "# ")
    (vendor / "CMakeLists.txt").write_text(lists.replace("adapter(acme_adapter", "adapter(acme_adapter NO_PYTHON"))
    shell(configure)
    assert {"acme_adapter", "acme_adapter_host"} & set(shell(targets).split()) == {"acme_adapter_host"}


def test_cpp_guide_with_a_plain_compiler(vendor: Path) -> None:
    """Both adapters, one compiler call beside the other."""
    acme, _sanitized = commands("g++ -std")
    beans = acme.replace("acme_adapter.cpp -lacme", "beans_adapter.cpp -o beans")
    sources = f"""printf '#include "%s"\\n' {FRAMEWORK}/src/*/*.cpp > acme.cpp"""  # at once, in a tenth of the time
    framework = f"{sources}; g++ -std=c++11 -I {FRAMEWORK}/src -c acme.cpp; ar rc libacme.a acme.o"
    shell(f"{beans} & {framework}; {acme}; mkdir build; mv a.out build/acme_adapter; wait $!")
    assert "ucm-cts run build/acme_adapter" in commands("ucm-cts run")
    outcome = ucm_cts("run", "build/acme_adapter")
    assert (outcome.status, outcome.err) == (0, "")
    assert "✓ CONFORMANT  Acme UCM 4.2" in outcome.out
    assert ucm_cts("run", "./beans", "--out", "out").status == 1
    lacking = {"R-11.2.1.2-05", "R-11.2.1.3-02", "R-11.2.1.4-02", "R-11.2.2.2-02", "R-12.10-26", "R-11.2.2.2-05"}
    assert lacking <= blameless(report_of(vendor / "out"))


@pytest.mark.native
def test_cpp_guide_step_by_step() -> None:
    (code,) = re.findall(r"(?m)^ +import acme_adapter\n(?: +.*\n)+", text_of("docs/adapter-cpp.md"))
    alias = "import sys, ucm_cts.adapters._reference_cpp as module; sys.modules['acme_adapter'] = module\n"
    check = "\nassert runtime.get_components() == [clock, display]; assert acme_adapter.life_cycles(10) > 0"
    subprocess.run([sys.executable, "-c", alias + textwrap.dedent(code) + check], check=True)


_DEFECTS = {
    "#include <string>\n": "#include <string>\n#include <thread>\n",
    "        running_ = true;\n": """
        std::thread other([this] { ++last_line_; });
        ++last_line_;
        other.join();
        int* const gone = new int(1);
        delete gone;
        running_ = *gone != 2;
""",
}
"""A race and a use of freed memory whenever Beans start."""


@pytest.mark.native
def test_sanitizers_of_the_cpp_guide_tell_what_is_wrong(here: Path) -> None:
    write_files("docs/adapter-cpp.md")
    beans = Path("beans.hpp").read_text()
    for good, bad in _DEFECTS.items():
        assert good in beans
        beans = beans.replace(good, bad, 1)
    Path("beans.hpp").write_text(beans)
    recipe = marked("docs/adapter-cpp.md", "sanitizers")
    recipe = re.sub(r"(?m)^include=.*$", f"include={shlex.quote(str(ROOT / 'adapters/sdk/cpp/include'))}", recipe)
    shell(re.sub(r"(?m)^(    ucm-cts .*)$", r"\1 -k R-11.2.2.1-13 || test $? -eq 1", recipe))
    for kind, text in (
        ("address,undefined", "AddressSanitizer: heap-use-after-free"),
        ("thread", "ThreadSanitizer: data race"),
    ):
        incidents = report_of(here / f"report-{kind}")["incidents"]
        assert any(text in json.dumps(incident) for incident in incidents), kind
