"""Tool chains that generate wrong IDL, one thing each: what the reference generates, with one text replaced."""

from __future__ import annotations

from ucm_cts.adapters.mutants.toolchain.registry import breaks, named
from ucm_cts.adapters.mutants.toolchain.rewriting import (
    GUARD,
    MODEL,
    STANDARD,
    appended,
    replace_each,
    replaced,
    rewritten,
)
from ucm_cts.adapters.reference.toolchain.program import Program

ENUM_INDEX = r'@IndexType\(typeid="(?!unsigned long")[^"]*"\)\n(?= *enum)'
SEQUENCE_INDEX = r'@IndexType\(typeid="(?!unsigned long")[^"]*"\)\n(?= *typedef sequence)'
ARRAY_INDEX = r'@IndexType\(typeid="(?!unsigned long")[^"]*"\)\n(?= *typedef (?!sequence))'

REPLACED: dict[str, tuple[str, str, str]] = {
    # data types (12.2, 12.3)
    "alias_forgotten": ("R-12.2-03", r" *typedef \S+ place_t;\n", ""),
    "byte_is_a_char": ("R-12.3.1-01", r"@int8 typedef octet", "@int8 typedef char"),
    "short_is_long": ("R-12.3.1-02", r"typedef short (\w+);", r"typedef long \1;"),
    "long_is_short": ("R-12.3.1-03", r"typedef long (\w+);", r"typedef short \1;"),
    "long_long_is_long": ("R-12.3.1-04", r"typedef long long ", "typedef long "),
    "unsigned_byte_is_a_char": ("R-12.3.1-05", r"@uint8 typedef octet", "@uint8 typedef char"),
    "unsigned_short_is_short": ("R-12.3.1-06", r"typedef unsigned short ", "typedef short "),
    "unsigned_long_is_long": ("R-12.3.1-07", r"typedef unsigned long (\w+);", r"typedef long \1;"),
    "unsigned_long_long_is_unsigned_long": ("R-12.3.1-08", r"typedef unsigned long long ", "typedef unsigned long "),
    "unsigned_long_long_is_signed": ("R-12.3.1-08", r"typedef unsigned long long ", "typedef long long "),
    "float_is_double": ("R-12.3.1-09", r"typedef float ", "typedef double "),
    "double_is_float": ("R-12.3.1-10", r"typedef double ", "typedef float "),
    "char_is_wchar": ("R-12.3.1-11", r"typedef char ", "typedef wchar "),
    "wchar_is_char": ("R-12.3.1-12", r"typedef wchar ", "typedef char "),
    "boolean_is_octet": ("R-12.3.1-13", r"typedef boolean ", "typedef octet "),
    "byte_without_sign": ("R-12.3.2-02", r"@int8 ", ""),
    "unsigned_byte_without_sign": ("R-12.3.2-03", r"@uint8 ", ""),
    # complex types (12.4.1)
    "alias_of_another_type": ("R-12.4.1-01", r"typedef ::data_types::long_t distance_t", "typedef double distance_t"),
    "field_forgotten": ("R-12.4.1-02", r" *::data_types::double_t y;\n", ""),
    "fields_out_of_order": ("R-12.4.1-02", r"( *::data_types::double_t x;\n)( *::data_types::double_t y;\n)", r"\2\1"),
    "structure_is_an_exception": ("R-12.4.1-02", r"struct segment_t", "exception segment_t"),
    "field_of_another_type": ("R-12.4.1-03", r"::data_types::shape_t shape;", "::data_types::long_t shape;"),
    "union_told_apart_by_a_number": ("R-12.4.1-04", r"switch \(::data_types::shape_t\)", "switch (long)"),
    "case_of_another_type": ("R-12.4.1-05", r"::data_types::distance_t side", "::data_types::text_t side"),
    "case_with_another_label": ("R-12.4.1-06", r"(case ::idl_types::green:)", r"\1 case ::idl_types::red:"),
    "default_forgotten": ("R-12.4.1-06", r" *default:\n", ""),
    "enumerator_forgotten": ("R-12.4.1-07", r' *@DefaultValue\(val="0"\)\n *black,\n', ""),
    "dimensions_out_of_order": ("R-12.4.1-08", r"grid_t\[2\]\[3\]", "grid_t[3][2]"),
    "array_of_another_type": ("R-12.4.1-08", r"typedef \S+ grid_t", "typedef long grid_t"),
    "sequence_without_bound": ("R-12.4.1-09", r"(sequence<[^,>]*), \d+>", r"\1>"),
    "sequence_of_another_type": ("R-12.4.1-09", r"sequence<::data_types::point_t>", "sequence<long>"),
    "string_with_another_bound": ("R-12.4.1-10", r"string<16>", "string<17>"),
    "wide_string_is_narrow": ("R-12.4.1-10", r"typedef wstring", "typedef string"),
    "native_is_octet": ("R-12.4.1-11", r"native handle_t;", "typedef octet handle_t;"),
    # annotations (12.4.1.1 to 12.4.1.3, 14)
    "native_without_footprint": ("R-12.4.1.1-02", r"@MemoryFootprint\(max=1024\)\n", ""),
    "footprint_of_another_size": ("R-12.4.1.1-03", r"max=1024", "max=1"),
    "index_is_no_integer": ("R-12.4.1.2-02", r'typeid="octet"', 'typeid="float"'),
    "sequence_without_index": ("R-12.4.1.2-04", SEQUENCE_INDEX, "\n"),
    "sequence_with_another_index": ("R-12.4.1.2-04", SEQUENCE_INDEX, '@IndexType(typeid="long long")\n'),
    "array_without_index": ("R-12.4.1.2-05", ARRAY_INDEX, "\n"),
    "array_with_another_index": ("R-12.4.1.2-05", ARRAY_INDEX, '@IndexType(typeid="long long")\n'),
    "enumeration_without_index": ("R-12.4.1.2-06", ENUM_INDEX, "\n"),
    "enumeration_with_another_index": ("R-12.4.1.2-06", ENUM_INDEX, '@IndexType(typeid="long long")\n'),
    "default_index_not_told": ("R-12.4.1.2-04", r'@IndexType\(typeid="unsigned long"\)\n(?= *typedef seq)', "\n"),
    "values_forgotten": ("R-12.4.1.3-02", r"@DefaultValue\(.*\)\n", "\n"),
    "values_counted_from_one": ("R-12.4.1.3-02", r'@DefaultValue\(val="0"\)', '@DefaultValue(val="1")'),
    "another_default": ("R-12.4.1.3-03", r'val="0x10"', 'val="0x11"'),
    "attribute_default_forgotten": ("R-12.4.1.3-03", r'@DefaultValue\(val="TRUE"\) ', ""),
    "values_by_position_only": ("R-12.4.1.3-02", r'( *)@DefaultValue\(val="0"\)\n', "\n"),
    "int8_with_a_value": ("R-14-02", r"@int8 ", "@int8(8) "),
    "uint8_with_a_value": ("R-14-03", r"@uint8 ", "@uint8(8) "),
    "footprint_called_otherwise": ("R-14-04", r"@MemoryFootprint\(max", "@MemoryFootprint(size"),
    "index_called_otherwise": ("R-14-05", r"@IndexType\(typeid", "@IndexType(type"),
    "value_called_otherwise": ("R-14-06", r"@DefaultValue\(val", "@DefaultValue(number"),
    # constants (12.5)
    "constant_forgotten": ("R-12.5-01", r" *const \S+ coldest .*\n", ""),
    "constant_of_another_type": ("R-12.5-02", r"const \S+ mask", "const ::constants::longlong_t mask"),
    "constant_is_a_basic_type": ("R-12.5-02", r"const \S+ coldest", "const long coldest"),
    "constant_without_sign": ("R-12.5-03", r"-273", "273"),
    "constant_read_as_decimal": ("R-12.5-03", r"0xFF00", "65000"),
    "constant_with_another_enumerator": ("R-12.5-03", r"::constants::high;", "::constants::low;"),
    "hyphen_left_out": ("R-12.2-03", r"\btwo_values\b", "twovalues"),
    # interfaces and exceptions (12.6)
    "exception_is_a_structure": ("R-12.6-01", r"exception closed", "struct closed"),
    "exception_field_renamed": ("R-12.6-02", r"rank_t limit;", "rank_t bound;"),
    "exception_field_of_another_type": ("R-12.6-02", r"::idl_types::rank_t limit;", "long limit;"),
    "interface_renamed": ("R-12.6-03", r"\bunrelated\b", "Unrelated"),
    "operation_forgotten": ("R-12.6-04", r" *void nothing\(\);\n", ""),
    "operations_inherited_besides": ("R-12.6-04", r"interface unrelated \{", "interface unrelated : ::Connectable {"),
    "port_element_is_a_manager": (
        "R-12.6-04",
        r"interface ask : ::PortElementObject",
        "interface ask : ::PortElementObject, ::ContainerManager",
    ),
    "operation_added": ("R-12.6-04", r"(interface unrelated \{\n)", r"\1void something();\n"),
    "inout_is_in": ("R-12.6-05", r"\binout ", "in "),
    "parameter_renamed": ("R-12.6-05", r"\bgiven\b", "value"),
    "parameters_out_of_order": ("R-12.6-05", r"\((in [^,()]*), (out [^,()]*), ", r"(\2, \1, "),
    "result_is_also_a_parameter": ("R-12.6-05", r"(at_root\()", r"\1out ::interfaces::long_t result"),
    "parameter_of_another_type": ("R-12.6-06", r"in ::interfaces::long_t given", "in ::interfaces::double_t given"),
    "result_forgotten": ("R-12.6-07", r"::interfaces::long_t at_root", "void at_root"),
    "exceptions_not_raised": ("R-12.6-08", r" raises \([^)]*\)", ""),
    "another_exception_raised": (
        "R-12.6-08",
        r"raises \(::interfaces::refused\)",
        "raises (::interfaces::nothing_left)",
    ),
    "ancestor_forgotten": ("R-12.6-09", r"interface left : ::interfaces::root", "interface left"),
    "second_ancestor_forgotten": ("R-12.6-09", r"::interfaces::left, ::interfaces::right", "::interfaces::left"),
    "read_attribute_can_be_written": ("R-12.6-10", r"readonly (attribute ::interfaces)", r"\1"),
    "interface_attributes_forgotten": ("R-12.6-10", r"(interface painter \{\n)(?: *.*attribute .*\n)+", r"\1"),
    # modules (12.7)
    "component_module_renamed": ("R-12.7-02", r"\bpeople\b", "People"),
    "contract_module_renamed": ("R-12.7-03", r"\bdata_types\b", "datatypes"),
    "interaction_module_renamed": ("R-12.7-04", r"\btalking\b", "talks_"),
    "aspect_module_renamed": ("R-12.7-05", r"\bruntime\b", "run_time"),
    "application_module_renamed": ("R-12.7-06", r"\bapplication\b", "App"),
    "interface_parameter_is_a_typename": ("R-12.7-10", r"<interface ", "<typename "),
    "typename_parameter_is_an_interface": ("R-12.7-11", r"<typename ", "<interface "),
    "type_parameter_as_in_clause_9": ("R-12.7-11", r"<typename ", "<type "),
    "parameter_in_lower_case": ("R-12.7-09", r"MESSAGE_TYPE_T", "message_type_t"),
    "parameter_of_another_module_forgotten": (
        "R-12.7-12",
        r"module services<interface SERVICE_INTF_T>",
        "module services",
    ),
    "needless_parameter": ("R-12.7-12", r"module data_types", "module data_types<typename T>"),
    "parameter_with_one_capital": ("R-12.7-09", r"MESSAGE_TYPE_T", "Message_type_t"),
    "inner_parameter_not_handed_out": ("R-12.7-12", r"\n#endif", "\n\n#endif"),
    # components (12.8)
    "component_renamed": ("R-12.8.1-01", r"\bhermit\b", "HermitComponent"),
    "component_attribute_forgotten": ("R-12.8.1-02", r" *attribute \S+ rate;\n", ""),
    "component_attribute_added": ("R-12.8.1-02", r"(interface hermit \{\n)", r"\1attribute long beard;\n"),
    "component_attributes_inherited_besides": (
        "R-12.8.1-02",
        r"(\n *)(interface hermit )\{",
        r"\1interface bearded { attribute long beard; };\1\2: bearded {",
    ),
    "component_operations_inherited_besides": (
        "R-12.8.1-06",
        r"interface hermit \{",
        "interface hermit : ::Connectable {",
    ),
    "component_is_another_component": ("R-12.8.1-06", r"interface teacher \{", "interface teacher : pupil {"),
    "component_operation_added": ("R-12.8.1-06", r"(interface pupil \{\n)", r"\1void wander();\n"),
    "component_attribute_of_another_type": ("R-12.8.1-03", r"attribute \S+ rate;", "attribute long rate;"),
    "component_attribute_cannot_be_written": ("R-12.8.1-04", r"(attribute \S+ rate;)", r"readonly \1"),
    "refined_type_forgotten": ("R-12.8.1-05", r"interface sensor : \S+ ", "interface sensor "),
    "body_called_otherwise": ("R-12.8.2-01", r"_Body\b", "_Impl"),
    "body_without_its_type": ("R-12.8.2-02", r"(interface \w+_Body : )\S+, ", r"\1"),
    "body_is_no_component_object": ("R-12.8.2-03", r", ::ComponentObject", ""),
    "port_element_interface_renamed": ("R-12.8.3-01", r"\bhear\b", "hear_api"),
    "port_element_without_its_base": ("R-12.8.3-02", r" : ::PortElementObject", ""),
    "role_with_a_getter": ("R-12.8.4-02", r"(interface pupil \{\n)", r"\1::PortElementObject get_rumour_listener();\n"),
    "role_with_a_getter_of_its_own_name": (
        "R-12.8.4-02",
        r"(interface pupil \{\n)",
        r"\1::PortElementObject get_rumour();\n",
    ),
    "getter_without_its_element": ("R-12.8.4-04", r"get_left_back", "get_left"),
    "getters_forgotten": ("R-12.8.4-04", r" *\S+ get_(?!tp_)\w+\(\);\n", ""),
    "getter_with_an_argument": ("R-12.8.4-05", r"get_left_back\(\)", "get_left_back(in long number)"),
    "getter_returns_any_port_element": ("R-12.8.4-06", r"\S+ (get_left_back)", r"::PortElementObject \1"),
    "getter_returns_an_unbound_interface": (
        "R-12.8.4-06",
        r"Radio_levels_data_stream_api(::stream_intf)",
        r"Radio_counts_data_stream_api\1",
    ),
    "required_element_with_a_getter": (
        "R-12.8.4-07",
        r"(interface pupil \{\n)",
        r"\1::ports_platform::talking::api::ask get_left_out();\n",
    ),
    "policy_getter_called_like_that_of_a_port": ("R-12.8.5-02", r"get_tp_", "get_"),
    "policy_getter_without_its_element": ("R-12.8.5-02", r"(get_tp_[A-Za-z]+)_\w+", r"\1"),
    "policy_getter_called_after_its_definition": ("R-12.8.5-02", r"get_tp_Drive", "get_tp_self_executing"),
    "inherited_policy_element_forgotten": ("R-12.8.5-02", r" *\S+ get_tp_Night_run_api\(\);\n", ""),
    "required_policy_element_with_a_getter": (
        "R-12.8.5-03",
        r"( *)(\S+ get_tp_Drive)",
        r"\1::policies_platform::runtime::api::clock_intf get_tp_Watch_clock_api();\n\1\2",
    ),
    "policy_getter_with_an_argument": ("R-12.8.5-04", r"(get_tp_\w+)\(\)", r"\1(in long number)"),
    "policy_getter_returns_any_port_element": ("R-12.8.5-05", r"\S+ (get_tp_Drive)", r"::PortElementObject \1"),
    # interactions (12.9)
    "connector_is_an_interface": ("R-12.9-02", r"(module talks \{\n)", r"\1interface line {};\n"),
    "connector_port_is_an_operation": (
        "R-12.9-03",
        r"(module talks \{\n)",
        r"\1interface line { void end_of_line(); };\n",
    ),
    "port_type_is_an_interface": ("R-12.9-05", r"(module talking \{\n)", r"\1interface asking {};\n"),
}
"""By the mutant's name: the requirement that it breaks, a pattern in the model's file, and what stands there instead."""

PRINTED: dict[str, tuple[str, str, str]] = {
    # what clause 12 prints (12.10, 12.11, 14)
    "index_defined_otherwise": ("R-14-05", r"string typeid;", "long typeid;"),
    "footprint_defined_otherwise": ("R-14-04", r"unsigned long max;", "string max;"),
    "connectable_forgotten": ("R-12.10-36", r"interface Connectable \{(?:\n.*){3}", ""),
    "trace_forgotten": ("R-12.11.2-07", r"interface trace_service_intf .*\{(?:\n.*){2}", ""),
    "property_without_value": ("R-12.10-29", r"    string value;\n", ""),
    "ids_are_unsigned": ("R-12.10-30", r"typedef long componentId", "typedef unsigned long componentId"),
    "four_properties_at_most": ("R-12.10-29", r"sequence<Property>", "sequence<Property, 4>"),
    "four_ids_at_most": ("R-12.10-30", r"sequence<componentId>", "sequence<componentId, 4>"),
    "ids_are_those_of_connections": (
        "R-12.10-30",
        r"(typedef sequence<)componentId(> componentIds;\n)(typedef long connectionId;\n)",
        r"\3\1connectionId\2",
    ),
    "four_port_elements_at_most": ("R-12.10-32", r"sequence<PortElementObject>", "sequence<PortElementObject, 4>"),
    "four_connections_at_most": ("R-12.10-33", r"sequence<PortConnection>", "sequence<PortConnection, 4>"),
    "components_are_port_elements": (
        "R-12.10-34",
        r"interface ComponentObject \{",
        "interface ComponentObject : PortElementObject {",
    ),
    "manager_is_connectable": (
        "R-12.10-38",
        r"interface ContainerManager : Container",
        "interface ContainerManager : Container, Connectable",
    ),
    "disconnects_components": ("R-12.10-37", r"disconnect\(in connectionId", "disconnect(in componentId"),
    "error_with_a_reason": ("R-12.10-31", r"exception NOT_FOUND \{\n", "exception NOT_FOUND {\nstring reason;\n"),
    "port_elements_have_an_operation": (
        "R-12.10-32",
        r"interface PortElementObject \{\n",
        "interface PortElementObject {\nvoid ping();\n",
    ),
    "port_connected_to_one": ("R-12.10-33", r"PortElementObjects to_port", "PortElementObject to_port"),
    "shutdown_forgotten": ("R-12.10-34", r" *void on_shutdown\(\);\n", ""),
    "fragment_sets_a_manager": ("R-12.10-35", r"\(in Container container", "(in string container"),
    "disconnected_without_its_port": ("R-12.10-36", r"on_disconnect\(in string port_name\)", "on_disconnect()"),
    "start_raises_nothing": ("R-12.10-37", r"void start\(\) raises \(UCM_ERROR\)", "void start()"),
    "manager_is_no_container": ("R-12.10-38", r"interface ContainerManager : Container", "interface ContainerManager"),
    "run_takes_a_number": (
        "R-12.11.1-01",
        r"(component_execution_intf \S+ \S+ \{\n *)void run\(\)",
        r"\1void run(in long number)",
    ),
    "time_is_signed": ("R-12.11.2-01", r"typedef unsigned long ucm_time_t", "typedef long ucm_time_t"),
    "microseconds_are_unsigned": (
        "R-12.11.2-02",
        r"typedef long ucm_suseconds_t",
        "typedef unsigned long ucm_suseconds_t",
    ),
    "messages_without_bound": ("R-12.11.2-03", r"string<255>", "string"),
    "microseconds_first": ("R-12.11.2-04", r"( *ucm_time_t utv_sec;\n)( *ucm_suseconds_t utv_usec;\n)", r"\2\1"),
    "severity_forgotten": ("R-12.11.2-05", r" *warning,\n", ""),
    "clock_returns_its_time": (
        "R-12.11.2-06",
        r"void get_local_time\(out ucm_timeval_t local_time\)",
        "ucm_timeval_t get_local_time()",
    ),
    "trace_without_severity": ("R-12.11.2-07", r"in log_severity_t severity, ", ""),
    "timeouts_called_otherwise": ("R-12.11.3-01", r"ABSOLUTE_TIME", "ABSOLUTE"),
    "timeout_without_flag": ("R-12.11.3-02", r" *timeout_enum_t flag;\n", ""),
    "timer_numbers_are_signed": (
        "R-12.11.3-03",
        r"typedef unsigned long timer_number_t",
        "typedef long timer_number_t",
    ),
    "timeout_without_number": ("R-12.11.3-04", r", in timer_number_t timer_number\);\n *\};", ");\n};"),
    "timers_cannot_be_asked": ("R-12.11.3-05", r" *timer_bool_t is_canceled\(.*\);\n", ""),
}
"""The same for the file of what clause 12 prints."""

REPLACED |= {
    # IDL as such (12.1)
    "semicolon_forgotten": ("R-12.1-03", r"(typedef boolean \w+);", r"\1"),
    "boolean_as_the_table_prints_it": ("R-12.1-03", r"typedef boolean ", "typedef bool "),
    "name_of_nothing": ("R-12.1-03", r"::data_types::label_t label;", "::data_types::tag_t label;"),
    "enumerators_end_with_a_comma": ("R-12.1-03", r"(\n *circle)\n", r"\1,\n"),
    "dimension_before_its_name": ("R-12.1-03", r"corners_t\[3\];", "[3] corners_t;"),
    "declared_after_its_use": ("R-12.1-03", r"( *typedef double double_t;\n)((?:.*\n)*?)(?=\};\n\n#endif)", r"\2\1"),
    "declared_twice": ("R-12.1-03", r"( *typedef double double_t;\n)", r"\1\1"),
    "operations_are_oneway": ("R-12.1-02", r"void nothing\(\)", "oneway void nothing()"),
}

APPENDED: dict[str, tuple[str, str]] = {
    "component_beside_its_interface": ("R-12.1-02", "component Extra { attribute long number; };"),
    "value_types": ("R-12.1-02", "valuetype extra { public long number; };"),
    "untyped_values": ("R-12.1-02", "typedef any extra;"),
}
"""By the mutant's name: the requirement that it breaks, and what it declares besides."""

ALSO: dict[str, tuple[str, ...]] = {
    "unsigned_short_is_short": ("R-12.4.1.2-04",),
    "refined_type_forgotten": ("R-12.8.4-04",),
    "component_is_another_component": ("R-12.8.1-02",),
    "body_without_its_type": ("R-12.8.4-04",),
    "port_element_interface_renamed": ("R-12.6-03",),
    "connector_port_is_an_operation": ("R-12.9-02",),
    "policy_getter_without_its_element": ("R-12.1-03",),
}
"""What the same defect breaks besides."""

NATIVES = ("native-types=supported",)
DEFAULTS = ("idl-attribute-defaults=annotated",)

DECLARES: dict[str, tuple[str, ...]] = {
    "values_forgotten": ("idl-enumerator-values=observed",),
    "values_counted_from_one": ("idl-enumerator-values=observed",),
    "native_is_octet": NATIVES,
    "native_without_footprint": NATIVES,
    "footprint_of_another_size": NATIVES,
    "footprint_called_otherwise": NATIVES,
    "another_default": DEFAULTS,
    "attribute_default_forgotten": DEFAULTS,
    "value_called_otherwise": DEFAULTS,
    "values_by_position_only": ("idl-enumerator-values=default-value",),
    "read_attribute_can_be_written": ("idl-interface-attributes=attributes",),
    "interface_attributes_forgotten": ("idl-interface-attributes=attributes",),
    "unsigned_long_long_is_unsigned_long": ("idl-ulonglong=unsigned-long-long",),
    "boolean_as_the_table_prints_it": ("idl-boolean=boolean",),
    "default_index_not_told": ("index-annotations=always",),
    "policy_getter_called_after_its_definition": ("idl-policy-getters=instance",),
    "parameter_with_one_capital": ("idl-template-names=upper",),
    "parameter_renamed": ("idl-parameter-names=kept",),
    "hyphen_left_out": ("idl-hyphens=underscore",),
    "inner_parameter_not_handed_out": ("idl-template-propagation=containment",),
}
"""What such a tool chain claims, so that what it does is wrong."""

PROMISES = {
    "R-12.10": ("idl-standard-files=generated",),
    "R-12.11": ("standard-idl=printed-with-timers",),
    "R-14-04": NATIVES,
    "R-14-05": (),
}
"""What a tool chain claims that generates what clause 12 prints."""

replace_each(REPLACED, also=ALSO, declares=DECLARES)
replace_each(PRINTED, STANDARD, declares={name: PROMISES[row[0][:7]] for name, row in PRINTED.items()})
for _name, (_requirement, _text) in APPENDED.items():
    breaks(_requirement, task="idl")(named(appended(_text), _name))


@breaks("R-12.7-02", "R-12.7-03", "R-12.7-06", task="idl", also=("R-12.7-04", "R-12.7-05"))
def generates_what_no_compiler_sees(program: Program) -> Program:
    """All that follows from the model stands in a branch that is never taken."""
    begin = "\n#ifdef NEVER_DEFINED\n"
    return rewritten(program, lambda files: {**files, MODEL: f"{begin}{files[MODEL]}{GUARD}"})


@breaks("R-12.4.1-10", task="idl")
def bound_of_another_branch(program: Program) -> Program:
    """A macro has the right number where it does not count."""
    made = "\n#if defined(TEXT_BOUND) || 2 < 1\n#define BOUND 16\n#else\n#define BOUND 17\n#endif\n"
    program = replaced(r"string<16>", "string<BOUND>")(program)
    return rewritten(program, lambda files: {**files, MODEL: f"{made}{files[MODEL]}"})


@breaks("R-12.7-07", task="idl")
def declarations_at_the_root(program: Program) -> Program:
    """What stands in a module inside a component module is declared at the root."""
    program = replaced(r"( *)typedef boolean flag_t;", r"\1typedef long other_flag_t;")(program)
    return appended("typedef boolean flag_t;")(program)


@breaks("R-12.7-08", task="idl", also=("R-12.8.4-04", "R-12.1-03"))
def templates_are_plain_modules(program: Program) -> Program:
    """Abstract types are named like others, in modules without parameters."""
    program = replaced(r"(module [a-z_]+)<(?:typename|interface) \w+> \{", r"\1 {")(program)
    program = replaced(r" *module ::.*<.*> (\w+);\n", "")(program)
    return replaced(r"\b\w+_(message_api|stream_api|more_api|watching_api)::", r"::PortElementObject //")(program)


@breaks("R-12-01", task="idl")
def generates_nothing(program: Program) -> Program:
    """There is no file."""
    return rewritten(program, lambda files: {})
