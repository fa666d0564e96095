// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/object_sizes.h"

#include "grammar/base/paths.h"
#include "runtime/meshing/patch_file.h"
#include "runtime/meshing/shapes.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

/// Sum of the areas of triangles, added in binary64 in the order of the triangles.
double area_of_triangles(std::span<const glm::vec3> places,
                         std::span<const std::uint32_t> indices) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto along = [&](std::size_t corner, int axis) {
            return static_cast<double>(places[indices[i + corner]][axis]) -
                   static_cast<double>(places[indices[i]][axis]);
        };
        const double x = along(1, 1) * along(2, 2) - along(1, 2) * along(2, 1);
        const double y = along(1, 2) * along(2, 0) - along(1, 0) * along(2, 2);
        const double z = along(1, 0) * along(2, 1) - along(1, 1) * along(2, 0);
        sum += 0.5 * std::sqrt(x * x + y * y + z * z);
    }
    return sum;
}

/// Half the area of the triangles of an object of the library, since each surface has triangles on
/// both sides.
double area_of_object(TurtleOperation kind) {
    double sum = 0.0;
    for (const ShapePart& part : make_shape(kind, 0).parts) {
        sum += area_of_triangles(part.positions, part.indices);
    }
    return 0.5 * sum;
}

bool is_picture_file(std::string_view path) {
    return path.ends_with(".png") || path.ends_with(".PNG");
}

} // namespace

Outcome<SensingOptions> read_object_sizes(const std::filesystem::path& folder,
                                          const Bytecode& bytecode,
                                          bool areas,
                                          const Project& project,
                                          FileBudget& budget) {
    Step step(project);
    SensingOptions sizes;
    if (areas) {
        sizes.leaf_area = area_of_object(TurtleOperation::Leaf);
        sizes.flower_area = area_of_object(TurtleOperation::Flower);
    }
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        if (symbol.turtle != TurtleOperation::MeshFile) {
            continue;
        }
        sizes.mesh_lengths.resize(bytecode.symbols.size(), 1.0F);
        sizes.mesh_areas.resize(bytecode.symbols.size(), 0.0);
        const std::string path = path_text(folder / path_of(path_of_object(symbol.mesh_file)));
        const Result<std::string> bytes =
            step.read_referenced(path, {~std::uint64_t{0}, budget.left});
        if (!bytes) {
            return step.fail(bytes.error());
        }
        const std::uint64_t left = budget.left - bytes.value().size();
        const auto refuse = [&](const Error& error) {
            return step.fail(
                Error{fmt::format("cannot use `{}`: {}", path, error.message), error.kind});
        };
        if (is_picture_file(path)) { // a card, 1 high and as wide as the picture
            const Result<Texture> picture = read_picture(bytes.value(), left);
            if (!picture) {
                return refuse(picture.error());
            }
            sizes.mesh_areas[i] = 0.5 * static_cast<double>(picture.value().width) /
                                  static_cast<double>(picture.value().height);
            continue;
        }
        const Result<UserMesh> mesh = read_object_file(symbol.mesh_file, bytes.value(), left);
        if (!mesh) {
            return refuse(mesh.error());
        }
        sizes.mesh_lengths[i] = mesh.value().length();
        sizes.mesh_areas[i] = 0.5 * area_of_triangles(mesh.value().positions, mesh.value().indices);
    }
    return step.done(std::move(sizes));
}

} // namespace lsys
