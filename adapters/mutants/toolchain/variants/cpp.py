"""Tool chains whose C++ uses freedoms of clause 13: other forms, more than is asked, other files. Nothing may fail them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.mutants.toolchain.registry import named, variant
from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, Edits, Files, edited, rewriting, sentence
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE


@dataclass(frozen=True)
class Freedom:
    """``edits`` are made in everything that is generated; ``declares`` is what a vendor may claim then."""

    edits: Edits
    tasks: Sequence[str] = BOTH
    declares: tuple[str, ...] = ()


_SHARED = r"::(?:std|ucm)::shared_ptr< \S+ >"

FREEDOMS: Mapping[str, Freedom] = {
    "enumerations_with_scope": Freedom({r"enum (\w+) :": r"enum class \1 :"}, ("cpp11",), ("cpp-enum=enum-class",)),
    "enumerations_of_32_bits": Freedom(
        {r"enum (\w+) : u\w+": r"enum \1 : uint32_t", r"(safe_enum< \w+_def), u\w+ >": r"\1, uint32_t >"}
    ),
    "bytes_with_sign": Freedom({r"typedef uint8_t byte_t;": "typedef int8_t byte_t;"}),
    "interfaces_by_constant_reference": Freedom(
        {rf"(\(|, )({_SHARED}) (\w+)(?=[,)])": r"\1const \2& \3"},
        declares=("cpp-interface-parameters=const-reference",),
    ),
    "bare_names_of_interfaces": Freedom({r"class (Abstract_(\w+));": r"class \1;\ntypedef \1 \2;"}),
    "helpers_besides": Freedom(
        {
            r"(    virtual ~Abstract_\w+\(\) \{\}\n)": r'\1    static const char* helper_name() { return ""; }\n    virtual bool helper_is_there() { return true; }\n',
            r"(    bool operator==\()": r"    void helper_reset() {}\n\1",
        }
    ),
    "ancestors_not_virtual": Freedom({r"public virtual ": "public "}),
    "connections_in_the_class": Freedom(
        {r"((?:typedef ::ucm::PortConnection<[^\n]*\n)+)(class Abstract_\w+ \{\n  public:\n)": r"\2\1"}
    ),
    "connections_in_another_order": Freedom(
        {r"on_startup\((const \w+& \w+), (const \w+& \w+)\)": r"on_startup(\2, \1)"}
    ),
    "enumerations_by_constant_reference": Freedom(
        {r"void (level|chosen)\((::interfaces::level_t) (?=value|given)": r"void \1(const \2& "}
    ),
    "mutators_by_value": Freedom({r"virtual void remark\(const (::interfaces::text_t)&": r"virtual void remark(\1"}),
    "mutators_by_moving_besides": Freedom(
        {
            r"(    virtual void remark\(const (::interfaces::text_t)& value\) = 0;\n)": r"\1    void remark(\2&& value) { remark(static_cast<const \2&>(value)); }\n"
        },
        ("cpp11",),
    ),
    "overloads_of_operations": Freedom(
        {
            r"(    virtual ::interfaces::(text_t) textual\([^\n]*\n)": r"\1    ::interfaces::\2 textual(const char* given) { return textual(::interfaces::\2(given)); }\n",
            r"(    virtual ::interfaces::record_t structured\([^\n]*\n)": r"\1    template <class T> int structured(const T*, int&, int) { return 0; }\n",
        }
    ),
    "overloads_of_startup": Freedom(
        {
            r"(    virtual void on_startup\((const left_out_Connection&) left_out, [^\n]*\n)": r"\1    void on_startup(\2) {}\n    void on_startup(const char*, int) {}\n",
            r"(    virtual void on_startup\((const Watch_clock_api_Connection&) [^\n]*\n)": r"\1    static void on_startup(\2, int) {}\n",
        }
    ),
    "accessors_for_constants": Freedom(
        {r"(virtual \S+ (?:name|age|serial|level|weight|remark)\(\)) = 0": r"\1 const = 0"}
    ),
    "functions_defined_by_a_sister": Freedom(
        {
            r"class Abstract_unrelated \{\n  public:\n": (
                "struct Identified {\n    virtual ~Identified() {}\n    virtual int identity() = 0;\n};\n"
                "struct Numbered : virtual Identified {\n    virtual int identity() { return 1; }\n};\n"
                "class Abstract_unrelated : public virtual Identified, public Numbered {\n  public:\n"
            )
        }
    ),
    "sizes_without_sign": Freedom(
        {r"template <class T, ::std::size_t N>": "template <class T, unsigned N>"}, ("cpp03",)
    ),
    "sizes_with_sign": Freedom(
        {r"template <class T, ::std::size_t N>": "template <class T, int N>", r"index >= N": "index >= size_type(N)"},
        ("cpp03",),
    ),
    "elements_are_named_by_typedef": Freedom(
        {
            r"class PortElementObject \{\n  public:\n    virtual ~PortElementObject\(\) \{\}\n\};\n": "class Element {\n  public:\n    virtual ~Element() {}\n};\ntypedef Element PortElementObject;\n"
        }
    ),
    "enumerators_have_synonyms": Freedom({r"circle = 30\n": "circle = 30,\n        round = 30\n"}),
    "elements_are_abstract_by_name": Freedom({r"\bPortElementObject\b": "Abstract_PortElementObject"}),
}


def _framework(files: Files) -> Files:
    """What components need stands in a namespace of the framework."""
    head, _, rest = files[SUPPORT_FILE].rpartition("namespace ucm {")
    moved = rest.replace("}  // namespace ucm", "} }").replace(" shared_ptr<", " ::ucm::shared_ptr<")
    moved = moved.replace("(::std::string name, shared_ptr<", "(::std::string name, ::ucm::shared_ptr<")
    named = {name: re.sub(r"::ucm::Port", "::framework::detail::Port", text) for name, text in files.items()}
    return {**named, SUPPORT_FILE: f"{head}namespace framework {{ namespace detail {{{moved}"}


def _one_file(files: Files) -> Files:
    """Everything stands in one header."""
    included = f'#include "{SUPPORT_FILE}"\n'
    return {name: text.replace(included, files[SUPPORT_FILE]) for name, text in files.items() if name != SUPPORT_FILE}


def _many_files(files: Files) -> Files:
    """Headers stand in folders and include each other."""
    made = {}
    for name, text in files.items():
        inner = f"detail/{name}"
        if name.endswith(".hpp"):
            made[inner] = text.replace('#include "', '#include "detail/')
            made[name] = f'#pragma once\n#include "{inner}"\n'
        else:
            made[name] = text
    return made


_CONNECTION = re.compile(r"typedef (::ucm::PortConnection< (\S+) >) (\w+);")


def _connections_derived(files: Files) -> Files:
    """Connection types derive from instances of the template."""

    def defined(match: re.Match[str]) -> str:
        instance, interface, name = match.groups()
        shared = "::ucm::shared_ptr" if "class shared_ptr" in files[SUPPORT_FILE] else "::std::shared_ptr"
        made = f"{name}(::std::string name, {shared}< {interface} > given) : {instance}(name, given) {{}}"
        return f"#ifndef HAS_{name}\n#define HAS_{name}\nstruct {name} : {instance} {{\n    {made}\n}};\n#endif"

    return {name: _CONNECTION.sub(defined, text) for name, text in files.items()}


_STRUCTURE = re.compile(r"class (\w+) \{\n  public:\n    \1\(\)([^\n]*) \{\}\n.*?\n  private:\n(.*?)\};\n", re.DOTALL)


_EXCEPTION = re.compile(r"class \w+ : public ::UCM::UserException \{\n.*?\n\};\n", re.DOTALL)
_ACCESSOR = re.compile(r"    [^\n]*\{ (?:return stored_|stored_)[^\n]*\n")


def _plain_members(files: Files) -> Files:
    """Fields of structures, unions and exceptions are members."""

    def structure(match: re.Match[str]) -> str:
        name, initial, stored = (match[i].replace("stored_selector", "_d").replace("stored_", "") for i in (1, 2, 3))
        return f"struct {name} {{\n    {name}(){initial} {{}}\n{stored}}};\n"

    def exception(match: re.Match[str]) -> str:
        return _ACCESSOR.sub("", match[0]).replace("  private:\n", "").replace("stored_", "")

    return {name: _EXCEPTION.sub(exception, _STRUCTURE.sub(structure, text)) for name, text in files.items()}


_DEFINED = re.compile(r"extern const ([^;=]*) = ([^;]*);\n")


def _floating_constants_in_headers(files: Files) -> Files:
    """Headers define constants of floating point types, and no source file is needed."""
    made = {name: text for name, text in files.items() if not name.endswith(".cpp")}
    for source in files.keys() - made.keys():
        for declaration, value in _DEFINED.findall(files[source]):
            declared = f"extern const {declaration};"
            made = {n: text.replace(declared, f"const {declaration} = {value};") for n, text in made.items()}
    return made


_BOUNDED = """
#include <stdexcept>
namespace ucm {
template <class T, ::std::size_t N>
class bounded_vector {
  public:
    typedef T value_type;
    bool operator==(const bounded_vector& other) const { return all_ == other.all_; }
    ::std::size_t size() const { return all_.size(); }
    void push_back(const T& value) {
        if (all_.size() == N) {
            throw ::std::length_error("bounded_vector");
        }
        all_.push_back(value);
    }

  private:
    ::std::vector<T> all_;
};
}  // namespace ucm

#endif
"""


def _bounded_vectors(files: Files) -> Files:
    """Bounded sequences hold any number of elements up to their bound."""
    made = {
        n: re.sub(r"::(?:std|ucm)::array(< [^<>]* > lengths_t)", r"::ucm::bounded_vector\1", t)
        for n, t in files.items()
    }
    return {**made, SUPPORT_FILE: made[SUPPORT_FILE].replace("\n#endif\n", _BOUNDED)}


REWRITTEN: Mapping[str, tuple[Callable[[Files], Files], tuple[str, ...]]] = {
    "framework_namespace": (_framework, ()),
    "one_file": (_one_file, ()),
    "many_files": (_many_files, ()),
    "connections_derived": (_connections_derived, ()),
    "plain_members": (_plain_members, ("cpp-struct=plain",)),
    "bounded_vectors": (_bounded_vectors, ()),
}

for _says, _freedom in FREEDOMS.items():
    for _task in _freedom.tasks:
        _derive = named(edited(_task, _freedom.edits), f"{_says}_{_task}", sentence(_says))
        variant(task=_task, declares=_freedom.declares)(_derive)


for _says, (_rewrite, _declares) in REWRITTEN.items():
    for _task in BOTH:
        variant(task=_task, declares=_declares)(named(rewriting(_rewrite, _task), f"{_says}_{_task}", _rewrite.__doc__))

_derive = rewriting(_floating_constants_in_headers, "cpp03")
variant(task="cpp03", declares=("cpp03-float-constants=header",))(
    named(_derive, "floating_constants_in_headers_cpp03", _derive.__doc__)
)
