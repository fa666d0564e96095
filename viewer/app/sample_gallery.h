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

/// The folder of the samples: `share/lsc/samples` beside the folder of the running program,
/// `samples` in a folder around it (a build in the source tree), or `lsc/samples` in a folder of
/// `$XDG_DATA_DIRS`. Empty if there is none.
[[nodiscard]] std::string samples_folder();

/// The samples of a folder: species, scenes, then others, each in alphabetical order. A sample is a
/// folder NAME with a file NAME.lsys or NAME.toml. Reads the first bytes of each file. Empty for an
/// empty path or a folder without samples.
[[nodiscard]] std::vector<GallerySample> find_samples(const std::string& folder);

/// The first sentence of the comment (`//` or `#`) that begins a text, without its final stop;
/// empty if the text does not begin with a comment.
[[nodiscard]] std::string title_of_text(std::string_view text);

/// The picture scaled down by a whole number so that it fits into a square of `side` pixels, by the
/// mean of its pixels. Empty if the bytes are no picture.
[[nodiscard]] Texture thumbnail_of(std::string_view bytes, std::uint32_t side);

} // namespace lsys::view
