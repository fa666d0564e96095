// Places in the text that a Program does not keep, found again in the source when a message needs
// them, and words for messages.
#pragma once

#include "compiler/check/check.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// Module `index` of Program::modules, which stands in `word`, with its arguments.
[[nodiscard]] SourceSpan
module_span(const CheckInput& input, const ProgramWord& word, std::size_t index);

/// The arguments of that module.
[[nodiscard]] std::vector<SourceSpan>
argument_spans(const CheckInput& input, const ProgramWord& word, std::size_t index);

[[nodiscard]] SourceSpan item_span(const Production& production, const ProgramPatternItem& item);

/// "no parameters", "1 parameter", "2 parameters"
[[nodiscard]] std::string parameters_text(std::uint32_t count);

/// A name in back quotes; one that is a back quote or blank stays readable.
[[nodiscard]] std::string quoted(std::string_view name);

/// The shortest text that reads back as the same binary32 number.
[[nodiscard]] std::string number_text(float value);

/// Calls visit(index in Program::modules, index of its first argument in Program::arguments,
/// module) for each module of a word.
template <typename Visit>
void for_each_module(const Program& program, const ProgramWord& word, Visit&& visit) {
    std::size_t argument = word.first_argument;
    for (std::size_t i = word.first_module; i < std::size_t{word.first_module} + word.module_count;
         ++i) {
        const ProgramModule module = program.modules[i];
        visit(i, argument, module);
        argument += program.symbol(module.symbol).parameter_count;
    }
}

} // namespace lsys
