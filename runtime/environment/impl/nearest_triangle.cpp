// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/nearest_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

/// Max triangles of a mesh whose corners are copied: at most 150 MB of copies.
constexpr std::size_t kMaxCopied = 1U << 21;

} // namespace

void NearestTriangle::build(std::span<const LeafTriangle> triangles,
                            std::span<const SplitNode> split,
                            Workers& workers) {
    constexpr std::size_t kPieces = 1U << 10; // cylinders of one piece of work
    triangles_ = triangles;
    corners_.clear();
    if (triangles.size() <= kMaxCopied) {
        corners_.reserve(triangles.size());
        for (std::size_t at = 0; at < triangles.size(); ++at) {
            corners_.push_back(corners_of(triangles[at]));
        }
    }
    find_frame();
    const LargeVector<WideChild> children = make_wide_nodes(split, nodes_);
    workers.for_each((children.size() + kPieces - 1) / kPieces, [&](std::uint64_t number) {
        const std::size_t end = std::min<std::size_t>(children.size(), (number + 1) * kPieces);
        for (std::size_t i = number * kPieces; i < end; ++i) {
            fill_cylinder(children[i]);
        }
    });
}

void NearestTriangle::find_frame() {
    PointBox box;
    for (const LeafTriangle& triangle : triangles_) {
        for (const std::uint32_t vertex : triangle.vertices) {
            box.add(vertices_[vertex]);
        }
    }
    double magnitude = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        magnitude = std::max({magnitude, std::abs(box.low[axis]), std::abs(box.high[axis])});
    }
    frame_ = Frame(box);
    // A computed nearest point may lie outside its triangle by some units in the last place of the
    // largest coordinate. Cylinders are larger than their triangles by far more.
    cylinder_margin_ = 1e-12 * magnitude * frame_.scale();
}

Vector3 NearestTriangle::axis_of(const WideChild& child) const {
    Vector3 sum{};
    for (std::size_t at = child.begin; at < child.end; ++at) {
        const std::array<std::uint32_t, 3>& corners = triangles_[at].vertices;
        const Vector3 area =
            area_vector({framed(corners[0]), framed(corners[1]), framed(corners[2])});
        sum = dot(sum, area) < 0.0 ? minus(sum, area) : plus(sum, area);
    }
    const Vector3 axis = normalised(sum);
    return is_finite(axis) && axis != Vector3{} ? axis : Vector3{0.0, 1.0, 0.0};
}

Vector3 NearestTriangle::middle_of(const WideChild& child, const Vector3& axis) const {
    constexpr std::uint32_t kFew = 16; // max triangles for which the middle is improved in rounds
    constexpr int kRounds = 6;
    Vector3 low = framed(triangles_[child.begin].vertices[0]);
    Vector3 high = low;
    const auto for_each_corner = [&](const auto& work) {
        for (std::size_t at = child.begin; at < child.end; ++at) {
            for (const std::uint32_t vertex : triangles_[at].vertices) {
                work(framed(vertex));
            }
        }
    };
    for_each_corner([&](const Vector3& corner) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], corner[i]);
            high[i] = std::max(high[i], corner[i]);
        }
    });
    Vector3 middle = times(plus(low, high), 0.5);
    // Move the middle towards the centre of the smallest circle around all corners, seen along the
    // axis (Badoiu & Clarkson 2003, "Smaller core-sets for balls").
    for (int round = 0; round < kRounds && child.end - child.begin <= kFew; ++round) {
        double farthest = -1.0;
        Vector3 way{};
        for_each_corner([&](const Vector3& corner) {
            const Vector3 offset = minus(corner, middle);
            const Vector3 beside = minus(offset, times(axis, dot(axis, offset)));
            if (squared_length(beside) > farthest) {
                farthest = squared_length(beside);
                way = beside;
            }
        });
        middle = plus(middle, times(way, 1.0 / (round + 3)));
    }
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for_each_corner([&](const Vector3& corner) {
        const double along = dot(axis, minus(corner, middle));
        least = std::min(least, along);
        most = std::max(most, along);
    });
    return plus(middle, times(axis, 0.5 * (least + most)));
}

void NearestTriangle::fill_cylinder(const WideChild& child) {
    Node& node = nodes_[child.node];
    const std::size_t lane = child.lane;
    if (!(frame_.scale() > 0.0 && cylinder_margin_ < 1.0)) { // bounds will not be used
        return;
    }
    Vector3 axis = axis_of(child);
    Vector3 middle = middle_of(child, axis);
    for (std::size_t i = 0; i < 3; ++i) {
        node.axis[i][lane] = static_cast<float>(axis[i]);
        node.middle[i][lane] = static_cast<float>(middle[i]);
        // Compute radius and length for the rounded axis and middle, which the search uses.
        axis[i] = static_cast<double>(node.axis[i][lane]);
        middle[i] = static_cast<double>(node.middle[i][lane]);
    }
    double half_length = 0.0;
    double radius_squared = 0.0;
    for (std::size_t at = child.begin; at < child.end; ++at) {
        for (const std::uint32_t vertex : triangles_[at].vertices) {
            const Vector3 offset = minus(framed(vertex), middle);
            const double along = dot(axis, offset);
            const Vector3 beside = minus(offset, times(axis, along));
            half_length = std::max(half_length, std::abs(along));
            radius_squared = std::max(radius_squared, squared_length(beside));
        }
    }
    node.half_length[lane] = upper_float(half_length + cylinder_margin_);
    node.radius[lane] = upper_float(std::sqrt(radius_squared) + cylinder_margin_);
}

inline Lanes NearestTriangle::least_squared(const Node& node, const std::array<Lanes, 3>& at) {
    const Lanes x = at[0] - node.middle[0];
    const Lanes y = at[1] - node.middle[1];
    const Lanes z = at[2] - node.middle[2];
    const Lanes along = x * node.axis[0] + y * node.axis[1] + z * node.axis[2];
    const Lanes beside_x = x - along * node.axis[0];
    const Lanes beside_y = y - along * node.axis[1];
    const Lanes beside_z = z - along * node.axis[2];
    const Lanes beside =
        square_roots(beside_x * beside_x + beside_y * beside_y + beside_z * beside_z);
    const Lanes above = not_negative(magnitudes(along) - node.half_length);
    const Lanes outside = not_negative(beside - node.radius);
    return above * above + outside * outside;
}

/// The search for one place, in steps.
class NearestTriangle::Search {
public:
    explicit Search(const NearestTriangle& tree) : tree_(tree) {}

    [[nodiscard]] bool is_done() const { return count_ == 0; }

    /// Begins with the triangle `hint`. `place` and `nearest` outlive the search.
    void start(const Vector3& place, NearestPoint& nearest, std::uint32_t hint) {
        place_ = &place;
        nearest_ = &nearest;
        const FramedPlace framed = tree_.frame_.framed_place(place);
        is_bounded_ = framed.is_bounded && tree_.cylinder_margin_ < 1.0;
        margin_ = framed.margin;
        at_ = in_all_lanes(framed.at);
        next_index_ = 0;
        first_ = hint;
        found_ = hint;
        set_limit();
        consider(hint);
        open_[0] = OpenNode::root();
        count_ = 1;
    }

    /// Visits one node.
    void step() {
        const OpenNode next = open_[--count_];
        if (next.least() > limit_) {
            return;
        }
        const Node& node = tree_.nodes_[next.index()];
        const std::size_t bottom = count_;
        count_ = push_children(open_, bottom, node, least_squared(node, at_), limit_);
        while (node.is_leaf && count_ > bottom) {
            const OpenNode child = open_[--count_];
            if (!(child.least() > limit_) && child.index() != first_) {
                consider(child.index());
            }
        }
    }

    /// The nearest triangle, or the one that the search began with if another mesh is nearer.
    [[nodiscard]] std::uint32_t found() const { return found_; }

private:
    void set_limit() {
        const double distance = std::sqrt(nearest_->squared) * tree_.frame_.scale() + margin_;
        limit_ =
            is_bounded_ ? upper_float(distance * distance) : std::numeric_limits<float>::infinity();
    }

    void consider(std::uint32_t at) {
        const LeafTriangle& triangle = tree_.triangles_[at];
        const NearestPoint point =
            nearest_point(tree_.corners_.empty() ? tree_.corners_of(triangle) : tree_.corners_[at],
                          *place_, nearest_->squared);
        const std::uint32_t index = triangle.index + 1;
        if (point.squared < nearest_->squared ||
            (point.squared == nearest_->squared && index < next_index_)) {
            *nearest_ = point;
            next_index_ = index;
            found_ = at;
            set_limit();
        }
    }

    const NearestTriangle& tree_;
    const Vector3* place_ = nullptr;  // `place` of start(); null before
    NearestPoint* nearest_ = nullptr; // `nearest` of start(); null before
    std::array<Lanes, 3> at_{};       // the place in the frame
    double margin_ = 0.0;             // FramedPlace::margin
    float limit_ = 0.0F;              // squared distance in the frame above which nodes are skipped
    bool is_bounded_ = false;         // whether the bounds of nodes are used
    /// 1 + LeafTriangle::index of the nearest triangle so far; 0: it is a triangle of another mesh.
    std::uint32_t next_index_ = 0;
    std::uint32_t first_ = 0; // `hint` of start()
    std::uint32_t found_ = 0; // result of found()
    std::size_t count_ = 0;   // entries of `open_`
    OpenNodes open_;
};

void NearestTriangle::find(std::span<const Vector3> places, std::span<NearestPoint> nearest) const {
    // Two searches take turns. The steps of one search depend on each other, so a processor works
    // on both at the same time.
    std::array<Search, 2> searches{Search(*this), Search(*this)};
    std::uint32_t hint = 0;
    std::size_t next = 0;
    for (bool is_busy = true; is_busy;) {
        is_busy = false;
        for (Search& search : searches) {
            if (search.is_done() && next < places.size()) {
                hint = next < searches.size() ? hint : search.found();
                search.start(places[next], nearest[next], hint);
                ++next;
            }
            if (!search.is_done()) {
                search.step();
                is_busy = true;
            }
        }
    }
}

std::uint64_t NearestTriangle::bytes(std::size_t triangles) {
    const std::uint64_t nodes = wide_node_count(triangles);
    return nodes * sizeof(Node) + (triangles + nodes) * sizeof(WideChild) +
           (triangles <= kMaxCopied ? triangles * sizeof(Triangle) : 0);
}

} // namespace lsys
