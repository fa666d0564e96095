// SPDX-License-Identifier: MIT
#include "runtime/scene/impl/table_reader.h"

#include "runtime/derive/runtime_diagnostic.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace lsys {

namespace {

struct KeyPlace {
    std::string_view key;
    std::string_view table;
};

/// The table that a key belongs to. Messages about a key in a wrong table name it.
constexpr KeyPlace kPlaces[] = {
    {"kind", "[terrain]"},
    {"size", "[terrain]"},
    {"origin", "[terrain]"},
    {"octaves", "[terrain]"},
    {"lacunarity", "[terrain]"},
    {"gain", "[terrain]"},
    {"feature", "[terrain]"},
    {"height", "[terrain]"},
    {"base", "[terrain]"},
    {"map_size", "[terrain]"},
    {"lowest", "[terrain]"},
    {"highest", "[terrain]"},
    {"filter", "[terrain]"},
    {"colour", "[terrain]"},
    {"normals", "[terrain]"},
    {"tile", "[terrain]"},
    {"sun", "[light]"},
    {"day", "[light]"},
    {"hour", "[light]"},
    {"latitude", "[light]"},
    {"turbidity", "[light]"},
    {"grammar", "[[species]]"},
    {"dialect", "[[species]]"},
    {"system", "[[species]]"},
    {"n", "[[species]]"},
    {"stages", "[[species]]"},
    {"years_of_stage", "[[species]]"},
    {"starting_stage", "[[species]]"},
    {"define", "[[species]]"},
    {"heroes", "[[species]]"},
    {"rho", "[[species]]"},
    {"cache_cap", "[[species]]"},
    {"surroundings", "[[species]]"},
    {"share", "[[species]]"},
    {"scale", "[[species]]"},
    {"altitude", "[[species]]"},
    {"slope", "[[species]]"},
    {"rate", "[species.growth]"},
    {"greatest_radius", "[species.growth]"},
    {"shade_tolerance", "[species.growth]"},
    {"vigour_spread", "[species.growth]"},
    {"lifespan", "[species.growth]"},
    {"maturity", "[species.growth]"},
    {"seeds", "[species.growth]"},
    {"seed_distance", "[species.growth]"},
    {"method", "[placement]"},
    {"count", "[placement]"},
    {"spacing", "[placement]"},
    {"density", "[placement]"},
    {"years", "[placement]"},
    {"trees", "[painted]"},
    {"erased", "[painted]"},
    {"key", "the file, above its tables"},
    {"season", "the file, above its tables"},
    {"variety", "the file, above its tables"},
    {"memory", "the file, above its tables"},
};

/// The shortest text that reads back as the same number; whole numbers have thousands separators.
std::string number_text(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e15) {
        return (value < 0.0 ? "-" : "") +
               grouped_digits(static_cast<std::uint64_t>(std::abs(value)));
    }
    return fmt::format("{}", value);
}

std::string with_unit(std::string text, std::string_view unit) {
    return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

std::string range_text(const NumberRange& range) {
    const bool open = std::isinf(range.max);
    if (open && std::isinf(range.min)) {
        return "be a number";
    }
    if (range.excludes_min) {
        return open ? with_unit(fmt::format("be above {}", number_text(range.min)), range.unit)
                    : with_unit(fmt::format("be above {} and at most {}", number_text(range.min),
                                            number_text(range.max)),
                                range.unit);
    }
    return open ? with_unit(fmt::format("be {} or more", number_text(range.min)), range.unit)
                : with_unit(fmt::format("be from {} to {}", number_text(range.min),
                                        number_text(range.max)),
                            range.unit);
}

std::string list_text(std::span<const std::string_view> names) {
    return fmt::format("`{}`", fmt::join(names, "`, `"));
}

} // namespace

const SceneEntry* TableReader::entry(std::string_view key) {
    known_.push_back(key);
    return table_ == nullptr ? nullptr : find_entry(*table_, key);
}

Diagnostic& TableReader::report_bad_value(SourceSpan span, std::string message) {
    return diagnostics_.add(DiagnosticCode::BadSceneValue, span, std::move(message));
}

Diagnostic& TableReader::report_wrong_kind(const SceneValue& value,
                                           std::string_view what,
                                           std::string_view wanted) {
    Diagnostic& error = report_bad_value(value.span, fmt::format("{} must be {}", what, wanted));
    error.label = fmt::format("this is {}", kind_text(value.kind));
    return error;
}

std::optional<double>
TableReader::number_of(const SceneValue& value, std::string_view what, const NumberRange& range) {
    if (value.kind != SceneValueKind::Integer && value.kind != SceneValueKind::Real) {
        report_wrong_kind(value, what, "a number");
        return std::nullopt;
    }
    const double number = value.real;
    const bool enough = range.excludes_min ? number > range.min : number >= range.min;
    if (!(enough && number <= range.max)) { // also true for NaN
        report_bad_value(value.span, fmt::format("{} is {}; it must {}", what, number_text(number),
                                                 range_text(range)));
        return std::nullopt;
    }
    return number;
}

std::optional<std::uint64_t>
TableReader::integer_of(const SceneValue& value, std::string_view what, IntegerRange range) {
    if (value.kind != SceneValueKind::Integer) {
        report_wrong_kind(value, what, "a whole number");
        return std::nullopt;
    }
    if (value.integer < 0 || static_cast<std::uint64_t>(value.integer) < range.min ||
        static_cast<std::uint64_t>(value.integer) > range.max) {
        const bool open = range.max >= std::uint64_t{1} << 53;
        const NumberRange wide{static_cast<double>(range.min),
                               open ? HUGE_VAL : static_cast<double>(range.max),
                               false,
                               {}};
        report_bad_value(value.span, fmt::format("{} is {}; it must {}", what,
                                                 number_text(value.real), range_text(wide)));
        return std::nullopt;
    }
    return static_cast<std::uint64_t>(value.integer);
}

std::optional<double> TableReader::number(std::string_view key, const NumberRange& range) {
    const SceneEntry* const found = entry(key);
    return found == nullptr ? std::nullopt
                            : number_of(found->value, fmt::format("`{}`", key), range);
}

std::optional<std::uint64_t> TableReader::integer(std::string_view key, IntegerRange range) {
    const SceneEntry* const found = entry(key);
    return found == nullptr ? std::nullopt
                            : integer_of(found->value, fmt::format("`{}`", key), range);
}

std::optional<std::string> TableReader::text(std::string_view key) {
    const SceneEntry* const found = entry(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    if (found->value.kind != SceneValueKind::Text) {
        report_wrong_kind(found->value, fmt::format("`{}`", key), "a text");
        return std::nullopt;
    }
    const std::string& text = found->value.text;
    const bool plain = std::none_of(text.begin(), text.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    if (text.empty() || !plain) {
        report_bad_value(
            found->value.span,
            fmt::format("`{}` {}", key, plain ? "is empty" : "holds a control character"));
        return std::nullopt;
    }
    return text;
}

std::optional<SceneFile> TableReader::file(std::string_view key) {
    std::optional<std::string> path = text(key);
    if (!path) {
        return std::nullopt;
    }
    return SceneFile{std::move(*path), span_of(key)};
}

std::optional<std::size_t> TableReader::choice(std::string_view key,
                                               std::span<const std::string_view> names) {
    const std::optional<std::string> name = text(key);
    if (!name) {
        return std::nullopt;
    }
    const auto found = std::find(names.begin(), names.end(), *name);
    if (found != names.end()) {
        return static_cast<std::size_t>(found - names.begin());
    }
    const SourceSpan span = span_of(key);
    Diagnostic& error = report_bad_value(span, fmt::format("there is no {} `{}`", key, *name));
    if (const auto nearest = nearest_name(*name, {names.begin(), names.end()})) {
        error.help.push_back(fmt::format("did you mean `{}`?", *nearest));
        error.fixes.push_back({fmt::format("write `{}`", *nearest),
                               {{span, fmt::format("\"{}\"", *nearest)}},
                               false});
    } else {
        error.help.push_back(fmt::format("`{}` is one of {}", key, list_text(names)));
    }
    return std::nullopt;
}

std::optional<std::array<double, 2>>
TableReader::pair(std::string_view key, const NumberRange& range, bool lone) {
    const SceneEntry* const found = entry(key);
    if (found == nullptr) {
        return std::nullopt;
    }
    const SceneValue& value = found->value;
    const std::string what = fmt::format("`{}`", key);
    if (lone && (value.kind == SceneValueKind::Integer || value.kind == SceneValueKind::Real)) {
        const std::optional<double> both = number_of(value, what, range);
        return both ? std::optional(std::array<double, 2>{*both, *both}) : std::nullopt;
    }
    if (value.kind != SceneValueKind::List) {
        report_wrong_kind(value, what,
                          lone ? "a number or a list of two" : "a list of two numbers");
        return std::nullopt;
    }
    if (value.items.size() != 2) {
        report_bad_value(value.span, fmt::format("{} must be a list of two numbers, not of {}",
                                                 what, value.items.size()));
        return std::nullopt;
    }
    const std::optional<double> first =
        number_of(value.items[0], fmt::format("the first number of {}", what), range);
    const std::optional<double> second =
        number_of(value.items[1], fmt::format("the second number of {}", what), range);
    return first && second ? std::optional(std::array<double, 2>{*first, *second}) : std::nullopt;
}

std::optional<std::array<double, 2>> TableReader::ordered_pair(std::string_view key,
                                                               const NumberRange& range) {
    const std::optional<std::array<double, 2>> ends = pair(key, range, false);
    if (ends && (*ends)[0] > (*ends)[1]) {
        report_bad_value(span_of(key),
                         fmt::format("`{}` begins at {} and ends below it, at {}", key,
                                     number_text((*ends)[0]), number_text((*ends)[1])));
        return std::nullopt;
    }
    return ends;
}

const SceneValue* TableReader::table(std::string_view key) {
    const SceneEntry* const found = entry(key);
    if (found == nullptr) {
        return nullptr;
    }
    if (found->value.kind != SceneValueKind::Table) {
        report_wrong_kind(found->value, fmt::format("`{}`", key), "a table");
        return nullptr;
    }
    return &found->value;
}

Diagnostic& TableReader::report_missing(std::string_view key, std::string_view subject) {
    SourceSpan at = span();
    if (name_.empty()) {
        at.end = at.begin; // there is no heading to underline
    }
    Diagnostic& error = diagnostics_.add(DiagnosticCode::MissingSceneKey, at,
                                         fmt::format("{} has no `{}`", subject, key));
    return error;
}

void TableReader::report_conflicting_key(std::string_view key,
                                         std::string_view reason,
                                         SourceSpan cause) {
    if (!has(key)) {
        return;
    }
    Diagnostic& error =
        diagnostics_.add(DiagnosticCode::ConflictingSceneKeys, find_entry(*table_, key)->key_span,
                         fmt::format("`{}` has no effect here: {}", key, reason));
    if (cause.file != kNoFile) {
        error.labels.push_back({cause, "this decides"});
    }
}

SourceSpan TableReader::span_of(std::string_view key) const {
    const SceneEntry* const found = table_ == nullptr ? nullptr : find_entry(*table_, key);
    return found == nullptr ? span() : found->value.span;
}

void TableReader::finish() {
    if (table_ == nullptr) {
        return;
    }
    for (const SceneEntry& found : table_->entries) {
        if (std::find(known_.begin(), known_.end(), found.key) != known_.end()) {
            continue;
        }
        Diagnostic& error =
            diagnostics_.add(DiagnosticCode::UnknownSceneKey, found.key_span,
                             name_.empty() ? fmt::format("a scene has no key `{}`", found.key)
                                           : fmt::format("`{}` has no key `{}`", name_, found.key));
        const auto place =
            std::find_if(std::begin(kPlaces), std::end(kPlaces),
                         [&](const KeyPlace& other) { return other.key == found.key; });
        if (place != std::end(kPlaces)) {
            const bool is_table = place->table.starts_with('[');
            error.help.push_back(is_table ? fmt::format("it belongs in `{}`", place->table)
                                          : fmt::format("it belongs to {}", place->table));
        } else if (found.key == "profile" || found.key == "turtle") {
            error.help.emplace_back("a grammar names its turtle itself: `#set turtle abop;`");
        } else if (found.key == "weight" &&
                   std::find(known_.begin(), known_.end(), "share") != known_.end()) {
            error.help.emplace_back("the weight of a species among the others is its `share`");
        } else if (const auto nearest = nearest_name(found.key, known_)) {
            error.help.push_back(fmt::format("did you mean `{}`?", *nearest));
            if (!has(*nearest)) {
                error.fixes.push_back({fmt::format("write `{}`", *nearest),
                                       {{found.key_span, std::string(*nearest)}},
                                       false});
            }
        } else {
            error.help.push_back(fmt::format("the keys are {}", list_text(known_)));
        }
    }
}

} // namespace lsys
