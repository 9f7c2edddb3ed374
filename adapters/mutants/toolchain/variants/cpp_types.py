"""Tool chains whose C++ has other data types than the reference one, as clause 13 allows, in every model."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

from ucm_cts.adapters.contract.metamodel.contracts import Enumeration, PrimitiveInteger, Sequence
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.rewriting import Files
from ucm_cts.adapters.mutants.toolchain.variants.cpp_names import Rewrite, all_of, rewriting
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE

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
"""A vector that keeps a bound, and the end of the file that it stands in."""


def _any_of(names: Collection[str]) -> str:
    """A pattern of ``names`` as C++ spells them; of nothing if there are none."""
    return "|".join(re.escape(identifier(name)) for name in names) or "(?!)"


def _bounded_vectors(model: Model, files: Files) -> Files:
    """Bounded sequences hold any number of elements up to their bound."""
    names = _any_of({one.name for one in all_of(model, Sequence) if one.max_size is not None and one.max_size > 0})
    shape = rf"typedef ::(?:std|ucm)::array(< [^<>]* > (?:{names});)"
    made = {name: re.sub(shape, r"typedef ::ucm::bounded_vector\1", text) for name, text in files.items()}
    return {**made, SUPPORT_FILE: made[SUPPORT_FILE].replace("\n#endif\n", _BOUNDED)}


def _stored_as(text: str, names: str, type_: str) -> str:
    """``text`` with ``type_`` below the enumerations of ``names``, a pattern."""
    modern = re.sub(rf"\benum ({names}) : \w+", rf"enum \1 : {type_}", text)
    return re.sub(rf"(safe_enum< (?:{names})_def), \w+ >", rf"\1, {type_} >", modern)


def _bytes_with_sign(model: Model, files: Files) -> Files:
    """BYTE has a sign, as its range of values says, below enumerations, too."""
    bytes_ = {one.name for one in all_of(model, PrimitiveInteger) if one.kind == "BYTE"}
    types = rf"\btypedef uint8_t ({_any_of(bytes_)});"
    by_byte = {"BYTE", *bytes_}
    stored = _any_of({one.name for one in all_of(model, Enumeration) if _last(one.index_type) in by_byte})
    return {
        name: _stored_as(re.sub(types, r"typedef int8_t \1;", text), stored, "int8_t") for name, text in files.items()
    }


def _enumerations_of_32_bits(model: Model, files: Files) -> Files:
    """Enumerations have 32 bits, as the other standard says; with a sign where values need one."""
    all_ = {one.name for one in all_of(model, Enumeration)}
    signed = {one.name for one in all_of(model, Enumeration) if any((e.value or 0) < 0 for e in one.enumerators)}
    return {
        name: _stored_as(_stored_as(text, _any_of(all_), "uint32_t"), _any_of(signed), "int32_t")
        for name, text in files.items()
    }


def _last(path: str | None) -> str:
    return (path or "").rpartition("::")[2]


REWRITTEN: Mapping[str, tuple[Rewrite, tuple[str, ...]]] = {
    "bounded_vectors": (_bounded_vectors, ()),
    "bounded_vectors_as_declared": (_bounded_vectors, ("cpp-bounded-sequence=bounded-vector",)),
    "bytes_with_sign": (_bytes_with_sign, ()),
    "bytes_with_sign_as_declared": (_bytes_with_sign, ("cpp-byte=int8_t",)),
    "enumerations_of_32_bits": (_enumerations_of_32_bits, ()),
    "enumerations_of_32_bits_as_declared": (_enumerations_of_32_bits, ("cpp-enum-type=uint32_t",)),
}

for _says, (_rewrite, _declares) in REWRITTEN.items():
    rewriting(_says, _rewrite, *_declares)
