// SPDX-License-Identifier: MIT
// .rules: the rule lists of Carey's forest generator. A header holds the text fields of the
// generator's window; each rule is a line `LHS=RHS:ratio`. Rewriting is cyclic: each generation
// applies the rules of one left side, in turn. A left side may be several symbols. The ratios of a
// left side are divided by their sum.
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/dialects/carey/parameters.h"
#include "grammar/dialects/carey/reader.h"
#include "grammar/dialects/carey/writer.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys {

namespace {

void write_settings(const CareyFile& file, const ParseContext& context, Translation& translation) {
    for (const CareySetting& setting : file.settings) {
        if (setting.key->name == "axiom") {
            continue;
        }
        const std::string_view value = context.sources.text(setting.value);
        if (!is_number(value, "-")) {
            context.diagnostics.add(DiagnosticCode::ForeignValue, setting.value,
                                    "`" + shown(value) + "` is not a number");
            continue;
        }
        const std::string name(setting.key->lsys);
        translation.put(name.empty() ? "#n = " : "#set " + name + " ", setting.place);
        translation.copy(setting.value, context.sources);
        translation.put(";\n");
    }
}

void write_axiom(const CareyFile& file,
                 const ParseContext& context,
                 CareyWriter& writer,
                 Translation& translation) {
    bool any = false;
    for (const CareySetting& setting : file.settings) {
        if (setting.key->name == "axiom") {
            any = true;
            translation.put("\n#w : ", setting.place);
            writer.write(setting.value, CareyText::Axiom);
            translation.put(";\n");
        }
    }
    if (!any && !context.diagnostics.has_errors()) {
        const SourceSpan end{translation.file(), 0, 0};
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, end,
                                "the file has no line `axiom: ...`");
    }
}

/// Properties of the selection of a rule that depend on the other rules.
struct RuleSelection {
    std::size_t number = 0;        // number of the rule in its file, from 1
    bool has_alternatives = false; // other rules have the same left side
    /// Condition that is true in the generations in which the rule has its turn. If empty,
    /// `rewriting cyclic` decides.
    std::string condition;
};

/// Writes the condition and the probability of a rule.
void write_choice(const CareyRule& rule,
                  const RuleSelection& selection,
                  const ParseContext& context,
                  Translation& translation) {
    if (!selection.has_alternatives) {
        translation.put(selection.condition.empty() ? "*" : selection.condition, rule.left);
        return;
    }
    translation.put(selection.condition.empty() ? "" : selection.condition + " ", rule.left);
    if (rule.ratio) {
        translation.put("~ ", *rule.ratio);
        translation.copy(*rule.ratio, context.sources);
    } else {
        translation.put("~ 1", rule.left);
    }
}

/// Writes a rule as a production whose left side ends in a module with `parameters` parameters. The
/// last module of the rule's right side gets these parameters.
void write_production(const CareyRule& rule,
                      const RuleSelection& selection,
                      std::size_t parameters,
                      const ParseContext& context,
                      CareyWriter& writer,
                      Translation& translation) {
    std::string formals;
    for (std::size_t i = 1; i <= parameters; ++i) {
        formals += (i == 1 ? "(x" : ", x") + std::to_string(i);
    }
    formals += parameters == 0 ? "" : ")";
    const std::string name = std::to_string(selection.number) +
                             (parameters == 0 ? "" : "p" + std::to_string(parameters));
    translation.put("#r" + name + " : ", rule.left);
    writer.write(rule.left, CareyText::Left);
    translation.put(formals + " : ", rule.left);
    write_choice(rule, selection, context, translation);
    translation.put(" : ", rule.left);
    writer.write(rule.right, CareyText::Right);
    if (parameters > 0) {
        translation.put(formals, rule.right);
    }
    translation.put(";\n", {rule.right.file, rule.right.end, rule.right.end});
}

void write_rules(const CareyFile& file,
                 const ParseContext& context,
                 CareyWriter& writer,
                 const LeftParameters& parameters,
                 Translation& translation) {
    std::map<std::string, std::size_t> alternatives;
    std::map<std::string, std::size_t> turns; // index of each left side, in file order
    std::vector<std::string> left_sides;
    for (const CareyRule& rule : file.rules) {
        left_sides.push_back(remove_blanks(context.sources.text(rule.left)));
        ++alternatives[left_sides.back()];
        turns.emplace(left_sides.back(), turns.size());
    }
    for (std::size_t i = 0; i < file.rules.size(); ++i) {
        const CareyRule& rule = file.rules[i];
        if (rule.ratio && !is_number(context.sources.text(*rule.ratio), "-")) {
            context.diagnostics.add(DiagnosticCode::ForeignValue, *rule.ratio,
                                    "`" + shown(context.sources.text(*rule.ratio)) +
                                        "` is not a ratio");
        }
        RuleSelection selection{i + 1, alternatives[left_sides[i]] > 1, {}};
        if (parameters.has_counts && turns.size() > 1) {
            selection.condition = "mod(step(), " + std::to_string(turns.size()) +
                                  ") == " + std::to_string(turns[left_sides[i]]);
        }
        write_production(rule, selection, 0, context, writer, translation);
        for (const std::size_t count : parameters.counts_by_rule[i]) {
            write_production(rule, selection, count, context, writer, translation);
        }
    }
}

} // namespace

std::string_view recognise_carey(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    text.remove_prefix(std::min(text.find_first_not_of(kWhitespace), text.size()));
    return find_carey_key(text) != nullptr ? "its first line, a setting as `axiom:`,"
                                           : std::string_view();
}

void translate_carey(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const CareyFile file = read_carey(translation.file(), context);
    std::set<std::string> left_sides;
    bool any_choice = false;
    for (const CareyRule& rule : file.rules) {
        const bool is_new =
            left_sides.insert(remove_blanks(context.sources.text(rule.left))).second;
        any_choice = any_choice || !is_new;
    }
    const LeftParameters parameters = find_left_parameters(file, context);
    // With `rewriting cyclic`, `F` and `F(x)` would be rewritten in different turns; the forest
    // generator rewrites them in one turn.
    translation.put("#set turtle " + std::string(row.turtle) +
                    ";\n#set names letters;\n#set rewriting " +
                    (parameters.has_counts ? "leftmost" : "cyclic") + ";\n");
    if (any_choice) {
        translation.put("#set weights any;\n");
    }
    CareyWriter writer(file, context, translation);
    write_settings(file, context, translation);
    write_axiom(file, context, writer, translation);
    translation.put("\n");
    write_rules(file, context, writer, parameters, translation);
}

} // namespace lsys
