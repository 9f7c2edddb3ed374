"""Tool chains whose C++ has all that it should have, but loses values, or holds more than the mapping allows."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.mutants.toolchain.rewriting import CPP03, CPP11, Edits, Wrong, register

_POINT = r"(class point_t \{\n  public:\n)"
_FIGURE = r"(class figure_t \{\n  public:\n)"
_COPIED = "    {0}(const {0}& other) {1}\n    {0}& operator=(const {0}& other) {2}\n"


def _copying(opening: str, name: str, copied: str, assigned: str) -> Edits:
    return {opening: r"\1" + _COPIED.format(name, copied, assigned)}


_SETTERS = {
    "read_only_is_read_into": "::interfaces::text_t&",
    "read_only_is_written_from_anywhere": "const void*",
    "read_only_is_written_as_characters": "const char*",
    "read_only_is_written_as_something": "const ::interfaces::record_t&",
}
register(
    "interfaces",
    {
        name: Wrong(
            "R-13.5-05",
            {r"(    virtual ::interfaces::text_t name\(\) = 0;\n)": rf"\1    virtual void name({taken}) {{}}\n"},
        )
        for name, taken in _SETTERS.items()
    },
)


_ARRAYS = {
    "constant_arrays_do_not_look": {
        r"(const_reference at\(size_type index\) const \{ return elements)\[checked\(index\)\]": r"\1[index]"
    },
    "ends_exchanged": {
        r"(    reference front\(\) \{ return elements)\[0\]": r"\1[N - 1]",
        r"(    reference back\(\) \{ return elements)\[N - 1\]": r"\1[0]",
    },
    "ends_compared_alone": {
        r"return ::std::equal\(left\.begin\(\), left\.end\(\), right\.begin\(\)\);": "return left[0] == right[0] && left[N - 1] == right[N - 1];"
    },
    "ends_filled_alone": {r"::std::fill\(begin\(\), end\(\), value\)": "elements[0] = value; elements[N - 1] = value"},
    "beginnings_exchanged_alone": {
        r"::std::swap_ranges\(begin\(\), end\(\), other\.begin\(\)\)": "::std::swap(elements[0], other.elements[0])"
    },
    "no_end_in_reverse": {r"    (?:const_)?reverse_iterator rend\(\)[^\n]*\n": ""},
}
_REFERENCES = {
    "reference_lost_to_itself": {
        r"(    shared_ptr& operator=\(const shared_ptr& other\) \{\n)        shared_ptr\(other\)\.swap\(\*this\);": (
            r"\1        if (count_) { count_->remove(); }\n        object_ = other.object_;\n"
            r"        count_ = other.count_;\n        add();"
        )
    },
    "reference_not_assigned_to_base": {
        r"    template <class Y>\n    shared_ptr& operator=\(const shared_ptr<Y>& other\) \{.*?\n    \}\n": "",
        r"    template <class Y>\n(    shared_ptr\(const shared_ptr<Y>& other\) :)": r"    template <class Y>\n    explicit\n\1",
    },
}
register("data_types", {name: Wrong("R-13.10.1-02", edits, tasks=CPP03) for name, edits in _ARRAYS.items()})
register("interfaces", {name: Wrong("R-13.10.3-02", edits, tasks=CPP03) for name, edits in _REFERENCES.items()})

_WRAPPED = "template <class T> struct wrap : public T {{}};\nnamespace {0} {{ class {1} {{}}; }}\n"
DATA_TYPES: Mapping[str, Wrong] = {
    "copy_of_structure_is_empty": Wrong(
        "R-13.2.1-02",
        _copying(
            _POINT, "point_t", ": stored_x(), stored_y(), stored_shape(), stored_label() { (void)other; }", "= default;"
        ),
        tasks=CPP11,
    ),
    "structure_keeps_what_it_had": Wrong(
        "R-13.2.1-02",
        {
            _POINT: r"\1    point_t(const point_t&) = default;\n    point_t& operator=(const point_t&) { return *this; }\n"
        },
        tasks=CPP11,
    ),
    "assigned_structure_keeps_what_it_had": Wrong(
        "R-13.2.1-02", {_POINT: r"\1    point_t& operator=(const point_t&) { return *this; }\n"}, tasks=CPP03
    ),
    "assigned_union_keeps_what_it_had": Wrong(
        "R-13.2.2-02", {_FIGURE: r"\1    figure_t& operator=(const figure_t&) { return *this; }\n"}, tasks=CPP03
    ),
    "copy_of_union_is_empty": Wrong(
        "R-13.2.2-02",
        {
            _FIGURE: r"\1    figure_t(const figure_t&) : figure_t() {}\n    figure_t& operator=(const figure_t&) = default;\n"
        },
        tasks=CPP11,
    ),
    "case_unselected_by_reading": Wrong(
        "R-13.2.2-04",
        {r"(::data_types::distance_t& side\(\) \{) ": r"\1 stored_selector = ::data_types::shape_t::triangle; "},
    ),
    "safe_enum_without_default": Wrong(
        "R-13.10.2-04", {r"typename inner = typename def::type>": "typename inner>"}, tasks=CPP03
    ),
    "underlying_is_for_variables": Wrong(
        "R-13.10.2-07", {r"inner underlying\(\) const": "inner underlying()"}, tasks=CPP03
    ),
    "one_enumerator_more": Wrong(
        "R-13.2.3-02", {r"circle = 30\n": "circle = 30,\n        pentagon = 40\n"}, tasks=CPP11
    ),
    "one_safe_enumerator_more": Wrong(
        "R-13.10.2-02", {r"circle = 30\n": "circle = 30,\n        pentagon = 40\n"}, tasks=CPP03
    ),
}
register("data_types", DATA_TYPES)
INTERFACES: Mapping[str, Wrong] = {
    "exception_arrives_empty": Wrong(
        "R-13.4-01 R-13.4-08",
        {r"refused\(const refused&\) = default;": "refused(const refused&) : refused() {}"},
        tasks=CPP11,
    ),
    "system_exceptions_are_the_users": Wrong(
        "R-13.4-05", {r"class SystemException : public Exception": "class SystemException : public UserException"}
    ),
    "user_exceptions_are_the_systems": Wrong(
        "R-13.4-05",
        {
            r"(/// Root of the exceptions that models declare\.\nclass UserException : public )Exception( \{.*?\n\};\n)(.*?\n\};\n)": r"\3\1SystemException\2"
        },
    ),
    "repository_ids_are_overloaded": Wrong(
        "R-13.4-03",
        {
            r"(    virtual const char\* _name\(\) const = 0;)": r'    virtual const char* rep_id() const { return ""; }\n    const char* rep_id(int) const { return ""; }\n\1'
        },
    ),
    "interfaces_wrap_corba": Wrong(
        "R-13-03",
        {
            r"namespace interfaces \{ \}\n": _WRAPPED.format("CORBA", "Object") + "namespace interfaces { }\n",
            r"class Abstract_root \{": "class Abstract_root : public virtual wrap< ::CORBA::Object> {",
        },
    ),
    "interfaces_are_of_another_corba": Wrong(
        "R-13-03",
        {
            r"namespace interfaces \{ \}\n": "namespace version { namespace CORBA { class Object {}; } }\nnamespace interfaces { }\n",
            r"class Abstract_root \{": "class Abstract_root : public virtual ::version::CORBA::Object {",
        },
    ),
    "exceptions_wrap_corba": Wrong(
        "R-13.4-06",
        {
            r"namespace UCM \{\n": _WRAPPED.format("CORBA", "UserException") + "namespace UCM {\n",
            r"class UserException : public Exception \{": "class UserException : public Exception, public wrap< ::CORBA::UserException> {",
        },
    ),
}
register("interfaces", INTERFACES)
BINDINGS: Mapping[str, Wrong] = {
    "port_elements_inherit_an_operation": Wrong(
        "R-13.8-03",
        {
            r"class PortElementObject \{": (
                "class Pinged {\n  public:\n    virtual ~Pinged() {}\n    virtual void ping() {}\n};\n"
                "class PortElementObject : public Pinged {"
            )
        },
    )
}
register("bindings", BINDINGS)
