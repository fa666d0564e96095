// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/marker_search.h"

#include "runtime/base/exact_functions.h"

#include <array>
#include <cmath>

namespace lsys {

MarkerReach marker_reach(const BytecodeEnvironment& declared) {
    const auto radius = static_cast<double>(declared.radius);
    const auto angle = static_cast<double>(declared.angle);
    const auto kill = static_cast<double>(declared.kill);
    return {radius * radius, exact_cosine_of_degrees(angle / 2.0), angle == 360.0, kill * kill};
}

MarkerSearch::MarkerSearch(std::span<const SensePlace> places,
                           const MarkerReach& reach,
                           const EnvironmentContext& context)
    : places_(places), reach_(reach), tree_(make_point_tree(places, context)) {}

bool MarkerSearch::kills(const Vector3& marker) const {
    if (reach_.kill_squared == 0.0) {
        return false;
    }
    std::array<std::uint32_t, kMaxSplitDepth> open{};
    std::size_t open_count = 1;
    while (open_count > 0) {
        const std::uint32_t index = open[--open_count];
        const PointTree::Node& node = tree_.nodes[index];
        if (!(least_squared(node, marker) < reach_.kill_squared)) {
            continue;
        }
        if (node.items.second != 0) {
            open[open_count++] = node.items.second;
            open[open_count++] = index + 1;
            continue;
        }
        for (std::uint32_t at = node.items.begin; at < node.items.end; ++at) {
            if (squared_length(minus(marker, tree_.points[at])) < reach_.kill_squared) {
                return true;
            }
        }
    }
    return false;
}

std::uint32_t MarkerSearch::find(const Vector3& marker) const {
    struct Open {
        std::uint32_t node = 0;
        double least = 0.0;
    };
    double nearest = reach_.radius_squared;
    std::uint32_t found = kNoPlace;
    std::array<Open, kMaxSplitDepth> open;
    std::size_t open_count = 0;
    open[open_count++] = {0, least_squared(tree_.nodes[0], marker)};
    while (open_count > 0) {
        const Open next = open[--open_count];
        if (!(next.least <= nearest)) {
            continue;
        }
        const SplitNode& items = tree_.nodes[next.node].items;
        if (items.second != 0) {
            const Open first{next.node + 1, least_squared(tree_.nodes[next.node + 1], marker)};
            const Open second{items.second, least_squared(tree_.nodes[items.second], marker)};
            const bool first_is_nearer = first.least <= second.least;
            open[open_count++] = first_is_nearer ? second : first;
            open[open_count++] = first_is_nearer ? first : second;
            continue;
        }
        for (std::uint32_t at = items.begin; at < items.end; ++at) {
            const Vector3 way = minus(marker, tree_.points[at]);
            const double squared = squared_length(way);
            const std::uint32_t position = tree_.positions[at];
            if ((squared < nearest || (squared == nearest && position < found)) &&
                sees(position, way, squared)) {
                nearest = squared;
                found = position;
            }
        }
    }
    return found;
}

bool MarkerSearch::sees(std::uint32_t position, const Vector3& way, double squared) const {
    return reach_.sees_all || squared == 0.0 ||
           dot(places_[position].heading, way) >= reach_.cosine * std::sqrt(squared);
}

} // namespace lsys
