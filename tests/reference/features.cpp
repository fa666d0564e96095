// SPDX-License-Identifier: MIT
#include "tests/reference/features.h"

#include "tests/reference/evaluate.h"

#include <algorithm>
#include <map>

namespace lsys::reference {

namespace {

class Finder {
public:
    Finder(const Case& test_case, const Derivation& derivation)
        : test_case_(test_case), derivation_(derivation) {}

    std::set<std::string> find() {
        files();
        words();
        for (const Statement* statement : statements_in_order(test_case_.grammar)) {
            look_at(*statement);
        }
        groups();
        if (derivation_.error) {
            static const std::vector<std::string> kErrors = {
                "error: not finite",        "error: bad range",         "error: bad weight",
                "error: unmatched bracket", "error: unmatched polygon", "error: no answer"};
            found_.insert(kErrors[static_cast<std::size_t>(derivation_.error->failure)]);
        }
        if (!test_case_.request.definitions.empty()) {
            found_.insert("definition on the command line");
        }
        return found_;
    }

private:
    void files() {
        const std::vector<File>& files = test_case_.grammar.files;
        if (files.size() > 1) {
            found_.insert("include");
        }
        for (const File& file : files) {
            if (file.letters) {
                found_.insert(&file == &files[0] ? "letters" : "letters in an included file");
            } else if (files[0].letters) {
                found_.insert("words included by letters");
            }
        }
    }

    void words() {
        const Word& last = derivation_.words.back();
        for (const Module& module : last) {
            for (const float value : module.values) {
                if (value != static_cast<float>(static_cast<int>(std::clamp(value, -1e9F, 1e9F)))) {
                    found_.insert("fractions in the word");
                }
            }
        }
        if (last.size() > 1000) {
            found_.insert("more than 1,000 modules");
        }
        if (derivation_.words.front().size() > 256) {
            found_.insert("more than 256 modules in the axiom");
        }
        if (last.empty()) {
            found_.insert("empty word");
        }
    }

    void look_at(const Statement& statement) {
        if (statement.kind == StatementKind::Set) {
            found_.insert("set " + statement.name + " " + statement.text);
        } else if (statement.kind == StatementKind::Define) {
            expression(statement.expr, "define: ");
            for (const auto& definition : test_case_.request.definitions) {
                if (definition.first == statement.name && ranges_ > 0) {
                    found_.insert("definition replaces a range");
                }
            }
            ranges_ = 0;
        } else if (statement.kind == StatementKind::Param) {
            expression(statement.expr, "param: ");
        } else if (statement.kind == StatementKind::Axiom) {
            if (statement.has_probability) {
                found_.insert("several axioms");
            }
            for (const ModuleUse& use : statement.modules) {
                for (const Expr& argument : use.arguments) {
                    expression(argument, "axiom: ");
                }
            }
        } else if (statement.kind == StatementKind::Production) {
            production(statement.production);
        } else if (statement.kind == StatementKind::Function ||
                   statement.kind == StatementKind::Curve) {
            const bool is_curve = statement.kind == StatementKind::Curve;
            defined_[statement.name] = is_curve ? "call of a curve" : "call of a function";
        } else if (statement.kind == StatementKind::Consider) {
            found_.insert("consider");
        } else if (statement.kind == StatementKind::Material) {
            found_.insert("material");
        }
    }

    void production(const Production& production) {
        if (production.stage == Stage::Interpret) {
            found_.insert("interpret");
        }
        if (derivation_.applications.count(production.label) == 0) {
            return;
        }
        const std::string mode = setting(test_case_.grammar, "rewriting").value_or("parallel");
        if (production.stage == Stage::Decompose) {
            found_.insert("decompose, " + mode);
        }
        if (production.stage == Stage::Down || production.stage == Stage::Up) {
            const std::string sweep = production.stage == Stage::Down ? "down" : "up";
            found_.insert(sweep);
            found_.insert(production.left || production.right ? sweep + " with a context" : sweep);
            found_.insert(production.probability ? sweep + " by chance" : sweep);
        }
        int polygons = 0;
        for (const ModuleUse& use : production.successor) {
            polygons += use.name == "{" ? 1 : use.name == "}" ? -1 : 0;
            if (use.name == "'" && use.arguments.size() == 3) {
                found_.insert("colour of three parts");
            }
            if (use.name == "%") {
                found_.insert("cut, " + mode);
            }
        }
        if (polygons != 0) {
            found_.insert("polygon along the word");
        }
        if (production.left) {
            found_.insert("left context");
            found_.insert("context, " + mode);
        }
        if (production.right) {
            found_.insert("right context");
            brackets(*production.right);
        }
        if (production.left && production.right) {
            found_.insert("both contexts");
        }
        if (production.predecessor.size() > 1) {
            found_.insert("several predecessor modules, " + mode);
        }
        if (production.successor.empty()) {
            found_.insert("empty successor");
        }
        if (production.probability) {
            if (is_computed(*production.probability)) {
                found_.insert("computed weight");
            }
            const std::string scope = setting(test_case_.grammar, "choice").value_or("module");
            found_.insert("choice " + scope + ", " + mode);
            found_.insert(production.condition ? "probability with condition"
                                               : "probability without condition");
        }
        if (production.condition) {
            expression(*production.condition, "condition: ");
        }
        if (!production.locals.empty()) {
            found_.insert("local values, " + mode);
            for (const auto& [name, value] : production.locals) {
                expression(value, "local: ");
            }
        }
        arguments(production);
        formals(production);
    }

    void brackets(const Pattern& pattern) {
        for (std::size_t i = 0; i + 1 < pattern.size(); ++i) {
            if (pattern[i].name == "[") {
                found_.insert(pattern[i + 1].name == "]" ? "context []" : "context [ ]");
            }
        }
    }

    void arguments(const Production& production) {
        ranges_ = 0;
        for (const ModuleUse& use : production.successor) {
            for (const Expr& argument : use.arguments) {
                expression(argument, "successor: ");
            }
        }
        if (ranges_ > 4) {
            found_.insert("more than four ranges in a successor");
        }
        if (ranges_ > 0) {
            found_.insert(production.probability ? "ranges after a choice" : "ranges, no choice");
        }
    }

    void formals(const Production& production) {
        for (const ModulePattern& module : production.predecessor) {
            for (const std::string& formal : module.formals) {
                if (derivation_.constants.count(formal) != 0) {
                    found_.insert("formal hides a constant");
                }
            }
        }
    }

    // Whether the value depends on the module or on the generation.
    bool is_computed(const Expr& expr) const {
        const bool is_step = expr.kind == ExprKind::Call && expr.text.rfind("step", 0) == 0;
        const bool is_formal =
            expr.kind == ExprKind::Name && derivation_.constants.count(expr.text) == 0;
        return is_step || is_formal ||
               std::any_of(expr.parts.begin(), expr.parts.end(),
                           [&](const Expr& part) { return is_computed(part); });
    }

    void expression(const Expr& expr, const std::string& place) {
        ranges_ += draws(expr) ? 1U : 0U;
        if (expr.kind == ExprKind::Range) {
            found_.insert(place + "range");
        } else if (expr.kind == ExprKind::Call) {
            const auto defined = defined_.find(expr.text);
            found_.insert(defined == defined_.end() ? "function " + expr.text : defined->second);
        } else if (expr.kind == ExprKind::Unary || expr.kind == ExprKind::Binary) {
            found_.insert((expr.kind == ExprKind::Unary ? "unary " : "operator ") + expr.text);
        } else if (expr.kind == ExprKind::Number && expr.text.size() > 30) {
            found_.insert("literal near the middle of two values");
        }
        for (const Expr& part : expr.parts) {
            if (expr.kind == ExprKind::Range && part.kind == ExprKind::Range) {
                found_.insert("range in a range");
            }
            expression(part, place);
        }
    }

    // Finds groups in which several productions with `~` were applied, or one production with `~`
    // and one without.
    void groups() {
        std::map<std::string, std::vector<const Production*>> groups;
        for (const Statement* statement : statements_in_order(test_case_.grammar)) {
            if (statement->kind == StatementKind::Production) {
                groups[group_of(statement->production)].push_back(&statement->production);
            }
        }
        for (const auto& [group, productions] : groups) {
            std::size_t chosen = 0;
            std::size_t plain = 0;
            for (const Production* production : productions) {
                const bool applied = derivation_.applications.count(production->label) != 0;
                chosen += applied && production->probability ? 1U : 0U;
                plain += applied && !production->probability ? 1U : 0U;
            }
            if (chosen > 1) {
                found_.insert("several chosen in a group");
            }
            if (chosen > 0 && plain > 0) {
                found_.insert("chosen and taken in a group");
            }
        }
    }

    const Case& test_case_;
    const Derivation& derivation_;
    std::set<std::string> found_;
    std::map<std::string, std::string> defined_; // functions of the grammar and their feature
    std::size_t ranges_ = 0;
};

} // namespace

std::set<std::string> features_of(const Case& test_case, const Derivation& derivation) {
    return Finder(test_case, derivation).find();
}

const std::vector<std::string>& feature_names() {
    static const std::vector<std::string> kNames = {"include",
                                                    "letters",
                                                    "letters in an included file",
                                                    "words included by letters",
                                                    "fractions in the word",
                                                    "more than 1,000 modules",

                                                    "definition on the command line",
                                                    "definition replaces a range",
                                                    "more than 256 modules in the axiom",
                                                    "set rewriting sequential",
                                                    "set rewriting cyclic",
                                                    "set rewriting leftmost",
                                                    "set choice generation",
                                                    "set weights any",
                                                    "define: range",
                                                    "param: range",
                                                    "axiom: range",
                                                    "successor: range",
                                                    "local: range",
                                                    "local values, parallel",
                                                    "local values, sequential",
                                                    "local values, cyclic",
                                                    "local values, leftmost",
                                                    "left context",
                                                    "right context",
                                                    "both contexts",
                                                    "context, parallel",
                                                    "context, sequential",
                                                    "context, cyclic",
                                                    "context, leftmost",
                                                    "context []",
                                                    "context [ ]",
                                                    "several predecessor modules, sequential",
                                                    "several predecessor modules, cyclic",
                                                    "several predecessor modules, leftmost",
                                                    "empty successor",
                                                    "choice module, parallel",
                                                    "choice module, sequential",
                                                    "choice module, cyclic",
                                                    "choice module, leftmost",
                                                    "choice generation, parallel",
                                                    "choice generation, sequential",
                                                    "choice generation, cyclic",
                                                    "choice generation, leftmost",
                                                    "probability with condition",
                                                    "probability without condition",
                                                    "more than four ranges in a successor",
                                                    "ranges after a choice",
                                                    "ranges, no choice",
                                                    "formal hides a constant",
                                                    "range in a range",
                                                    "literal near the middle of two values",
                                                    "several chosen in a group",
                                                    "chosen and taken in a group",
                                                    "error: not finite",
                                                    "error: bad range",
                                                    "error: bad weight",
                                                    "computed weight",
                                                    "several axioms",
                                                    "error: unmatched bracket",
                                                    "error: unmatched polygon",
                                                    "polygon along the word",
                                                    "colour of three parts",
                                                    "material",
                                                    "interpret",
                                                    "unary -",
                                                    "unary !",
                                                    "operator +",
                                                    "operator -",
                                                    "operator *",
                                                    "operator /",
                                                    "operator ^",
                                                    "operator <",
                                                    "operator <=",
                                                    "operator >",
                                                    "operator >=",
                                                    "operator ==",
                                                    "operator !=",
                                                    "operator &&",
                                                    "operator ||",
                                                    "function sin",
                                                    "function cos",
                                                    "function tan",
                                                    "function asin",
                                                    "function acos",
                                                    "function atan",
                                                    "function atan2",
                                                    "function sqrt",
                                                    "function exp",
                                                    "function log",
                                                    "function pow",
                                                    "function abs",
                                                    "function floor",
                                                    "function ceil",
                                                    "function round",
                                                    "function sign",
                                                    "function min",
                                                    "function max",
                                                    "function mod",
                                                    "function if",
                                                    "function clamp",
                                                    "function mix",
                                                    "function normal",
                                                    "function poisson",
                                                    "function binomial",
                                                    "call of a function",
                                                    "call of a curve",
                                                    "function step",
                                                    "function steps",
                                                    "consider",
                                                    "decompose, parallel",
                                                    "decompose, sequential",
                                                    "decompose, cyclic",
                                                    "decompose, leftmost",
                                                    "down",
                                                    "down with a context",
                                                    "down by chance",
                                                    "up",
                                                    "up with a context",
                                                    "up by chance",
                                                    "cut, parallel",
                                                    "cut, sequential",
                                                    "cut, cyclic",
                                                    "cut, leftmost"};
    return kNames;
}

} // namespace lsys::reference
