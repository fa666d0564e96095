// SPDX-License-Identifier: MIT
// Environments of kind Map: the value of a picture below or above each place.
#include "grammar/base/contract.h"
#include "runtime/environment/environment.h"

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// A picture that lies on the plane of x and z. The value at the centre of a pixel is that of the
/// pixel; between centres, values are interpolated bilinearly; beyond the border, they equal those
/// at the border.
class MapEnvironment : public Environment {
public:
    MapEnvironment(const BytecodeEnvironment& declared,
                   const EnvironmentFiles& files,
                   const EnvironmentContext& context)
        : declared_(declared), picture_(files.picture), context_(context) {
        LSYS_CHECK(picture_.columns > 0 && picture_.rows > 0);
        LSYS_CHECK(picture_.values.size() == std::size_t{picture_.columns} * picture_.rows);
    }

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& /*sizes*/) override {
        constexpr std::size_t kPiece = 1U << 14; // places of one piece of work
        const std::size_t count = word.places.size();
        context_.workers->for_each((count + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
            const std::size_t end = std::min<std::size_t>(count, (piece + 1) * kPiece);
            for (std::size_t i = piece * kPiece; i < end; ++i) {
                const Vector3& place = word.places[i].position;
                answers[i] = static_cast<float>(value(place[0], place[2])) + 0.0F; // -0 becomes 0
            }
        });
        return std::nullopt;
    }

private:
    /// A position along one axis of the picture: the two pixels around it, and the fraction of the
    /// way from the centre of the first to that of the second.
    struct PixelPair {
        std::size_t first = 0;
        std::size_t second = 0;
        double part = 0.0; // 0 at the centre of `first`, 1 at the centre of `second`
    };

    /// `distance`: from the middle of the picture, m; `size`: width of all `pixels` pixels, m.
    [[nodiscard]] static PixelPair pixels_at(double distance, double size, std::uint32_t pixels) {
        const double last = static_cast<double>(pixels - 1);
        const double at = (distance / size + 0.5) * static_cast<double>(pixels) - 0.5;
        if (!(at > 0.0)) {
            return {0, 0, 0.0};
        }
        if (at >= last) {
            return {pixels - 1, pixels - 1, 0.0};
        }
        const double first = std::floor(at);
        const auto index = static_cast<std::size_t>(first);
        return {index, index + 1, at - first};
    }

    [[nodiscard]] double value(double x, double z) const {
        const auto wide = [](float number) { return static_cast<double>(number); };
        const PixelPair column =
            pixels_at(x - wide(declared_.at[0]), wide(declared_.size[0]), picture_.columns);
        const PixelPair row =
            pixels_at(z - wide(declared_.at[1]), wide(declared_.size[1]), picture_.rows);
        const auto along = [&](std::size_t of_row) {
            const double* const pixels = picture_.values.data() + of_row * picture_.columns;
            const double first = pixels[column.first];
            return first + (pixels[column.second] - first) * column.part;
        };
        const double upper = along(row.first);
        const double grey = upper + (along(row.second) - upper) * row.part;
        return wide(declared_.low) + (wide(declared_.high) - wide(declared_.low)) * grey;
    }

    const BytecodeEnvironment& declared_;
    const EnvironmentPicture& picture_;
    EnvironmentContext context_;
};

} // namespace

std::unique_ptr<Environment> make_map(const BytecodeEnvironment& declared,
                                      const EnvironmentFiles& files,
                                      const EnvironmentContext& context) {
    return std::make_unique<MapEnvironment>(declared, files, context);
}

} // namespace lsys
