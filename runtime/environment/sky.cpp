// SPDX-License-Identifier: MIT
// Environments of kind Sky: the part of the light of an overcast sky that reaches a place through
// the leaf area above it (Beer-Lambert law).
#include "runtime/base/exact_functions.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/impl/leaf_area.h"
#include "runtime/environment/impl/sky_ray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lsys {

namespace {

constexpr std::size_t kPiece = 128; // places of one piece of work
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct SkyDirection {
    Vector3 direction{};
    double weight = 0.0; // sine of the elevation
};

/// Directions on a spiral with the golden angle, which are spread evenly over the hemisphere.
std::vector<SkyDirection> sky_directions(std::uint32_t count) {
    std::vector<SkyDirection> directions(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double sine = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double azimuth = static_cast<double>(i) * 180.0 * (3.0 - std::sqrt(5.0)); // degrees
        const ExactSineCosine turn = exact_sine_cosine_of_degrees(azimuth);
        directions[i] = {{cosine * turn.cosine, sine, cosine * turn.sine}, sine};
    }
    return directions;
}

class SkyEnvironment : public Environment {
public:
    SkyEnvironment(const BytecodeEnvironment& declared, const EnvironmentContext& context)
        : declared_(declared), context_(context), cell_(static_cast<double>(declared.cell)),
          directions_(sky_directions(declared.directions)) {
        for (const SkyDirection& direction : directions_) {
            weight_ += direction.weight;
        }
    }

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        if (word.places.empty()) {
            return std::nullopt;
        }
        return answer_places(word, answers);
    }

private:
    [[nodiscard]] std::optional<EnvironmentFailure> answer_places(const SensedWord& word,
                                                                  std::vector<float>& answers) {
        const std::uint64_t own_bytes = word.organs.size() * sizeof(CellArea);
        if (own_bytes > context_.max_bytes) {
            return limit(own_bytes);
        }
        std::vector<CellArea> areas;
        areas.reserve(word.organs.size());
        for (const SensedOrgan& organ : word.organs) {
            if (organ.area == 0.0) {
                continue;
            }
            const std::optional<CellIndex> cell = cell_of(organ.middle, cell_);
            if (!cell) {
                return beyond("an organ", 0);
            }
            areas.push_back({*cell, organ.area});
        }
        if (areas.empty() || declared_.extinction == 0.0F) {
            std::fill(answers.begin(), answers.end(), 1.0F);
            return std::nullopt;
        }
        const CellBox box = box_of(areas);
        const Extinction extinction{static_cast<double>(declared_.extinction),
                                    cell_ * cell_ * cell_};
        const std::uint64_t grid_bytes = own_bytes + LeafAreaGrid::bytes_for(box);
        const std::uint64_t table_bytes = own_bytes + LeafAreaTable::bytes_for(areas.size(), box);
        if (box.cells() <= kMinGrid + kGridCellsPerOrgan * areas.size() &&
            grid_bytes <= context_.max_bytes) {
            return trace(word.places, LeafAreaGrid(areas, box, extinction), box, answers);
        }
        if (table_bytes > context_.max_bytes) {
            return limit(table_bytes);
        }
        return trace(word.places, LeafAreaTable(areas, box, extinction), box, answers);
    }

    /// Up to kMinGrid + kGridCellsPerOrgan * organs cells a grid is faster than a hash table.
    static constexpr std::uint64_t kMinGrid = std::uint64_t{1} << 16;
    static constexpr std::uint64_t kGridCellsPerOrgan = 32;

    [[nodiscard]] static CellBox box_of(const std::vector<CellArea>& areas) {
        CellBox box{areas.front().cell, areas.front().cell};
        for (const CellArea& organ : areas) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                box.low[axis] = std::min(box.low[axis], organ.cell[axis]);
                box.high[axis] = std::max(box.high[axis], organ.cell[axis]);
            }
        }
        return box;
    }

    template <typename Field>
    [[nodiscard]] std::optional<EnvironmentFailure> trace(std::span<const SensePlace> places,
                                                          const Field& field,
                                                          const CellBox& box,
                                                          std::vector<float>& answers) {
        const std::size_t pieces = (places.size() + kPiece - 1) / kPiece;
        std::atomic<std::size_t> first_beyond{kNone};
        context_.workers->for_each(pieces, [&](std::uint64_t piece) {
            const std::size_t end = std::min<std::size_t>(places.size(), (piece + 1) * kPiece);
            for (std::size_t i = piece * kPiece; i < end && !is_cancelled(); ++i) {
                const Vector3& place = places[i].position;
                const std::optional<CellIndex> own = cell_of(place, cell_);
                if (!own) {
                    std::size_t before = first_beyond;
                    while (i < before && !first_beyond.compare_exchange_weak(before, i)) {
                    }
                    return;
                }
                answers[i] = static_cast<float>(light(place, *own, field, box));
            }
        });
        if (first_beyond != kNone) {
            return beyond("the place", first_beyond);
        }
        if (is_cancelled()) {
            return stopped(Stop::Cancelled);
        }
        return std::nullopt;
    }

    /// The part of the light of the sky that reaches `place`, which is in the cell `own`. `field`:
    /// a LeafAreaGrid or LeafAreaTable.
    template <typename Field>
    [[nodiscard]] double light(const Vector3& place,
                               const CellIndex& own,
                               const Field& field,
                               const CellBox& box) const {
        double sum = 0.0;
        for (const SkyDirection& sky : directions_) {
            const double depth = SkyRay(place, own, sky.direction, cell_).depth(field, box);
            sum += sky.weight * (depth == 0.0 ? 1.0 : exact_exp(-depth));
        }
        return sum / weight_;
    }

    [[nodiscard]] static EnvironmentFailure limit(std::uint64_t bytes) {
        return {Stop::Limit, {}, {}, bytes, 0};
    }
    [[nodiscard]] static EnvironmentFailure beyond(std::string_view what, std::size_t place) {
        return {Stop::Diagnosed,
                std::string(what) + " is more than 2147483648 cells from the origin",
                "use a larger `cell`", 0, place};
    }
    [[nodiscard]] bool is_cancelled() const {
        return context_.cancelled != nullptr && *context_.cancelled;
    }

    const BytecodeEnvironment& declared_;
    EnvironmentContext context_;
    double cell_; // m
    std::vector<SkyDirection> directions_;
    double weight_ = 0.0; // sum of the weights of all directions
};

} // namespace

std::unique_ptr<Environment> make_sky(const BytecodeEnvironment& declared,
                                      const EnvironmentContext& context) {
    return std::make_unique<SkyEnvironment>(declared, context);
}

} // namespace lsys
