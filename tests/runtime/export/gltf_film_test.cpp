// SPDX-License-Identifier: MIT
// Films of growth in GLB: at the time of each frame, a reader shows the mesh of that frame.
#include "runtime/export/export.h"
#include "runtime/meshing/mesh_film.h"
#include "tests/support/meshes.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace lsys;
using nlohmann::json;

namespace {

/// A plant of `triangles` triangles; `size` moves its vertices.
Mesh frame_of(std::uint32_t triangles, float size) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const float x = static_cast<float>(i);
        for (const glm::vec3 corner : {glm::vec3(x, 0.0F, 0.0F), glm::vec3(x + size, 0.0F, 0.0F),
                                       glm::vec3(x, size, 0.0F)}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner);
            mesh.normals.emplace_back(0.0F, 0.0F, size > 1.5F ? -1.0F : 1.0F);
        }
    }
    if (triangles > 0) {
        mesh.materials.push_back({.name = "bark"});
        mesh.parts.push_back({0, 0, mesh.indices.size()});
    }
    return mesh;
}

struct File {
    json document;
    std::string data;

    [[nodiscard]] std::vector<float> floats(std::size_t accessor) const {
        const json& entry = document["accessors"][accessor];
        const json& view = document["bufferViews"][entry["bufferView"].get<std::size_t>()];
        const std::size_t width = entry["type"] == "VEC3" ? 3 : 1;
        std::vector<float> values(width * entry["count"].get<std::size_t>());
        const std::size_t offset =
            view["byteOffset"].get<std::size_t>() + entry.value("byteOffset", std::size_t{0});
        REQUIRE(offset + values.size() * sizeof(float) <= data.size());
        std::memcpy(values.data(), data.data() + offset, values.size() * sizeof(float));
        return values;
    }
};

File written(const MeshFilm& film) {
    ExportInfo info;
    info.film = &film;
    std::string bytes;
    REQUIRE(export_mesh(film.mesh, {}, ExportFormat::Glb, info, [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, bytes.data() + 12, sizeof json_bytes);
    return {json::parse(bytes.substr(20, json_bytes)), bytes.substr(28 + json_bytes)};
}

/// Values of the animation of a node at a time, by glTF 2.0, appendix C; empty without a channel.
std::vector<float> animated(const File& file, std::size_t node, const char* path, float time) {
    if (!file.document.contains("animations")) {
        return {};
    }
    const json& animation = file.document["animations"][0];
    for (const json& channel : animation["channels"]) {
        if (channel["target"]["node"] != node || channel["target"]["path"] != path) {
            continue;
        }
        const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
        const std::vector<float> times = file.floats(sampler["input"].get<std::size_t>());
        const std::vector<float> values = file.floats(sampler["output"].get<std::size_t>());
        const std::size_t width = values.size() / times.size();
        std::size_t key = 0;
        while (key + 1 < times.size() && times[key + 1] <= time) {
            ++key;
        }
        const bool inside = time > times[key] && key + 1 < times.size();
        const float part = inside && sampler["interpolation"] == "LINEAR"
                               ? (time - times[key]) / (times[key + 1] - times[key])
                               : 0.0F;
        std::vector<float> result(width);
        for (std::size_t i = 0; i < width; ++i) {
            const float next = part > 0.0F ? values[(key + 1) * width + i] : 0.0F;
            result[i] = (1.0F - part) * values[key * width + i] + part * next;
        }
        return result;
    }
    return {};
}

/// Positions or normals of the vertices that are shown at a time, s.
std::vector<float> seen(const File& file, float time, const char* attribute) {
    std::vector<float> all;
    for (const json& child : file.document["nodes"][0]["children"]) {
        const auto number = child.get<std::size_t>();
        const json& node = file.document["nodes"][number];
        const std::vector<float> scale = animated(file, number, "scale", time);
        if (!scale.empty() ? scale[0] == 0.0F : node.contains("scale")) {
            continue;
        }
        const std::vector<float> weights = animated(file, number, "weights", time);
        const json& mesh = file.document["meshes"][node["mesh"].get<std::size_t>()];
        for (const json& primitive : mesh["primitives"]) {
            std::vector<float> values =
                file.floats(primitive["attributes"][attribute].get<std::size_t>());
            for (std::size_t k = 0; k < weights.size(); ++k) {
                const std::vector<float> change =
                    file.floats(primitive["targets"][k][attribute].get<std::size_t>());
                for (std::size_t i = 0; i < values.size(); ++i) {
                    values[i] += weights[k] * change[i];
                }
            }
            all.insert(all.end(), values.begin(), values.end());
        }
    }
    return all;
}

void check_equal(const std::vector<float>& found, const LargeVector<glm::vec3>& wanted) {
    REQUIRE(found.size() == 3 * wanted.size());
    float worst = 0.0F;
    for (std::size_t i = 0; i < found.size(); ++i) {
        worst = std::max(worst, std::abs(found[i] - wanted[i / 3][static_cast<int>(i % 3)]));
    }
    CHECK(worst < 1e-6F);
}

} // namespace

TEST_CASE("at the time of each frame a film shows the mesh of the frame") {
    const std::vector<std::pair<std::uint32_t, float>> frames{
        {0, 0.0F}, {1, 0.5F}, {1, 1.0F}, {1, 2.0F}, {3, 1.0F}, {2, 0.25F}, {2, 1.75F}};
    MeshFilmBuilder builder(8.0F);
    for (const auto& [triangles, size] : frames) {
        builder.add(frame_of(triangles, size));
    }
    const MeshFilm film = builder.finish();
    const File file = written(film);
    CHECK(file.document["meshes"].size() == 3);
    CHECK(file.document["materials"].size() == 1);
    CHECK(file.document["meshes"][0]["extras"]["targetNames"] == json({"frame 2", "frame 3"}));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        CAPTURE(i);
        const Mesh wanted = frame_of(frames[i].first, frames[i].second);
        const float time = static_cast<float>(i) / 8.0F;
        check_equal(seen(file, time, "POSITION"), wanted.positions);
        check_equal(seen(file, time, "NORMAL"), wanted.normals);
    }
    // Half way between two frames of a shape.
    check_equal(seen(file, 1.5F / 8.0F, "POSITION"), frame_of(1, 0.75F).positions);
    // A shape stays until the next one appears.
    check_equal(seen(file, 4.5F / 8.0F, "POSITION"), frame_of(3, 1.0F).positions);
    // Readers without animations show the last shape.
    const json& nodes = file.document["nodes"];
    CHECK(nodes[1]["scale"] == json({0, 0, 0}));
    CHECK(nodes[2]["scale"] == json({0, 0, 0}));
    CHECK_FALSE(nodes[3].contains("scale"));
}

TEST_CASE("a film of one shape is animated, and a film of one frame is not") {
    MeshFilmBuilder moving(24.0F);
    moving.add(frame_of(2, 0.5F));
    moving.add(frame_of(2, 1.0F));
    const MeshFilm film = moving.finish();
    const File file = written(film);
    REQUIRE(file.document["animations"][0]["channels"].size() == 1);
    CHECK(file.document["animations"][0]["channels"][0]["target"]["path"] == "weights");
    check_equal(seen(file, 0.0F, "POSITION"), frame_of(2, 0.5F).positions);
    check_equal(seen(file, 1.0F / 24.0F, "POSITION"), frame_of(2, 1.0F).positions);

    MeshFilmBuilder still(24.0F);
    still.add(frame_of(2, 1.0F));
    const MeshFilm picture = still.finish();
    const File single = written(picture);
    CHECK_FALSE(single.document.contains("animations"));
    check_equal(seen(single, 0.0F, "POSITION"), frame_of(2, 1.0F).positions);
}

TEST_CASE("bounds of morph targets are those of their changes") {
    MeshFilmBuilder builder(24.0F);
    builder.add(frame_of(1, 0.25F));
    builder.add(frame_of(1, 1.0F));
    const MeshFilm film = builder.finish();
    const File file = written(film);
    const json& target = file.document["meshes"][0]["primitives"][0]["targets"][0];
    const json& accessor = file.document["accessors"][target["POSITION"].get<std::size_t>()];
    CHECK(accessor["min"] == json({-0.75, -0.75, 0.0}));
    CHECK(accessor["max"] == json({0.0, 0.0, 0.0}));
}
