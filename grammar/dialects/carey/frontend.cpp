#include "grammar/dialects/carey/frontend.h"

#include "carey/parser.h"
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/carey/session.h"
#include "grammar/dialects/carey/writer.h"

#include <array>
#include <map>
#include <string>

namespace lsys {

namespace {

/// A setting of the form, and of .lsys; empty: the axiom and the number of generations, which are
/// statements.
struct Key {
    std::string_view name;
    std::string_view lsys;
};
constexpr std::array kKeys{
    Key{"axiom", ""},          Key{"generations", ""},
    Key{"angle", "angle"},     Key{"angle_scale", "angle_scale"},
    Key{"step", "step"},       Key{"step_scale", "step_scale"},
    Key{"thickness", "width"}, Key{"thickness_scale", "width_scale"},
    Key{"seed", "seed"},
};

/// The name before the colon, without blanks.
std::string_view name_of(const CareySetting& setting, const SourceMap& sources) {
    const std::string_view key = sources.text(setting.key);
    return key.substr(0, key.find_first_of(" \t:"));
}

bool is_number(std::string_view text) {
    text.remove_prefix(!text.empty() && text[0] == '-' ? 1 : 0);
    return !text.empty() && literal_length(text) == text.size();
}

void write_settings(const CareySession& session, Translation& translation) {
    const ParseContext& context = session.context;
    for (const CareySetting& setting : session.settings) {
        const std::string_view name = name_of(setting, context.sources);
        const std::string_view value = context.sources.text(setting.value);
        if (name == "axiom") {
            continue;
        }
        if (!is_number(value)) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, setting.value,
                                    "`" + shown(value) + "` is no number");
            continue;
        }
        std::string begin = "#n = ";
        for (const Key& key : kKeys) {
            if (key.name == name && !key.lsys.empty()) {
                begin = "#set " + std::string(key.lsys) + " ";
            }
        }
        translation.put(begin, setting.key);
        translation.copy(setting.value, context.sources);
        translation.put(";\n");
    }
}

void write_axiom(const CareySession& session, CareyWriter& writer, Translation& translation) {
    bool any = false;
    for (const CareySetting& setting : session.settings) {
        if (name_of(setting, session.context.sources) == "axiom") {
            any = true;
            translation.put("\n#w : ", setting.key);
            writer.write(setting.value, CareyText::Axiom);
            translation.put(";\n");
        }
    }
    if (!any && !session.context.diagnostics.has_errors()) {
        const SourceSpan end{translation.file(), 0, 0};
        session.context.diagnostics.add(DiagnosticCode::ForeignSyntax, end,
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
        if (!is_number(ratio)) {
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

int CareySession::at_end() {
    const bool first = !ended_;
    ended_ = true;
    return first ? carey_grammar::Parser::token::TOK_NEWLINE
                 : carey_grammar::Parser::token::TOK_END;
}

void CareySession::no_equals(SourceSpan name, SourceSpan colon, bool is_rule) const {
    if (is_rule) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, colon,
                                "the ratio of a rule stands behind its right side");
        return;
    }
    const std::string_view text = context.sources.text(name);
    Diagnostic& error =
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, name,
                                "`" + shown(text) + "` is no setting, and a rule has a `=`");
    std::string names;
    for (const Key& key : kKeys) {
        names += (names.empty() ? "`" : ", `") + std::string(key.name) + "`";
    }
    error.help.push_back("the settings are " + names);
}

std::string_view recognise_carey(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) {
        return {};
    }
    text.remove_prefix(begin);
    for (const Key& key : kKeys) {
        if (text.starts_with(key.name)) {
            const std::size_t colon = text.find_first_not_of(" \t", key.name.size());
            if (colon != std::string_view::npos && text[colon] == ':') {
                return "its first line, a setting as `axiom:`,";
            }
        }
    }
    return {};
}

Translation translate_carey(FileId root, const ParseContext& context) {
    CareySession session(root, context);
    {
        const CareyScanning scanning(session, context.sources.file(root).text());
        carey_grammar::Parser parser(session, scanning.scanner());
        static_cast<void>(parser.parse()); // what is wrong has been reported
    }
    std::map<std::string, std::size_t> alternatives;
    bool any_choice = false;
    for (const CareyRule& rule : session.rules) {
        any_choice =
            ++alternatives[without_blanks(context.sources.text(rule.left))] > 1 || any_choice;
    }
    Translation translation(root);
    translation.put("#set turtle carey;\n#set names letters;\n#set rewriting cyclic;\n");
    if (any_choice) {
        translation.put("#set weights any;\n");
    }
    CareyWriter writer(session, translation);
    write_settings(session, translation);
    write_axiom(session, writer, translation);
    translation.put("\n");
    for (std::size_t i = 0; i < session.rules.size(); ++i) {
        const CareyRule& rule = session.rules[i];
        const bool chosen = alternatives[without_blanks(context.sources.text(rule.left))] > 1;
        write_rule(rule, i + 1, chosen, context, writer, translation);
    }
    return translation;
}

} // namespace lsys
