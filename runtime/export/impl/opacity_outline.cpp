// SPDX-License-Identifier: MIT
#include "runtime/export/impl/opacity_outline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace lsys {

namespace {

/// Max cells along a side of the picture; a cell of a larger picture has several texels.
constexpr std::uint32_t kMaxSide = 256;
constexpr double kMinArea = 1e-4;        // fraction of the picture; smaller outlines are dropped
constexpr float kMinTolerance = 0.75F;   // cells
constexpr float kTolerance = 1.0F / 200; // fraction of the longer side

/// Whether each cell, a square of texels, is at least half opaque.
struct Mask {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<bool> cells;

    [[nodiscard]] bool at(std::int64_t x, std::int64_t y) const {
        return x >= 0 && y >= 0 && x < columns && y < rows &&
               cells[static_cast<std::size_t>(y * columns + x)];
    }
};

Mask make_mask(const Texture& picture, const glm::vec2& low, const glm::vec2& high) {
    const std::uint32_t side = (std::max(picture.width, picture.height) + kMaxSide - 1) / kMaxSide;
    Mask mask;
    mask.columns = (picture.width + side - 1) / side;
    mask.rows = (picture.height + side - 1) / side;
    mask.cells.resize(std::size_t{mask.columns} * mask.rows);
    const glm::vec2 size(static_cast<float>(picture.width), static_cast<float>(picture.height));
    for (std::uint32_t row = 0; row < mask.rows; ++row) {
        for (std::uint32_t column = 0; column < mask.columns; ++column) {
            const std::uint32_t right = std::min((column + 1) * side, picture.width);
            const std::uint32_t bottom = std::min((row + 1) * side, picture.height);
            std::uint64_t opacity = 0;
            for (std::uint32_t y = row * side; y < bottom; ++y) {
                for (std::uint32_t x = column * side; x < right; ++x) {
                    opacity += picture.texels[4 * (std::size_t{y} * picture.width + x) + 3];
                }
            }
            const std::uint64_t texels =
                std::uint64_t{right - column * side} * (bottom - row * side);
            const glm::vec2 centre = glm::vec2(static_cast<float>(column * side + right),
                                               static_cast<float>(row * side + bottom)) /
                                     (2.0F * size);
            const bool counts =
                centre.x > low.x && centre.x < high.x && centre.y > low.y && centre.y < high.y;
            // The threshold of has_holes(): an opacity of 128 of 255 is opaque.
            mask.cells[std::size_t{row} * mask.columns + column] =
                counts && opacity >= 128 * texels;
        }
    }
    return mask;
}

/// Follows the edges between opaque and transparent cells; opaque cells lie to the right of the
/// path.
class Tracer {
public:
    explicit Tracer(const Mask& mask)
        : columns_(mask.columns + 1), ways_(std::size_t{columns_} * (mask.rows + 1)) {
        for (std::uint32_t y = 0; y < mask.rows; ++y) {
            for (std::uint32_t x = 0; x < mask.columns; ++x) {
                if (!mask.at(x, y)) {
                    continue;
                }
                add(!mask.at(x, std::int64_t{y} - 1), x, y, 0);
                add(!mask.at(x + 1, y), x + 1, y, 1);
                add(!mask.at(x, y + 1), x + 1, y + 1, 2);
                add(!mask.at(std::int64_t{x} - 1, y), x, y + 1, 3);
            }
        }
    }

    /// The midpoints of the edges of each closed path, in units of cells.
    [[nodiscard]] std::vector<std::vector<glm::vec2>> trace() {
        std::vector<std::vector<glm::vec2>> loops;
        for (std::size_t corner = 0; corner < ways_.size(); ++corner) {
            for (std::uint32_t way = 0; way < kSteps.size(); ++way) {
                if (has(corner, way)) {
                    loops.push_back(follow(corner, way));
                }
            }
        }
        return loops;
    }

private:
    /// Right, down, left, up.
    static constexpr std::array<std::pair<int, int>, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

    void add(bool is_edge, std::uint32_t x, std::uint32_t y, std::uint32_t way) {
        if (is_edge) {
            std::uint8_t& ways = ways_[std::size_t{y} * columns_ + x];
            ways = static_cast<std::uint8_t>(ways | 1U << way);
        }
    }
    [[nodiscard]] bool has(std::size_t corner, std::uint32_t way) const {
        return (std::uint32_t{ways_[corner]} >> way & 1U) != 0;
    }

    [[nodiscard]] std::vector<glm::vec2> follow(std::size_t first, std::uint32_t first_way) {
        std::vector<glm::vec2> loop;
        std::vector<std::pair<std::size_t, std::uint32_t>> taken;
        std::size_t corner = first;
        std::uint32_t way = first_way;
        do {
            taken.emplace_back(corner, way);
            const auto [right, down] = kSteps[way];
            loop.emplace_back(
                static_cast<float>(corner % columns_) + 0.5F * static_cast<float>(right),
                static_cast<float>(corner / columns_) + 0.5F * static_cast<float>(down));
            corner = static_cast<std::size_t>(static_cast<std::int64_t>(corner) + right +
                                              std::int64_t{down} * columns_);
            // Right turns first: cells that touch only at a corner are not joined.
            for (const std::uint32_t turn : {1U, 0U, 3U}) {
                if (has(corner, (way + turn) % 4)) {
                    way = (way + turn) % 4;
                    break;
                }
            }
        } while (corner != first || way != first_way);
        for (const auto& [at, used] : taken) {
            ways_[at] = static_cast<std::uint8_t>(ways_[at] & ~(1U << used));
        }
        return loop;
    }

    std::uint32_t columns_;          // of corners
    std::vector<std::uint8_t> ways_; // bit k: an edge leaves the corner along kSteps[k]
};

double area(const std::vector<glm::vec2>& loop) {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const glm::dvec2 a(loop[i]);
        const glm::dvec2 b(loop[(i + 1) % loop.size()]);
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::fabs(twice);
}

float distance_to(const glm::vec2& point, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 along = b - a;
    const float length = glm::dot(along, along);
    const float at =
        length > 0.0F ? std::clamp(glm::dot(point - a, along) / length, 0.0F, 1.0F) : 0.0F;
    return glm::length(point - (a + at * along));
}

/// Simplifies a closed line so that no removed point is farther than `tolerance` from the new line
/// (Douglas and Peucker, "Algorithms for the reduction of the number of points required to
/// represent a digitized line", 1973).
std::vector<glm::vec2> simplified(const std::vector<glm::vec2>& loop, float tolerance) {
    const std::size_t count = loop.size();
    const auto farthest = [&](std::size_t from, std::size_t to) {
        std::pair<float, std::size_t> best{0.0F, from};
        for (std::size_t i = from + 1; i < to; ++i) {
            const float distance = distance_to(loop[i], loop[from], loop[to % count]);
            best = distance > best.first ? std::pair{distance, i} : best;
        }
        return best;
    };
    // The closed line is cut at the first point and at the point farthest from the first.
    std::vector<bool> kept(count, false);
    const std::size_t middle = farthest(0, count).second;
    kept[0] = true;
    kept[middle] = true;
    std::vector<std::pair<std::size_t, std::size_t>> runs{{0, middle}, {middle, count}};
    while (!runs.empty()) {
        const auto [from, to] = runs.back();
        runs.pop_back();
        const auto [distance, at] = farthest(from, to);
        if (distance > tolerance) {
            kept[at] = true;
            runs.emplace_back(from, at);
            runs.emplace_back(at, to);
        }
    }
    std::vector<glm::vec2> left;
    for (std::size_t i = 0; i < count; ++i) {
        if (kept[i]) {
            left.push_back(loop[i]);
        }
    }
    return left;
}

} // namespace

std::vector<std::vector<glm::vec2>>
opacity_outline(const Texture& picture, const glm::vec2& low, const glm::vec2& high) {
    const Mask mask = make_mask(picture, low, high);
    const std::uint32_t longer = std::max(mask.columns, mask.rows);
    const float tolerance = std::max(kMinTolerance, kTolerance * static_cast<float>(longer));
    const double min_area = kMinArea * mask.columns * mask.rows;
    const float cell = static_cast<float>((std::max(picture.width, picture.height) + kMaxSide - 1) /
                                          kMaxSide); // texels
    const glm::vec2 scale =
        cell / glm::vec2(static_cast<float>(picture.width), static_cast<float>(picture.height));
    std::vector<std::vector<glm::vec2>> loops;
    for (const std::vector<glm::vec2>& loop : Tracer(mask).trace()) {
        std::vector<glm::vec2> outline = simplified(loop, tolerance);
        if (outline.size() < 3 || area(loop) < min_area) {
            continue;
        }
        for (glm::vec2& point : outline) {
            point = glm::vec2(std::min(point.x * scale.x, 1.0F), std::min(point.y * scale.y, 1.0F));
        }
        loops.push_back(std::move(outline));
    }
    return loops;
}

} // namespace lsys
