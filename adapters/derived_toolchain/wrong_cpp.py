"""Tool chains that generate wrong C++, one thing each: what the reference generates, with one text replaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.contracts import Constant
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.derived_toolchain.registry import breaks
from ucm_cts.adapters.derived_toolchain.rewriting_cpp import Edit, edited
from ucm_cts.adapters.toolchain.program import Program

BOTH = ("cpp11", "cpp03")
CPP11 = ("cpp11",)
CPP03 = ("cpp03",)

MODELS: dict[str, str] = {}
"""By the mutant's name: a mapping model that shows what is wrong."""


@dataclass(frozen=True)
class Wrong:
    """``model`` shows that ``breaks`` are broken; ``also`` are those that the same defect breaks besides."""

    model: str
    breaks: str
    edits: Sequence[Edit]
    also: str = ""
    tasks: Sequence[str] = BOTH
    declares: tuple[str, ...] = ()


def _typedef(name: str, was: str, now: str) -> list[Edit]:
    return [(rf"typedef {was} {name};", f"typedef {now} {name};")]


_SHARED = r"::(?:std|ucm)::shared_ptr<"
_ARRAY = r"::(?:std|ucm)::array<"
_HERMIT = r"(~Abstract_Hermit_Impl\(\) \{\}\n)"
_LINE = r"([^\n]*\n)"

PRIMITIVES: Mapping[str, Wrong] = {
    "byte_is_16_bits": Wrong("data_types", "R-13.1-01", _typedef("byte_t", "uint8_t", "uint16_t")),
    "short_is_32_bits": Wrong("data_types", "R-13.1-02", _typedef("short_t", "int16_t", "int32_t")),
    "long_is_64_bits": Wrong("data_types", "R-13.1-03", _typedef("long_t", "int32_t", "int64_t")),
    "longlong_has_no_sign": Wrong("data_types", "R-13.1-04", _typedef("longlong_t", "int64_t", "uint64_t")),
    "ubyte_has_a_sign": Wrong("data_types", "R-13.1-05", _typedef("ubyte_t", "uint8_t", "int8_t")),
    "ushort_has_a_sign": Wrong("data_types", "R-13.1-06", _typedef("ushort_t", "uint16_t", "int16_t")),
    "ulong_has_a_sign": Wrong("data_types", "R-13.1-07", _typedef("ulong_t", "uint32_t", "int32_t")),
    "ulonglong_has_a_sign": Wrong("data_types", "R-13.1-08", _typedef("ulonglong_t", "uint64_t", "int64_t")),
    "float_is_double": Wrong("data_types", "R-13.1-09", _typedef("float_t", "float", "double")),
    "double_is_float": Wrong("data_types", "R-13.1-10", _typedef("double_t", "double", "float")),
    "char_has_a_sign": Wrong("data_types", "R-13.1-11", _typedef("char_t", "char", "signed char")),
    "wchar_is_a_number": Wrong("data_types", "R-13.1-12", _typedef("wide_char_t", "wchar_t", "uint32_t")),
    "boolean_is_a_number": Wrong("data_types", "R-13.1-13", _typedef("boolean_t", "bool", "uint8_t")),
}

DATA_TYPES: Mapping[str, Wrong] = {
    "type_renamed": Wrong("data_types", "R-13.2-01", [(r"uint64_t ulonglong_t;", "uint64_t ulonglong;")]),
    "alias_of_another_type": Wrong(
        "data_types", "R-13.2-02", [(r"typedef ::data_types::long_t distance_t", "typedef int16_t distance_t")]
    ),
    "structure_is_an_enum": Wrong(
        "data_types",
        "R-13.2.1-01",
        [(r"class segment_t \{.*?\n\};", "enum segment_t { segment_begin, segment_end };")],
        also="R-13.2.1-03",
    ),
    "structure_not_copied": Wrong(
        "data_types",
        "R-13.2.1-02",
        [
            (
                r"class segment_t \{\n  public:\n",
                "class segment_t {\n    segment_t(const segment_t&);\n    segment_t& operator=(const segment_t&);\n\n  public:\n",
            )
        ],
    ),
    "field_cannot_be_written": Wrong(
        "data_types", "R-13.2.1-03", [(r"    void y\(::data_types::double_t value\)[^\n]*\n", "")]
    ),
    "field_kept_in_another": Wrong(
        "data_types",
        "R-13.2.1-03",
        [(r"void y\(::data_types::double_t value\) \{ stored_y", "void y(::data_types::double_t value) { stored_x")],
    ),
    "field_of_another_type": Wrong(
        "data_types", "R-13.2.1-03", [(r"::data_types::double_t y\(\) const", "float y() const")]
    ),
    "union_is_an_enum": Wrong(
        "data_types",
        "R-13.2.2-01",
        [(r"class figure_t \{.*?\n\};", "enum figure_t { figure_side };")],
        also="R-13.2.2-03 R-13.2.2-04",
    ),
    "union_not_copied": Wrong(
        "data_types",
        "R-13.2.2-02",
        [
            (
                r"class figure_t \{\n  public:\n",
                "class figure_t {\n    figure_t(const figure_t&);\n    figure_t& operator=(const figure_t&);\n\n  public:\n",
            )
        ],
    ),
    "case_cannot_be_written": Wrong("data_types", "R-13.2.2-03", [(r"    void side\([^\n]*\n", "")]),
    "case_not_selected": Wrong(
        "data_types", "R-13.2.2-04", [(r"stored_selector = ::data_types::shape_t::square; ", "")]
    ),
    "array_is_a_vector": Wrong(
        "data_types",
        "R-13.2.4-01",
        [(rf"typedef {_ARRAY} ::data_types::long_t, 3 > corners_t", "typedef ::std::vector<int> corners_t")],
        also="R-13.2.4-02",
        tasks=CPP11,
    ),
    "array_of_another_type": Wrong(
        "data_types",
        "R-13.2.4-01",
        [(r"(array< ::data_types::)long_t(, 3 > corners_t)", r"\1double_t\2")],
        tasks=CPP11,
    ),
    "ucm_array_of_another_type": Wrong(
        "data_types",
        "R-13.10.1-01",
        [(r"(array< ::data_types::)long_t(, 3 > corners_t)", r"\1double_t\2")],
        tasks=CPP03,
    ),
    "dimensions_out_of_order": Wrong("data_types", "R-13.2.4-02", [(r"3 >, 2 > grid_t", "2 >, 3 > grid_t")]),
    "bounded_sequence_too_long": Wrong("data_types", "R-13.2.5-01", [(r"4 > lengths_t", "5 > lengths_t")]),
    "bounded_sequence_without_bound": Wrong(
        "data_types",
        "R-13.2.5-01",
        [(rf"{_ARRAY} (::data_types::double_t), 4 > lengths_t", r"::std::vector< \1 > lengths_t")],
    ),
    "sequence_of_another_type": Wrong(
        "data_types", "R-13.2.5-02", [(r"vector< ::data_types::point_t > path_t", "vector< double > path_t")]
    ),
    "string_is_an_array_of_char": Wrong(
        "data_types", "R-13.2.6-01", _typedef("label_t", "::std::string", "const char*")
    ),
    "wide_string_is_narrow": Wrong(
        "data_types", "R-13.2.6-02", _typedef("wide_text_t", "::std::wstring", "::std::string")
    ),
    "constant_is_a_variable": Wrong(
        "constants", "R-13.2.7-01", [(r"(?:constexpr|const) (::constants::boolean_t enabled)", r"static \1")]
    ),
    "constant_with_another_value": Wrong("constants", "R-13.2.7-02", [(r"capacity = 64", "capacity = 65")]),
    "constant_of_another_type": Wrong(
        "constants", "R-13.2.7-02", [(r"::constants::short_t coldest", "int32_t coldest")]
    ),
    "module_without_content_forgotten": Wrong(
        "modules", "R-13.3-01", [(r"namespace application \{ namespace empty \{ \}\}\n", "")]
    ),
    "exception_somewhere_else": Wrong(
        "interfaces", "R-13.3-02", [(r"class nothing_left : .*?\n\};", r"namespace errors {\n\g<0>\n}")]
    ),
}

ENUMERATIONS: Mapping[str, Wrong] = {
    "enumeration_is_a_number": Wrong(
        "interfaces",
        "R-13.2.3-01",
        [(r"enum level_t : uint32_t \{.*?\};", "typedef uint32_t level_t;\nenum { low, high };")],
        also="R-13.2.3-02 R-13.2.3-03 R-13.2.3-04 R-13.6-03",
        tasks=CPP11,
    ),
    "enumeration_with_scope_in_spite_of_the_claim": Wrong(
        "constants",
        "R-13.2.3-01",
        [(r"enum (\w+) :", r"enum class \1 :")],
        tasks=CPP11,
        declares=("cpp-enum=enum",),
    ),
    "enumerator_renamed": Wrong(
        "data_types",
        "R-13.2.3-02",
        [(r"\bsquare\b", "quadrat")],
        also="R-13.2.3-03 R-13.2.2-04",
        tasks=CPP11,
    ),
    "enumerator_with_another_value": Wrong("data_types", "R-13.2.3-03", [(r"square = 20", "square = 21")], tasks=CPP11),
    "enumeration_stored_otherwise": Wrong(
        "data_types", "R-13.2.3-04", [(r"enum shape_t : uint16_t", "enum shape_t : uint64_t")], tasks=CPP11
    ),
    "definition_renamed": Wrong(
        "data_types",
        "R-13.10.2-01",
        [(r"shape_t_def\b", "shape_t_definition")],
        also="R-13.10.2-02 R-13.10.2-03 R-13.10.2-05",
        tasks=CPP03,
    ),
    "safe_enumerator_with_another_value": Wrong(
        "data_types", "R-13.10.2-02", [(r"circle = 30", "circle = 31")], tasks=CPP03
    ),
    "enumeration_is_not_safe": Wrong(
        "interfaces",
        "R-13.10.2-03",
        [(r"typedef ::ucm::safe_enum< level_t_def, uint32_t > level_t", "typedef level_t_def::type level_t")],
        also="R-13.10.2-04 R-13.10.2-05 R-13.10.2-06 R-13.10.2-07 R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11"
        " R-13.10.2-12 R-13.10.2-13 R-13.6-03",
        tasks=CPP03,
    ),
    "safe_enumeration_stored_otherwise": Wrong(
        "data_types", "R-13.10.2-04", [(r"shape_t_def, uint16_t >", "shape_t_def, uint64_t >")], tasks=CPP03
    ),
    "enumerators_out_of_reach": Wrong(
        "interfaces",
        "R-13.10.2-05",
        [(r"class safe_enum : public def", "class safe_enum : protected def")],
        also="R-13.10.2-06 R-13.10.2-07 R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11 R-13.10.2-12"
        " R-13.10.2-13 R-13.6-03",
        tasks=CPP03,
    ),
    "enumerators_must_be_cast": Wrong(
        "interfaces",
        "R-13.10.2-06",
        [(r"    safe_enum\(type v\)", "    explicit safe_enum(type v)")],
        also="R-13.10.2-08 R-13.10.2-09 R-13.10.2-10 R-13.10.2-11 R-13.10.2-12 R-13.10.2-13",
        tasks=CPP03,
    ),
    "underlying_forgets_the_value": Wrong(
        "data_types",
        "R-13.10.2-07",
        [(r"underlying\(\) const \{ return val; \}", "underlying() const { return inner(); }")],
        tasks=CPP03,
    ),
}

_COMPARISONS = {
    "equal_is_always": ("R-13.10.2-08", "==", "return val == s.val || true"),
    "unequal_is_equal": ("R-13.10.2-09", "!=", "return val == s.val"),
    "less_is_less_or_equal": ("R-13.10.2-10", "<", "return val <= s.val"),
    "less_or_equal_is_less": ("R-13.10.2-11", "<=", "return val < s.val"),
    "greater_is_greater_or_equal": ("R-13.10.2-12", ">", "return val >= s.val"),
    "greater_or_equal_is_greater": ("R-13.10.2-13", ">=", "return val > s.val"),
}
COMPARISONS: Mapping[str, Wrong] = {
    name: Wrong(
        "data_types",
        requirement,
        [(rf"(operator{operator}\(const safe_enum& s\) const \{{ )return [^;]*", rf"\1{body}")],
        tasks=CPP03,
    )
    for name, (requirement, operator, body) in _COMPARISONS.items()
}

EXCEPTIONS: Mapping[str, Wrong] = {
    "exception_not_assigned": Wrong(
        "interfaces",
        "R-13.4-01",
        [
            (
                r"nothing_left& operator=\(const nothing_left&\) = default",
                "nothing_left& operator=(const nothing_left&) = delete",
            )
        ],
        tasks=CPP11,
    ),
    "exception_is_not_assigned": Wrong(
        "interfaces",
        "R-13.4-01",
        [(r"(class nothing_left [^\n]*\n)", r"\1    nothing_left& operator=(const nothing_left&);\n")],
        tasks=CPP03,
    ),
    "root_is_concrete": Wrong(
        "interfaces",
        "R-13.4-02",
        [
            (r"virtual void _raise\(\) const = 0;", "virtual void _raise() const {}"),
            (r"virtual const char\* _name\(\) const = 0;", 'virtual const char* _name() const { return ""; }'),
        ],
    ),
    "system_exception_without_root": Wrong(
        "interfaces", "R-13.4-02", [(r"class SystemException : public Exception \{", "class SystemException {")]
    ),
    "exceptions_have_repository_ids": Wrong(
        "interfaces",
        "R-13.4-03",
        [
            (
                r"(    virtual const char\* _name\(\) const = 0;)",
                r'    virtual const char* _rep_id() const { return ""; }\n\1',
            )
        ],
    ),
    "user_exception_is_the_systems": Wrong(
        "interfaces",
        "R-13.4-04",
        [(r"class refused : public ::UCM::UserException", "class refused : public ::UCM::SystemException")],
    ),
    "system_exception_renamed": Wrong(
        "interfaces", "R-13.4-05", [(r"\bSystemException\b", "RuntimeException")], also="R-13.4-02"
    ),
    "exceptions_are_corbas": Wrong(
        "interfaces",
        "R-13.4-06",
        [
            (r"namespace UCM \{\n", "namespace CORBA { class UserException {}; }\nnamespace UCM {\n"),
            (
                r"class UserException : public Exception \{",
                "class UserException : public Exception, public ::CORBA::UserException {",
            ),
        ],
    ),
    "exception_field_forgotten": Wrong("interfaces", "R-13.4-07", [(r"    void code\([^\n]*\n", "")]),
    "exceptions_not_caught": Wrong(
        "interfaces",
        "R-13.4-08",
        [(r"class UserException : public Exception", "class UserException : protected Exception")],
        also="R-13.4-02",
    ),
}

_NAMED = "::interfaces::Abstract_named >"

INTERFACES: Mapping[str, Wrong] = {
    "interfaces_are_corbas": Wrong(
        "interfaces",
        "R-13-03",
        [
            (r"namespace interfaces \{ \}\n", "namespace CORBA { class Object {}; }\nnamespace interfaces { }\n"),
            (r"class Abstract_root \{", "class Abstract_root : public virtual ::CORBA::Object {"),
        ],
    ),
    "accessor_has_a_prefix": Wrong(
        "interfaces", "R-13.5-02", [(r"text_t name\(\) = 0", "text_t get_name() = 0")], also="R-13.6-04"
    ),
    "accessor_returns_a_reference": Wrong(
        "interfaces", "R-13.5-02", [(r"virtual (::interfaces::text_t) name\(\) = 0", r"virtual const \1& name() = 0")]
    ),
    "accessor_is_for_constants": Wrong(
        "interfaces", "R-13.5-02", [(r"text_t name\(\) = 0", "text_t name() const = 0")]
    ),
    "mutator_forgotten": Wrong("interfaces", "R-13.5-03", [(r"    virtual void weight\([^\n]*\n", "")]),
    "mutator_has_a_body": Wrong(
        "interfaces", "R-13.5-04", [(r"(virtual void weight\([^\n]*) = 0;", r"\1 { (void)value; }")]
    ),
    "read_only_is_written": Wrong(
        "interfaces",
        "R-13.5-05",
        [
            (
                r"(    virtual ::interfaces::text_t name\(\) = 0;\n)",
                r"\1    virtual void name(const ::interfaces::text_t&) {}\n",
            )
        ],
    ),
    "interface_is_concrete": Wrong(
        "interfaces", "R-13.6-01", [(r"at_root\(\) = 0;", "at_root() { return 0; }")], also="R-13.6.1-01"
    ),
    "interface_without_prefix": Wrong(
        "ports", "R-13.6-02", [(r"\bAbstract_unrelated\b", "unrelated")], also="R-13.3-02"
    ),
    "interface_cannot_be_implemented": Wrong(
        "interfaces",
        "R-13.6-03",
        [(r"  public:\n(    virtual ~Abstract_primitive_parameters\(\) \{\}\n)", r"  private:\n\1  public:\n")],
    ),
    "operation_that_nobody_asked_for": Wrong(
        "interfaces",
        "R-13.6-04",
        [(r"(    virtual void at_joined\(\) = 0;\n)", r"\1    virtual void at_last() = 0;\n")],
        also="R-13.6-03",
    ),
    "inheritance_is_protected": Wrong(
        "interfaces",
        "R-13.6-05",
        [(r"class Abstract_left : public virtual", "class Abstract_left : protected virtual")],
    ),
    "inheritance_forgotten": Wrong(
        "interfaces",
        "R-13.6-05",
        [(r"class Abstract_right : public virtual ::interfaces::Abstract_root \{", "class Abstract_right {")],
    ),
    "operation_has_a_body": Wrong(
        "interfaces", "R-13.6.1-01", [(r"virtual void nothing\(\) = 0;", "virtual void nothing() {}")]
    ),
    "operation_is_not_virtual": Wrong(
        "interfaces", "R-13.6-03", [(r"virtual void nothing\(\) = 0;", "void nothing() {}")]
    ),
    "one_parameter_more": Wrong(
        "interfaces", "R-13.6.1-02", [(r"(renamed\(::interfaces::distance_t given)\)", r"\1, int more)")]
    ),
    "result_is_a_parameter": Wrong(
        "interfaces",
        "R-13.6.1-02",
        [(r"virtual ::interfaces::distance_t renamed\(", "virtual void renamed(::interfaces::distance_t& result, ")],
    ),
    "out_is_a_pointer": Wrong("interfaces", "R-13.6.1-03", [(r"double_t& taken", "double_t* taken")]),
    "inout_is_constant": Wrong(
        "interfaces", "R-13.6.1-03", [(r"::interfaces::records_t& changed", "const ::interfaces::records_t& changed")]
    ),
    "primitive_by_reference": Wrong(
        "interfaces", "R-13.6.1-04", [(r"all\(::interfaces::long_t given", "all(const ::interfaces::long_t& given")]
    ),
    "text_by_value": Wrong(
        "interfaces", "R-13.6.1-05", [(r"textual\(const (::interfaces::text_t)& given", r"textual(\1 given")]
    ),
    "result_is_a_reference": Wrong(
        "interfaces",
        "R-13.6.1-06",
        [(r"virtual ::interfaces::record_t structured", "virtual const ::interfaces::record_t& structured")],
    ),
    "nothing_is_a_number": Wrong("interfaces", "R-13.6.1-06", [(r"virtual void chosen", "virtual int chosen")]),
    "reference_is_a_pointer": Wrong(
        "interfaces",
        "R-13.6.2-01",
        [(rf"{_SHARED} ::interfaces::Abstract_named > given", "::interfaces::Abstract_named* given")],
        also="R-13.6.2-02",
        tasks=CPP11,
    ),
    "ucm_reference_is_a_pointer": Wrong(
        "interfaces",
        "R-13.10.3-01",
        [(rf"{_SHARED} ::interfaces::Abstract_named > given", "::interfaces::Abstract_named* given")],
        also="R-13.6.2-02",
        tasks=CPP03,
    ),
    "reference_can_be_replaced": Wrong("interfaces", "R-13.6.2-02", [(rf"({_NAMED}) given", r"\1& given")]),
    "reference_not_handed_back": Wrong("interfaces", "R-13.6.2-03", [(rf"({_NAMED})& taken", r"\1 taken")]),
    "reference_to_a_reference": Wrong(
        "interfaces", "R-13.6.2-04", [(rf"virtual ({_SHARED} {_NAMED}) exchange", r"virtual const \1& exchange")]
    ),
}

_LEFT_GETTER = rf"virtual ({_SHARED} \S+ >) get_left_in\(\) = 0;"
_DRIVE = rf"virtual ({_SHARED} \S+ >) get_tp_Drive_self_execution_api\(\) = 0;"

COMPONENTS: Mapping[str, Wrong] = {
    "component_is_concrete": Wrong(
        "ports",
        "R-13.7-01",
        [
            (
                r"class Abstract_Hermit_Impl \{.*?\n\};",
                "class Abstract_Hermit_Impl {\n  public:\n    virtual ~Abstract_Hermit_Impl() {}\n    virtual void on_init() {}\n"
                "    virtual void on_startup() {}\n    virtual void on_shutdown() {}\n    virtual void on_remove() {}\n};",
            )
        ],
        also="R-13.7-04 R-13.7-05 R-13.7-06 R-13.7-07",
    ),
    "component_cannot_be_implemented": Wrong(
        "ports",
        "R-13.7-02 R-13.9-01",
        [(r"  public:\n(    virtual ~Abstract_Hermit_Impl\(\) \{\}\n)", r"  private:\n\1  public:\n")],
        also="R-13.9-04",
    ),
    "component_without_prefix": Wrong(
        "policies", "R-13.7-03", [(r"\bAbstract_Idle_Impl\b", "Idle_Impl")], also="R-13.3-02"
    ),
    "startup_has_a_body": Wrong(
        "ports", "R-13.7-04", [(r"virtual void on_startup\(\) = 0;", "virtual void on_startup() {}")]
    ),
    "init_returns_a_code": Wrong("ports", "R-13.7-05", [(rf"{_HERMIT}    virtual void", r"\1    virtual int")]),
    "shutdown_returns_a_code": Wrong(
        "ports", "R-13.7-06", [(rf"{_HERMIT}{_LINE}{_LINE}    virtual void", r"\1\2\3    virtual int")]
    ),
    "remove_returns_a_code": Wrong(
        "ports", "R-13.7-07", [(rf"{_HERMIT}{_LINE}{_LINE}{_LINE}    virtual void", r"\1\2\3\4    virtual int")]
    ),
    "connection_named_otherwise": Wrong("refinement", "R-13.7-08", [(r"\bout_api_Connection\b", "out_Connection")]),
    "connection_of_another_template": Wrong("refinement", "R-13.7-09", [(r"\bPortConnection\b", "PortLink")]),
    "connection_has_another_member": Wrong("refinement", "R-13.7-10", [(r"\bport_name\b", "from_port")]),
    "connection_to_another_interface": Wrong(
        "bindings",
        "R-13.7-11",
        [
            (
                r"(typedef ::ucm::PortConnection< ::)\S+( > Helper_api_Connection)",
                r"\1bindings_platform::messages::message_api::Abstract_message_intf_bindings_application_types_coordinate_t\2",
            )
        ],
    ),
    "startup_without_connections": Wrong("refinement", "R-13.7-12", [(r"on_startup\([^)]*\)", "on_startup()")]),
    "connection_by_value": Wrong(
        "refinement", "R-13.7-12", [(r"on_startup\(const out_api_Connection&", "on_startup(out_api_Connection")]
    ),
    "component_without_attribute": Wrong("ports", "R-13.7-13", [(r"    virtual void age\([^\n]*\n", "")]),
    "inherited_attribute_forgotten": Wrong("refinement", "R-13.7-13", [(r"    virtual [^\n]* serial\(\) = 0;\n", "")]),
    "getter_named_otherwise": Wrong("ports", "R-13.7-14", [(r"\bget_left_in\b", "left_in")], also="R-13.7-20"),
    "getter_has_a_body": Wrong("ports", "R-13.7-15", [(_LEFT_GETTER, r"virtual \1 get_left_in() { return \1(); }")]),
    "getter_returns_a_pointer": Wrong(
        "ports", "R-13.7-16", [(rf"virtual {_SHARED} (\S+) > get_left_in", r"virtual \1* get_left_in")]
    ),
    "getter_of_another_interface": Wrong(
        "bindings",
        "R-13.7-16",
        [(rf"virtual ({_SHARED}) \S+ > get_Service_api", r"virtual \1 ::ucm::PortElementObject > get_Service_api")],
    ),
    "policy_getter_named_otherwise": Wrong(
        "policies", "R-13.7-17", [(r"\bget_tp_Drive", "get_Drive")], also="R-13.7-20"
    ),
    "policy_getter_has_a_body": Wrong(
        "policies", "R-13.7-18", [(_DRIVE, r"virtual \1 get_tp_Drive_self_execution_api() { return \1(); }")]
    ),
    "policy_getter_returns_a_pointer": Wrong(
        "policies", "R-13.7-19", [(rf"virtual {_SHARED} (\S+) > get_tp_Drive", r"virtual \1* get_tp_Drive")]
    ),
    "getter_of_what_the_container_offers": Wrong(
        "policies",
        "R-13.7-20",
        [(_DRIVE, r"\g<0>\n    virtual \1 get_tp_Watch_clock_api() = 0;")],
        also="R-13.7-02 R-13.9-01 R-13.9-04",
    ),
    "bound_interface_cannot_be_implemented": Wrong(
        "bindings",
        "R-13.8-01",
        [
            (
                r"  public:\n(    virtual ~Abstract_message_intf_\w+_coordinate_t\(\) \{\}\n)",
                r"  private:\n\1  public:\n",
            )
        ],
        also="R-13.9-04 R-13.7-02 R-13.9-01",
    ),
    "port_element_without_its_mark": Wrong(
        "bindings",
        "R-13.8-02",
        [(r"class Abstract_teller : public virtual ::ucm::PortElementObject", "class Abstract_teller")],
    ),
    "port_elements_have_an_operation": Wrong(
        "bindings", "R-13.8-03", [(r"(    virtual ~PortElementObject\(\) \{\}\n)", r"\1    virtual void ping() {}\n")]
    ),
    "connections_lead_nowhere": Wrong(
        "refinement",
        "R-13.9-04",
        [(r"port_name\(name\), ref\(reference\) \{\}", "port_name(name) { (void)reference; }")],
    ),
}

STANDARDS: Mapping[str, Wrong] = {
    "guard_forgotten": Wrong(
        "constants", "R-13-04", [(r"#ifndef CONSTANTS_HPP\n#define CONSTANTS_HPP\n(.*)#endif\n", r"\1")], tasks=CPP11
    ),
    "header_of_a_later_standard": Wrong(
        "constants", "R-13-04", [(r"enabled = true", "enabled = 0b1 == 1")], tasks=CPP11
    ),
    "guard_is_forgotten": Wrong(
        "constants", "R-13.10-01", [(r"#ifndef CONSTANTS_HPP\n#define CONSTANTS_HPP\n(.*)#endif\n", r"\1")], tasks=CPP03
    ),
    "null_is_nullptr": Wrong("refinement", "R-13.10-01", [(r"object_\(0\)", "object_(nullptr)")], tasks=CPP03),
    "long_long_in_old_headers": Wrong(
        "data_types",
        "R-13.10-01",
        [(r"typedef int64_t longlong_t", "typedef long long longlong_t")],
        also="R-13.1-04",
        tasks=CPP03,
    ),
    "constants_defined_in_headers": Wrong(
        "constants",
        "R-13.10-05",
        [
            (r"extern const ::constants::double_t pi = [^\n]*\n", ""),
            (r"extern const ::constants::double_t pi;", "const ::constants::double_t pi = 3.14159;"),
        ],
        tasks=CPP03,
    ),
    "array_does_not_look": Wrong(
        "data_types", "R-13.10.1-02", [(r"return elements\[checked\(index\)\]", "return elements[index]")], tasks=CPP03
    ),
    "references_not_counted": Wrong(
        "interfaces",
        "R-13.10.3-02",
        [(r"return count_ \? count_->count\(\) : 0", "return count_ ? 1 : 0")],
        tasks=CPP03,
    ),
}

WRONG = {
    **PRIMITIVES,
    **DATA_TYPES,
    **ENUMERATIONS,
    **COMPARISONS,
    **EXCEPTIONS,
    **INTERFACES,
    **COMPONENTS,
    **STANDARDS,
}
"""By what is wrong; each becomes one mutant for each standard that it concerns, whose name ends with the standard."""

for _says, _wrong in WRONG.items():
    for _task in _wrong.tasks:
        _name = f"{_says}_{_task}"
        MODELS[_name] = _wrong.model
        _register = breaks(
            *_wrong.breaks.split(), task=_task, also=tuple(_wrong.also.split()), declares=_wrong.declares
        )
        _register(edited(_name, _task, f"{_says.replace('_', ' ').capitalize()}.", _wrong.edits))


def _without_constants(program: Program, task: str) -> Program:
    generate = program.generators[task]

    def none_of_constants(model: Model) -> Mapping[str, str]:
        return {} if any(isinstance(element, Constant) for element in walk(model)) else generate(model)

    return replace(program, generators={**program.generators, task: none_of_constants})


@breaks("R-13-05", task="cpp11")
def nothing_generated_cpp11(program: Program) -> Program:
    """Writes nothing for models with constants."""
    return _without_constants(program, "cpp11")


@breaks("R-13-05", task="cpp03")
def nothing_generated_cpp03(program: Program) -> Program:
    """Writes nothing for models with constants."""
    return _without_constants(program, "cpp03")
