"""C++ that all probes use, valid in both standards. It does not depend on the headers under test."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ucm_cts.harness.toolchains.cpp.probes.keywords import without_macros

MOST_PARAMETERS = 8
"""The most parameters of a function that probes check."""


def taken_first() -> str:
    """The text that comes before the headers: types of fixed width as the compiler knows them, before any header names them."""
    return "\n".join(f"#ifdef {macro}\ntypedef {macro} ucts_{name};\n#endif" for name, macro in _WIDTHS.items())


def names_in(text: str) -> set[str]:
    """All words of ``text`` that a macro could be called like, but for those that may be macros."""
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r'"(?:\\.|[^"\\])*"|//.*', "", text))) - _NOT_OURS


def prelude(modern: bool, names: Iterable[str] = ()) -> str:
    """The text that comes after the headers and before the checks; neither its names nor ``names`` are macros after it, even if
    one of the headers is called like a standard one.
    """
    typed = "decltype(e)" if modern else "__typeof__(e)"
    standard = "#include <cstdint>\n#include <array>\n#include <memory>\n" if modern else "#include <stdint.h>\n"
    tools = f"{_TOOLS}{_widths()}{_signatures()}{_RUNNING}"
    own = {*names_in(tools), *names, "UCTS_TYPE", "main"}
    cleared = without_macros("cpp11" if modern else "cpp03", own)
    return f"{cleared}{_INCLUDES}{standard}{cleared}#define UCTS_TYPE(e) {typed}\n{tools}"


_NOT_OURS = {"ref", "PortConnection", "PortElementObject", "Abstract_PortElementObject", "FILE"}
"""Names that the headers declare, in any way, and names that may be macros of the standard library."""


_WIDTHS = {f"{u}int{w}_t": f"__{u.upper()}INT{w}_TYPE__" for u in ("", "u") for w in (8, 16, 32, 64)}
"""Types of fixed width, and what compilers that have such a macro call them."""


def _widths() -> str:
    """Lines that the compiler refuses if a header has made another type of one of fixed width."""
    return "".join(
        f"#ifdef {macro}\ntypedef ::ucts::one_of< ::{name}, ::ucts_{name}>::yes {name}_is_taken_first;\n#endif\n"
        for name, macro in _WIDTHS.items()
    )


_INCLUDES = """\
#include <cstddef>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>
"""

_TOOLS = """\
namespace ucts {
typedef char yes_type;
struct no_type { char two[2]; };
template <bool Condition> struct holds {};
template <> struct holds<true> { typedef int yes; };
template <class A, class B> struct same { enum { value = 0 }; };
template <class A> struct same<A, A> { enum { value = 1 }; };
template <int N> struct none {};
template <class A, class B, class C = none<0>, class D = none<0>, class E = none<0> > struct one_of
    : holds<same<A, B>::value || same<A, C>::value || same<A, D>::value || same<A, E>::value> {};
template <class A> struct bare { typedef A type; };
template <class A> struct bare<const A> { typedef A type; };
template <class A> struct bare<A&> { typedef typename bare<A>::type type; };
template <class A> struct constant { enum { value = 0 }; };
template <class A> struct constant<const A> { enum { value = 1 }; };
template <class A> A& make();
template <class A> const typename bare<A>::type& slot_of();
template <class A> int accepts(A*);
template <class A> char (&constness(A&))[1 + constant<A>::value];
template <bool First, class A, class B> struct choose { typedef A type; };
template <class A, class B> struct choose<false, A, B> { typedef B type; };
template <class T> yes_type has_connection(typename T::PortConnection*);
template <class T> no_type has_connection(...);
template <class T> struct connection_base { typedef typename T::PortConnection type; };
template <template <class> class P, class A> int instance(P<A>*);
template <template <class, class> class P, class A, class B> int instance(P<A, B>*);
template <class A> struct by_constant { enum { value = 0 }; };
template <class A> struct by_constant<const A&> { enum { value = 1 }; };
template <int N> struct by_constant<none<N> > { enum { value = 1 }; };
yes_type becomes_int(int);
template <class T> yes_type is_unscoped(char (*)[sizeof(becomes_int(make<T>()))]);
template <class T> no_type is_unscoped(...);
"""

_RUNNING = """\
template <class P> struct pointee;
template <class S> struct target { typedef typename pointee<typename bare<typename S::result>::type>::type type; };
template <class S> struct inner { typedef typename pointee<typename bare<typename S::member>::type>::type type; };
template <class M> struct member_type { typedef M member; };
template <class C, class M> member_type<M> member_of(M C::*);

namespace {
bool broken = false;
int current = 0;
const char* token = "";
::std::FILE* results = 0;
}
struct failed {};
inline void tell(const char* word, const char* what) {
    ::std::fprintf(results, "%s %s %d %.200s\\n", token, word, current, what);
    ::std::fflush(results);
}
inline void require(bool condition, const char* what) {
    if (!condition) {
        broken = true;
        tell("broken", what);  // decides; the exception only ends the check, and runs code of the headers on its way
        throw failed();
    }
}
inline bool operator==(const ::std::string& a, const ::std::string& b) { return a.compare(b) == 0; }
inline bool operator==(const ::std::string& a, const char* b) { return a.compare(b) == 0; }
inline bool operator==(const ::std::wstring& a, const ::std::wstring& b) { return a.compare(b) == 0; }
inline bool operator==(const ::std::wstring& a, const wchar_t* b) { return a.compare(b) == 0; }
template <class C> struct slot { static C* value; };
template <class C> C* slot<C>::value = 0;
template <class C> struct kept { static C* value; };
template <class C> C* kept<C>::value = 0;
template <class C> void keep(const C& connection) {
    delete kept<C>::value;
    kept<C>::value = new C(connection);
}
template <class C> void keep_if_connection(const C& connection) { keep(connection); }
template <int N> void keep_if_connection(const none<N>&) {}
template <class C, class M, class O> C* unconnected(M O::*) { return new C(::std::string(), M()); }
template <class A> const typename bare<A>::type& slot_of() {
    typedef typename bare<A>::type C;
    if (slot<C>::value == 0) {
        slot<C>::value = unconnected<C>(&C::ref);
    }
    return *slot<C>::value;
}
template <class S, class E> void bounded(const E& element, ::std::size_t most) {
    S sequence;
    require(sequence.size() == 0, "it has elements when it is new");
    for (::std::size_t i = 0; i < most; ++i) {
        sequence.push_back(element);
    }
    require(sequence.size() == most, "it does not hold as many elements as the model says");
    try {
        sequence.push_back(element);
    } catch (...) {
    }
    require(sequence.size() == most, "it holds more elements than the model says");
}
inline bool began(const char* path, const char* word) {
    results = ::std::fopen(path, "w");
    token = word;
    return results != 0;
}
inline void run(int number, void (*check)()) {
    current = number;
    broken = false;
    tell("begin", "");
    try {
        check();
        tell(broken ? "over" : "kept", "");
        return;
    } catch (const failed&) {
        tell("over", "");
        return;
    } catch (const ::std::exception& exception) {
        tell("broken", (::std::string("an exception came out: ") + exception.what()).c_str());
    } catch (...) {
        tell("broken", "an exception came out");
    }
    tell("over", "");
}
inline int ended() {
    current = 0;
    tell("end", "");
    return ::std::fclose(results);
}
}  // namespace ucts
"""


def _signatures() -> str:
    """What member functions of up to ``MOST_PARAMETERS`` parameters look like, and how a component is started with them."""
    text = ["template <class F> struct signature;"]
    for count in range(MOST_PARAMETERS + 1):
        classes = "".join(f", class A{i}" for i in range(1, count + 1))
        taken = ", ".join(f"A{i}" for i in range(1, count + 1))
        named = "".join(
            f" typedef {f'A{i}' if i <= count else f'none<{i}>'} a{i};" for i in range(1, MOST_PARAMETERS + 1)
        )
        given = ", ".join(f"slot_of<A{i}>()" for i in range(1, count + 1))
        alike = " + ".join(["0", *(f"same<A{i}, const C&>::value" for i in range(1, count + 1))])
        text.append(
            f"template <class R, class C{classes}> struct signature<R (C::*)({taken})> "
            f"{{ typedef R result;{named} enum {{ arity = {count} }}; typedef R (C::*pointer)({taken}); }};\n"
            f"template <class R, class C{classes}> signature<R (C::*)({taken})> of_{count}(R (C::*)({taken}));\n"
            f"template <class R, class C{classes}> struct signature<R (C::*)({taken}) const> : signature<R (C::*)({taken})> {{}};\n"
            f"template <class R, class C{classes}> signature<R (C::*)({taken}) const>"
            f" of_constant_{count}(R (C::*)({taken}) const);\n"
            f"template <class C, class R, class O{classes}> char (&times(R (O::*)({taken})))[1 + {alike}];\n"
            f"template <class B, class C{classes}> void start(B& body, void (C::*startup)({taken})) "
            f"{{ (body.*startup)({given}); }}"
        )
    return "\n".join(text) + "\n"


SHARED_POINTERS = {"cpp11": "::std::shared_ptr", "cpp03": "::ucm::shared_ptr"}
"""The class template of references to interfaces."""

SHARED = "namespace ucts { template <class T> struct pointee<%s<T> > { typedef T type; }; }\n"

ARRAY = """\
namespace ucts { template <class A> struct array_of;
template <class T, ::std::size_t N> struct array_of< ::std::array<T, N> > { typedef T element; enum { size = N }; }; }
"""

_SIZES = [f"{sign}{integer}" for sign in ("", "unsigned ") for integer in ("short", "int", "long")]

UCM_ARRAY = "\n".join(
    [
        "namespace ucts { template <class A> struct array_of;",
        *(
            f"template <class T, {size} N> struct array_of< ::ucm::array<T, N> >"
            " { typedef T element; enum { size = N }; };"
            for size in _SIZES
        ),
        "}",
        "",
    ]
)
"""13.10.1 does not say of which type the size is; only what matches the vendor's template is ever chosen."""

SAFE_ENUM = """\
namespace ucts { template <class E> struct safe;
template <class D, class I> struct safe< ::ucm::safe_enum<D, I> > { typedef D definition; typedef I inner; }; }
"""

ARRAY_WORKS = """\
    typedef ::ucm::array<int, 3> A;
    A a = A(), b = A(), listed = {1, 2, 3};
    ::ucts::require(listed[0] == 1 && listed[2] == 3, "it is not made from a list of its elements");
    const A& c = a;
    for (::std::size_t i = 0; i < 3; ++i) { a[i] = static_cast<int>(i); }
    ::ucts::require(c.size() == 3 && c.max_size() == 3 && !c.empty(), "its size is not that of its type");
    ::ucts::require(c.front() == 0 && c.back() == 2 && c.at(1) == 1 && c[1] == 1, "elements are not found by index");
    ::ucts::require(c.data() == &c[0] && *c.begin() == 0 && c.end() - c.begin() == 3, "iterators do not cover its elements");
    ::ucts::require(*c.rbegin() == 2, "reverse iterators do not begin at the end");
    bool refused = false;
    try { a.at(3) = 1; } catch (const ::std::out_of_range&) { refused = true; }
    ::ucts::require(refused, "at() takes an index that is too great");
    refused = false;
    try { (void)c.at(3); } catch (const ::std::out_of_range&) { refused = true; }
    ::ucts::require(refused, "at() of a constant one takes an index that is too great");
    ::ucts::require(&a.front() == &a[0] && &a.back() == &a[2], "front() and back() are not its first and its last element");
    ::ucts::require(&a.at(1) == &a[1] && a.data() == &a[0], "elements are not found by index");
    ::ucts::require(a.end() - a.begin() == 3 && &*a.begin() == &a[0], "iterators do not cover its elements");
    ::ucts::require(a.rend() - a.rbegin() == 3 && &*(a.rend() - 1) == &a[0], "reverse iterators do not end at the beginning");
    ::ucts::require(c.rend() - c.rbegin() == 3 && &*(c.rend() - 1) == &c[0], "reverse iterators do not end at the beginning");
    b.fill(8);
    ::ucts::require(b[0] == 8 && b[1] == 8 && b[2] == 8, "fill() does not fill it");
    b.fill(0);
    A other = a;
    other[1] = 5;
    ::ucts::require(other != a && !(other == a) && a < other, "it is not compared element by element");
    ::ucts::require(b < a && a > b && b <= a && a >= b && a != b && !(a == b), "it is not compared element by element");
    b = a;
    ::ucts::require(a == b && !(a != b), "a copy is not equal");
    ::ucts::require(!(a < b) && !(a > b) && a <= b && a >= b, "one of two equal ones comes before the other");
    b[0] = 9;
    ::ucts::require(a[0] == 0, "a copy shares its elements");
    a.swap(b);
    ::ucts::require(a[0] == 9 && b[0] == 0, "swap() does not exchange the elements");
    a.swap(other);
    ::ucts::require(a[1] == 5 && other[1] == 1 && other[0] == 9, "swap() does not exchange the elements");
"""

SHARED_WORKS_TYPES = """\
struct base { static int alive; int value; base() : value(7) { ++alive; } ~base() { --alive; } };
int base::alive = 0;
struct derived : base { static int gone; ~derived() { ++gone; } };
int derived::gone = 0;
::ucts::yes_type becomes_one(const ::ucm::shared_ptr<base>&);
::ucts::no_type becomes_one(...);
"""

SHARED_WORKS = """\
    typedef ::ucm::shared_ptr<base> P;
    {
        P none;
        base* const bare = 0;
        const bool is_taken = sizeof(becomes_one(bare)) == sizeof(::ucts::yes_type);
        ::ucts::require(!is_taken, "a bare pointer becomes one without being asked to");
        ::ucts::require(!none && none.get() == 0 && none.use_count() == 0, "a new one is not null");
        P first(new base);
        ::ucts::require(first && first->value == 7 && (*first).value == 7, "it does not lead to its object");
        ::ucts::require(first.use_count() == 1, "one reference is not counted as one");
        P second(first);
        none = second;
        ::ucts::require(none.get() == first.get() && none == first && !(none != first), "copies do not lead to the same object");
        ::ucts::require(first.use_count() == 3, "copies are not counted");
        none.reset();
        second = P();
        ::ucts::require(first.use_count() == 1 && base::alive == 1, "references that are gone are counted");
        first.swap(second);
        ::ucts::require(!first && second, "swap() does not exchange the references");
        second.reset(new base);
        ::ucts::require(base::alive == 1, "reset() does not let go of the object");
        P& itself = second;
        second = itself;
        ::ucts::require(base::alive == 1 && second.use_count() == 1, "assigned to itself it is not what it was");
    }
    ::ucts::require(base::alive == 0, "the object is not deleted with its last reference");
    {
        ::ucm::shared_ptr<derived> made(new derived);
        const bool is_one = sizeof(becomes_one(made)) == sizeof(::ucts::yes_type);
        ::ucts::require(is_one, "a reference does not become one to a base unless it is asked to");
        P shared(made);
        made.reset();
        ::ucts::require(derived::gone == 0 && shared.use_count() == 1, "a reference to a base is not counted");
        ::ucm::shared_ptr<derived> again(new derived);
        P assigned;
        assigned = again;
        ::ucts::require(assigned.get() == again.get() && again.use_count() == 2, "a reference to a base is not assigned");
    }
    ::ucts::require(derived::gone == 2 && base::alive == 0, "an object is not deleted as what it was made");
"""
