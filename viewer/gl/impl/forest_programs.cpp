// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/forest_programs.h"

#include "viewer/gl/impl/program.h"

#include <array>
#include <string>
#include <utility>

namespace lsys::view {

Result<ForestPrograms>
make_forest_programs(Device& device, const ShaderSource& shaders, bool windy) {
    ForestPrograms programs;
    struct ProgramSpec {
        ProgramObject* program;
        const char* vertex;
        const char* fragment;
        const char* defines;
        bool is_costly = false; // used from Quality::Medium on only
    };
    constexpr const char* kBranch = "branch.vert.glsl";
    constexpr const char* kImpostor = "impostor.vert.glsl";
    const std::array<ProgramSpec, 18> wanted = {
        {{&programs.branches.solid, kBranch, "branch.frag.glsl", ""},
         {&programs.branches.plain, kBranch, "leaf.frag.glsl", "#define LIT_AT_CORNERS\n"},
         {&programs.branches.cut_out, kBranch, "leaf.frag.glsl",
          "#define LIT_AT_CORNERS\n#define CUT_OUT\n"},
         {&programs.branches.one_sample_cut_out, kBranch, "leaf.frag.glsl",
          "#define LIT_AT_CORNERS\n#define CUT_OUT\n#define ONE_SAMPLE\n"},
         {&programs.blending_branches.solid, kBranch, "branch.frag.glsl", "#define BLENDS\n"},
         {&programs.blending_branches.plain, kBranch, "leaf.frag.glsl",
          "#define LIT_AT_CORNERS\n#define BLENDS\n"},
         {&programs.blending_branches.cut_out, kBranch, "leaf.frag.glsl",
          "#define LIT_AT_CORNERS\n#define CUT_OUT\n#define BLENDS\n"},
         {&programs.blending_branches.one_sample_cut_out, kBranch, "leaf.frag.glsl",
          "#define LIT_AT_CORNERS\n#define CUT_OUT\n#define BLENDS\n#define ONE_SAMPLE\n"},
         {&programs.branches.bumpy_cut_out, kBranch, "branch.frag.glsl", "#define CUT_OUT\n", true},
         {&programs.blending_branches.bumpy_cut_out, kBranch, "branch.frag.glsl",
          "#define CUT_OUT\n#define BLENDS\n", true},
         {&programs.caster, kBranch, "pick.frag.glsl", "#define PICK\n", true},
         {&programs.cut_out_caster, kBranch, "pick.frag.glsl", "#define PICK\n#define CUT_OUT\n",
          true},
         {&programs.impostor, kImpostor, "impostor.frag.glsl", ""},
         {&programs.impostor_depth, kImpostor, "impostor.frag.glsl", "#define DEPTH\n"},
         {&programs.blending_impostor_depth, kImpostor, "impostor.frag.glsl",
          "#define DEPTH\n#define BLENDS\n"},
         {&programs.one_sample_impostor_depth, kImpostor, "impostor.frag.glsl",
          "#define DEPTH\n#define ONE_SAMPLE\n"},
         {&programs.one_sample_blending_impostor_depth, kImpostor, "impostor.frag.glsl",
          "#define DEPTH\n#define BLENDS\n#define ONE_SAMPLE\n"},
         {&programs.impostor_shadow, kImpostor, "impostor.frag.glsl", "#define SHADOW\n"}}};
    const std::string common = windy ? "#define ONE_TAP\n#define WIND\n" : "#define ONE_TAP\n";
    for (const ProgramSpec& one : wanted) {
        if (one.is_costly && device.quality() == 0) {
            continue;
        }
        Result<ProgramObject> made =
            make_program(device, shaders, one.vertex, one.fragment, common + one.defines);
        if (!made) {
            return made.error();
        }
        *one.program = std::move(made.value());
    }
    return programs;
}

Result<ForestPickPrograms>
make_pick_programs(Device& device, const ShaderSource& shaders, bool windy) {
    ForestPickPrograms programs;
    struct ProgramSpec {
        ProgramObject* program;
        const char* vertex;
        const char* fragment;
        const char* defines;
    };
    constexpr const char* kBranch = "branch.vert.glsl";
    constexpr const char* kPick = "pick.frag.glsl";
    constexpr const char* kImpostor = "impostor.vert.glsl";
    constexpr const char* kImpostorPick = "impostor.frag.glsl";
    const std::array<ProgramSpec, 6> wanted = {
        {{&programs.branch, kBranch, kPick, ""},
         {&programs.cut_out, kBranch, kPick, "#define CUT_OUT\n"},
         {&programs.blending_branch, kBranch, kPick, "#define BLENDS\n"},
         {&programs.blending_cut_out, kBranch, kPick, "#define CUT_OUT\n#define BLENDS\n"},
         {&programs.impostor, kImpostor, kImpostorPick, "#define DEPTH\n"},
         {&programs.blending_impostor, kImpostor, kImpostorPick,
          "#define DEPTH\n#define BLENDS\n"}}};
    const std::string common =
        windy ? "#define PICK\n#define ONE_TAP\n#define WIND\n" : "#define PICK\n#define ONE_TAP\n";
    for (const ProgramSpec& one : wanted) {
        Result<ProgramObject> made =
            make_program(device, shaders, one.vertex, one.fragment, common + one.defines);
        if (!made) {
            return made.error();
        }
        *one.program = std::move(made.value());
    }
    return programs;
}

} // namespace lsys::view
