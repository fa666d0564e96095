// SPDX-License-Identifier: MIT
// Checks of verify() for parts of the bytecode that do not refer to its code. Each function ending
// in `_problem` returns the first mistake of its part, or nothing.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace lsys {

/// Whether messages can show the text: it has no control characters.
[[nodiscard]] inline bool is_printable(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char character) {
        const auto byte = static_cast<unsigned char>(character);
        return byte >= 0x20 && byte != 0x7F;
    });
}

/// Whether `index` is kNone or a row of Bytecode::sites.
[[nodiscard]] inline bool is_site(const Bytecode& bytecode, std::uint32_t index) {
    return index == kNone || index < bytecode.sites.size();
}

/// Settings, tropisms among them, and the number of generations.
[[nodiscard]] std::optional<std::string> settings_problem(const Bytecode& bytecode);
[[nodiscard]] std::optional<std::string> curves_problem(const Bytecode& bytecode);
[[nodiscard]] std::optional<std::string> contours_problem(const Bytecode& bytecode);
[[nodiscard]] std::optional<std::string> materials_problem(const Bytecode& bytecode);
[[nodiscard]] std::optional<std::string> environments_problem(const Bytecode& bytecode);

/// Whether the successor of a production of a sweep is one module of the predecessor's name and
/// number of parameters. Precondition: the predecessor is one module.
[[nodiscard]] bool changes_only_parameters(const Bytecode& bytecode,
                                           const BytecodeProduction& production);

} // namespace lsys
