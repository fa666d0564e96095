#include "grammar/dialects/sys/frontend.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/sys/session.h"
#include "sys/parser.h"

#include <charconv>
#include <map>
#include <string>

namespace lsys {

namespace {

/// The modules of a word of the file.
void write_modules(SourceSpan text, const ParseContext& context, Translation& translation) {
    read_letter_modules(text, context, [&](const LetterModule& module) {
        write_letter(module, context, translation);
        if (module.arguments.begin != module.arguments.end) {
            write_plain_arguments(module.arguments, context, translation);
        }
    });
}

/// The number of rules of the file, beside those that are there.
void check_count(const SysSession& session) {
    if (!session.count) {
        return;
    }
    const std::string_view text = session.context.sources.text(*session.count);
    std::uint32_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size()) {
        session.context.diagnostics.add(DiagnosticCode::ForeignSyntax, *session.count,
                                        "expected the number of rules, saw `" + shown(text) + "`");
    } else if (count != session.rules.size() && !session.context.diagnostics.has_errors()) {
        session.context.diagnostics.add(DiagnosticCode::ForeignSyntax, *session.count,
                                        "the file says that it has " + std::string(text) +
                                            " rules, and has " +
                                            std::to_string(session.rules.size()));
    }
}

void write_rule(const SysRule& rule,
                std::size_t number,
                bool certain,
                SysSession& session,
                Translation& translation) {
    const ParseContext& context = session.context;
    const SourceSpan whole = join(rule.symbol, rule.probability);
    int modules = 0;
    SourceSpan second;
    translation.put("#r" + std::to_string(number) + " : ", whole);
    read_letter_modules(rule.symbol, context, [&](const LetterModule& module) {
        second = ++modules == 2 ? module.span : second;
        if (module.arguments.begin != module.arguments.end) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, module.arguments,
                                    "the symbol that a rule replaces has no parameters");
        }
        write_letter(module, context, translation);
    });
    if (modules > 1) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, second,
                                "a rule replaces one symbol");
    }
    translation.put(" : ", rule.symbol);
    const std::string_view probability = context.sources.text(rule.probability);
    if (literal_length(probability) != probability.size()) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, rule.probability,
                                "`" + shown(probability) + "` is no probability");
    }
    if (certain) {
        translation.put("*", rule.probability);
    } else {
        translation.put("~ ", rule.probability);
        translation.copy(rule.probability, context.sources);
    }
    translation.put(" : ", rule.replacement);
    write_modules(rule.replacement, context, translation);
    translation.put(";\n", {whole.file, whole.end, whole.end});
}

} // namespace

int SysSession::at_end() {
    const bool first = !ended_;
    ended_ = true;
    return first ? sys_grammar::Parser::token::TOK_NEWLINE : sys_grammar::Parser::token::TOK_END;
}

std::string_view recognise_sys(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    constexpr std::string_view kHeader = "LSYSTEM";
    if (begin == std::string_view::npos || text.substr(begin, kHeader.size()) != kHeader) {
        return {};
    }
    const std::string_view rest = text.substr(begin + kHeader.size());
    return rest.empty() || rest.find_first_of(" \t\r\n") == 0 ? "its first word, `LSYSTEM`"
                                                              : std::string_view();
}

Translation translate_sys(FileId root, const ParseContext& context) {
    SysSession session(root, context);
    {
        const SysScanning scanning(session, context.sources.file(root).text());
        sys_grammar::Parser parser(session, scanning.scanner());
        static_cast<void>(parser.parse()); // what is wrong has been reported
    }
    Translation translation(root);
    check_count(session);
    if (!session.axiom) {
        return translation;
    }
    translation.put("#set turtle sys;\n#set names letters;\n\n#w : ");
    write_modules(*session.axiom, context, translation);
    translation.put(";\n\n");
    std::map<std::string_view, std::size_t> alternatives;
    for (const SysRule& rule : session.rules) {
        ++alternatives[context.sources.text(rule.symbol)];
    }
    for (std::size_t i = 0; i < session.rules.size(); ++i) {
        const SysRule& rule = session.rules[i];
        const std::string_view probability = context.sources.text(rule.probability);
        const bool certain = alternatives[context.sources.text(rule.symbol)] == 1 &&
                             literal_length(probability) == probability.size() &&
                             read_literal(probability).value == 1.0F;
        write_rule(rule, i + 1, certain, session, translation);
    }
    return translation;
}

} // namespace lsys
