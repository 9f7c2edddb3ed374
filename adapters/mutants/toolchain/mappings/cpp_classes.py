"""Tool chains that generate wrong C++ of exceptions, interfaces and components, or for another standard, one thing each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.contracts import Constant
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.rewriting import CPP03, CPP11, Wrong, register
from ucm_cts.adapters.reference.toolchain.program import Program

_SHARED = r"::(?:std|ucm)::shared_ptr<"
_HERMIT = r"(~Abstract_Hermit_Impl\(\) \{\}\n)"
_LINE = r"([^\n]*\n)"


_NAMED = "::interfaces::Abstract_named >"


_LEFT_GETTER = rf"virtual ({_SHARED} \S+ >) get_left_in\(\) = 0;"
_DRIVE = rf"virtual ({_SHARED} \S+ >) get_tp_Drive_self_execution_api\(\) = 0;"

PORTS: Mapping[str, Wrong] = {
    "interface_without_prefix": Wrong("R-13.6-02", {r"\bAbstract_unrelated\b": "unrelated"}, also="R-13.3-02"),
    "component_is_concrete": Wrong(
        "R-13.7-01",
        {
            r"class Abstract_Hermit_Impl \{.*?\n\};": (
                "class Abstract_Hermit_Impl {\n  public:\n    virtual ~Abstract_Hermit_Impl() {}\n    virtual void on_init() {}\n"
                "    virtual void on_startup() {}\n    virtual void on_shutdown() {}\n    virtual void on_remove() {}\n};"
            )
        },
        also="R-13.7-04 R-13.7-05 R-13.7-06 R-13.7-07",
    ),
    "component_cannot_be_implemented": Wrong(
        "R-13.7-02 R-13.9-01",
        {r"  public:\n(    virtual ~Abstract_Hermit_Impl\(\) \{\}\n)": r"  private:\n\1  public:\n"},
        also="R-13.9-04",
    ),
    "startup_has_a_body": Wrong("R-13.7-04", {r"virtual void on_startup\(\) = 0;": "virtual void on_startup() {}"}),
    "init_returns_a_code": Wrong("R-13.7-05", {rf"{_HERMIT}    virtual void": r"\1    virtual int"}),
    "shutdown_returns_a_code": Wrong(
        "R-13.7-06", {rf"{_HERMIT}{_LINE}{_LINE}    virtual void": r"\1\2\3    virtual int"}
    ),
    "remove_returns_a_code": Wrong(
        "R-13.7-07", {rf"{_HERMIT}{_LINE}{_LINE}{_LINE}    virtual void": r"\1\2\3\4    virtual int"}
    ),
    "component_without_attribute": Wrong("R-13.7-13", {r"    virtual void age\([^\n]*\n": ""}),
    "getter_named_otherwise": Wrong("R-13.7-14", {r"\bget_left_in\b": "left_in"}, also="R-13.7-20"),
    "getter_has_a_body": Wrong("R-13.7-15", {_LEFT_GETTER: r"virtual \1 get_left_in() { return \1(); }"}),
    "getter_returns_a_pointer": Wrong(
        "R-13.7-16", {rf"virtual {_SHARED} (\S+) > get_left_in": r"virtual \1* get_left_in"}
    ),
}
register("ports", PORTS)
POLICIES: Mapping[str, Wrong] = {
    "component_without_prefix": Wrong("R-13.7-03", {r"\bAbstract_Idle_Impl\b": "Idle_Impl"}, also="R-13.3-02"),
    "offer_by_value": Wrong("R-13.7-12", {r"const Watch_clock_api_Connection&": "Watch_clock_api_Connection"}),
    "policy_getter_named_otherwise": Wrong("R-13.7-17", {r"\bget_tp_Drive": "get_Drive"}, also="R-13.7-20"),
    "policy_getter_has_a_body": Wrong(
        "R-13.7-18", {_DRIVE: r"virtual \1 get_tp_Drive_self_execution_api() { return \1(); }"}
    ),
    "policy_getter_returns_a_pointer": Wrong(
        "R-13.7-19", {rf"virtual {_SHARED} (\S+) > get_tp_Drive": r"virtual \1* get_tp_Drive"}
    ),
    "getter_of_what_the_container_offers": Wrong(
        "R-13.7-20",
        {_DRIVE: r"\g<0>\n    virtual \1 get_tp_Watch_clock_api() = 0;"},
        also="R-13.7-02 R-13.9-01 R-13.9-04",
    ),
}
register("policies", POLICIES)
BINDINGS: Mapping[str, Wrong] = {
    "connection_to_another_interface": Wrong(
        "R-13.7-11",
        {
            r"(typedef ::ucm::PortConnection< ::)\S+( > Helper_api_Connection)": r"\1bindings_platform::messages::message_api::Abstract_message_intf_bindings_application_types_coordinate_t\2"
        },
    ),
    "getter_of_another_interface": Wrong(
        "R-13.7-16",
        {rf"virtual ({_SHARED}) \S+ > get_Service_api": r"virtual \1 ::ucm::PortElementObject > get_Service_api"},
    ),
    "bound_interface_cannot_be_implemented": Wrong(
        "R-13.8-01",
        {r"  public:\n(    virtual ~Abstract_message_intf_\w+_coordinate_t\(\) \{\}\n)": r"  private:\n\1  public:\n"},
        also="R-13.9-04 R-13.7-02 R-13.9-01",
    ),
    "port_element_without_its_mark": Wrong(
        "R-13.8-02", {r"class Abstract_teller : public virtual ::ucm::PortElementObject": "class Abstract_teller"}
    ),
    "port_elements_have_an_operation": Wrong(
        "R-13.8-03", {r"(    virtual ~PortElementObject\(\) \{\}\n)": r"\1    virtual void ping() {}\n"}
    ),
}
register("bindings", BINDINGS)

CONSTANTS: Mapping[str, Wrong] = {
    "guard_forgotten": Wrong(
        "R-13-04", {r"#ifndef CONSTANTS_HPP\n#define CONSTANTS_HPP\n(.*)#endif\n": r"\1"}, tasks=CPP11
    ),
    "header_of_a_later_standard": Wrong("R-13-04", {r"enabled = true": "enabled = 0b1 == 1"}, tasks=CPP11),
    "guard_is_forgotten": Wrong(
        "R-13.10-01", {r"#ifndef CONSTANTS_HPP\n#define CONSTANTS_HPP\n(.*)#endif\n": r"\1"}, tasks=CPP03
    ),
    "constants_defined_in_headers": Wrong(
        "R-13.10-05",
        {
            r"extern const ::constants::double_t pi = [^\n]*\n": "",
            r"extern const ::constants::double_t pi;": "const ::constants::double_t pi = 3.14159;",
        },
        tasks=CPP03,
    ),
}
register("constants", CONSTANTS)
REFINEMENT: Mapping[str, Wrong] = {
    "connection_named_otherwise": Wrong("R-13.7-08", {r"\bout_api_Connection\b": "out_Connection"}),
    "connection_of_another_template": Wrong("R-13.7-09", {r"\bPortConnection\b": "PortLink"}),
    "connection_has_another_member": Wrong("R-13.7-10", {r"\bport_name\b": "from_port"}),
    "startup_without_connections": Wrong("R-13.7-12", {r"on_startup\([^)]*\)": "on_startup()"}),
    "connection_by_value": Wrong(
        "R-13.7-12", {r"on_startup\(const out_api_Connection&": "on_startup(out_api_Connection"}
    ),
    "inherited_attribute_forgotten": Wrong("R-13.7-13", {r"    virtual [^\n]* serial\(\) = 0;\n": ""}),
    "connections_lead_nowhere": Wrong(
        "R-13.9-04", {r"port_name\(name\), ref\(reference\) \{\}": "port_name(name) { (void)reference; }"}
    ),
    "null_is_nullptr": Wrong("R-13.10-01", {r"object_\(0\)": "object_(nullptr)"}, tasks=CPP03),
}
register("refinement", REFINEMENT)
DATA_TYPES: Mapping[str, Wrong] = {
    "long_long_in_old_headers": Wrong(
        "R-13.10-01", {r"typedef int64_t longlong_t": "typedef long long longlong_t"}, also="R-13.1-04", tasks=CPP03
    ),
    "array_does_not_look": Wrong(
        "R-13.10.1-02", {r"return elements\[checked\(index\)\]": "return elements[index]"}, tasks=CPP03
    ),
}
register("data_types", DATA_TYPES)
INTERFACES: Mapping[str, Wrong] = {
    "exception_not_assigned": Wrong(
        "R-13.4-01",
        {
            r"nothing_left& operator=\(const nothing_left&\) = default": "nothing_left& operator=(const nothing_left&) = delete"
        },
        tasks=CPP11,
    ),
    "exception_is_not_assigned": Wrong(
        "R-13.4-01",
        {r"(class nothing_left [^\n]*\n)": r"\1    nothing_left& operator=(const nothing_left&);\n"},
        tasks=CPP03,
    ),
    "root_is_concrete": Wrong(
        "R-13.4-02",
        {
            r"virtual void _raise\(\) const = 0;": "virtual void _raise() const {}",
            r"virtual const char\* _name\(\) const = 0;": 'virtual const char* _name() const { return ""; }',
        },
    ),
    "system_exception_without_root": Wrong(
        "R-13.4-02", {r"class SystemException : public Exception \{": "class SystemException {"}
    ),
    "exceptions_have_repository_ids": Wrong(
        "R-13.4-03",
        {
            r"(    virtual const char\* _name\(\) const = 0;)": r'    virtual const char* _rep_id() const { return ""; }\n\1'
        },
    ),
    "user_exception_is_the_systems": Wrong(
        "R-13.4-04", {r"class refused : public ::UCM::UserException": "class refused : public ::UCM::SystemException"}
    ),
    "system_exception_renamed": Wrong("R-13.4-05", {r"\bSystemException\b": "RuntimeException"}, also="R-13.4-02"),
    "exceptions_are_corbas": Wrong(
        "R-13.4-06",
        {
            r"namespace UCM \{\n": "namespace CORBA { class UserException {}; }\nnamespace UCM {\n",
            r"class UserException : public Exception \{": "class UserException : public Exception, public ::CORBA::UserException {",
        },
    ),
    "exception_field_forgotten": Wrong("R-13.4-07", {r"    void code\([^\n]*\n": ""}),
    "exceptions_not_caught": Wrong(
        "R-13.4-08",
        {r"class UserException : public Exception": "class UserException : protected Exception"},
        also="R-13.4-02",
    ),
    "interfaces_are_corbas": Wrong(
        "R-13-03",
        {
            r"namespace interfaces \{ \}\n": "namespace CORBA { class Object {}; }\nnamespace interfaces { }\n",
            r"class Abstract_root \{": "class Abstract_root : public virtual ::CORBA::Object {",
        },
    ),
    "accessor_has_a_prefix": Wrong("R-13.5-02", {r"text_t name\(\) = 0": "text_t get_name() = 0"}, also="R-13.6-04"),
    "accessor_returns_a_reference": Wrong(
        "R-13.5-02", {r"virtual (::interfaces::text_t) name\(\) = 0": r"virtual const \1& name() = 0"}
    ),
    "accessor_is_for_constants": Wrong(
        "R-13.5-02", {r"text_t name\(\) = 0": "text_t name() const = 0"}, declares=("cpp-accessors=not-const",)
    ),
    "mutator_forgotten": Wrong("R-13.5-03", {r"    virtual void weight\([^\n]*\n": ""}),
    "mutator_has_a_body": Wrong("R-13.5-04", {r"(virtual void weight\([^\n]*) = 0;": r"\1 { (void)value; }"}),
    "read_only_is_written": Wrong(
        "R-13.5-05",
        {
            r"(    virtual ::interfaces::text_t name\(\) = 0;\n)": r"\1    virtual void name(const ::interfaces::text_t&) {}\n"
        },
    ),
    "interface_is_concrete": Wrong("R-13.6-01", {r"at_root\(\) = 0;": "at_root() { return 0; }"}, also="R-13.6.1-01"),
    "interface_cannot_be_implemented": Wrong(
        "R-13.6-03",
        {r"  public:\n(    virtual ~Abstract_primitive_parameters\(\) \{\}\n)": r"  private:\n\1  public:\n"},
    ),
    "operation_that_nobody_asked_for": Wrong(
        "R-13.6-04",
        {r"(    virtual void at_joined\(\) = 0;\n)": r"\1    virtual void at_last() = 0;\n"},
        also="R-13.6-03",
    ),
    "inheritance_is_protected": Wrong(
        "R-13.6-05", {r"class Abstract_left : public virtual": "class Abstract_left : protected virtual"}
    ),
    "inheritance_forgotten": Wrong(
        "R-13.6-05", {r"class Abstract_right : public virtual ::interfaces::Abstract_root \{": "class Abstract_right {"}
    ),
    "operation_has_a_body": Wrong(
        "R-13.6.1-01", {r"virtual void nothing\(\) = 0;(\n    virtual ::interfaces)": r"virtual void nothing() {}\1"}
    ),
    "operation_is_not_virtual": Wrong(
        "R-13.6-03", {r"virtual void nothing\(\) = 0;(\n    virtual ::interfaces)": r"void nothing() {}\1"}
    ),
    "one_parameter_more": Wrong("R-13.6.1-02", {r"(renamed\(::interfaces::distance_t given)\)": r"\1, int more)"}),
    "result_is_a_parameter": Wrong(
        "R-13.6.1-02",
        {r"virtual ::interfaces::distance_t renamed\(": "virtual void renamed(::interfaces::distance_t& result, "},
    ),
    "out_is_a_pointer": Wrong("R-13.6.1-03", {r"double_t& taken": "double_t* taken"}),
    "inout_is_constant": Wrong(
        "R-13.6.1-03", {r"::interfaces::records_t& changed": "const ::interfaces::records_t& changed"}
    ),
    "primitive_by_reference": Wrong(
        "R-13.6.1-04", {r"all\(::interfaces::long_t given": "all(const ::interfaces::long_t& given"}
    ),
    "text_by_value": Wrong("R-13.6.1-05", {r"textual\(const (::interfaces::text_t)& given": r"textual(\1 given"}),
    "result_is_a_reference": Wrong(
        "R-13.6.1-06",
        {r"virtual ::interfaces::record_t structured": "virtual const ::interfaces::record_t& structured"},
    ),
    "nothing_is_a_number": Wrong("R-13.6.1-06", {r"virtual void chosen": "virtual int chosen"}),
    "reference_is_a_pointer": Wrong(
        "R-13.6.2-01",
        {rf"{_SHARED} ::interfaces::Abstract_named > given": "::interfaces::Abstract_named* given"},
        also="R-13.6.2-02",
        tasks=CPP11,
    ),
    "ucm_reference_is_a_pointer": Wrong(
        "R-13.10.3-01",
        {rf"{_SHARED} ::interfaces::Abstract_named > given": "::interfaces::Abstract_named* given"},
        also="R-13.6.2-02",
        tasks=CPP03,
    ),
    "reference_can_be_replaced": Wrong("R-13.6.2-02", {rf"({_NAMED}) given": r"\1& given"}),
    "reference_not_handed_back": Wrong("R-13.6.2-03", {rf"({_NAMED})& taken": r"\1 taken"}),
    "reference_to_a_reference": Wrong(
        "R-13.6.2-04", {rf"virtual ({_SHARED} {_NAMED}) exchange": r"virtual const \1& exchange"}
    ),
    "references_not_counted": Wrong(
        "R-13.10.3-02", {r"return count_ \? count_->count\(\) : 0": "return count_ ? 1 : 0"}, tasks=CPP03
    ),
}
register("interfaces", INTERFACES)


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
