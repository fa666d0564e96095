// SPDX-License-Identifier: MIT
// write_syntax: fills the words of the language into the templates of this folder, which makes the
// syntax files of editors.
// Usage: write_syntax [--check] EDITORS     EDITORS: the folder editors/ of the sources
//   --check: writes nothing; exit status 1 if a file differs from what its template gives
// In a template `@LIST:FORM@` stands for all words of a member of LanguageWords, in a form:
//   regex `a|b`, vim `a\|b`, words `a b`, lisp `"a" "b"`, items `<item>a</item>` on lines of their own
#include "runtime/languageserver/language_words.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Templates and the files made from them, in the folder editors/.
constexpr std::array<std::pair<const char*, const char*>, 4> kFiles{{
    {"syntax/lsys.tmLanguage.json.in", "vscode/syntaxes/lsys.tmLanguage.json"},
    {"syntax/lsys.vim.in", "vim/syntax/lsys.vim"},
    {"syntax/lsys-mode.el.in", "emacs/lsys-mode.el"},
    {"syntax/lsys.xml.in", "kate/lsys.xml"},
}};

/// The texts before and after each word of a list, and between two words.
struct Form {
    std::string_view before;
    std::string_view after;
    std::string_view between;
};

const std::map<std::string_view, Form> kForms{
    {"regex", {"", "", "|"}},
    {"vim", {"", "", "\\|"}},
    {"words", {"", "", " "}},
    {"lisp", {"\"", "\"", " "}},
    {"items", {"      <item>", "</item>", "\n"}},
};

std::string joined(const Words& words, const Form& form) {
    std::string text;
    for (const std::string& word : words) {
        text += text.empty() ? "" : form.between;
        text += form.before;
        text += word;
        text += form.after;
    }
    return text;
}

/// The text that replaces `LIST:FORM`; nullopt if one of the two names is unknown.
std::optional<std::string> filled(std::string_view name,
                                  const std::map<std::string, Words>& lists) {
    const std::size_t colon = name.find(':');
    if (colon == std::string_view::npos) {
        return std::nullopt;
    }
    const auto list = lists.find(std::string(name.substr(0, colon)));
    const auto form = kForms.find(name.substr(colon + 1));
    if (list == lists.end() || form == kForms.end()) {
        return std::nullopt;
    }
    return joined(list->second, form->second);
}

/// Replaces `@LIST:FORM@`; other texts between two `@` stay.
std::string fill(std::string_view text, const std::map<std::string, Words>& lists) {
    std::string result;
    while (true) {
        const std::size_t begin = text.find('@');
        result += text.substr(0, begin);
        if (begin == std::string_view::npos) {
            return result;
        }
        const std::size_t end = text.find('@', begin + 1);
        const auto words = end == std::string_view::npos
                               ? std::nullopt
                               : filled(text.substr(begin + 1, end - begin - 1), lists);
        result += words ? *words : "@";
        text.remove_prefix(words ? end + 1 : begin + 1);
    }
}

std::optional<std::string> read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return in ? std::optional(text.str()) : std::nullopt;
}

std::map<std::string, Words> word_lists() {
    lsys::LanguageWords words = lsys::language_words();
    // All statements but those for which templates have rules of their own.
    Words values = words.statements;
    std::erase_if(values, [](const std::string& word) {
        return word == "w" || word == "ignore" || word == "consider" || word == "decompose" ||
               word == "interpret" || word == "down" || word == "up" || word == "set" ||
               word == "material" || word == "sense";
    });
    return {{"statements", words.statements}, {"value_statements", values},
            {"functions", words.functions},   {"settings", words.settings},
            {"values", words.values},         {"material_keys", words.material_keys},
            {"sense_keys", words.sense_keys}, {"sense_kinds", words.sense_kinds},
            {"objects", words.objects},       {"commands", words.commands}};
}

int run(const fs::path& editors, bool checks) {
    const auto lists = word_lists();
    int status = 0;
    for (const auto& [source, target] : kFiles) {
        const std::optional<std::string> text = read(editors / source);
        if (!text) {
            std::cerr << fmt::format("write_syntax: cannot read {}\n", (editors / source).string());
            return 2;
        }
        const std::string contents = fill(*text, lists);
        if (checks && read(editors / target) != contents) {
            std::cerr << fmt::format(
                "write_syntax: editors/{} is not what editors/{} and the tables "
                "of the compiler give: run write_syntax editors\n",
                target, source);
            status = 1;
        } else if (!checks) {
            std::ofstream out(editors / target, std::ios::binary);
            if (!(out << contents << std::flush)) {
                std::cerr << fmt::format("write_syntax: cannot write {}\n",
                                         (editors / target).string());
                return 2;
            }
        }
    }
    return status;
}

} // namespace

int main(int count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    const bool checks = !words.empty() && words.front() == "--check";
    if (words.size() != (checks ? 2U : 1U)) {
        std::cerr << "usage: write_syntax [--check] EDITORS\n";
        return 2;
    }
    return run(words.back(), checks);
}
