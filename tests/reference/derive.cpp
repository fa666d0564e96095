// SPDX-License-Identifier: MIT
#include "tests/reference/derive.h"

#include "tests/reference/pass.h"
#include "tests/reference/sensing.h"
#include "tests/reference/start.h"

#include <cstdlib>

namespace lsys::reference {

namespace {

// "A generation begins with the cuts": removes each `%` and the rest of its branch.
Word without_cuts(const System& system, const Word& word) {
    Word out;
    std::size_t open = 0; // brackets open in the removed part
    bool is_cut = false;
    for (const Module& module : word) {
        const bool bare = module.values.empty();
        if (is_cut && bare && module.name == "[") {
            ++open;
        } else if (is_cut && bare && module.name == "]") {
            is_cut = open > 0;
            open -= open > 0 ? 1 : 0;
        } else if (system.cuts && bare && module.name == "%") {
            is_cut = true;
        }
        if (!is_cut) {
            out.push_back(module);
        }
    }
    return out;
}

// Makes the word of an age complete: decomposition, sensing, the down sweep, the up sweep.
Word completed(const System& system,
               Surroundings& surroundings,
               const Word& word,
               std::uint32_t age,
               Derivation& derivation) {
    Word complete = decomposed(system, word, age, derivation);
    surroundings.sense(complete, age, derivation);
    sweep(system, Stage::Down, complete, age, derivation);
    sweep(system, Stage::Up, complete, age, derivation);
    return complete;
}

Word next_word(const System& system,
               const std::string& mode,
               const Word& word,
               std::uint32_t age,
               Derivation& derivation) {
    if (mode == "sequential") {
        Word current = word;
        for (std::uint32_t k = 0; k < system.rewriting_rule_count; ++k) {
            const PassInput pass{system, current, age, kDrawsOfARule * k, k};
            current = run_pass(pass, derivation);
        }
        return current;
    }
    if (mode == "cyclic") {
        if (system.rewriting_rule_count == 0) {
            return word;
        }
        const std::size_t rule = age % system.rewriting_rule_count;
        return run_pass(PassInput{system, word, age, 0, rule}, derivation);
    }
    return run_pass(PassInput{system, word, age, 0, std::nullopt}, derivation);
}

std::uint64_t seed_of(const Grammar& grammar, const Request& request) {
    if (request.seed) {
        return *request.seed;
    }
    const std::optional<std::string> seed = setting(grammar, "seed");
    return seed ? std::strtoull(seed->c_str(), nullptr, 10) : 0;
}

std::uint32_t depth_of(const Grammar& grammar, const std::string& key) {
    const std::optional<std::string> depth = setting(grammar, key);
    return depth ? static_cast<std::uint32_t>(std::strtoul(depth->c_str(), nullptr, 10)) : 100;
}

// "A `]` without its `[` is an error" in the last word; "`{` `}` follow the same rule, along the
// word and apart from brackets". A `{` or `}` in the part that a cut removes does not count.
std::optional<RunError>
unmatched_bracket(const System& system, const Word& word, std::uint32_t age) {
    std::uint64_t open = 0;
    std::uint64_t polygons = 0;
    std::uint64_t cut = 0; // open branches since the cut; 0 outside of a removed part
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::string& name = word[i].name;
        const bool removed = cut > 0;
        if (name == "[") {
            ++open;
            cut += removed ? 1 : 0;
        } else if (name == "]") {
            if (open == 0) {
                return RunError{Failure::UnmatchedBracket, "", i, age, word[i]};
            }
            --open;
            cut -= removed ? 1 : 0;
        } else if (removed) {
            continue;
        } else if (name == "{") {
            ++polygons;
        } else if (name == "}") {
            if (polygons == 0) {
                return RunError{Failure::UnmatchedPolygon, "", i, age, word[i]};
            }
            --polygons;
        } else if (system.cuts && name == "%") {
            cut = 1;
        }
    }
    return std::nullopt;
}

} // namespace

Derivation derive(const Grammar& grammar, const Request& request) {
    Derivation derivation;
    System system;
    system.seed = seed_of(grammar, request);
    system.max_modules = request.max_modules;
    system.one_choice_per_generation =
        setting(grammar, "choice").value_or("module") == "generation";
    const std::string mode = setting(grammar, "rewriting").value_or("parallel");
    derivation.seed = system.seed;
    system.grammar = &grammar;
    system.decompose_depth = depth_of(grammar, "decompose_depth");
    system.interpret_depth = depth_of(grammar, "interpret_depth");
    const std::string turtle = setting(grammar, "turtle").value_or("lsys");
    system.cuts = turtle == "lsys" || turtle == "thesis" || turtle == "abop" || turtle == "cpfg" ||
                  turtle == "houdini";
    try {
        Start start(grammar, request, system);
        system.steps = request.generations.value_or(start.generations());
        derivation.generations = system.steps;
        derivation.constants = system.constants;
        Surroundings surroundings(system);
        const auto complete = [&](const Word& word, std::uint32_t age) {
            derivation.words.push_back(completed(system, surroundings, word, age, derivation));
        };
        complete(start.axiom(), 0);
        for (std::uint32_t age = 0; age < system.steps; ++age) {
            const Word read = without_cuts(system, derivation.words.back());
            complete(next_word(system, mode, read, age, derivation), age + 1);
        }
    } catch (const TooLarge&) {
        derivation.too_large = true;
        return derivation;
    } catch (const Stop& stopped) {
        derivation.error = stopped.error;
        return derivation;
    } catch (const BadRange&) { // raised by a definition or the axiom
        derivation.error = RunError{Failure::BadRange, "", 0, 0, {}};
        return derivation;
    }
    derivation.error = unmatched_bracket(system, derivation.words.back(), system.steps);
    return derivation;
}

} // namespace lsys::reference
