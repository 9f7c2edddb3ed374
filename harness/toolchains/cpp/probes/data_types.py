"""Probes for claims about data types and constants (13.1 to 13.4, 13.10)."""

from __future__ import annotations

from ucm_cts.harness.toolchains.cpp.probes.prelude import ARRAY_WORKS, SHARED_WORKS, SHARED_WORKS_TYPES
from ucm_cts.harness.toolchains.cpp.probes.text import Text, holds, one_of, words
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Sample


def of_types(claim: claims.Claim) -> Text | None:
    """The probe for a claim about names, types, fields and constants."""
    match claim:
        case claims.Namespace(name):
            return Text(f"a namespace {name}", f"namespace found = {name};")
        case claims.Declares(name):
            return Text(f"a type {name}", f"typedef {name} found;")
        case claims.Is(name, types):
            return Text(f"{name} is {words(types)}", one_of(name, types))
        case claims.ArrayOf(name, template, element, depth):
            inner = name
            for _ in range(depth):
                inner = f"::ucts::array_of<{inner}>::element"
            nested = " of ".join([template] * depth)
            return Text(f"{name} is {nested} of {element}", one_of(inner, [element]))
        case claims.Sizes(name, sizes):
            return Text(f"{name} has {' times '.join(map(str, sizes))} elements", _sizes(name, sizes))
        case claims.BoundedSequence():
            return _bounded_sequence(claim)
        case claims.IsClass(name):
            return Text(f"{name} is a class", holds(f"__is_class({name})"))
        case claims.Regular(name):
            copied = f"{name} first = {name}(); {name} second(first); second = first; (void)second;"
            return Text(f"{name} can be made without arguments, copied and assigned", run=copied)
        case claims.Field():
            return _field(claim)
        case claims.Copied():
            return _copied(claim)
        case claims.Changed(owner, field, sample):
            kept = _same(sample, f"object.{field}()", "value", "it does not keep what is assigned to it")
            run = f"{owner} object; const {sample.type} value = {sample.first}; object.{field}() = value; {kept}"
            return Text(f"{field}() of {owner} returns a reference that can be assigned to", run=run)
        case claims.Constructed():
            return _constructed(claim)
        case claims.Discriminator():
            return _discriminator(claim)
        case claims.IsConstant(name):
            return Text(f"{name} is constant", holds(f"sizeof(::ucts::constness({name})) == 2"))
        case claims.ConstantIs(name, type_, value):
            text = one_of(f"::ucts::bare<UCTS_TYPE({name})>::type", [type_])
            return Text(f"{name} is {value}", text, f'::ucts::require({name} == {value}, "it has another value");')
    return None


def _sizes(name: str, sizes: tuple[int, ...]) -> str:
    inner, conditions = name, []
    for size in sizes:
        array = f"::ucts::array_of<{inner}>"
        conditions.append(f"{array}::size == {size}")
        inner = f"{array}::element"
    return holds(" && ".join(conditions))


def _bounded_sequence(claim: claims.BoundedSequence) -> Text:
    name, element, size = claim.name, claim.element.type, claim.size
    array = f"{claim.array}< {element}, {size} >"
    shapes = {"array": array, "bounded-vector": f"a vector of at most {size} elements of {element}"}
    says = f"{name} is {words(shapes[form] for form in claim.forms)}"
    if claim.forms == ("array",):
        return Text(says, one_of(name, [array]))
    vector = "template <class S> struct vector_like {{ static void check() {{ {} }} }};".format(
        f'::ucts::require(!::ucts::same<S, ::std::vector< {element} > >::value, "it is a plain vector, which has no bound");'
        f" ::ucts::bounded<S, {element} >({claim.element.first}, {size});"
    )
    if "array" in claim.forms:
        vector += f" template <> struct vector_like< {array} > {{ static void check() {{}} }};"
    return Text(says, vector, f"vector_like<{name}>::check();")


def _same(sample: Sample, read: str, value: str, message: str) -> str:
    return f'::ucts::require({read} == {value}, "{message}");' if sample.comparable else f"(void)({read});"


def _dispatch(
    field: str, sample: Sample, forms: tuple[claims.StructForm, ...], bodies: dict[str, str]
) -> tuple[str, str]:
    """Declares ``use_field``; ``bodies`` has its statements for each form of a field."""
    if len(forms) == 1:
        return (
            f"template <class T, class V> void use_field(T& object, const V& value) {{ {bodies[forms[0]]} }}",
            "object, value",
        )
    return (
        "struct by_call {}; struct by_name {};"
        f" template <class T> ::ucts::yes_type form(char (*)[sizeof((::ucts::make<T>().{field}("
        f"::ucts::make<const {sample.type}>()), 0))]);"
        " template <class T> ::ucts::no_type form(...);"
        f" template <class T, class V> void use_field(T& object, const V& value, by_call) {{ {bodies['accessors']} }}"
        f" template <class T, class V> void use_field(T& object, const V& value, by_name) {{ {bodies['plain']} }}"
    ), "object, value, chosen()"


def _chosen(owner: str, forms: tuple[claims.StructForm, ...]) -> str:
    if len(forms) == 1:
        return ""
    return (
        f"typedef ::ucts::choose<sizeof(form<{owner}>(0)) == sizeof(::ucts::yes_type), by_call, by_name>::type chosen; "
    )


def _field(claim: claims.Field) -> Text:
    owner, field, sample = claim.owner, claim.field, claim.sample
    bodies = {}
    for form, write, read in (
        ("accessors", f"object.{field}(value);", f"object.{field}()"),
        ("plain", f"object.{field} = value;", f"object.{field}"),
    ):
        exact = f"typedef typename ::ucts::one_of<typename ::ucts::bare<UCTS_TYPE({read})>::type, V>::yes checked;"
        kept = _same(sample, read, "value", "it does not keep what is written to it")
        constant = f"typename ::ucts::bare<UCTS_TYPE({read.replace('object', 'constant')})>::type"
        whole = f"const T& constant = object; typedef typename ::ucts::one_of<{constant}, V>::yes read; "
        whole += _same(sample, read.replace("object", "constant"), "value", "it is not what a constant object has")
        bodies[form] = f"{write} {exact} {kept} {whole}"
    declared, arguments = _dispatch(field, sample, claim.forms, bodies)
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; use_field({arguments});"
    says = f"{owner} has a field {field} of type {sample.type} that is written, and read of constant objects, too"
    return Text(says, declared, run)


def _copied(claim: claims.Copied) -> Text:
    owner, field, sample = claim.owner, claim.field, claim.sample
    bodies = {}
    for form, write, call in (
        ("accessors", f"object.{field}(value);", "()"),
        ("plain", f"object.{field} = value;", ""),
    ):
        read = f"{field}{call}"
        caught = f"T& caught) {{ {_same(sample, f'caught.{read}', 'value', 'what is caught has lost it')}"
        copies = "T copy(object); T assigned; assigned = object; "
        copies += _same(sample, f"copy.{read}", "value", "a copy has lost it")
        copies += _same(sample, f"assigned.{read}", "value", "what it is assigned to has lost it")
        bodies[form] = f"{write} {f'try {{ throw object; }} catch ({caught} }}' if claim.thrown else copies}"
    declared, arguments = _dispatch(field, sample, claim.forms, bodies)
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; use_field({arguments});"
    kept = "thrown and caught" if claim.thrown else "copied and assigned"
    return Text(f"{owner} is {kept} with its field {field}", declared, run)


def _constructed(claim: claims.Constructed) -> Text:
    """Once for each field, which has another value than the others: so none is mistaken for another."""
    fields = tuple(enumerate(claim.fields))
    run = ""
    for special, _ in fields:
        values = "".join(
            f"const {sample.type} value_{n} = {sample.second if n == special else sample.first}; "
            for n, (_, sample) in fields
        )
        made = f"const {claim.owner} made({', '.join(f'value_{n}' for n, _ in fields)}); "
        wrong = "a field has not the value that it was made from"
        kept = "".join(_same(sample, f"made.{field}()", f"value_{n}", wrong) for n, (field, sample) in fields)
        run += f"{{ {values}{made}{kept} }} "
    return Text(f"{claim.owner} is made from a value of each field, in their order", run=run)


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
    bodies = {
        "accessors": f"object.{claim.case}(value); {judged} {again}",
        "plain": f"(void)value; {selected}(void)selector;",
    }
    declared, arguments = _dispatch(claim.case, sample, claim.forms, bodies)
    declared = f"{found} {typed} {declared}"
    run = f"{_chosen(owner, claim.forms)}{owner} object; const {sample.type} value = {sample.first}; use_field({arguments});"
    return Text(f"writing {claim.case} makes the selector of {owner} {words(claim.values)}", declared, run)


def of_enumerations(claim: claims.Claim) -> Text | None:
    """The probe for a claim about enumerations and class templates."""
    match claim:
        case claims.EnumForm(name, forms):
            text = holds(f"__is_enum({name})")
            if len(forms) == 1:
                sign = "==" if forms[0] == "enum" else "!="
                unscoped = f"sizeof(::ucts::is_unscoped<{name}>(0)) {sign} sizeof(::ucts::yes_type)"
                text = holds(f"__is_enum({name}) && {unscoped}")
            return Text(f"{name} is an {words(forms).replace('-', ' ')}", text)
        case claims.Underlying(name, types):
            return Text(f"{name} is stored as {words(types)}", one_of(f"__underlying_type({name})", types))
        case claims.EnumeratorOf(owner, enumerator, type_):
            found = f"::ucts::bare<UCTS_TYPE({owner}::{enumerator})>::type"
            return Text(f"{owner}::{enumerator} is an enumerator of {type_}", one_of(found, [type_]))
        case claims.EnumeratorValue(owner, enumerator, value):
            text = holds(f"static_cast<long>({owner}::{enumerator}) == {value}")
            return Text(f"{owner}::{enumerator} is {value}", text)
        case claims.SafeEnum(name, definition):
            text = one_of(f"::ucts::safe<{name}>::definition", [definition])
            return Text(f"{name} is ucm::safe_enum of {definition}", text)
        case claims.SafeEnumInner(name, types):
            return Text(f"{name} keeps its value as {words(types)}", one_of(f"::ucts::safe<{name}>::inner", types))
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
            return Text(f"ucm::safe_enum of {type_} alone keeps its enumerators", one_of(alone, [named]))
        case "safe-enum-comparison":
            return _comparison(type_, claim.detail, claim.values)
        case "array":
            return Text("ucm::array has the semantics of std::array", run=ARRAY_WORKS)
    return Text("ucm::shared_ptr has the semantics of std::shared_ptr", SHARED_WORKS_TYPES, SHARED_WORKS)


def _comparison(type_: str, operator: str, values: tuple[str, ...]) -> Text:
    less, greater = values
    truth = {"==": (0, 0, 1), "!=": (1, 1, 0), "<": (1, 0, 0), "<=": (1, 0, 1), ">": (0, 1, 0), ">=": (0, 1, 1)}
    run = f"const {type_} less = {less}, greater = {greater}; "
    for pair, is_true in zip(
        (("less", "greater"), ("greater", "less"), ("less", "less")), truth[operator], strict=True
    ):
        wrong = f"{operator} gives the wrong answer"
        run += f'::ucts::require({"" if is_true else "!"}({pair[0]} {operator} {pair[1]}), "{wrong}"); '
    return Text(f"values of {type_} are compared by {operator}", run=run)
