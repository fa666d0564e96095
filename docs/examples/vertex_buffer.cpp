// SPDX-License-Identifier: MIT
// Meshes a plant into a vertex buffer and an index buffer, laid out as a renderer wants them.
// Usage: vertex_buffer FILE
#include <cstdint>
#include <iostream>
#include <lsys/plant.h>
#include <vector>

struct Vertex {
    float position[3];
    float normal[3];
    float uv[2];
};

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: vertex_buffer FILE\n";
        return 2;
    }
    const auto grammar = lsys::compile_file(arguments[1]);
    const auto plant = grammar ? lsys::grow(*grammar)
                               : lsys::Outcome<lsys::Plant>(grammar.status(), grammar.messages());
    const auto mesh = plant ? lsys::make_mesh(*plant)
                            : lsys::Outcome<lsys::Mesh>(plant.status(), plant.messages());
    if (!mesh) {
        std::cerr << mesh.messages().text();
        return 1;
    }
    // In a renderer these two are mapped buffers of the GPU.
    std::vector<Vertex> vertices(mesh->positions().size());
    std::vector<std::uint32_t> indices(mesh->index_count());
    if (vertices.empty()) {
        std::cerr << "the plant has no surface\n";
        return 1;
    }
    mesh->read_vertices({.positions = &vertices[0].position,
                         .normals = &vertices[0].normal,
                         .texture_coordinates = &vertices[0].uv,
                         .stride = sizeof(Vertex)});
    mesh->read_indices(0, indices.size(), indices.data());
    for (const lsys::MeshPart& part : mesh->parts()) {
        std::cout << mesh->materials()[part.material].name << ": " << part.index_count / 3
                  << " triangles\n";
    }
    std::cout << vertices.size() << " vertices of " << sizeof(Vertex) << " bytes\n";
}
