// SPDX-License-Identifier: MIT
// Makes random productions, and the modules of successors and of the axiom. A bundle is a list of
// productions with the same predecessor and contexts; their conditions and probabilities are legal
// together.

#pragma once

#include "tests/reference/generate_expression.h"
#include "tests/reference/generate_plan.h"
#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <string>
#include <vector>

namespace lsys::reference {

// The names of a successor or axiom without arguments; its brackets are included.
using KindList = std::vector<ModuleKind>;

class ProductionMaker {
public:
    ProductionMaker(Random& random, const Plan& plan, const Constants& constants)
        : random_(random), plan_(plan), expressions_(random, constants), constants_(constants) {}

    // Makes a bundle (see the top of this file) with empty labels. `letters`: for a file with
    // `#set names letters`.
    std::vector<Production> bundle(bool letters);
    // Makes a bundle of a sweep, Stage::Down or Stage::Up.
    std::vector<Production> sweep_bundle(Stage stage, bool letters);

    std::vector<ModuleUse> modules(int length, const Scope& scope, bool letters);
    // Probabilities whose sum is nearly 1; arbitrary weights if the grammar has `weights any`.
    std::vector<float> shares(int count);
    // An expression with the value `value`. It must not name constants that are hidden by
    // `formals`.
    Expr probability(float value, const std::vector<std::string>& formals);

private:
    const ModuleKind& any_kind(bool letters);
    // An argument of a module. In a plant that senses, most lengths and turns are those of a plant.
    Expr argument(const ModuleKind& kind, const Scope& scope);
    const ModuleKind& active_kind(bool letters);
    KindList random_list(int length, bool letters, bool polygon);
    const KindList& common_list(bool letters);
    Production shape(bool letters); // predecessor and contexts
    // Makes productions with the predecessor and the contexts of `shape`.
    std::vector<Production> bundle_of(const Production& shape, bool letters);
    std::vector<ModuleUse>
    successor(const Production& production, const Scope& scope, bool letters);
    Pattern context(int length, bool brackets, int depth, bool letters);
    // Names the parameters of the modules in `pattern`; each name in `used` is used only once.
    void name_formals(Pattern& pattern, std::vector<std::string>& used);
    std::string name_local(const std::vector<std::string>& used);
    Expr weight(const Scope& scope); // depends on the module

    Random& random_;
    const Plan& plan_;
    ExpressionMaker expressions_;
    const Constants& constants_;
    // Index of the kind that the next production rewrites; each active kind gets its turn.
    std::size_t next_active_kind_ = 0;
    // Skeletons from which successors are often made, and from which contexts are cut, so that
    // contexts match words.
    std::vector<KindList> lists_;
    std::vector<KindList> lists_of_letters_;
};

} // namespace lsys::reference
