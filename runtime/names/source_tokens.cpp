// SPDX-License-Identifier: MIT
#include "runtime/names/source_tokens.h"

#include "grammar/ast/include_chain.h"
#include "grammar/base/characters.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

bool is_before(const SourceToken& a, const SourceToken& b) {
    return a.begin < b.begin;
}

static_assert(static_cast<int>(SourceTokenKind::Keyword) == static_cast<int>(NameKind::Environment),
              "both begin with the same kinds of names");

void add_names(const NameIndex& index, const std::string& path, std::vector<SourceToken>& tokens) {
    for (const NameUse& use : index.uses) {
        if (use.place.path == path) {
            const bool is_sense = use.kind == NameKind::Environment;
            tokens.push_back(
                {use.place.begin, use.place.end,
                 is_sense ? SourceTokenKind::Module : static_cast<SourceTokenKind>(use.kind)});
        }
    }
}

/// Adds the keyword of a statement, and the key of a `#set`.
void add_words(const StatementOutline& statement,
               std::string_view text,
               std::vector<SourceToken>& tokens) {
    if (text.substr(statement.place.begin, 1) != "#") {
        return; // a statement of a translation has no keyword in the text
    }
    std::uint32_t end = statement.place.begin + 1;
    while (end < text.size() && is_word_character(text[end])) {
        ++end;
    }
    const bool is_named = statement.kind == StatementKind::Production &&
                          statement.name_place.begin == statement.place.begin + 1;
    if (!is_named) {
        tokens.push_back({statement.place.begin, end, SourceTokenKind::Keyword});
    }
    if (statement.kind == StatementKind::Set) {
        tokens.push_back(
            {statement.name_place.begin, statement.name_place.end, SourceTokenKind::Setting});
    }
}

/// Adds the comments of [begin, end). `//` begins a comment only between statements.
void add_comments(std::size_t begin,
                  std::size_t end,
                  bool is_statement,
                  std::string_view text,
                  std::vector<SourceToken>& tokens) {
    const std::string_view part = text.substr(0, end);
    for (std::size_t at = begin; at + 1 < end;) {
        const std::string_view sign = part.substr(at, 2);
        std::size_t after = at + 1;
        if (part[at] == '"') {
            after = std::min(part.find_first_of("\"\n", at + 1), end - 1) + 1;
        } else if (sign == "/*" || (sign == "//" && !is_statement)) {
            const std::size_t close =
                sign == "/*" ? part.find("*/", at + 2) : part.find('\n', at + 2);
            after = close == std::string_view::npos ? end : close + (sign == "/*" ? 2 : 0);
            tokens.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(after),
                              SourceTokenKind::Comment});
        }
        at = after;
    }
}

} // namespace

std::vector<SourceToken>
source_tokens(const NameIndex& index, const std::string& path, std::string_view text) {
    std::vector<SourceToken> tokens;
    add_names(index, path, tokens);
    std::vector<const StatementOutline*> statements;
    for (const StatementOutline& statement : index.statements) {
        if (statement.place.path == path) {
            statements.push_back(&statement);
            add_words(statement, text, tokens);
        }
    }
    std::sort(statements.begin(), statements.end(),
              [](const StatementOutline* a, const StatementOutline* b) {
                  return a->place.begin < b->place.begin;
              });
    std::size_t done = 0;
    for (const StatementOutline* const statement : statements) {
        const std::size_t end = std::min<std::size_t>(statement->place.end, text.size());
        add_comments(done, std::min<std::size_t>(statement->place.begin, end), false, text, tokens);
        done = std::max<std::size_t>(done, statement->place.begin);
        add_comments(done, end, true, text, tokens);
        done = std::max(done, end);
    }
    add_comments(done, text.size(), false, text, tokens);
    std::stable_sort(tokens.begin(), tokens.end(), is_before);
    std::uint32_t covered = 0;
    std::erase_if(tokens, [&covered](const SourceToken& token) {
        if (token.begin < covered || token.begin == token.end) {
            return true;
        }
        covered = token.end;
        return false;
    });
    return tokens;
}

std::vector<ColouredFile>
coloured_files(const std::string& path, std::string text, const FileLoader& load) {
    ParsedGrammar parsed;
    parse_grammar(path, std::move(text), Dialect::Lsys, load, parsed);
    const NameIndex index = index_names(parsed);
    std::vector<ColouredFile> files;
    for (std::uint32_t i = 0; i < parsed.sources.file_count(); ++i) {
        const SourceFile& file = parsed.sources.file(static_cast<FileId>(i));
        files.push_back(
            {file.path(), source_tokens(index, normalised_path(file.path()), file.text()), {}});
    }
    for (const SourceSpan& statement : parsed.statements) {
        files[static_cast<std::size_t>(statement.file)].statements.push_back(statement);
    }
    for (ColouredFile& file : files) {
        std::sort(file.statements.begin(), file.statements.end(),
                  [](const SourceSpan& a, const SourceSpan& b) { return a.begin < b.begin; });
    }
    return files;
}

} // namespace lsys
