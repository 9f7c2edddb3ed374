// UCM_CTS_ADAPTER(AdapterClass, "product", "version"): to be written once, at namespace scope, in one source file.
//
// It defines `main` of a stand-alone adapter; compiled with -DUCM_CTS_PYTHON_MODULE=name, a Python module instead.
#ifndef UCM_CTS_MAIN_HPP
#define UCM_CTS_MAIN_HPP

#include <memory>

#ifdef UCM_CTS_PYTHON_MODULE
#include "ucm_cts/python_module.hpp"

#define UCM_CTS_ADAPTER(AdapterClass, product, version)                                  \
    PYBIND11_MODULE(UCM_CTS_PYTHON_MODULE, module) {                                     \
        ucm_cts::define_module(module, ucm_cts::Product{product, version},               \
                               [] { return std::make_shared<AdapterClass>(); });         \
    }                                                                                    \
    static_assert(true, "takes the semicolon")

#else
#include "ucm_cts/host.hpp"

#define UCM_CTS_ADAPTER(AdapterClass, product, version)                                  \
    int main(int argc, char** argv) {                                                    \
        return ucm_cts::host_main(argc, argv, ucm_cts::Product{product, version},        \
                                  [] { return std::make_shared<AdapterClass>(); });      \
    }                                                                                    \
    static_assert(true, "takes the semicolon")
#endif

#endif
