"""The probe for a claim about C++: a piece of a translation unit, and its words."""

from __future__ import annotations

from ucm_cts.harness.toolchains.cpp.probes import text as txt
from ucm_cts.harness.toolchains.cpp.probes.data_types import of_enumerations, of_types
from ucm_cts.harness.toolchains.cpp.probes.overloads import found_function, ways_to, ways_to_startup
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Class, Connected, Returned


def _function(claim: claims.Arity | claims.Passed) -> str:
    found = found_function("found", claim.method, ways_to("found", claim.parameters, claim.forms))
    return f"{found} typedef found<{txt.class_text(claim.owner)} >::function function;"


def _startup(claim: claims.Startup) -> str:
    connections = [txt.connection_text(claim.owner, connection) for connection in claim.connections]
    ways = ways_to_startup("found", claim.least, claim.most, connections)
    return f"{found_function('found', 'on_startup', ways)} typedef found<{claim.owner}>::function function;"


def render(claim: claims.Claim) -> txt.Text | None:
    """The probe for ``claim``; None if no compiler can decide it."""
    return of_types(claim) or of_enumerations(claim) or _of_classes(claim) or _of_components(claim)


def _of_classes(claim: claims.Claim) -> txt.Text | None:
    match claim:
        case claims.Derives(derived, base):
            text = f"enum {{ found = sizeof(::ucts::accepts<{base} >(static_cast<{txt.class_text(derived)}*>(0))) }};"
            return txt.Text(f"{txt.class_words(derived)} derives publicly from {base}", text)
        case claims.NotDerived(derived, base):
            text = txt.holds(f"!__is_base_of({base}, {txt.class_text(derived)})")
            return txt.Text(f"{txt.class_words(derived)} does not derive from {base}", text)
        case claims.IsAbstract(name):
            return txt.Text(f"{txt.class_words(name)} is abstract", txt.holds(f"__is_abstract({txt.class_text(name)})"))
        case claims.NoMember(owner, member):
            return txt.Text(f"{txt.class_words(owner)} has no {member}", *_no_member(owner, member))
        case claims.Thrown(name, base):
            caught = f"bool caught = false; try {{ throw {name}(); }} catch (const {base}&) {{ caught = true; }}"
            return txt.Text(f"{name} is caught as {base}", run=f'{caught} ::ucts::require(caught, "it is not");')
        case claims.Pure(owner, key, method, parameters):
            at = f"{key}_lacks_{method}_{parameters}" if parameters >= 0 else f"{key}_lacks_{method}"
            text = txt.holds(f"__is_abstract(::ucts::{at}<{txt.class_text(owner)} >)")
            return txt.Text(f"{txt.class_words(owner)}::{method} is pure virtual", text, key=key, pure=True)
        case claims.Arity(owner, method, parameters, _):
            counted = f"{parameters or 'no'} parameter{'s' * (parameters != 1)}"
            says = f"{txt.class_words(owner)} has a function {method} with {counted}"
            return txt.Text(says, _function(claim), of_functions=True)
        case claims.Passed(owner, method, _, position, types, _):
            found = f"function::a{position}" if position else "function::result"
            what = f"parameter {position}" if position else "the result"
            says = f"{what} of {txt.class_words(owner)}::{method} is {txt.words(types)}"
            return txt.Text(says, f"{_function(claim)} {txt.one_of(found, types)}", of_functions=True)
        case claims.NoMutator(owner, method, type_):
            says = f"{txt.class_words(owner)} has no function that sets {method}"
            return txt.Text(says, _no_mutator(txt.class_text(owner), method, type_))
    return None


def _no_member(owner: Class, member: str) -> tuple[str]:
    """Found by its address, unless it is overloaded, or by a call."""
    declared = (
        f"template <class T> ::ucts::yes_type has(char (*)[sizeof(&T::{member})]);"
        " template <class T> ::ucts::no_type has(...);"
        f" template <class T> ::ucts::yes_type calls(char (*)[sizeof((::ucts::make<T>().{member}(), 0))]);"
        " template <class T> ::ucts::no_type calls(...);"
    )
    type_ = txt.class_text(owner)
    neither = (f"sizeof({how}<{type_}>(0)) == sizeof(::ucts::no_type)" for how in ("has", "calls"))
    return (f"{declared} {txt.holds(' && '.join(neither))}",)


_ANYTHING = (
    "struct any_value { template <class X> operator X() const; };"
    " struct any_variable { template <class X> operator X&() const; };"
)


def _no_mutator(owner: str, method: str, type_: str) -> str:
    """No call with one argument is understood, whatever that is: of several that take anything none is chosen."""
    given = (f"const {type_}", type_, "const char* const", "const void* const", "const int", "const any_value")
    text, absent = _ANYTHING, []
    for number, argument in enumerate((*given, "const any_variable")):
        text += (
            f" template <class T> ::ucts::yes_type takes_{number}(char (*)[sizeof((::ucts::make<T>().{method}("
            f"::ucts::make<{argument} >()), 0))]); template <class T> ::ucts::no_type takes_{number}(...);"
        )
        absent.append(f"sizeof(takes_{number}<{owner} >(0)) == sizeof(::ucts::no_type)")
    return f"{text} {txt.holds(' && '.join(absent))}"


def _of_components(claim: claims.Claim) -> txt.Text | None:
    match claim:
        case claims.DeclaresConnection(owner, connection):
            return txt.Text(
                f"a type {connection} for {owner}", f"typedef {txt.connection_text(owner, connection)} found;"
            )
        case claims.ConnectionTemplate(owner, connection):
            type_ = txt.connection_text(owner, connection)
            named = txt.holds(f"sizeof(::ucts::has_connection<{type_}>(0)) == sizeof(::ucts::yes_type)")
            instance = f"enum {{ is_made = sizeof(::ucts::instance(static_cast< ::ucts::connection_base<{type_}>::type*>(0))) }};"
            return txt.Text(f"{connection} is an instance of a template PortConnection", f"{named} {instance}")
        case claims.ConnectionShape(owner, connection):
            type_ = txt.connection_text(owner, connection)
            text = f"typedef UCTS_TYPE(::ucts::member_of(&{type_}::port_name)) name; {txt.one_of('name::member', ['::std::string'])}"
            reference = f"typedef UCTS_TYPE(::ucts::member_of(&{type_}::ref)) reference;"
            made = f'{type_} connection(::std::string("name"), reference::member()); '
            made += '::ucts::require(connection.port_name == "name", "port_name is not what it was made of");'
            says = f"{connection} has a std::string port_name and a reference ref and is made of both"
            return txt.Text(says, f"{text} {reference} typedef ::ucts::inner<reference>::type pointee;", made)
        case claims.ConnectionTo(owner, connection, interface):
            type_ = txt.class_text(Connected(owner, connection))
            if not interface:
                return txt.Text(f"{connection} refers to the actual interface", f"typedef {type_} found;")
            text = f"enum {{ found = sizeof(::ucts::accepts<{interface} >(static_cast<{type_}*>(0))) }};"
            return txt.Text(f"{connection} refers to {interface}", text)
        case claims.Startup(owner, least, most, _):
            text = f"{_startup(claim)} {txt.one_of('function::result', ['void'])}"
            text += f" typedef ::ucts::holds<(function::arity >= {least} && function::arity <= {most})>::yes counted;"
            constant = " && ".join(f"::ucts::by_constant<function::a{i}>::value" for i in range(1, most + 1))
            text += f" typedef ::ucts::holds<({constant or 'true'})>::yes constant;"
            counted = f"{least}" if least == most else f"{least} to {most}"
            says = f"{owner}::on_startup takes {counted} constant references to connections"
            return txt.Text(says, text, of_functions=True)
        case claims.StartupTakes(owner, connection, startup):
            type_ = txt.connection_text(owner, connection)
            alike = [f"::ucts::same<{txt.connection_text(owner, c)}, {type_}>::value" for c in startup.connections]
            taken = [f"::ucts::same<function::a{i}, const {type_}&>::value" for i in range(1, startup.most + 1)]
            text = f"{_startup(startup)} {txt.holds(' + '.join(taken) + ' == ' + ' + '.join(alike))}"
            says = f"{owner}::on_startup takes const {connection}& as often as there are connections of this type"
            return txt.Text(says, text, of_functions=True)
        case claims.ReturnsReference(owner, getter, interface):
            type_ = txt.class_text(Returned(owner, getter))
            if not interface:
                return txt.Text(
                    f"{owner}::{getter} returns a shared pointer", f"typedef {type_} found;", of_functions=True
                )
            text = f"enum {{ found = sizeof(::ucts::accepts<{interface} >(static_cast<{type_}*>(0))) }};"
            return txt.Text(f"{owner}::{getter} returns a shared pointer to {interface}", text, of_functions=True)
    return None
