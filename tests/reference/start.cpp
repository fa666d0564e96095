// SPDX-License-Identifier: MIT
#include "tests/reference/start.h"

#include "tests/reference/philox.h"

#include <cmath>

namespace lsys::reference {

namespace {

std::uint64_t count_ranges(const Expr& expr) {
    std::uint64_t count = draws(expr) ? 1 : 0;
    for (const Expr& part : expr.parts) {
        count += count_ranges(part);
    }
    return count;
}

float finite(float value) {
    if (!std::isfinite(value)) {
        throw Stop{};
    }
    return value;
}

} // namespace

Start::Start(const Grammar& grammar, const Request& request, System& system)
    : request_(request), system_(system) {
    environment_.constants = &system_.constants;
    environment_.functions = &system_.functions;
    environment_.draw = [this] {
        return uniform(system_.seed, range_number_++, kBeforeTheDerivation, 0);
    };
    for (const Statement* statement : statements_in_order(grammar)) {
        read(*statement);
    }
    number_rules();
    if (considers_) {
        for (const std::string& name : system_.mentioned) {
            if (system_.considered.count(name) == 0 && name != "[" && name != "]") {
                system_.ignored.insert(name);
            }
        }
    }
}

// Rules are numbered stage by stage.
void Start::number_rules() {
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
}

Word Start::axiom() {
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

void Start::read(const Statement& statement) {
    if (statement.kind == StatementKind::Generations) {
        generations_ = static_cast<std::uint32_t>(evaluate(statement.expr, environment_));
    } else if (statement.kind == StatementKind::Define || statement.kind == StatementKind::Param) {
        system_.constants[statement.name] = value_of(statement);
    } else if (statement.kind == StatementKind::Function) {
        // The body will be evaluated with all constants, also later ones. Later constants
        // change nothing, because no constant is defined twice.
        system_.functions[statement.name] = {statement.names, statement.expr, {}};
    } else if (statement.kind == StatementKind::Curve) {
        UserFunction& curve = system_.functions[statement.name];
        for (const auto& [x, y] : statement.points) {
            curve.points.emplace_back(evaluate(x, environment_), evaluate(y, environment_));
        }
    } else if (statement.kind == StatementKind::Sense) {
        read_sense(statement);
    } else if (statement.kind == StatementKind::Object) {
        system_.objects[statement.name] = &statement;
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
        read_production(statement.production);
    }
}

void Start::read_sense(const Statement& statement) {
    DeclaredSense& declared = system_.senses.emplace_back();
    declared.statement = &statement;
    for (const SenseKey& key : statement.sense.keys) {
        std::vector<float>& values = declared.values.emplace_back();
        for (const Expr& expr : key.numbers) {
            values.push_back(evaluate(expr, environment_));
        }
    }
}

void Start::read_production(const Production& production) {
    for (const ModuleUse& use : production.successor) {
        system_.mentioned.insert(use.name);
    }
    for (const ModulePattern& module : production.predecessor) {
        system_.mentioned.insert(module.name);
    }
    productions_[production.stage].push_back(&production);
}

// "The choice is draw 0 at position 2^64 - 1, generation 0xFFFFFFFF."
const Start::Axiom& Start::choose_axiom() const {
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
std::size_t Start::number_of(const std::string& rule) {
    std::vector<std::string>& rules = system_.rules;
    for (std::size_t k = 0; k < rules.size(); ++k) {
        if (rules[k] == rule) {
            return k;
        }
    }
    rules.push_back(rule);
    return rules.size() - 1;
}

// A random range uses up its draw index even if -D replaces the expression that contains it.
float Start::value_of(const Statement& statement) {
    for (const auto& [name, number] : request_.definitions) {
        if (name == statement.name) {
            range_number_ += count_ranges(statement.expr);
            return number;
        }
    }
    return finite(evaluate(statement.expr, environment_));
}

} // namespace lsys::reference
