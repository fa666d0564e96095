// SPDX-License-Identifier: MIT
// Messages and grammars for Python.
#include "runtime/python/call.h"

#include <lsys/messages.h>
#include <lsys/word.h>
#include <vector>

namespace lsys_python {

void bind_messages(py::module_& module) {
    py::class_<lsys::Place>(module, "Place",
                            "A range of characters of a file; the end is exclusive.")
        .def_readonly("file", &lsys::Place::file)
        .def_readonly("line", &lsys::Place::line)
        .def_readonly("column", &lsys::Place::column)
        .def_readonly("end_line", &lsys::Place::end_line)
        .def_readonly("end_column", &lsys::Place::end_column)
        .def_readonly("offset", &lsys::Place::offset)
        .def_readonly("end_offset", &lsys::Place::end_offset)
        .def("__repr__", [](const lsys::Place& place) {
            return "Place(" + place.file + ":" + std::to_string(place.line) + ":" +
                   std::to_string(place.column) + ")";
        });
    py::class_<lsys::Edit>(module, "Edit", "Replaces the text of a place.")
        .def_readonly("place", &lsys::Edit::place)
        .def_readonly("replacement", &lsys::Edit::replacement);
    py::class_<lsys::Fix>(module, "Fix", "A repair: edits that are applied together.")
        .def_readonly("title", &lsys::Fix::title)
        .def_readonly("edits", &lsys::Fix::edits)
        .def_readonly("certain", &lsys::Fix::certain);
    py::class_<lsys::Label>(module, "Label", "A further place of a diagnostic.")
        .def_readonly("place", &lsys::Label::place)
        .def_readonly("text", &lsys::Label::text);
    py::class_<lsys::Diagnostic>(module, "Diagnostic", "A message with its place and repairs.")
        .def_property_readonly("severity",
                               [](const lsys::Diagnostic& diagnostic) {
                                   return diagnostic.severity == lsys::Severity::Error ? "error"
                                          : diagnostic.severity == lsys::Severity::Warning
                                              ? "warning"
                                              : "note";
                               })
        .def_readonly("code", &lsys::Diagnostic::code)
        .def_readonly("message", &lsys::Diagnostic::message)
        .def_readonly("place", &lsys::Diagnostic::place)
        .def_readonly("label", &lsys::Diagnostic::label)
        .def_readonly("labels", &lsys::Diagnostic::labels)
        .def_readonly("notes", &lsys::Diagnostic::notes)
        .def_property_readonly("help",
                               [](const lsys::Diagnostic& diagnostic) {
                                   std::vector<std::string> help;
                                   for (const std::string& text : diagnostic.help) {
                                       help.push_back(with_argument_names(text));
                                   }
                                   return help;
                               })
        .def_readonly("fixes", &lsys::Diagnostic::fixes)
        .def("__repr__", [](const lsys::Diagnostic& diagnostic) {
            return "<Diagnostic " + diagnostic.code + ": " + diagnostic.message + ">";
        });
}

void bind_grammar(py::module_& module) {
    py::class_<lsys::Constant>(module, "Constant", "A `#define` or `#param` of a grammar.")
        .def_readonly("name", &lsys::Constant::name)
        .def_readonly("is_parameter", &lsys::Constant::is_parameter)
        .def_property_readonly("value",
                               [](const lsys::Constant& constant) -> py::object {
                                   return constant.is_random ? py::object(py::none())
                                                             : py::float_(constant.value);
                               })
        .def_property_readonly("bounds", [](const lsys::Constant& constant) -> py::object {
            return constant.is_parameter ? py::object(py::make_tuple(constant.min, constant.max))
                                         : py::object(py::none());
        });
    py::class_<lsys::PredictedSize>(module, "PredictedSize",
                                    "Bounds of the number of modules of one generation.")
        .def_readonly("low", &lsys::PredictedSize::low)
        .def_readonly("high", &lsys::PredictedSize::high)
        .def_readonly("low_segments", &lsys::PredictedSize::low_segments)
        .def_readonly("high_segments", &lsys::PredictedSize::high_segments)
        .def_readonly("max_bytes", &lsys::PredictedSize::max_bytes);
    py::class_<lsys::Grammar>(module, "Grammar", "A compiled L-system.")
        .def_property_readonly("name", &lsys::Grammar::name)
        .def_property_readonly("generations", &lsys::Grammar::generations)
        .def_property_readonly("seed", &lsys::Grammar::seed)
        .def_property_readonly("constants", &lsys::Grammar::constants)
        .def_property_readonly("translation", &lsys::Grammar::translation)
        .def_property_readonly(
            "bytecode", [](const lsys::Grammar& grammar) { return py::bytes(grammar.bytecode()); })
        .def("predict", &lsys::Grammar::predict, "generations"_a,
             py::call_guard<py::gil_scoped_release>())
        .def(
            "derive",
            [](const lsys::Grammar& grammar, std::optional<std::uint32_t> generations,
               std::optional<std::uint64_t> seed, const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::derive(grammar, {generations, seed}, project);
                }));
            },
            "generations"_a = py::none(), "seed"_a = py::none())
        .def(
            "grow",
            [](const lsys::Grammar& grammar, std::optional<std::uint32_t> generations,
               std::optional<std::uint64_t> seed, std::optional<float> height, bool stream,
               const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::grow(grammar, {generations, seed, height, stream}, project);
                }));
            },
            "generations"_a = py::none(), "seed"_a = py::none(), "height"_a = py::none(),
            "stream"_a = false);
    module.def(
        "compile_file",
        [](const std::string& path, const std::map<std::string, float>& defines,
           const py::dict& settings, std::optional<std::uint32_t> generations,
           const std::string& dialect, const std::string& system, bool bug_compatible,
           const py::kwargs& rest) {
            const lsys::GrammarOptions options =
                grammar_options(defines, settings, generations, dialect, system, bug_compatible);
            return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                return lsys::compile_file(path, options, project);
            }));
        },
        "path"_a, "defines"_a, "settings"_a, "generations"_a, "dialect"_a, "system"_a,
        "bug_compatible"_a);
    module.def(
        "compile_text",
        [](const std::string& text, const std::string& name,
           const std::map<std::string, float>& defines, const py::dict& settings,
           std::optional<std::uint32_t> generations, const std::string& dialect,
           const std::string& system, bool bug_compatible, const py::kwargs& rest) {
            const lsys::GrammarOptions options =
                grammar_options(defines, settings, generations, dialect, system, bug_compatible);
            return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                return lsys::compile_text(text, name, options, project);
            }));
        },
        "text"_a, "name"_a, "defines"_a, "settings"_a, "generations"_a, "dialect"_a, "system"_a,
        "bug_compatible"_a);
}

} // namespace lsys_python
