// SPDX-License-Identifier: MIT
// Environments of kind Solid: the signed distance to the nearest of several surfaces, and the
// direction to it (Prusinkiewicz, James & Mech 1994, "Synthetic topiary").
//
// The arithmetic, in binary64: the distance to a plane a x + b y + c z + d is |s| / m with
// s = ((a x + b y) + c z) + d and m the square root of (a^2 + b^2) + c^2; the unit vector to it is
// -(a, b, c) / m where s > 0, (a, b, c) / m where s < 0. The distance to a mesh is the square root
// of the least squared distance to a triangle with an area (impl/triangle_distance.h); the unit
// vector is the vector to the nearest point, each component divided by the distance. Of surfaces at
// equal distances the first is taken, planes before meshes. Triangles, of one mesh or of several,
// are compared by squared distances. A distance to a mesh of at most 2^-48 times the greatest
// magnitude of a coordinate, of the place or of a corner of a triangle, is 0: the nearest point has
// rounding errors of that order, which would move places on a face off the surface.
#include "grammar/base/contract.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/impl/space_order.h"
#include "runtime/environment/impl/triangle_tree.h"
#include "runtime/environment/impl/vectors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

/// Max distance at which a place is on a mesh, relative to the greatest magnitude of a coordinate.
constexpr double kOnSurface = 0x1p-48;

double magnitude_of(const Vector3& point) {
    return std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
}

struct SolidPlane {
    Vector3 normal{};    // a, b, c
    double offset = 0.0; // d
    double length = 1.0; // length of `normal`
};

class SolidEnvironment : public Environment {
public:
    SolidEnvironment(const BytecodeEnvironment& declared,
                     const EnvironmentFiles& files,
                     const EnvironmentContext& context)
        : files_(files), context_(context) {
        for (const EnvironmentSurface& surface : declared.surfaces) {
            if (surface.path.empty()) {
                SolidPlane plane;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    plane.normal[axis] = static_cast<double>(surface.plane[axis]);
                }
                plane.offset = static_cast<double>(surface.plane[3]);
                plane.length = std::sqrt(squared_length(plane.normal));
                LSYS_CHECK(plane.length > 0.0);
                planes_.push_back(plane);
            }
        }
        LSYS_CHECK(declared.surfaces.size() == planes_.size() + files.meshes.size());
        LSYS_CHECK(!declared.surfaces.empty());
    }

    std::optional<EnvironmentFailure> begin(std::uint64_t /*seed*/) override {
        return build_trees();
    }

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        if (auto failure = check_places(word.places)) {
            return failure;
        }
        if (word.places.empty()) {
            return std::nullopt;
        }
        return answer_all(word.places, answers);
    }

private:
    static constexpr std::size_t kPlaces = 1U << 8; // places per piece of work

    std::optional<EnvironmentFailure> answer_all(std::span<const SensePlace> places,
                                                 std::vector<float>& answers) const {
        // Places near each other are answered one after the other, because their searches visit the
        // same nodes of the trees.
        const std::size_t count = places.size();
        const std::uint64_t bytes = tree_bytes_ + count * kSpaceOrderBytes;
        if (bytes > context_.max_bytes) {
            return beyond_memory(bytes);
        }
        const LargeVector<std::uint32_t> order = order_in_space(places, context_);
        context_.workers->for_each((count + kPlaces - 1) / kPlaces, [&](std::uint64_t piece) {
            if (is_cancelled(context_.cancelled)) {
                return;
            }
            const std::size_t begin = piece * kPlaces;
            const std::size_t end = std::min(count, begin + kPlaces);
            // Read all positions in one loop, so that the processor waits for several reads at the
            // same time.
            std::array<Vector3, kPlaces> positions;
            for (std::size_t i = begin; i < end; ++i) {
                positions[i - begin] = places[order[i]].position;
            }
            std::array<NearestPoint, kPlaces> nearest;
            for (const std::unique_ptr<TriangleTree>& tree : trees_) {
                tree->find_nearest({positions.data(), end - begin}, nearest);
            }
            for (std::size_t i = begin; i < end; ++i) {
                answer_one(positions[i - begin], nearest[i - begin],
                           answers.data() + std::size_t{order[i]} * 4);
            }
        });
        if (is_cancelled(context_.cancelled)) {
            return stopped(Stop::Cancelled);
        }
        return std::nullopt;
    }

    /// Builds the trees of the meshes, once for all derivations.
    std::optional<EnvironmentFailure> build_trees() {
        if (trees_.size() == files_.meshes.size()) {
            return std::nullopt;
        }
        trees_.clear();
        std::uint64_t bytes = 0;
        for (const EnvironmentMesh& mesh : files_.meshes) {
            if (auto failure = check_mesh(mesh)) {
                return failure;
            }
            bytes += TriangleTree::bytes(mesh);
        }
        if (bytes > context_.max_bytes) {
            return beyond_memory(bytes);
        }
        std::vector<std::unique_ptr<TriangleTree>> trees;
        double magnitude = 0.0;
        for (const EnvironmentMesh& mesh : files_.meshes) {
            for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
                for (const std::uint32_t corner : corners) {
                    magnitude = std::max(magnitude, magnitude_of(mesh.vertices[corner]));
                }
            }
            trees.push_back(std::make_unique<TriangleTree>(mesh, context_));
            if (is_cancelled(context_.cancelled)) {
                return stopped(Stop::Cancelled);
            }
            if (trees.back()->empty()) {
                return refused("its mesh has no triangle with an area",
                               "give the triangles three different corners");
            }
        }
        trees_ = std::move(trees);
        magnitude_ = magnitude;
        tree_bytes_ = bytes;
        return std::nullopt;
    }

    /// `nearest`: the nearest point of all meshes.
    void answer_one(const Vector3& place, const NearestPoint& nearest, float* answer) const {
        double distance = std::numeric_limits<double>::infinity();
        Vector3 direction{};
        bool inside = false;
        for (const SolidPlane& plane : planes_) {
            const double side = dot(plane.normal, place) + plane.offset;
            const double from_plane = std::abs(side) / plane.length;
            inside = inside || side < 0.0;
            if (from_plane < distance) {
                distance = from_plane;
                const double sign = side > 0.0 ? -1.0 : 1.0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    direction[axis] = sign * plane.normal[axis] / plane.length;
                }
            }
        }
        for (const std::unique_ptr<TriangleTree>& tree : trees_) {
            inside = inside || tree->is_inside(place);
        }
        double from_mesh = std::sqrt(nearest.squared);
        if (from_mesh <= kOnSurface * std::max(magnitude_, magnitude_of(place))) {
            from_mesh = 0.0;
        }
        if (from_mesh < distance) {
            distance = from_mesh;
            direction = normalised(nearest.away);
        }
        if (distance == 0.0) {
            direction = {};
        }
        write_answer(inside ? -distance : distance, direction, answer);
    }

    const EnvironmentFiles& files_;
    EnvironmentContext context_;
    std::vector<SolidPlane> planes_;
    std::vector<std::unique_ptr<TriangleTree>> trees_; // one for each mesh, after begin()
    std::uint64_t tree_bytes_ = 0;                     // bytes of `trees_`
    double magnitude_ = 0.0; // m, greatest magnitude of a coordinate of the meshes
};

} // namespace

std::unique_ptr<Environment> make_solid(const BytecodeEnvironment& declared,
                                        const EnvironmentFiles& files,
                                        const EnvironmentContext& context) {
    return std::make_unique<SolidEnvironment>(declared, files, context);
}

} // namespace lsys
