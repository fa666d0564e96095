// SPDX-License-Identifier: MIT
// ForestPrograms: shader programs of forests.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// Programs of the draw classes, for ForestBuffers::draw().
struct BranchPrograms {
    ProgramObject solid; // BranchClass::OneSided, TwoSided, and opaque picture files
    ProgramObject plain;
    ProgramObject cut_out;
    ProgramObject one_sample_cut_out; // `cut_out` for frames with one sample per pixel
    ProgramObject bumpy_cut_out;      // holes and a normal map; made from Medium on
};

struct ForestPrograms {
    BranchPrograms branches;
    ProgramObject impostor_depth; // draws depths before the colours are drawn
    // Variants for trees that are drawn in two LOD bands at once; `impostor` draws the colours of
    // whole and blended impostors.
    BranchPrograms blending_branches;
    ProgramObject blending_impostor_depth;
    // Programs that draw depths, for frames with one sample per pixel.
    ProgramObject one_sample_impostor_depth;
    ProgramObject one_sample_blending_impostor_depth;
    ProgramObject impostor;
    ProgramObject impostor_shadow;
    // Draws casters into the shadow maps near the eye; from Quality::Medium on.
    ProgramObject caster;
    ProgramObject cut_out_caster;
};

/// Programs that write kind and index of the part that each pixel shows: shaders/pick.frag.glsl.
struct ForestPickPrograms {
    ProgramObject branch; // all classes but cut-out leaves
    ProgramObject cut_out;
    ProgramObject blending_branch;
    ProgramObject blending_cut_out;
    ProgramObject impostor;
    ProgramObject blending_impostor;
};

/// `windy` and errors: as in make_forest_programs().
[[nodiscard]] Result<ForestPickPrograms>
make_pick_programs(Device& device, const ShaderSource& shaders, bool windy);

/// `windy`: whether trees sway; programs without wind are faster. Error: a shader does not compile.
[[nodiscard]] Result<ForestPrograms>
make_forest_programs(Device& device, const ShaderSource& shaders, bool windy);

} // namespace lsys::view
