// SPDX-License-Identifier: MIT
// Reads any bytes as the files that lie beside a cpfg model: view (.v), curves (.func), contours
// (.con), surfaces (.s), colour maps (.map) and materials (.mat). Statements made from curves,
// contours and colours must compile. Every file that a view file names has the same text.
#include "grammar/dialects/cpfg/curves.h"
#include "grammar/dialects/cpfg/looks.h"
#include "grammar/dialects/cpfg/materials.h"
#include "grammar/dialects/cpfg/organs.h"
#include "runtime/meshing/patch_file.h"
#include "tests/fuzz/compiled.h"
#include "tests/fuzz/read_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kMaxGrammarBytes = 100'000;

/// The uses of a model with all commands, for which no line of a view file is left out.
lsys::CpfgUses all_uses() {
    lsys::CpfgUses uses;
    uses.sets_widths = uses.steps_widths = uses.steps_colours = true;
    uses.has_elasticity = uses.changes_tropisms = uses.has_any_colour = true;
    uses.has_any_texture = uses.sets_textures = true;
    for (unsigned colour = 0; colour < 256; ++colour) {
        uses.colours.insert(colour);
    }
    return uses;
}

/// Compiles and derives a grammar of `statements`. Returns whether it compiles.
bool compiles(const std::string& statements) {
    const CompiledText compiled = compile_text(
        "#n = 1;\n#w : A(0.5);\n#set turtle cpfg;\n" + statements, lsys::Dialect::Lsys, "");
    if (compiled.bytecode) {
        static_cast<void>(derived_text(*compiled.bytecode));
    }
    return compiled.bytecode.has_value();
}

std::string curve_grammar(const lsys::CpfgView& view) {
    std::string statements;
    std::string sum = "0";
    for (const lsys::CpfgCurve& curve : view.curves) {
        static_cast<void>(lsys::curve_table(curve));
        if (!curve.points.empty() && statements.size() < kMaxGrammarBytes) {
            const std::string name = "f" + std::to_string(statements.size());
            statements += lsys::curve_statements(curve, {name, name + "_table", name + "_between"});
            sum += " + " + name + "(x)";
        }
    }
    return statements + "#p : A(x) : * : F(" + sum + ");\n";
}

std::string contour_grammar(const lsys::CpfgOrgans& organs) {
    std::string statements;
    for (const auto& [number, contour] : organs.contours) {
        if (!contour.points.empty() && statements.size() < kMaxGrammarBytes) {
            statements += lsys::contour_statement(number, contour.points);
        }
    }
    return statements;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    const lsys::FileBeside beside = [&](std::string_view) {
        return lsys::Result<std::string>(text);
    };
    const lsys::CpfgOrgans organs = lsys::read_organs(lsys::kNoFile, text, beside);
    if (!compiles(curve_grammar(lsys::read_view(text, beside))) ||
        !compiles(contour_grammar(organs)) ||
        !compiles(lsys::material_statements(text, all_uses(), lsys::kFirstCpfgColour))) {
        std::abort();
    }
    for (const auto& [letter, surface] : organs.surfaces) {
        // A name with a quotation mark or a line end is refused by the scanner.
        static_cast<void>(compiles("#object " + letter + " " + lsys::object_text(surface) + ";\n"));
    }
    // Not all of these statements compile: they keep numbers of the file, as a width below 0.
    std::string looks;
    for (const lsys::CpfgLooks::Text& line :
         lsys::read_looks(lsys::kNoFile, text, all_uses()).statements) {
        looks += line.text + "\n";
    }
    static_cast<void>(compiles(looks));
    check_mesh(lsys::read_patches(text, {}, kMaxMeshBytes));
    return 0;
}
