// ForestPrograms: the shaders that forests are drawn with.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// By class: ForestBuffers::draw().
struct BranchPrograms {
    ProgramObject solid; // one-sided, two-sided
    ProgramObject plain;
    ProgramObject cut_out;
};

struct ForestPrograms {
    BranchPrograms branches;
    ProgramObject impostor_depth; // drawn first, and light only where it is the same
    // The same for what is drawn as two things; light is found alike.
    BranchPrograms blending_branches;
    ProgramObject blending_impostor_depth;
    ProgramObject impostor;
    ProgramObject impostor_shadow;
};

/// `windy`: trees move; without, no time is lost on that. Error: a shader does not compile.
[[nodiscard]] Result<ForestPrograms>
make_forest_programs(Device& device, const ShaderSource& shaders, bool windy);

} // namespace lsys::view
