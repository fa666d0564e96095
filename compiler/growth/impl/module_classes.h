// SPDX-License-Identifier: MIT
// Classes of modules that are rewritten alike, which the growth analysis counts instead of modules.
// A class is a code and the known values of its relevant parameters (production_index.h). If a
// condition reads the parameter of A, A(12) and A(11) are two classes; F(2) and F(2.2) are one
// class if the parameter of F is not relevant. An unknown value stands for every value. Beyond
// kMaxClassesWithKnownValues classes, new classes have no known values: bounds stay valid but
// become wider.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/growth/impl/known_values.h"
#include "compiler/growth/production_index.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace lsys::analysis {

enum class ClassId : std::uint32_t {};

/// A number of modules, `count`, of class `target`.
struct ClassTerm {
    ClassId target{};
    std::uint32_t count = 0;
};

/// A possible rewriting of a module of a class.
struct ClassOutcome {
    ProductionId production = kNoProduction; // kNoProduction: the module is copied
    TableRange terms;                        // range of ModuleClasses::terms
    double probability = 1.0;
};

/// All outcomes of a class, and the min and max number of modules of each class among them.
struct ClassExpansion {
    bool done = false;                // the outcomes have been computed
    bool probabilities_known = false; // the probabilities of the outcomes are known
    bool copies = false;    // the module may be copied, since possibly no production matches
    bool unchanged = false; // every outcome is the module itself with the same parameters
    TableRange outcomes;    // range of ModuleClasses::outcomes
    TableRange low;         // range of ModuleClasses::terms, as is `high`
    TableRange high;
};

class ModuleClasses {
public:
    /// Max number of classes with known values. Further classes have no known values.
    static constexpr std::uint32_t kMaxClassesWithKnownValues = 4096;
    /// Max of instructions run plus template codes read. Once it is reached, new classes have no
    /// known values.
    static constexpr std::uint64_t kMaxWork = 20'000'000;

    /// `bytecode` is verified and outlives this object; `steps` is the number of generations asked
    /// for.
    ModuleClasses(const Bytecode& bytecode, std::uint32_t steps);

    [[nodiscard]] const Bytecode& bytecode() const { return *bytecode_; }
    [[nodiscard]] std::size_t count() const { return classes_.size(); }
    [[nodiscard]] Code code(ClassId id) const { return classes_[number(id)].code; }
    [[nodiscard]] SymbolId symbol(ClassId id) const { return bytecode_->symbol_of(code(id)); }
    /// The parameters of a class; known ones are exact.
    [[nodiscard]] std::vector<KnownValue> parameters(ClassId id) const;

    /// The first word of a derivation: an outcome for each axiom.
    [[nodiscard]] ClassExpansion start();
    /// The classes of a production's successor for unknown formals.
    [[nodiscard]] std::vector<ClassTerm> successor(ProductionId production);
    /// The outcomes of a class in a word of age `age`. May add classes. The result and its ranges
    /// are valid until the age changes.
    const ClassExpansion& expand(ClassId id, std::uint32_t age);
    /// Per symbol: the symbols (itself, or symbols in contexts) whose parameters an answer or a
    /// sweep changes, and whose parameters decide how modules of the symbol are rewritten.
    [[nodiscard]] std::span<const SymbolId> causes(SymbolId symbol) const {
        return causes_[static_cast<std::size_t>(symbol)];
    }
    /// Whether outcomes can depend on the age of the word.
    [[nodiscard]] bool depends_on_age() const { return index_.depends_on_age(); }
    [[nodiscard]] bool expanded(ClassId id) const {
        return number(id) < expansions_.size() && expansions_[number(id)].done;
    }

    [[nodiscard]] std::span<const ClassTerm> terms(TableRange range) const {
        return std::span(terms_).subspan(range.first, range.count);
    }
    [[nodiscard]] std::span<const ClassOutcome> outcomes(TableRange range) const {
        return std::span(outcomes_).subspan(range.first, range.count);
    }

    [[nodiscard]] const ProductionIndex& productions() const { return index_; }
    /// Whether classes without known values may also stand for folded modules.
    [[nodiscard]] bool covers_folded() const { return covers_folded_; }

private:
    struct Class {
        Code code = 0;
        std::uint32_t first_value = 0; // index in values_ of its relevant parameters, or kNone
    };
    /// A module of a word whose class depends on values.
    struct VariableModule {
        Code code = 0;
        std::uint32_t first_argument = 0; // index in argument_starts_ of its relevant arguments
    };
    /// A word, with modules of fixed classes counted by class.
    struct CountedWord {
        bool is_counted = false;              // the modules have been counted
        std::uint32_t locals = kNone;         // see WordTemplate::locals
        std::vector<ClassTerm> fixed;         // modules of fixed classes
        std::vector<VariableModule> variable; // the other modules
    };
    struct Match {
        std::uint32_t production = kNone; // kNone: no production matches, the module is copied
        double probability = 0.0;

        friend bool operator==(const Match&, const Match&) = default;
    };
    struct Matches {
        std::vector<Match> list;
        bool probabilities_known = true; // else Match::probability has no meaning
    };

    void fill_causes(); // sets what causes() returns
    static std::size_t number(ClassId id) { return static_cast<std::size_t>(id); }
    ClassId add_class(Code code, std::uint32_t first_value);
    /// The class of a code without relevant stored parameters.
    ClassId fixed_class(Code code);
    ClassId class_with_known_values(Code code, std::span<const KnownValue> values);
    /// The class of a code with unknown parameters.
    ClassId unknown_class(Code code);
    /// Counts the modules of a word whose classes are fixed, and lists the others.
    void count_word(const WordTemplate& word, CountedWord& out);
    /// Appends the terms of a word to terms_, merged and in order of classes.
    TableRange instantiate(const CountedWord& word, const ExpressionInputs& inputs);

    [[nodiscard]] ExpressionInputs inputs(std::span<const KnownValue> formals) const;
    /// Whether an answer of an environment or a sweep may change the parameter.
    [[nodiscard]] bool may_change(SymbolId symbol, std::uint32_t parameter) const {
        return parameter < changed_parameters_[static_cast<std::size_t>(symbol)];
    }
    /// The value of the condition of a production for a module with these parameters.
    KnownValue condition(std::uint32_t production, std::span<const KnownValue> parameters);
    KnownValue weight_of(std::uint32_t production, std::span<const KnownValue> parameters);
    KnownValue value_of(std::uint32_t production,
                        std::uint32_t first_instruction,
                        std::span<const KnownValue> parameters);
    /// The productions that may rewrite a module. Conditions are evaluated for the parameters
    /// `point`; conditions of productions with contexts, which are not in the grid, for
    /// `parameters`.
    Matches match(SymbolId symbol,
                  std::span<const KnownValue> point,
                  std::span<const KnownValue> parameters);
    /// The matches of a module over all values of its unknown parameters.
    Matches match_everywhere(SymbolId symbol, std::span<const KnownValue> parameters);
    /// The outcomes of matches. Does not set ClassExpansion::unchanged. `self`: the module's class.
    ClassExpansion
    expand_matches(const Matches& matches, ClassId self, std::span<const KnownValue> parameters);
    /// Stores the outcomes, and the min and max count of each class over them.
    void set_outcomes(const std::vector<ClassOutcome>& outcomes, ClassExpansion& expansion);
    /// Adds the min and max count of each class over the outcomes.
    void add_bounds(ClassExpansion& expansion);
    /// Whether every outcome yields the module itself, and nothing else changes it. More than 16
    /// outcomes count as a change.
    [[nodiscard]] bool is_unchanged(const ClassExpansion& expansion, Code code) const;
    /// Whether the production writes the same module with the same parameters.
    [[nodiscard]] bool is_identity(Code code, std::uint32_t production) const;
    /// Whether kMaxWork is exceeded.
    [[nodiscard]] bool is_work_exhausted() const { return work_ + evaluator_.work() > kMaxWork; }

    const Bytecode* bytecode_;
    ProductionIndex index_;
    std::uint32_t steps_;                           // requested generations
    std::vector<std::uint32_t> changed_parameters_; // see changed_parameters()
    std::vector<std::vector<SymbolId>> causes_;     // by symbol
    bool covers_folded_ = false;                    // see covers_folded()
    std::uint32_t age_ = 0; // age of the word that expansions_ are valid for

    std::vector<Class> classes_;
    std::vector<KnownValue> values_;       // relevant parameters of classes, see Class::first_value
    std::vector<std::uint32_t> fixed_ids_; // by code: the class without values, or kNone
    std::vector<std::uint32_t> unknown_ids_; // by code: the class with unknown values
    std::map<std::vector<std::uint32_t>, ClassId> known_value_ids_; // classes with known values
    std::vector<ClassExpansion> expansions_;
    std::unordered_map<std::uint32_t, ClassExpansion>
        shared_; // by symbol: the expansion of all its classes with unknown values
    std::vector<ClassOutcome> outcomes_;
    std::vector<ClassTerm> terms_;
    std::unordered_map<std::uint32_t, CountedWord> words_; // by production
    std::vector<std::uint32_t> argument_starts_; // first instructions of relevant arguments
    std::vector<std::uint32_t> code_counts_;     // scratch of count_word
    std::vector<KnownValue> formals_;            // scratch of value_of

    Evaluator evaluator_;
    std::uint64_t work_ = 0; // counts towards kMaxWork
};

} // namespace lsys::analysis
