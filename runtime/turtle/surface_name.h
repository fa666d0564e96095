// SPDX-License-Identifier: MIT
// The name of a surface file in `#object X "leaf.s#0.5 texture 2 whole";`: the path, and how the
// surface is drawn (docs/language.md section 15.4).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

struct SurfaceName {
    std::string_view path;
    float scale = 1.0F;
    /// Steps of a patch from row to row and along the rows of control points; 0: those of the file.
    std::uint32_t row_steps = 0;
    std::uint32_t column_steps = 0;
    std::optional<std::uint32_t> texture; // in place of the turtle's; 0: none
    bool is_whole = false; // texture coordinates run once over the surface, not over each patch
};

inline constexpr std::uint32_t kMaxSurfaceTexture = 255;

/// The parts of the name of a surface file, which ends in `.s` or `.S`; nullopt for another name.
[[nodiscard]] std::optional<SurfaceName> surface_name(std::string_view name);
/// The path of a surface file; other names as they are.
[[nodiscard]] std::string path_of_object(const std::string& name);

} // namespace lsys
