// SPDX-License-Identifier: MIT
#include "runtime/program/weight_report.h"

#include "grammar/base/exponentials.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxSettleRounds = 2000; // max rounds of bent_height()

constexpr double kBitsPerDigit = 3.3219280948873623; // binary logarithm of 10

/// `value` rounded up to two significant digits.
double rounded_up(double value) {
    constexpr double kRounding = 1e-12; // so that the logarithm of 1000 is not below 3
    const double digits = std::floor(binary_logarithm(value) / kBitsPerDigit + kRounding);
    const double unit = power(10.0, digits - 1.0);
    return std::ceil(value / unit - 1e-9) * unit;
}

std::string number_text(double value) {
    return fmt::format("{:.6g}", value);
}

/// Text with the values with which the plant would stand: "`#set elasticity 1.2e+10`, or widths
/// times 1.8". Empty if no values were found.
std::string advice(const WeightReport& report) {
    std::vector<std::string> ways;
    if (report.elasticity) {
        ways.push_back(fmt::format("`#set elasticity {};`", number_text(*report.elasticity)));
    }
    if (report.spring) {
        ways.push_back(fmt::format("`#set spring {};`", number_text(*report.spring)));
    }
    if (report.width_factor) {
        ways.push_back(fmt::format("widths times {}", number_text(*report.width_factor)));
    }
    return ways.empty() ? "" : fmt::format("it stands with {}", fmt::join(ways, ", or with "));
}

bool has_one_spring(const Skeleton& plant) {
    return !plant.segments.empty() &&
           std::all_of(plant.segments.begin(), plant.segments.end(), [&](const Segment& segment) {
               return segment.spring == plant.segments[0].spring && segment.spring > 0.0F;
           });
}

} // namespace

WeightReport
make_weight_report(const Skeleton& plant, const Settings& settings, const PhysicsOptions& options) {
    WeightReport report;
    report.gravity = static_cast<double>(options.gravity);
    report.stability = stability_of(plant, options);
    report.height_left = bent_height(plant, options, kMaxSettleRounds);
    if (report.stands()) {
        return report;
    }
    const std::optional<double> spring_factor =
        standing_factor(plant, options, Stiffening::Springs);
    const auto elasticity = static_cast<double>(settings.elasticity);
    if (!settings.has_spring && has_automatic_springs(plant, elasticity)) {
        if (spring_factor && elasticity > 0.0) {
            report.elasticity = rounded_up(elasticity * *spring_factor);
        }
        if (const auto width_factor = standing_factor(plant, options, Stiffening::Widths)) {
            report.width_factor = rounded_up(*width_factor);
        }
    } else if (spring_factor && settings.has_spring && has_one_spring(plant)) {
        report.spring = rounded_up(static_cast<double>(settings.spring) * *spring_factor);
    }
    return report;
}

std::string weight_text(const WeightReport& report) {
    std::string text = fmt::format("under {:.4g} m/s2 the plant keeps {:.0f} % of its height",
                                   report.gravity, 100.0 * report.height_left);
    const Stability& stability = report.stability;
    if (std::isfinite(stability.load_factor)) {
        text += fmt::format("; it buckles at {:.3g} times its weight", stability.load_factor);
    }
    text += '\n';
    if (stability.trunk_factor) {
        text += fmt::format("the trunk, {:.3g} m long and {:.3g} m wide, alone as a column buckles "
                            "at {:.3g} times its weight\n",
                            stability.trunk_length, stability.trunk_width, *stability.trunk_factor);
        if (*stability.trunk_factor <
            1.0) { // trunk_factor is proportional to the square of the width (Greenhill 1881)
            text += fmt::format("it is too thin by {:.3g} m\n",
                                stability.trunk_width *
                                    (1.0 / std::sqrt(*stability.trunk_factor) - 1.0));
        }
    }
    const std::string ways = advice(report);
    if (!ways.empty()) {
        text += ways + '\n';
    }
    return text;
}

std::string weight_json(const WeightReport& report) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    const Stability& stability = report.stability;
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value && std::isfinite(*value)) {
            object[name] = *value;
        }
    };
    object["gravity"] = report.gravity;
    object["height_left"] = report.height_left;
    object["stands"] = report.stands();
    add("load_factor", stability.load_factor);
    if (stability.trunk_length > 0.0) {
        object["trunk_length"] = stability.trunk_length;
        object["trunk_width"] = stability.trunk_width;
    }
    add("trunk_factor", stability.trunk_factor);
    add("standing_width_factor", report.width_factor);
    add("standing_elasticity", report.elasticity);
    add("standing_spring", report.spring);
    return object.dump() + '\n';
}

Diagnostics fall_warning(const WeightReport& report) {
    Diagnostics diagnostics;
    if (report.stands()) {
        return diagnostics;
    }
    Diagnostic& warning =
        diagnostics.add(DiagnosticCode::WeakStem, {},
                        fmt::format("the plant sinks to {:.0f} % of its height under {:.4g} m/s2",
                                    100.0 * report.height_left, report.gravity));
    const std::string ways = advice(report);
    warning.help.push_back(ways.empty() ? "make its segments wider or stiffer" : ways);
    return diagnostics;
}

Diagnostics
make_fall_warning(const Skeleton& plant, const Settings& settings, PhysicsOptions options) {
    if (!(options.gravity > 0.0F) || plant.segments.size() > kMaxFallWarningSegments) {
        return {};
    }
    options.wind = {};
    return fall_warning(make_weight_report(plant, settings, options));
}

ExitStatus
warn_of_fall(const WeightReport& report, const Grammar& grammar, const Console& console) {
    Diagnostics warning = fall_warning(report);
    return report.stands() ? ExitStatus::Ok : console.show(warning, *grammar.sources);
}

} // namespace lsys
