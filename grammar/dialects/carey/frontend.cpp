// .rules: the rule lists of Carey's forest generator. A header holds the settings of the
// generator's form; each rule is a line `LHS=RHS:ratio`. Rewriting is cyclic, a left side may be
// several symbols, ratios are normalised.
#include "grammar/ast/reports.h"
#include "grammar/dialects/carey/reader.h"
#include "grammar/dialects/carey/writer.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <map>
#include <string>

namespace lsys {

namespace {

void write_settings(const CareyFile& file, const ParseContext& context, Translation& translation) {
    for (const CareySetting& setting : file.settings) {
        if (setting.key->name == "axiom") {
            continue;
        }
        const std::string_view value = context.sources.text(setting.value);
        if (!is_number(value, "-")) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, setting.value,
                                    "`" + shown(value) + "` is no number");
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

void write_rule(const CareyRule& rule,
                std::size_t number,
                bool chosen,
                const ParseContext& context,
                CareyWriter& writer,
                Translation& translation) {
    translation.put("#r" + std::to_string(number) + " : ", rule.left);
    writer.write(rule.left, CareyText::Left);
    translation.put(" : ", rule.left);
    if (rule.ratio) {
        const std::string_view ratio = context.sources.text(*rule.ratio);
        if (!is_number(ratio, "-")) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, *rule.ratio,
                                    "`" + shown(ratio) + "` is no ratio");
        }
    }
    if (!chosen) {
        translation.put("*", rule.left);
    } else if (rule.ratio) {
        translation.put("~ ", *rule.ratio);
        translation.copy(*rule.ratio, context.sources);
    } else {
        translation.put("~ 1", rule.left);
    }
    translation.put(" : ", rule.left);
    writer.write(rule.right, CareyText::Right);
    translation.put(";\n", {rule.right.file, rule.right.end, rule.right.end});
}

} // namespace

std::string_view recognise_carey(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return find_carey_key(text) != nullptr ? "its first line, a setting as `axiom:`,"
                                           : std::string_view();
}

void translate_carey(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const CareyFile file = read_carey(translation.file(), context);
    std::map<std::string, std::size_t> alternatives;
    bool any_choice = false;
    for (const CareyRule& rule : file.rules) {
        any_choice =
            ++alternatives[without_blanks(context.sources.text(rule.left))] > 1 || any_choice;
    }
    translation.put("#set turtle " + std::string(row.turtle) +
                    ";\n#set names letters;\n#set rewriting cyclic;\n");
    if (any_choice) {
        translation.put("#set weights any;\n");
    }
    CareyWriter writer(file, context, translation);
    write_settings(file, context, translation);
    write_axiom(file, context, writer, translation);
    translation.put("\n");
    for (std::size_t i = 0; i < file.rules.size(); ++i) {
        const CareyRule& rule = file.rules[i];
        const bool chosen = alternatives[without_blanks(context.sources.text(rule.left))] > 1;
        write_rule(rule, i + 1, chosen, context, writer, translation);
    }
}

} // namespace lsys
