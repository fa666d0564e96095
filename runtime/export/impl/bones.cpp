// SPDX-License-Identifier: MIT
#include "runtime/export/impl/bones.h"

#include "grammar/base/contract.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lsys {

namespace {

// A piece is not cut further if its positions are off by at most this fraction of the plant's
// size.
constexpr double kPlaceTolerance = 1e-5;
// Max error of positions due to an omitted key, relative to the max displacement of a tip in the
// clip.
constexpr double kKeyTolerance = 2e-3;
constexpr double kMaxKeyAngle = 0.01;     // rad, max error of a rotation due to an omitted key
constexpr std::uint32_t kMaxSamples = 16; // frames in which errors are measured
constexpr std::uint32_t kNoBone = ~std::uint32_t{0};
constexpr int kFitRounds = 4; // Gauss-Newton steps that fit a rotation

/// A rotation and a place: maps x to place + turn * x.
struct Rigid {
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 place{0.0};

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& point) const {
        return place + turn * point;
    }
};

Rigid place_of(const SegmentPlace& place) {
    return {glm::normalize(glm::dquat(place.frame)), glm::dvec3(place.base)};
}

/// The rigid motion that takes `from` to `to`, in world coordinates.
Rigid motion(const Rigid& from, const Rigid& to) {
    const glm::dquat turn = to.turn * glm::conjugate(from.turn);
    return {turn, to.place - turn * from.place};
}

/// The tree of segments. Each vector is by segment; kNoSegment: there is none.
struct Tree {
    std::vector<std::uint32_t> parents;
    std::vector<std::uint32_t> first_child;
    std::vector<std::uint32_t> next_sibling;
    std::vector<std::uint32_t> thickest; // child that continues the segment's axis
    std::vector<std::uint32_t> sizes;    // segments in the subtree of each, itself included
};

Tree tree_of(const Skeleton& plant) {
    const auto count = static_cast<std::uint32_t>(plant.segments.size());
    Tree tree;
    tree.parents.assign(count, kNoSegment);
    tree.first_child = tree.next_sibling = tree.thickest = tree.parents;
    tree.sizes.assign(count, 1);
    for (std::uint32_t i = count; i-- > 0;) { // backwards, which lists children in ascending order
        const std::uint32_t parent = plant.segments[i].parent;
        if (parent >= i) {
            continue;
        }
        tree.parents[i] = parent;
        tree.next_sibling[i] = tree.first_child[parent];
        tree.first_child[parent] = i;
        tree.sizes[parent] += tree.sizes[i];
        // Among equally thick children the one in fewer brackets continues the segment.
        std::uint32_t& thickest = tree.thickest[parent];
        const Segment& child = plant.segments[i];
        if (thickest == kNoSegment || child.base_radius > plant.segments[thickest].base_radius ||
            (child.base_radius == plant.segments[thickest].base_radius &&
             child.order <= plant.segments[thickest].order)) {
            thickest = i;
        }
    }
    return tree;
}

/// Cuts the tree into pieces by the motion of its segments.
class Cutter {
public:
    Cutter(const Skeleton& plant, const Tree& tree, const PlantAnimation& animation)
        : plant_(plant), tree_(tree), owners_(plant.segments.size(), 0) {
        const std::uint32_t last = animation.frame_count - 1;
        const std::uint32_t count = std::min(last, kMaxSamples);
        for (std::uint32_t i = 1; i <= count; ++i) {
            samples_.push_back(
                animation.frame(static_cast<std::uint32_t>(std::uint64_t{last} * i / count)));
        }
        start_ = animation.frame(0);
    }

    /// The segments at which pieces begin, ascending. Cuts until each piece moves rigidly to within
    /// `tolerance` metres, or until there are `max_pieces`.
    std::vector<std::uint32_t> run(double tolerance, std::uint32_t max_pieces) {
        pieces_.push_back({kNoSegment, kNoSegment, 0.0});
        for (std::uint32_t i = 0; i < owners_.size(); ++i) {
            if (tree_.parents[i] == kNoSegment) {
                measure(i, 0);
            }
        }
        while (pieces_.size() < max_pieces) {
            const auto worst =
                std::max_element(pieces_.begin(), pieces_.end(),
                                 [](const Piece& a, const Piece& b) { return a.error < b.error; });
            if (!(worst->error > tolerance)) {
                break;
            }
            cut(static_cast<std::uint32_t>(worst - pieces_.begin()));
        }
        std::vector<std::uint32_t> roots;
        for (const Piece& piece : pieces_) {
            if (piece.root != kNoSegment) {
                roots.push_back(piece.root);
            }
        }
        std::sort(roots.begin(), roots.end());
        return roots;
    }

private:
    struct Piece {
        std::uint32_t root = kNoSegment;  // kNoSegment: the piece that stands still
        std::uint32_t worst = kNoSegment; // segment with the largest error
        double error = 0.0;               // m, of the tip of `worst`
    };

    [[nodiscard]] glm::dvec3 tip(std::uint32_t segment,
                                 std::span<const SegmentPlace> places) const {
        const SegmentPlace& place = places[segment];
        return glm::dvec3(place.base + plant_.segments[segment].length * heading(place.frame));
    }

    /// Max distance, over the sampled frames, between the tip of `segment` and the place to which
    /// the motion of `root` takes this tip.
    [[nodiscard]] double error(std::uint32_t root, std::uint32_t segment) const {
        const glm::dvec3 at_start = tip(segment, start_);
        double max_error = 0.0;
        for (const std::span<const SegmentPlace> sample : samples_) {
            const glm::dvec3 taken = root == kNoSegment ? at_start
                                                        : motion(place_of(start_[root]),
                                                                 place_of(sample[root]))(at_start);
            const glm::dvec3 off = taken - tip(segment, sample);
            max_error = std::max(max_error, glm::dot(off, off));
        }
        return std::sqrt(max_error);
    }

    /// Moves `top` and its descendants in the same piece to `piece`, and measures their errors.
    void measure(std::uint32_t top, std::uint32_t piece) {
        const std::uint32_t before = owners_[top];
        std::vector<Rigid> moves;
        const std::uint32_t root = pieces_[piece].root;
        for (const std::span<const SegmentPlace> sample : samples_) {
            moves.push_back(root == kNoSegment
                                ? Rigid{}
                                : motion(place_of(start_[root]), place_of(sample[root])));
        }
        open_.assign(1, top);
        while (!open_.empty()) {
            const std::uint32_t segment = open_.back();
            open_.pop_back();
            owners_[segment] = piece;
            const glm::dvec3 at_start = tip(segment, start_);
            double max_error = 0.0;
            for (std::size_t i = 0; i < moves.size(); ++i) {
                const glm::dvec3 off = moves[i](at_start) - tip(segment, samples_[i]);
                max_error = std::max(max_error, glm::dot(off, off));
            }
            max_error = std::sqrt(max_error);
            if (max_error > pieces_[piece].error) {
                pieces_[piece].error = max_error;
                pieces_[piece].worst = segment;
            }
            for (std::uint32_t child = tree_.first_child[segment]; child != kNoSegment;
                 child = tree_.next_sibling[child]) {
                if (owners_[child] == before) {
                    open_.push_back(child);
                }
            }
        }
    }

    /// Cuts a piece in two on the path from its root to its worst segment, at the place where the
    /// errors of both parts are about equal.
    void cut(std::uint32_t piece) {
        const std::uint32_t root = pieces_[piece].root;
        const std::uint32_t worst = pieces_[piece].worst;
        std::vector<std::uint32_t> way; // path from the worst segment to the root
        for (std::uint32_t at = worst; at != kNoSegment && at != root; at = tree_.parents[at]) {
            way.push_back(at);
        }
        if (way.empty()) { // the worst segment is the root: a rounding error, far from the origin
            pieces_[piece].error = 0.0;
            return;
        }
        // A cut nearer to the root decreases the error of the part on the side of the root and
        // increases the error of the part beyond the cut.
        std::size_t low = 0;
        std::size_t high = way.size() - 1;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            const std::uint32_t parent = tree_.parents[way[middle]];
            const double before = parent == kNoSegment ? 0.0 : error(root, parent);
            if (error(way[middle], worst) < before) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        const std::uint32_t top = way[low];
        const auto new_piece = static_cast<std::uint32_t>(pieces_.size());
        pieces_.push_back({top, kNoSegment, 0.0});
        measure(top, new_piece);
        remeasure(piece, root);
    }

    /// Finds the worst segment of a piece from which a part was cut off.
    void remeasure(std::uint32_t piece, std::uint32_t root) {
        pieces_[piece].error = 0.0;
        pieces_[piece].worst = kNoSegment;
        if (root != kNoSegment) {
            measure(root, piece);
            return;
        }
        for (std::uint32_t i = 0; i < owners_.size(); ++i) {
            if (tree_.parents[i] == kNoSegment && owners_[i] == piece) {
                measure(i, piece);
            }
        }
    }

    const Skeleton& plant_;
    const Tree& tree_;
    std::span<const SegmentPlace> start_;                // the first frame
    std::vector<std::span<const SegmentPlace>> samples_; // frames in which errors are measured
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> owners_; // piece of each segment
    std::vector<std::uint32_t> open_;   // segments that measure() has still to visit
};

/// A point of a piece, for fitting the rotation of the joint of the piece.
struct FitPoint {
    std::uint32_t segment = 0;
    bool is_base = false; // the point is the base of a segment, else its tip
    double weight = 1.0;
};

/// The rotation that takes `arms` nearest to `targets` by weighted least squares, iterated from
/// `start`. `arms` and `targets` are relative to the joint.
glm::dquat fitted(const glm::dquat& start,
                  std::span<const glm::dvec3> arms,
                  std::span<const glm::dvec3> targets,
                  std::span<const double> weights) {
    glm::dquat turn = start;
    for (int round = 0; round < kFitRounds; ++round) { // Gauss-Newton
        glm::dmat3 matrix(0.0);
        glm::dvec3 torque(0.0);
        for (std::size_t i = 0; i < arms.size(); ++i) {
            const glm::dvec3 arm = turn * arms[i];
            const double square = glm::dot(arm, arm);
            matrix += weights[i] * (glm::dmat3(square) - glm::outerProduct(arm, arm));
            torque += weights[i] * glm::cross(arm, targets[i] - arm);
        }
        // Damping: points on a line do not determine the twist about the line, so the twist stays
        // unchanged.
        const double trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
        if (!(trace > 0.0)) {
            break;
        }
        matrix += glm::dmat3(1e-4 * trace);
        const glm::dvec3 step = 0.5 * (glm::inverse(matrix) * torque);
        turn = glm::normalize(glm::dquat(1.0, step.x, step.y, step.z) * turn);
    }
    return turn;
}

/// Frames that need keys, so that interpolated rotations deviate by at most the angle whose half
/// has the sine `half_sine`. Empty: all rotations are within this angle of the first.
std::vector<std::uint32_t> keys_of(std::span<const glm::quat> rotations, double half_sine) {
    const auto is_near = [half_sine](const glm::dquat& a, const glm::dquat& b) {
        const glm::dquat turn = glm::conjugate(a) * b;
        return turn.x * turn.x + turn.y * turn.y + turn.z * turn.z <= half_sine * half_sine;
    };
    const auto count = static_cast<std::uint32_t>(rotations.size());
    const glm::dquat first(rotations.front());
    if (std::all_of(rotations.begin(), rotations.end(),
                    [&](const glm::quat& each) { return is_near(first, glm::dquat(each)); })) {
        return {};
    }
    std::vector<std::uint32_t> keys{0};
    while (keys.back() + 1 < count) {
        const std::uint32_t from = keys.back();
        std::uint32_t to = from + 1;
        const auto spans = [&](std::uint32_t end) {
            for (std::uint32_t i = from + 1; i < end; ++i) {
                const double part = static_cast<double>(i - from) / static_cast<double>(end - from);
                const glm::dquat between = glm::normalize(
                    (1.0 - part) * glm::dquat(rotations[from]) + part * glm::dquat(rotations[end]));
                if (!is_near(between, glm::dquat(rotations[i]))) {
                    return false;
                }
            }
            return true;
        };
        while (to + 1 < count && spans(to + 1)) {
            ++to;
        }
        keys.push_back(to);
    }
    return keys;
}

/// Computes the joints and weights of pieces.
class Builder {
public:
    Builder(const Skeleton& plant, const Tree& tree, const PlantAnimation& animation)
        : plant_(plant), tree_(tree), animation_(animation) {
        for (std::uint32_t frame = 1; frame < animation.frame_count; ++frame) {
            for (std::uint32_t i = 0; i < animation.segment_count; ++i) {
                const FitPoint end{i, false, 1.0};
                max_displacement_ =
                    std::max(max_displacement_, glm::length(place(end, frame) - place(end, 0)));
            }
        }
    }

    Bones run(std::span<const std::uint32_t> roots) {
        bones_.plant = &plant_;
        make_joints(roots);
        for (std::uint32_t joint = 1; joint < bones_.joints.size(); ++joint) {
            fit(joint);
        }
        make_weights();
        return std::move(bones_);
    }

private:
    void make_joints(std::span<const std::uint32_t> roots) {
        const std::size_t count = plant_.segments.size();
        std::vector<std::uint32_t> joint_at(count, 0);
        bones_.joints.resize(roots.size() + 1);
        for (std::size_t i = 0; i < roots.size(); ++i) {
            joint_at[roots[i]] = static_cast<std::uint32_t>(i + 1);
        }
        owners_.assign(count, 0);
        points_.resize(bones_.joints.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t parent = tree_.parents[i];
            const std::uint32_t before = parent == kNoSegment ? 0 : owners_[parent];
            const std::uint32_t joint = joint_at[i];
            owners_[i] = joint != 0 ? joint : before;
            if (joint != 0) {
                const Rigid start = place_of(animation_.frame(0)[i]);
                Bone& bone = bones_.joints[joint];
                bone.segment = i;
                bone.parent = before;
                bone.place = start.place;
                bone.frame = start.turn;
                points_[before].push_back({i, true, static_cast<double>(tree_.sizes[i])});
            }
            points_[owners_[i]].push_back({i, false, 1.0});
        }
        for (Bone& bone : bones_.joints) {
            const Bone& parent = bones_.joints[bone.parent];
            bone.translation =
                glm::vec3(glm::conjugate(parent.frame) * (bone.place - parent.place));
        }
        moves_.assign(bones_.joints.size() * animation_.frame_count, Rigid{});
    }

    [[nodiscard]] glm::dvec3 place(const FitPoint& point, std::uint32_t frame) const {
        const SegmentPlace& at = animation_.frame(frame)[point.segment];
        const float length = point.is_base ? 0.0F : plant_.segments[point.segment].length;
        return glm::dvec3(at.base + length * heading(at.frame));
    }

    /// Motion of a joint since the first frame.
    Rigid& move(std::uint32_t joint, std::uint32_t frame) {
        return moves_[std::size_t{joint} * animation_.frame_count + frame];
    }

    /// Rotates a joint in each frame so that the points of its piece and its child joints come
    /// nearest to their places in that frame.
    void fit(std::uint32_t joint) {
        Bone& bone = bones_.joints[joint];
        const std::vector<FitPoint>& points = points_[joint];
        std::vector<glm::dvec3> arms;
        std::vector<double> weights;
        double reach = 0.0;
        for (const FitPoint& point : points) {
            arms.push_back(place(point, 0) - bone.place);
            weights.push_back(point.weight);
            reach = std::max(reach, glm::length(arms.back()));
        }
        std::vector<glm::dvec3> targets(arms.size());
        const Bone& parent = bones_.joints[bone.parent];
        for (std::uint32_t frame = 0; frame < animation_.frame_count; ++frame) {
            const Rigid& parent_move = move(bone.parent, frame);
            const glm::dvec3 centre = parent_move(bone.place);
            for (std::size_t i = 0; i < points.size(); ++i) {
                targets[i] = place(points[i], frame) - centre;
            }
            const glm::dquat turn = frame == 0
                                        ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                        : fitted(mean_turn(joint, frame), arms, targets, weights);
            move(joint, frame) = {turn, centre - turn * bone.place};
            const glm::quat local(glm::normalize(glm::conjugate(parent_move.turn * parent.frame) *
                                                 (turn * bone.frame)));
            const bool other_side = frame > 0 && glm::dot(bone.rotations.back(), local) < 0.0F;
            bone.rotations.push_back(other_side ? -local : local);
        }
        const double angle =
            std::min(kKeyTolerance * max_displacement_ / std::max(reach, 1e-30), kMaxKeyAngle);
        bone.keys = keys_of(bone.rotations, 0.5 * angle);
    }

    /// Mean rotation of the segments of a piece since the first frame, weighted by length.
    [[nodiscard]] glm::dquat mean_turn(std::uint32_t joint, std::uint32_t frame) const {
        glm::dquat sum(0.0, 0.0, 0.0, 0.0);
        for (const FitPoint& point : points_[joint]) {
            if (!point.is_base) {
                const glm::dquat turn =
                    place_of(animation_.frame(frame)[point.segment]).turn *
                    glm::conjugate(place_of(animation_.frame(0)[point.segment]).turn);
                const double length = static_cast<double>(plant_.segments[point.segment].length);
                sum = sum + (glm::dot(sum, turn) < 0.0 ? -length : length) * turn;
            }
        }
        return glm::dot(sum, sum) > 0.0 ? glm::normalize(sum) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    }

    /// Joints and their weights.
    using Terms = std::vector<std::pair<std::uint32_t, double>>;

    static void add(Terms& terms, std::uint32_t joint, double weight) {
        const auto found = std::find_if(terms.begin(), terms.end(),
                                        [joint](const auto& term) { return term.first == joint; });
        if (found != terms.end()) {
            found->second += weight;
        } else if (weight > 0.0) {
            terms.emplace_back(joint, weight);
        }
    }
    static void add(Terms& terms, const BoneWeights& weights, double factor) {
        for (std::size_t i = 0; i < weights.joints.size(); ++i) {
            add(terms, weights.joints[i], factor * static_cast<double>(weights.weights[i]));
        }
    }

public:
    /// The four greatest weights, scaled to add up to 1.
    static BoneWeights collected(Terms& terms) {
        std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) {
            return a.second > b.second || (a.second == b.second && a.first < b.first);
        });
        terms.resize(std::min(terms.size(), std::size_t{4}));
        double sum = 0.0;
        for (const auto& term : terms) {
            sum += term.second;
        }
        BoneWeights weights;
        for (std::size_t i = 0; i < terms.size(); ++i) {
            weights.joints[i] = static_cast<std::uint16_t>(terms[i].first);
            weights.weights[i] = static_cast<float>(terms[i].second / sum);
        }
        return weights;
    }
    static BoneWeights mixed(std::span<const std::pair<BoneWeights, double>> parts) {
        Terms terms;
        for (const auto& [weights, factor] : parts) {
            add(terms, weights, factor);
        }
        return collected(terms);
    }

private:
    /// The axis of a piece: its first segment, then always the thickest child.
    struct Axis {
        double length = 0.0;
        std::uint32_t next = kNoBone;     // joint of the next piece along the axis
        std::uint32_t previous = kNoBone; // joint of the previous piece along the axis
    };

    void make_weights() {
        const std::size_t count = plant_.segments.size();
        std::vector<Axis> axes(bones_.joints.size());
        std::vector<double> along(count, -1.0); // m from the joint to the base; -1: not on the axis
        for (std::uint32_t joint = 1; joint < axes.size(); ++joint) {
            Axis& axis = axes[joint];
            for (std::uint32_t at = bones_.joints[joint].segment; at != kNoSegment;
                 at = tree_.thickest[at]) {
                if (owners_[at] != joint) {
                    axis.next = owners_[at];
                    axes[axis.next].previous = joint;
                    break;
                }
                along[at] = axis.length;
                axis.length += static_cast<double>(plant_.segments[at].length);
            }
        }
        bones_.segments.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t joint = owners_[i];
            const std::uint32_t parent = tree_.parents[i];
            const BoneWeights at_parent =
                parent == kNoSegment ? BoneWeights{{0}, {1.0F}} : bones_.segments[parent][1];
            if (joint == 0 || along[i] < 0.0) { // like its parent's tip: still, or beside the axis
                bones_.segments[i] = {at_parent, at_parent};
                continue;
            }
            const double length = static_cast<double>(plant_.segments[i].length);
            const std::uint32_t first = bones_.joints[joint].segment;
            const std::uint32_t from = tree_.parents[first];
            const BoneWeights root =
                from == kNoSegment ? BoneWeights{{0}, {1.0F}} : bones_.segments[from][1];
            bones_.segments[i] = {weights_on(axes, joint, along[i], root),
                                  weights_on(axes, joint, along[i] + length, root)};
        }
    }

    /// Weights at `along` metres from the start of the axis of a piece. `root`: weights of the
    /// point of the parent piece where the axis starts.
    static BoneWeights weights_on(std::span<const Axis> axes,
                                  std::uint32_t joint,
                                  double along,
                                  const BoneWeights& root) {
        const Axis& axis = axes[joint];
        const double half = 0.5 * axis.length;
        Terms terms;
        if (along < half && axis.previous != kNoBone) {
            const double before = 0.5 * axes[axis.previous].length;
            const double part = (before + along) / (before + half);
            add(terms, axis.previous, 1.0 - part);
            add(terms, joint, part);
        } else if (along < half) {
            const double part = along / half;
            add(terms, root, 1.0 - part);
            add(terms, joint, part);
        } else if (axis.next != kNoBone) {
            const double behind = 0.5 * axes[axis.next].length;
            const double part = (along - half) / std::max(half + behind, 1e-30);
            add(terms, joint, 1.0 - part);
            add(terms, axis.next, part);
        } else {
            add(terms, joint, 1.0);
        }
        return collected(terms);
    }

    const Skeleton& plant_;
    const Tree& tree_;
    const PlantAnimation& animation_;
    double max_displacement_ = 0.0; // m, max displacement of a tip in the clip
    Bones bones_;
    std::vector<std::uint32_t> owners_;         // joint of each segment
    std::vector<std::vector<FitPoint>> points_; // by joint: points of its piece and child joints
    std::vector<Rigid> moves_;                  // by joint, then by frame
};

double size_of(const Skeleton& plant) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (const Segment& segment : plant.segments) {
        const glm::vec3 end = segment.base + segment.length * heading(segment.frame);
        low = glm::min(low, glm::min(segment.base, end));
        high = glm::max(high, glm::max(segment.base, end));
    }
    const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
    return std::max({size.x, size.y, size.z, 0.0});
}

} // namespace

BoneWeights Bones::weights_of(const VertexSegments& bound, const glm::vec3& position) const {
    const auto at = [&](std::uint32_t number) {
        if (number >= segments.size()) {
            return BoneWeights{{0}, {1.0F}};
        }
        const Segment& segment = plant->segments[number];
        const double length = static_cast<double>(segment.length);
        const double along =
            glm::dot(glm::dvec3(position - segment.base), glm::dvec3(heading(segment.frame)));
        const double part = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
        const std::array<std::pair<BoneWeights, double>, 2> ends{
            {{segments[number][0], 1.0 - part}, {segments[number][1], part}}};
        return Builder::mixed(ends);
    };
    if (bound[0] == bound[1]) {
        return at(bound[0]);
    }
    const std::array<std::pair<BoneWeights, double>, 2> both{
        {{at(bound[0]), 0.5}, {at(bound[1]), 0.5}}};
    return Builder::mixed(both);
}

Bones make_bones(const Skeleton& plant, const PlantAnimation& animation, std::uint32_t max_joints) {
    LSYS_CHECK(animation.segment_count == plant.segments.size() && animation.frame_count > 0,
               animation.segment_count, plant.segments.size(), animation.frame_count);
    LSYS_CHECK(max_joints >= 2, max_joints);
    const Tree tree = tree_of(plant);
    const double size = size_of(plant);
    const std::vector<std::uint32_t> roots =
        Cutter(plant, tree, animation).run(kPlaceTolerance * size, max_joints);
    return Builder(plant, tree, animation).run(roots);
}

} // namespace lsys
