"""The header that all generated headers include: what clause 13 takes from the standard library or has the framework give."""

from __future__ import annotations

SUPPORT_FILE = "ucm_support.hpp"

_EXCEPTIONS = """\
namespace UCM {{

/// Root of all exceptions (13.4).
class Exception : public ::std::exception {{
  public:
    virtual ~Exception() {silent} {{}}
    virtual void _raise() const = 0;
    virtual const char* _name() const = 0;
    virtual const char* what() const {silent} {{ return _name(); }}
}};

/// Root of the exceptions that models declare.
class UserException : public Exception {{
  public:
    virtual ~UserException() {silent} {{}}
}};

/// Root of the exceptions of the platform at run time.
class SystemException : public Exception {{
  public:
    virtual ~SystemException() {silent} {{}}
}};

}}  // namespace UCM
"""

_COMPONENTS = """\
namespace ucm {{

/// What interfaces of port elements derive from (13.8).
class PortElementObject {{
  public:
    virtual ~PortElementObject() {{}}
}};

/// A required port element and what it is connected to (13.7).
template <class T>
struct PortConnection {{
    ::std::string port_name;
    {shared_ptr}<T> ref;

    PortConnection(::std::string name, {shared_ptr}<T> reference) : port_name(name), ref(reference) {{}}
}};

}}  // namespace ucm
"""

_HEAD = """\
#ifndef UCM_SUPPORT_HPP
#define UCM_SUPPORT_HPP

"""

_INCLUDES_11 = """\
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

"""

_INCLUDES_03 = """\
#include <algorithm>
#include <cstddef>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <stdint.h>

"""

_ARRAY = """\
namespace ucm {

/// The semantics of std::array (13.10.1).
template <class T, ::std::size_t N>
struct array {
    typedef T value_type;
    typedef T* pointer;
    typedef const T* const_pointer;
    typedef T& reference;
    typedef const T& const_reference;
    typedef T* iterator;
    typedef const T* const_iterator;
    typedef ::std::size_t size_type;
    typedef ::std::ptrdiff_t difference_type;
    typedef ::std::reverse_iterator<iterator> reverse_iterator;
    typedef ::std::reverse_iterator<const_iterator> const_reverse_iterator;

    T elements[N];

    reference operator[](size_type index) { return elements[index]; }
    const_reference operator[](size_type index) const { return elements[index]; }
    reference at(size_type index) { return elements[checked(index)]; }
    const_reference at(size_type index) const { return elements[checked(index)]; }
    reference front() { return elements[0]; }
    const_reference front() const { return elements[0]; }
    reference back() { return elements[N - 1]; }
    const_reference back() const { return elements[N - 1]; }
    pointer data() { return elements; }
    const_pointer data() const { return elements; }
    iterator begin() { return elements; }
    const_iterator begin() const { return elements; }
    iterator end() { return elements + N; }
    const_iterator end() const { return elements + N; }
    reverse_iterator rbegin() { return reverse_iterator(end()); }
    const_reverse_iterator rbegin() const { return const_reverse_iterator(end()); }
    reverse_iterator rend() { return reverse_iterator(begin()); }
    const_reverse_iterator rend() const { return const_reverse_iterator(begin()); }
    size_type size() const { return N; }
    size_type max_size() const { return N; }
    bool empty() const { return N == 0; }
    void fill(const T& value) { ::std::fill(begin(), end(), value); }
    void swap(array& other) { ::std::swap_ranges(begin(), end(), other.begin()); }

  private:
    static size_type checked(size_type index) {
        if (index >= N) {
            throw ::std::out_of_range("ucm::array::at");
        }
        return index;
    }
};

template <class T, ::std::size_t N>
bool operator==(const array<T, N>& left, const array<T, N>& right) {
    return ::std::equal(left.begin(), left.end(), right.begin());
}

template <class T, ::std::size_t N>
bool operator!=(const array<T, N>& left, const array<T, N>& right) {
    return !(left == right);
}

template <class T, ::std::size_t N>
bool operator<(const array<T, N>& left, const array<T, N>& right) {
    return ::std::lexicographical_compare(left.begin(), left.end(), right.begin(), right.end());
}

template <class T, ::std::size_t N>
bool operator>(const array<T, N>& left, const array<T, N>& right) {
    return right < left;
}

template <class T, ::std::size_t N>
bool operator<=(const array<T, N>& left, const array<T, N>& right) {
    return !(right < left);
}

template <class T, ::std::size_t N>
bool operator>=(const array<T, N>& left, const array<T, N>& right) {
    return !(left < right);
}

}  // namespace ucm

"""

_SAFE_ENUM = """\
namespace ucm {

/// An enumeration whose enumerators are found in its own scope (13.10.2).
template <typename def, typename inner = typename def::type>
class safe_enum : public def {
    typedef typename def::type type;
    inner val;

  public:
    safe_enum() : val(static_cast<inner>(type())) {}
    safe_enum(type v) : val(static_cast<inner>(v)) {}

    inner underlying() const { return val; }

    bool operator==(const safe_enum& s) const { return val == s.val; }
    bool operator!=(const safe_enum& s) const { return val != s.val; }
    bool operator<(const safe_enum& s) const { return val < s.val; }
    bool operator<=(const safe_enum& s) const { return val <= s.val; }
    bool operator>(const safe_enum& s) const { return val > s.val; }
    bool operator>=(const safe_enum& s) const { return val >= s.val; }
};

}  // namespace ucm

"""

_SHARED_PTR = """\
namespace ucm {

/// Counts references to one object and deletes it after the last; for several threads only where the compiler can.
class reference_count {
  public:
    explicit reference_count() : count_(1) {}
    virtual ~reference_count() {}
#ifdef __GNUC__
    void add() { __sync_add_and_fetch(&count_, 1); }
    void remove() {
        if (__sync_sub_and_fetch(&count_, 1) == 0) {
            delete this;
        }
    }
#else
    void add() { ++count_; }
    void remove() {
        if (--count_ == 0) {
            delete this;
        }
    }
#endif
    long count() const { return count_; }

  private:
    reference_count(const reference_count&);
    reference_count& operator=(const reference_count&);

    long count_;
};

template <class Y>
class owned : public reference_count {
  public:
    explicit owned(Y* object) : object_(object) {}
    virtual ~owned() { delete object_; }

  private:
    Y* object_;
};

/// The semantics of std::shared_ptr (13.10.3).
template <class T>
class shared_ptr {
    typedef void (shared_ptr::*condition)() const;
    void yes() const {}

  public:
    typedef T element_type;

    shared_ptr() : object_(0), count_(0) {}
    template <class Y>
    explicit shared_ptr(Y* object) : object_(object), count_(0) {
        try {
            count_ = new owned<Y>(object);
        } catch (...) {
            delete object;
            throw;
        }
    }
    shared_ptr(const shared_ptr& other) : object_(other.object_), count_(other.count_) { add(); }
    template <class Y>
    shared_ptr(const shared_ptr<Y>& other) : object_(other.object_), count_(other.count_) {
        add();
    }
    template <class Y>
    shared_ptr(const shared_ptr<Y>& other, T* object) : object_(object), count_(other.count_) {
        add();
    }
    ~shared_ptr() {
        if (count_) {
            count_->remove();
        }
    }

    shared_ptr& operator=(const shared_ptr& other) {
        shared_ptr(other).swap(*this);
        return *this;
    }
    template <class Y>
    shared_ptr& operator=(const shared_ptr<Y>& other) {
        shared_ptr(other).swap(*this);
        return *this;
    }
    void swap(shared_ptr& other) {
        ::std::swap(object_, other.object_);
        ::std::swap(count_, other.count_);
    }
    void reset() { shared_ptr().swap(*this); }
    template <class Y>
    void reset(Y* object) {
        shared_ptr(object).swap(*this);
    }

    T* get() const { return object_; }
    T& operator*() const { return *object_; }
    T* operator->() const { return object_; }
    long use_count() const { return count_ ? count_->count() : 0; }
    bool unique() const { return use_count() == 1; }
    operator condition() const { return object_ ? &shared_ptr::yes : 0; }

  private:
    template <class Y>
    friend class shared_ptr;

    void add() {
        if (count_) {
            count_->add();
        }
    }

    T* object_;
    reference_count* count_;
};

template <class T, class Y>
bool operator==(const shared_ptr<T>& left, const shared_ptr<Y>& right) {
    return left.get() == right.get();
}

template <class T, class Y>
bool operator!=(const shared_ptr<T>& left, const shared_ptr<Y>& right) {
    return left.get() != right.get();
}

template <class T, class Y>
bool operator<(const shared_ptr<T>& left, const shared_ptr<Y>& right) {
    return left.get() < right.get();
}

template <class T, class Y>
shared_ptr<T> static_pointer_cast(const shared_ptr<Y>& other) {
    return shared_ptr<T>(other, static_cast<T*>(other.get()));
}

template <class T, class Y>
shared_ptr<T> dynamic_pointer_cast(const shared_ptr<Y>& other) {
    T* const object = dynamic_cast<T*>(other.get());
    return object ? shared_ptr<T>(other, object) : shared_ptr<T>();
}

}  // namespace ucm

"""


def support(modern: bool) -> str:
    """The text of ``SUPPORT_FILE`` for C++11, or for C++03."""
    silent = "noexcept" if modern else "throw()"
    shared_ptr = "::std::shared_ptr" if modern else "shared_ptr"
    head = _INCLUDES_11 if modern else _INCLUDES_03 + _ARRAY + _SAFE_ENUM + _SHARED_PTR
    tail = _EXCEPTIONS.format(silent=silent) + "\n" + _COMPONENTS.format(shared_ptr=shared_ptr)
    return f"{_HEAD}{head}{tail}\n#endif\n"
