// SPDX-License-Identifier: MIT
// Random productions, and modules of successors and of the axiom. A bundle is a list of productions
// with one predecessor and one pair of contexts, whose conditions and probabilities are legal
// together.

#pragma once

#include "tests/reference/generate_expression.h"
#include "tests/reference/generate_plan.h"
#include "tests/reference/grammar.h"
#include "tests/reference/random.h"

#include <string>
#include <vector>

namespace lsys::reference {

// The names of a successor or axiom without arguments, brackets among them.
using Skeleton = std::vector<Species>;

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
    // Probabilities whose sum is nearly 1; with `weights any`, arbitrary weights.
    std::vector<float> shares(int count);
    // An expression with the value `value`. `formals` hide constants, so it must not name them.
    Expr probability(float value, const std::vector<std::string>& formals);

private:
    const Species& any_species(bool letters);
    // An argument of a module. In a plant that senses, lengths and turns have the size of a plant's.
    Expr argument(const Species& species, const Scope& scope);
    const Species& active_species(bool letters);
    Skeleton skeleton(int length, bool letters, bool polygon);
    const Skeleton& common_skeleton(bool letters);
    Production shape(bool letters);
    std::vector<Production> bundle_of(const Production& shape, bool letters);
    std::vector<ModuleUse>
    successor(const Production& production, const Scope& scope, bool letters);
    Pattern context(int length, bool brackets, int depth, bool letters);
    // Gives the modules of `pattern` names for their parameters, each only once in `used`.
    void name_formals(Pattern& pattern, std::vector<std::string>& used);
    std::string name_local(const std::vector<std::string>& used);
    Expr weight(const Scope& scope);

    Random& random_;
    const Plan& plan_;
    ExpressionMaker expressions_;
    const Constants& constants_;
    // Index of the next active species, so that productions rewrite each of them.
    std::size_t turn_ = 0;
    // Skeletons from which successors are often made and contexts are cut, so that contexts match.
    std::vector<Skeleton> skeletons_;
    std::vector<Skeleton> skeletons_of_letters_;
};

} // namespace lsys::reference
