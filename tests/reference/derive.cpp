// SPDX-License-Identifier: MIT
#include "tests/reference/derive.h"

#include "tests/reference/evaluate.h"
#include "tests/reference/match.h"
#include "tests/reference/philox.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

namespace lsys::reference {

namespace {

constexpr std::uint32_t kBeforeTheDerivation = 0xFFFFFFFF;
constexpr std::uint64_t kDrawsOfARule = 4096;
constexpr std::uint64_t kFirstDecomposeDraw = std::uint64_t{1} << 32;
constexpr std::uint64_t kFirstDownDraw = kFirstDecomposeDraw + (std::uint64_t{1} << 30);
constexpr std::uint64_t kFirstUpDraw = kFirstDownDraw + (std::uint64_t{1} << 29);

// A production, and its group and rule (section 5).
struct Entry {
    const Production* production = nullptr;
    std::string group;
    std::size_t rule = 0;
};

struct System {
    std::map<std::string, float> constants;
    Functions functions;
    std::map<Stage, std::vector<Entry>> productions; // in file order
    std::vector<std::string> rules;                  // in order of first appearance, stage by stage
    std::set<std::string> ignored;
    std::set<std::string> considered;
    std::set<std::string> mentioned;      // names in all words and patterns
    std::size_t rewriting_rule_count = 0; // rules[0, rewriting_rule_count) are those of rewriting
    std::uint32_t decompose_depth = 100;
    bool cuts = false; // in the turtle profile, `%` is a cut
    bool one_choice_per_generation = false;
    std::uint64_t seed = 0;
    std::uint32_t steps = 0;
    std::size_t max_modules = 0;
};

struct TooLarge {};

// Raised inside a step; becomes a RunError.
struct Stop {
    RunError error;
};

// Input of a pass, which rewrites `word`, of age `age`, once. A generation is one pass; with
// sequential rewriting and #decompose it is several passes.
struct PassInput {
    const System& system;
    const Word& word;
    std::uint32_t age = 0;
    // Number of the first draw. Sequential rewriting: 4096 times the index of the rule. #decompose:
    // 2^32 + 4096 times the index of the pass. Sweeps: kFirstDownDraw and kFirstUpDraw.
    std::uint64_t first_draw = 0;
    std::optional<std::size_t> only_rule; // the only rule of this pass; empty: all rules
    Stage stage = Stage::Rewrite;
};

Environment environment_of(const PassInput& pass, const Bindings& bindings) {
    Environment environment;
    environment.constants = &pass.system.constants;
    environment.functions = &pass.system.functions;
    environment.formals = bindings;
    environment.step = static_cast<float>(pass.age);
    environment.steps = static_cast<float>(pass.system.steps);
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

// Appends the successor to `out`. Ranges in it are numbered in the order of their closing braces.
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
                      {&use, production.label, pass.age + (pass.stage == Stage::Rewrite ? 1 : 0)}};
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

// Rewrites the word once from left to right, as leftmost rewriting does. In parallel rewriting a
// predecessor is one module, so that this also rewrites all modules at once.
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

// "A generation begins with the cuts": removes each `%` and the rest of its branch.
Word without_cuts(const System& system, const Word& word) {
    Word out;
    std::size_t open = 0; // brackets open in the removed part
    bool cut = false;
    for (const Module& module : word) {
        const bool bare = module.values.empty();
        if (cut && bare && module.name == "[") {
            ++open;
        } else if (cut && bare && module.name == "]") {
            cut = open > 0;
            open -= open > 0 ? 1 : 0;
        } else if (system.cuts && bare && module.name == "%") {
            cut = true;
        }
        if (!cut) {
            out.push_back(module);
        }
    }
    return out;
}

// Applies passes of #decompose to the word of an age, until no production applies or the depth
// limit is reached.
Word decomposed(const System& system, Word word, std::uint32_t age, Derivation& derivation) {
    for (std::uint32_t i = 0; i < system.decompose_depth; ++i) {
        PassInput pass{system,          word, age, kFirstDecomposeDraw + kDrawsOfARule * i, {},
                       Stage::Decompose};
        const std::map<std::string, std::uint64_t> before = derivation.applications;
        Word next = run_pass(pass, derivation);
        if (before == derivation.applications) {
            return word;
        }
        word = next;
    }
    return word;
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

// Completes the word of an age: by decomposition, then the down sweep, then the up sweep. Sensing
// belongs before the sweeps; the oracle does not implement it.
Word completed(const System& system, const Word& word, std::uint32_t age, Derivation& derivation) {
    Word complete = decomposed(system, word, age, derivation);
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

// Gives constants and axiom their values, in the order in which the text defines them.
class Start {
public:
    Start(const Grammar& grammar, const Request& request, System& system)
        : request_(request), system_(system) {
        environment_.constants = &system_.constants;
        environment_.functions = &system_.functions;
        environment_.draw = [this] {
            return uniform(system_.seed, range_number_++, kBeforeTheDerivation, 0);
        };
        for (const Statement* statement : statements_in_order(grammar)) {
            read(*statement);
        }
        for (const Stage stage :
             {Stage::Rewrite, Stage::Decompose, Stage::Interpret, Stage::Down, Stage::Up}) {
            for (const Production* production : productions_[stage]) {
                system_.productions[stage].push_back(
                    {production, group_of(*production), number_of(rule_of(*production))});
            }
            if (stage == Stage::Rewrite) {
                system_.rewriting_rule_count = system_.rules.size();
            }
        }
        if (considers_) {
            for (const std::string& name : system_.mentioned) {
                if (system_.considered.count(name) == 0 && name != "[" && name != "]") {
                    system_.ignored.insert(name);
                }
            }
        }
    }

    // "Draws of all axioms are numbered, only the chosen one is evaluated."
    [[nodiscard]] Word axiom() {
        Word word;
        const Axiom& chosen = choose_axiom();
        range_number_ = chosen.first_range;
        for (const ModuleUse& use : chosen.statement->modules) {
            Module module{use.name, {}, {&use, "", 0}};
            for (const Expr& argument : use.arguments) {
                module.values.push_back(finite(evaluate(argument, environment_)));
            }
            word.push_back(module);
        }
        return word;
    }

    [[nodiscard]] std::uint32_t generations() const { return generations_; }

private:
    void read(const Statement& statement) {
        if (statement.kind == StatementKind::Generations) {
            generations_ = static_cast<std::uint32_t>(evaluate(statement.expr, environment_));
        } else if (statement.kind == StatementKind::Define ||
                   statement.kind == StatementKind::Param) {
            system_.constants[statement.name] = value_of(statement);
        } else if (statement.kind == StatementKind::Function) {
            // The body is evaluated with all constants, including those that follow it. These
            // change nothing, because no constant is defined twice.
            system_.functions[statement.name] = {statement.names, statement.expr, {}};
        } else if (statement.kind == StatementKind::Curve) {
            UserFunction& curve = system_.functions[statement.name];
            for (const auto& [x, y] : statement.points) {
                curve.points.emplace_back(evaluate(x, environment_), evaluate(y, environment_));
            }
        } else if (statement.kind == StatementKind::Ignore) {
            system_.ignored.insert(statement.names.begin(), statement.names.end());
        } else if (statement.kind == StatementKind::Consider) {
            system_.considered.insert(statement.names.begin(), statement.names.end());
            considers_ = true;
        } else if (statement.kind == StatementKind::Axiom) {
            axioms_.push_back({&statement, range_number_});
            for (const ModuleUse& use : statement.modules) {
                system_.mentioned.insert(use.name);
                for (const Expr& argument : use.arguments) {
                    range_number_ += count_ranges(argument);
                }
            }
        } else if (statement.kind == StatementKind::Production) {
            const Production& production = statement.production;
            for (const ModuleUse& use : production.successor) {
                system_.mentioned.insert(use.name);
            }
            for (const ModulePattern& module : production.predecessor) {
                system_.mentioned.insert(module.name);
            }
            productions_[production.stage].push_back(&production);
        }
    }

    struct Axiom {
        const Statement* statement = nullptr;
        std::uint64_t first_range = 0;
    };

    // "The choice is draw 0 at position 2^64 - 1, generation 0xFFFFFFFF."
    [[nodiscard]] const Axiom& choose_axiom() const {
        if (!axioms_.front().statement->has_probability) {
            return axioms_.front();
        }
        float sum = 0;
        for (const Axiom& axiom : axioms_) {
            sum += evaluate(axiom.statement->expr, environment_);
        }
        const float u = uniform(system_.seed, ~std::uint64_t{0}, kBeforeTheDerivation, 0);
        float running = 0;
        for (const Axiom& axiom : axioms_) {
            const float share = evaluate(axiom.statement->expr, environment_) / sum;
            running += share;
            if (running > u) {
                return axiom;
            }
        }
        return axioms_.back();
    }

    // Rules are numbered by first appearance.
    std::size_t number_of(const std::string& rule) {
        std::vector<std::string>& rules = system_.rules;
        for (std::size_t k = 0; k < rules.size(); ++k) {
            if (rules[k] == rule) {
                return k;
            }
        }
        rules.push_back(rule);
        return rules.size() - 1;
    }

    // A random range uses up its draw number even if -D replaces the expression that contains the
    // range.
    float value_of(const Statement& statement) {
        for (const auto& [name, number] : request_.definitions) {
            if (name == statement.name) {
                range_number_ += count_ranges(statement.expr);
                return number;
            }
        }
        return finite(evaluate(statement.expr, environment_));
    }

    static std::uint64_t count_ranges(const Expr& expr) {
        std::uint64_t count = draws(expr) ? 1 : 0;
        for (const Expr& part : expr.parts) {
            count += count_ranges(part);
        }
        return count;
    }

    static float finite(float value) {
        if (!std::isfinite(value)) {
            throw Stop{};
        }
        return value;
    }

    const Request& request_;
    System& system_;
    Environment environment_;
    std::uint64_t range_number_ = 0;
    std::uint32_t generations_ = 0;
    std::map<Stage, std::vector<const Production*>> productions_; // in file order
    bool considers_ = false;
    std::vector<Axiom> axioms_; // in the order of the text
};

std::uint64_t seed_of(const Grammar& grammar, const Request& request) {
    if (request.seed) {
        return *request.seed;
    }
    const std::optional<std::string> seed = setting(grammar, "seed");
    return seed ? std::strtoull(seed->c_str(), nullptr, 10) : 0;
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
    if (const auto depth = setting(grammar, "decompose_depth")) {
        system.decompose_depth =
            static_cast<std::uint32_t>(std::strtoul(depth->c_str(), nullptr, 10));
    }
    const std::string turtle = setting(grammar, "turtle").value_or("lsys");
    system.cuts = turtle == "lsys" || turtle == "thesis" || turtle == "abop" || turtle == "cpfg" ||
                  turtle == "houdini";
    try {
        Start start(grammar, request, system);
        system.steps = request.generations.value_or(start.generations());
        derivation.generations = system.steps;
        derivation.constants = system.constants;
        derivation.words.push_back(completed(system, start.axiom(), 0, derivation));
        for (std::uint32_t age = 0; age < system.steps; ++age) {
            const Word read = without_cuts(system, derivation.words.back());
            derivation.words.push_back(completed(
                system, next_word(system, mode, read, age, derivation), age + 1, derivation));
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
