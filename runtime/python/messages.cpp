// SPDX-License-Identifier: MIT
// Messages and grammars for Python.
#include "runtime/python/call.h"

#include <lsys/messages.h>
#include <lsys/word.h>
#include <type_traits>
#include <vector>

namespace lsys_python {

namespace {

/// The value of a member as Python stores it: an enumerator as its number.
template <typename Value>
auto stored(const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
        return static_cast<int>(value);
    } else {
        return value;
    }
}

template <typename Value>
void restore(Value& value, const py::handle& from) {
    if constexpr (std::is_enum_v<Value>) {
        value = static_cast<Value>(from.cast<int>());
    } else {
        value = from.cast<Value>();
    }
}

/// Lets `pickle` copy objects with these public members, as process pools copy exceptions. The
/// function `restorer` of the module makes an object of its members: the classes have no
/// constructor.
template <typename T, typename... Values>
void add_pickle(py::module_& module,
                py::class_<T>& type,
                const char* restorer,
                Values T::*... members) {
    module.def(restorer, [members...](const py::args& state) {
        if (state.size() != sizeof...(members)) {
            throw py::value_error("pickled by another version of lsys");
        }
        T value;
        std::size_t i = 0;
        (restore(value.*members, state[i++]), ...);
        return value;
    });
    type.def("__reduce__", [restorer, members...](const T& value) {
        // `pickle` finds Python functions by name, but not functions of pybind11 2.10.
        return py::make_tuple(py::module_::import("lsys.errors").attr("restored"),
                              py::make_tuple(restorer, stored(value.*members)...));
    });
}

} // namespace

void bind_messages(py::module_& module) {
    py::class_<lsys::Place> place(module, "Place",
                                  "A range of characters of a file; the end is exclusive.");
    place.def_readonly("file", &lsys::Place::file)
        .def_readonly("line", &lsys::Place::line)
        .def_readonly("column", &lsys::Place::column)
        .def_readonly("end_line", &lsys::Place::end_line)
        .def_readonly("end_column", &lsys::Place::end_column)
        .def_readonly("offset", &lsys::Place::offset)
        .def_readonly("end_offset", &lsys::Place::end_offset)
        .def("__repr__", [](const lsys::Place& shown) {
            return "Place(" + shown.file + ":" + std::to_string(shown.line) + ":" +
                   std::to_string(shown.column) + ")";
        });
    add_pickle(module, place, "_restored_place", &lsys::Place::file, &lsys::Place::line,
               &lsys::Place::column, &lsys::Place::end_line, &lsys::Place::end_column,
               &lsys::Place::offset, &lsys::Place::end_offset);
    py::class_<lsys::Edit> edit(module, "Edit", "Replaces the text of a place.");
    edit.def_readonly("place", &lsys::Edit::place)
        .def_readonly("replacement", &lsys::Edit::replacement);
    add_pickle(module, edit, "_restored_edit", &lsys::Edit::place, &lsys::Edit::replacement);
    py::class_<lsys::Fix> fix(module, "Fix", "A repair: edits that are applied together.");
    fix.def_readonly("title", &lsys::Fix::title)
        .def_readonly("edits", &lsys::Fix::edits)
        .def_readonly("certain", &lsys::Fix::certain);
    add_pickle(module, fix, "_restored_fix", &lsys::Fix::title, &lsys::Fix::edits,
               &lsys::Fix::certain);
    py::class_<lsys::Label> label(module, "Label", "A further place of a diagnostic.");
    label.def_readonly("place", &lsys::Label::place).def_readonly("text", &lsys::Label::text);
    add_pickle(module, label, "_restored_label", &lsys::Label::place, &lsys::Label::text);
    py::class_<lsys::Diagnostic> diagnostic(module, "Diagnostic",
                                            "A message with its place and repairs.");
    diagnostic
        .def_property_readonly("severity",
                               [](const lsys::Diagnostic& shown) {
                                   return shown.severity == lsys::Severity::Error     ? "error"
                                          : shown.severity == lsys::Severity::Warning ? "warning"
                                                                                      : "note";
                               })
        .def_readonly("code", &lsys::Diagnostic::code)
        .def_readonly("message", &lsys::Diagnostic::message)
        .def_readonly("place", &lsys::Diagnostic::place)
        .def_readonly("label", &lsys::Diagnostic::label)
        .def_readonly("labels", &lsys::Diagnostic::labels)
        .def_readonly("notes", &lsys::Diagnostic::notes)
        .def_property_readonly("help",
                               [](const lsys::Diagnostic& shown) {
                                   std::vector<std::string> help;
                                   for (const std::string& text : shown.help) {
                                       help.push_back(with_argument_names(text));
                                   }
                                   return help;
                               })
        .def_readonly("fixes", &lsys::Diagnostic::fixes)
        .def("__repr__", [](const lsys::Diagnostic& shown) {
            return "<Diagnostic " + shown.code + ": " + shown.message + ">";
        });
    add_pickle(module, diagnostic, "_restored_diagnostic", &lsys::Diagnostic::severity,
               &lsys::Diagnostic::code, &lsys::Diagnostic::message, &lsys::Diagnostic::place,
               &lsys::Diagnostic::label, &lsys::Diagnostic::labels, &lsys::Diagnostic::notes,
               &lsys::Diagnostic::help, &lsys::Diagnostic::fixes);
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
