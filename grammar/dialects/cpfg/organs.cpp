// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/organs.h"

#include "grammar/base/number_chars.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace lsys {

namespace {

/// std::hypot() is not rounded in the same way on every machine.
double length_of(double x, double y) {
    return std::sqrt(x * x + y * y);
}

constexpr std::string_view kBlanks = " \t\r";
constexpr std::uint32_t kSides = 8; // the default of cpfg
constexpr std::uint32_t kMinSides = 3;
constexpr std::uint32_t kMaxSides = 63; // a contour has at most 64 points
constexpr std::size_t kMaxPoints = 1000;
constexpr std::size_t kMaxFiles = 256;
constexpr double kMaxSteps = 10.0;    // of a patch of a surface, in cpfg
constexpr double kMaxTexture = 255.0; // materials of .lsys have room for no more
constexpr int kStepsPerSpan = 10;     // for lengths along a contour, as in cpfg

struct ContourFile {
    bool closed = false;
    std::vector<CurvePoint> points;
};

// The functions first_... and take() remove what they read from the beginning of their argument.

std::string_view first_line(std::string_view& text) {
    return trimmed(take_line(text), kBlanks);
}

std::string_view first_word(std::string_view& line) {
    line = trimmed(line, kBlanks);
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

std::optional<double> first_number(std::string_view& line) {
    const std::string_view word = first_word(line);
    double value = 0.0;
    const auto [end, error] = number_from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc() && end == word.data() + word.size() &&
                           std::isfinite(value) && std::abs(value) < 1e30;
    return is_number ? std::optional(value) : std::nullopt;
}

/// A number from 0 to `max`, without its fraction.
std::optional<std::uint32_t> first_count(std::string_view& line, double max) {
    const std::optional<double> number = first_number(line);
    return number && *number >= 0.0 && *number <= max
               ? std::optional(static_cast<std::uint32_t>(*number))
               : std::nullopt;
}

/// Whether the line begins with `label`.
bool take(std::string_view& line, std::string_view label) {
    if (!line.starts_with(label)) {
        return false;
    }
    line.remove_prefix(label.size());
    return true;
}

/// Reads `TEXTURE`, `STEPS STEPS` or `STEPS STEPS TEXTURE`, as cpfg does. A negative texture is
/// that of the turtle.
void read_steps_and_texture(std::string_view line, CpfgSurface& surface) {
    std::vector<double> numbers;
    while (numbers.size() < 3) {
        const std::optional<double> number = first_number(line);
        if (!number) {
            break;
        }
        numbers.push_back(std::trunc(*number));
    }
    if (numbers.size() >= 2) {
        const auto steps = [](double count) {
            return count == 0.0 ? 0 : static_cast<std::uint32_t>(std::clamp(count, 1.0, kMaxSteps));
        };
        surface.row_steps = steps(numbers[0]);
        surface.column_steps = steps(numbers[1]);
    }
    const std::size_t place = numbers.size() == 1 ? 0 : 2;
    if (numbers.size() > place && numbers[place] >= 0.0) {
        const bool is_valid = numbers[place] <= kMaxTexture;
        surface.texture = is_valid ? static_cast<std::uint32_t>(numbers[place]) : 0;
    }
}

/// Appends a point, with `has_times` as often as the last number of the line says. Returns false if
/// the line is no point.
bool append_point(std::string_view line, bool has_times, ContourFile& file) {
    const std::optional<double> x = first_number(line);
    const std::optional<double> y = first_number(line);
    if (!x || !y) {
        return false;
    }
    std::uint32_t times = 1;
    if (has_times) {
        static_cast<void>(first_number(line)); // z
        const auto written_times = first_count(line, kMaxPoints);
        if (!written_times) {
            return false;
        }
        times = *written_times;
    }
    file.points.insert(file.points.end(), times, CurvePoint{*x, *y});
    return file.points.size() <= kMaxPoints;
}

/// Reads the formats `11 3 open` and `cver 1 1` to `cver 1 3`.
std::optional<ContourFile> read_contour(std::string_view text) {
    ContourFile file;
    std::string_view line = first_line(text);
    const bool has_times = line.starts_with("cver");
    std::optional<std::uint32_t> count;
    if (has_times) {
        while (!text.empty()) {
            line = first_line(text);
            if (take(line, "points:")) {
                // `points: 5 9`: 5 lines with a point each, 9 points with their repetitions.
                count = first_count(line, kMaxPoints);
            } else if (take(line, "type:")) {
                line = trimmed(line, kBlanks);
                file.closed = line.starts_with('c');
            } else if (count && !line.empty() &&
                       line.find_first_not_of("+-.0123456789eE \t") == line.npos) {
                text = {line.data(),
                        static_cast<std::size_t>(text.data() + text.size() - line.data())};
                break; // the first point
            }
        }
    } else {
        count = first_count(line, kMaxPoints);
        static_cast<void>(first_number(line)); // number of coordinates
        file.closed = first_word(line) == "closed";
    }
    for (std::uint32_t i = 0; count && i < *count; ++i) {
        if (!append_point(first_line(text), has_times, file)) {
            return std::nullopt;
        }
    }
    const std::size_t fewest = file.closed ? 3 : 4;
    return file.points.size() < fewest ? std::nullopt : std::optional(std::move(file));
}

/// The uniform cubic B-spline at `t` spans from its begin.
CurvePoint spline_at(const std::vector<CurvePoint>& points, double t) {
    const double begin = std::floor(t);
    const double u = t - begin;
    const double v = 1.0 - u;
    const std::array<double, 4> weights{
        v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
        (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) / 6.0, u * u * u / 6.0};
    CurvePoint sum;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const CurvePoint& point = points[(static_cast<std::size_t>(begin) + i) % points.size()];
        sum.x += weights[i] * point.x;
        sum.y += weights[i] * point.y;
    }
    return sum;
}

/// `count` + 1 points at equal distances along the contour.
std::vector<CurvePoint> spaced(const ContourFile& file, std::uint32_t count) {
    const std::size_t spans = file.closed ? file.points.size() : file.points.size() - 3;
    const std::size_t steps = spans * kStepsPerSpan;
    std::vector<double> lengths{0.0};
    CurvePoint before = spline_at(file.points, 0.0);
    for (std::size_t i = 1; i <= steps; ++i) {
        // The end of an open contour is the end of its last span.
        const double t = std::min(static_cast<double>(i) / kStepsPerSpan,
                                  static_cast<double>(spans) - (file.closed ? 0.0 : 1e-9));
        const CurvePoint at = spline_at(file.points, t);
        lengths.push_back(lengths.back() + length_of(at.x - before.x, at.y - before.y));
        before = at;
    }
    std::vector<CurvePoint> result;
    std::size_t step = 1;
    for (std::uint32_t i = 0; i <= count; ++i) {
        const double wanted = lengths.back() * i / count;
        while (step < steps && lengths[step] < wanted) {
            ++step;
        }
        const double span = lengths[step] - lengths[step - 1];
        const double part = span > 0.0 ? (wanted - lengths[step - 1]) / span : 0.0;
        const double t = (static_cast<double>(step - 1) + part) / kStepsPerSpan;
        result.push_back(spline_at(
            file.points, std::min(t, static_cast<double>(spans) - (file.closed ? 0.0 : 1e-9))));
    }
    return result;
}

/// Turns a closed contour so that its first point lies on the x axis, as cpfg does.
void turn_to_axis(std::vector<CurvePoint>& points) {
    const CurvePoint first = points.front();
    const double length = length_of(first.x, first.y);
    if (!(length > 1e-9)) {
        return;
    }
    for (CurvePoint& point : points) {
        point = {(point.x * first.x + point.y * first.y) / length,
                 (point.y * first.x - point.x * first.y) / length};
    }
}

} // namespace

std::vector<CurvePoint> contour_points(std::string_view text, std::uint32_t sides) {
    const std::optional<ContourFile> file = read_contour(text);
    if (!file) {
        return {};
    }
    std::vector<CurvePoint> points = spaced(*file, std::min(sides, kMaxSides));
    if (file->closed) {
        points.back() = points.front();
        turn_to_axis(points);
    } else {
        std::reverse(points.begin(),
                     points.end()); // u of texture coordinates falls along a contour in cpfg
    }
    for (CurvePoint& point : points) {
        // x of cpfg points along its up vector, -U of .lsys, and y to the right. Both are relative
        // to the radius; coordinates of .lsys are relative to the width.
        point = {0.5 * point.y, -0.5 * point.x};
    }
    const bool has_extent = std::ranges::any_of(points, [&](const CurvePoint& point) {
        return length_of(point.x - points.front().x, point.y - points.front().y) > 1e-6;
    });
    return has_extent ? points : std::vector<CurvePoint>{};
}

CpfgOrgans read_organs(FileId file, std::string_view view, const FileBeside& beside) {
    const auto span_of = [file, text = view.data()](std::string_view name) {
        const auto begin = static_cast<std::uint32_t>(name.data() - text);
        return SourceSpan{file, begin, begin + static_cast<std::uint32_t>(name.size())};
    };
    CpfgOrgans organs;
    while (!view.empty()) {
        std::string_view line = first_line(view);
        if (take(line, "contour sides:")) {
            organs.sides = first_count(line, 1e6).value_or(0);
        } else if (take(line, "polygonization level:")) {
            // Level n is 2^(n + 1) sides.
            organs.sides = std::uint32_t{2} << first_count(line, 16.0).value_or(2);
        } else if (take(line, "contour:")) {
            const auto number = first_count(line, 1e6);
            const std::string_view name = first_word(line);
            if (number && !name.empty() && organs.contours.size() < kMaxFiles) {
                organs.contours.emplace(*number,
                                        CpfgContour{std::string(name), span_of(name), {}, {}});
            }
        } else if (take(line, "surface:")) {
            const std::string_view letter = first_word(line);
            CpfgSurface surface;
            const std::string_view name = first_word(line);
            surface.file = name;
            surface.span = span_of(name);
            surface.scale = first_number(line).value_or(1.0);
            surface.scale = surface.scale > 0.0 ? surface.scale : 1.0;
            read_steps_and_texture(line, surface);
            if (letter.size() == 1 && organs.surfaces.size() < kMaxFiles) {
                if (const Result<std::string> text = beside(surface.file); !text) {
                    surface.failure = text.error().message;
                }
                organs.surfaces.emplace(letter, std::move(surface));
            }
        }
    }
    organs.sides = organs.sides == 0 ? 0 : std::clamp(organs.sides, kMinSides, kMaxSides);
    const std::uint32_t sides = organs.sides == 0 ? kSides : organs.sides;
    for (auto& [number, contour] : organs.contours) {
        const Result<std::string> text = beside(contour.file);
        contour.points = text ? contour_points(text.value(), sides) : std::vector<CurvePoint>{};
        if (contour.points.empty()) {
            contour.failure = text ? "it is no contour" : text.error().message;
        }
    }
    return organs;
}

std::string contour_statement(std::uint32_t number, const std::vector<CurvePoint>& points) {
    std::string text = "#contour contour" + std::to_string(number);
    for (std::size_t i = 0; i < points.size(); ++i) {
        text += i == 0 ? " " : ", ";
        text += decimal_text(points[i].x) + " " + decimal_text(points[i].y);
    }
    return text + ";\n";
}

std::string object_text(const CpfgSurface& surface) {
    std::string how;
    const auto add = [&](const std::string& words) { how += (how.empty() ? "#" : " ") + words; };
    if (surface.scale != 1.0) {
        add(decimal_text(surface.scale));
    }
    if (surface.row_steps != 0 && surface.column_steps != 0) {
        add("steps " + std::to_string(surface.row_steps) + " " +
            std::to_string(surface.column_steps));
    }
    if (surface.texture) {
        add("texture " + std::to_string(*surface.texture));
    }
    if (surface.is_whole) {
        add("whole");
    }
    return "\"" + surface.file + how + "\"";
}

} // namespace lsys
