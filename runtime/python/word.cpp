// SPDX-License-Identifier: MIT
// Words for Python.
#include "runtime/python/arrays.h"
#include "runtime/python/call.h"

#include <lsys/word.h>

namespace lsys_python {

namespace {

/// The numpy type of codes of `bytes` bytes each.
py::dtype code_type(std::uint32_t bytes) {
    return bytes == 1   ? py::dtype::of<std::uint8_t>()
           : bytes == 2 ? py::dtype::of<std::uint16_t>()
                        : py::dtype::of<std::uint32_t>();
}

/// Iterates over the modules of a word.
class WordIterator {
public:
    explicit WordIterator(lsys::Word word) : word_(std::move(word)) {}

    /// Name and parameters of the next module. Raises StopIteration at the end.
    py::tuple next() {
        if (position_ == word_.size()) {
            throw py::stop_iteration();
        }
        const lsys::ModuleKind& kind = word_.kinds()[code()];
        const std::span<const float> values =
            kind.stored_parameters != 0
                ? word_.parameters().subspan(parameter_, kind.stored_parameters)
                : std::span<const float>(kind.constants);
        ++position_;
        parameter_ += kind.stored_parameters;
        py::tuple parameters(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            parameters[i] = values[i];
        }
        return py::make_tuple(kind.name, std::move(parameters));
    }

private:
    [[nodiscard]] std::uint32_t code() const {
        switch (word_.code_bytes()) {
        case 1:
            return static_cast<const std::uint8_t*>(word_.codes())[position_];
        case 2:
            return static_cast<const std::uint16_t*>(word_.codes())[position_];
        default:
            return static_cast<const std::uint32_t*>(word_.codes())[position_];
        }
    }

    lsys::Word word_;
    std::uint64_t position_ = 0;  // of the next module in the word
    std::uint64_t parameter_ = 0; // index of its first parameter in Word::parameters()
};

} // namespace

void bind_word(py::module_& module) {
    py::class_<lsys::ModuleKind>(module, "ModuleKind", "The meaning of a code of a word.")
        .def_readonly("name", &lsys::ModuleKind::name)
        .def_readonly("stored_parameters", &lsys::ModuleKind::stored_parameters)
        .def_readonly("constants", &lsys::ModuleKind::constants);
    py::class_<WordIterator>(module, "WordIterator")
        .def("__iter__", [](py::object self) { return self; })
        .def("__next__", &WordIterator::next);
    py::class_<lsys::Word>(module, "Word", "A derived string of modules.")
        .def("__len__", &lsys::Word::size)
        .def("__iter__", [](const lsys::Word& word) { return WordIterator(word); })
        .def("__str__",
             [](const lsys::Word& word) {
                 std::string text;
                 {
                     const py::gil_scoped_release unlocked;
                     text = word.text();
                 }
                 return text;
             })
        .def_property_readonly("generation", &lsys::Word::generation)
        .def_property_readonly("seed", &lsys::Word::seed)
        .def_property_readonly("kinds", &lsys::Word::kinds)
        .def_property_readonly("codes",
                               [](const py::object& self) {
                                   const auto& word = self.cast<const lsys::Word&>();
                                   return view(code_type(word.code_bytes()),
                                               {static_cast<py::ssize_t>(word.size())},
                                               word.codes(), self);
                               })
        .def_property_readonly("parameters", [](const py::object& self) {
            const auto& word = self.cast<const lsys::Word&>();
            return view(py::dtype::of<float>(),
                        {static_cast<py::ssize_t>(word.parameters().size())},
                        word.parameters().data(), self);
        });
}

} // namespace lsys_python
