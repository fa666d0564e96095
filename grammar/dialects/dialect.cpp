// SPDX-License-Identifier: MIT
#include "grammar/dialects/dialect.h"

#include "grammar/ast/reports.h"
#include "grammar/base/contract.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/other_language.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::array kRows{
    DialectRow{Dialect::Lsys, "lsys", "lsys", ".lsys", "lsys", "docs/language.md", nullptr, nullptr,
               no_system_names},
#define LSYS_DIALECT(enumerator, name, folder, title, extensions, turtle, systems)                 \
    DialectRow{Dialect::enumerator,                                                                \
               #name,                                                                              \
               title,                                                                              \
               extensions,                                                                         \
               turtle,                                                                             \
               "docs/dialects/" #folder ".md",                                                     \
               recognise_##folder,                                                                 \
               translate_##folder,                                                                 \
               systems},
#include "grammar/dialects/dialects.def"
#undef LSYS_DIALECT
};

bool has_extension(std::string_view path, std::string_view extensions) {
    while (!extensions.empty()) {
        const std::size_t end = std::min(extensions.find(' '), extensions.size());
        if (path.ends_with(extensions.substr(0, end))) {
            return true;
        }
        extensions.remove_prefix(std::min(end + 1, extensions.size()));
    }
    return false;
}

/// Whether a text has the axiom of a grammar of .lsys: `#w :`.
bool has_lsys_axiom(std::string_view text) {
    constexpr std::string_view kAxiom = "#w";
    for (std::size_t at = text.find(kAxiom); at != std::string_view::npos;
         at = text.find(kAxiom, at + 1)) {
        const std::size_t next = text.find_first_not_of(" \t", at + kAxiom.size());
        if (next != std::string_view::npos && text[next] == ':') {
            return true;
        }
    }
    return false;
}

} // namespace

std::vector<std::string> no_system_names(std::string_view /*text*/) {
    return {};
}

std::span<const DialectRow> dialects() {
    return kRows;
}

const DialectRow& row_of(Dialect dialect) {
    return kRows[static_cast<std::size_t>(dialect)];
}

std::optional<Dialect> find_dialect(std::string_view name) {
    for (const DialectRow& row : kRows) {
        if (row.name == name) {
            return row.dialect;
        }
    }
    return std::nullopt;
}

DetectedDialect detect_dialect(std::string_view path, std::string_view text) {
    // The extension alone decides, since mistakes and comments may make a text look like another
    // dialect. Only `.l` and `.ls` are extensions of several programs.
    const bool is_shared = path.ends_with(".l") || path.ends_with(".ls");
    for (const DialectRow& row : kRows) {
        if (!is_shared && has_extension(path, row.extensions)) {
            return {row.dialect, "its name"};
        }
    }
    if (is_other_program(text)) {
        return {Dialect::Lsys, "its content"}; // the front end of .lsys reports the language
    }
    // If the text fits several dialects, the extension decides.
    DetectedDialect found;
    for (const DialectRow& row : kRows) {
        const bool has_own = has_extension(path, row.extensions);
        // A dialect that has extensions, but not `.ls`, has no files `.ls`.
        const bool has_other = path.ends_with(".ls") && !row.extensions.empty() && !has_own;
        if (row.recognise == nullptr || has_other || (found.dialect && !has_own)) {
            continue;
        }
        if (const std::string_view by = row.recognise(text); !by.empty()) {
            found = {row.dialect, by};
        }
    }
    if (found.dialect) {
        return found;
    }
    if (is_unread_language(text)) {
        return {Dialect::Lsys, "its content"};
    }
    for (const DialectRow& row : kRows) {
        if (has_extension(path, row.extensions)) {
            return {row.dialect, "its name"};
        }
    }
    if (has_lsys_axiom(text)) {
        return {Dialect::Lsys, "its content"};
    }
    return {};
}

bool has_systems(Dialect dialect) {
    return row_of(dialect).systems != no_system_names;
}

std::vector<std::string> systems_in(Dialect dialect, std::string_view text) {
    return row_of(dialect).systems(text);
}

Translation translate(FileId root, Dialect dialect, const ParseContext& context) {
    const DialectRow& row = row_of(dialect);
    LSYS_CHECK(row.translate != nullptr);
    Translation translation(root);
    row.translate(row, context, translation);
    static_cast<void>(translation.report_overflow(context.diagnostics));
    return translation;
}

namespace {

/// The Ast of a file that cannot be read.
Ast no_ast(FileId root) {
    Ast ast;
    ast.files.push_back({root, {}});
    ast.incomplete = true;
    return ast;
}

} // namespace

bool check_is_lsys(FileId root, const ParseContext& context) {
    if (!check_is_text(root, context.sources, context.diagnostics)) {
        return false;
    }
    const std::string_view text = context.sources.file(root).text();
    const std::optional<OtherLanguage> other = recognise_other_language(text);
    if (other) {
        Diagnostic& diagnostic = context.diagnostics.add(
            DiagnosticCode::OtherLanguage, {root, other->begin, other->end},
            "this looks like " + other->name + ", not like a .lsys grammar");
        diagnostic.help.push_back(other->help);
    }
    return !other;
}

Ast parse_dialect(FileId root, Dialect dialect, const ParseContext& context, std::string* text) {
    if (dialect == Dialect::Lsys) {
        return check_is_lsys(root, context) ? parse_lsys(root, context) : no_ast(root);
    }
    if (!check_is_text(root, context.sources, context.diagnostics)) {
        return no_ast(root);
    }
    const Translation translation = translate(root, dialect, context);
    if (context.diagnostics.has_errors()) {
        return no_ast(root);
    }
    if (text != nullptr) {
        *text = translation.text();
    }
    return parse_translation(translation, context);
}

} // namespace lsys
