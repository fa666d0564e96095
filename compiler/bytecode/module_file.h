// Bytecode as bytes: the .lsb file. Little-endian, with magic, version, sizes and a checksum; the
// .cpp draws the layout. Reading checks everything, ends with verify(), and never trusts a size.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/result.h"

#include <string>
#include <string_view>

namespace lsys {

// Version history. Every change of what a .lsb file can hold takes a new version: a field, an
// enumerator, an opcode or an operation of the turtle more, another order, another meaning.
//   1  The first format. Opcode BranchDraw, operation SaveBranch and profile Carey were added
//      without a new version.
//   2  Places of the modules in the text (template_places).
//   3  Stages of productions, depths of #decompose and #interpret, what happens at the greatest.
//   4  Source of random numbers, names of single characters; profiles l3d_program and
//   lplus_program;
//      operations TurnByPi, ParameterBegin, ParameterEnd and Text, in the middle of the others.
//      Rewriting mode Leftmost, profiles Fractint and Sidefx and their operations, HalfTurnSnapped
//      to DivideAngle, were added without a new version.
//   5  The contents of version 4, with all of these; traits of the turtle.
inline constexpr std::uint32_t kModuleFileVersion = 5;

#define LSYS_VERSION_MATTERS                                                                       \
    "what a .lsb file can hold has changed: raise kModuleFileVersion, add a line to its history, " \
    "then set this number"
static_assert(kCountOf<Opcode> == 44, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TurtleOperation> == 60, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TurtleProfile> == 12, LSYS_VERSION_MATTERS);
static_assert(kCountOf<RewritingMode> == 4, LSYS_VERSION_MATTERS);
static_assert(kCountOf<ChoiceScope> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<WeightRule> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<RandomSource> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<AtDepth> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<SymbolKind> == 5, LSYS_VERSION_MATTERS);
static_assert(kCountOf<PatternKind> == 3, LSYS_VERSION_MATTERS);
static_assert(kCountOf<Stage> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Settings> == 25, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<TurtleTraits> == 9, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeSymbol> == 6, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<FoldedModule> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeGlobal> == 8, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<PatternItem> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Site> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<SourceSpan> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<SiteMark> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<PlaceRun> == 6, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<TableRange> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<WordTemplate> == 4, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeProduction> == 15, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Bytecode> == 20, LSYS_VERSION_MATTERS);
#undef LSYS_VERSION_MATTERS

[[nodiscard]] std::string write_module_file(const Bytecode& bytecode);
/// Refuses, each with its own message: a foreign file, a newer or older version, a truncated one, a
/// checksum that does not fit, and contents that do not verify. The message does not name the file.
[[nodiscard]] Result<Bytecode> read_module_file(std::string_view bytes);
/// Whether these bytes begin like a .lsb file.
[[nodiscard]] bool is_module_file(std::string_view bytes);
/// Makes head, size and checksum fit whatever contents follow, so that tests reach what lies behind
/// them.
void seal_module_file(std::string& bytes);

} // namespace lsys
