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

struct CompileOptions {
    std::vector<Definition> definitions;
    std::optional<std::uint32_t> generations; // -n; a missing #n then gets no warning
    std::uint64_t max_modules = std::uint64_t{1}
                                << 32; // for the warning about words that grow past it
    bool lower = true;                 // false: stop after the Program
};

} // namespace lsys
