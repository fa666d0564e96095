// SPDX-License-Identifier: MIT
#include "grammar/dialects/carey/writer.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"

#include <algorithm>

namespace lsys {

namespace {

/// Symbols that the forest generator reserves for its instancing.
constexpr std::string_view kReserved = "@$<>";

} // namespace

std::string remove_blanks(std::string_view text) {
    std::string bare(text);
    std::erase_if(bare, [](char c) { return kWhitespace.find(c) != std::string_view::npos; });
    return bare;
}

CareyWriter::CareyWriter(const CareyFile& file,
                         const ParseContext& context,
                         Translation& translation)
    : context_(context), translation_(translation) {
    for (const CareyRule& rule : file.rules) {
        left_sides_.push_back(remove_blanks(context.sources.text(rule.left)));
    }
    std::sort(left_sides_.begin(), left_sides_.end());
    left_sides_.erase(std::unique(left_sides_.begin(), left_sides_.end()), left_sides_.end());
}

bool CareyWriter::check_symbol(const LetterModule& module) {
    Diagnostics& diagnostics = context_.diagnostics;
    const bool ascii = module.character < 0x80;
    const char c = ascii ? static_cast<char>(module.character) : '?';
    if (ascii && kReserved.find(c) != std::string_view::npos) {
        diagnostics.add(DiagnosticCode::ForeignSyntax, module.span,
                        std::string("`") + c + "` is reserved for instancing");
        return false;
    }
    if (c == ',') {
        diagnostics.add(DiagnosticCode::ForeignSyntax, module.span,
                        "`,` is not a symbol: it ends the rule for the forest generator");
        return false;
    }
    if (c == '(' || c == ')') {
        diagnostics.add(DiagnosticCode::ForeignSyntax, module.span,
                        std::string("`") + c + "` belongs to no symbol");
        return false;
    }
    return true;
}

void CareyWriter::check_arguments(const LetterModule& module) {
    const std::string_view arguments = context_.sources.text(module.arguments);
    for (const std::string& left : left_sides_) {
        if (arguments.find(left) != std::string_view::npos) {
            context_.diagnostics.add(
                DiagnosticCode::ForeignFeature, join(module.span, module.arguments),
                "the left side `" + shown(left) + "` matches a part of this module only");
            return;
        }
    }
}

void CareyWriter::write_arguments(const LetterModule& module, CareyText kind) {
    const std::string_view text = context_.sources.text(module.arguments);
    if (kind == CareyText::Left) {
        context_.diagnostics.add(DiagnosticCode::ForeignFeature, module.arguments,
                                 "a left side with parentheses is not supported");
        return;
    }
    check_arguments(module);
    if (remove_blanks(text) == "(#)" && kind == CareyText::Right) {
        translation_.put("(step() + 1)", module.arguments);
        return;
    }
    if (const std::size_t comma = text.find(','); comma != std::string_view::npos) {
        const auto at = static_cast<std::uint32_t>(module.arguments.begin + comma);
        context_.diagnostics.add(DiagnosticCode::ForeignQuirk, {module.arguments.file, at, at + 1},
                                 "the forest generator ends a rule at a comma; here it separates "
                                 "parameters");
    }
    static_cast<void>(write_plain_arguments(module.arguments, context_, translation_));
}

void CareyWriter::write(SourceSpan text, CareyText kind) {
    read_letter_modules(text, context_, [&](const LetterModule& module) {
        if (!check_symbol(module)) {
            return;
        }
        const bool has_arguments = module.arguments.begin != module.arguments.end;
        if (module.character == U'#' && kind == CareyText::Right && !has_arguments) {
            context_.diagnostics.add(
                DiagnosticCode::ForeignQuirk, module.span,
                "outside of parentheses `#` is the age, which the forest generator writes as "
                "digits; here it is the parameter of a module");
            translation_.put("`#`(step() + 1)", module.span);
            return;
        }
        write_letter(module, context_, translation_);
        if (has_arguments) {
            write_arguments(module, kind);
        }
    });
}

} // namespace lsys
