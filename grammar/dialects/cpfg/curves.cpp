// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/curves.h"

#include "grammar/ast/number.h"
#include "grammar/base/characters.h"
#include "grammar/base/number_chars.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kSamples = 100; // the default of cpfg
constexpr double kTolerance = 1e-3;   // relative to the range of values of the curve
constexpr std::size_t kMaxPoints = 1000;
constexpr std::size_t kMaxCurves = 256;
constexpr std::size_t kMaxSamples = 1'000'000;
constexpr std::size_t kMaxTable = 256; // points of a `#curve`

/// Removes the first line of `text`; returns it without blanks at its ends.
std::string_view next_line(std::string_view& text) {
    return trimmed(take_line(text), kWhitespace);
}

std::optional<std::string_view> value_of(std::string_view line, std::string_view key) {
    if (!line.starts_with(key)) {
        return std::nullopt;
    }
    return trimmed(line.substr(key.size()), kWhitespace);
}

/// Removes a number from the beginning of `text`; false if there is none or it is not finite.
bool read_number(std::string_view& text, double& value) {
    text = trimmed(text, kWhitespace);
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc() && std::isfinite(value);
}

/// A whole number at the beginning of `text`; 0 if there is none or it is above `most`.
std::size_t read_count(std::string_view text, std::size_t most) {
    double value = 0.0;
    const bool fits =
        read_number(text, value) && value >= 0.0 && value <= static_cast<double>(most);
    return fits ? static_cast<std::size_t>(value) : 0;
}

/// Curves of a .func or .fset file: `name:` begins one, `points:` counts lines that follow. A line
/// has x, y and perhaps a multiplicity.
void read_curves(std::string_view text, std::vector<CpfgCurve>& curves) {
    CpfgCurve curve;
    while (!text.empty() && curves.size() < kMaxCurves) {
        const std::string_view line = next_line(text);
        if (const auto name = value_of(line, "name:")) {
            curve.name = *name;
            continue;
        }
        if (auto samples = value_of(line, "samples:")) {
            curve.samples = read_count(*samples, kMaxSamples);
            continue;
        }
        auto count_text = value_of(line, "points:");
        double count = 0.0;
        if (!count_text || !read_number(*count_text, count) || count < 2.0 ||
            count > static_cast<double>(kMaxPoints)) {
            continue;
        }
        double lines = 0.0;
        for (; lines < count && !text.empty(); ++lines) {
            std::string_view pair = next_line(text);
            CurvePoint point;
            if (!read_number(pair, point.x) || !read_number(pair, point.y) ||
                (!curve.points.empty() && point.x < curve.points.back().x)) {
                break;
            }
            const std::size_t times = std::max<std::size_t>(read_count(pair, kMaxPoints), 1);
            curve.points.insert(curve.points.end(), times, point);
        }
        if (lines == count && curve.points.size() <= kMaxPoints) {
            curves.push_back(curve);
        }
        curve = {};
    }
}

/// The point at `t` of a uniform B-spline that begins and ends at its first and last control point,
/// by de Boor's recursion. `t` is from 0 to the number of spans.
CurvePoint spline(const std::vector<CurvePoint>& points, std::size_t degree, double t) {
    const std::size_t spans = points.size() - degree;
    const auto span = std::min(static_cast<std::size_t>(t), spans - 1);
    const auto knot = [&](std::size_t i) {
        return i <= degree ? 0.0 : static_cast<double>(std::min(i - degree, spans));
    };
    std::array<CurvePoint, 4> control{};
    for (std::size_t i = 0; i <= degree; ++i) {
        control[i] = points[span + i];
    }
    for (std::size_t level = 1; level <= degree; ++level) {
        for (std::size_t i = degree; i >= level; --i) {
            const double begin = knot(span + i);
            const double end = knot(span + i + degree - level + 1);
            const double part = end > begin ? (t - begin) / (end - begin) : 0.0;
            control[i].x = control[i - 1].x * (1.0 - part) + control[i].x * part;
            control[i].y = control[i - 1].y * (1.0 - part) + control[i].y * part;
        }
    }
    return control[degree];
}

/// Points of the spline with these control points, at equal distances in x.
std::vector<CurvePoint> sampled(const std::vector<CurvePoint>& points) {
    const std::size_t degree = std::min<std::size_t>(points.size() - 1, 3);
    const auto spans = static_cast<double>(points.size() - degree);
    std::vector<CurvePoint> samples;
    const double begin = points.front().x;
    const double width = points.back().x - begin;
    for (std::size_t i = 0; i <= kSamples; ++i) {
        const double x = begin + width * static_cast<double>(i) / kSamples;
        double low = 0.0;
        double high = spans;
        for (int step = 0; step < 40; ++step) { // x ascends with t
            const double middle = (low + high) / 2.0;
            (spline(points, degree, middle).x < x ? low : high) = middle;
        }
        samples.push_back({x, spline(points, degree, high).y});
    }
    return samples;
}

/// Simplifies samples to a polyline within the tolerance (Douglas and Peucker).
std::vector<CurvePoint> chords(const std::vector<CurvePoint>& samples) {
    const auto [low, high] =
        std::minmax_element(samples.begin(), samples.end(),
                            [](const CurvePoint& a, const CurvePoint& b) { return a.y < b.y; });
    const double allowed = (high->y - low->y) * kTolerance;
    std::vector<bool> wanted(samples.size(), false);
    wanted.front() = wanted.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> spans{{0, samples.size() - 1}};
    while (!spans.empty()) {
        const auto [from, to] = spans.back();
        spans.pop_back();
        const double slope = (samples[to].y - samples[from].y) / (samples[to].x - samples[from].x);
        double max_error = allowed;
        std::size_t worst = from;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double chord = samples[from].y + slope * (samples[i].x - samples[from].x);
            if (std::abs(samples[i].y - chord) > max_error) {
                max_error = std::abs(samples[i].y - chord);
                worst = i;
            }
        }
        if (worst != from) {
            wanted[worst] = true;
            spans.emplace_back(from, worst);
            spans.emplace_back(worst, to);
        }
    }
    std::vector<CurvePoint> vertices;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (wanted[i]) {
            vertices.push_back(samples[i]);
        }
    }
    return vertices;
}

/// The binary32 nearest to `value`, as text.
std::string shortest(double value) {
    constexpr double kMax = 1e30;
    const double inside = std::clamp(value, -kMax, kMax);
    return text_of(inside == 0.0 ? 0.0F : static_cast<float>(inside));
}

std::string in_parentheses(const std::string& text) {
    return text.starts_with("-") ? "(" + text + ")" : text;
}

} // namespace

CpfgView read_view(std::string_view text, const FileBeside& beside) {
    CpfgView view;
    while (!text.empty()) {
        const std::string_view line = next_line(text);
        if (const auto factor = value_of(line, "angle factor:"); factor && view.angle.empty()) {
            const std::string_view value = factor->substr(0, literal_length(*factor));
            view.angle = value.empty() ? "" : "(360 / " + std::string(value) + ")";
        } else if (const auto angle = value_of(line, "angle increment:");
                   angle && view.angle.empty()) {
            view.angle = angle->substr(0, literal_length(*angle));
        } else if (auto set = value_of(line, "function set:")) {
            if (const auto curves = beside(*set)) {
                read_curves(curves.value(), view.curves);
            }
        } else if (auto function = value_of(line, "function:")) {
            const std::size_t before = view.curves.size();
            const std::size_t end = std::min(function->find_first_of(" \t"), function->size());
            const std::string_view path = function->substr(0, end);
            if (const auto curve = beside(path)) {
                read_curves(curve.value(), view.curves);
            }
            // A missing file keeps its number, so that the numbers of later curves do not change.
            view.curves.resize(before + 1);
            const std::string_view file = path.substr(path.find_last_of('/') + 1);
            view.curves.back().file = file.substr(0, file.find('.'));
            if (view.curves.back().samples == 0) { // files of the older version have no `samples:`
                view.curves.back().samples = read_count(function->substr(end), kMaxSamples);
            }
        }
    }
    return view;
}

std::vector<double> curve_table(const CpfgCurve& curve) {
    constexpr std::size_t kDegree = 3;
    constexpr double kError = 1e-3; // error of x at which cpfg ends its search
    std::vector<double> table;
    if (curve.samples < 3 || curve.samples > kMaxTable || curve.points.size() <= kDegree) {
        return table;
    }
    const auto spans = static_cast<double>(curve.points.size() - kDegree);
    for (std::size_t i = 0; i < curve.samples; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(curve.samples - 1);
        double low = 0.0;
        double high = 1.0;
        CurvePoint point;
        for (int step = 0; step < 60; ++step) { // ends earlier if the curve reaches x
            const double middle = (low + high) / 2.0;
            point = spline(curve.points, kDegree, middle * spans);
            (point.x > x ? high : low) = middle;
            if (std::abs(point.x - x) <= kError) {
                break;
            }
        }
        table.push_back(point.y);
    }
    return table;
}

std::string curve_statements(const CpfgCurve& curve, const CpfgCurveNames& names) {
    const std::string head = "#function " + names.function + "(x) ";
    const std::vector<double> table = curve_table(curve);
    if (table.empty()) {
        return head + curve_at(curve, "x") + ";\n";
    }
    if (std::all_of(table.begin(), table.end(), [&](double y) { return y == table[0]; })) {
        return head + in_parentheses(shortest(table[0])) + ";\n";
    }
    std::string text = "#curve " + names.table;
    for (std::size_t i = 0; i < table.size(); ++i) {
        text += (i == 0 ? " " : ", ") + std::to_string(i) + " " + shortest(table[i]);
    }
    return text + ";\n#function " + names.between + "(u) mix(" + names.table + "(floor(u)), " +
           names.table + "(floor(u) + 1), u - floor(u));\n" + head + names.between +
           "(clamp(x, 0, 1)*" + std::to_string(table.size() - 1) + ");\n";
}

std::string curve_at(const CpfgCurve& curve, const std::string& x) {
    if (curve.points.back().x <= curve.points.front().x) {
        return in_parentheses(decimal_text(curve.points.back().y));
    }
    const std::vector<CurvePoint> points = chords(sampled(curve.points));
    std::string text = in_parentheses(decimal_text(points.front().y));
    for (std::size_t i = 1; i < points.size(); ++i) {
        const CurvePoint& from = points[i - 1];
        const CurvePoint& to = points[i];
        const std::string slope = decimal_text((to.y - from.y) / (to.x - from.x));
        if (slope == "0") {
            continue;
        }
        text += " + ";
        text += in_parentheses(slope);
        text += "*(clamp(" + x + ", ";
        text += in_parentheses(decimal_text(from.x));
        text += ", ";
        text += in_parentheses(decimal_text(to.x));
        text += ") - ";
        text += in_parentheses(decimal_text(from.x));
        text += ")";
    }
    return text;
}

} // namespace lsys
