// SPDX-License-Identifier: MIT
#include "tests/fuzz/grammar_mutator.h"

#include "tests/reference/generate.h"
#include "tests/reference/print.h"
#include "tests/reference/random.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <vector>

namespace {

using lsys::reference::Random;
using Pieces = std::vector<std::string>;

/// Texts that have a meaning in many places of a grammar.
constexpr std::array<std::string_view, 64> kTexts{"0",
                                                  "1",
                                                  "2",
                                                  "0.5",
                                                  "-1",
                                                  "4",
                                                  "100",
                                                  "1e30",
                                                  "1e-30",
                                                  "16777217",
                                                  "0.1",
                                                  "(x)",
                                                  "(x+1)",
                                                  "(x, y)",
                                                  "(1)",
                                                  "({0, 1})",
                                                  "(2^x)",
                                                  "x > 0",
                                                  "x < 3",
                                                  "x == 1",
                                                  "* ~ 0.5",
                                                  "~ x",
                                                  "[",
                                                  "]",
                                                  "[ + A ]",
                                                  "{",
                                                  "}",
                                                  ".",
                                                  "+",
                                                  "-",
                                                  "&",
                                                  "^",
                                                  "\\",
                                                  "/",
                                                  "|",
                                                  "!",
                                                  "'",
                                                  "F",
                                                  "f",
                                                  "%",
                                                  "A",
                                                  "B",
                                                  "A < B",
                                                  "B > C",
                                                  "A < B > C",
                                                  "?P(0, 0, 0)",
                                                  "?H",
                                                  "step()",
                                                  "steps()",
                                                  "min(x, 1)",
                                                  "sin(x)",
                                                  "floor(x)",
                                                  "normal(0, 1)",
                                                  "?s(0, 0, 0, 0)",
                                                  "`a`",
                                                  "!= 0",
                                                  "&& x > 1",
                                                  "|| x < 0",
                                                  "x ? 1 : 2",
                                                  "let z = x;",
                                                  "\n",
                                                  "// c\n",
                                                  "/* c */",
                                                  "@"};

constexpr std::array<std::string_view, 28> kStatements{
    "#set rewriting sequential;",
    "#set rewriting leftmost;",
    "#set rewriting cyclic;",
    "#set choice generation;",
    "#set names letters;",
    "#set names characters;",
    "#set turtle cpfg;",
    "#set turtle abop;",
    "#set turtle houdini;",
    "#set random glibc;",
    "#set seed 7;",
    "#set angle 30;",
    "#set at_depth stop;",
    "#set decompose_depth 3;",
    "#set interpret_depth 2;",
    "#set weights any;",
    "#ignore : + -;",
    "#consider : F;",
    "#sense s space shape ball size 2 2 2 count 30 radius 0.4 kill 0.2;",
    "#sense l shadow cell 0.25;",
    "#define k 2;",
    "#param q 1 {0, 4};",
    "#function g(a) a*2;",
    "#curve c (0, 0) (1, 1);",
    "#decompose d : D(x) : x > 0 : F D(x-1);",
    "#interpret i : L : * : [ F + F ];",
    "#down o : B : * : B;",
    "#object L LEAF;",
};

bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}
bool is_blank(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Cuts a text into names and numbers, runs of blanks, comments, and single characters.
Pieces tokens_of(std::string_view text) {
    Pieces tokens;
    while (!text.empty()) {
        std::size_t length = 1;
        const auto while_true = [&](bool (*holds)(char)) {
            while (length < text.size() && holds(text[length])) {
                ++length;
            }
        };
        if (is_name(text[0])) {
            while_true(is_name);
        } else if (is_blank(text[0])) {
            while_true(is_blank);
        } else if (text.starts_with("//")) {
            length = std::min(text.find('\n'), text.size());
        } else if (text.starts_with("/*")) {
            length = std::min(std::min(text.find("*/", 2), text.size()) + 2, text.size());
        }
        tokens.emplace_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return tokens;
}

/// Cuts a text behind each `;`.
Pieces statements_of(std::string_view text) {
    Pieces statements;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size() - 1) + 1;
        statements.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return statements;
}

std::string joined(const Pieces& pieces) {
    std::string text;
    for (const std::string& piece : pieces) {
        text += piece;
    }
    return text;
}

/// A random grammar that is one file.
std::string random_grammar(Random& random) {
    const lsys::reference::Case made = lsys::reference::generate(random.word());
    return lsys::reference::print_grammar(made.grammar, random.below(2) == 0 ? 0 : random.word())[0]
        .text;
}

/// The kind of a token by its first character; tokens of one kind replace each other.
int kind_of(const std::string& token) {
    const char c = token[0];
    return std::isdigit(static_cast<unsigned char>(c)) != 0 ? 0
           : is_name(c)                                     ? 1
           : is_blank(c)                                    ? 2
                                                            : 3;
}

void change_tokens(Pieces& tokens, Random& random) {
    const std::size_t at = random.below(tokens.size());
    const std::size_t other = random.below(tokens.size());
    const auto place = tokens.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random.below(7)) {
    case 0: // replaces a token by another one of the same kind
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const std::string& found = tokens[(other + i) % tokens.size()];
            if (kind_of(found) == kind_of(tokens[at]) && found != tokens[at]) {
                tokens[at] = found;
                return;
            }
        }
        return;
    case 1:
        tokens[at] = kTexts[random.below(kTexts.size())];
        return;
    case 2:
        tokens.insert(place, " " + std::string(kTexts[random.below(kTexts.size())]) + " ");
        return;
    case 3:
        tokens.erase(place);
        return;
    case 4:
        std::swap(tokens[at], tokens[other]);
        return;
    case 5: { // repeats a run of tokens elsewhere
        const std::size_t end = std::min(tokens.size(), other + 1 + random.below(12));
        const Pieces run(tokens.begin() + static_cast<std::ptrdiff_t>(other),
                         tokens.begin() + static_cast<std::ptrdiff_t>(end));
        tokens.insert(place, run.begin(), run.end());
        return;
    }
    default: // replaces the next number, if there is one
        for (std::size_t i = at; i < tokens.size(); ++i) {
            if (kind_of(tokens[i]) == 0) {
                tokens[i] = kTexts[random.below(11)];
                return;
            }
        }
    }
}

void change_statements(Pieces& statements, Random& random) {
    const std::size_t at = random.below(statements.size());
    const auto place = statements.begin() + static_cast<std::ptrdiff_t>(at);
    // Random grammars take milliseconds, so they are rare.
    switch (random.below(64) == 0 ? 4 : random.below(4)) {
    case 0:
        statements.erase(place);
        return;
    case 1:
        statements.insert(place, std::string(kStatements[random.below(kStatements.size())]));
        return;
    case 2:
        std::swap(statements[at], statements[random.below(statements.size())]);
        return;
    case 3:
        statements.insert(place, statements[random.below(statements.size())]);
        return;
    default: {
        const Pieces others = statements_of(random_grammar(random));
        statements.insert(place, others[random.below(others.size())]);
    }
    }
}

} // namespace

std::string changed_grammar(std::string_view text, std::uint64_t seed) {
    Random random(seed, 1);
    if (text.size() < 2 || random.below(512) == 0) {
        return random_grammar(random);
    }
    std::string changed(text);
    for (std::size_t count = 1 + random.below(4); count > 0 && !changed.empty(); --count) {
        if (random.below(3) == 0) {
            Pieces statements = statements_of(changed);
            change_statements(statements, random);
            changed = joined(statements);
        } else {
            Pieces tokens = tokens_of(changed);
            change_tokens(tokens, random);
            changed = joined(tokens);
        }
    }
    return changed;
}

std::string crossed_grammars(std::string_view text, std::string_view other, std::uint64_t seed) {
    Random random(seed, 2);
    Pieces statements = statements_of(text);
    const Pieces others = statements_of(other);
    for (std::size_t count = 1 + random.below(3); count > 0 && !others.empty(); --count) {
        const std::string& taken = others[random.below(others.size())];
        const std::size_t at = random.below(statements.size() + 1);
        if (at < statements.size() && random.below(2) == 0) {
            statements[at] = taken;
        } else {
            statements.insert(statements.begin() + static_cast<std::ptrdiff_t>(at), taken);
        }
    }
    return joined(statements);
}

#ifdef LSYS_FUZZ
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t
LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed);
// NOLINTNEXTLINE(bugprone-easily-swappable-parameters): the signature is libFuzzer's
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data,
                                                 std::size_t size,
                                                 const std::uint8_t* other,
                                                 std::size_t other_size,
                                                 std::uint8_t* out,
                                                 std::size_t max_size,
                                                 unsigned seed);

namespace {

std::size_t written(const std::string& text, std::uint8_t* data, std::size_t max_size) {
    const std::size_t size = std::min(text.size(), max_size);
    std::memcpy(data, text.data(), size);
    return size;
}

std::string_view view_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

} // namespace

std::size_t
LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
    if (seed % 8 == 0) {
        // Changes of bytes, which may break the structure.
        return LLVMFuzzerMutate(data, size, max_size);
    }
    return written(changed_grammar(view_of(data, size), seed), data, max_size);
}

std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data,
                                      std::size_t size,
                                      const std::uint8_t* other,
                                      std::size_t other_size,
                                      std::uint8_t* out,
                                      std::size_t max_size,
                                      unsigned seed) {
    return written(crossed_grammars(view_of(data, size), view_of(other, other_size), seed), out,
                   max_size);
}
#endif
