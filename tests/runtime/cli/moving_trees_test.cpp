// SPDX-License-Identifier: MIT
// Largest distance of a vertex from its place at rest, for samples in an animation of wind.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace {

using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

std::vector<glm::vec3> positions_of(const std::string& ply) {
    const std::size_t count =
        std::stoul(ply.substr(ply.find("element vertex ") + std::strlen("element vertex ")));
    const std::string end = "end_header\n";
    const std::string header = ply.substr(0, ply.find(end));
    // Bytes per vertex: floats and colours. Only vertices have properties of these types.
    std::size_t stride = 0;
    for (const auto& [word, bytes] :
         {std::pair("property float ", 4), std::pair("property uchar ", 1)}) {
        for (std::size_t at = header.find(word); at != std::string::npos;
             at = header.find(word, at + 1)) {
            stride += static_cast<std::size_t>(bytes);
        }
    }
    std::vector<glm::vec3> positions(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(&positions[i], ply.data() + header.size() + end.size() + i * stride,
                    sizeof(glm::vec3));
    }
    return positions;
}

/// Largest distance of a vertex from its place at rest in an animation of 4 s with gusts of 4 to 12
/// m/s, as a fraction of the height of the plant.
float largest_sway(const std::string& sample) {
    const ScratchFolder folder;
    const std::string grammar =
        std::string(LSYS_SOURCE_DIR "/samples/") + sample + "/" + sample + ".lsys";
    std::vector<std::string> arguments{"export",  grammar, "-q", "--method",         "cylinders",
                                       "--sides", "3",     "-o", folder / "rest.ply"};
    REQUIRE(run_lsc(arguments, "").status == 0);
    arguments.back() = folder / "a.ply";
    arguments.insert(arguments.end(),
                     {"--loop", "--frames", "17", "--fps", "4", "--wind", "8,0,0,0.5"});
    REQUIRE(run_lsc(arguments, "").status == 0);
    const std::vector<glm::vec3> rest = positions_of(read_text(folder / "rest.ply"));
    const auto [low, high] = std::minmax_element(
        rest.begin(), rest.end(), [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
    float max_distance = 0.0F;
    for (int frame = 1; frame <= 17; ++frame) {
        const std::string number = (frame < 10 ? "0" : "") + std::to_string(frame);
        const std::vector<glm::vec3> moved =
            positions_of(read_text(folder / ("a.00" + number + ".ply")));
        REQUIRE(moved.size() == rest.size());
        for (std::size_t i = 0; i < rest.size(); ++i) {
            max_distance = std::max(max_distance, glm::length(moved[i] - rest[i]));
        }
    }
    CHECK(positions_of(read_text(folder / "a.0001.ply")) ==
          positions_of(read_text(folder / "a.0017.ply")));
    return max_distance / (high->y - low->y);
}

} // namespace

TEST_CASE("trees sway in a fresh breeze by a plausible fraction of their height") {
    const std::string name = GENERATE("carey-type-0", "carey-type-1"); // carey-type-2 takes minutes
    CAPTURE(name);
    const float sway = largest_sway(name);
    CHECK(sway > 0.03F);
    CHECK(sway < 0.15F);
}
