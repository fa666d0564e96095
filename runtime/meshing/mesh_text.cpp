// SPDX-License-Identifier: MIT
#include "runtime/meshing/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace lsys {

namespace {

const char* kind_name(MaterialKind kind) {
    switch (kind) {
    case MaterialKind::Bark:
        return "bark";
    case MaterialKind::Leaf:
        return "leaf";
    case MaterialKind::Flower:
        return "flower";
    case MaterialKind::Plain:
        break;
    }
    return "plain";
}

std::string segment_text(std::uint32_t segment) {
    return segment == kNoSegment ? "-" : fmt::format("{}", segment);
}

void append_part(const Mesh& mesh, std::uint64_t index, std::string& text) {
    const MeshPart& part = mesh.parts[index];
    const Material& material = mesh.materials[part.material];
    const glm::vec4& c = material.colour;
    fmt::format_to(std::back_inserter(text),
                   "part {} \"{}\" {} colour ({}, {}, {}, {}) triangles {}{}{}{}\n", index,
                   material.name, kind_name(material.kind), c.r, c.g, c.b, c.a,
                   part.index_count / 3, material.two_sided ? " two-sided" : "",
                   material.cut_out ? " cut-out" : "", material.textured ? " textured" : "");
}

void append_vertex(const Mesh& mesh, std::uint64_t index, std::string& text) {
    const auto add = std::back_inserter(text);
    const glm::vec3& p = mesh.positions[index];
    const glm::vec3& n = mesh.normals[index];
    fmt::format_to(add, "vertex {} at ({}, {}, {}) normal ({}, {}, {})", index, p.x, p.y, p.z, n.x,
                   n.y, n.z);
    if (!mesh.texture_coordinates.empty()) {
        const glm::vec2& t = mesh.texture_coordinates[index];
        fmt::format_to(add, " texture ({}, {})", t.x, t.y);
    }
    if (!mesh.tangents.empty()) {
        const glm::vec4& t = mesh.tangents[index];
        fmt::format_to(add, " tangent ({}, {}, {}, {})", t.x, t.y, t.z, t.w);
    }
    if (!mesh.colours.empty()) {
        fmt::format_to(add, " colour {}", text_of(mesh.colours[index]));
    }
    if (!mesh.segments.empty()) {
        const auto [first, second] = mesh.segments[index];
        fmt::format_to(add, " segment {}", segment_text(first));
        if (second != first) {
            fmt::format_to(add, " {}", segment_text(second));
        }
    }
    text += '\n';
}

} // namespace

std::uint64_t line_count(const Mesh& mesh) {
    return 1 + mesh.parts.size() + mesh.positions.size() + mesh.indices.size() / 3;
}

void append_line(const Mesh& mesh, std::uint64_t line, std::string& text) {
    if (line == 0) {
        fmt::format_to(std::back_inserter(text), "mesh vertices {} triangles {} parts {}\n",
                       mesh.positions.size(), mesh.indices.size() / 3, mesh.parts.size());
        return;
    }
    --line;
    if (line < mesh.parts.size()) {
        append_part(mesh, line, text);
        return;
    }
    line -= mesh.parts.size();
    if (line < mesh.positions.size()) {
        append_vertex(mesh, line, text);
        return;
    }
    line -= mesh.positions.size();
    // Parts are consecutive and cover all indices.
    const auto behind = std::upper_bound(
        mesh.parts.begin(), mesh.parts.end(), 3 * line,
        [](std::uint64_t index, const MeshPart& part) { return index < part.first_index; });
    fmt::format_to(std::back_inserter(text), "triangle {} part {} corners {} {} {}\n", line,
                   behind - mesh.parts.begin() - 1, mesh.indices[3 * line],
                   mesh.indices[3 * line + 1], mesh.indices[3 * line + 2]);
}

} // namespace lsys
