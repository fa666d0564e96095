// SPDX-License-Identifier: MIT
// The Python module lsys._lsys: the public library for Python, arrays as views of numpy without
// copies. The package in lsys/ adds functions that are easier to write in Python.
#include "runtime/python/call.h"

#include <lsys/api.h>

PYBIND11_MODULE(_lsys, module) {
    module.doc() = "L-systems: compile grammars, derive words, draw and mesh plants and forests.";
    module.attr("__version__") = lsys::version();
    lsys_python::bind_messages(module);
    lsys_python::bind_grammar(module);
    lsys_python::bind_word(module);
    lsys_python::bind_plant(module);
    lsys_python::bind_forest(module);
}
