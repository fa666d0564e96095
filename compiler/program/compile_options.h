// SPDX-License-Identifier: MIT
// Options of a compilation, for every step from the Ast to the Bytecode.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// `-D NAME=value`.
struct Definition {
    std::string name;
    float value = 0.0F;

    friend bool operator==(const Definition&, const Definition&) = default;
};

/// `--set KEY=VALUES`: replaces the `#set` statements of a key.
struct SettingText {
    std::string key;
    std::string values; // text as in `#set KEY VALUES;`: `30`, `0 -1 0 0.2`, `cpfg`

    friend bool operator==(const SettingText&, const SettingText&) = default;
};

struct Ast;

struct CompileOptions {
    std::vector<Definition> definitions;
    /// Ast whose `#set` statements replace `#set` statements of the grammar with the same keys.
    /// They may use the constants of the grammar; the two Asts share one Names. Null: no
    /// replacements.
    Ast* settings = nullptr;
    std::optional<std::uint32_t> generations; // -n; suppresses the warning about a missing #n
    std::uint64_t max_modules = std::uint64_t{1}
                                << 32; // modules per word; a warning reports larger words
    /// The text is a file for `#include`: axiom and names may be defined elsewhere. Such a text is
    /// only checked, not compiled.
    bool part = false;
    bool lower = true; // false: stop after the Program
};

} // namespace lsys
