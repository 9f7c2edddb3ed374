// Mutants drawn from the dimensions of the provocations: failures, refusals, later use, counts, sizes, moments, early ends.
#include <chrono>
#include <future>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "registry.hpp"

namespace derived {

namespace {

using lwucm::componentId;
using lwucm::componentIds;
using lwucm::connectionId;
using lwucm::Container;
using lwucm::ManagerImpl;
using lwucm::PortElementObject;
using lwucm::Properties;
using lwucm::Property;

// bodies that raise

/// Knows the ports whose connections were undone although on_disconnect raised.
class NotesFailures : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void disconnect(connectionId connection) override {
        const lwucm::Connection* const found = shared_->connections.find(connection);
        const auto port = found == nullptr ? Port() : Port(found->client->id(), found->port);
        try {
            ManagerImpl::disconnect(connection);
        } catch (const lwucm::UCM_ERROR&) {
            if (found != nullptr && shared_->connections.find(connection) == nullptr) {
                failed(port);
            }
            throw;
        }
    }

  protected:
    typedef std::pair<componentId, std::string> Port;
    virtual void failed(const Port& port) = 0;
};

class LetsFailuresOut final : public NotesFailures {
  public:
    using NotesFailures::NotesFailures;

  protected:
    void failed(const Port&) override { throw std::runtime_error("the body failed"); }
};
const bool a = breaks<LetsFailuresOut>("lets_failures_out_of_disconnect", {"R-12.10-08"},
                                       "disconnect lets another exception out when on_disconnect raised.",
                                       {"R-12.10-23"});

class KeepsPortsTaken final : public NotesFailures {
  public:
    using NotesFailures::NotesFailures;

    connectionId connect(componentId instance, const std::string& port_name,
                         std::shared_ptr<PortElementObject> to_port) override {
        if (taken_.count(Port(instance, port_name)) > 0) {
            throw lwucm::UCM_ERROR("connected already");
        }
        return ManagerImpl::connect(instance, port_name, std::move(to_port));
    }

  protected:
    void failed(const Port& port) override { taken_.insert(port); }

  private:
    std::set<Port> taken_;
};
const bool b = breaks<KeepsPortsTaken>("keeps_ports_taken_after_a_failure", {"R-11.2.3-08"},
                                       "A port whose on_disconnect raised cannot be connected again.", {"R-12.10-07"});

class ListsFailed final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    componentId add_component(const Properties& configValues) override {
        try {
            return ManagerImpl::add_component(configValues);
        } catch (const lwucm::UCM_ERROR&) {
            ghosts_.push_back(30000 + static_cast<componentId>(ghosts_.size()));
            throw;
        }
    }

    componentIds get_components() override {
        componentIds listed = ManagerImpl::get_components();
        listed.insert(listed.end(), ghosts_.begin(), ghosts_.end());
        return listed;
    }

  private:
    componentIds ghosts_;
};
const bool c = breaks<ListsFailed>("lists_what_was_not_added", {"R-12.10-22"},
                                   "get_components lists a number for each component that was not added.",
                                   {"R-11.2.2.1-14", "R-11.2.1.4-03"});

// operations that were refused

class RefusesOnceMore final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void start() override {
        if (was_refused_) {
            throw lwucm::UCM_ERROR("it was refused before");
        }
        try {
            ManagerImpl::start();
        } catch (const lwucm::UCM_ERROR&) {
            was_refused_ = true;
            throw;
        }
    }

  private:
    bool was_refused_ = false;
};
const bool d = breaks<RefusesOnceMore>("never_starts_after_a_refusal", {"R-11.2.3-06"},
                                       "Once start was refused, every start is refused.",
                                       {"R-11.2.3-08", "R-11.2.3-10", "R-12.10-24", "R-12.10-23"});

class ListsLessAfterRefusal final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void remove_component(componentId id) override {
        try {
            ManagerImpl::remove_component(id);
        } catch (const lwucm::NOT_FOUND&) {
            was_refused_ = true;
            throw;
        }
    }

    componentIds get_components() override {
        componentIds listed = ManagerImpl::get_components();
        if (was_refused_ && !listed.empty()) {
            listed.pop_back();
        }
        return listed;
    }

  private:
    bool was_refused_ = false;
};
const bool e = breaks<ListsLessAfterRefusal>(
    "lists_one_less_after_a_refused_removal", {"R-11.2.2.1-14"},
    "Once an unknown component was to be removed, get_components leaves out the last one.",
    {"R-11.2.1.4-03", "R-12.10-22"});

// what was given out is used later

class RemovesTwice final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    componentId add_component(const Properties& configValues) override {
        const componentId id = ManagerImpl::add_component(configValues);
        gone_.erase(id);
        return id;
    }

    void remove_component(componentId id) override {
        if (gone_.count(id) == 0) {
            ManagerImpl::remove_component(id);
            gone_.insert(id);
        }
    }

  private:
    std::set<componentId> gone_;
};
const bool f = breaks<RemovesTwice>("removes_components_twice", {"R-12.10-15"},
                                    "remove_component of a removed component returns.");

class FindsRemoved final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    std::shared_ptr<PortElementObject> get_port_element(componentId id, const std::string& port_name) override {
        try {
            return known_[{id, port_name}] = ManagerImpl::get_port_element(id, port_name);
        } catch (const lwucm::NOT_FOUND&) {
            const std::shared_ptr<PortElementObject> element = known_[{id, port_name}];
            if (element) {
                return element;
            }
            throw;
        }
    }

  private:
    std::map<std::pair<componentId, std::string>, std::shared_ptr<PortElementObject>> known_;
};
const bool g = breaks<FindsRemoved>("finds_port_elements_of_the_removed", {"R-12.10-15"},
                                    "get_port_element of a removed component gives what it gave before.");

class UndoesTwice final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    connectionId connect(componentId instance, const std::string& port_name,
                         std::shared_ptr<PortElementObject> to_port) override {
        const connectionId id = ManagerImpl::connect(instance, port_name, std::move(to_port));
        undone_.erase(id);
        return id;
    }

    void disconnect(connectionId connection) override {
        if (undone_.count(connection) == 0) {
            ManagerImpl::disconnect(connection);
            undone_.insert(connection);
        }
    }

  private:
    std::set<connectionId> undone_;
};
const bool h = breaks<UndoesTwice>("undoes_connections_twice", {"R-12.10-16"},
                                   "disconnect of a connection that is undone returns.");

class RemovesContainersTwice final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void remove_container(std::shared_ptr<Container> subContainer) override {
        if (subContainer && gone_.count(subContainer) > 0) {
            return;
        }
        ManagerImpl::remove_container(subContainer);
        gone_.insert(subContainer);
    }

  private:
    std::set<std::shared_ptr<Container>> gone_;
};
const bool i = breaks<RemovesContainersTwice>("removes_containers_twice", {"R-12.10-17"},
                                              "remove_container of a removed container returns.");

// counts

class Lists255 final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    componentIds get_components() override {
        componentIds listed = ManagerImpl::get_components();
        listed.resize(listed.size() % 256);
        return listed;
    }
};
const bool j = breaks<Lists255>("counts_members_in_a_byte", {"R-11.2.2.1-14"},
                                "The length of what get_components lists has eight bits.");

class StartsThreeTimes final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    void start() override {
        if (starts_ == 3) {
            throw lwucm::UCM_ERROR("started three times");
        }
        ManagerImpl::start();
        ++starts_;
    }

  private:
    int starts_ = 0;
};
const bool k = breaks<StartsThreeTimes>("starts_three_times", {"R-11.2.3-10"}, "The fourth start is refused.",
                                        {"R-11.2.3-06", "R-11.2.3-08", "R-11.2.3-15", "R-12.10-23"});

class ConnectsSeven final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    connectionId connect(componentId instance, const std::string& port_name,
                         std::shared_ptr<PortElementObject> to_port) override {
        if (made_ == 7) {
            throw lwucm::UCM_ERROR("there are seven connections");
        }
        const connectionId id = ManagerImpl::connect(instance, port_name, std::move(to_port));
        ++made_;
        return id;
    }

  private:
    int made_ = 0;
};
const bool l = breaks<ConnectsSeven>(
    "makes_seven_connections", {"R-11.2.2.1-08"}, "connect is refused once seven connections have been made.",
    {"R-11.2.3-08", "R-11.2.1.1-01", "R-11.2.1.3-01", "R-12.10-24", "R-12.10-07", "R-11.1.2-02", "R-11.2.3-06"});

class MakesOneContainer final : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    std::shared_ptr<Container> create_container(const Properties& configValues) override {
        if (has_made_one_) {
            throw lwucm::UCM_ERROR("there was a container");
        }
        has_made_one_ = true;
        return ManagerImpl::create_container(configValues);
    }

  private:
    bool has_made_one_ = false;
};
const bool m = breaks<MakesOneContainer>("makes_one_container", {"R-11.1.3-03"},
                                         "A second create_container is refused, even if the first container is gone.",
                                         {"R-11.2.2.2-02", "R-12.10-12"});

// sizes

class CutsAttributes : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    componentId add_component(const Properties& configValues) override {
        Properties cut = configValues;
        for (Property& property : cut) {
            property.value = changed(property.value);
        }
        return ManagerImpl::add_component(cut);
    }

  protected:
    virtual std::string changed(const std::string& value) const = 0;
};

class CutsAt4096 final : public CutsAttributes {
  public:
    using CutsAttributes::CutsAttributes;

  protected:
    std::string changed(const std::string& value) const override { return value.substr(0, 4095); }
};
const bool n = breaks<CutsAt4096>("cuts_attributes_at_4095", {"R-11.2.1.2-05"},
                                  "Values of attributes end after 4095 characters.");

class CutsAtLineEnds final : public CutsAttributes {
  public:
    using CutsAttributes::CutsAttributes;

  protected:
    std::string changed(const std::string& value) const override { return value.substr(0, value.find('\n')); }
};
const bool o = breaks<CutsAtLineEnds>("cuts_attributes_at_line_ends", {"R-11.2.1.2-05"},
                                      "Values of attributes end at the first end of a line.", {"R-10.1.1-06"});

// operations that return early

class ReturnsEarly : public ManagerImpl {
  public:
    using ManagerImpl::ManagerImpl;

    ~ReturnsEarly() override {
        if (rest_.valid()) {
            rest_.wait();
        }
    }

  protected:
    template <class Work>
    void soon(Work work) {
        rest_ = std::async(std::launch::async, work);
        if (rest_.wait_for(std::chrono::milliseconds(60)) == std::future_status::ready) {
            rest_.get();
        }
    }

  private:
    std::future<void> rest_;
};

class StopsLater final : public ReturnsEarly {
  public:
    using ReturnsEarly::ReturnsEarly;

    void stop() override {
        soon([this] { ManagerImpl::stop(); });
    }
};
const bool p = breaks<StopsLater>("stop_returns_after_60_ms", {"R-11.2.2.1-12"},
                                  "stop returns after 60 ms, although a body is still in on_shutdown.",
                                  {"R-11.1.1-01", "R-11.2.1.2-10", "R-11.2.2.2-01", "R-11.2.3-17", "R-11.2.2.1-13"});

class StartsLater final : public ReturnsEarly {
  public:
    using ReturnsEarly::ReturnsEarly;

    void start() override {
        soon([this] { ManagerImpl::start(); });
    }
};
const bool q = breaks<StartsLater>("start_returns_after_60_ms", {"R-11.2.2.1-11"},
                                   "start returns after 60 ms, although a body is still in on_startup.",
                                   {"R-11.1.1-01", "R-11.2.2.2-01", "R-11.2.1.2-07", "R-11.2.3-03", "R-11.2.1.2-08"});

}  // namespace

}  // namespace derived
