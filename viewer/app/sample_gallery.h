// SPDX-License-Identifier: MIT
// The samples that are installed with lsc, with their titles and pictures.
#pragma once

#include "runtime/meshing/texture.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

struct GallerySample {
    std::string name;    // name of its folder
    std::string file;    // a grammar or a scene
    std::string title;   // first sentence of the file's first comment
    std::string picture; // PNG; empty: none
};

/// The folder of the samples: `share/lsc/samples` beside the folder of the running program; or
/// `samples` in a parent folder of the program, for a build in the source tree; or `lsc/samples` in
/// a folder of `$XDG_DATA_DIRS`. Empty if there is none.
[[nodiscard]] std::string samples_folder();

/// The samples in a folder: species, then scenes, then others, each in alphabetical order. A sample
/// is a folder NAME that has a file NAME.lsys or NAME.toml. Reads the first bytes of each file.
/// Empty if `folder` is empty or has no samples.
[[nodiscard]] std::vector<GallerySample> find_samples(const std::string& folder);

/// The first sentence of the comment (`//` or `#`) at the begin of a text, without its full stop;
/// empty if the text does not begin with a comment.
[[nodiscard]] std::string title_of_text(std::string_view text);

/// A picture scaled down by a whole number so that it fits into a square of `side` pixels; each
/// pixel is the mean of the pixels that it replaces. Empty if `bytes` are no picture.
[[nodiscard]] Texture thumbnail_of(std::string_view bytes, std::uint32_t side);

} // namespace lsys::view
