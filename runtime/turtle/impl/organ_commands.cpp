// SPDX-License-Identifier: MIT
// The commands of organs: SURFACE_BEGIN, SURFACE_POINT, SURFACE_END, SURFACE_TANGENTS,
// SURFACE_RADII.
#include "runtime/base/exact_functions.h"
#include "runtime/turtle/impl/state.h"

namespace lsys {

namespace {

glm::dvec3 place_of(const Pose& pose) {
    return {pose.x, pose.y, pose.z};
}

glm::dquat turn_of(const Pose& pose) {
    return {pose.qw, pose.qx, pose.qy, pose.qz};
}

/// The point in the frame of the organ that begins at `base`.
OrganPoint local(const OpenOrganPoint& from, const Pose& base) {
    OrganPoint point = from.point;
    const glm::dquat back = glm::conjugate(turn_of(base));
    point.position = glm::vec3(back * (place_of(from.pose) - place_of(base)));
    point.frame = glm::quat(glm::normalize(back * turn_of(from.pose)));
    return point;
}

} // namespace

bool Turtle::State::begin_organ() {
    if (organs.is_open_at(stack.size())) {
        if (!traits.organs_branch) {
            note(TurtleFaultKind::SurfaceWithin);
            return true;
        }
        if (!close_organ(OrganEnd::LastPoint)) { // cpfg begins anew
            return false;
        }
    }
    OpenOrgan organ;
    organ.depth = stack.size();
    organ.first = organs.points.size();
    organ.object.kind = TurtleOperation::SurfaceBegin;
    organ.object.position = position_of(now.pose);
    organ.object.frame = frame_of(now.pose);
    organ.object.parent = now.segment;
    organ.object.order = order();
    organ.object.colour = now.colour;
    organ.origin = origin;
    organ.position = position;
    organ.code = code;
    return within_memory([&] { organs.open.push_back(organ); }) && add_organ_point();
}

/// Adds the turtle's place to the open organ. A point at the place of the point before replaces it,
/// so that `F` and a point behind it are one.
bool Turtle::State::add_organ_point() {
    if (!(now.width <= std::numeric_limits<float>::max())) {
        return fault(TurtleFaultKind::NotFinite);
    }
    OpenOrganPoint added;
    added.pose = now.pose;
    added.point.width = now.width;
    added.point.tangent_before = now.tangent_before;
    added.point.tangent_after = now.tangent_after;
    added.point.radii = now.radii;
    added.point.contour = now.contour;
    added.point.colour = now.colour;
    added.point.sides = now.sides;
    std::vector<OpenOrganPoint>& points = organs.points;
    if (points.size() > organs.open.back().first &&
        position_of(points.back().pose) == position_of(now.pose)) {
        points.back() = added;
        return true;
    }
    const std::uint64_t bytes = skeleton.byte_count() + 2 * points.size() * sizeof(OpenOrganPoint);
    if (points.size() == points.capacity() && bytes > options.max_bytes) {
        return stop(Stop::Limit);
    }
    return within_memory([&] { points.push_back(added); });
}

/// Continues the open organ, from its last point, in the branch that begins (cpfg).
bool Turtle::State::continue_organ() {
    OpenOrgan organ = organs.open.back();
    organ.depth = stack.size();
    organ.first = organs.points.size();
    organ.continues = true;
    const OpenOrganPoint last = organs.points.back();
    return within_memory([&] {
        organs.points.push_back(last);
        organs.open.push_back(organ);
    });
}

/// Ends the open organ and draws it.
bool Turtle::State::close_organ(OrganEnd place) {
    if (place == OrganEnd::Here && !add_organ_point()) {
        return false;
    }
    const OpenOrgan organ = organs.open.back();
    const std::size_t count = organs.points.size() - organ.first;
    const Pose base = organs.points[organ.first].pose;
    if (count < 2 && organ.continues) {
        // The branch adds nothing to the organ.
    } else if (count < 2) {
        note_at(TurtleFaultKind::SmallSurface, organ.position, organ.code);
    } else {
        if (!make_room(skeleton.organs) || !make_room(skeleton.objects)) {
            return false;
        }
        const auto first = static_cast<std::uint32_t>(skeleton.organ_points.size());
        for (std::size_t i = organ.first; i < organs.points.size(); ++i) {
            if (!make_room(skeleton.organ_points)) {
                return false;
            }
            skeleton.organ_points.push_back(local(organs.points[i], base));
        }
        PlacedObject object = organ.object;
        object.position = position_of(base);
        object.frame = frame_of(base);
        object.mesh_file = static_cast<std::uint32_t>(skeleton.organs.size());
        skeleton.organs.push_back({first, static_cast<std::uint32_t>(count)});
        skeleton.objects.push_back(object);
        if (has_origins) {
            if (!make_room(skeleton.object_origins)) {
                return false;
            }
            skeleton.object_origins.push_back(organ.origin);
        }
    }
    organs.points.resize(organ.first);
    organs.open.pop_back();
    return true;
}

/// Ends the organs that are open at the end of the word, each in the turtle's state of its branch.
bool Turtle::State::close_all_organs() {
    std::size_t depth = stack.size();
    while (!organs.open.empty()) {
        while (organs.open.back().depth < depth) {
            now = stack[--depth];
        }
        if (!close_organ(organ_end())) {
            return false;
        }
    }
    return true;
}

void Turtle::State::set_tangents(const Action& action, const float* arguments) {
    now.tangent_before = action.argument_count > 0 ? arguments[0] : 1.0F;
    now.tangent_after = action.argument_count > 1 ? arguments[1] : now.tangent_before;
    if (!std::isfinite(now.tangent_before) || !std::isfinite(now.tangent_after)) {
        now.tangent_before = 1.0F;
        now.tangent_after = 1.0F;
    }
}

void Turtle::State::set_radius_tangents(const Action& action, const float* arguments) {
    if (action.argument_count == 1) {
        now.radii.per_chord = arguments[0] != 0.0F;
        return;
    }
    if (action.argument_count == 0) {
        now.radii = {};
        return;
    }
    const auto component = [&](std::size_t i, bool is_radius) {
        const ExactSineCosine turned =
            exact_sine_cosine_of_degrees(static_cast<double>(arguments[i]));
        const double value =
            static_cast<double>(arguments[i + 1]) * (is_radius ? turned.sine : turned.cosine);
        return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
    };
    const std::size_t after = action.argument_count > 3 ? 2 : 0;
    now.radii = {component(0, false), component(0, true), component(after, false),
                 component(after, true), now.radii.per_chord};
}

} // namespace lsys
