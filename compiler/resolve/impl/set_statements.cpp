// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/set_statements.h"

#include "compiler/resolve/impl/definitions.h"
#include "grammar/base/synonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsys {

namespace {

/// The keys, in the order in which messages list them.
constexpr auto kSettingKeys = std::to_array<std::string_view>({
#define LSYS_CHOICE(type, field, initial, effect, group) #field,
#define LSYS_STATEMENT(key) #key,
#include "compiler/bytecode/settings.def"
#define LSYS_NUMBER(field, initial, effect, group, min, wanted) #field,
#include "compiler/bytecode/settings.def"
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit) #field,
#include "compiler/bytecode/settings.def"
});

/// Smaller densities are probably meant in g/cm³.
constexpr float kMinLikelyDensity = 2.0F;

/// The value of `#set names`: the way in which a text without blanks is split into module names.
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
            if (check_first_setting(node)) {
                read_mode(node, resolution_.text(node.key));
            }
        }
    }
    Settings& settings = resolution_.program.settings;
    settings.traits = traits_of(settings.turtle);
}

std::uint64_t SetResolver::scope_of(const SetNode& node) const {
    const bool of_file = resolution_.text(node.key) == "names";
    const FileId file = of_file ? node.key_span.file : kNoFile;
    return (std::uint64_t{static_cast<std::uint32_t>(file)} << 32) |
           static_cast<std::uint32_t>(node.key);
}

bool SetResolver::check_first_setting(const SetNode& node) {
    const auto [first, is_new] = first_.try_emplace(scope_of(node), node.key_span);
    if (!is_new) {
        report_duplicate(resolution_, node.key_span, first->second,
                         fmt::format("`#set {}`", resolution_.text(node.key)));
    }
    return is_new;
}

void SetResolver::read_mode(const SetNode& node, std::string_view key) {
    Settings& settings = resolution_.program.settings;
#define LSYS_CHOICE(type, field, initial, effect, group)                                           \
    if (key == #field) {                                                                           \
        choose(node, enumerators_of<type>(), settings.field);                                      \
        return;                                                                                    \
    }
#include "compiler/bytecode/settings.def"
    if (key == "names") {
        auto reading = NameReading::Words;
        choose(node, kReadings, reading);
        const std::vector<AstFile>& files = resolution_.ast.files;
        const FileId root = files.empty() ? kNoFile : files[0].file;
        const FileId file = origin_ == Origin::Options ? root : node.key_span.file;
        std::erase(resolution_.letter_files, file);
        if (reading != NameReading::Words) {
            resolution_.letter_files.push_back(file);
        }
        if (file == root) {
            settings.print_letters = reading != NameReading::Words;
            settings.print_characters = reading == NameReading::Characters;
        }
    } else if (std::ranges::find(kSettingKeys, key) == kSettingKeys.end()) {
        report_unknown_key(node);
    }
}

void SetResolver::report_unknown_key(const SetNode& node) {
    const std::string_view key = resolution_.text(node.key);
    const std::vector<std::string_view> keys(kSettingKeys.begin(), kSettingKeys.end());
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::UnknownKey, node.key_span,
                                                    fmt::format("there is no setting `{}`", key));
    if (const Synonym* const synonym = find_synonym(SynonymKind::Setting, key)) {
        if (synonym->spelling.starts_with('#')) {
            report_statement_for_key(node, *synonym, error);
            return;
        }
        error.help.push_back(help_for(*synonym, key));
        if (synonym->spelling == "tropism" && node.values.count == 1) {
            explain_tropism(node, error);
        } else if (!synonym->spelling.empty()) {
            add_fix(error, fmt::format("write `{}`", synonym->spelling), node.key_span,
                    std::string(synonym->spelling), false);
        }
        return;
    }
    const std::string nearest = suggestions_.nearest(key, keys);
    if (!nearest.empty()) {
        suggest(error, node.key_span, nearest);
    } else {
        error.help.push_back(fmt::format("the settings are `{}`", fmt::join(keys, "`, `")));
    }
}

/// Explains `#set iterations 6;`: the equivalent in .lsys is a statement, not a setting.
void SetResolver::report_statement_for_key(const SetNode& node,
                                           const Synonym& synonym,
                                           Diagnostic& error) const {
    error.help.emplace_back(synonym.advice);
    const std::string_view text = resolution_.sources.file(node.key_span.file).text();
    const std::size_t hash = text.rfind('#', node.key_span.begin);
    if (hash != std::string_view::npos && node.key_span.begin - hash < 16 &&
        node.values.count == 1) {
        const SourceSpan value = resolution_.ast.set_values[node.values.first].span;
        const std::string start(synonym.spelling);
        add_fix(error, fmt::format("write `{} {};`", start, resolution_.sources.text(value)),
                {node.key_span.file, static_cast<std::uint32_t>(hash), node.key_span.end}, start,
                false);
    }
}

void SetResolver::explain_tropism(const SetNode& node, Diagnostic& error) const {
    const SourceSpan span = resolution_.ast.set_values[node.values.first].span;
    std::string_view number = resolution_.sources.text(span);
    const bool is_negative = number.starts_with('-');
    number.remove_prefix(is_negative ? 1 : 0);
    if (number.empty() || number.find_first_not_of("0123456789.") != std::string_view::npos) {
        return;
    }
    error.help.emplace_back("the direction of the pull comes first, then its strength; `0 -1 0` is "
                            "down");
    const std::string values = fmt::format("tropism 0 -1 0 {}", number);
    add_fix(error, fmt::format("write `#set {};`", values),
            {span.file, node.key_span.begin, span.end}, values, false);
}

Diagnostic&
SetResolver::report_bad_value(const SetNode& node, SourceSpan span, const std::string& message) {
    Diagnostic& error =
        resolution_.diagnostics.add(DiagnosticCode::BadSetting, span,
                                    fmt::format("`{}` {}", resolution_.text(node.key), message));
    if (span != node.key_span) {
        error.labels.push_back({node.key_span, "the setting"});
    }
    return error;
}

std::string_view SetResolver::word_of(const SetNode& node, const char* choices) {
    if (node.values.count != 1) {
        report_bad_value(node, node.key_span, fmt::format("takes one of {}", choices));
        return {};
    }
    const SetValue value = resolution_.ast.set_values[node.values.first];
    if (value.is_word) {
        return resolution_.text(value.word);
    }
    if (value.value == kNoExpression ||
        resolution_.ast.expression(value.value).kind != ExpressionKind::Error) {
        report_bad_value(node, value.span, fmt::format("takes one of {}", choices));
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
        return; // a duplicate, which read_modes() has reported
    }
    expressions.begin_statement();
    Settings& settings = resolution_.program.settings;
    if (key == "seed") {
        read_seed(node, expressions);
    } else if (key == "tropism") {
        read_tropism(node, expressions);
    } else if (key == "tropisms") {
        read_tropisms(node, expressions);
    } else if (key == "height") {
        read_height(node, expressions);
    } else if (key == "pipe") {
        read_pipe(node, expressions);
    } else if (key == "flare") {
        read_flare(node, expressions);
    } else if (key == "spring") {
        read_spring(node, expressions);
    }
    // The rows of settings.def follow. Any further key is a mode or unknown, see read_modes().
#define LSYS_NUMBER(field, initial, effect, group, min, wanted)                                    \
    else if (key == #field) {                                                                      \
        const NumberRange range{min, -kLowestNumber, false, wanted};                               \
        settings.field = read_one(node, range, expressions).value_or(settings.field);              \
    }
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    else if (key == #field) {                                                                      \
        const NumberRange range{min, max, true, wanted};                                           \
        if (const std::optional<float> number = read_one(node, range, expressions)) {              \
            settings.field = static_cast<std::uint32_t>(*number);                                  \
        }                                                                                          \
    }
#include "compiler/bytecode/settings.def"
    if (key == "density" && node.values.count == 1 && settings.density > 0.0F &&
        settings.density < kMinLikelyDensity) {
        Diagnostic& warning = resolution_.diagnostics.add(
            DiagnosticCode::UnlikelyDensity, resolution_.ast.set_values[node.values.first].span,
            fmt::format("a density of {} kg/m³ is less than that of any wood", settings.density));
        add_fix(warning, fmt::format("{} g/cm³ is `{}`", settings.density, settings.density * 1000),
                warning.span, fmt::format("{}", settings.density * 1000), false);
    }
}

/// The only number of the statement, if it is within the range.
std::optional<float> SetResolver::read_one(const SetNode& node,
                                           const NumberRange& range,
                                           ExpressionResolver& expressions) {
    if (node.values.count != 1) {
        report_bad_value(node, node.key_span, fmt::format("takes {}", range.wanted));
        return std::nullopt;
    }
    const SourceSpan span = resolution_.ast.set_values[node.values.first].span;
    const std::optional<float> number = number_of(node, 0, expressions);
    if (number && (!(*number >= range.min && *number <= range.max) ||
                   (range.is_whole && *number != std::floor(*number)))) {
        report_bad_value(node, span, fmt::format("is {}, not {}", range.wanted, *number));
        return std::nullopt;
    }
    return number;
}

void SetResolver::read_tropism(const SetNode& node, ExpressionResolver& expressions) {
    Settings& settings = resolution_.program.settings;
    if (node.values.count != settings.tropism.size()) {
        Diagnostic& error = report_bad_value(node, node.key_span,
                                             "takes four numbers: x, y, z and the susceptibility");
        if (node.values.count == 1) {
            explain_tropism(node, error);
        } else {
            error.help.emplace_back(
                "for example `#set tropism 0 -1 0 0.2;`, a pull down of strength 0.2");
        }
        return;
    }
    for (std::uint32_t i = 0; i < settings.tropism.size(); ++i) {
        const std::optional<float> number = number_of(node, i, expressions);
        settings.tropism[i] = number.value_or(0.0F);
        if (number && !std::isfinite(*number)) {
            report_bad_value(node, node.key_span, "takes finite numbers");
        }
    }
    settings.has_tropism = true;
}

void SetResolver::read_tropisms(const SetNode& node, ExpressionResolver& expressions) {
    constexpr std::uint32_t kMinNumbers = 3; // x, y, z
    constexpr std::uint32_t kMaxNumbers = 6; // x, y, z, strength, increment, angle
    const auto kind_at = [&](std::uint32_t index) {
        const SetValue value = resolution_.ast.set_values[node.values.first + index];
        const std::string_view word = value.is_word ? resolution_.text(value.word) : "";
        TropismKind found = TropismKind::None;
        for (const TropismKind each : enumerators_of<TropismKind>()) {
            found = !word.empty() && name_of(each) == word ? each : found;
        }
        return found;
    };
    StepTropisms tropisms;
    std::size_t count = 0;
    bool has_after = false;
    for (std::uint32_t at = 0; at < node.values.count || count == 0;) {
        const std::uint32_t first = at;
        const TropismKind kind = at < node.values.count ? kind_at(at++) : TropismKind::None;
        std::array<float, kMaxNumbers> numbers{};
        std::uint32_t number_count = 0;
        while (at < node.values.count && number_count < kMaxNumbers &&
               kind_at(at) == TropismKind::None) {
            numbers[number_count++] = number_of(node, at++, expressions).value_or(0.0F);
        }
        const bool is_valid =
            kind != TropismKind::None && number_count >= kMinNumbers &&
            (kind == TropismKind::Before || number_count < kMaxNumbers) &&
            !(kind == TropismKind::After && has_after) && count < tropisms.size() &&
            std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); });
        if (!is_valid) {
            Diagnostic& error = report_bad_value(
                node, first < node.values.count ? value_span(node, first) : node.key_span,
                "takes up to 11 groups: `after`, once, `before` or `twist`, then x, y, z, and "
                "perhaps strength and increment; `before` also an angle");
            error.help.emplace_back("for example `#set tropisms before 0 1 0 0.1;`");
            return;
        }
        has_after = has_after || kind == TropismKind::After;
        tropisms[count++] = {
            kind, {numbers[0], numbers[1], numbers[2]}, numbers[3], numbers[4], numbers[5]};
    }
    resolution_.program.settings.tropisms = tropisms;
}

void SetResolver::read_height(const SetNode& node, ExpressionResolver& expressions) {
    const NumberRange range{kMinHeight, kMaxHeight, false,
                            "a height in metres from 0.000001 to 1,000,000"};
    if (const std::optional<float> height = read_one(node, range, expressions)) {
        resolution_.program.settings.height = *height;
        resolution_.program.height_span = node.key_span;
    }
}

SourceSpan SetResolver::value_span(const SetNode& node, std::uint32_t index) const {
    return resolution_.ast.set_values[node.values.first + index].span;
}

std::optional<std::array<float, 3>> SetResolver::read_two_or_three(
    const SetNode& node, const char* wanted, ExpressionResolver& expressions) {
    std::array<float, 3> numbers{};
    if (node.values.count < 2 || node.values.count > numbers.size()) {
        report_bad_value(node, node.key_span, wanted);
        return std::nullopt;
    }
    bool all = true;
    for (std::uint32_t i = 0; i < node.values.count; ++i) {
        const std::optional<float> number = number_of(node, i, expressions);
        numbers[i] = number.value_or(0.0F);
        all = all && number.has_value();
    }
    return all ? std::optional(numbers) : std::nullopt;
}

void SetResolver::read_pipe(const SetNode& node, ExpressionResolver& expressions) {
    const auto numbers = read_two_or_three(
        node, "takes two numbers, the exponent and the width of a tip, and perhaps a taper",
        expressions);
    if (!numbers) {
        return;
    }
    const auto [exponent, width, taper] = *numbers;
    if (!(exponent >= kMinPipeExponent && exponent <= kMaxPipeExponent)) {
        report_bad_value(node, value_span(node, 0),
                         fmt::format("begins with an exponent from 1 to 4, not {}", exponent));
    } else if (!(width >= 0.0F && std::isfinite(width))) {
        report_bad_value(
            node, value_span(node, 1),
            fmt::format("has the width of a tip, from 0 on, as second number, not {}", width));
    } else if (!(taper >= 0.0F && taper <= 1.0F)) {
        report_bad_value(node, value_span(node, 2),
                         fmt::format("ends with a taper from 0 to 1, not {}", taper));
    } else {
        resolution_.program.settings.pipe = {exponent, width, taper};
        resolution_.program.pipe_span = node.key_span;
    }
}

void SetResolver::read_flare(const SetNode& node, ExpressionResolver& expressions) {
    const auto numbers = read_two_or_three(
        node,
        "takes two numbers, the factor at the ground and the height where the flare begins, and "
        "perhaps a number of roots",
        expressions);
    if (!numbers) {
        return;
    }
    const auto [factor, height, roots] = *numbers;
    const bool has_roots = node.values.count == 3;
    if (!(factor >= 1.0F && factor <= kMaxFlare)) {
        report_bad_value(node, value_span(node, 0),
                         fmt::format("begins with a factor from 1 to 10, not {}", factor));
    } else if (!(height > 0.0F && std::isfinite(height))) {
        report_bad_value(
            node, value_span(node, 1),
            fmt::format("has a height in metres above 0 as second number, not {}", height));
    } else if (has_roots &&
               !(roots >= static_cast<float>(kMinRoots) && roots <= static_cast<float>(kMaxRoots) &&
                 roots == std::floor(roots))) {
        report_bad_value(
            node, value_span(node, 2),
            fmt::format("ends with a whole number of roots from 3 to 9, not {}", roots));
    } else {
        resolution_.program.settings.flare = {factor, height, static_cast<std::uint32_t>(roots)};
    }
}

void SetResolver::read_spring(const SetNode& node, ExpressionResolver& expressions) {
    if (node.values.count == 1) {
        const SetValue value = resolution_.ast.set_values[node.values.first];
        if (value.is_word && resolution_.text(value.word) == "auto") {
            return;
        }
    }
    const NumberRange range{0.0F, -kLowestNumber, false, "`auto` or a stiffness from 0 on"};
    if (const std::optional<float> number = read_one(node, range, expressions)) {
        resolution_.program.settings.has_spring = true;
        resolution_.program.settings.spring = *number;
    }
}

void SetResolver::read_seed(const SetNode& node, ExpressionResolver& expressions) {
    const char* wanted = "is a whole number from 0 to 18,446,744,073,709,551,615";
    if (node.values.count != 1) {
        report_bad_value(node, node.key_span, wanted);
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
        report_bad_value(node, value.span, wanted);
        return;
    }
    settings.seed = static_cast<std::uint64_t>(*number);
    settings.has_seed = true;
}

} // namespace lsys
