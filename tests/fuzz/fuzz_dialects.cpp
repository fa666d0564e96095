// SPDX-License-Identifier: MIT
// Derives texts in every other dialect. Either there is an error, or the output of `lsc import`
// compiles and derives the same word.
#include "grammar/dialects/cpfg/curves.h"
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
    const CompiledText imported =
        compile_text(lsys::format_text(original.translation), lsys::Dialect::Lsys, "");
    if (!imported.bytecode ||
        derived_text(*original.bytecode) != derived_text(*imported.bytecode)) {
        std::abort();
    }
}

/// Reads `text` as a view file of cpfg; every file that it names has the same text.
void try_view(const std::string& text) {
    const lsys::CpfgView view =
        lsys::read_view(text, [&](std::string_view) { return std::optional<std::string>(text); });
    std::string grammar = "#n = 1;\n#w : A(0.5);\n";
    std::string sum = "0";
    for (const lsys::CpfgCurve& curve : view.curves) {
        if (!curve.points.empty() && grammar.size() < 100'000) {
            const std::string name = "f" + std::to_string(grammar.size());
            grammar += lsys::curve_statements(curve, {name, name + "_table", name + "_between"});
            sum += " + " + name + "(x)";
        }
    }
    grammar += "#p : A(x) : * : F(" + sum + ");\n";
    const CompiledText compiled = compile_text(grammar, lsys::Dialect::Lsys, "");
    if (compiled.bytecode) {
        static_cast<void>(derived_text(*compiled.bytecode));
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMaxSystems = 4;
    const std::string text(data, data + size);
    static_cast<void>(lsys::detect_dialect("fuzz", text));
    try_view(text);
    for (const lsys::DialectRow& row : lsys::dialects()) {
        if (row.dialect == lsys::Dialect::Lsys) {
            continue;
        }
        std::vector<std::string> systems = lsys::systems_in(row.dialect, text);
        systems.resize(std::min(systems.size(), kMaxSystems));
        try_system(text, row.dialect, "");
        for (const std::string& system : systems) {
            try_system(text, row.dialect, system);
        }
    }
    return 0;
}
