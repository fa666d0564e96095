#include "runtime/mesh.h"

#include "runtime/meshing/boxes.h"
#include "runtime/meshing/cylinders.h"
#include "runtime/meshing/mesh_builder.h"
#include "runtime/meshing/objects.h"
#include "runtime/meshing/polygons.h"
#include "runtime/meshing/tubes.h"

#include <new>
#include <stdexcept>

namespace lsys {

namespace {

MeshStatus build(const Skeleton& skeleton,
                 const std::vector<UserMesh>& user_meshes,
                 const MeshOptions& options,
                 Mesh& mesh) {
    MeshBuilder builder(options, mesh);
    switch (options.method) {
    case MeshMethod::Tubes:
        append_tubes(skeleton, options, builder);
        break;
    case MeshMethod::Cylinders:
        append_cylinders(skeleton, options, builder);
        break;
    case MeshMethod::Boxes:
        append_boxes(skeleton, options, builder);
        break;
    }
    append_polygons(skeleton, options, builder);
    append_objects(skeleton, user_meshes, options, builder);
    return builder.finish();
}

} // namespace

MeshStatus make_mesh(const Skeleton& skeleton,
                     const std::vector<UserMesh>& user_meshes,
                     const MeshOptions& options,
                     Mesh& mesh) {
    try {
        return build(skeleton, user_meshes, options, mesh);
    } catch (const std::bad_alloc&) {
        mesh = {};
    } catch (const std::length_error&) {
        mesh = {};
    }
    return MeshStatus::OutOfMemory;
}

glm::vec3 palette_colour(std::uint32_t index) {
    static constexpr std::array<std::array<float, 3>, 12> kRound{{
        {0.162F, 0.098F, 0.054F}, // bark
        {0.082F, 0.235F, 0.028F}, // leaf
        {0.604F, 0.027F, 0.034F}, // red
        {0.896F, 0.491F, 0.017F}, // amber
        {0.831F, 0.787F, 0.612F}, // cream
        {0.716F, 0.174F, 0.352F}, // pink
        {0.246F, 0.072F, 0.462F}, // violet
        {0.030F, 0.152F, 0.533F}, // blue
        {0.019F, 0.337F, 0.319F}, // teal
        {0.337F, 0.503F, 0.072F}, // light green
        {0.381F, 0.212F, 0.105F}, // light brown
        {0.402F, 0.402F, 0.402F}, // grey
    }};
    const std::size_t entry = index < kRound.size() ? index : 2 + (index - 2) % (kRound.size() - 2);
    return {kRound[entry][0], kRound[entry][1], kRound[entry][2]};
}

} // namespace lsys
