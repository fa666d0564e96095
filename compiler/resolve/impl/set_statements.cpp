#include "compiler/resolve/impl/set_statements.h"

#include "compiler/resolve/impl/definitions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A key whose value is one number.
struct NumberKey {
    std::string_view key;
    float Settings::*field;
    float minimum;
    const char* wanted;
};

constexpr std::array kNumberKeys{
    NumberKey{"angle", &Settings::angle, -kInfinity, "an angle in degrees"},
    NumberKey{"step", &Settings::step, -kInfinity, "a length"},
    NumberKey{"width", &Settings::width, 0.0F, "a diameter from 0 on"},
    NumberKey{"angle_scale", &Settings::angle_scale, -kInfinity, "a factor"},
    NumberKey{"step_scale", &Settings::step_scale, -kInfinity, "a factor"},
    NumberKey{"width_scale", &Settings::width_scale, 0.0F, "a factor from 0 on"},
    NumberKey{"spring", &Settings::spring, 0.0F, "a stiffness from 0 on"},
    NumberKey{"density", &Settings::density, 0.0F, "a density from 0 on"},
    NumberKey{"damping", &Settings::damping, 0.0F, "a damping from 0 on"},
};

/// A key whose value is one whole number.
struct CountKey {
    std::string_view key;
    std::uint32_t Settings::*field;
    float minimum;
    float maximum;
    const char* wanted;
};

constexpr std::array kCountKeys{
    CountKey{"sides", &Settings::sides, 3.0F, 64.0F, "a whole number from 3 to 64"},
    CountKey{"decompose_depth", &Settings::decompose_depth, 1.0F, static_cast<float>(kMaxDepth),
             "a whole number from 1 to 100,000"},
    CountKey{"interpret_depth", &Settings::interpret_depth, 1.0F, static_cast<float>(kMaxDepth),
             "a whole number from 1 to 100,000"},
};

constexpr std::array<std::string_view, 9> kOtherKeys{
    "turtle", "names", "rewriting", "choice", "weights", "random", "tropism", "seed", "at_depth"};

/// What the front end reads.
enum class NameReading : std::uint8_t { Words, Letters, Characters };
constexpr std::array kReadings{NameReading::Words, NameReading::Letters, NameReading::Characters};
std::string_view name_of(NameReading reading) {
    constexpr std::array<std::string_view, 3> kNames{"words", "letters", "characters"};
    return kNames[static_cast<std::size_t>(reading)];
}

} // namespace

void SetResolver::read_modes() {
    for (const Statement& statement : resolution_.ast.statements) {
        if (statement.kind == StatementKind::Set) {
            const SetNode& node = resolution_.ast.sets[statement.index];
            if (is_first(node)) {
                read_mode(node, resolution_.text(node.key));
            }
        }
    }
}

/// What may be set once: `names` for each file, other keys for all.
std::uint64_t SetResolver::scope_of(const SetNode& node) const {
    const bool of_file = resolution_.text(node.key) == "names";
    const FileId file = of_file ? node.key_span.file : kNoFile;
    return (std::uint64_t{static_cast<std::uint32_t>(file)} << 32) |
           static_cast<std::uint32_t>(node.key);
}

bool SetResolver::is_first(const SetNode& node) {
    const auto [first, is_new] = first_.try_emplace(scope_of(node), node.key_span);
    if (!is_new) {
        report_duplicate(resolution_, node.key_span, first->second,
                         fmt::format("`#set {}`", resolution_.text(node.key)));
    }
    return is_new;
}

void SetResolver::read_mode(const SetNode& node, std::string_view key) {
    Settings& settings = resolution_.program.settings;
    if (key == "turtle") {
        choose(node, enumerators_of<TurtleProfile>(), settings.turtle);
    } else if (key == "rewriting") {
        choose(node, enumerators_of<RewritingMode>(), settings.rewriting);
    } else if (key == "choice") {
        choose(node, enumerators_of<ChoiceScope>(), settings.choice);
    } else if (key == "random") {
        choose(node, enumerators_of<RandomSource>(), settings.random);
    } else if (key == "weights") {
        choose(node, enumerators_of<WeightRule>(), settings.weights);
    } else if (key == "at_depth") {
        choose(node, enumerators_of<AtDepth>(), settings.at_depth);
    } else if (key == "names") {
        auto reading = NameReading::Words;
        choose(node, kReadings, reading);
        if (reading != NameReading::Words) {
            resolution_.letter_files.push_back(node.key_span.file);
        }
        if (!resolution_.ast.files.empty() && node.key_span.file == resolution_.ast.files[0].file) {
            settings.print_letters = reading != NameReading::Words;
            settings.print_characters = reading == NameReading::Characters;
        }
    } else {
        for (const std::string_view other : kOtherKeys) {
            if (key == other) {
                return;
            }
        }
        for (const NumberKey& row : kNumberKeys) {
            if (key == row.key) {
                return;
            }
        }
        for (const CountKey& row : kCountKeys) {
            if (key == row.key) {
                return;
            }
        }
        report_unknown_key(node);
    }
}

void SetResolver::report_unknown_key(const SetNode& node) {
    const std::string_view key = resolution_.text(node.key);
    std::vector<std::string_view> keys(kOtherKeys.begin(), kOtherKeys.end());
    for (const NumberKey& row : kNumberKeys) {
        keys.push_back(row.key);
    }
    for (const CountKey& row : kCountKeys) {
        keys.push_back(row.key);
    }
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::UnknownKey, node.key_span,
                                                    fmt::format("there is no setting `{}`", key));
    const std::string nearest = suggestions_.nearest(key, keys);
    if (!nearest.empty()) {
        suggest(error, node.key_span, nearest);
    } else {
        error.help.push_back(fmt::format("the settings are `{}`", fmt::join(keys, "`, `")));
    }
}

void SetResolver::bad_value(const SetNode& node, SourceSpan span, const std::string& message) {
    Diagnostic& error =
        resolution_.diagnostics.add(DiagnosticCode::BadSetting, span,
                                    fmt::format("`{}` {}", resolution_.text(node.key), message));
    if (span != node.key_span) {
        error.labels.push_back({node.key_span, "the setting"});
    }
}

/// The one word of the statement; empty after an error.
std::string_view SetResolver::word_of(const SetNode& node, const char* choices) {
    if (node.values.count != 1) {
        bad_value(node, node.key_span, fmt::format("takes one of {}", choices));
        return {};
    }
    const SetValue value = resolution_.ast.set_values[node.values.first];
    if (value.is_word) {
        return resolution_.text(value.word);
    }
    if (value.value == kNoExpression ||
        resolution_.ast.expression(value.value).kind != ExpressionKind::Error) {
        bad_value(node, value.span, fmt::format("takes one of {}", choices));
    }
    return {};
}

template <typename Enum, std::size_t size>
void SetResolver::choose(const SetNode& node, const std::array<Enum, size>& values, Enum& chosen) {
    std::vector<std::string_view> names;
    names.reserve(size);
    for (const Enum value : values) {
        names.push_back(name_of(value));
    }
    const std::string choices = fmt::format("`{}`", fmt::join(names, "`, `"));
    const std::string_view word = word_of(node, choices.c_str());
    if (word.empty()) {
        return;
    }
    for (const Enum value : values) {
        if (name_of(value) == word) {
            chosen = value;
            return;
        }
    }
    const SourceSpan span = resolution_.ast.set_values[node.values.first].span;
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadSetting, span,
        fmt::format("`{}` cannot be `{}`", resolution_.text(node.key), word));
    const std::string nearest = suggestions_.nearest(word, names);
    if (!nearest.empty()) {
        suggest(error, span, nearest);
    } else {
        error.help.push_back(fmt::format("it is one of {}", choices));
    }
}

std::optional<float>
SetResolver::number_of(const SetNode& node, std::uint32_t index, ExpressionResolver& expressions) {
    const SetValue value = resolution_.ast.set_values[node.values.first + index];
    const ValueId id =
        value.is_word ? expressions.resolve_name(value.word, value.span, ExpressionPlace::Setting)
                      : expressions.resolve(value.value, ExpressionPlace::Setting);
    return id == kPoison ? std::nullopt : expressions.constant_value(id);
}

void SetResolver::read_number(const SetNode& node, ExpressionResolver& expressions) {
    const std::string_view key = resolution_.text(node.key);
    if (first_.at(scope_of(node)) != node.key_span) {
        return; // a second one
    }
    expressions.begin_statement();
    Settings& settings = resolution_.program.settings;
    if (key == "seed") {
        read_seed(node, expressions);
        return;
    }
    if (key == "tropism") {
        if (node.values.count != 4) {
            bad_value(node, node.key_span, "takes four numbers: x, y, z and the susceptibility");
            return;
        }
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::optional<float> number = number_of(node, i, expressions);
            settings.tropism[i] = number.value_or(0.0F);
            if (number && !std::isfinite(*number)) {
                bad_value(node, node.key_span, "takes finite numbers");
                settings.tropism[i] = 0.0F;
            }
        }
        settings.has_tropism = true;
        return;
    }
    const NumberKey* row = nullptr;
    for (const NumberKey& each : kNumberKeys) {
        row = each.key == key ? &each : row;
    }
    const CountKey* count = nullptr;
    for (const CountKey& each : kCountKeys) {
        count = each.key == key ? &each : count;
    }
    if (row == nullptr && count == nullptr) {
        return; // a mode, or an unknown key
    }
    const char* wanted = row == nullptr ? count->wanted : row->wanted;
    if (node.values.count != 1) {
        bad_value(node, node.key_span, fmt::format("takes {}", wanted));
        return;
    }
    const SourceSpan span = resolution_.ast.set_values[node.values.first].span;
    const std::optional<float> number = number_of(node, 0, expressions);
    if (!number) {
        return;
    }
    if (row == nullptr) {
        if (!(*number >= count->minimum && *number <= count->maximum) ||
            *number != std::floor(*number)) {
            bad_value(node, span, fmt::format("is {}, not {}", wanted, *number));
            return;
        }
        settings.*(count->field) = static_cast<std::uint32_t>(*number);
        return;
    }
    if (!std::isfinite(*number) || *number < row->minimum) {
        bad_value(node, span, fmt::format("is {}, not {}", wanted, *number));
        return;
    }
    settings.*(row->field) = *number;
}

void SetResolver::read_seed(const SetNode& node, ExpressionResolver& expressions) {
    const char* wanted = "is a whole number from 0 to 18,446,744,073,709,551,615";
    if (node.values.count != 1) {
        bad_value(node, node.key_span, wanted);
        return;
    }
    const SetValue value = resolution_.ast.set_values[node.values.first];
    Settings& settings = resolution_.program.settings;
    const std::optional<float> number = number_of(node, 0, expressions);
    if (!value.is_word) {
        if (const auto exact = exact_whole_number(resolution_, value.value)) {
            settings.seed = *exact;
            settings.has_seed = true;
            return;
        }
    }
    if (!number) {
        return;
    }
    if (!(*number >= 0.0F && *number < 0x1p64F) || *number != std::floor(*number)) {
        bad_value(node, value.span, wanted);
        return;
    }
    settings.seed = static_cast<std::uint64_t>(*number);
    settings.has_seed = true;
}

} // namespace lsys
