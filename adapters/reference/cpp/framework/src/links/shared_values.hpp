// Draft, View: the values of shared data (10.4.2) at a writer and at a reader. Their connection calls them one at a time.
#ifndef LWUCM_SRC_SHARED_VALUES_HPP
#define LWUCM_SRC_SHARED_VALUES_HPP

#include "lwucm/value.hpp"

namespace lwucm {

/// What a writer has set. A second publication sends it again.
class Draft {
  public:
    Draft() = default;
    virtual ~Draft() = default;
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    virtual void write(const Value& value) {
        value_ = value;
        is_set_ = true;
    }

    /// Was there a value?
    virtual bool cancel() {
        const bool was_set = is_set_;
        is_set_ = false;
        return was_set;
    }

    /// The value to publish; null if there is none.
    const Value* value() const { return is_set_ ? &value_ : nullptr; }

  protected:
    bool is_set() const { return is_set_; }

  private:
    Value value_;
    bool is_set_ = false;
};

/// What a reader reads, how often it is frozen, and what it has missed meanwhile.
class View {
  public:
    explicit View(const Value& at_first) : current_(at_first), missed_(at_first) {}
    virtual ~View() = default;
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    /// A publication. Is the reader to be notified now?
    virtual bool take(const Value& value) {
        (depth_ > 0 ? missed_ : current_) = value;
        has_missed_ = depth_ > 0;
        return depth_ == 0;
    }

    virtual void freeze() { ++depth_; }

    /// Was it frozen?
    virtual bool release() {
        if (depth_ == 0) {
            return false;
        }
        --depth_;
        return true;
    }

    /// Reads what it has missed, if it is frozen no more. Has it missed something?
    virtual bool catch_up() {
        if (depth_ > 0 || !has_missed_) {
            return false;
        }
        current_ = missed_;
        has_missed_ = false;
        return true;
    }

    virtual Value read() { return current_; }

  protected:
    Value current_;
    Value missed_;
    int depth_ = 0;
    bool has_missed_ = false;
};

}  // namespace lwucm

#endif
