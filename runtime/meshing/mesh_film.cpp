// SPDX-License-Identifier: MIT
#include "runtime/meshing/mesh_film.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

bool looks_equal(const Material& a, const Material& b) {
    return a.name == b.name && a.kind == b.kind && a.colour == b.colour &&
           a.two_sided == b.two_sided && a.cut_out == b.cut_out && a.textured == b.textured &&
           a.picture == b.picture && a.normal_map == b.normal_map && a.roughness == b.roughness &&
           a.translucency == b.translucency;
}

/// Whether `b` has the triangles and materials of `a`, so that only vertices differ.
bool is_same_shape(const Mesh& a, const Mesh& b) {
    return a.positions.size() == b.positions.size() && a.parts.size() == b.parts.size() &&
           std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(),
                      [&](const MeshPart& x, const MeshPart& y) {
                          return x.first_index == y.first_index && x.index_count == y.index_count &&
                                 looks_equal(a.materials[x.material], b.materials[y.material]);
                      }) &&
           a.indices == b.indices;
}

std::uint64_t byte_count(const std::vector<MeshFilm::Frame>& frames) {
    std::uint64_t bytes = 0;
    for (const MeshFilm::Frame& frame : frames) {
        bytes += (frame.positions.size() + frame.normals.size()) * sizeof(glm::vec3);
    }
    return bytes;
}

template <typename T>
void append(LargeVector<T>& to, const LargeVector<T>& items) {
    to.insert(to.end(), items.begin(), items.end());
}

std::uint32_t number_of(std::vector<Material>& materials, const Material& material) {
    const auto found = std::find_if(materials.begin(), materials.end(), [&](const Material& each) {
        return looks_equal(each, material);
    });
    const auto number = static_cast<std::uint32_t>(found - materials.begin());
    if (found == materials.end()) {
        materials.push_back(material);
    }
    return number;
}

} // namespace

std::uint64_t MeshFilm::byte_count() const {
    std::uint64_t bytes = mesh.byte_count();
    for (const Shape& shape : shapes) {
        bytes += lsys::byte_count(shape.earlier);
    }
    return bytes;
}

void MeshFilmBuilder::add(Mesh frame) {
    if (frames_ > 0) {
        if (is_same_shape(last_, frame)) {
            earlier_.push_back({std::move(last_.positions), std::move(last_.normals)});
        } else {
            close_shape();
        }
    }
    last_ = std::move(frame);
    ++frames_;
}

void MeshFilmBuilder::close_shape() {
    Mesh& mesh = film_.mesh;
    MeshFilm::Shape& shape = film_.shapes.emplace_back();
    shape.earlier = std::exchange(earlier_, {});
    shape.first_frame = frames_ - shape.frame_count();
    shape.first_vertex = mesh.positions.size();
    shape.first_part = static_cast<std::uint32_t>(mesh.parts.size());
    for (MeshPart part : last_.parts) {
        if (part.index_count == 0) {
            continue;
        }
        ++shape.part_count;
        part.material = number_of(mesh.materials, last_.materials[part.material]);
        part.first_index += mesh.indices.size();
        mesh.parts.push_back(part);
    }
    append(mesh.positions, last_.positions);
    append(mesh.normals, last_.normals);
    append(mesh.texture_coordinates, last_.texture_coordinates);
    append(mesh.tangents, last_.tangents);
    append(mesh.colours, last_.colours);
    mesh.looks = last_.looks;
    mesh.indices.append(std::move(last_.indices), static_cast<std::uint32_t>(shape.first_vertex));
    last_ = {};
}

std::uint64_t MeshFilmBuilder::byte_count() const {
    return film_.byte_count() + last_.byte_count() + lsys::byte_count(earlier_);
}

MeshFilm MeshFilmBuilder::finish() {
    if (frames_ > 0) {
        close_shape();
    }
    return std::move(film_);
}

} // namespace lsys
