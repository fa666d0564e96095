// SPDX-License-Identifier: MIT
// Plan: a program prepared for rewriting; every decision that does not depend on the module is made
// in advance. Made once per derivation, when the values of the globals are known; updated for each
// generation if a condition, weight or argument depends on step(), and for each rule if a pass
// rewrites one rule only. Read by the passes, by many threads at once.
//
// A row says how modules of a code are rewritten: by one entry, by a random choice among a fixed
// set, by the first comparison that holds, or by conditions and contexts. An entry is a successor:
// the codes to copy, and for each parameter an AffineTerm (shape.h) or an expression.
// Entry c < code_count belongs to code c: the successor of a Fixed row, or the copy that other rows
// write if nothing matches. The other entries follow in the order of the families, so that record
// r > 0 of a module means entry row.base + r. A code whose arguments are known and whose successors
// are folded (fold_reached.h) has a block of entries of its own.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/engine/batch.h"
#include "runtime/derive/engine/eval.h"
#include "runtime/derive/engine/folded_index.h"
#include "runtime/derive/engine/glibc_rule_draws.h"
#include "runtime/derive/engine/shape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace lsys {

/// Max parameters of an entry whose terms are stored in the entry itself.
inline constexpr std::size_t kEntryTerms = 4;
/// Max parameters of a batched entry.
inline constexpr std::uint32_t kMaxBatchedParameters = 16;

/// A successor. Unless `general`, parameter i is own[input[i]] * scale[i] + offset[i], where `own`
/// are the parameters of the rewritten module; with more than kEntryTerms parameters, see
/// terms_or_program.
struct alignas(64) Entry {
    std::array<float, kEntryTerms> scale{};
    std::array<float, kEntryTerms> offset{};
    std::array<std::uint8_t, kEntryTerms> input{};
    std::uint32_t first_code = 0; // index in Plan::pool()
    std::uint32_t code_count = 0;
    std::uint32_t parameter_count = 0;
    /// If `general`: index in Plan::batch_programs(); kNone: evaluate() computes the parameters.
    /// Otherwise, with more than kEntryTerms parameters: index of the first one in Plan::terms().
    std::uint32_t terms_or_program = 0;
    std::uint32_t candidate = kNone; // kNone: a copy of the module
    std::uint32_t first_place = 0;   // of the successor: index in Bytecode::template_codes
    bool general = false;            // parameters need a batch or evaluate()
    bool reads_own = false;          // terms read parameters of the rewritten module
    bool special = false;            // needs more than one wide store of codes and one of terms
    bool batched = false;            // special for its parameters only, which a batch computes
};

static_assert(sizeof(Entry) == 64, "an entry is one line of the cache");

/// The way to choose the successor of a module.
enum class RowKind : std::uint8_t {
    Fixed,   // always the entry of the module's code
    Choice,  // by chance, among the same productions for every module
    Tests,   // by the first comparison of the module's parameters that holds
    General, // by trying the candidates of the family
};

struct Row {
    std::uint32_t base = 0;            // record r > 0 means entry base + r
    std::uint32_t code_count = 0;      // Fixed: codes written
    std::uint32_t parameter_count = 0; // Fixed: parameters written
    std::uint32_t stored = 0;          // parameters of the module in the word
    std::uint32_t constants = kNone;   // folded module: index in Bytecode::constants
    std::uint32_t source = 0;          // index in ChoiceTables::list, TestTables::lists, families_
    std::uint32_t left_guard = kNone;  // General: index in Plan::guards(); kNone: any neighbour
    std::uint32_t right_guard = kNone;
    RowKind kind = RowKind::Fixed;
    bool copies = true; // Fixed: writes the module itself
    bool slow = false;  // entries read the parameters of a folded module
};

/// The productions that are tried for a module, in file order: all productions of its symbol, or in
/// a pass of one rule the productions of the rule.
struct Family {
    std::uint32_t first = 0; // index in candidates
    std::uint32_t count = 0;
    std::uint32_t left_guard = kNone; // index in Plan::guards(); kNone: any neighbour
    std::uint32_t right_guard = kNone;
    bool replaces_several = false; // a match of a candidate replaces several modules
    bool has_context = false;
    bool reads_context = false;         // a formal of a context is used
    bool reads_own = false;             // an entry reads the module's parameters
    bool depends_on_generation = false; // has step(), or a choice per generation
    bool current = false;               // candidates and entries are up to date
};

enum class ConditionKind : std::uint8_t { Always, Never, Comparisons, Expression };

struct Candidate {
    std::uint32_t production = 0;
    std::uint32_t group = 0;            // BytecodeProduction::group
    std::uint32_t modules = 1;          // modules that a match replaces
    std::uint32_t own_first = 0;        // index of the formal of the module's first parameter
    std::uint32_t first_comparison = 0; // index in Plan::comparisons_
    std::uint32_t comparison_count = 0;
    std::uint32_t comparison_room = 0;   // comparisons for which there is room from that index
    std::uint32_t first_term = 0;        // index in Plan::terms() if parameters > kEntryTerms
    std::uint32_t batch_program = kNone; // index in batch_programs(); set when first needed
    float weight = 0.0F;                 // unless computes_weight
    ConditionKind condition = ConditionKind::Always;
    bool stochastic = false;      // has a weight: chosen by chance among its group
    bool computes_weight = false; // code computes the weight for each module
    bool has_context = false;
    bool gathers = false;       // formals must be collected: some are not the module's own
    bool reads_context = false; // some formals belong to contexts
};

/// The alternatives of a Choice row, records with thresholds. The first record whose threshold
/// exceeds the draw is taken, or else the last record.
struct Choice {
    std::uint32_t first = 0; // index in ChoiceTables::thresholds and records
    std::uint32_t count = 0;
    std::uint32_t room = 0; // alternatives for which there is room from `first` on
};

/// One of the tests of a Tests row. The first test in file order that holds decides.
struct Test {
    Comparison comparison;
    std::uint32_t record = 0;
};
struct TestList {
    std::uint32_t first = 0; // index in TestTables::list
    std::uint32_t count = 0;
    std::uint32_t room = 0; // tests for which there is room from `first` on
};

/// Calls visit(R{}) with the unsigned integer type R of a record of `width` bytes, 1 or 4.
template <typename Visit>
decltype(auto) visit_record_type(std::uint32_t width, Visit&& visit) {
    return width == 1 ? visit(std::uint8_t{}) : visit(std::uint32_t{});
}

/// Inputs that are constant during a derivation.
struct PlanInputs {
    const float* globals = nullptr;
    std::uint64_t seed = 0;
    float steps = 0.0F; // value of steps()
};

class Plan {
public:
    /// Plans the productions of `stage`. `each_generation`: prepare() will be called for each
    /// generation; otherwise one plan serves all.
    Plan(const Bytecode& bytecode,
         const PlanInputs& inputs,
         bool each_generation,
         Stage stage = Stage::Rewrite);

    /// Updates rows and entries to rewrite words of age `generation`. In parallel and leftmost mode
    /// all families are active.
    void prepare(std::uint32_t generation);
    /// In sequential and cyclic mode: activates only rule `rule`. Called after prepare().
    void select_rule(std::uint32_t rule);

    [[nodiscard]] const Bytecode& bytecode() const { return bytecode_; }
    /// The productions of the plan's stage.
    [[nodiscard]] TableRange productions() const { return productions_; }
    [[nodiscard]] const PlanInputs& inputs() const { return inputs_; }
    [[nodiscard]] const Row& row(Code code) const { return rows_[code]; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] const std::vector<AffineTerm>& terms() const { return terms_; }
    [[nodiscard]] const std::vector<BatchProgram>& batch_programs() const {
        return batch_programs_;
    }
    [[nodiscard]] const Family& family(std::uint32_t index) const { return families_[index]; }
    [[nodiscard]] std::span<const Candidate> candidates(const Family& family) const {
        return {candidates_.data() + family.first, family.count};
    }
    [[nodiscard]] const Candidate& candidate(std::uint32_t index) const {
        return candidates_[index];
    }
    [[nodiscard]] std::span<const Comparison> comparisons(const Candidate& candidate) const {
        return {comparisons_.data() + candidate.first_comparison, candidate.comparison_count};
    }
    [[nodiscard]] const Choice& choice(std::uint32_t index) const { return choices_.list[index]; }
    [[nodiscard]] std::span<const float> thresholds(const Choice& choice) const {
        return {choices_.thresholds.data() + choice.first, choice.count};
    }
    [[nodiscard]] std::span<const std::uint32_t> records(const Choice& choice) const {
        return {choices_.records.data() + choice.first, choice.count};
    }
    [[nodiscard]] std::span<const Test> tests(std::uint32_t index) const {
        return {tests_.list.data() + tests_.lists[index].first, tests_.lists[index].count};
    }
    /// guards()[guard + code] is not 0 if a module of `code` may be the neighbour.
    [[nodiscard]] const std::uint8_t* guards() const { return guards_.data(); }
    /// Codes at the word's width: the codes of the templates, then every code once, then templates
    /// with folded modules, then kWordSlack bytes.
    [[nodiscard]] const std::byte* pool() const { return codes_.pool.data(); }
    /// The code at an index of pool().
    [[nodiscard]] Code pool_code(std::uint32_t index) const;

    /// Bytes of codes per wide store: 16 or 32.
    [[nodiscard]] std::uint32_t wide_bytes() const { return codes_.wide_bytes; }
    /// Whether some entry is batched.
    [[nodiscard]] bool has_batched() const { return has_batched_; }
    /// Whether some batched entry draws random numbers, which takes most of the time of a batch.
    [[nodiscard]] bool has_batched_draws() const { return has_batched_draws_; }
    /// Number of parameters per module for which the wide loop needs room.
    [[nodiscard]] std::uint32_t wide_parameters() const { return wide_parameters_; }
    /// Whether some symbol has more than one parameter, so that terms of an entry may read
    /// different ones.
    [[nodiscard]] bool has_several_parameters() const { return has_several_parameters_; }

    // Properties of the active rows
    [[nodiscard]] bool all_fixed() const { return active_.dynamic_rows == 0; }
    /// Whether an active production has a context, and whether one uses a formal of its context.
    [[nodiscard]] bool needs_contexts() const { return active_.needs_contexts; }
    [[nodiscard]] bool reads_contexts() const { return active_.reads_contexts; }
    /// The max number of modules that a match replaces. This number may exceed 1 in leftmost
    /// rewriting, and in a pass of one rule, in which every match replaces this number of modules.
    [[nodiscard]] std::uint32_t predecessor_count() const { return active_.predecessor_count; }
    /// Modules replaced by a match whose successor is `entry`.
    [[nodiscard]] std::uint32_t replaced_modules(const Entry& entry) const {
        return entry.candidate == kNone ? 1 : candidates_[entry.candidate].modules;
    }
    /// Distance from a module to the first one that its right guard may check.
    [[nodiscard]] std::uint32_t guard_distance() const {
        return families_by_symbol_ ? 1 : active_.predecessor_count;
    }
    /// First symbol of the predecessor of `rule`.
    [[nodiscard]] SymbolId first_symbol(std::uint32_t rule) const;
    /// The codes of the modules of `symbol`.
    [[nodiscard]] std::span<const Code> codes_of(SymbolId symbol) const;

    // Properties of the program
    [[nodiscard]] bool has_parameters() const { return has_parameters_; }
    /// Whether some successor without parameters has local values whose computation can fail.
    [[nodiscard]] bool checks_unstored() const { return checks_unstored_; }
    /// Bytes per record: 1 or 4.
    [[nodiscard]] std::uint32_t record_width() const { return record_width_; }
    [[nodiscard]] std::uint32_t code_width() const { return codes_.width; }
    /// Whether brackets or ignored modules can occur at all.
    [[nodiscard]] bool has_structure() const { return has_structure_; }
    /// The draw of `rule` with `choice generation`.
    [[nodiscard]] float rule_draw(std::uint32_t rule, std::uint32_t generation) const;
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    /// Makes codes_.
    void make_codes();
    /// Makes the families and their candidates.
    void make_families();
    /// Makes the guards. If every candidate of a family has a left context, a lookup of the left
    /// neighbour rules out most modules. The guards of right contexts do the same for the right
    /// neighbour.
    void make_guards();
    /// Makes a row for each code, and an entry for each code and each candidate.
    void make_entries();
    /// Finds the shapes of the conditions and arguments of all candidates.
    void shape(Family& family);
    /// Sets the kind and the comparisons of the condition.
    void shape_condition(Candidate& candidate);
    /// Sets the terms of the parameters, or Entry::general if they have no terms.
    void shape_entry(const Candidate& candidate, Entry& entry);
    void make_batch_program(Candidate& candidate);
    /// The known inputs of the expressions of a candidate.
    [[nodiscard]] ShapeKnowledge knowledge(const Candidate& candidate) const;
    /// Sets the rows of all codes that the family rewrites.
    void activate_family(std::uint32_t family_index);
    /// Sets the row of `code`, a code of the symbol that the family rewrites.
    void resolve(std::uint32_t family_index, Code code);
    /// Sets a row whose first possible match is a candidate with a weight: Fixed, Choice or
    /// General.
    void resolve_choice(const Family& family, std::uint32_t first_match, Code code);
    /// Makes the row Fixed, with a copy of `entry`.
    void resolve_fixed(Code code, const Entry& entry);
    /// Makes the tests of a row if single comparisons suffice to choose a production: no contexts,
    /// no draws, no other conditions. Returns whether the tests were made.
    [[nodiscard]] bool resolve_tests(const Family& family, Code code);
    /// Turns the parameters of `entry`, the only entry of a folded module, into constants. Returns
    /// false if that is not possible.
    [[nodiscard]] bool make_constant(const Row& row, Entry& entry) const;
    /// Makes an entry write folded modules only, if the arguments of the module are known and the
    /// program has all folded modules needed. Returns whether the entry was changed.
    [[nodiscard]] bool fold(Code code, Entry& entry);
    /// Folds the entries of a module that one of several productions may rewrite.
    void fold_records(const Family& family, Code code);
    /// Puts the successor with folded modules for the arguments `own` into the pool; returns its
    /// index, or kNone if the program lacks one of these modules.
    [[nodiscard]] std::uint32_t folded_template(const Candidate& candidate, const float* own);
    /// Appends a template to the pool; returns its index there.
    [[nodiscard]] std::uint32_t add_template(const std::vector<Code>& codes);
    /// The condition of a candidate for a module with the arguments `own`, if known; null: unknown.
    [[nodiscard]] ConditionKind
    condition_for(const Family& family, const Candidate& candidate, const float* own) const;
    /// The arguments of the folded module of a row; null: the row has no folded module.
    [[nodiscard]] const float* folded_arguments(const Row& row) const;
    /// Sets the kind of a row, and the count of rows that are not Fixed.
    void set_kind(Code code, RowKind kind);
    /// Makes the row copy its modules.
    void reset_row(Code code);
    /// The entry that copies a module.
    [[nodiscard]] Entry identity_entry(Code code) const;
    /// Sets Entry::special and Entry::batched.
    void set_special(Entry& entry) const;
    /// Whether the plan has every value on which the family depends: either the family does not
    /// depend on the generation, or prepare() is called for each generation.
    [[nodiscard]] bool knows_generation(const Family& family) const {
        return each_generation_ || !family.depends_on_generation;
    }

    /// Codes at the word's width, and the codes of each symbol.
    struct CodeTables {
        std::vector<std::byte> pool;      // templates, each code once, folded templates, slack
        std::uint32_t first_identity = 0; // index in the pool where the list of all codes begins
        std::vector<std::uint32_t> first_of_symbol; // index in by_symbol; last: its size
        std::vector<Code> by_symbol;                // codes grouped by symbol
        std::uint32_t width = 1;                    // bytes per code
        std::uint32_t wide_bytes = 16;
    };
    /// Alternatives of Choice rows.
    struct ChoiceTables {
        std::vector<Choice> list;
        std::vector<float> thresholds;      // cumulative weights
        std::vector<std::uint32_t> records; // one per threshold
        std::vector<std::uint32_t> of_code; // index in list; kNone: none yet
    };
    /// Comparisons of Tests rows.
    struct TestTables {
        std::vector<TestList> lists;
        std::vector<Test> list;
        std::vector<std::uint32_t> of_code; // index in lists; kNone: none yet
    };
    /// Templates with folded modules, for codes whose arguments are known.
    struct Folding {
        std::optional<FoldedIndex> index; // none: nothing is folded
        std::vector<Code> codes;          // codes of folded templates, at the pool's end
        std::unordered_map<std::uint64_t, std::uint32_t> templates; // by code and candidate
        std::vector<std::uint32_t> block_of_code; // by code: first own entry, or kNone
        std::uint64_t budget = 0; // candidates that may still be tried for folded modules
    };
    /// Summary of the active rows.
    struct ActiveFamilies {
        std::uint32_t dynamic_rows = 0; // number of rows that are not Fixed
        std::uint32_t predecessor_count = 1;
        std::uint32_t selected_rule = kNone; // kNone: all rules
        bool needs_contexts = false;
        bool reads_contexts = false;
    };

    const Bytecode& bytecode_;
    PlanInputs inputs_;
    bool each_generation_; // prepare() is called for each generation
    TableRange productions_;
    bool families_by_symbol_;                   // a family holds all productions of its symbol
    std::uint32_t generation_ = 0;              // argument of the last prepare()
    std::optional<GlibcRuleDraws> glibc_draws_; // set with `random glibc`

    std::vector<Row> rows_; // by code
    std::vector<Entry> entries_;
    /// Identity terms, then the terms of entries with more than kEntryTerms parameters.
    std::vector<AffineTerm> terms_;
    std::vector<Family> families_;
    std::vector<std::uint32_t>
        generation_families_; // indexes of families with depends_on_generation
    std::vector<Candidate> candidates_;
    std::vector<Comparison> comparisons_;
    std::vector<BatchProgram> batch_programs_;
    std::vector<std::uint8_t> guards_;
    ChoiceTables choices_;
    TestTables tests_;
    CodeTables codes_;
    Folding folding_;
    ActiveFamilies active_;

    // Facts of the program
    std::uint32_t record_width_ = 1;
    std::uint32_t wide_parameters_ = kEntryTerms;
    bool has_batched_ = false;
    bool has_batched_draws_ = false;
    bool has_several_parameters_ = false;
    bool has_parameters_ = false;
    bool has_structure_ = false;
    bool checks_unstored_ = false;
};

} // namespace lsys
