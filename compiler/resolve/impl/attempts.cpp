#include "compiler/resolve/impl/attempts.h"

#include <algorithm>

namespace lsys {

namespace {

/// The identifier at the start of `text`, after blanks, or an empty string.
std::string_view leading_identifier(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
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
        read(resolution.sources.file(file.file).text());
    }
}

void AttemptedStatements::read(std::string_view text) {
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at)) {
        ++at;
        const std::string_view keyword = leading_identifier(text.substr(at, 16));
        if (keyword == "define" || keyword == "param") {
            const std::string_view rest = text.substr(at);
            const auto end =
                static_cast<std::size_t>(keyword.data() + keyword.size() - rest.data());
            constants_.emplace(leading_identifier(rest.substr(end)));
        } else if (keyword == "w" || keyword == "n") {
            keywords_.emplace(keyword);
        }
    }
}

bool AttemptedStatements::has(std::string_view keyword) const {
    return keywords_.contains(std::string(keyword));
}

bool AttemptedStatements::defines(std::string_view name) const {
    return constants_.contains(std::string(name));
}

} // namespace lsys
