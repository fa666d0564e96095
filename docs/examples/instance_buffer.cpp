// SPDX-License-Identifier: MIT
// A forest in the buffers of a renderer: vertices and indices of each mesh, a matrix for each
// instance, and the list of draws for glMultiDrawElementsIndirect.
// Usage: instance_buffer FILE COUNT
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <lsys/forest.h>
#include <vector>

struct Vertex {
    float position[3];
    float normal[3];
};

/// One instance in the buffer of this renderer: its matrix, then data of the renderer.
struct InstanceData {
    float matrix[16];
    float tint[4];
};

/// Has the layout of DrawElementsIndirectCommand.
struct Draw {
    std::uint32_t index_count;
    std::uint32_t instance_count;
    std::uint32_t first_index;
    std::uint32_t base_vertex;
    std::uint32_t first_instance;
};

int main(int count, char** arguments) {
    if (count != 3) {
        std::cerr << "usage: instance_buffer FILE COUNT\n";
        return 2;
    }
    lsys::ForestOptions options;
    options.scene = {{"count", arguments[2]}, {"heroes", "3"}};
    const auto forest = lsys::grow_forest({arguments[1]}, options);
    if (!forest) {
        std::cerr << forest.messages().text();
        return 1;
    }
    const auto outcome = lsys::make_instances(*forest);
    if (!outcome) {
        std::cerr << outcome.messages().text();
        return 1;
    }
    const lsys::Instances& instances = *outcome;

    // One vertex buffer and one index buffer for all meshes. In a renderer they are mapped buffers
    // of the GPU.
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> base_vertex;
    std::vector<std::uint32_t> base_index;
    for (const lsys::Mesh& mesh : instances.meshes()) {
        base_vertex.push_back(static_cast<std::uint32_t>(vertices.size()));
        base_index.push_back(static_cast<std::uint32_t>(indices.size()));
        vertices.resize(vertices.size() + mesh.positions().size());
        indices.resize(indices.size() + mesh.index_count());
        lsys::VertexTarget target;
        target.positions = &vertices[base_vertex.back()].position;
        target.normals = &vertices[base_vertex.back()].normal;
        target.stride = sizeof(Vertex);
        mesh.read_vertices(target);
        mesh.read_indices(0, mesh.index_count(), &indices[base_index.back()]);
    }

    // Write the matrices directly to their places in the buffer.
    std::vector<InstanceData> data(instances.all().size());
    instances.read_matrices(0, data.size(), data.data(), sizeof(InstanceData));

    std::vector<Draw> draws;
    std::uint64_t triangles = 0;
    for (const lsys::InstanceGroup& group : instances.groups()) {
        const lsys::Mesh& mesh = instances.meshes()[group.mesh];
        for (std::uint32_t i = 0; i < group.part_count; ++i) {
            const lsys::MeshPart& part = mesh.parts()[group.first_part + i];
            draws.push_back({static_cast<std::uint32_t>(part.index_count),
                             static_cast<std::uint32_t>(group.instance_count),
                             base_index[group.mesh] + static_cast<std::uint32_t>(part.first_index),
                             base_vertex[group.mesh],
                             static_cast<std::uint32_t>(group.first_instance)});
            triangles += part.index_count / 3 * group.instance_count;
        }
    }
    std::cout << forest->trees().size() << " trees, " << data.size() << " instances of "
              << sizeof(InstanceData) << " bytes, " << draws.size() << " draws\n"
              << vertices.size() << " vertices in memory, " << triangles << " triangles drawn\n";
}
