// Classes of modules that are rewritten alike: what the growth analysis counts instead of modules.
// A class is a code and, of its parameters, the exact values of those that can decide which
// production is taken, as far as they are known before the derivation. So A(12), whose condition
// reads its parameter, is another class than A(11), while F(2) and F(2.2) are one where no
// condition asks. A class whose values are not known stands for every value. Values stop being told
// apart when there are more than kMaxValuedClasses; what is said of a class then stays true but is
// less sharp.
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

/// `count` modules of class `target`.
struct ClassTerm {
    ClassId target{};
    std::uint32_t count = 0;
};

/// One way in which a module of a class may be rewritten.
struct ClassOutcome {
    ProductionId production = kNoProduction; // none: the module is copied
    TableRange terms;                        // in ModuleClasses::terms
    double probability = 1.0;
};

/// All ways, and the least and the greatest number of modules of each class that they can yield.
struct ClassExpansion {
    bool done = false;
    bool decided = false;   // the probabilities of the outcomes are known
    bool copies = false;    // the module may be copied, no production matching
    bool unchanged = false; // every outcome yields the very same module
    TableRange outcomes;    // in ModuleClasses::outcomes
    TableRange low;         // in ModuleClasses::terms
    TableRange high;
};

class ModuleClasses {
public:
    static constexpr std::uint32_t kMaxValuedClasses = 4096;
    /// Instructions and template codes after which classes are no longer told apart by values.
    static constexpr std::uint64_t kMaxWork = 20'000'000;

    /// `bytecode` is verified and outlives this; `steps` is the number of generations asked for.
    ModuleClasses(const Bytecode& bytecode, std::uint32_t steps);

    [[nodiscard]] const Bytecode& bytecode() const { return *bytecode_; }
    [[nodiscard]] std::size_t count() const { return classes_.size(); }
    [[nodiscard]] Code code(ClassId id) const { return classes_[number(id)].code; }
    [[nodiscard]] SymbolId symbol(ClassId id) const { return bytecode_->symbol_of(code(id)); }
    /// The parameters of a class: exact where known.
    [[nodiscard]] std::vector<KnownValue> parameters(ClassId id) const;

    /// The classes of the axiom.
    [[nodiscard]] std::vector<ClassTerm> axiom();
    /// The classes of a production's successor where nothing is known of its formals.
    [[nodiscard]] std::vector<ClassTerm> successor(ProductionId production);
    /// What becomes of a module of a class in a word of age `age`. May add classes. The result and
    /// ranges taken from it hold until the age changes.
    const ClassExpansion& expand(ClassId id, std::uint32_t age);
    /// Whether what becomes of a class can depend on the age of the word.
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
        std::uint32_t first_value = 0; // in values_: its relevant parameters; kNone without any
    };
    /// A module of a word whose class depends on values.
    struct VariableModule {
        Code code = 0;
        std::uint32_t first_argument = 0; // in argument_starts_: its relevant arguments
    };
    /// A word; its modules with fixed classes are counted together.
    struct CountedWord {
        bool made = false;
        std::vector<ClassTerm> fixed;
        std::vector<VariableModule> variable;
    };
    struct Match {
        std::uint32_t production = kNone; // kNone: none, the module is copied
        double probability = 0.0;

        friend bool operator==(const Match&, const Match&) = default;
    };
    struct Matches {
        std::vector<Match> list;
        bool decided = true;
    };

    static std::size_t number(ClassId id) { return static_cast<std::size_t>(id); }
    ClassId add_class(Code code, std::uint32_t first_value);
    ClassId fixed_class(Code code);
    ClassId valued_class(Code code, std::span<const KnownValue> values);
    ClassId unknown_class(Code code);
    void count_word(const WordTemplate& word, CountedWord& out);
    /// Appends the terms of a word to terms_, merged and in order of classes.
    TableRange instantiate(const CountedWord& word, const Surroundings& surroundings);

    [[nodiscard]] Surroundings surroundings(std::span<const KnownValue> formals) const;
    KnownValue condition(std::uint32_t production, std::span<const KnownValue> parameters);
    /// What may be taken where every condition is evaluated at `point`, but those of productions
    /// with contexts at `sure`.
    Matches
    match(SymbolId symbol, std::span<const KnownValue> point, std::span<const KnownValue> sure);
    Matches match_everywhere(SymbolId symbol, std::span<const KnownValue> parameters);
    ClassExpansion
    expand_matches(const Matches& matches, ClassId self, std::span<const KnownValue> parameters);
    void add_bounds(ClassExpansion& expansion);
    [[nodiscard]] bool is_unchanged(const ClassExpansion& expansion, Code code) const;
    [[nodiscard]] bool is_identity(Code code, std::uint32_t production) const;
    [[nodiscard]] bool exhausted() const { return work_ + evaluator_.work() > kMaxWork; }

    const Bytecode* bytecode_;
    ProductionIndex index_;
    std::uint32_t steps_;
    bool covers_folded_ = false;
    std::uint32_t age_ = 0; // of the expansions

    std::vector<Class> classes_;
    std::vector<KnownValue> values_;
    std::vector<std::uint32_t> fixed_ids_;   // by code; kNone while there is none
    std::vector<std::uint32_t> unknown_ids_; // by code: nothing is known of its relevant parameters
    std::map<std::vector<std::uint32_t>, ClassId> valued_ids_; // with some known value
    std::vector<ClassExpansion> expansions_;
    std::unordered_map<std::uint32_t, ClassExpansion> shared_; // by symbol: nothing is known
    std::vector<ClassOutcome> outcomes_;
    std::vector<ClassTerm> terms_;
    std::unordered_map<std::uint32_t, CountedWord> words_; // by production
    std::vector<std::uint32_t> argument_starts_;
    std::vector<std::uint32_t> code_counts_; // scratch of count_word
    std::vector<KnownValue> formals_;        // scratch of condition

    Evaluator evaluator_;
    std::uint64_t work_ = 0;
};

} // namespace lsys::analysis
