// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/marker_search.h"

#include "runtime/base/exact_functions.h"

#include <array>
#include <cmath>
#include <limits>

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
    : places_(places), reach_(reach), radius_(std::sqrt(reach.radius_squared)),
      kill_(std::sqrt(reach.kill_squared)), compares_headings_(!reach.sees_all) {
    if (places.empty()) {
        return;
    }
    LargeVector<SplitItem> items = split_items(places);
    const LargeVector<SplitNode> split =
        build_split_tree(items, kLanes, *context.workers, context.cancelled);
    if (split.empty()) {
        return;
    }
    PointBox box;
    for (const SensePlace& place : places) {
        box.add(place.position);
        // Turtles do not renormalise headings. The margin of the angle is valid for lengths below
        // 2.
        compares_headings_ = compares_headings_ && squared_length(place.heading) < 4.0;
    }
    frame_ = Frame(box, radius_);
    const LargeVector<WideChild> children = make_wide_nodes(split, nodes_);
    for (Node& node : nodes_) {
        if (node.is_leaf) {
            fill_leaf(node, items);
        }
    }
    fill_boxes(children, items);
}

void MarkerSearch::fill_leaf(Node& node, std::span<const SplitItem> items) const {
    for (std::size_t lane = 0; lane < node.count; ++lane) {
        const std::uint32_t position = items[node.children[lane]].index;
        node.children[lane] = position;
        const Vector3 at = frame_.framed(places_[position].position);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.low[axis][lane] = static_cast<float>(at[axis]);
            if (compares_headings_) {
                node.high[axis][lane] = static_cast<float>(places_[position].heading[axis]);
            }
        }
    }
}

void MarkerSearch::fill_boxes(std::span<const WideChild> children,
                              std::span<const SplitItem> items) {
    for (const WideChild& child : children) {
        Node& node = nodes_[child.node];
        if (node.is_leaf) {
            continue;
        }
        PointBox box;
        for (const SplitItem& item : items.subspan(child.begin, child.end - child.begin)) {
            box.add(frame_.framed(places_[item.index].position));
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Rounding to nearest suffices, since FramedPlace::margin is far above the rounding
            // error.
            node.low[axis][child.lane] = static_cast<float>(box.low[axis]);
            node.high[axis][child.lane] = static_cast<float>(box.high[axis]);
        }
    }
}

/// The search for one marker.
class MarkerSearch::Query {
public:
    Query(const MarkerSearch& search, const Vector3& marker)
        : search_(search), marker_(marker), framed_(search.frame_.framed_place(marker)),
          at_(in_all_lanes(framed_.at)), nearest_(search.reach_.radius_squared),
          limit_(limit_of(search.radius_)),
          kill_limit_(search.kill_ > 0.0 ? limit_of(search.kill_) : -1.0F) {
        if (search.compares_headings_ && framed_.is_bounded) {
            cosine_ = static_cast<float>(search.reach_.cosine);
            // With u and s of Frame::framed_place(), the dot product of heading and `way` has an
            // error of 24 u s, and |way| times the cosine one of 11 u s.
            angle_margin_ = static_cast<float>(-framed_.margin);
        }
    }

    std::uint32_t find(std::uint32_t hint) {
        if (hint < kKilled && consider(hint)) {
            return kKilled;
        }
        OpenNodes open;
        std::size_t count = 0;
        open[count++] = OpenNode::root();
        while (count > 0) {
            const OpenNode next = open[--count];
            const float limit = std::max(limit_, kill_limit_);
            if (next.least() > limit) {
                continue;
            }
            const Node& node = search_.nodes_[next.index()];
            if (node.is_leaf) {
                const std::uint32_t used = (1U << node.count) - 1;
                for (std::uint32_t bits = candidates(node) & used; bits != 0; bits &= bits - 1) {
                    if (consider(node.children[lowest_lane(bits)])) {
                        return kKilled;
                    }
                }
                continue;
            }
            count = push_children(open, count, node, least_squared(node), limit);
        }
        return found_;
    }

private:
    /// The squared distance in the frame, with its margin, of a distance in metres.
    [[nodiscard]] float limit_of(double metres) const {
        const double distance = metres * search_.frame_.scale() + framed_.margin;
        return framed_.is_bounded ? upper_float(distance * distance)
                                  : std::numeric_limits<float>::infinity();
    }

    [[nodiscard]] Lanes least_squared(const Node& node) const {
        Lanes sum{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Lanes apart =
                not_negative(greater(node.low[axis] - at_[axis], at_[axis] - node.high[axis]));
            sum += apart * apart;
        }
        return sum;
    }

    /// A mask of the places of a leaf that may kill the marker, or that may see it and be nearer than
    /// the nearest place so far.
    [[nodiscard]] std::uint32_t candidates(const Node& node) const {
        Lanes squared{};
        Lanes towards{}; // dot product of heading and `way`
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Lanes way = at_[axis] - node.low[axis];
            squared += way * way;
            towards += way * node.high[axis];
        }
        const Lanes beyond = towards - cosine_ * square_roots(squared);
        const LaneMask hidden = (squared > limit_) | (beyond < angle_margin_);
        return ~lane_bits(hidden & (squared > kill_limit_));
    }

    /// Makes the place at `position` the one found if it is nearer and sees the marker. Returns
    /// whether the place kills the marker.
    [[nodiscard]] bool consider(std::uint32_t position) {
        const Vector3 way = minus(marker_, search_.places_[position].position);
        const double squared = squared_length(way);
        if (squared < search_.reach_.kill_squared) {
            return true;
        }
        if ((squared < nearest_ || (squared == nearest_ && position < found_)) &&
            search_.sees(position, way, squared)) {
            nearest_ = squared;
            found_ = position;
            limit_ = limit_of(std::sqrt(squared));
        }
        return false;
    }

    const MarkerSearch& search_;
    const Vector3& marker_;
    FramedPlace framed_;
    std::array<Lanes, 3> at_;        // framed_.at, each coordinate in all lanes
    double nearest_;                 // m^2, squared distance of found_; at first radius^2
    std::uint32_t found_ = kNoPlace; // the nearest place so far that sees the marker
    float limit_;          // squared distance in the frame above which a place cannot be nearest
    float kill_limit_;     // squared distance in the frame above which a place cannot kill
    float cosine_ = -1.0F; // MarkerReach::cosine, if the angle is tested in binary32
    // -1 times the max error of that test; minus infinity: the angle is not tested in binary32.
    float angle_margin_ = -std::numeric_limits<float>::infinity();
};

std::uint32_t MarkerSearch::find(const Vector3& marker, std::uint32_t hint) const {
    return Query(*this, marker).find(hint);
}

bool MarkerSearch::sees(std::uint32_t position, const Vector3& way, double squared) const {
    return reach_.sees_all || squared == 0.0 ||
           dot(places_[position].heading, way) >= reach_.cosine * std::sqrt(squared);
}

std::uint64_t MarkerSearch::bytes(std::size_t places) {
    const std::uint64_t nodes = wide_node_count(places);
    return places * sizeof(SplitItem) + nodes * (sizeof(Node) + sizeof(SplitNode)) +
           (places + nodes) * sizeof(WideChild);
}

} // namespace lsys
