// The shared-data connector (10.4.2). Each writer keeps the value that it has set. A publication goes to each reader on the
// reader's own thread, which takes the value and calls the notification; a reader that is frozen takes it, and is notified,
// when it has been released as many times as it was frozen. What a component had set, frozen or read ends when it is stopped.
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "containers/container_impl.hpp"
#include "links/connectors.hpp"
#include "links/port_link.hpp"
#include "links/shared_values.hpp"
#include "platform/parts.hpp"

namespace lwucm {

namespace {

const char* const NOTIFY = "on_data_update";

InterfacePtr with_codes(std::vector<std::pair<const char*, std::vector<Parameter>>> methods) {
    std::vector<Method> made;
    for (auto& method : methods) {
        method.second.push_back({"ecode", Direction::result, comm_ecode_type()});
        made.push_back(Method(method.first, method.second));
    }
    return std::make_shared<const Interface>(made);
}

class SharedData final : public PortLink {
  public:
    SharedData(std::shared_ptr<Shared> shared, const BoundTypes& types)
        : PortLink(std::move(shared)), type_(bound(types)), nothing_(any_value(*type_)) {}

    void abandon(const Instance& instance) override {
        std::lock_guard<std::mutex> lock(mutex_);
        for (auto writer = drafts_.begin(); writer != drafts_.end();) {
            writer = writer->first.first == &instance ? drafts_.erase(writer) : std::next(writer);
        }
        for (auto& reader : readers_) {
            if (&reader.first->instance() == &instance) {
                reader.second = Parts::view(nothing_);
            }
        }
    }

  protected:
    PortElements elements_of(Role role) const override {
        const Parameter in = {"data", Direction::in, type_};
        const Parameter out = {"data", Direction::out, type_};
        if (role == Role::sd_writer) {
            return {"", "writer_p", nullptr,
                    with_codes({{"write_data", {in}}, {"publish_data", {}}, {"cancel_data", {}}})};
        }
        if (role == Role::sd_reader) {
            return {"notification_p", "reader_p",
                    std::make_shared<const Interface>(std::vector<Method>{Method(NOTIFY, {})}),
                    with_codes({{"freeze_data", {}}, {"release_data", {}}, {"read_data", {out}}})};
        }
        throw BAD_PARAMETER("the connector has no such role");
    }

    void join(const AttachedPort& port) override {
        if (port.called) {
            std::lock_guard<std::mutex> lock(mutex_);
            readers_[port.called] = Parts::view(nothing_);
        }
    }

    void forget(const End& end) override {
        std::lock_guard<std::mutex> lock(mutex_);
        for (auto reader = readers_.begin(); reader != readers_.end(); ++reader) {
            if (reader->first.get() == &end) {
                readers_.erase(reader);
                return;
            }
        }
    }

    Values carry_out(const AttachedPort& port, const std::string& method, const Values& given) override {
        if (method == "write_data") {
            return {code(write(writer(port), given.at(0)))};
        }
        if (method == "publish_data") {
            return {code(publish(writer(port)))};
        }
        if (method == "cancel_data") {
            return {code(cancel(writer(port)))};
        }
        if (method == "freeze_data") {
            return {code(freeze(port.called))};
        }
        return method == "release_data" ? Values{code(release(port.called))} : read(port.called);
    }

  private:
    /// A component and its port.
    typedef std::pair<const Instance*, std::string> Writer;

    static Writer writer(const AttachedPort& port) { return {port.instance, port.name}; }

    static TypePtr bound(const BoundTypes& types) {
        const auto found = types.find("shared-data_t");
        if (found == types.end() || !found->second || types.size() != 1) {
            throw BAD_PARAMETER("shared data is bound to shared-data_t");
        }
        return found->second;
    }

    /// `mutex_` is locked.
    Draft& draft(const Writer& writer) {
        std::unique_ptr<Draft>& found = drafts_[writer];
        if (!found) {
            found = Parts::draft();
        }
        return *found;
    }

    const char* write(const Writer& writer, const Value& value) {
        std::lock_guard<std::mutex> lock(mutex_);
        draft(writer).write(value);
        return "ok";
    }

    const char* cancel(const Writer& writer) {
        std::lock_guard<std::mutex> lock(mutex_);
        return draft(writer).cancel() ? "ok" : "internal_error";
    }

    const char* publish(const Writer& writer) {
        if (const char* const failure = fault()) {
            return failure;
        }
        std::lock_guard<std::mutex> lock(mutex_);
        const Value* const published = draft(writer).value();
        if (published == nullptr) {
            return "internal_error";
        }
        const Value value = *published;
        for (auto& reader : readers_) {
            CalledEnd* const end = reader.first.get();  // its lane ends before it does
            end->call_later([this, end, value] { bring(*end, value); });
        }
        return "ok";
    }

    /// On the thread of the reader.
    void bring(CalledEnd& reader, const Value& value) {
        if (take(reader, value)) {
            reader.call(NOTIFY, {});
        }
    }

    /// Is the reader to be notified now?
    bool take(const CalledEnd& reader, const Value& value) {
        std::lock_guard<std::mutex> lock(mutex_);
        View* const view = find(reader);
        return view != nullptr && view->take(value);
    }

    const char* freeze(const std::shared_ptr<CalledEnd>& reader) {
        std::lock_guard<std::mutex> lock(mutex_);
        View* const view = find(*reader);
        if (view == nullptr) {
            return "internal_error";
        }
        view->freeze();
        return "ok";
    }

    const char* release(const std::shared_ptr<CalledEnd>& reader) {
        std::lock_guard<std::mutex> lock(mutex_);
        View* const view = find(*reader);
        if (view == nullptr || !view->release()) {
            return "internal_error";
        }
        if (view->catch_up()) {
            CalledEnd* const end = reader.get();
            end->call_later([end] { end->call(NOTIFY, {}); });
        }
        return "ok";
    }

    Values read(const std::shared_ptr<CalledEnd>& reader) {
        std::lock_guard<std::mutex> lock(mutex_);
        View* const view = find(*reader);
        return view != nullptr ? Values{view->read(), code("ok")} : Values{nothing_, code("internal_error")};
    }

    View* find(const CalledEnd& end) {
        for (auto& reader : readers_) {
            if (reader.first.get() == &end) {
                return reader.second.get();
            }
        }
        return nullptr;
    }

    const TypePtr type_;
    const Value nothing_;
    std::mutex mutex_;
    std::map<Writer, std::unique_ptr<Draft>> drafts_;
    std::map<std::shared_ptr<CalledEnd>, std::unique_ptr<View>> readers_;
};

}  // namespace

std::shared_ptr<Link> make_shared_data_connector(std::shared_ptr<Shared> shared, const BoundTypes& types) {
    return std::make_shared<SharedData>(std::move(shared), types);
}

}  // namespace lwucm
