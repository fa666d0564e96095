// A limp twig loads its branch as a point mass at its base does, so a coarse plant falls as the
// whole plant does: Body::moment, clearance and ground_spring are those of the whole plant.
#include "runtime/physics/impl/coarse.h"

#include "runtime/physics/impl/ground.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <numbers>

namespace lsys {

namespace {

constexpr std::uint32_t kCoarsest = 500; // approximate bodies of the coarsest plant
constexpr std::uint32_t kGrowth = 4;     // approximate ratio of bodies from plant to plant
constexpr double kMinGrowth = 3.0;       // min ratio

/// Sums over each body and its descendants, by body.
struct Twigs {
    std::vector<std::uint32_t> sizes; // bodies
    std::vector<double> masses;       // kg
    std::vector<float> sails;         // m^2, area in the wind, mean over all directions
};

Twigs twigs_of(const std::vector<Body>& bodies) {
    constexpr float kMeanSine = std::numbers::pi_v<float> / 4.0F;
    constexpr float kMeanCosine = 0.5F;
    const std::size_t count = bodies.size();
    Twigs out{std::vector<std::uint32_t>(count, 1), std::vector<double>(count, 0.0),
              std::vector<float>(count, 0.0F)};
    for (std::size_t b = count; b-- > 0;) {
        const Body& body = bodies[b];
        out.masses[b] += body.mass;
        out.sails[b] += kMeanSine * body.side + kMeanCosine * body.end + body.sail;
        if (body.parent != kNoSegment) {
            out.sizes[body.parent] += out.sizes[b];
            out.masses[body.parent] += out.masses[b];
            out.sails[body.parent] += out.sails[b];
        }
    }
    return out;
}

/// The part of `plant` whose bodies have at least `min_size` bodies in their subtree, themselves
/// included.
CoarsePlant coarse_plant(const Bodies& plant, const Twigs& twigs, std::uint32_t min_size) {
    CoarsePlant out;
    std::vector<std::uint32_t> places(plant.bodies.size(), kNoSegment);
    std::uint32_t begin = 0;
    for (const std::uint32_t end : plant.level_ends) {
        for (std::uint32_t b = begin; b < end; ++b) {
            if (twigs.sizes[b] < min_size) {
                continue;
            }
            const auto place = static_cast<std::uint32_t>(out.whole.size());
            places[b] = place;
            out.whole.push_back(b);
            Body body = plant.bodies[b];
            glm::dvec3 first_moment = body.mass * body.centre;
            for (std::uint32_t c = body.first_child; c < body.first_child + body.child_count; ++c) {
                if (twigs.sizes[c] < min_size) {
                    const glm::dvec3& offset = plant.bodies[c].offset;
                    body.mass += twigs.masses[c];
                    first_moment += twigs.masses[c] * offset;
                    body.inertia += point_inertia(twigs.masses[c], offset);
                    body.sail = std::min(body.sail + twigs.sails[c], 1e30F);
                }
            }
            if (body.mass > 0.0) {
                body.centre = first_moment / body.mass;
            }
            body.first_child = 0;
            body.child_count = 0;
            if (body.parent != kNoSegment) {
                body.parent = places[body.parent];
                Body& parent = out.bodies.bodies[body.parent];
                parent.first_child = parent.child_count == 0 ? place : parent.first_child;
                ++parent.child_count;
            }
            out.bodies.bodies.push_back(body);
        }
        const auto count = static_cast<std::uint32_t>(out.whole.size());
        if (out.bodies.level_ends.empty() || out.bodies.level_ends.back() < count) {
            out.bodies.level_ends.push_back(count);
        }
        begin = end;
    }
    return out;
}

} // namespace

std::vector<CoarsePlant> coarse_plants(const Bodies& plant) {
    std::vector<CoarsePlant> out;
    const std::size_t count = plant.bodies.size();
    if (count < kMinCoarsened) {
        return out;
    }
    const Twigs twigs = twigs_of(plant.bodies);
    std::vector<std::uint32_t> sorted = twigs.sizes;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    for (std::size_t most = kCoarsest; most < count; most *= kGrowth) {
        // At most `most` bodies have larger subtrees than item `most` of `sorted`.
        const std::uint32_t min_size = sorted[most] + 1;
        const auto kept = static_cast<double>(
            std::partition_point(sorted.begin(), sorted.end(),
                                 [&](std::uint32_t size) { return size >= min_size; }) -
            sorted.begin());
        const bool is_less = kMinGrowth * kept <= static_cast<double>(count);
        const double before = out.empty() ? 0.0 : static_cast<double>(out.back().whole.size());
        if (kept > 0.0 && is_less && kept >= kMinGrowth * before) {
            out.push_back(coarse_plant(plant, twigs, min_size));
        }
    }
    return out;
}

void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses) {
    for (std::size_t b = 0; b < plant.bodies.size(); ++b) {
        const Body& body = plant.bodies[b];
        BodyPose& pose = poses[b];
        if (body.parent == kNoSegment) {
            pose.shift = glm::dvec3(0.0);
            pose.turn = known[b] != 0 ? pose.turn : before[b].turn;
            continue;
        }
        const BodyPose& parent = poses[body.parent];
        pose.shift = parent.shift + (parent.turn * body.offset - body.offset);
        if (known[b] == 0) {
            pose.turn = glm::normalize(parent.turn *
                                       (glm::conjugate(before[body.parent].turn) * before[b].turn));
            pose.turn = ground ? raised(body, pose.turn, pose.shift) : pose.turn;
        }
    }
}

} // namespace lsys
