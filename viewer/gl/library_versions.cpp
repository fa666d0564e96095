// SPDX-License-Identifier: MIT
#include "viewer/gl/library_versions.h"

#include <fmt/format.h>

#include <GLFW/glfw3.h>
#include <imgui.h>

namespace lsys::view {

std::vector<std::pair<std::string, std::string>> viewer_libraries() {
    int major = 0;
    int minor = 0;
    int revision = 0;
    glfwGetVersion(&major, &minor, &revision); // needs no display
    return {{"Dear ImGui", IMGUI_VERSION},
            {"GLFW", fmt::format("{}.{}.{}", major, minor, revision)},
            {"libepoxy", LSYS_EPOXY_VERSION}};
}

} // namespace lsys::view
