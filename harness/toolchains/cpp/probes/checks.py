"""A claim about C++ as a piece of a translation unit, and as words."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ucm_cts.harness.toolchains.cpp.probes.overloads import found_function, ways_to, ways_to_startup
from ucm_cts.harness.toolchains.cpp.probes.prelude import ARRAY_WORKS, SHARED_WORKS, SHARED_WORKS_TYPES
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Class, Connected, Named, Returned, Sample

Support = str
"""What of the framework's own class templates a check needs: ``shared_ptr``, ``array`` or ``safe_enum``."""


@dataclass(frozen=True)
class Text:
    """``declared`` stands at the outermost level, ``run`` in a function that ``ucts::require`` ends; ``says`` is what must hold.

    ``key`` names the implementation that it needs, ``of_functions`` is whether a function is looked at, ``judged_last`` that it
    says something only if all functions are as they should be, and ``pure`` that it does so only if the class can be implemented.
    """

    says: str
    declared: str = ""
    run: str = ""
    key: str = ""
    of_functions: bool = False
    judged_last: bool = False
    pure: bool = False


def class_text(owner: Class) -> str:
    """How C++ reaches a class."""
    match owner:
        case Named(name):
            return name
        case Returned(class_name, getter):
            return f"::ucts::target<UCTS_TYPE(::ucts::of_0(&{class_name}::{getter}))>::type"
        case Connected(class_name, connection):
            return f"::ucts::inner<UCTS_TYPE(::ucts::member_of(&{connection_text(class_name, connection)}::ref))>::type"
    raise AssertionError(owner)


def class_words(owner: Class) -> str:
    """What a class is called in messages."""
    match owner:
        case Named(name):
            return name
        case Returned(class_name, getter):
            return f"the class that {class_name}::{getter}() returns a reference to"
        case Connected(_, connection):
            return f"the class that {connection} refers to"
    raise AssertionError(owner)


def connection_text(owner: str, connection: str) -> str:
    """The name that ``connection_declared`` gives to a connection type."""
    return f"{_helper(owner, connection)}::type"


def _helper(owner: str, connection: str) -> str:
    place, _, name = owner.rpartition("::")
    return f"{place}::ucts_{name}_{connection}"


def connection_declared(owner: str, connection: str) -> str:
    """Looks ``connection`` up inside the class ``owner``, so that it is found in the class or around it."""
    place, _, name = _helper(owner, connection).rpartition("::")
    parts = [part for part in place.split("::") if part]
    opened = " ".join(f"namespace {part} {{" for part in parts)
    return f"{opened} struct {name} : {owner} {{ typedef {connection} type; }}; {'}' * len(parts)}"


def connection_missing(owner: str, connection: str) -> str:
    """What ``connection_text`` names where there is no such type, so that texts that name it are understood."""
    place, _, name = _helper(owner, connection).rpartition("::")
    parts = [part for part in place.split("::") if part]
    opened = " ".join(f"namespace {part} {{" for part in parts)
    return f"{opened} struct {name} {{ struct type; }}; {'}' * len(parts)}"


def _holds(condition: str) -> str:
    return f"typedef ::ucts::holds<({condition})>::yes checked;"


def _one_of(type_: str, types: Iterable[str]) -> str:
    return f"typedef ::ucts::one_of<{type_}, {', '.join(types)} >::yes checked;"


def _words(types: Iterable[str]) -> str:
    return " or ".join(type_.replace("< ", "<").replace(" >", ">") for type_ in types)


def _function(claim: claims.Arity | claims.Passed) -> str:
    found = found_function("found", claim.method, ways_to("found", claim.parameters, claim.forms))
    return f"{found} typedef found<{class_text(claim.owner)} >::function function;"


def _startup(claim: claims.Startup) -> str:
    connections = [connection_text(claim.owner, connection) for connection in claim.connections]
    ways = ways_to_startup("found", claim.least, claim.most, connections)
    return f"{found_function('found', 'on_startup', ways)} typedef found<{claim.owner}>::function function;"


def render(claim: claims.Claim) -> Text | None:
    """The probe for ``claim``; None if no compiler can decide it."""
    return _of_types(claim) or _of_enumerations(claim) or _of_classes(claim) or _of_components(claim)


def _of_types(claim: claims.Claim) -> Text | None:
    match claim:
        case claims.Namespace(name):
            return Text(f"a namespace {name}", f"namespace found = {name};")
        case claims.Declares(name):
            return Text(f"a type {name}", f"typedef {name} found;")
        case claims.Is(name, types):
            return Text(f"{name} is {_words(types)}", _one_of(name, types))
        case claims.ArrayOf(name, template, element, depth):
            inner = name
            for _ in range(depth):
                inner = f"::ucts::array_of<{inner}>::element"
            nested = " of ".join([template] * depth)
            return Text(f"{name} is {nested} of {element}", _one_of(inner, [element]))
        case claims.Sizes(name, sizes):
            return Text(f"{name} has {' times '.join(map(str, sizes))} elements", _sizes(name, sizes))
        case claims.BoundedSequence():
            return _bounded_sequence(claim)
        case claims.IsClass(name):
            return Text(f"{name} is a class", _holds(f"__is_class({name})"))
        case claims.Regular(name):
            copied = f"{name} first = {name}(); {name} second(first); second = first; (void)second;"
            return Text(f"{name} can be made without arguments, copied and assigned", run=copied)
        case claims.Field():
            return _field(claim)
        case claims.Copied():
            return _copied(claim)
        case claims.Discriminator():
            return _discriminator(claim)
        case claims.IsConstant(name):
            return Text(f"{name} is constant", _holds(f"sizeof(::ucts::constness({name})) == 2"))
        case claims.ConstantIs(name, type_, value):
            text = _one_of(f"::ucts::bare<UCTS_TYPE({name})>::type", [type_])
            return Text(f"{name} is {value}", text, f'::ucts::require({name} == {value}, "it has another value");')
    return None


def _sizes(name: str, sizes: tuple[int, ...]) -> str:
    inner, conditions = name, []
    for size in sizes:
        array = f"::ucts::array_of<{inner}>"
        conditions.append(f"{array}::size == {size}")
        inner = f"{array}::element"
    return _holds(" && ".join(conditions))


def _bounded_sequence(claim: claims.BoundedSequence) -> Text:
    name, element, size = claim.name, claim.element.type, claim.size
    array = f"{claim.array}< {element}, {size} >"
    shapes = {"array": array, "bounded-vector": f"a vector of at most {size} elements of {element}"}
    says = f"{name} is {_words(shapes[form] for form in claim.forms)}"
    if claim.forms == ("array",):
        return Text(says, _one_of(name, [array]))
    vector = "template <class S> struct vector_like {{ static void look() {{ {} }} }};".format(
        f'::ucts::require(!::ucts::same<S, ::std::vector< {element} > >::value, "it is a plain vector, which has no bound");'
        f" ::ucts::bounded<S, {element} >({claim.element.first}, {size});"
    )
    if "array" in claim.forms:
        vector += f" template <> struct vector_like< {array} > {{ static void look() {{}} }};"
    return Text(says, vector, f"vector_like<{name}>::look();")


def _same(sample: Sample, read: str, value: str, message: str) -> str:
    return f'::ucts::require({read} == {value}, "{message}");' if sample.comparable else f"(void)({read});"


def _dispatch(
    field: str, sample: Sample, forms: tuple[claims.StructForm, ...], look: dict[str, str]
) -> tuple[str, str]:
    """Declares ``look_at``, which does what ``look`` says for the form that the field has."""
    if len(forms) == 1:
        return (
            f"template <class T, class V> void look_at(T& object, const V& value) {{ {look[forms[0]]} }}",
            "object, value",
        )
    return (
        "struct by_call {}; struct by_name {};"
        f" template <class T> ::ucts::yes_type form(char (*)[sizeof((::ucts::make<T>().{field}("
        f"::ucts::make<const {sample.type}>()), 0))]);"
        " template <class T> ::ucts::no_type form(...);"
        f" template <class T, class V> void look_at(T& object, const V& value, by_call) {{ {look['accessors']} }}"
        f" template <class T, class V> void look_at(T& object, const V& value, by_name) {{ {look['plain']} }}"
    ), "object, value, chosen()"


def _chosen(owner: str, forms: tuple[claims.StructForm, ...]) -> str:
    if len(forms) == 1:
        return ""
    return (
        f"typedef ::ucts::choose<sizeof(form<{owner}>(0)) == sizeof(::ucts::yes_type), by_call, by_name>::type chosen; "
    )


def _field(claim: claims.Field) -> Text:
    owner, field, sample = claim.owner, claim.field, claim.sample
    look = {}
    for form, write, read in (
        ("accessors", f"object.{field}(value);", f"object.{field}()"),
        ("plain", f"object.{field} = value;", f"object.{field}"),
    ):
        exact = f"typedef typename ::ucts::one_of<typename ::ucts::bare<UCTS_TYPE({read})>::type, V>::yes checked;"
        kept = _same(sample, read, "value", "it does not keep what is written to it")
        look[form] = f"{write} {exact} {kept}"
    declared, arguments = _dispatch(field, sample, claim.forms, look)
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; look_at({arguments});"
    return Text(f"{owner} has a field {field} of type {sample.type} that is written and read", declared, run)


def _copied(claim: claims.Copied) -> Text:
    owner, field, sample = claim.owner, claim.field, claim.sample
    look = {}
    for form, write, call in (
        ("accessors", f"object.{field}(value);", "()"),
        ("plain", f"object.{field} = value;", ""),
    ):
        read = f"{field}{call}"
        caught = f"T& caught) {{ {_same(sample, f'caught.{read}', 'value', 'what is caught has lost it')}"
        copies = "T copy(object); T assigned; assigned = object; "
        copies += _same(sample, f"copy.{read}", "value", "a copy has lost it")
        copies += _same(sample, f"assigned.{read}", "value", "what it is assigned to has lost it")
        look[form] = f"{write} {f'try {{ throw object; }} catch ({caught} }}' if claim.thrown else copies}"
    declared, arguments = _dispatch(field, sample, claim.forms, look)
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; look_at({arguments});"
    kept = "thrown and caught" if claim.thrown else "copied and assigned"
    return Text(f"{owner} is {kept} with its field {field}", declared, run)


def _discriminator(claim: claims.Discriminator) -> Text:
    """The selector is found under one of several names, the first of which that is there counts."""
    owner, sample = claim.owner, claim.sample
    candidates = [f"{f}()" for f in claim.functions] + list(claim.functions) * ("plain" in claim.forms)
    selector = claim.values[0].rpartition("::")[0]
    found = "template <int Position> struct reader;"
    for position, candidate in enumerate(candidates):
        found += (
            f" template <class T> ::ucts::yes_type has_{position}(char (*)[sizeof(::ucts::make<T>().{candidate})]);"
            f" template <class T> ::ucts::no_type has_{position}(...); template <> struct reader<{position}>"
            f" {{ template <class T> static {selector} read(T& object) {{ return object.{candidate}; }} }};"
        )
    index = str(len(candidates) - 1)
    for position in range(len(candidates) - 2, -1, -1):
        index = f"(sizeof(has_{position}<{owner}>(0)) == sizeof(::ucts::yes_type) ? {position} : {index})"
    chosen = " || ".join(f"selector == {value}" for value in claim.values)
    selected = f"const {selector} selector = at::read(object); "
    judged = f'{selected}::ucts::require({chosen}, "the selector does not say which case was written");'
    reading = '"the selector says something else once the case was read"'
    again = f"(void)object.{claim.case}(); {{ {selected}::ucts::require({chosen}, {reading}); }}"
    typed = f"enum {{ which = {index} }}; typedef reader<which> at;"
    look = {
        "accessors": f"object.{claim.case}(value); {judged} {again}",
        "plain": f"(void)value; {selected}(void)selector;",
    }
    declared, arguments = _dispatch(claim.case, sample, claim.forms, look)
    declared = f"{found} {typed} {declared}"
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; look_at({arguments});"
    return Text(f"writing {claim.case} makes the selector of {owner} {_words(claim.values)}", declared, run)


def _of_enumerations(claim: claims.Claim) -> Text | None:
    match claim:
        case claims.EnumForm(name, forms):
            text = _holds(f"__is_enum({name})")
            if len(forms) == 1:
                sign = "==" if forms[0] == "enum" else "!="
                unscoped = f"sizeof(::ucts::is_unscoped<{name}>(0)) {sign} sizeof(::ucts::yes_type)"
                text = _holds(f"__is_enum({name}) && {unscoped}")
            return Text(f"{name} is an {_words(forms).replace('-', ' ')}", text)
        case claims.Underlying(name, types):
            return Text(f"{name} is stored as {_words(types)}", _one_of(f"__underlying_type({name})", types))
        case claims.EnumeratorOf(owner, enumerator, type_):
            found = f"::ucts::bare<UCTS_TYPE({owner}::{enumerator})>::type"
            return Text(f"{owner}::{enumerator} is an enumerator of {type_}", _one_of(found, [type_]))
        case claims.EnumeratorValue(owner, enumerator, value):
            text = _holds(f"static_cast<long>({owner}::{enumerator}) == {value}")
            return Text(f"{owner}::{enumerator} is {value}", text)
        case claims.SafeEnum(name, definition):
            text = _one_of(f"::ucts::safe<{name}>::definition", [definition])
            return Text(f"{name} is ucm::safe_enum of {definition}", text)
        case claims.SafeEnumInner(name, types):
            return Text(f"{name} keeps its value as {_words(types)}", _one_of(f"::ucts::safe<{name}>::inner", types))
        case claims.Works():
            return _works(claim)
    return None


def _works(claim: claims.Works) -> Text:
    type_ = claim.types[0]
    match claim.subject:
        case "safe-enum-construction":
            first, second = claim.values
            run = f"{type_} one = {first}; {type_} other({second}); one = other; (void)one;"
            return Text(f"{type_} is made of its enumerators", run=run)
        case "safe-enum-underlying":
            first, second, number, other = claim.values
            message = '"underlying() does not return the value"'
            run = "".join(
                f"{{ const {type_} made({v}); ::ucts::require(made.underlying() == {n}, {message}); }} "
                for v, n in ((first, number), (second, other))
            )
            return Text(f"underlying() returns the value of {type_}", run=run)
        case "safe-enum-default":
            alone, named = f"::ucm::safe_enum<{type_}>", f"::ucm::safe_enum<{type_}, {type_}::type>"
            return Text(f"ucm::safe_enum of {type_} alone keeps its enumerators", _one_of(alone, [named]))
        case "safe-enum-comparison":
            return _comparison(type_, claim.detail, claim.values)
        case "array":
            return Text("ucm::array has the semantics of std::array", run=ARRAY_WORKS)
    return Text("ucm::shared_ptr has the semantics of std::shared_ptr", SHARED_WORKS_TYPES, SHARED_WORKS)


def _comparison(type_: str, operator: str, values: tuple[str, ...]) -> Text:
    less, greater = values
    truth = {"==": (0, 0, 1), "!=": (1, 1, 0), "<": (1, 0, 0), "<=": (1, 0, 1), ">": (0, 1, 0), ">=": (0, 1, 1)}
    run = f"const {type_} less = {less}, greater = {greater}; "
    for pair, holds in zip((("less", "greater"), ("greater", "less"), ("less", "less")), truth[operator], strict=True):
        wrong = f"{operator} gives the wrong answer"
        run += f'::ucts::require({"" if holds else "!"}({pair[0]} {operator} {pair[1]}), "{wrong}"); '
    return Text(f"values of {type_} are compared by {operator}", run=run)


def _of_classes(claim: claims.Claim) -> Text | None:
    match claim:
        case claims.Derives(derived, base):
            text = f"enum {{ found = sizeof(::ucts::accepts<{base} >(static_cast<{class_text(derived)}*>(0))) }};"
            return Text(f"{class_words(derived)} derives publicly from {base}", text)
        case claims.NotDerived(derived, base):
            text = _holds(f"!__is_base_of({base}, {class_text(derived)})")
            return Text(f"{class_words(derived)} does not derive from {base}", text)
        case claims.IsAbstract(name):
            return Text(f"{class_words(name)} is abstract", _holds(f"__is_abstract({class_text(name)})"))
        case claims.NoMember(owner, member):
            return Text(f"{class_words(owner)} has no {member}", *_no_member(owner, member))
        case claims.Thrown(name, base):
            caught = f"bool caught = false; try {{ throw {name}(); }} catch (const {base}&) {{ caught = true; }}"
            return Text(f"{name} is caught as {base}", run=f'{caught} ::ucts::require(caught, "it is not");')
        case claims.Pure(owner, key, method, parameters):
            at = f"{key}_lacks_{method}_{parameters}" if parameters >= 0 else f"{key}_lacks_{method}"
            text = _holds(f"__is_abstract(::ucts::{at}<{class_text(owner)} >)")
            return Text(f"{class_words(owner)}::{method} is pure virtual", text, key=key, pure=True)
        case claims.Arity(owner, method, parameters, _):
            counted = f"{parameters or 'no'} parameter{'s' * (parameters != 1)}"
            says = f"{class_words(owner)} has a function {method} with {counted}"
            return Text(says, _function(claim), of_functions=True)
        case claims.Passed(owner, method, _, position, types, _):
            found = f"function::a{position}" if position else "function::result"
            what = f"parameter {position}" if position else "the result"
            says = f"{what} of {class_words(owner)}::{method} is {_words(types)}"
            return Text(says, f"{_function(claim)} {_one_of(found, types)}", of_functions=True)
        case claims.NoMutator(owner, method, type_):
            says = f"{class_words(owner)} has no function that sets {method}"
            return Text(says, _no_mutator(class_text(owner), method, type_))
    return None


def _no_member(owner: Class, member: str) -> tuple[str]:
    """Found by its address, unless it is overloaded, or by a call."""
    declared = (
        f"template <class T> ::ucts::yes_type has(char (*)[sizeof(&T::{member})]);"
        " template <class T> ::ucts::no_type has(...);"
        f" template <class T> ::ucts::yes_type calls(char (*)[sizeof((::ucts::make<T>().{member}(), 0))]);"
        " template <class T> ::ucts::no_type calls(...);"
    )
    type_ = class_text(owner)
    neither = (f"sizeof({how}<{type_}>(0)) == sizeof(::ucts::no_type)" for how in ("has", "calls"))
    return (f"{declared} {_holds(' && '.join(neither))}",)


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
    return f"{text} {_holds(' && '.join(absent))}"


def _of_components(claim: claims.Claim) -> Text | None:
    match claim:
        case claims.DeclaresConnection(owner, connection):
            return Text(f"a type {connection} for {owner}", f"typedef {connection_text(owner, connection)} found;")
        case claims.ConnectionTemplate(owner, connection):
            type_ = connection_text(owner, connection)
            named = _holds(f"sizeof(::ucts::has_connection<{type_}>(0)) == sizeof(::ucts::yes_type)")
            instance = f"enum {{ is_made = sizeof(::ucts::instance(static_cast< ::ucts::connection_base<{type_}>::type*>(0))) }};"
            return Text(f"{connection} is an instance of a template PortConnection", f"{named} {instance}")
        case claims.ConnectionShape(owner, connection):
            type_ = connection_text(owner, connection)
            text = f"typedef UCTS_TYPE(::ucts::member_of(&{type_}::port_name)) name; {_one_of('name::member', ['::std::string'])}"
            reference = f"typedef UCTS_TYPE(::ucts::member_of(&{type_}::ref)) reference;"
            made = f'{type_} connection(::std::string("name"), reference::member()); '
            made += '::ucts::require(connection.port_name == "name", "port_name is not what it was made of");'
            says = f"{connection} has a std::string port_name and a reference ref and is made of both"
            return Text(says, f"{text} {reference} typedef ::ucts::inner<reference>::type pointee;", made)
        case claims.ConnectionTo(owner, connection, interface):
            type_ = class_text(Connected(owner, connection))
            if not interface:
                return Text(f"{connection} refers to the actual interface", f"typedef {type_} found;")
            text = f"enum {{ found = sizeof(::ucts::accepts<{interface} >(static_cast<{type_}*>(0))) }};"
            return Text(f"{connection} refers to {interface}", text)
        case claims.Startup(owner, least, most, _):
            text = f"{_startup(claim)} {_one_of('function::result', ['void'])}"
            text += f" typedef ::ucts::holds<(function::arity >= {least} && function::arity <= {most})>::yes counted;"
            constant = " && ".join(f"::ucts::by_constant<function::a{i}>::value" for i in range(1, most + 1))
            text += f" typedef ::ucts::holds<({constant or 'true'})>::yes constant;"
            counted = f"{least}" if least == most else f"{least} to {most}"
            says = f"{owner}::on_startup takes {counted} constant references to connections"
            return Text(says, text, of_functions=True)
        case claims.StartupTakes(owner, connection, startup):
            type_ = connection_text(owner, connection)
            alike = [f"::ucts::same<{connection_text(owner, c)}, {type_}>::value" for c in startup.connections]
            taken = [f"::ucts::same<function::a{i}, const {type_}&>::value" for i in range(1, startup.most + 1)]
            text = f"{_startup(startup)} {_holds(' + '.join(taken) + ' == ' + ' + '.join(alike))}"
            says = f"{owner}::on_startup takes const {connection}& as often as there are connections of this type"
            return Text(says, text, of_functions=True)
        case claims.ReturnsReference(owner, getter, interface):
            type_ = class_text(Returned(owner, getter))
            if not interface:
                return Text(f"{owner}::{getter} returns a shared pointer", f"typedef {type_} found;", of_functions=True)
            text = f"enum {{ found = sizeof(::ucts::accepts<{interface} >(static_cast<{type_}*>(0))) }};"
            return Text(f"{owner}::{getter} returns a shared pointer to {interface}", text, of_functions=True)
    return None
