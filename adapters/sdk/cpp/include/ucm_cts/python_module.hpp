// An adapter as a Python module, for debuggers, benchmarks and hosts written in Python. Needs pybind11 and C++17.
#ifndef UCM_CTS_PYTHON_MODULE_HPP
#define UCM_CTS_PYTHON_MODULE_HPP

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "ucm_cts/messages.hpp"
#include "ucm_cts/native.hpp"

namespace ucm_cts {

/// The module has `answer`, `Runtime`, `life_cycles`, the three exceptions, and `product` and `version`.
inline void define_module(pybind11::module_& module, const Product& product, const AdapterFactory& make_adapter) {
    namespace py = pybind11;

    module.attr("product") = product.name;
    module.attr("version") = product.version;
    py::register_local_exception<NotFound>(module, "NotFound");
    py::register_local_exception<BadParameter>(module, "BadParameter");
    py::register_local_exception<UcmError>(module, "UcmError");

    module.def(
        "answer",
        [product, make_adapter](const py::bytes& message, const py::object& emit) {
            const std::string line = message;
            Answerer::Emit sink;
            if (!emit.is_none()) {
                sink = [&emit](const std::string& event) {
                    const py::gil_scoped_acquire gil;
                    try {
                        emit(py::bytes(event));
                    } catch (py::error_already_set& error) {  // must not reach the framework under test
                        error.discard_as_unraisable("the emit callback of answer");
                    }
                };
            }
            std::string out;
            {
                const py::gil_scoped_release no_gil;
                Answerer answerer(product, make_adapter, sink);
                out = answerer.answer(line.data(), line.size());
            }
            return py::bytes(out);
        },
        py::arg("message"), py::arg("emit") = py::none(),
        "Answer one wire message; a streamed run calls emit with each event's line.");

    module.def(
        "life_cycles", [make_adapter](std::int64_t count) { return life_cycles(make_adapter(), count); },
        py::arg("count"), py::call_guard<py::gil_scoped_release>(),
        "Mean nanoseconds of one life cycle of a provider and a client, all in C++.");

    struct Opaque {
        Reference reference;
    };
    py::class_<Opaque>(module, "Reference", py::module_local());

    typedef std::tuple<std::string, std::vector<std::string>, std::vector<std::string>> Model;
    py::class_<Runtime>(module, "Runtime", py::module_local(),
                        "The Container API of a fresh runtime, with bodies that record nothing.")
        .def(py::init([make_adapter](const std::vector<Model>& models) {
                 std::vector<Implementation> implementations;
                 for (const Model& model : models) {
                     implementations.push_back(
                         native_implementation(std::get<0>(model), std::get<1>(model), std::get<2>(model)));
                 }
                 return std::make_unique<Runtime>(make_adapter(), implementations);
             }),
             py::arg("implementations"), "implementations: (name, provided port elements, required port elements)")
        .def("add_component", &Runtime::add_component, py::arg("implementation"))
        .def("remove_component", &Runtime::remove_component, py::arg("comp_instance"))
        .def(
            "get_port_element",
            [](Runtime& runtime, Id id, const std::string& port) {
                return Opaque{runtime.get_port_element(id, port)};
            },
            py::arg("comp_instance"), py::arg("port_name"))
        .def(
            "connect",
            [](Runtime& runtime, Id id, const std::string& port, const Opaque* to) {
                return runtime.connect(id, port, to != nullptr ? to->reference : Reference());
            },
            py::arg("instance"), py::arg("port_name"), py::arg("to_port").none(true))
        .def("disconnect", &Runtime::disconnect, py::arg("connection"))
        .def("start", &Runtime::start)
        .def("stop", &Runtime::stop)
        .def("get_components", &Runtime::get_components)
        .def("destroy", &Runtime::destroy)
        .def(
            "exchange",
            [](Runtime&, const Opaque& to, std::int32_t value) {
                if (!to.reference) {
                    throw BadParameter("the reference is null");
                }
                return to.reference->exchange(value);
            },
            py::arg("ref"), py::arg("value"));
}

}  // namespace ucm_cts

#endif
