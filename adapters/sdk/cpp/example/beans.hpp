// Beans: a toy component framework whose API looks nothing like 12.10. It is the framework of the second example in
// docs/adapter-cpp.md, and shows what an adapter has to bridge: names for ids, functions for interfaces, codes for exceptions.
#ifndef BEANS_HPP
#define BEANS_HPP

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace beans {

typedef std::function<int(int)> Service;
typedef std::map<std::string, Service> Services;

/// What goes over a line: the name of an operation and a text; what comes back is a text.
typedef std::function<std::string(const std::string& operation, const std::string& text)> Talk;

/// The service of one who is on a line, which is to talk.
struct Speaker {
    Talk talk;
    int operator()(int) const { throw std::logic_error("lines are for talking"); }
};

/// What a bean is made of: services it offers, how it answers on a line, and functions that the kernel calls.
struct Bean {
    Services offers;
    std::map<std::string, Talk> answers;
    std::function<void()> prepare;
    std::function<void(const Services& needs)> activate;
    std::function<void()> deactivate;
    std::function<void()> dispose;
};

struct Kind {
    std::vector<std::string> needs;
    std::function<Bean()> make;
};

enum class Code { ok, no_such_bean, no_such_service, no_such_wire, not_now, bean_failed };

class Kernel {
  public:
    void define(const std::string& kind, Kind definition) { kinds_[kind] = std::move(definition); }

    /// Beans are known by names, which the caller chooses.
    Code load(const std::string& name, const std::string& kind) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        const auto found = kinds_.find(kind);
        if (found == kinds_.end() || running_ || find(name) != nullptr) {
            return Code::not_now;
        }
        try {
            std::unique_ptr<Loaded> loaded(new Loaded{name, &found->second, found->second.make(), Services()});
            loaded->bean.prepare();
            loaded_.push_back(std::move(loaded));
        } catch (...) {
            return Code::bean_failed;
        }
        return Code::ok;
    }

    Code unload(const std::string& name) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        Loaded* const loaded = find(name);
        if (loaded == nullptr) {
            return Code::no_such_bean;
        }
        if (running_ || !loaded->wires.empty()) {
            return Code::not_now;
        }
        const bool done = attempt(loaded->bean.dispose);
        loaded_.erase(std::find_if(loaded_.begin(), loaded_.end(),
                                   [loaded](const std::unique_ptr<Loaded>& each) { return each.get() == loaded; }));
        return done ? Code::ok : Code::bean_failed;
    }

    Code service(const std::string& name, const std::string& offered, Service& result) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        Loaded* const loaded = find(name);
        if (loaded == nullptr) {
            return Code::no_such_bean;
        }
        const auto found = loaded->bean.offers.find(offered);
        if (found == loaded->bean.offers.end()) {
            return Code::no_such_service;
        }
        result = found->second;
        return Code::ok;
    }

    /// Supplies what a bean needs; `wire` is set to a number for unwire.
    Code wire(const std::string& name, const std::string& needed, const Service& service, int& wire) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        Loaded* const loaded = find(name);
        if (loaded == nullptr) {
            return Code::no_such_bean;
        }
        const std::vector<std::string>& needs = loaded->kind->needs;
        if (std::find(needs.begin(), needs.end(), needed) == needs.end()) {
            return Code::no_such_service;
        }
        if (running_ || !loaded->wires.emplace(needed, service).second) {
            return Code::not_now;
        }
        wire = ++last_wire_;
        wires_[wire] = std::make_pair(loaded, needed);
        return Code::ok;
    }

    Code unwire(int wire) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        const auto found = wires_.find(wire);
        if (found == wires_.end()) {
            return Code::no_such_wire;
        }
        if (running_) {
            return Code::not_now;
        }
        found->second.first->wires.erase(found->second.second);
        wires_.erase(found);
        return Code::ok;
    }

    /// A new line, on which one bean answers and any number call.
    int line() {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        lines_[++last_line_] = std::make_shared<Line>();
        return last_line_;
    }

    Code answer(int line, const std::string& name, const std::string& offered) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        Loaded* const loaded = find(name);
        if (loaded == nullptr) {
            return Code::no_such_bean;
        }
        const auto found = loaded->bean.answers.find(offered);
        if (found == loaded->bean.answers.end()) {
            return Code::no_such_service;
        }
        Line& on = *lines_.at(line);
        if (running_ || on.answers) {
            return Code::not_now;
        }
        on.answers = found->second;
        return Code::ok;
    }

    /// Supplies what a bean needs by a Speaker; `wire` is set to a number for unwire.
    Code call(int line, const std::string& name, const std::string& needed, int& number) {
        const std::shared_ptr<Line> on = lines_.at(line);
        return wire(name, needed, Speaker{[on](const std::string& operation, const std::string& text) {
            if (on->is_cut || !on->answers) {
                throw std::runtime_error("nobody answers");
            }
            return on->answers(operation, text);
        }}, number);
    }

    /// Nobody answers any more.
    void hang_up(int line) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        lines_.at(line)->answers = Talk();
    }

    /// Cut, or mend, a line.
    void cut(int line, bool is_cut) {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        lines_.at(line)->is_cut = is_cut;
    }

    Code run() {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        for (const std::unique_ptr<Loaded>& each : loaded_) {
            if (each->wires.size() != each->kind->needs.size()) {
                return Code::not_now;
            }
        }
        for (std::size_t n = 0; n < loaded_.size() && !running_; ++n) {
            Loaded& each = *loaded_[n];
            if (!attempt([&each] { each.bean.activate(each.wires); })) {
                while (n-- > 0) {
                    attempt(loaded_[n]->bean.deactivate);
                }
                return Code::bean_failed;
            }
        }
        running_ = true;
        return Code::ok;
    }

    Code halt() {
        std::lock_guard<std::recursive_mutex> lock(mutex_);
        bool done = true;
        for (auto each = loaded_.rbegin(); running_ && each != loaded_.rend(); ++each) {
            done = attempt((*each)->bean.deactivate) && done;
        }
        running_ = false;
        return done ? Code::ok : Code::bean_failed;
    }

  private:
    struct Loaded {
        std::string name;
        const Kind* kind;
        Bean bean;
        Services wires;
    };

    struct Line {
        Talk answers;
        bool is_cut = false;
    };

    static bool attempt(const std::function<void()>& callback) {
        try {
            callback();
            return true;
        } catch (...) {
            return false;
        }
    }

    Loaded* find(const std::string& name) {
        for (const std::unique_ptr<Loaded>& each : loaded_) {
            if (each->name == name) {
                return each.get();
            }
        }
        return nullptr;
    }

    std::recursive_mutex mutex_;
    std::map<std::string, Kind> kinds_;
    std::vector<std::unique_ptr<Loaded>> loaded_;
    std::map<int, std::pair<Loaded*, std::string>> wires_;
    std::map<int, std::shared_ptr<Line>> lines_;
    int last_wire_ = 0;
    int last_line_ = 0;
    bool running_ = false;
};

}  // namespace beans

#endif
