// SPDX-License-Identifier: MIT
// Compares the compiler and the runtime with the oracle of tests/reference. The input is the seed
// of a random grammar, and edits of it: other numbers, modules of successors removed, repeated and
// exchanged. An edited grammar that does not compile is skipped. At a difference it prints both
// words, and the grammar, and aborts.
#include "runtime/derive/word_text.h"
#include "tests/fuzz/input_bytes.h"
#include "tests/fuzz/small_derivation.h"
#include "tests/reference/compile_case.h"
#include "tests/reference/generate.h"
#include "tests/reference/print.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace lsys::reference;

constexpr std::size_t kMaxModules = 1'000;
constexpr int kMaxEdits = 8;

/// Lists of modules and numbers that an edit may change.
struct Places {
    std::vector<std::vector<ModuleUse>*> successors;
    std::vector<Expr*> numbers;
};

void add_numbers(Expr& expression, std::vector<Expr*>& numbers) {
    if (expression.kind == ExprKind::Number) {
        numbers.push_back(&expression);
    }
    for (Expr& part : expression.parts) {
        add_numbers(part, numbers);
    }
}

Places places_of(Grammar& grammar) {
    Places places;
    for (File& file : grammar.files) {
        for (Statement& statement : file.statements) {
            if (statement.kind != StatementKind::Production) {
                continue;
            }
            Production& production = statement.production;
            places.successors.push_back(&production.successor);
            if (production.condition) {
                add_numbers(*production.condition, places.numbers);
            }
            for (ModuleUse& module : production.successor) {
                for (Expr& argument : module.arguments) {
                    add_numbers(argument, places.numbers);
                }
            }
        }
    }
    return places;
}

bool is_bracket(const ModuleUse& module) {
    return module.name == "[" || module.name == "]" || module.name == "{" || module.name == "}";
}

/// Changes one successor: removes, repeats or exchanges modules that are no brackets.
void edit_successor(std::vector<ModuleUse>& successor, InputBytes& input) {
    const std::size_t kind = input.below(3);
    if (successor.empty()) {
        return;
    }
    const std::size_t at = input.below(successor.size());
    const std::size_t other = input.below(successor.size());
    if (is_bracket(successor[at]) || is_bracket(successor[other])) {
        return;
    }
    const auto place = successor.begin() + static_cast<std::ptrdiff_t>(at);
    if (kind == 0) {
        successor.erase(place);
    } else if (kind == 1) {
        const ModuleUse repeated = successor[other];
        successor.insert(place, repeated);
    } else {
        std::swap(successor[at], successor[other]);
    }
}

void edit(Grammar& grammar, InputBytes& input) {
    constexpr std::array kNumbers{0.0F, 1.0F, 2.0F, 0.5F, 3.0F, 0.25F, 100.0F, 1e6F, 7.0F, 1e30F};
    for (int count = 0; count < kMaxEdits && !input.empty(); ++count) {
        const Places places = places_of(grammar);
        if (input.below(2) == 0 && !places.numbers.empty()) {
            Expr& number = *places.numbers[input.below(places.numbers.size())];
            number.number = kNumbers[input.below(kNumbers.size())];
            number.text.clear();
        } else if (!places.successors.empty()) {
            edit_successor(*places.successors[input.below(places.successors.size())], input);
        }
    }
}

[[noreturn]] void
fail(const Case& test_case, const std::string& expected, const std::string& found) {
    std::fprintf(stderr, "DIFFERENT:\n  oracle: %s\n  lsc:    %s\n", expected.c_str(),
                 found.c_str());
    for (const TextFile& file : print_grammar(test_case.grammar, test_case.layout_seed)) {
        std::fprintf(stderr, "---- %s\n%s\n", file.path.c_str(), file.text.c_str());
    }
    std::abort();
}

std::string text_of(const lsys::Bytecode& bytecode, const lsys::Word& word) {
    std::string text;
    static_cast<void>(lsys::WordPrinter(bytecode).print(word, [&](std::string_view piece) {
        text += piece;
        return true;
    }));
    return text;
}

/// The place of an error as text.
std::string place_text(std::uint64_t generation, std::uint64_t position) {
    return "error at " + std::to_string(generation) + ":" + std::to_string(position);
}

void compare(const Case& test_case, const lsys::Bytecode& bytecode, const Derivation& expected) {
    lsys::DeriveOptions options;
    options.generations = expected.generations;
    options.seed = expected.seed;
    options.threads = 1;
    lsys::Derivation derivation(bytecode, options);
    const std::optional<lsys::Stop> stop = derivation.derive();
    const std::string found = // the word, or the place of the error
        stop ? place_text(derivation.error().generation, derivation.error().position)
             : text_of(bytecode, derivation.word());
    std::string wanted;
    if (expected.error) {
        wanted = place_text(expected.error->generation, expected.error->position);
    } else {
        wanted = print_word(expected.words.back(), test_case.grammar.files[0].letters);
    }
    if (wanted != found || stop.has_value() != expected.error.has_value()) {
        fail(test_case, wanted, found);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    InputBytes input(data, size);
    Case test_case = generate(input.number<std::uint32_t>());
    edit(test_case.grammar, input);
    test_case.request.max_modules = kMaxModules;
    std::string messages;
    const std::optional<lsys::Bytecode> bytecode = compile_case(test_case, messages);
    if (!bytecode) {
        return 0;
    }
    const Derivation expected = derive(test_case.grammar, test_case.request);
    if (!expected.too_large) {
        compare(test_case, *bytecode, expected);
    }
    return 0;
}
