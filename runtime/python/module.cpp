// SPDX-License-Identifier: MIT
// The Python module lsys._lsys: the public library for Python, arrays as views of numpy without
// copies. The package in lsys/ adds functions that are easier to write in Python.
#include "runtime/python/call.h"

#include <lsys/api.h>
#include <string>

namespace {

/// Lets `__new__` of classes without constructors raise TypeError: it would make objects without a
/// value, which no function can use.
void refuse_new(const pybind11::module_& module) {
    for (const auto& [key, value] : pybind11::dict(module.attr("__dict__"))) {
        if (!pybind11::isinstance<pybind11::type>(value)) {
            continue;
        }
        // pybind11 gives a class without constructors an `__init__` that is a slot of C.
        const pybind11::type kind = pybind11::type::of(value.attr("__init__"));
        if (kind.attr("__name__").cast<std::string>() != "wrapper_descriptor") {
            continue;
        }
        const std::string text = pybind11::str(key).cast<std::string>() + " has no constructor";
        value.attr("__new__") = pybind11::module_::import("builtins")
                                    .attr("staticmethod")(pybind11::cpp_function(
                                        [text](const pybind11::args&, const pybind11::kwargs&) {
                                            throw pybind11::type_error(text);
                                        }));
    }
}

} // namespace

PYBIND11_MODULE(_lsys, module) {
    module.doc() = "L-systems: compile grammars, derive words, draw and mesh plants and forests.";
    module.attr("__version__") = lsys::version();
    lsys_python::bind_messages(module);
    lsys_python::bind_grammar(module);
    lsys_python::bind_word(module);
    lsys_python::bind_plant(module);
    lsys_python::bind_forest(module);
    refuse_new(module);
}
