// SPDX-License-Identifier: MIT
#include "viewer/scene/height_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys::view {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Clips [begin, end] to the range of t for which origin + t * direction is in [low, high].
bool clip_axis(
    double origin, double direction, double low, double high, double& begin, double& end) {
    if (direction == 0.0) {
        return origin >= low && origin <= high;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    // With this tolerance a border belongs to the squares on both sides, however it is rounded.
    const double slack = 1e-12 * (std::abs(begin) + std::abs(end));
    return begin <= end + slack;
}

} // namespace

HeightField::HeightField(const Terrain& terrain, std::uint32_t columns, std::uint32_t rows)
    : region_(terrain.region()), columns_(std::max(columns, 1U)), rows_(std::max(rows, 1U)),
      step_x_(region_.width / columns_), step_z_(region_.depth / rows_) {
    heights_.reserve(std::size_t{columns_ + 1} * (rows_ + 1));
    for (std::uint32_t row = 0; row <= rows_; ++row) {
        for (std::uint32_t column = 0; column <= columns_; ++column) {
            heights_.push_back(terrain.height(static_cast<float>(region_.x + column * step_x_),
                                              static_cast<float>(region_.z + row * step_z_)));
        }
    }
    Level cells{columns_, rows_, {}};
    cells.max_heights.reserve(std::size_t{columns_} * rows_);
    for (std::uint32_t row = 0; row < rows_; ++row) {
        const float* const low = heights_.data() + std::size_t{row} * (columns_ + 1);
        const float* const high = low + columns_ + 1;
        for (std::uint32_t column = 0; column < columns_; ++column) {
            cells.max_heights.push_back(std::max(std::max(low[column], low[column + 1]),
                                                 std::max(high[column], high[column + 1])));
        }
    }
    levels_.push_back(std::move(cells));
    while (levels_.back().max_heights.size() > 1) {
        const Level& finer = levels_.back();
        Level level{(finer.columns + 1) / 2, (finer.rows + 1) / 2, {}};
        level.max_heights.assign(std::size_t{level.columns} * level.rows,
                                 -std::numeric_limits<float>::infinity());
        for (std::uint32_t row = 0; row < finer.rows; ++row) {
            for (std::uint32_t column = 0; column < finer.columns; ++column) {
                float& max_height =
                    level.max_heights[std::size_t{row / 2} * level.columns + column / 2];
                max_height = std::max(max_height,
                                      finer.max_heights[std::size_t{row} * finer.columns + column]);
            }
        }
        levels_.push_back(std::move(level));
    }
}

double HeightField::height_at(std::uint32_t column, std::uint32_t row) const {
    return static_cast<double>(heights_[std::size_t{row} * (columns_ + 1) + column]);
}

/// The range of ray parameters over a square; nullopt if the ray passes beside the square, or above
/// the max height of the square.
std::optional<HeightField::Span> HeightField::clip(const Ray& ray,
                                                   std::uint32_t level,
                                                   std::uint32_t column,
                                                   std::uint32_t row) const {
    const double low_x = region_.x + (column << level) * step_x_;
    const double low_z = region_.z + (row << level) * step_z_;
    const std::uint32_t next_column = std::min((column + 1) << level, columns_);
    const std::uint32_t next_row = std::min((row + 1) << level, rows_);
    Span span{0.0, kInfinity};
    if (!clip_axis(ray.origin.x, ray.direction.x, low_x, region_.x + next_column * step_x_,
                   span.begin, span.end) ||
        !clip_axis(ray.origin.z, ray.direction.z, low_z, region_.z + next_row * step_z_, span.begin,
                   span.end)) {
        return std::nullopt;
    }
    const Level& squares = levels_[level];
    const auto max_height =
        static_cast<double>(squares.max_heights[std::size_t{row} * squares.columns + column]);
    const double first = ray.origin.y + span.begin * ray.direction.y;
    const double last =
        ray.direction.y < 0.0
            ? (std::isinf(span.end) ? -kInfinity : ray.origin.y + span.end * ray.direction.y)
            : first;
    const double lowest = std::min(first, last);
    if (lowest > max_height + 1e-9 * (1.0 + std::abs(max_height))) {
        return std::nullopt;
    }
    return span;
}

/// Intersects the ray with the two triangles of a cell. The height of the ray above a triangle is a
/// linear function of the ray parameter.
std::optional<double> HeightField::pick_in_cell(const Ray& ray,
                                                const Span& span,
                                                std::uint32_t column,
                                                std::uint32_t row) const {
    const double corner = height_at(column, row);
    const double along_x = height_at(column + 1, row);
    const double along_z = height_at(column, row + 1);
    const double far = height_at(column + 1, row + 1);
    const double low_x = region_.x + column * step_x_;
    const double low_z = region_.z + row * step_z_;
    const auto above = [&](double t) {
        const double u =
            std::clamp((ray.origin.x + t * ray.direction.x - low_x) / step_x_, 0.0, 1.0);
        const double v =
            std::clamp((ray.origin.z + t * ray.direction.z - low_z) / step_z_, 0.0, 1.0);
        const double ground = u >= v ? corner + u * (along_x - corner) + v * (far - along_x)
                                     : corner + v * (along_z - corner) + u * (far - along_z);
        return ray.origin.y + t * ray.direction.y - ground;
    };
    double begin = span.begin;
    double height = above(begin);
    if (height <= 0.0) {
        return begin;
    }
    if (std::isinf(span.end)) { // the ray is vertical
        return ray.direction.y < 0.0 ? std::optional(begin - height / ray.direction.y)
                                     : std::nullopt;
    }
    const double u0 = (ray.origin.x - low_x) / step_x_ - (ray.origin.z - low_z) / step_z_;
    const double du = ray.direction.x / step_x_ - ray.direction.z / step_z_;
    const double diagonal = du == 0.0 ? span.end : -u0 / du;
    for (const double end : {diagonal, span.end}) {
        if (!(end > begin && end <= span.end)) {
            continue;
        }
        const double next = above(end);
        if (next <= 0.0) {
            return begin + (end - begin) * (height / (height - next));
        }
        begin = end;
        height = next;
    }
    return std::nullopt;
}

std::optional<glm::dvec3> HeightField::pick(const Ray& ray) const {
    struct Square {
        std::uint32_t level;
        std::uint32_t column;
        std::uint32_t row;
    };
    std::vector<Square> pending;
    pending.push_back({static_cast<std::uint32_t>(levels_.size() - 1), 0, 0});
    while (!pending.empty()) {
        const Square square = pending.back();
        pending.pop_back();
        const std::optional<Span> span = clip(ray, square.level, square.column, square.row);
        if (!span) {
            continue;
        }
        if (square.level == 0) {
            if (const auto t = pick_in_cell(ray, *span, square.column, square.row)) {
                return ray.origin + *t * ray.direction;
            }
            continue;
        }
        // Pushes the four children of the square in reverse order, so that the nearest child is
        // popped first.
        const Level& finer = levels_[square.level - 1];
        const std::uint32_t near_column = ray.direction.x < 0.0 ? 1 : 0;
        const std::uint32_t near_row = ray.direction.z < 0.0 ? 1 : 0;
        // The two children beside the nearest child may be visited in any order: a ray meets only
        // one of them, or meets both at the corner that all four children share.
        for (const std::uint32_t which : {3U, 2U, 1U, 0U}) {
            const Square child{square.level - 1, 2 * square.column + (near_column ^ (which & 1U)),
                               2 * square.row + (near_row ^ (which >> 1U))};
            if (child.column < finer.columns && child.row < finer.rows) {
                pending.push_back(child);
            }
        }
    }
    return std::nullopt;
}

} // namespace lsys::view
