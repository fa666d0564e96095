// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/tetrahedra.h"

#include "runtime/base/workers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace lsys {

namespace {

using Node = glm::ivec3; // in units of the grid

// Three bisections halve the edges of a tetrahedron.
constexpr int kHalvings = 18;
constexpr int kUnits = 1 << kHalvings; // along the root cube
constexpr int kMaxGeneration = 3 * kHalvings;
constexpr int kPieceGeneration = 6; // generation of tetrahedra that are cut in parallel
/// Growth of the size of cells per metre of distance from the surface. Neighbours cut their common
/// edge in the same way if the wanted size changes by less than 0.16 per metre. The 0.16 follows
/// from three numbers: a bisection reduces the size Grid::step() by the fraction 0.206; the middles
/// of two edges of a tetrahedron are at most 0.71 of its longest edge apart; its longest edge is
/// less than 1.79 times this size.
constexpr double kGrowth = 0.1;
constexpr double kMaxGrowth = 0.16;
/// Size of cells at the edge of the flat base, as a fraction of the size elsewhere; small cells
/// keep the edge sharp.
constexpr double kBaseCells = 0.25;
/// Triangles between vertices on a curved surface lie within the solid. Therefore the surface of
/// cones is moved outwards by kChord * cell^2 / radius, which keeps their volume.
constexpr double kChord = 0.031;
/// Lipschitz bound of the distance from the surface: its max change per metre.
constexpr double kLipschitz = 1.02;
/// Size of a tetrahedron of generation k, by k modulo 3, relative to generation 0: 2^(-k / 3).
constexpr std::array<double, 3> kSteps{1.0, 0.7937005259840998, 0.6299605249474366};
/// Min distance of a vertex from the ends of its edge, as a fraction of the length of the edge, so
/// that no triangle shrinks to a line.
constexpr double kEdgeMargin = 0.02;
/// Max distance from the surface, as a fraction of the length of its edge, at which a vertex counts
/// as lying on the surface.
constexpr double kExact = 1e-6;

struct Tetrahedron {
    std::array<Node, 4> nodes{};
    std::array<double, 4> distances{}; // of the nodes from the surface
    int tag = 3;        // the next bisection cuts the edge from nodes[0] to nodes[tag]
    int generation = 0; // number of bisections that made it
};

struct Grid {
    glm::dvec3 origin{};
    double side = 1.0; // side of the root cube, m

    /// The middle between two nodes.
    [[nodiscard]] glm::dvec3 middle(const Node& a, const Node& b) const {
        return origin + glm::dvec3(a + b) * (0.5 * side / kUnits);
    }
    [[nodiscard]] glm::dvec3 position(const Node& node) const { return middle(node, node); }
    [[nodiscard]] double step(int generation) const {
        return side / static_cast<double>(1 << (generation / 3)) *
               kSteps[static_cast<std::size_t>(generation % 3)];
    }
};

/// A grid that contains all shapes with room around them. The ground, or the lowest point, lies at
/// a third of its height, and therefore between the nodes of every generation.
Grid make_grid(const Solid& solid) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high = -low;
    double thinnest = std::numeric_limits<double>::max(); // radius
    for (const SolidShape& shape : solid.shapes) {
        thinnest = std::min({thinnest, shape.base_radius, shape.tip_radius});
        const double radius = std::max(shape.base_radius, shape.tip_radius);
        for (const glm::dvec3& corner : shape.corners) {
            low = glm::min(low, corner - radius);
            high = glm::max(high, corner + radius);
        }
    }
    constexpr double kRoom = 1.6;
    const glm::dvec3 extent = high - low;
    Grid grid;
    const double min_side = kRoom * std::max({extent.x, extent.y, extent.z});
    // Puts the size of cells of the thinnest shapes, which are the most frequent, halfway between
    // the sizes of tetrahedra of two generations.
    constexpr double kPhase = 0.9;
    grid.side = kPhase * solid.cell * thinnest;
    while (grid.side < min_side) {
        grid.side *= 2.0;
    }
    const double smaller = grid.side * (grid.side * kSteps[2] >= min_side ? kSteps[2] : kSteps[1]);
    grid.side = smaller >= min_side ? smaller : grid.side;
    grid.origin = 0.5 * (low + high) - 0.49 * grid.side;
    grid.origin.y = solid.ground.value_or(low.y) - grid.side / 3.0;
    return grid;
}

/// A ball around a shape, and the size of the smallest cells of the shape.
struct Ball {
    glm::dvec3 centre{};
    double radius = 0.0;
    double cell = 0.0;
};

std::vector<Ball> make_balls(const Solid& solid) {
    std::vector<Ball> balls;
    balls.reserve(solid.shapes.size());
    for (const SolidShape& shape : solid.shapes) {
        Ball ball;
        const auto& [a, b, c] = shape.corners;
        ball.centre = shape.is_triangle ? (a + b + c) / 3.0 : 0.5 * (a + b);
        for (const glm::dvec3& corner : shape.corners) {
            ball.radius = std::max(ball.radius, glm::length(corner - ball.centre));
        }
        const double thickest = std::max(shape.base_radius, shape.tip_radius);
        const double thinnest = std::min(shape.base_radius, shape.tip_radius);
        // The surface is moved outwards by up to kChord times the radius. With a ground, cells near
        // the ground are smaller.
        ball.radius += (1.0 + kChord) * thickest;
        ball.cell = solid.cell * thinnest * (solid.ground ? kBaseCells : 1.0);
        balls.push_back(ball);
    }
    return balls;
}

/// Distance of a point from the surface of the solid.
struct Probe {
    double distance = std::numeric_limits<double>::max(); // m, negative within the solid
    std::uint32_t shape = 0;                              // number of the nearest shape
    bool on_ground = false;                               // the flat base is nearer than all shapes
};

std::uint64_t key_of(const Node& a, const Node& b) {
    const Node sum = a + b; // identifies the edge: no two edges have the same middle
    constexpr unsigned kBits = 21;
    return (static_cast<std::uint64_t>(sum.x) << (2 * kBits)) |
           (static_cast<std::uint64_t>(sum.y) << kBits) | static_cast<std::uint64_t>(sum.z);
}

/// Whether the corners b, c, d are counter-clockwise, seen from the side away from corner a.
bool is_positive(const std::array<Node, 4>& nodes) {
    const glm::i64vec3 a(nodes[0]);
    const glm::i64vec3 b = glm::i64vec3(nodes[1]) - a;
    const glm::i64vec3 c = glm::i64vec3(nodes[2]) - a;
    const glm::i64vec3 d = glm::i64vec3(nodes[3]) - a;
    return b.x * (c.y * d.z - c.z * d.y) + b.y * (c.z * d.x - c.x * d.z) +
               b.z * (c.x * d.y - c.y * d.x) >
           0;
}

/// The surface within one tetrahedron and its descendants.
class Cutter {
public:
    Cutter(const Solid& solid,
           const std::vector<Ball>& balls,
           const Grid& grid,
           std::atomic<std::uint64_t>& bytes_left)
        : solid_(solid), balls_(balls), grid_(grid), bytes_left_(bytes_left) {}

    using Visit = std::function<void(const Tetrahedron&, std::span<const std::uint32_t>)>;

    /// Visits the tetrahedra that the surface may pass through: those of generation `end`, and
    /// those of earlier generations that are small enough. `near`: the shapes that determine the
    /// distance and the size of cells within `tetrahedron`.
    void visit_leaves(const Tetrahedron& tetrahedron,
                      std::span<const std::uint32_t> near,
                      int end,
                      const Visit& visit) {
        near_.assign(near.begin(), near.end());
        descend(tetrahedron, 0, end, visit);
    }
    void cut_leaves(const Tetrahedron& tetrahedron, std::span<const std::uint32_t> near) {
        visit_leaves(tetrahedron, near, kMaxGeneration + 1,
                     [this](const Tetrahedron& leaf, std::span<const std::uint32_t> shapes) {
                         cut(leaf, shapes);
                     });
    }

    /// The distance of a point from the union of the shapes `near`, cut off below the ground.
    [[nodiscard]] Probe probe(const glm::dvec3& point, std::span<const std::uint32_t> near) const {
        Probe best;
        for (const std::uint32_t number : near) {
            const double distance = measure(solid_.shapes[number], point).distance;
            if (distance < best.distance) {
                best = {distance, number, false};
            }
        }
        const double whole = above_ground(best.distance, point);
        best.on_ground = whole > best.distance;
        best.distance = whole;
        return best;
    }

    [[nodiscard]] SolidSurface take_surface() { return std::move(surface_); }
    [[nodiscard]] std::vector<std::uint64_t> take_keys() { return std::move(keys_); }
    [[nodiscard]] bool overflow() const { return overflow_; }

private:
    struct Size {
        double distance = 0.0; // m, from the surface of a shape; negative within it
        double size = 0.0;     // m, size of cells
    };

    [[nodiscard]] Size measure(const SolidShape& shape, const glm::dvec3& point) const {
        const ShapeProbe at = lsys::probe(shape, point);
        double cell = solid_.cell * at.radius;
        double base_height = 0.0; // height above the flat base if that limits `cell`, else 0
        if (solid_.ground) {
            const double height = std::abs(point.y - *solid_.ground);
            const double at_base = kBaseCells * cell + kGrowth * height;
            base_height = at_base < cell ? height : 0.0;
            cell = std::min(cell, at_base);
        }
        const double distance =
            at.distance - (shape.is_triangle ? 0.0 : kChord * cell * cell / at.radius);
        // Near the ground, `cell` already includes the growth over `base_height`.
        return {distance, cell + kGrowth * std::max(std::abs(distance) - base_height, 0.0)};
    }

    [[nodiscard]] double above_ground(double distance, const glm::dvec3& point) const {
        return solid_.ground ? std::max(distance, *solid_.ground - point.y) : distance;
    }

    /// Visits a tetrahedron whose shapes are near_[first] to the end of near_.
    void descend(const Tetrahedron& tetrahedron,
                 std::size_t first,
                 int end, // NOLINT(bugprone-easily-swappable-parameters)
                 const Visit& visit) {
        const std::size_t last = near_.size();
        if (overflow_) {
            return;
        }
        if (tetrahedron.generation == end) {
            visit(tetrahedron, std::span(near_).subspan(first));
            return;
        }
        const Node& from = tetrahedron.nodes[0];
        const Node& to = tetrahedron.nodes[static_cast<std::size_t>(tetrahedron.tag)];
        const glm::dvec3 middle = grid_.middle(from, to);
        double reach = 0.0; // max distance of a corner from `middle`
        for (const Node& node : tetrahedron.nodes) {
            reach = std::max(reach, glm::length(grid_.position(node) - middle));
        }
        // About six tetrahedra share this edge and are bisected at its middle. Most of them need
        // only the distance at the middle, not the shapes near the middle.
        const std::uint64_t key = key_of(from, to);
        const auto known = middles_.find(key);
        const bool is_new = known == middles_.end();
        const Size at_middle = is_new ? measure_all(first, last, middle) : known->second;
        if (is_new) {
            if (middles_.size() >= kMaxMiddles) {
                middles_.clear();
            }
            middles_.emplace(key, at_middle);
        }
        const double distance = above_ground(at_middle.distance, middle);
        if (std::abs(distance) > kLipschitz * reach) {
            return;
        }
        const double size = at_middle.size;
        const bool is_leaf =
            tetrahedron.generation == kMaxGeneration || grid_.step(tetrahedron.generation) <= size;
        if (is_leaf) {
            visit(tetrahedron, std::span(near_).subspan(first));
            return;
        }
        if (!is_new) {
            measure_all(first, last, middle);
        }
        const double next = grid_.step(tetrahedron.generation + 1);
        for (std::size_t i = first; i < last; ++i) {
            const Size& at = probes_[i - first];
            // A shape matters for the size of cells only if its cells may be the smallest somewhere
            // in this tetrahedron. So of a plant's many leaves only the nearest ones matter.
            const bool may_be_nearest =
                at.distance <= at_middle.distance + 2.0 * kLipschitz * reach;
            const bool may_be_smallest = at.size <= size + 2.0 * kMaxGrowth * reach;
            if (may_be_nearest || (may_be_smallest && at.size - kMaxGrowth * reach < next)) {
                near_.push_back(near_[i]);
            }
        }
        const Node node = (from + to) / 2;
        descend(half_of(tetrahedron, node, distance, true), last, end, visit);
        descend(half_of(tetrahedron, node, distance, false), last, end, visit);
        near_.resize(last);
    }

    /// The min distance and the min size of cells at a point, over the shapes near_[first, last).
    /// Sets probes_ to the values of each shape; for shapes too far away to have the min, to lower
    /// bounds of the values.
    Size measure_all(std::size_t first, std::size_t last, const glm::dvec3& point) {
        constexpr double kFar = std::numeric_limits<double>::max();
        probes_.resize(last - first);
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < probes_.size(); ++i) {
            const Ball& ball = balls_[near_[first + i]];
            const double distance = glm::length(point - ball.centre) - ball.radius;
            probes_[i] = {distance, ball.cell + kGrowth * std::max(distance, 0.0)};
            nearest = distance < probes_[nearest].distance ? i : nearest;
        }
        Size all{kFar, kFar};
        const auto measure_one = [&](std::size_t i) {
            probes_[i] = measure(solid_.shapes[near_[first + i]], point);
            all.distance = std::min(all.distance, probes_[i].distance);
            all.size = std::min(all.size, probes_[i].size);
        };
        if (!probes_.empty()) {
            measure_one(nearest);
        }
        for (std::size_t i = 0; i < probes_.size(); ++i) {
            if (i != nearest &&
                (probes_[i].distance < all.distance || probes_[i].size < all.size)) {
                measure_one(i);
            }
        }
        return all;
    }

    static Tetrahedron
    half_of(const Tetrahedron& whole, const Node& middle, double distance, bool low) {
        Tetrahedron half = whole;
        const auto tag = static_cast<std::size_t>(whole.tag);
        for (std::size_t i = 0; i < tag && !low; ++i) {
            half.nodes[i] = whole.nodes[i + 1];
            half.distances[i] = whole.distances[i + 1];
        }
        half.nodes[tag] = middle;
        half.distances[tag] = distance;
        half.tag = whole.tag > 1 ? whole.tag - 1 : 3;
        half.generation = whole.generation + 1;
        return half;
    }

    /// Finds the shapes that may be nearest to a point within `reach` (m) of `middle`.
    void keep_nearest(const glm::dvec3& middle, double reach, std::span<const std::uint32_t> near) {
        probes_.resize(near.size());
        double nearest = std::numeric_limits<double>::max();
        for (std::size_t i = 0; i < near.size(); ++i) {
            probes_[i] = measure(solid_.shapes[near[i]], middle);
            nearest = std::min(nearest, probes_[i].distance);
        }
        nearest_.clear();
        for (std::size_t i = 0; i < near.size(); ++i) {
            if (probes_[i].distance <= nearest + 2.0 * kLipschitz * reach) {
                nearest_.push_back(near[i]);
            }
        }
    }

    /// The vertex where the surface crosses the edge from a node within the solid to a node
    /// outside.
    std::uint32_t vertex(const Tetrahedron& tetrahedron,
                         std::size_t within,
                         std::size_t outside,
                         std::span<const std::uint32_t> near) {
        const Node& a = tetrahedron.nodes[within];
        const Node& b = tetrahedron.nodes[outside];
        const std::uint64_t key = key_of(a, b);
        const auto [found, is_new] =
            vertex_of_.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
        if (!is_new) {
            return found->second;
        }
        const glm::dvec3 from = grid_.position(a);
        const glm::dvec3 to = grid_.position(b);
        double low = 0.0;
        double high = 1.0;
        double at_low = tetrahedron.distances[within];
        double at_high = tetrahedron.distances[outside];
        const double length = glm::length(to - from);
        keep_nearest(0.5 * (from + to), 0.5 * length, near);
        // Regula falsi; the weight of an end that stays twice is halved (Dowell and Jarratt 1971).
        constexpr int kRounds = 8;
        double t = 0.5;
        int side = 0;
        for (int round = 0; round < kRounds; ++round) {
            t = low + (high - low) * (at_low / (at_low - at_high));
            const double at = probe(from + t * (to - from), nearest_).distance;
            if (std::abs(at) <= kExact * length) {
                break;
            }
            if (at < 0.0) {
                low = t;
                at_low = at;
                at_high *= side < 0 ? 0.5 : 1.0;
                side = -1;
            } else {
                high = t;
                at_high = at;
                at_low *= side > 0 ? 0.5 : 1.0;
                side = 1;
            }
        }
        t = std::clamp(t, kEdgeMargin, 1.0 - kEdgeMargin);
        SolidVertex made;
        made.position = from + t * (to - from);
        const Probe at = probe(made.position, nearest_);
        made.shape = at.shape;
        made.on_ground = at.on_ground;
        if (made.on_ground) {
            made.position.y = *solid_.ground;
        }
        surface_.vertices.push_back(made);
        keys_.push_back(key);
        return found->second;
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool turned) {
        surface_.triangles.push_back(turned ? std::array{a, c, b} : std::array{a, b, c});
    }

    /// Adds the triangles that separate the nodes within the solid from the nodes outside.
    void cut(const Tetrahedron& tetrahedron, std::span<const std::uint32_t> near) {
        // Puts the nodes within the solid first.
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        const auto is_within = [&](std::size_t i) { return tetrahedron.distances[i] < 0.0; };
        const auto outside = std::stable_partition(order.begin(), order.end(), is_within);
        const auto count = outside - order.begin();
        if (count == 0 || count == 4) {
            return;
        }
        std::array<Node, 4> nodes;
        std::transform(order.begin(), order.end(), nodes.begin(),
                       [&](std::size_t i) { return tetrahedron.nodes[i]; });
        const bool turned = !is_positive(nodes);
        const std::size_t before = keys_.size();
        const auto on = [&](std::size_t a, std::size_t b) {
            return vertex(tetrahedron, order[a], order[b], near);
        };
        if (count == 1) {
            const std::uint32_t first = on(0, 1);
            const std::uint32_t second = on(0, 2);
            add_triangle(first, second, on(0, 3), turned);
        } else if (count == 3) {
            const std::uint32_t first = on(0, 3);
            const std::uint32_t second = on(1, 3);
            add_triangle(first, second, on(2, 3), turned);
        } else {
            const std::uint32_t first = on(0, 2);
            const std::uint32_t second = on(0, 3);
            const std::uint32_t third = on(1, 3);
            add_quad({first, second, third, on(1, 2)}, turned);
        }
        take((keys_.size() - before) * kVertexBytes + (count == 2 ? 2 : 1) * kTriangleBytes);
    }

    /// Divides a quad along its shorter diagonal.
    void add_quad(const std::array<std::uint32_t, 4>& corners, bool turned) {
        const auto square = [&](std::size_t a, std::size_t b) {
            const glm::dvec3 line =
                surface_.vertices[corners[a]].position - surface_.vertices[corners[b]].position;
            return glm::dot(line, line);
        };
        const std::size_t first = square(0, 2) <= square(1, 3) ? 0 : 1;
        add_triangle(corners[first], corners[first + 1], corners[first + 2], turned);
        add_triangle(corners[first], corners[first + 2], corners[(first + 3) % 4], turned);
    }

    /// Takes `bytes` from bytes_left_; sets overflow_ if they are not left.
    void take(std::uint64_t bytes) {
        std::uint64_t left = bytes_left_.load();
        while (left >= bytes && !bytes_left_.compare_exchange_weak(left, left - bytes)) {
        }
        overflow_ = overflow_ || left < bytes;
    }

    // Bytes per vertex and per triangle, with the table of edges, and with both copies that exist
    // while pieces are joined.
    static constexpr std::uint64_t kVertexBytes = 2 * sizeof(SolidVertex) + 96;
    static constexpr std::uint64_t kTriangleBytes = 24;

    const Solid& solid_;
    const std::vector<Ball>& balls_; // a ball around each shape
    const Grid& grid_;
    std::atomic<std::uint64_t>& bytes_left_;
    bool overflow_ = false; // more bytes were needed than are left
    std::vector<std::uint32_t>
        near_; // numbers of shapes, stacked: of an ancestor, then of its descendants
    std::vector<Size> probes_;           // values at one point for some shapes, see measure_all()
    std::vector<std::uint32_t> nearest_; // numbers of shapes that may be nearest on an edge
    static constexpr std::size_t kMaxMiddles = 1 << 20;
    std::unordered_map<std::uint64_t, Size> middles_;            // by key of the edge
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_; // by key of the edge
    std::vector<std::uint64_t> keys_; // by vertex: key of the edge on which it lies
    SolidSurface surface_;
};

/// A tetrahedron with the shapes that determine distance and size of cells in it.
struct Piece {
    Tetrahedron tetrahedron;
    std::vector<std::uint32_t> near; // numbers of these shapes
    SolidSurface surface;
    std::vector<std::uint64_t> keys; // by vertex of `surface`: key of the edge on which it lies
};

/// Divides the root cube into six tetrahedra around its diagonal, and bisects these into pieces.
std::vector<Piece> make_pieces(const Solid& solid,
                               const std::vector<Ball>& balls,
                               const Grid& grid,
                               std::atomic<std::uint64_t>& bytes_left) {
    std::vector<std::uint32_t> all(solid.shapes.size());
    std::iota(all.begin(), all.end(), 0U);
    Cutter cutter(solid, balls, grid, bytes_left);
    std::vector<Piece> pieces;
    std::array<int, 3> axes{0, 1, 2};
    do {
        Tetrahedron root;
        for (std::size_t i = 0; i < 4; ++i) {
            if (i > 0) {
                root.nodes[i] = root.nodes[i - 1];
                root.nodes[i][axes[i - 1]] = kUnits;
            }
            root.distances[i] = cutter.probe(grid.position(root.nodes[i]), all).distance;
        }
        cutter.visit_leaves(root, all, kPieceGeneration,
                            [&](const Tetrahedron& leaf, std::span<const std::uint32_t> near) {
                                pieces.push_back({leaf, {near.begin(), near.end()}, {}, {}});
                            });
    } while (std::next_permutation(axes.begin(), axes.end()));
    return pieces;
}

/// Joins the surfaces of pieces along their common vertices.
SolidSurface join(std::vector<Piece>& pieces) {
    SolidSurface all;
    std::unordered_map<std::uint64_t, std::uint32_t> vertex_of;
    std::vector<std::uint32_t> number;
    for (Piece& piece : pieces) {
        number.clear();
        for (std::size_t i = 0; i < piece.keys.size(); ++i) {
            const auto [found, is_new] = vertex_of.try_emplace(
                piece.keys[i], static_cast<std::uint32_t>(all.vertices.size()));
            if (is_new) {
                all.vertices.push_back(piece.surface.vertices[i]);
            }
            number.push_back(found->second);
        }
        for (const auto& [a, b, c] : piece.surface.triangles) {
            all.triangles.push_back({number[a], number[b], number[c]});
        }
        piece = {};
    }
    return all;
}

} // namespace

std::optional<SolidSurface>
extract_surface(const Solid& solid, std::uint64_t max_bytes, std::uint32_t threads) {
    if (solid.shapes.empty()) {
        return SolidSurface{};
    }
    const Grid grid = make_grid(solid);
    const std::vector<Ball> balls = make_balls(solid);
    std::atomic<std::uint64_t> bytes_left{max_bytes};
    std::atomic<bool> overflow{false};
    std::vector<Piece> pieces = make_pieces(solid, balls, grid, bytes_left);
    Workers workers(threads);
    workers.for_each(pieces.size(), [&](std::uint64_t i) {
        Piece& piece = pieces[i];
        if (overflow) {
            return;
        }
        Cutter cutter(solid, balls, grid, bytes_left);
        cutter.cut_leaves(piece.tetrahedron, piece.near);
        piece.surface = cutter.take_surface();
        piece.keys = cutter.take_keys();
        if (cutter.overflow()) {
            overflow = true;
        }
    });
    if (overflow) {
        return std::nullopt;
    }
    return join(pieces);
}

} // namespace lsys
