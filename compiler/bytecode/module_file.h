// SPDX-License-Identifier: MIT
// The .lsb file: Bytecode as little-endian bytes with magic, version, sizes and a checksum;
// module_file.cpp describes the layout. Reading checks every size before memory is allocated, and
// ends with verify().
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/result.h"

#include <string>
#include <string_view>

namespace lsys {

// Version history. Every change of the contents of a .lsb file takes a new version: a new field,
// enumerator, opcode or turtle operation, another order, another meaning.
//   1  The first format. Opcode BranchDraw, operation SaveBranch and profile Carey were added
//      without a new version.
//   2  Places of the modules in the text (template_places).
//   3  Stages of productions, depths of #decompose and #interpret, treatment at the max depth.
//   4  Source of random numbers, names of single characters; profiles l3d_program and
//      lplus_program; operations TurnByPi, ParameterBegin, ParameterEnd and Text, inserted between
//      older ones.
//      Rewriting mode Leftmost, profiles Fractint and Sidefx and their operations, HalfTurnSnapped
//      to DivideAngle, were added without a new version.
//   5  Version 4 with all of these additions, and traits of the turtle.
//   6  Height and pipe model of the plant; springs from the elasticity, and the load of a joint.
//   7  Droop of leaves, and segments that are boxes, among the traits of the turtle.
//   8  Local values and their slots, choices, the depth of the stack; opcodes Local to EndIf.
//   9  Curves, distributions, weights that are computed, several axioms.
//  10  Materials of colour indexes; operation SetRgb.
//  11  Flare of stems, collars, shapes of tips; taper of the pipe model.
//  12  Profile Cpfg, its trait for the corners of polygons, and its operations.
//  13  Sense modules, environments, the stages of sweeps.
//  14  Contours, the operations of organs, SurfaceBegin to SetContour, and the trait of their
//      tangents; tropisms whose strength the word changes, with their operations; unit and increment
//      of widths; first colour; operations NarrowWidth, WidenWidth and PreviousColour.
//  15  Increment of colours, scale of the plant, shape of the word, operations SurfaceRadii and
//      SetTexture, traits organs_branch and colours_wrap.
inline constexpr std::uint32_t kModuleFileVersion = 15;

#define LSYS_VERSION_MATTERS                                                                       \
    "what a .lsb file can hold has changed: raise kModuleFileVersion, add a line to its history, " \
    "then set this number"
static_assert(kCountOf<Opcode> == 54, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TurtleOperation> == 80, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TurtleProfile> == 13, LSYS_VERSION_MATTERS);
static_assert(kCountOf<RewritingMode> == 4, LSYS_VERSION_MATTERS);
static_assert(kCountOf<ChoiceScope> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<WeightRule> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<RandomSource> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<AtDepth> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<LoadRule> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TipShape> == 3, LSYS_VERSION_MATTERS);
static_assert(kCountOf<WidthUnit> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<WordShape> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<TropismKind> == 4, LSYS_VERSION_MATTERS);
static_assert(kCountOf<SymbolKind> == 5, LSYS_VERSION_MATTERS);
static_assert(kCountOf<PatternKind> == 3, LSYS_VERSION_MATTERS);
static_assert(kCountOf<Stage> == 5, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Settings> == 40, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<StepTropism> == 5, LSYS_VERSION_MATTERS);
static_assert(std::tuple_size_v<StepTropisms> == 11, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<TurtleTraits> == 15, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Pipe> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Flare> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeSymbol> == 7, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<FoldedModule> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeGlobal> == 8, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<PatternItem> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Site> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<SourceSpan> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<SiteRange> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<PlaceRun> == 6, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<TableRange> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeCurve> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeContour> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<ContourPoint> == 2, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeMaterial> == 11, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodePicture> == 2, LSYS_VERSION_MATTERS);
static_assert(kCountOf<EnvironmentKind> == 7, LSYS_VERSION_MATTERS);
static_assert(kCountOf<SpaceShape> == 5, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeEnvironment> == 19, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<EnvironmentSurface> == 3, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeAxiom> == 4, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<WordTemplate> == 5, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<BytecodeProduction> == 16, LSYS_VERSION_MATTERS);
static_assert(kFieldCount<Bytecode> == 24, LSYS_VERSION_MATTERS);
#undef LSYS_VERSION_MATTERS

[[nodiscard]] std::string write_module_file(const Bytecode& bytecode);
/// Fails with its own message for a foreign file, a newer or older version, a truncated file, a
/// wrong checksum, and contents that do not verify. The message does not name the file.
[[nodiscard]] Result<Bytecode> read_module_file(std::string_view bytes);
/// Whether the bytes begin with the magic of a .lsb file.
[[nodiscard]] bool is_module_file(std::string_view bytes);
/// Makes magic, version, size and checksum in the header of `bytes` fit the contents. A test calls
/// it after it has changed the contents, so that read_module_file() gets as far as the contents.
void seal_module_file(std::string& bytes);

} // namespace lsys
