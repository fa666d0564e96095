// SPDX-License-Identifier: MIT
// Environments of kind Shadow: every place shades a pyramid of voxels below it (Palubicki et al.
// 2009, section 4). The shadow is evaluated at the voxels of the places only.
#include "runtime/environment/environment.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/impl/shadow_layers.h"
#include "runtime/environment/impl/shadow_run.h"
#include "runtime/environment/impl/vectors.h"
#include "runtime/environment/impl/voxel_tiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

constexpr std::size_t kPiece = 2048; // voxels of one piece of work

class ShadowEnvironment : public Environment {
public:
    ShadowEnvironment(const BytecodeEnvironment& declared, const EnvironmentContext& context)
        : declared_(declared), context_(context), layers_(declared) {}

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        if (word.places.empty()) {
            return std::nullopt;
        }
        const std::uint64_t bytes =
            VoxelTiles::bytes_for(word.places.size()) +
            context_.workers->count() * (shadow_table_bytes(declared_.levels) + kPieceBytes);
        if (bytes > context_.max_bytes) {
            return beyond_memory(bytes);
        }
        return answer_places(word.places, answers);
    }

private:
    /// Estimated bytes of the lists of a ShadowRun, per thread, for plants that are not very dense.
    static constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 20;

    [[nodiscard]] std::optional<EnvironmentFailure>
    answer_places(std::span<const SensePlace> places, std::vector<float>& answers) {
        const std::uint32_t tile_bits = shadow_tile_bits(declared_.levels);
        VoxelTiles tiles(tile_bits, *context_.workers, cancelled());
        const auto cell = static_cast<double>(declared_.cell);
        auto failure = tiles.build(places.size(), [&](std::size_t i) {
            const Vector3& at = places[i].position;
            // The axis of the plant is in the middle of a column. Rounding errors of a height that
            // is a multiple of the cell do not move the place to the voxel below.
            return Vector3{fast_floor(at[0] / cell + 0.5), fast_floor(at[1] / cell + 0x1p-20),
                           fast_floor(at[2] / cell + 0.5)};
        });
        if (failure) {
            if (failure->stop == Stop::Diagnosed) {
                explain(*failure);
            }
            return failure;
        }
        const std::size_t voxels = tiles.voxel_count();
        context_.workers->for_each((voxels + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
            const std::size_t begin = piece * kPiece;
            evaluate(tiles, tile_bits, begin, std::min(voxels, begin + kPiece), answers);
        });
        if (cancelled()) {
            return stopped(Stop::Cancelled);
        }
        return std::nullopt;
    }

    void evaluate(const VoxelTiles& tiles,
                  std::uint32_t tile_bits,
                  std::size_t begin,
                  std::size_t end,
                  std::vector<float>& answers) const {
        ShadowRun run(tiles, tile_bits, layers_);
        for (std::size_t tile = tiles.tile_of(begin); begin < end; ++tile) {
            if (cancelled()) {
                return;
            }
            const std::size_t run_end = std::min(end, tiles.first_voxel(tile + 1));
            for (const ShadowSum& sum : run.evaluate(tile, begin, run_end)) {
                write(tiles, begin++, layers_.answer(sum), answers);
            }
        }
    }

    static void write(const VoxelTiles& tiles,
                      std::size_t voxel,
                      const std::array<double, 4>& numbers,
                      std::vector<float>& answers) {
        std::array<float, 4> rounded{};
        for (std::size_t k = 0; k < 4; ++k) {
            rounded[k] = static_cast<float>(numbers[k]) + 0.0F; // -0 becomes 0
        }
        for (std::size_t i = 0; i < tiles.place_count(voxel); ++i) {
            std::copy_n(rounded.begin(), 4,
                        answers.begin() + static_cast<std::ptrdiff_t>(4 * tiles.place(voxel, i)));
        }
    }

    void explain(EnvironmentFailure& failure) const {
        failure.text = "the place is more than 2147483648 voxels from the origin";
        failure.help = "use a larger `cell`";
    }

    [[nodiscard]] const std::atomic<bool>& cancelled() const {
        static const std::atomic<bool> kNever{false};
        return context_.cancelled != nullptr ? *context_.cancelled : kNever;
    }

    const BytecodeEnvironment& declared_;
    EnvironmentContext context_;
    ShadowLayers layers_;
};

} // namespace

std::unique_ptr<Environment> make_shadow(const BytecodeEnvironment& declared,
                                         const EnvironmentContext& context) {
    return std::make_unique<ShadowEnvironment>(declared, context);
}

} // namespace lsys
