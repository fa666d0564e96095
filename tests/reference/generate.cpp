// SPDX-License-Identifier: MIT
#include "tests/reference/generate.h"

#include "tests/reference/features.h"
#include "tests/reference/generate_expression.h"
#include "tests/reference/generate_grammar.h"
#include "tests/reference/random.h"

#include <algorithm>
#include <set>

namespace lsys::reference {

namespace {

// Sets the number of generations: in -n if the case has -n, else in #n. If the case has both, #n
// gets a random number.
void set_generations(Case& test_case, std::uint32_t generations, Random& random) {
    const bool by_request = test_case.request.generations.has_value();
    if (by_request) {
        test_case.request.generations = generations;
    }
    for (File& file : test_case.grammar.files) {
        for (Statement& statement : file.statements) {
            if (statement.kind == StatementKind::Generations) {
                const auto value = static_cast<float>(by_request ? random.below(9) : generations);
                const std::size_t style = random.below(4);
                statement.expr = style == 0   ? binary("+", number(value - 1), number(1))
                                 : style == 1 ? binary("/", number(value * 2), number(2))
                                              : number(value);
                if (value == 0) {
                    statement.expr = number(0);
                }
            }
        }
    }
}

struct Sized {
    Case test_case;
    double score = -1;
};

// A score of the features that a case uses; rare features count more.
double score_of(const Case& test_case, const Derivation& derivation) {
    static const std::set<std::string> kRare = {"context []",
                                                "context [ ]",
                                                "range in a range",
                                                "more than four ranges in a successor",
                                                "error: bad range",
                                                "error: not finite",
                                                "error: unmatched bracket",
                                                "both contexts",
                                                "chosen and taken in a group",
                                                "choice generation, sequential",
                                                "choice generation, cyclic",
                                                "empty word"};
    std::size_t productions = 0;
    for (const Statement* statement : statements_in_order(test_case.grammar)) {
        productions += statement->kind == StatementKind::Production ? 1U : 0U;
    }
    const auto applied = static_cast<double>(derivation.applications.size());
    double score = productions == 0 ? 0.5 : applied / static_cast<double>(productions);
    score += derivation.words.back().size() > 20 ? 0.2 : 0;
    score += derivation.words.size() > 3 ? 0.2 : 0;
    for (const std::string& feature : features_of(test_case, derivation)) {
        score += kRare.count(feature) != 0 ? 0.25 : 0;
    }
    for (const auto& [kind, answered] : derivation.answered) {
        const auto different = static_cast<double>(answered.different.size());
        score += kind == "turtle" ? 0.1 : std::min(1.0, 0.05 * different);
    }
    return score;
}

// Chooses the number of generations, at most `max_generations`, so that words have at most `cap`
// modules, and so that an error occurs only if `keep_error` is true.
Sized size_up(Case test_case,
              std::size_t cap,
              std::uint32_t max_generations,
              bool keep_error,
              Random random) {
    std::uint32_t generations = max_generations;
    while (true) {
        set_generations(test_case, generations, random);
        Request limited = test_case.request;
        limited.max_modules = cap;
        const Derivation derivation = derive(test_case.grammar, limited);
        if (derivation.words.empty()) {
            return {};
        }
        const bool stopped = derivation.words.size() <= generations;
        const bool is_kept = derivation.error && (keep_error || !stopped);
        if (!stopped || is_kept) {
            Sized sized{test_case, score_of(test_case, derivation)};
            return sized;
        }
        if (generations == 0) {
            return {};
        }
        generations = static_cast<std::uint32_t>(derivation.words.size()) - 1;
    }
}

// The best of some cases of a seed. `good`: a score with which no further case is made.
Case best_case(std::uint64_t seed,
               bool senses,
               std::size_t cap,
               std::uint32_t attempts,
               double good,
               Random& random) {
    Sized best;
    for (std::uint32_t attempt = 0; attempt < attempts || best.score < 0; ++attempt) {
        Case test_case = make_case(seed, attempt, senses);
        const bool cyclic = setting(test_case.grammar, "rewriting").value_or("") == "cyclic";
        const int longest = cyclic || cap > 5000 ? 24 : 9;
        const auto max_generations = static_cast<std::uint32_t>(random.between(2, longest));
        const bool keep_error = random.percent(senses ? 10 : 45);
        Sized sized =
            size_up(test_case, cap, max_generations, keep_error, Random(seed, 3 + attempt));
        if (sized.score > best.score) {
            best = sized;
        }
        if (best.score > good) {
            break;
        }
    }
    best.test_case.layout_seed = seed * 2 + 1;
    return best.test_case;
}

} // namespace

Case generate(std::uint64_t seed) {
    Random random(seed, 1);
    static const std::vector<std::size_t> kCaps = {60, 150, 300, 300, 600, 600, 1000, 1000, 2500};
    const std::size_t cap = random.percent(2) ? 20000 : random.pick(kCaps);
    return best_case(seed, false, cap, 16, 1.5, random);
}

Case generate_plant(std::uint64_t seed) {
    Random random(seed, 0x20);
    static const std::vector<std::size_t> kCaps = {60, 100, 150, 200, 400};
    return best_case(seed + (std::uint64_t{1} << 32), true, random.pick(kCaps), 12, 2.8, random);
}

} // namespace lsys::reference
