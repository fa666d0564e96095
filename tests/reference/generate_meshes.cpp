// SPDX-License-Identifier: MIT
#include "tests/reference/generate_meshes.h"

#include <algorithm>

namespace lsys::reference {

namespace {

using Vertex = std::array<float, 3>;

std::string new_path(const Grammar& grammar, const std::string& ending, Random& random) {
    static const std::vector<std::string> kFolders = {"", "parts/", "parts/deep/", "files a/"};
    const std::size_t number = grammar.meshes.size() + grammar.pictures.size();
    return random.pick(kFolders) + "file" + std::to_string(number) + ending;
}

// In metres, between `low` and `high` centimetres. The offset keeps places of plants, most of whose
// lengths are multiples of 5 cm, off the surfaces: the sign of the distance there is undefined.
float coordinate(Random& random, int low, int high) {
    return static_cast<float>(random.between(low / 5, high / 5) * 5) / 100.0F + 0.013F;
}

// Adds the vertices and faces of a closed surface.
void add_faces(MeshFile& mesh,
               const std::vector<Vertex>& vertices,
               const std::vector<std::vector<std::size_t>>& faces) {
    const std::size_t first = mesh.vertices.size();
    mesh.vertices.insert(mesh.vertices.end(), vertices.begin(), vertices.end());
    for (std::vector<std::size_t> face : faces) {
        for (std::size_t& index : face) {
            index += first;
        }
        mesh.faces.push_back(face);
    }
}

void add_box(MeshFile& mesh, const Vertex& low, const Vertex& size) {
    std::vector<Vertex> vertices;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vertex vertex = low;
        for (unsigned axis = 0; axis < 3; ++axis) {
            vertex[axis] += (corner >> axis & 1U) != 0 ? size[axis] : 0.0F;
        }
        vertices.push_back(vertex);
    }
    add_faces(mesh, vertices,
              {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

// Two pyramids with a common base of `sides` corners.
void add_spindle(MeshFile& mesh, const Vertex& low, const Vertex& size, std::size_t sides) {
    static const std::vector<std::array<float, 2>> kRing = {{1, 0.4F}, {0.7F, 0.9F}, {0.3F, 1},
                                                            {0, 0.6F}, {0.2F, 0.1F}, {0.6F, 0}};
    std::vector<Vertex> vertices;
    const std::size_t skip = kRing.size() - sides;
    for (std::size_t i = skip; i < kRing.size(); ++i) {
        vertices.push_back({low[0] + size[0] * kRing[i][0], low[1] + size[1] * 0.4F,
                            low[2] + size[2] * kRing[i][1]});
    }
    vertices.push_back({low[0] + size[0] * 0.4F, low[1] + size[1], low[2] + size[2] * 0.5F});
    vertices.push_back({low[0] + size[0] * 0.5F, low[1], low[2] + size[2] * 0.3F});
    std::vector<std::vector<std::size_t>> faces;
    for (std::size_t i = 0; i < sides; ++i) {
        faces.push_back({i, sides, (i + 1) % sides});
        faces.push_back({i, (i + 1) % sides, sides + 1});
    }
    add_faces(mesh, vertices, faces);
}

void add_part(MeshFile& mesh, int size, Random& random) {
    const Vertex low = {coordinate(random, -size, size / 2), coordinate(random, -size, size),
                        coordinate(random, -size, size / 2)};
    const Vertex extent = {coordinate(random, 10, size), coordinate(random, 10, size),
                           coordinate(random, 10, size)};
    if (random.percent(50)) {
        add_box(mesh, low, extent);
    } else {
        add_spindle(mesh, low, extent, 3 + random.below(4));
    }
}

// Makes some faces face the other side.
void turn_some(MeshFile& mesh, Random& random) {
    for (std::vector<std::size_t>& face : mesh.faces) {
        if (random.percent(40)) {
            std::reverse(face.begin(), face.end());
        }
    }
}

// Gives each face corners of its own: equal places are one vertex all the same.
void separate(MeshFile& mesh) {
    std::vector<Vertex> vertices;
    for (std::vector<std::size_t>& face : mesh.faces) {
        for (std::size_t& index : face) {
            vertices.push_back(mesh.vertices[index]);
            index = vertices.size() - 1;
        }
    }
    mesh.vertices = vertices;
}

} // namespace

std::string add_mesh(Grammar& grammar, Random& random, MeshUse use) {
    MeshFile mesh;
    mesh.path = new_path(grammar, ".obj", random);
    const int size = use == MeshUse::Organ ? 60 : random.between(60, 300); // cm
    const int parts = random.percent(70) ? 1 : 2; // the second may be inside the first
    for (int i = 0; i < parts; ++i) {
        add_part(mesh, size, random);
    }
    if (use != MeshUse::Organ && random.percent(20)) {
        turn_some(mesh, random);
    }
    if (use == MeshUse::Obstacle && random.percent(25)) { // a hole
        mesh.faces.pop_back();
    }
    if (use == MeshUse::Obstacle && random.percent(8)) { // an edge of three faces
        mesh.faces.push_back(mesh.faces.front());
    }
    if (random.percent(20)) {
        separate(mesh);
    }
    grammar.meshes.push_back(mesh);
    return mesh.path;
}

std::string add_picture(Grammar& grammar, Random& random) {
    PictureFile picture;
    picture.path = new_path(grammar, ".png", random);
    picture.columns = 1 + random.below(5);
    picture.rows = 1 + random.below(5);
    picture.channels = 1 + random.below(4);
    picture.depth = random.percent(50) ? 8 : 16;
    for (std::size_t i = 0; i < picture.columns * picture.rows * picture.channels; ++i) {
        picture.samples.push_back(
            static_cast<std::uint16_t>(random.below(picture.depth == 8 ? 256 : 65536)));
    }
    grammar.pictures.push_back(picture);
    return picture.path;
}

} // namespace lsys::reference
