// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/environments.h"

#include "compiler/resolve/impl/definitions.h"
#include "compiler/resolve/known_words.h"
#include "grammar/base/counted_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::array<const char*, 5> kTurtleAnswers{"place", "heading", "up", "right", "left"};
constexpr std::string_view kSenseExample = "for example `#sense light shadow cell 0.5;`";

/// "`shadow` and `sky`".
std::string kinds_with(const EnvironmentKey& key) {
    std::vector<std::string> kinds;
    for (const EnvironmentKind kind : enumerators_of<EnvironmentKind>()) {
        if (key.belongs_to(kind)) {
            kinds.push_back(fmt::format("`{}`", name_of(kind)));
        }
    }
    return fmt::format("{}", fmt::join(kinds, " and "));
}

} // namespace

std::vector<std::string_view> sense_keys() {
    std::vector<std::string_view> keys;
    for (const EnvironmentKey& key : environment_keys()) {
        keys.push_back(key.word);
    }
    return keys;
}

// --- names

void EnvironmentResolver::declare_all() {
    for (std::size_t i = 0; i < kTurtleSenses.size(); ++i) {
        const NameId name = resolution_.names.find(sense_name(kTurtleSenses.substr(i, 1)));
        if (name != kNoName) {
            const auto sense = static_cast<std::uint32_t>(Sense::Position) + i;
            symbols_.set_sense(name, static_cast<Sense>(sense));
            declared_[name] = true;
        }
    }
    bool has_too_many = false;
    for (const Statement& statement : resolution_.ast.statements) {
        if (statement.kind != StatementKind::Sense) {
            continue;
        }
        const SenseNode& node = resolution_.ast.senses[statement.index];
        std::vector<ProgramEnvironment>& environments = resolution_.program.environments;
        if (!check_free_name(node)) {
            continue;
        }
        if (environments.size() == kMaxEnvironments) {
            if (!std::exchange(has_too_many, true)) {
                resolution_.diagnostics.add(
                    DiagnosticCode::BadEnvironment, node.name_span,
                    fmt::format("a grammar has at most {} environments", kMaxEnvironments));
            }
            declared_[resolution_.names.find(sense_name(resolution_.text(node.name)))] = true;
            continue;
        }
        const auto number = static_cast<std::uint32_t>(environments.size());
        const NameId module = resolution_.names.find(sense_name(resolution_.text(node.name)));
        symbols_.set_sense(module, static_cast<Sense>(number));
        declared_[module] = true;
        numbers_[statement.index] = number;
        ProgramEnvironment& environment = environments.emplace_back();
        environment.name = node.name;
        environment.name_span = node.name_span;
    }
}

bool EnvironmentResolver::check_free_name(const SenseNode& node) {
    const std::string_view name = resolution_.text(node.name);
    const std::size_t turtle = name.size() == 1 ? kTurtleSenses.find(name) : std::string_view::npos;
    if (turtle != std::string_view::npos) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadEnvironment, node.name_span,
            fmt::format("`?{}` asks the turtle for its {}", name, kTurtleAnswers[turtle]));
        error.help.emplace_back("`P`, `H`, `U`, `R` and `L` are not free; give the environment "
                                "another name");
        return false;
    }
    const std::vector<FileId>& letters = resolution_.letter_files;
    const bool is_letters =
        std::find(letters.begin(), letters.end(), node.name_span.file) != letters.end();
    if (is_letters && (name.size() > 1 || name == "_")) {
        resolution_.diagnostics
            .add(DiagnosticCode::BadEnvironment, node.name_span,
                 "with `#set names letters` the name of an environment is one letter")
            .notes.push_back(
                fmt::format("`?{}` is read as `?{}` and further modules", name, name.substr(0, 1)));
        declared_[resolution_.names.find(sense_name(name))] = true;
        return false;
    }
    const auto [first, is_new] = first_.try_emplace(node.name, node.name_span);
    if (!is_new) {
        report_duplicate(resolution_, node.name_span, first->second,
                         fmt::format("environment `{}`", name));
    }
    return is_new;
}

bool EnvironmentResolver::check_name(NameId module, SourceSpan span) {
    const std::string_view text = resolution_.text(module);
    if (!is_sense_name(text) || declared_.contains(module)) {
        return true;
    }
    const std::string_view name = text.substr(1);
    if (expressions_.may_be_missing(name) ||
        !resolution_.diagnostics.admits(DiagnosticCode::UnknownEnvironment)) {
        return false;
    }
    std::vector<std::string> senses;
    for (const ProgramEnvironment& environment : resolution_.program.environments) {
        senses.push_back(sense_name(resolution_.text(environment.name)));
    }
    for (std::size_t i = 0; i < kTurtleSenses.size(); ++i) {
        senses.push_back(sense_name(kTurtleSenses.substr(i, 1)));
    }
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::UnknownEnvironment, span,
                                                    fmt::format("no `#sense` declares `{}`", text));
    const std::string nearest = suggestions_.nearest(text, {senses.begin(), senses.end()});
    if (!nearest.empty()) {
        suggest(error, span, nearest);
    } else if (name == "E") {
        error.help.emplace_back("`?E` of cpfg asks an external program: declare it by `#sense E "
                                "program;`");
    } else {
        error.help.push_back(fmt::format("declare it by `#sense {} KIND;`; the kinds are `{}`",
                                         name, fmt::join(environment_kind_names(), "`, `")));
    }
    return false;
}

// --- statements

void EnvironmentResolver::environment(std::uint32_t index) {
    const SenseNode& node = resolution_.ast.senses[index];
    const auto number = numbers_.find(index);
    ProgramEnvironment unused; // environment of a statement whose name is in error
    unused.name = node.name;
    ProgramEnvironment& environment =
        number == numbers_.end() ? unused : resolution_.program.environments[number->second];
    expressions_.begin_statement();
    const std::optional<EnvironmentKind> kind = read_kind(node);
    if (!kind) {
        return;
    }
    environment.values.kind = *kind;
    const Reading reading = read_entries(node, *kind);
    for (const Entry& entry : reading.entries) {
        read_entry(entry, environment);
    }
    check_missing_keys(reading, environment);
}

std::optional<EnvironmentKind> EnvironmentResolver::read_kind(const SenseNode& node) {
    const std::string_view name = resolution_.text(node.name);
    if (node.values.count == 0) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadEnvironment, node.name_span,
            find_environment_kind(name)
                ? fmt::format("`{}` stands in the place of a name; the kind comes after it", name)
                : fmt::format("environment `{}` has no kind", name));
        error.help.push_back(
            fmt::format("the kinds are `{}`", fmt::join(environment_kind_names(), "`, `")));
        error.help.emplace_back(kSenseExample);
        return std::nullopt;
    }
    const SetValue& first = resolution_.ast.set_values[node.values.first];
    if (first.is_word) {
        if (const auto kind = find_environment_kind(resolution_.text(first.word))) {
            return kind;
        }
    }
    report_unknown_kind(first, node.name_span);
    return std::nullopt;
}

void EnvironmentResolver::report_unknown_kind(const SetValue& value, SourceSpan name) {
    const std::vector<std::string_view> kinds = environment_kind_names();
    if (!value.is_word) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadEnvironment, value.span,
            "a kind comes after the name of an environment, not a value");
        error.labels.push_back({name, "the name"});
        error.help.push_back(fmt::format("the kinds are `{}`", fmt::join(kinds, "`, `")));
        return;
    }
    const std::string_view word = resolution_.text(value.word);
    const EnvironmentKey* const key = find_environment_key(word);
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadEnvironment, value.span,
        key != nullptr ? fmt::format("`{}` is a key; the kind comes before it", word)
                       : fmt::format("there is no kind of environment `{}`", word));
    if (key != nullptr) {
        error.labels.push_back({name, "the name"});
        error.help.push_back(fmt::format(
            "{} {} a key `{}`", kinds_with(*key),
            kinds_with(*key).find(" and ") == std::string::npos ? "has" : "have", word));
        return;
    }
    const std::string nearest = suggestions_.nearest(word, kinds);
    if (!nearest.empty()) {
        suggest(error, value.span, nearest);
    } else {
        error.help.push_back(fmt::format("the kinds are `{}`", fmt::join(kinds, "`, `")));
    }
}

EnvironmentResolver::Reading EnvironmentResolver::read_entries(const SenseNode& node,
                                                               EnvironmentKind kind) {
    Reading reading;
    reading.kind = kind;
    reading.kind_span = resolution_.ast.set_values[node.values.first].span;
    const ListRange range{node.values.first + 1, node.values.count - 1};
    if (range.count != 0 && !resolution_.ast.set_values[range.first].is_word) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadEnvironment, resolution_.ast.set_values[range.first].span,
            "a key comes after the kind, not a value");
        error.help.push_back(kind == EnvironmentKind::Program
                                 ? "an environment of kind `program` has no keys"
                                 : fmt::format("the keys of `{}` are `{}`", name_of(kind),
                                               fmt::join(environment_keys_of(kind), "`, `")));
        reading.is_complete = false;
    }
    // After a key that takes a shape or a file, a word that is no key is the value of that key; a
    // file name without quotes is reported later.
    const auto is_value = [&](const SetValue& word, const KeyedValues& before) {
        const EnvironmentKey* const key = find_environment_key(resolution_.text(before.key));
        return key != nullptr && before.values.count == 0 &&
               (key->form == EnvironmentKeyForm::Shape || key->form == EnvironmentKeyForm::Meshes ||
                key->form == EnvironmentKeyForm::Picture) &&
               find_environment_key(resolution_.text(word.word)) == nullptr;
    };
    std::unordered_map<const EnvironmentKey*, SourceSpan> first_of;
    for (const KeyedValues& written : split_keyed_values(resolution_.ast, range, is_value)) {
        const std::string_view word = resolution_.text(written.key);
        const EnvironmentKey* const key = find_environment_key(word);
        std::vector<Entry>& entries = reading.entries;
        const bool is_known = key != nullptr && key->belongs_to(kind);
        const bool repeats = is_known && !key->may_repeat() && first_of.contains(key);
        if ((!is_known || repeats) && !entries.empty() && lacks_value(entries.back(), kind) &&
            expressions_.is_constant(written.key)) {
            report_bare_constant(resolution_, DiagnosticCode::BadEnvironment,
                                 {written.span, true, written.key});
            entries.pop_back(); // the key whose value the constant was meant to be
            continue;
        }
        if (!is_known) {
            report_unknown_key(written, kind);
            reading.is_complete = false;
        } else if (repeats) {
            report_duplicate(resolution_, written.span, first_of.at(key),
                             fmt::format("`{}` of one environment", word));
        } else {
            first_of.try_emplace(key, written.span);
            entries.push_back({key, written});
        }
    }
    return reading;
}

bool EnvironmentResolver::lacks_value(const Entry& entry, EnvironmentKind kind) const {
    return entry.written.values.count < value_count(*entry.key, kind);
}

void EnvironmentResolver::report_unknown_key(const KeyedValues& word, EnvironmentKind kind) {
    const std::string_view name = resolution_.text(word.key);
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::UnknownKey, word.span,
        fmt::format("an environment of kind `{}` has no key `{}`", name_of(kind), name));
    if (kind == EnvironmentKind::Program) {
        error.help.emplace_back("it has no keys: the program is an option of the command line, "
                                "`--environment NAME=COMMAND`");
        return;
    }
    const std::vector<std::string_view> keys = environment_keys_of(kind);
    if (const EnvironmentKey* const key = find_environment_key(name)) {
        error.notes.push_back(fmt::format("`{}` is a key of {}", name, kinds_with(*key)));
        error.help.push_back(
            fmt::format("the keys of `{}` are `{}`", name_of(kind), fmt::join(keys, "`, `")));
        return;
    }
    if (const std::string nearest = suggestions_.nearest(name, keys); !nearest.empty()) {
        suggest(error, word.span, nearest);
        return;
    }
    error.help.push_back(
        fmt::format("the keys of `{}` are `{}`", name_of(kind), fmt::join(keys, "`, `")));
}

void EnvironmentResolver::check_missing_keys(const Reading& reading,
                                             const ProgramEnvironment& environment) {
    const auto has = [&](std::string_view word) {
        return std::any_of(reading.entries.begin(), reading.entries.end(),
                           [&](const Entry& entry) { return entry.key->word == word; });
    };
    const auto entry_of = [&](std::string_view word) {
        return std::find_if(reading.entries.begin(), reading.entries.end(),
                            [&](const Entry& entry) { return entry.key->word == word; });
    };
    const bool is_mesh = environment.values.shape == SpaceShape::Mesh;
    if (is_mesh && has("size")) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadEnvironment, entry_of("size")->written.span,
            "a mesh has its own size: `size` cannot stand beside it");
        error.labels.push_back({value(*entry_of("shape"), 0).span, "the mesh"});
        error.help.emplace_back("the mesh is used as it is modelled, in metres, moved by `at`");
    }
    if (!reading.is_complete) {
        return;
    }
    std::vector<std::string> missing;
    const EnvironmentKey* only_missing = nullptr;
    for (const EnvironmentKey& key : environment_keys()) {
        if (key.is_required_by(reading.kind) && !has(key.word) &&
            !(key.word == "size" && is_mesh)) {
            missing.push_back(fmt::format("`{}`", key.word));
            only_missing = &key;
        }
    }
    if (reading.kind == EnvironmentKind::Solid && !has("mesh") && !has("plane")) {
        missing.emplace_back("a `mesh` or a `plane`");
    }
    if (missing.empty()) {
        return;
    }
    std::string list = missing.front();
    for (std::size_t i = 1; i < missing.size(); ++i) {
        list += (i + 1 == missing.size() ? " and " : ", ") + missing[i];
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadEnvironment, reading.kind_span,
        fmt::format("an environment of kind `{}` needs {}", name_of(reading.kind), list));
    if (missing.size() == 1 && only_missing != nullptr) {
        error.help.push_back(fmt::format("`{}` takes {}", only_missing->word,
                                         wanted_text(*only_missing, reading.kind)));
    }
    constexpr std::array<std::string_view, kCountOf<EnvironmentKind>> kExamples{
        "",
        "",
        "space shape ball size 4 4 4 at 0 2 0 count 5000 radius 1 kill 0.3",
        "crowd radius 1",
        "solid mesh \"wall.obj\"",
        "map file \"soil.png\" size 10 10",
        ""};
    const std::string_view example = kExamples[static_cast<std::size_t>(reading.kind)];
    error.help.push_back(
        fmt::format("for example `#sense {} {};`", resolution_.text(environment.name), example));
}

} // namespace lsys
