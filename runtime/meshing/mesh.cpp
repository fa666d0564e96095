// SPDX-License-Identifier: MIT
#include "runtime/meshing/mesh.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/meshing/impl/boxes.h"
#include "runtime/meshing/impl/cylinders.h"
#include "runtime/meshing/impl/l3d_shapes.h"
#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/impl/objects.h"
#include "runtime/meshing/impl/organs.h"
#include "runtime/meshing/impl/polygons.h"
#include "runtime/meshing/impl/ring_segments.h"
#include "runtime/meshing/impl/solid.h"
#include "runtime/meshing/impl/tubes.h"
#include "runtime/meshing/looks.h"

#include <utility>

namespace lsys {

namespace {

std::vector<FilePictures> pictures_of(const Skeleton& skeleton,
                                      const std::vector<UserMesh>& user_meshes) {
    std::vector<std::string> names = object_file_names(skeleton.mesh_files);
    names.resize(user_meshes.size());
    std::vector<FilePictures> pictures;
    for (std::size_t i = 0; i < user_meshes.size(); ++i) {
        pictures.push_back({user_meshes[i].picture, user_meshes[i].normal_map, names[i]});
    }
    return pictures;
}

std::optional<Stop> build_solid(const Skeleton& skeleton,
                                const std::vector<UserMesh>& user_meshes,
                                const MeshOptions& options,
                                Mesh& mesh) {
    MeshOptions plain = options; // options for leaves and polygons without thickness
    plain.texture_coordinates = false;
    plain.tangents = false;
    plain.colours = true;
    plain.segments = true;
    Mesh flat;
    MeshBuilder flat_builder(plain, flat);
    flat_builder.set_pictures(pictures_of(skeleton, user_meshes));
    flat_builder.set_looks(skeleton.looks);
    append_polygons(skeleton, user_meshes, plain, flat_builder);
    append_objects(skeleton, user_meshes, plain, flat_builder);
    append_organs(skeleton, plain, flat_builder);
    std::optional<Stop> stop = flat_builder.finish();
    MeshBuilder builder(options, mesh);
    builder.set_looks(skeleton.looks);
    if (!stop) {
        stop = append_solid(skeleton, flat, options, builder, mesh.shells);
    }
    if (!stop) {
        stop = builder.finish();
    }
    if (stop) {
        mesh = {};
    }
    return stop;
}

std::optional<Stop> build(const Skeleton& skeleton,
                          const std::vector<UserMesh>& user_meshes,
                          const MeshOptions& wanted,
                          Mesh& mesh) {
    const MeshOptions options = resolved(wanted, skeleton);
    mesh.shells = 0;
    if (options.method == MeshMethod::Solid) {
        return build_solid(skeleton, user_meshes, options, mesh);
    }
    MeshBuilder builder(options, mesh);
    builder.set_pictures(pictures_of(skeleton, user_meshes));
    builder.set_looks(skeleton.looks);
    if (skeleton.l3d_compatible_surface && options.method == MeshMethod::Tubes) {
        append_l3d_shapes(skeleton, builder);
        append_objects(skeleton, user_meshes, options, builder); // all objects except leaves
        append_organs(skeleton, options, builder);
        return builder.finish();
    }
    switch (options.method) {
    case MeshMethod::Default: // replaced by resolved()
    case MeshMethod::Tubes:
        append_tubes(skeleton, options, builder);
        if (options.segments && !builder.stop()) {
            fill_ring_segments(skeleton, options, builder.segments());
        }
        break;
    case MeshMethod::Cylinders:
        append_cylinders(skeleton, options, builder);
        break;
    case MeshMethod::Boxes:
        append_boxes(skeleton, options, builder);
        break;
    case MeshMethod::Solid: // handled above by build_solid()
        break;
    }
    append_polygons(skeleton, user_meshes, options, builder);
    append_objects(skeleton, user_meshes, options, builder);
    append_organs(skeleton, options, builder);
    return builder.finish();
}

} // namespace

MeshOptions resolved(const MeshOptions& options, const Skeleton& skeleton) {
    MeshOptions all = options;
    if (all.method == MeshMethod::Default) {
        all.method = skeleton.box_segments ? MeshMethod::Boxes : MeshMethod::Tubes;
    }
    const std::uint32_t plain = skeleton.box_segments ? 0 : kSubdivisions;
    all.subdivisions = all.subdivisions.value_or(all.grooves > 0.0F ? kGrooveSubdivisions : plain);
    if (all.grooves > 0.0F && all.method == MeshMethod::Tubes && all.sides == 0) {
        all.sides = kGrooveSides;
    }
    return all;
}

std::optional<Stop> make_mesh(const Skeleton& skeleton,
                              const std::vector<UserMesh>& user_meshes,
                              const MeshOptions& options,
                              Mesh& mesh) {
    return catch_out_of_memory([&] { return build(skeleton, user_meshes, options, mesh); },
                               [&] {
                                   mesh = {};
                                   return Stop::OutOfMemory;
                               });
}

glm::vec3 palette_colour(std::uint32_t index) {
    if (is_own(index)) {
        const auto part = [&](unsigned shift) {
            return linear_of_srgb(static_cast<float>(index >> shift & 0xFFU) / 255.0F);
        };
        return {part(16), part(8), part(0)};
    }
    // Grammars count colours up as a plant grows, so the first ones are wood and foliage.
    static constexpr std::array<std::array<float, 3>, 25> kPalette{{
        {0.162F, 0.098F, 0.054F}, // bark
        {0.082F, 0.235F, 0.028F}, // leaf
        {0.095F, 0.252F, 0.031F}, // greens, from deep to light
        {0.110F, 0.270F, 0.034F}, {0.126F, 0.289F, 0.037F}, {0.143F, 0.309F, 0.041F},
        {0.161F, 0.330F, 0.045F}, {0.180F, 0.352F, 0.049F}, {0.201F, 0.375F, 0.053F},
        {0.223F, 0.398F, 0.056F}, {0.247F, 0.421F, 0.059F}, {0.274F, 0.440F, 0.061F},
        {0.303F, 0.455F, 0.062F}, {0.335F, 0.466F, 0.063F}, {0.368F, 0.472F, 0.064F},
        {0.402F, 0.474F, 0.065F}, {0.381F, 0.212F, 0.105F}, // light brown
        {0.604F, 0.027F, 0.034F},                           // red
        {0.896F, 0.491F, 0.017F},                           // amber
        {0.831F, 0.787F, 0.612F},                           // cream
        {0.716F, 0.174F, 0.352F},                           // pink
        {0.246F, 0.072F, 0.462F},                           // violet
        {0.030F, 0.152F, 0.533F},                           // blue
        {0.019F, 0.337F, 0.319F},                           // teal
        {0.402F, 0.402F, 0.402F},                           // grey
    }};
    const std::size_t entry =
        index < kPalette.size() ? index : 2 + (index - 2) % (kPalette.size() - 2);
    return {kPalette[entry][0], kPalette[entry][1], kPalette[entry][2]};
}

} // namespace lsys
