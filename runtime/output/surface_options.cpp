// SPDX-License-Identifier: MIT
#include "runtime/output/surface_options.h"

#include <fmt/format.h>

namespace lsys {

std::string find_surface_conflict(const SurfaceOptions& options, ExportFormat format) {
    const FormatTraits& traits = traits_of(format);
    if (options.up != UpAxis::Y && !traits.up_axes) {
        return fmt::format("--up z is for {}; {}",
                           format_names("and", [](const auto& each) { return each.up_axes; }),
                           traits.uses_mesh ? "glTF fixes +Y as up, and readers turn it to their "
                                              "own axis"
                                            : "a drawing shows X and Y");
    }
    if (options.both_sides && !traits.back_faces) {
        return fmt::format("--both-sides is for {}; {}",
                           format_names("and", [](const auto& each) { return each.back_faces; }),
                           traits.pictures != ExportPictures::None
                               ? "this format states which materials have two sides"
                               : "this format has no materials");
    }
    return {};
}

} // namespace lsys
