// SPDX-License-Identifier: MIT
// Compiles any bytes as a file of one dialect, LSYS_FUZZ_DIALECT. Either there is an error, or the
// output of `lsc import` compiles, keeps its form when it is formatted again, and derives the same
// word or stops for the same reason.
#include "grammar/format/format.h"
#include "tests/fuzz/compiled.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void try_system(const std::string& text, lsys::Dialect dialect, const std::string& system) {
    const CompiledText original = compile_text(text, dialect, system);
    if (!original.bytecode) {
        return;
    }
    const std::string translation = lsys::format_text(original.translation);
    const CompiledText imported = compile_text(translation, lsys::Dialect::Lsys, "");
    if (!imported.bytecode || lsys::format_text(translation) != translation ||
        derived_text(*original.bytecode) != derived_text(*imported.bytecode)) {
        std::abort();
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMaxSystems = 4;
    static const lsys::Dialect dialect = lsys::find_dialect(LSYS_FUZZ_DIALECT).value();
    const std::string text(data, data + size);
    static_cast<void>(lsys::detect_dialect("fuzz", text));
    std::vector<std::string> systems = lsys::systems_in(dialect, text);
    systems.resize(std::min(systems.size(), kMaxSystems));
    try_system(text, dialect, "");
    for (const std::string& system : systems) {
        try_system(text, dialect, system);
    }
    return 0;
}
