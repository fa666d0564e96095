// SPDX-License-Identifier: MIT
// Environments of kind Crowd: how many other places are near, and the direction away from them
// (Mech & Prusinkiewicz 1996, "Visual models of plants interacting with their environment").
//
// The arithmetic, in binary64: a place q is near p if (dx^2 + dy^2) + dz^2 < radius^2, with the
// differences d = p - q. Each coordinate of the sum of p - q over the near places is exact and rounded
// once; so it depends neither on the order of modules nor on threads, and it is 0 for places equal to
// p. The direction is this sum, each component divided by the length.
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/exact_total.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/impl/point_tree.h"

#include <algorithm>

namespace lsys {

namespace {

/// A tree of places with the exact total of the coordinates below each node, so that a node within
/// the radius is counted as a whole. If the radius covers all places, an answer takes one step.
class CrowdedPlaces {
public:
    CrowdedPlaces(std::span<const SensePlace> places, const EnvironmentContext& context)
        : range_(places), tree_(make_point_tree(places, context)),
          totals_(tree_.nodes.size() * node_words()) {
        for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
            std::uint64_t* const total = totals_.data() + i * node_words();
            std::fill_n(total, node_words(), 0);
            const SplitNode& items = tree_.nodes[i].items;
            if (items.second == 0) {
                for (std::uint32_t at = items.begin; at < items.end; ++at) {
                    add_place(total, tree_.points[at]);
                }
                continue;
            }
            add_node(total, i + 1);
            add_node(total, items.second);
        }
    }

    [[nodiscard]] std::size_t size() const { return tree_.points.size(); }
    /// The index in the word of place `at`, in the order of the tree.
    [[nodiscard]] std::uint32_t position(std::size_t at) const { return tree_.positions[at]; }

    /// The answer for place `at`, in the order of the tree.
    void answer(std::size_t at, double radius_squared, float* answer) const {
        const Vector3 place = tree_.points[at];
        Totals totals{};
        // The place is in its own sphere, where it adds nothing to the sum.
        const std::uint64_t others = total_within(place, radius_squared, totals) - 1;
        Vector3 direction{};
        if (others > 0) {
            Vector3 away{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                std::uint64_t* const total = totals.data() + axis * range_.words();
                range_.subtract(total, place[axis], others + 1);
                away[axis] = -range_.rounded(total);
            }
            direction = normalised(away);
        }
        write_answer(static_cast<double>(others), direction, answer);
    }

    /// Bytes of a CrowdedPlaces of `places` places whose totals have `words` words each.
    [[nodiscard]] static std::uint64_t bytes(std::size_t places, std::size_t words) {
        return std::uint64_t{places} * (kPointTreeBytes + 8 * words);
    }

private:
    using Totals = std::array<std::uint64_t, 3 * kMaxTotalWords>; // x, y, z, words() each

    [[nodiscard]] std::size_t node_words() const { return 3 * range_.words(); }

    void add_place(std::uint64_t* totals, const Vector3& place) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            range_.add(totals + axis * range_.words(), place[axis]);
        }
    }

    void add_node(std::uint64_t* totals, std::size_t node) const {
        const std::uint64_t* const other = totals_.data() + node * node_words();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            range_.add(totals + axis * range_.words(), other + axis * range_.words());
        }
    }

    /// Adds the coordinates of all places near `place` to `totals` and returns their number.
    std::uint64_t total_within(const Vector3& place, double radius_squared, Totals& totals) const {
        std::uint64_t count = 0;
        std::array<std::uint32_t, kMaxSplitDepth> open{};
        std::size_t open_count = 1;
        while (open_count > 0) {
            const std::uint32_t index = open[--open_count];
            const PointTree::Node& node = tree_.nodes[index];
            if (!(least_squared(node, place) < radius_squared)) {
                continue;
            }
            if (most_squared(node, place) < radius_squared) {
                add_node(totals.data(), index);
                count += node.items.end - node.items.begin;
            } else if (node.items.second == 0) {
                for (std::uint32_t at = node.items.begin; at < node.items.end; ++at) {
                    if (squared_length(minus(place, tree_.points[at])) < radius_squared) {
                        add_place(totals.data(), tree_.points[at]);
                        ++count;
                    }
                }
            } else {
                open[open_count++] = node.items.second;
                open[open_count++] = index + 1;
            }
        }
        return count;
    }

    TotalRange range_;
    PointTree tree_;
    LargeVector<std::uint64_t> totals_; // node_words() for each node
};

class CrowdEnvironment : public Environment {
public:
    CrowdEnvironment(const BytecodeEnvironment& declared, const EnvironmentContext& context)
        : declared_(declared), context_(context) {}

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        if (auto failure = check_places(word.places)) {
            return failure;
        }
        return answer_all(word.places, answers);
    }

private:
    std::optional<EnvironmentFailure> answer_all(std::span<const SensePlace> places,
                                                 std::vector<float>& answers) const {
        constexpr std::size_t kPiece = 1U << 10; // places of one piece of work
        const std::uint64_t bytes = CrowdedPlaces::bytes(places.size(), TotalRange(places).words());
        if (bytes > context_.max_bytes) {
            return beyond_memory(bytes);
        }
        const CrowdedPlaces crowd(places, context_);
        const double radius = static_cast<double>(declared_.radius);
        context_.workers->for_each((crowd.size() + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
            if (is_cancelled(context_.cancelled)) {
                return;
            }
            const std::size_t end = std::min<std::size_t>(crowd.size(), (piece + 1) * kPiece);
            for (std::size_t at = piece * kPiece; at < end; ++at) {
                crowd.answer(at, radius * radius,
                             answers.data() + std::size_t{crowd.position(at)} * 4);
            }
        });
        if (is_cancelled(context_.cancelled)) {
            return stopped(Stop::Cancelled);
        }
        return std::nullopt;
    }

    const BytecodeEnvironment& declared_;
    EnvironmentContext context_;
};

} // namespace

std::unique_ptr<Environment> make_crowd(const BytecodeEnvironment& declared,
                                        const EnvironmentContext& context) {
    return std::make_unique<CrowdEnvironment>(declared, context);
}

} // namespace lsys
