// SPDX-License-Identifier: MIT
#include "tests/reference/features.h"

#include <algorithm>

namespace lsys::reference {

namespace {

bool senses(const Pattern& pattern) {
    return std::any_of(pattern.begin(), pattern.end(),
                       [](const ModulePattern& module) { return is_sense_name(module.name); });
}

// Features of an environment that has answered.
void add_sense(const Sense& sense, std::set<std::string>& found) {
    for (const SenseKey& key : sense.keys) {
        if (key.key == "shape") {
            found.insert(key.word.empty() ? "shape of a mesh" : "shape " + key.word);
        } else if (sense.kind == "solid") {
            found.insert("solid of a " + key.key);
        }
        const bool computed = std::any_of(key.numbers.begin(), key.numbers.end(),
                                          [](const Expr& expr) { return expr.text == "+"; });
        found.insert(computed ? "key from a constant" : "key as a literal");
    }
}

void add_production(const Production& production, std::set<std::string>& found) {
    if (senses(production.predecessor)) {
        switch (production.stage) {
        case Stage::Interpret:
            found.insert("sense module interpreted");
            break;
        case Stage::Decompose:
            found.insert("sense module decomposed");
            break;
        case Stage::Down:
        case Stage::Up:
            found.insert("sense module swept");
            break;
        default:
            found.insert("sense module rewritten");
        }
    }
    if ((production.left && senses(*production.left)) ||
        (production.right && senses(*production.right))) {
        found.insert("sense module in a context");
    }
    if (production.stage == Stage::Interpret) {
        found.insert("interpretation moves places");
    }
}

} // namespace

std::set<std::string> sense_features_of(const Case& test_case, const Derivation& derivation) {
    std::set<std::string> found;
    for (const auto& [kind, answered] : derivation.answered) {
        if (answered.other_than_zero > 0) {
            found.insert("answers of kind " + kind);
        }
    }
    for (const Statement* statement : statements_in_order(test_case.grammar)) {
        if (statement->kind == StatementKind::Sense &&
            derivation.answered.count(statement->sense.kind) != 0) {
            add_sense(statement->sense, found);
        } else if (statement->kind == StatementKind::Production &&
                   derivation.applications.count(statement->production.label) != 0) {
            add_production(statement->production, found);
        } else if (statement->kind == StatementKind::Object && !statement->mesh.empty()) {
            found.insert("object of a mesh");
        } else if (statement->kind == StatementKind::Set) {
            found.insert("set " + statement->name);
        }
    }
    for (const Module& module : derivation.words.back()) {
        if (is_sense_name(module.name)) {
            found.insert(module.values.empty()      ? "sense module without parameters"
                         : module.values.size() > 4 ? "sense module with parameters of its own"
                                                    : "sense module with an answer");
            found.insert(test_case.grammar.files[0].letters ? "sense module of letters"
                                                            : "sense module of words");
        }
    }
    if (derivation.error) {
        found.insert(derivation.error->failure == Failure::NoAnswer ? "error: no answer"
                                                                    : "another error");
    }
    return found;
}

const std::vector<std::string>& sense_feature_names() {
    static const std::vector<std::string> kNames = {"answers of kind turtle",
                                                    "answers of kind shadow",
                                                    "answers of kind sky",
                                                    "answers of kind space",
                                                    "answers of kind crowd",
                                                    "answers of kind solid",
                                                    "answers of kind map",
                                                    "answers of kind program",
                                                    "shape box",
                                                    "shape ball",
                                                    "shape dome",
                                                    "shape cone",
                                                    "shape of a mesh",
                                                    "solid of a mesh",
                                                    "solid of a plane",
                                                    "key from a constant",
                                                    "key as a literal",
                                                    "object of a mesh",
                                                    "set tropism",
                                                    "set turtle",
                                                    "set step_scale",
                                                    "set interpret_depth",
                                                    "interpretation moves places",
                                                    "sense module interpreted",
                                                    "sense module decomposed",
                                                    "sense module swept",
                                                    "sense module rewritten",
                                                    "sense module in a context",
                                                    "sense module without parameters",
                                                    "sense module with parameters of its own",
                                                    "sense module with an answer",
                                                    "sense module of letters",
                                                    "sense module of words",
                                                    "another error"};
    return kNames;
}

} // namespace lsys::reference
