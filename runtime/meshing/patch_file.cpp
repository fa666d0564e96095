// SPDX-License-Identifier: MIT
#include "runtime/meshing/patch_file.h"

#include "grammar/base/number_chars.h"
#include "runtime/base/size_text.h"
#include "runtime/meshing/user_mesh.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr int kSteps = 8; // steps of a patch in each direction, unless the file states them
constexpr int kMaxSteps = 64;

using ControlPoints = std::array<glm::dvec3, 16>; // row by row

/// Values of the cubic Bernstein polynomials, or with `slopes` their derivatives.
std::array<double, 4> bernstein(double t, bool slopes) {
    const double u = 1.0 - t;
    return slopes ? std::array{-3.0 * u * u, 3.0 * u * (u - 2.0 * t), 3.0 * t * (2.0 * u - t),
                               3.0 * t * t}
                  : std::array{u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t};
}

glm::dvec3 weighted(const ControlPoints& points,
                    const std::array<double, 4>& rows,
                    const std::array<double, 4>& columns) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 16; ++i) {
        sum += rows[i / 4] * columns[i % 4] * points[i];
    }
    return sum;
}

class PatchReader {
public:
    PatchReader(std::string_view text, const SurfaceName& name, std::uint64_t max_bytes)
        : text_(text), name_(name), max_bytes_(max_bytes) {}

    Result<UserMesh> read() {
        if (!read_header()) {
            return std::move(*error_);
        }
        while (skip_blank_lines()) {
            ControlPoints points{};
            if (!read_patch(points) || !append_patch(points)) {
                return std::move(*error_);
            }
        }
        if (mesh_.indices.empty()) {
            return Error{"there is no patch in it"};
        }
        smooth_edges();
        if (name_.is_whole) {
            map_whole();
        }
        return std::move(mesh_);
    }

private:
    bool fail(std::string what) {
        error_ = Error{fmt::format("line {}: {}", line_number_, what)};
        return false;
    }

    /// Reads the next line into line_; returns false at the end of the text.
    bool next_line() {
        if (at_ >= text_.size()) {
            ++line_number_;
            line_ = {};
            return false;
        }
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        line_ = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_number_;
        return true;
    }

    /// Whether a line with text follows; it is the next that next_line() reads.
    bool skip_blank_lines() {
        while (at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            if (text_.substr(at_, end - at_).find_first_not_of(" \t\r") != text_.npos) {
                return true;
            }
            next_line();
        }
        return false;
    }

    /// Removes the next word from line_ and returns it; empty at the end of the line.
    std::string_view next_word() {
        constexpr std::string_view kBlanks = " \t\r";
        line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
        const std::string_view word = line_.substr(0, line_.find_first_of(kBlanks));
        line_.remove_prefix(word.size());
        return word;
    }

    /// Reads the next number of line_, behind any words that end with `:`.
    bool next_number(std::string_view what, double& value) {
        std::string_view word = next_word();
        while (word.ends_with(':')) {
            word = next_word();
        }
        word.remove_prefix(word.starts_with('+') ? 1 : 0);
        const auto [end, code] = number_from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || code != std::errc() || end != word.data() + word.size()) {
            return fail(word.empty() ? fmt::format("{} lacks a number", what)
                                     : fmt::format("`{}` is not a number", shortened(word)));
        }
        constexpr double kMax = 1e30;
        if (!(std::abs(value) <= kMax)) {
            return fail(fmt::format("{} is not a finite number below 1e30", shortened(word)));
        }
        return true;
    }

    static std::string shortened(std::string_view word) {
        constexpr std::size_t kMaxLength = 40;
        return std::string(word.substr(0, kMaxLength)) + (word.size() > kMaxLength ? "..." : "");
    }

    /// Reads the line `label` with as many numbers as `values` has.
    bool read_numbers(std::string_view label, std::span<double> values) {
        if (!skip_blank_lines()) {
            next_line();
            return fail(label.empty() ? std::string("the file ends where numbers should follow")
                                      : fmt::format("the file ends before `{}`", label));
        }
        next_line();
        line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
        if (!line_.starts_with(label)) {
            return fail(fmt::format("expected `{}`", label));
        }
        line_.remove_prefix(label.size());
        const std::string_view what = label.empty() ? "the box" : label;
        return std::ranges::all_of(values, [&](double& value) { return next_number(what, value); });
    }

    bool next_line_begins(std::string_view label) {
        return skip_blank_lines() && text_.substr(at_).starts_with(label);
    }

    bool read_vector(std::string_view label, glm::dvec3& vector) {
        std::array<double, 3> values{};
        const bool ok = read_numbers(label, values);
        vector = {values[0], values[1], values[2]};
        return ok;
    }

    bool read_header() {
        if (next_line_begins("VERSION")) {
            next_line();
        }
        std::array<double, 6> box{};
        if (!read_numbers("", box)) {
            return false;
        }
        std::array<double, 2> steps{kSteps, kSteps};
        if (next_line_begins("PRECISION")) {
            if (!read_numbers("PRECISION", steps)) {
                return false;
            }
            for (const double each : steps) {
                if (!(each >= 1.0 && each <= kMaxSteps)) {
                    return fail(
                        fmt::format("a precision of {} is not from 1 to {}", each, kMaxSteps));
                }
            }
        }
        rows_ = name_.row_steps != 0 ? name_.row_steps : static_cast<std::uint32_t>(steps[0]);
        columns_ =
            name_.column_steps != 0 ? name_.column_steps : static_cast<std::uint32_t>(steps[1]);
        glm::dvec3 end{};
        glm::dvec3 heading{};
        glm::dvec3 up{};
        if (!read_vector("CONTACT POINT", contact_) || !read_vector("END POINT", end) ||
            !read_direction("HEADING", heading) || !read_direction("UP", up)) {
            return false;
        }
        const glm::dvec3 left = glm::cross(heading, up);
        const double length = glm::length(left);
        if (!(length > 1e-6)) {
            return fail("HEADING and UP are parallel");
        }
        axes_ = glm::dmat3(left / length, heading, glm::cross(left / length, heading));
        std::array<double, 1> size{};
        if (!read_numbers("SIZE:", size)) {
            return false;
        }
        if (!(size[0] > 0.0)) {
            return fail(fmt::format("a size of {} is not above 0", size[0]));
        }
        scale_ = static_cast<double>(name_.scale) / size[0];
        return true;
    }

    bool read_direction(std::string_view label, glm::dvec3& direction) {
        if (!read_vector(label, direction)) {
            return false;
        }
        const double length = glm::length(direction);
        if (!(length > 1e-3)) {
            return fail(fmt::format("{} has no direction", label));
        }
        direction /= length;
        return true;
    }

    bool read_patch(ControlPoints& points) {
        next_line(); // the name
        for (const std::string_view label : {"TOP COLOR:", "AL:", "L:", "BL:"}) {
            if (!read_numbers(label, {})) {
                return false;
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i % 4 == 0 && !read_numbers("", {})) {
                return false;
            }
            glm::dvec3& point = points[i];
            for (double* const value : {&point.x, &point.y, &point.z}) {
                if (!next_number("a row of control points", *value)) {
                    return false;
                }
            }
            // The coordinates in the file and those of the product are along the left, heading and
            // up axes of cpfg's turtle. Its left and up are -R and -U.
            point = axes_ * (scale_ * (point - contact_));
            point.x = -point.x;
            point.z = -point.z;
        }
        return true;
    }

    bool append_patch(const ControlPoints& points) {
        const std::uint64_t vertices = std::uint64_t{rows_ + 1} * (columns_ + 1);
        // 64: bytes per vertex in smooth_edges()
        used_ += vertices * (2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 64) +
                 std::uint64_t{rows_} * columns_ * 6 * sizeof(std::uint32_t);
        if (2 * used_ > max_bytes_) {
            error_ = memory_error("its mesh", max_bytes_);
            return false;
        }
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::uint32_t row = 0; row <= rows_; ++row) {
            for (std::uint32_t column = 0; column <= columns_; ++column) {
                append_vertex(points, static_cast<double>(row) / rows_,
                              static_cast<double>(column) / columns_);
            }
        }
        for (std::uint32_t row = 0; row < rows_; ++row) {
            for (std::uint32_t column = 0; column < columns_; ++column) {
                const std::uint32_t a = first + row * (columns_ + 1) + column;
                const std::uint32_t c = a + columns_ + 1;
                append_triangle(a, c, c + 1);
                append_triangle(a, c + 1, a + 1);
            }
        }
        return true;
    }

    /// `s`: from the first row of control points to the last; `t`: along the rows.
    void append_vertex(const ControlPoints& points, double s, double t) {
        const glm::dvec3 down = weighted(points, bernstein(s, true), bernstein(t, false));
        const glm::dvec3 across = weighted(points, bernstein(s, false), bernstein(t, true));
        const glm::dvec3 normal = glm::cross(down, across);
        const double length = glm::length(normal);
        mesh_.positions.emplace_back(weighted(points, bernstein(s, false), bernstein(t, false)));
        // smooth_edges() gives a vertex without a normal the mean normal of its triangles.
        mesh_.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(0.0));
        mesh_.texture_coordinates.emplace_back(s, 1.0 - t);
    }

    /// Texture coordinates that run once over the box of the surface: u along -X, the left of cpfg,
    /// and v against the heading.
    void map_whole() {
        glm::vec3 low = mesh_.positions.front();
        glm::vec3 high = low;
        for (const glm::vec3& position : mesh_.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        const auto part = [](float length, float whole) {
            return whole > 0.0F ? length / whole : 0.0F;
        };
        for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
            const glm::vec3 from_high = high - mesh_.positions[i];
            mesh_.texture_coordinates[i] = {part(from_high.x, high.x - low.x),
                                            part(from_high.y, high.y - low.y)};
        }
    }

    void append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto at = [&](std::uint32_t i) { return glm::dvec3(mesh_.positions[i]); };
        if (glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) > 0.0) {
            mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
        }
    }

    /// Gives vertices at one place a common normal, unless their surfaces meet at a sharp edge.
    void smooth_edges() {
        constexpr float kSharp = 0.5F;          // cosine of the angle between normals
        constexpr std::size_t kMaxJoined = 256; // more vertices at a place keep their normals
        std::vector<glm::vec3> faces(mesh_.positions.size(), glm::vec3(0.0F));
        for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return mesh_.positions[mesh_.indices[i + k]]; };
            const glm::vec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
            for (std::size_t k = 0; k < 3; ++k) {
                faces[mesh_.indices[i + k]] += area;
            }
        }
        std::map<std::tuple<float, float, float>, std::vector<std::uint32_t>> places;
        for (std::uint32_t i = 0; i < mesh_.positions.size(); ++i) {
            glm::vec3& normal = mesh_.normals[i];
            if (normal == glm::vec3(0.0F)) {
                const float length = glm::length(faces[i]);
                normal = length > 0.0F ? faces[i] / length : glm::vec3(0.0F, 0.0F, -1.0F);
            }
            const glm::vec3& at = mesh_.positions[i];
            places[{at.x, at.y, at.z}].push_back(i);
        }
        std::vector<glm::vec3> smooth = mesh_.normals;
        for (const auto& [place, vertices] : places) {
            if (vertices.size() > kMaxJoined) {
                continue;
            }
            for (const std::uint32_t own : vertices) {
                glm::vec3 sum(0.0F);
                for (const std::uint32_t other : vertices) {
                    const bool joins = glm::dot(mesh_.normals[own], mesh_.normals[other]) > kSharp;
                    sum += joins ? mesh_.normals[other] : glm::vec3(0.0F);
                }
                smooth[own] = glm::normalize(sum);
            }
        }
        mesh_.normals = std::move(smooth);
    }

    std::string_view text_;
    SurfaceName name_;
    std::uint64_t max_bytes_;
    std::uint64_t used_ = 0; // estimated bytes of the mesh
    std::size_t at_ = 0;     // offset of the next line in text_
    std::string_view line_;  // the rest of the current line
    std::uint64_t line_number_ = 0;
    std::optional<Error> error_;
    std::uint32_t rows_ = 0;    // steps along the columns of control points
    std::uint32_t columns_ = 0; // steps along the rows of control points
    glm::dvec3 contact_{};      // contact point, in coordinates of the file
    glm::dmat3 axes_{1.0};      // columns: left, heading and up
    double scale_ = 1.0;        // scale of the name / SIZE
    UserMesh mesh_;
};

} // namespace

Result<UserMesh>
read_patches(std::string_view text, const SurfaceName& name, std::uint64_t max_bytes) {
    return PatchReader(text, name, max_bytes).read();
}

Result<UserMesh>
read_object_file(std::string_view name, std::string_view text, std::uint64_t max_bytes) {
    const std::optional<SurfaceName> parts = surface_name(name);
    return parts ? read_patches(text, *parts, max_bytes) : read_obj(text, max_bytes);
}

} // namespace lsys
