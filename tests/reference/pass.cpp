// SPDX-License-Identifier: MIT
#include "tests/reference/pass.h"

#include "tests/reference/match.h"
#include "tests/reference/philox.h"

#include <cmath>

namespace lsys::reference {

namespace {

constexpr std::uint64_t kFirstDecomposeDraw = std::uint64_t{1} << 32;
constexpr std::uint64_t kFirstInterpretDraw = kFirstDecomposeDraw + (std::uint64_t{1} << 31);
constexpr std::uint64_t kFirstDownDraw = kFirstDecomposeDraw + (std::uint64_t{1} << 30);
constexpr std::uint64_t kFirstUpDraw = kFirstDownDraw + (std::uint64_t{1} << 29);

Environment environment_of(const PassInput& pass, const Bindings& bindings) {
    Environment environment;
    environment.constants = &pass.system.constants;
    environment.functions = &pass.system.functions;
    environment.formals = bindings;
    environment.step = static_cast<float>(pass.age);
    // "Draws, `step()` and `steps()` of interpretation use the age of the sensed word."
    environment.steps =
        static_cast<float>(pass.stage == Stage::Interpret ? pass.age : pass.system.steps);
    return environment;
}

[[noreturn]] void
stop(const PassInput& pass, const Production& production, std::size_t position, Failure failure) {
    throw Stop{RunError{failure, production.label, position, pass.age, pass.word[position]}};
}

// "A production matches a module when name and count agree, the contexts match, and the condition
// holds."
bool matches(const PassInput& pass,
             const Production& production,
             std::size_t position,
             Bindings& bindings) {
    bindings.clear();
    if (!matches_around(production, pass.word, position, pass.system.ignored, bindings)) {
        return false;
    }
    if (!production.condition) {
        return true;
    }
    const float value = evaluate(*production.condition, environment_of(pass, bindings));
    if (!std::isfinite(value)) {
        stop(pass, production, position, Failure::NotFinite);
    }
    return value != 0.0F;
}

// The random number that chooses between the productions that match at `position`.
float draw_of_choice(const PassInput& pass, std::size_t rule, std::size_t position) {
    const System& system = pass.system;
    if (system.one_choice_per_generation) {
        const std::uint64_t place = std::uint64_t{0} - 1 - rule;
        return uniform(system.seed, place, pass.age, 0);
    }
    return uniform(system.seed, position, pass.age, pass.first_draw);
}

struct Choice {
    const Production* production = nullptr;
    Bindings bindings;
};

// "Productions are tried in file order. If the first that matches has no `~`, it is taken.
// Otherwise the choice is among all matching `~` productions whose predecessor and contexts have
// the same names and counts, with weights p, normalised."
Choice choose(const PassInput& pass, std::size_t position) {
    const System& system = pass.system;
    std::vector<Choice> candidates;
    Entry first;
    const auto entries = system.productions.find(pass.stage);
    if (entries == system.productions.end()) {
        return {};
    }
    for (const Entry& entry : entries->second) {
        const Production& production = *entry.production;
        if (pass.only_rule && entry.rule != *pass.only_rule) {
            continue;
        }
        if (!candidates.empty() && (!production.probability || entry.group != first.group)) {
            continue;
        }
        Choice candidate{&production, {}};
        if (!matches(pass, production, position, candidate.bindings)) {
            continue;
        }
        if (!production.probability) {
            return candidate;
        }
        if (candidates.empty()) {
            first = entry;
        }
        candidates.push_back(candidate);
    }
    if (candidates.empty()) {
        return {};
    }

    float sum = 0;
    std::vector<float> weights;
    for (const Choice& candidate : candidates) {
        const float weight =
            evaluate(*candidate.production->probability, environment_of(pass, candidate.bindings));
        sum += weight;
        if (!std::isfinite(weight) || weight < 0 || !std::isfinite(sum)) {
            stop(pass, *candidate.production, position, Failure::BadWeight);
        }
        weights.push_back(weight);
    }
    if (sum == 0) {
        return {}; // "the module counts as not matched"
    }
    const float u = draw_of_choice(pass, first.rule, position);
    float running = 0;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const float share = weights[i] / sum;
        running += share;
        taken = weights[i] > 0 ? i : taken;
        if (running > u) {
            break;
        }
    }
    return candidates[taken];
}

// Appends the successor to `out`; its ranges are numbered in the order of their closing braces.
void rewrite(const PassInput& pass, const Choice& choice, std::size_t position, Word& out) {
    const System& system = pass.system;
    const Production& production = *choice.production;
    const bool choice_took_a_draw = production.probability && !system.one_choice_per_generation;
    std::uint64_t draw = pass.first_draw + (choice_took_a_draw ? 1 : 0);

    Environment environment = environment_of(pass, choice.bindings);
    environment.draw = [&] { return uniform(system.seed, position, pass.age, draw++); };
    const auto value_of = [&](const Expr& expr) {
        try {
            return evaluate(expr, environment);
        } catch (const BadRange&) {
            stop(pass, production, position, Failure::BadRange);
        }
    };
    for (const auto& [name, expr] : production.locals) {
        environment.formals[name] = value_of(expr); // a local value may be infinite or NaN
    }
    for (const ModuleUse& use : production.successor) {
        Module module{use.name,
                      {},
                      {&use, production.label, pass.age + (pass.stage == Stage::Rewrite ? 1 : 0)},
                      pass.word[position].source};
        for (const Expr& argument : use.arguments) {
            const float value = value_of(argument);
            if (!std::isfinite(value)) {
                stop(pass, production, position, Failure::NotFinite);
            }
            module.values.push_back(value);
        }
        out.push_back(module);
    }
}

// Applies passes of a stage until none applies or the depth limit is reached.
Word settled(
    const System& system, Stage stage, Word word, std::uint32_t age, Derivation& derivation) {
    const bool decomposes = stage == Stage::Decompose;
    const std::uint32_t depth = decomposes ? system.decompose_depth : system.interpret_depth;
    const std::uint64_t first = decomposes ? kFirstDecomposeDraw : kFirstInterpretDraw;
    for (std::uint32_t i = 0; i < depth; ++i) {
        const PassInput pass{system, word, age, first + kDrawsOfARule * i, {}, stage};
        const std::map<std::string, std::uint64_t> before = derivation.applications;
        Word next = run_pass(pass, derivation);
        if (before == derivation.applications) {
            return word;
        }
        word = next;
    }
    return word;
}

} // namespace

// Rewrites the word once from left to right, as in leftmost rewriting. In parallel rewriting a
// predecessor is one module, so that this is also the step that rewrites all modules at once.
Word run_pass(const PassInput& pass, Derivation& derivation) {
    Word out;
    std::size_t position = 0;
    while (position < pass.word.size()) {
        const Choice choice = choose(pass, position);
        if (choice.production == nullptr) { // copied, with its origin
            out.push_back(pass.word[position]);
            ++position;
            continue;
        }
        rewrite(pass, choice, position, out);
        ++derivation.applications[choice.production->label];
        position += choice.production->predecessor.size();
        if (out.size() > pass.system.max_modules) {
            throw TooLarge{};
        }
    }
    return out;
}

Word decomposed(const System& system, const Word& word, std::uint32_t age, Derivation& derivation) {
    return settled(system, Stage::Decompose, word, age, derivation);
}

Word interpreted(const System& system,
                 const Word& word,
                 std::uint32_t age,
                 Derivation& derivation) {
    Word drawn = word;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        drawn[i].source = i;
    }
    return settled(system, Stage::Interpret, drawn, age, derivation);
}

// "#down visits the word from right to left, #up from left to right"; a module that a production
// matches gets new parameters, which the modules visited later see. It keeps its origin.
void sweep(
    const System& system, Stage stage, Word& word, std::uint32_t age, Derivation& derivation) {
    const bool down = stage == Stage::Down;
    const PassInput pass{system, word, age, down ? kFirstDownDraw : kFirstUpDraw, {}, stage};
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::size_t position = down ? word.size() - 1 - i : i;
        const Choice choice = choose(pass, position);
        if (choice.production != nullptr) {
            Word written;
            rewrite(pass, choice, position, written);
            word[position].values = written.front().values;
            ++derivation.applications[choice.production->label];
        }
    }
}

} // namespace lsys::reference
