// SPDX-License-Identifier: MIT
// Properties of the formatter for every grammar, tested on samples and random grammars, unchanged and
// with a random layout. Formatting again changes nothing, and the syntax tree stays the same.
#include "grammar/ast/ast_dump.h"
#include "grammar/format/format.h"
#include "grammar/format/impl/lexemes.h"
#include "grammar/lsys/parse.h"
#include "tests/reference/generate.h"
#include "tests/reference/print.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace lsys;

/// The syntax tree as text, without the places of statements; nullopt if the text has errors.
std::optional<std::string> tree_of(const std::string& text) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader nothing = [](const std::string&) -> Result<std::string> {
        return std::string();
    };
    const FileId file = sources.add("grammar.lsys", text);
    const Ast ast = parse_lsys(file, {sources, names, diagnostics, nothing});
    if (diagnostics.count(Severity::Error) != 0) {
        return std::nullopt;
    }
    std::istringstream lines(dump_ast(ast, names, sources));
    std::string tree;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t place = line.find_first_not_of(" 0123456789:");
        tree += line.starts_with("  ") && place != line.npos ? line.substr(place) : line;
        tree += '\n';
    }
    return tree;
}

std::vector<std::string> comments_of(const std::string& text) {
    std::vector<std::string> comments;
    for (const Lexeme& lexeme : lexemes_of(text)) {
        if (is_comment(lexeme)) {
            std::string& comment = comments.emplace_back(lexeme.text);
            // Drop the \r of line ends, since mixed line ends become one kind.
            std::erase(comment, '\r');
        }
    }
    return comments;
}

/// Gives a text a random layout: puts random blanks, line ends and comments between tokens.
class LayoutDestroyer {
public:
    enum class Manner { Blanks, Lines, Mixed };

    LayoutDestroyer(Manner manner, std::uint64_t seed) : manner_(manner), state_(seed * 2 + 1) {}

    /// `repeats`: number of copies of the modules of every production.
    std::string run(const std::string& text, int repeats) {
        std::string out;
        std::vector<Lexeme> statement;
        for (const Lexeme& lexeme : lexemes_of(text)) {
            statement.push_back(lexeme);
            if (lexeme.kind == LexemeKind::Semicolon || is_between(lexeme, statement)) {
                write(statement, repeats, out);
                statement.clear();
            }
        }
        return out;
    }

private:
    static bool is_between(const Lexeme& lexeme, const std::vector<Lexeme>& statement) {
        return statement.size() == 1 && is_comment(lexeme);
    }

    void write(const std::vector<Lexeme>& statement, int repeats, std::string& out) {
        std::size_t list = statement.size(); // the first token of the successor
        for (std::size_t i = 0; i < statement.size(); ++i) {
            list = statement[i].ends_head ? i + 1 : list;
        }
        for (std::size_t i = 0; i < list; ++i) {
            put(statement[i], out);
        }
        for (int again = 0; again < repeats; ++again) {
            for (std::size_t i = list; i + 1 < statement.size(); ++i) {
                put(statement[i], out);
            }
        }
        if (list < statement.size()) {
            put(statement.back(), out);
        }
    }

    void put(const Lexeme& lexeme, std::string& out) {
        out += lexeme.text;
        if (lexeme.kind == LexemeKind::LineComment) {
            out += '\n';
            return;
        }
        switch (manner_) {
        case Manner::Blanks:
            out += ' ';
            break;
        case Manner::Lines:
            out += '\n';
            break;
        case Manner::Mixed:
            static const char* const gaps[] = {" ",    " ",       "\n",          "   ",
                                               "\t",   " \n\n\n", " /* c */ ",   "\r\n",
                                               "\n\n", " ",       "/* a\n b */", " "};
            state_ = state_ * 6364136223846793005U + 1442695040888963407U;
            out += gaps[(state_ >> 33) % std::size(gaps)];
            break;
        }
    }

    Manner manner_;
    std::uint64_t state_;
};

/// Writes random productions with long conditions.
class ConditionWriter {
public:
    explicit ConditionWriter(std::uint64_t seed) : state_(seed * 2 + 1) {}

    std::string production(const std::string& name) {
        std::string text = "#" + name + " : A(length, width, age) : " + condition(3);
        text += next(3) == 0 ? " ~ 0.25" : "";
        if (next(2) == 0) {
            text += " : let a = " + sum() + ", b = " + sum();
        }
        return text + (next(5) == 0 ? " : ;\n" : " : F(length) [ +(30) A(length, width, age) ];\n");
    }

private:
    std::string condition(int depth) {
        std::string text;
        const std::uint64_t operands = 1 + next(5);
        for (std::uint64_t i = 0; i < operands; ++i) {
            text += i == 0 ? "" : next(2) == 0 ? " || " : " && ";
            text += depth > 0 && next(6) == 0
                        ? (next(2) == 0 ? "!(" : "(") + condition(depth - 1) + ")"
                        : sum() + (next(2) == 0 ? " > " : " <= ") + sum();
        }
        return text;
    }

    std::string sum() {
        static const char* const terms[] = {"length", "width",       "age",         "0.25*length^2",
                                            "-width", "min(age, 3)", "step()/12.5", "100"};
        std::string text;
        const std::uint64_t count = 1 + next(3);
        for (std::uint64_t i = 0; i < count; ++i) {
            text += (i == 0 ? "" : " + ") + std::string(terms[next(std::size(terms))]);
        }
        return text;
    }

    std::uint64_t next(std::uint64_t count) {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return (state_ >> 33) % count;
    }

    std::uint64_t state_;
};

/// A message about the first property that does not hold; empty if all hold.
std::string mistake_in_layout_of(const std::string& text) {
    const std::optional<std::string> before = tree_of(text);
    if (!before) {
        return "the text has errors";
    }
    const std::string once = format_text(text);
    if (tree_of(once) != before) {
        return "the tree has changed:\n" + once;
    }
    if (comments_of(once) != comments_of(text)) {
        return "a comment has changed:\n" + once;
    }
    const std::string twice = format_text(once);
    if (twice != once) {
        return "formatting again changes it:\n" + once + "----\n" + twice;
    }
    return {};
}

std::size_t check_layouts_of(std::string text, std::uint64_t seed) {
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.erase(0, 3); // remove the byte order mark
    }
    std::size_t tried = 0;
    const auto check = [&](const std::string& layout) {
        const std::string mistake = mistake_in_layout_of(layout);
        if (!mistake.empty()) {
            FAIL_CHECK(mistake << "\n---- of\n" << layout);
        }
        ++tried;
    };
    check(text);
    using Manner = LayoutDestroyer::Manner;
    for (const Manner manner : {Manner::Blanks, Manner::Lines, Manner::Mixed}) {
        for (const int repeats : {1, 2, 9}) {
            check(LayoutDestroyer(manner, seed).run(text, repeats));
        }
    }
    return tried;
}

} // namespace

TEST_CASE("formatting samples keeps their meaning, and formatting again changes nothing") {
    std::size_t tried = 0;
    for (const tests::Sample& sample : tests::all_samples()) {
        INFO(sample.file);
        tried += check_layouts_of(tests::read_text(sample.file), tried);
    }
    CHECK(tried > 400);
}

TEST_CASE("formatting random grammars keeps their meaning, and formatting again changes nothing") {
    std::size_t tried = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        INFO("seed " << seed);
        const reference::Case made = reference::generate(seed);
        for (const reference::TextFile& file :
             reference::print_grammar(made.grammar, made.layout_seed)) {
            tried += check_layouts_of(file.text, seed);
        }
    }
    CHECK(tried >= 3000);
}

TEST_CASE(
    "formatting random conditions keeps their meaning, and formatting again changes nothing") {
    std::size_t long_count = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        ConditionWriter writer(seed);
        std::string text = "#n = 1;\n#w : A(1, 2, 3);\n";
        for (const char* const name : {"p", "q", "r"}) {
            text += writer.production(name);
        }
        check_layouts_of(text, seed);
        long_count += format_text(text).find("\n        ") != std::string::npos ? 1U : 0U;
    }
    CHECK(long_count > 500); // otherwise few conditions were laid out
}
