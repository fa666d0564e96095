// SPDX-License-Identifier: MIT
// Reads any bytes as a camera (`--camera`, bookmarks). A camera that is accepted is written and
// read back as the same camera.
#include "viewer/scene/camera.h"

#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using lsys::view::Camera;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const lsys::Result<Camera> read = lsys::view::parse_camera(text, Camera{});
    if (!read) {
        return 0;
    }
    const Camera& camera = read.value();
    const std::string written = lsys::view::to_text(camera);
    const lsys::Result<Camera> again = lsys::view::parse_camera(written, Camera{});
    if (!again || again.value() != camera) {
        std::abort();
    }
    static_cast<void>(lsys::view::view_matrix(camera));
    static_cast<void>(lsys::view::projection_matrix(camera, 1.5F, near_distance(camera)));
    return 0;
}
