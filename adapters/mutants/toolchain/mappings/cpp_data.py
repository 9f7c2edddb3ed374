"""Tool chains that generate wrong C++ of modules, data types and constants, one thing each."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.mutants.toolchain.rewriting import CPP03, CPP11, Edits, Wrong, register


def _typedef(name: str, was: str, now: str) -> Edits:
    return {rf"typedef {was} {name};": f"typedef {now} {name};"}


_ARRAY = r"::(?:std|ucm)::array<"


MODULES: Mapping[str, Wrong] = {
    "module_without_content_forgotten": Wrong("R-13.3-01", {r"namespace application \{ namespace empty \{ \}\}\n": ""})
}
register("modules", MODULES)

INTERFACES: Mapping[str, Wrong] = {
    "exception_somewhere_else": Wrong("R-13.3-02", {r"class nothing_left : .*?\n\};": r"namespace errors {\n\g<0>\n}"}),
    "enumeration_is_a_number": Wrong(
        "R-13.2.3-01",
        {r"enum level_t : uint32_t \{.*?\};": "typedef uint32_t level_t;\nenum { low, high };"},
        also="R-13.2.3-02 R-13.2.3-03 R-13.2.3-04 R-13.6-03 R-13.2.7-02 R-13-04",
        tasks=CPP11,
    ),
    "enumeration_is_not_safe": Wrong(
        "R-13.10.2-03",
        {r"typedef ::ucm::safe_enum< level_t_def, uint32_t > level_t": "typedef level_t_def::type level_t"},
        also="R-13.10.2-04 R-13.10.2-05 R-13.10.2-06 R-13.10.2-07 R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11"
        " R-13.10.2-12 R-13.10.2-13 R-13.6-03 R-13.10-01 R-13.2.7-02 R-13.2.1-03",
        tasks=CPP03,
    ),
    "enumerators_out_of_reach": Wrong(
        "R-13.10.2-05",
        {r"class safe_enum : public def": "class safe_enum : protected def"},
        also="R-13.10.2-06 R-13.10.2-07 R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11 R-13.10.2-12"
        " R-13.10.2-13 R-13.6-03 R-13.10-01 R-13.2.7-02 R-13.2.1-03",
        tasks=CPP03,
    ),
    "enumerators_must_be_cast": Wrong(
        "R-13.10.2-06",
        {r"    safe_enum\(type v\)": "    explicit safe_enum(type v)"},
        also="R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11 R-13.10.2-12 R-13.10.2-13 R-13.10-01 R-13.2.7-02",
        tasks=CPP03,
    ),
}
register("interfaces", INTERFACES)
CONSTANTS: Mapping[str, Wrong] = {
    "constant_is_a_variable": Wrong(
        "R-13.2.7-01", {r"(?:constexpr|const) (::constants::boolean_t enabled)": r"static \1"}
    ),
    "constant_with_another_value": Wrong("R-13.2.7-02", {r"capacity = 64": "capacity = 65"}),
    "constant_of_another_type": Wrong("R-13.2.7-02", {r"::constants::short_t coldest": "int32_t coldest"}),
    "enumeration_with_scope_in_spite_of_the_claim": Wrong(
        "R-13.2.3-01", {r"enum (\w+) :": r"enum class \1 :"}, tasks=CPP11, declares=("cpp-enum=enum",)
    ),
}
register("constants", CONSTANTS)
DATA_TYPES: Mapping[str, Wrong] = {
    "byte_is_16_bits": Wrong("R-13.1-01", _typedef("byte_t", "uint8_t", "uint16_t")),
    "short_is_32_bits": Wrong("R-13.1-02", _typedef("short_t", "int16_t", "int32_t")),
    "long_is_64_bits": Wrong("R-13.1-03", _typedef("long_t", "int32_t", "int64_t")),
    "longlong_has_no_sign": Wrong("R-13.1-04", _typedef("longlong_t", "int64_t", "uint64_t")),
    "ubyte_has_a_sign": Wrong("R-13.1-05", _typedef("ubyte_t", "uint8_t", "int8_t")),
    "ushort_has_a_sign": Wrong("R-13.1-06", _typedef("ushort_t", "uint16_t", "int16_t")),
    "ulong_has_a_sign": Wrong("R-13.1-07", _typedef("ulong_t", "uint32_t", "int32_t")),
    "ulonglong_has_a_sign": Wrong("R-13.1-08", _typedef("ulonglong_t", "uint64_t", "int64_t")),
    "float_is_double": Wrong("R-13.1-09", _typedef("float_t", "float", "double")),
    "double_is_float": Wrong("R-13.1-10", _typedef("double_t", "double", "float")),
    "char_has_a_sign": Wrong("R-13.1-11", _typedef("char_t", "char", "signed char")),
    "wchar_is_a_number": Wrong("R-13.1-12", _typedef("wide_char_t", "wchar_t", "uint32_t")),
    "boolean_is_a_number": Wrong("R-13.1-13", _typedef("boolean_t", "bool", "uint8_t")),
    "type_renamed": Wrong(
        "R-13.2-01",
        {r"uint64_t ulonglong_t;": "uint64_t ulonglong;"},
        also="R-13-04 R-13.10-01 R-13.2.1-03 R-13.2.7-01 R-13.2.7-02 R-13.5-02 R-13.5-03 R-13.6.1-02 R-13.7-13",
    ),
    "alias_of_another_type": Wrong(
        "R-13.2-02", {r"typedef ::data_types::long_t distance_t": "typedef int16_t distance_t"}
    ),
    "structure_is_an_enum": Wrong(
        "R-13.2.1-01",
        {r"class segment_t \{.*?\n\};": "enum segment_t { segment_begin, segment_end };"},
        also="R-13.2.1-03",
    ),
    "structure_not_copied": Wrong(
        "R-13.2.1-02",
        {
            r"class segment_t \{\n  public:\n": "class segment_t {\n    segment_t(const segment_t&);\n    segment_t& operator=(const segment_t&);\n\n  public:\n"
        },
    ),
    "field_cannot_be_written": Wrong("R-13.2.1-03", {r"    void y\(::data_types::double_t value\)[^\n]*\n": ""}),
    "field_kept_in_another": Wrong(
        "R-13.2.1-03",
        {r"void y\(::data_types::double_t value\) \{ stored_y": "void y(::data_types::double_t value) { stored_x"},
    ),
    "field_of_another_type": Wrong("R-13.2.1-03", {r"::data_types::double_t&? y\(\)": "float y()"}),
    "union_is_an_enum": Wrong(
        "R-13.2.2-01", {r"class figure_t \{.*?\n\};": "enum figure_t { figure_side };"}, also="R-13.2.2-03 R-13.2.2-04"
    ),
    "union_not_copied": Wrong(
        "R-13.2.2-02",
        {
            r"class figure_t \{\n  public:\n": "class figure_t {\n    figure_t(const figure_t&);\n    figure_t& operator=(const figure_t&);\n\n  public:\n"
        },
    ),
    "case_cannot_be_written": Wrong("R-13.2.2-03", {r"    void side\([^\n]*\n": ""}),
    "case_not_selected": Wrong("R-13.2.2-04", {r"stored_selector = ::data_types::shape_t::square; ": ""}),
    "array_is_a_vector": Wrong(
        "R-13.2.4-01",
        {rf"typedef {_ARRAY} ::data_types::long_t, 3 > corners_t": "typedef ::std::vector<int> corners_t"},
        also="R-13.2.4-02",
        tasks=CPP11,
    ),
    "array_of_another_type": Wrong(
        "R-13.2.4-01", {r"(array< ::data_types::)long_t(, 3 > corners_t)": r"\1double_t\2"}, tasks=CPP11
    ),
    "ucm_array_of_another_type": Wrong(
        "R-13.10.1-01", {r"(array< ::data_types::)long_t(, 3 > corners_t)": r"\1double_t\2"}, tasks=CPP03
    ),
    "dimensions_out_of_order": Wrong("R-13.2.4-02", {r"3 >, 2 > grid_t": "2 >, 3 > grid_t"}),
    "bounded_sequence_too_long": Wrong("R-13.2.5-01", {r"4 > lengths_t": "5 > lengths_t"}),
    "bounded_sequence_without_bound": Wrong(
        "R-13.2.5-01", {rf"{_ARRAY} (::data_types::double_t), 4 > lengths_t": r"::std::vector< \1 > lengths_t"}
    ),
    "sequence_of_another_type": Wrong(
        "R-13.2.5-02", {r"vector< ::data_types::point_t > path_t": "vector< double > path_t"}
    ),
    "string_is_an_array_of_char": Wrong("R-13.2.6-01", _typedef("label_t", "::std::string", "const char*")),
    "wide_string_is_narrow": Wrong(
        "R-13.2.6-02",
        _typedef("wide_text_t", "::std::wstring", "::std::string"),
        also="R-13.2.1-03 R-13.2.2-03 R-13.2.2-04 R-13.4-07 R-13.6-03 R-13.7-02 R-13.9-01 R-13.9-04",
    ),
    "enumerator_renamed": Wrong("R-13.2.3-02", {r"\bsquare\b": "quadrat"}, also="R-13.2.3-03 R-13.2.2-04", tasks=CPP11),
    "enumerator_with_another_value": Wrong("R-13.2.3-03", {r"square = 20": "square = 21"}, tasks=CPP11),
    "enumeration_stored_otherwise": Wrong(
        "R-13.2.3-04", {r"enum shape_t : uint16_t": "enum shape_t : uint64_t"}, tasks=CPP11
    ),
    "definition_renamed": Wrong(
        "R-13.10.2-01",
        {r"shape_t_def\b": "shape_t_definition"},
        also="R-13.10.2-02 R-13.10.2-03 R-13.10.2-04 R-13.10.2-05",
        tasks=CPP03,
    ),
    "safe_enumerator_with_another_value": Wrong("R-13.10.2-02", {r"circle = 30": "circle = 31"}, tasks=CPP03),
    "safe_enumeration_stored_otherwise": Wrong(
        "R-13.10.2-04", {r"shape_t_def, uint16_t >": "shape_t_def, uint64_t >"}, tasks=CPP03
    ),
    "underlying_forgets_the_value": Wrong(
        "R-13.10.2-07",
        {r"underlying\(\) const \{ return val; \}": "underlying() const { return inner(); }"},
        tasks=CPP03,
    ),
}
register("data_types", DATA_TYPES)

_COMPARISONS = {
    "equal_is_always": ("R-13.10.2-08", "==", "return val == s.val || true"),
    "unequal_is_equal": ("R-13.10.2-09", "!=", "return val == s.val"),
    "less_is_less_or_equal": ("R-13.10.2-10", "<", "return val <= s.val"),
    "less_or_equal_is_less": ("R-13.10.2-11", "<=", "return val < s.val"),
    "greater_is_greater_or_equal": ("R-13.10.2-12", ">", "return val >= s.val"),
    "greater_or_equal_is_greater": ("R-13.10.2-13", ">=", "return val > s.val"),
}
register(
    "data_types",
    {
        name: Wrong(
            requirement,
            {rf"(operator{operator}\(const safe_enum& s\) const \{{ )return [^;]*": rf"\1{body}"},
            tasks=CPP03,
        )
        for name, (requirement, operator, body) in _COMPARISONS.items()
    },
)
