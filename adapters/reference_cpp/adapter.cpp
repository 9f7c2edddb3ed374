// Binds the C++ reference framework: the only file that knows both it and the SDK.
#include <lwucm/runtime.hpp>
#include <ucm_cts/main.hpp>
#include <ucm_cts/shaped.hpp>

struct Lwucm {
    typedef lwucm::PortElementObject PortElementObject;
    typedef lwucm::ComponentObject ComponentObject;
    typedef lwucm::FragmentObject FragmentObject;
    typedef lwucm::Connectable Connectable;
    typedef lwucm::Container Container;
    typedef lwucm::ContainerManager ContainerManager;
    typedef lwucm::NOT_FOUND NOT_FOUND;
    typedef lwucm::BAD_PARAMETER BAD_PARAMETER;
    typedef lwucm::UCM_ERROR UCM_ERROR;

    static std::shared_ptr<ContainerManager> create_runtime(
        const std::vector<ucm_cts::ShapedImplementation<Lwucm>>& implementations) {
        lwucm::Repository repository;
        for (const auto& one : implementations) {
            repository.add({one.name, one.provided, one.required, one.attributes, one.create, one.set_attribute});
        }
        return lwucm::create_runtime(repository);
    }

    static lwucm::Properties configuration(const std::string& implementation, const ucm_cts::Attributes& attributes) {
        return ucm_cts::properties<lwucm::Properties>("implementation", implementation, attributes);
    }
};

UCM_CTS_ADAPTER(ucm_cts::ShapedAdapter<Lwucm>, "lwucm reference framework (C++)", "0.1.0");
