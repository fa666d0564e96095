// SPDX-License-Identifier: MIT
// The min, max and expected number of modules of each class in a word, generation by generation. A
// GrowthWalk holds the counts of one generation; advance() computes the counts of the next.
#pragma once

#include "compiler/growth/growth.h"
#include "compiler/growth/impl/module_classes.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lsys::analysis {

/// Whether two counts are equal: as numbers, or as logarithms if both exceed 2^128 - 1.
[[nodiscard]] bool same(const Count& a, const Count& b);
[[nodiscard]] bool same(const GenerationSize& a, const GenerationSize& b);
[[nodiscard]] bool less(const Count& a, const Count& b);
/// The size of a generation that is one module with this code.
[[nodiscard]] GenerationSize size_of(const Bytecode& bytecode, Code code);

class GrowthWalk {
public:
    /// Begins at the axiom. `classes` must outlive the walk.
    explicit GrowthWalk(ModuleClasses& classes);

    [[nodiscard]] std::uint32_t age() const { return age_; }
    /// Rewrites the word into the word of the next generation.
    void advance();

    /// Bounds of the size of the word.
    [[nodiscard]] GenerationSize low() const { return total(low_, true); }
    [[nodiscard]] GenerationSize high() const { return total(high_, false); }
    [[nodiscard]] double expected_modules() const;
    /// Whether the expected counts are known: every outcome so far had a known probability.
    [[nodiscard]] bool probabilities_known() const { return probabilities_known_; }
    /// Whether no production can change the current word or later words.
    [[nodiscard]] bool is_final();
    /// A sense module or swept module of the word whose new parameters decide how a module of the
    /// word is rewritten; kNoSymbol if there is none.
    [[nodiscard]] SymbolId cause_of_next() const;
    /// Whether a generation is a linear map of the counts. The map may depend on the age only by
    /// the choice of the rule in cyclic rewriting.
    [[nodiscard]] bool is_linear() const;
    /// The production that writes the most modules of the next generation.
    [[nodiscard]] ProductionId dominant();
    /// Number of terms processed so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

    /// Bounds of the number of modules of a class in the word.
    [[nodiscard]] Count low(ClassId id) const { return at(low_, id); }
    [[nodiscard]] Count high(ClassId id) const { return at(high_, id); }
    [[nodiscard]] std::span<const ClassId> present() const { return present_; }
    /// Replaces the word by a word of age `age` with these counts by class.
    void load(std::uint32_t age, std::span<const Count> low, std::span<const Count> high);

private:
    /// A rule with several predecessor modules.
    struct SequenceRule {
        std::vector<std::pair<SymbolId, std::uint32_t>> uses; // modules that a match replaces
        std::vector<ClassTerm> max_written; // max count of modules of each class per match
        ProductionId first = kNoProduction; // first production of the rule
    };
    struct Rule {
        SymbolId symbol = kNoSymbol;    // the predecessor, if it is one module
        std::uint32_t sequence = kNone; // index in sequences_, if it is several modules
    };

    static Count at(const std::vector<Count>& counts, ClassId id) {
        const auto i = static_cast<std::size_t>(id);
        return i < counts.size() ? counts[i] : Count{};
    }
    void list_rules();
    /// Rewrites the modules of the word that a rule matches.
    void apply_rule(const Rule& rule);
    /// Replaces all modules of these classes by their outcomes.
    void rewrite(std::span<const ClassId> ids);
    /// Subtracts the modules that the rule replaces from the lower bounds, because up to `matches`
    /// matches may occur.
    void subtract_replaced(const SequenceRule& rule, const Count& matches);
    /// Adds the modules that `matches` matches of the rule write to the upper bounds.
    void add_written(const SequenceRule& rule, const Count& matches);
    /// Max number of matches of the rule in the word.
    [[nodiscard]] Count max_matches(const SequenceRule& rule) const;
    /// Adds a class to present_, unless present_ has it.
    void add_present(ClassId id);
    /// Extends the lists of counts to classes that were added.
    void reserve_counts();
    void index_by_symbol();
    /// Removes classes without modules from present_.
    void drop_absent();
    /// The size of a word with these counts by class. `is_low`: the counts are lower bounds.
    [[nodiscard]] GenerationSize total(const std::vector<Count>& counts, bool is_low) const;

    ModuleClasses* classes_;
    std::uint32_t age_ = 0;
    bool probabilities_known_ = true; // else expected_ has no meaning
    std::vector<Count> low_;          // by class: min number; high_: max, expected_: mean
    std::vector<Count> high_;
    std::vector<double> expected_;
    std::vector<bool> is_present_; // by class: it is in present_
    std::vector<ClassId> present_; // classes with modules in the word
    std::vector<Rule> rules_;      // used in rewriting modes with a pass per rule
    std::vector<SequenceRule> sequences_;
    /// The classes in present_, by SymbolId.
    std::unordered_map<std::uint32_t, std::vector<ClassId>> by_symbol_;
    std::uint64_t work_ = 0; // see work()
};

} // namespace lsys::analysis
