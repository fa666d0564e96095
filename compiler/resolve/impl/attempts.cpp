// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/attempts.h"

#include "grammar/base/characters.h"

#include <algorithm>

namespace lsys {

namespace {

/// The identifier at the start of `text`, after blanks, or an empty string.
std::string_view leading_identifier(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kWhitespace), text.size()));
    std::size_t length = 0;
    while (
        length < text.size() && is_identifier(text.substr(0, 1)) &&
        (is_identifier(text.substr(length, 1)) || (text[length] >= '0' && text[length] <= '9'))) {
        ++length;
    }
    return text.substr(0, length);
}

} // namespace

AttemptedStatements::AttemptedStatements(const Resolution& resolution) {
    if (!resolution.ast.incomplete) {
        return;
    }
    for (const AstFile& file : resolution.ast.files) {
        const std::string_view text = resolution.sources.file(file.file).text();
        read_statements(text);
        read_other_notations(text);
    }
}

void AttemptedStatements::read_statements(std::string_view text) {
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at)) {
        ++at;
        const std::string_view keyword = leading_identifier(text.substr(at, 16));
        if (keyword == "define" || keyword == "param" || keyword == "function" ||
            keyword == "curve" || keyword == "sense" || keyword == "contour") {
            const std::string_view rest = text.substr(at);
            const auto end =
                static_cast<std::size_t>(keyword.data() + keyword.size() - rest.data());
            defined_names_.emplace(leading_identifier(rest.substr(end)));
        } else if (keyword == "w" || keyword == "n") {
            keywords_.emplace(keyword);
        }
    }
}

void AttemptedStatements::read_other_notations(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        const std::string_view word = leading_identifier(line);
        const std::size_t behind =
            word.empty() ? 0 : static_cast<std::size_t>(word.data() + word.size() - line.data());
        const std::size_t sign = line.find_first_not_of(" \t", behind);
        const bool has_sign =
            sign != std::string_view::npos && (line[sign] == '=' || line[sign] == ':');
        if (has_sign && (word == "n" || word == "length" || word == "iterations")) {
            keywords_.emplace("n");
        }
        if (line.starts_with("derivation")) {
            keywords_.emplace("n");
        }
        if (line.find("\u03c9") < 4 ||
            (has_sign && (word == "axiom" || word == "Axiom" || word == "start"))) {
            keywords_.emplace("w");
        }
        at = end + 1;
    }
}

bool AttemptedStatements::has(std::string_view keyword) const {
    return keywords_.contains(std::string(keyword));
}

bool AttemptedStatements::defines(std::string_view name) const {
    return defined_names_.contains(std::string(name));
}

} // namespace lsys
