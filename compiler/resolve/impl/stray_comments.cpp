// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/stray_comments.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace lsys {

namespace {

/// Max file size in bytes; larger files are not searched.
constexpr std::size_t kMaxSearched = std::size_t{1} << 20;

std::string_view line_at(std::string_view text, std::size_t at) {
    const std::string_view line = text.substr(at, text.find('\n', at) - at);
    return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

/// The modules of `text` up to the next `:` or `;`. Arguments with their parentheses, and comments
/// `/* ... */`, are replaced by blanks.
std::string without_arguments(std::string_view text) {
    std::string modules;
    std::size_t depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text.substr(at, 2) == "/*") {
            at = std::min(text.find("*/", at + 2), text.size() - 2) + 1;
            modules += ' ';
            continue;
        }
        if (depth == 0 && (text[at] == ':' || text[at] == ';')) {
            break; // the rest is another part or statement
        }
        depth += text[at] == '(' ? 1U : 0U;
        modules += depth == 0 ? text[at] : ' ';
        depth -= text[at] == ')' && depth > 0 ? 1U : 0U;
    }
    return modules;
}

/// Calls visit(word) for each identifier of `text`.
template <typename Visit>
void for_each_word(std::string_view text, const Visit& visit) {
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && is_word_character(text[end])) {
            ++end;
        }
        if (end != at && is_letter(text[at])) {
            visit(text.substr(at, end - at));
        }
        at = std::max(end, at + 1);
    }
}

/// The words of a file outside of comments `/* ... */` and before `//` in their line.
class FileWords {
public:
    FileWords(std::string_view text, bool letters) {
        for (std::size_t at = 0; at < text.size();) {
            if (text.substr(at, 2) == "//") {
                at = std::min(text.find('\n', at), text.size());
            } else if (text.substr(at, 2) == "/*") {
                at = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
            } else {
                const std::size_t end = std::min(text.find('/', at + 1), text.size());
                for_each_word(text.substr(at, end - at), [&](std::string_view word) {
                    words_.insert(word);
                    if (letters) {
                        letters_.insert(word.begin(), word.end());
                    }
                });
                at = end;
            }
        }
    }

    [[nodiscard]] bool has(std::string_view word) const { return words_.count(word) != 0; }
    /// Whether the file has the word with two neighbouring letters exchanged.
    [[nodiscard]] bool has_with_exchanged_letters(std::string_view word) const {
        std::string other(word);
        for (std::size_t i = 0; i + 1 < other.size(); ++i) {
            std::swap(other[i], other[i + 1]);
            if (has(other)) {
                return true;
            }
            std::swap(other[i], other[i + 1]);
        }
        return false;
    }
    /// For a file with `names letters`: whether a word looks like part of a remark, because all or
    /// at least three of its letters occur in no word of the file.
    [[nodiscard]] bool has_foreign_letters(std::string_view word) const {
        const auto foreign = std::count_if(
            word.begin(), word.end(), [&](char letter) { return letters_.count(letter) == 0; });
        return foreign >= 3 || foreign == static_cast<std::ptrdiff_t>(word.size());
    }

private:
    std::unordered_set<std::string_view> words_;
    std::unordered_set<char> letters_; // letters of all words, only with `names letters`
};

/// `text`, the rest of a line, without its comments `/* ... */`.
std::string without_comments(std::string_view text) {
    std::string rest;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t open = std::min(text.find("/*", at), text.size());
        rest += text.substr(at, open - at);
        const std::size_t close = text.find("*/", std::min(open + 2, text.size()));
        at = close == std::string_view::npos ? text.size() : close + 2;
        rest += ' ';
    }
    return rest;
}

class CommentSearch {
public:
    CommentSearch(Resolution& resolution, const std::vector<bool>& known, NameSplitter& splitter)
        : resolution_(resolution), known_(known), splitter_(splitter) {}

    /// Whether `comment`, the text after a `//`, is meant as a comment: outside of parentheses it
    /// has a word of several letters that is not a module. With `names letters` the word has at
    /// least three letters, or two such words follow each other. Single letters may be modules
    /// that no production names, as in a derived word that is pasted as an axiom.
    [[nodiscard]] bool is_comment(std::string_view comment, FileId file) {
        bool found = false;
        bool was_foreign = false;
        const std::string words = without_arguments(comment);
        for_each_word(words, [&](std::string_view word) {
            const bool foreign = word.size() > 1 && is_foreign(word, file);
            const std::size_t enough = is_letters(file) ? 3 : 2;
            found = found || (foreign && (was_foreign || word.size() >= enough));
            was_foreign = foreign;
        });
        return found;
    }

    /// Whether the `//` at `at` stands between modules without blanks, as in `F//A`, in a file whose
    /// letters are modules. People write a blank before or after the `//` of a comment.
    [[nodiscard]] bool is_within_modules(std::string_view text, std::size_t at, FileId file) const {
        const auto is_module = [&](std::size_t place) {
            return place < text.size() && kWhitespace.find(text[place]) == kWhitespace.npos;
        };
        return is_letters(file) && at > 0 && is_module(at - 1) && is_module(at + 2);
    }

    /// Whether the text after a `//` may be modules with a mistake among them: it has a name of
    /// several letters that occurs elsewhere in the file.
    [[nodiscard]] bool may_be_modules(std::string_view comment, FileId file) {
        bool found = false;
        for_each_word(without_arguments(comment), [&](std::string_view word) {
            found = found || (word.size() > 1 && (is_known(word) || words_of(file).has(word)));
        });
        return found;
    }

private:
    /// Whether the file has `names letters` or `names characters`.
    [[nodiscard]] bool is_letters(FileId file) const {
        return std::ranges::find(resolution_.letter_files, file) != resolution_.letter_files.end();
    }

    [[nodiscard]] const FileWords& words_of(FileId file) {
        const auto found = files_.find(file);
        return found != files_.end()
                   ? found->second
                   : files_
                         .emplace(file, FileWords(resolution_.sources.file(file).text(),
                                                  is_letters(file)))
                         .first->second;
    }

    [[nodiscard]] bool is_known(std::string_view name) const {
        const NameId id = resolution_.names.find(name);
        return id != kNoName && index_of(id) < known_.size() && known_[index_of(id)];
    }

    /// Whether the word is neither a known module name, nor in the file outside its comments, nor
    /// such names written together.
    [[nodiscard]] bool is_foreign(std::string_view word, FileId file) {
        const FileWords& words = words_of(file);
        if (is_letters(file)) {
            return !words.has(word) && words.has_foreign_letters(word);
        }
        if (is_known(word) || words.has(word) || words.has_with_exchanged_letters(word)) {
            return false;
        }
        const NameId id = resolution_.names.find(word);
        if (id == kNoName || index_of(id) >= known_.size() || !splitter_.may_split(id)) {
            return true;
        }
        // without_arguments() has removed the arguments: try each number of them.
        constexpr std::uint32_t kMaxParameters = 8;
        for (std::uint32_t count = 0; count <= kMaxParameters; ++count) {
            if (!splitter_.parts(id, count, file).empty()) {
                return false;
            }
        }
        return true;
    }

    Resolution& resolution_;
    const std::vector<bool>& known_; // by name: it is a known module name
    NameSplitter& splitter_;
    std::map<FileId, FileWords> files_;
};

} // namespace

void check_stray_comments(Resolution& resolution,
                          const std::vector<bool>& known,
                          NameSplitter& splitter) {
    CommentSearch search(resolution, known, splitter);
    for (const SourceSpan slashes : resolution.ast.slashes) {
        const std::string_view text = resolution.sources.file(slashes.file).text();
        if (text.size() > kMaxSearched) {
            continue;
        }
        const std::string_view line = line_at(text, slashes.begin);
        const std::string rest =
            without_comments(line.substr(std::min<std::size_t>(2, line.size())));
        if (!search.is_within_modules(text, slashes.begin, slashes.file) &&
            search.is_comment(rest, slashes.file)) {
            report_stray_comment(resolution.diagnostics, line, slashes,
                                 search.may_be_modules(rest, slashes.file));
        }
    }
}

} // namespace lsys
