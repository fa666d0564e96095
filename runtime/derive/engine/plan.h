// Plan: a program prepared for rewriting, with everything decided that can be decided before a
// module is seen. Made once a run, when the globals are known; refreshed for a generation where
// something depends on step(), and for a rule where a pass rewrites one rule only. Read by the
// passes, by many threads at once.
//
// A row tells how modules of a code are rewritten: always by one entry, by a choice among a fixed
// set, by the first of some comparisons that holds, or as conditions and contexts say. An entry is
// one way: the codes to copy, and for each parameter a lane (expressions/shape.h), or general code.
// Entry c < code_count belongs to code c: what a Fixed row writes, and the copy that stands for no
// match in other rows. The others follow in the order of the families, so that record r > 0 of a
// module means entry row.base + r. A code whose entries differ from those of its family, because
// its arguments are known and what it writes is folded (fold_reached.h), has a block of its own.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/engine/eval.h"
#include "runtime/derive/engine/folded_index.h"
#include "runtime/derive/engine/rule_dice.h"
#include "runtime/derive/engine/shape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace lsys {

/// Parameters that an entry makes without a loop.
inline constexpr std::size_t kEntryLanes = 4;

struct alignas(64) Entry {
    std::array<float, kEntryLanes> scale{};
    std::array<float, kEntryLanes> offset{};
    std::array<std::uint8_t, kEntryLanes> input{};
    std::uint32_t first_code = 0; // in the pool
    std::uint32_t code_count = 0;
    std::uint32_t parameter_count = 0;
    std::uint32_t first_lane = 0;    // in Plan::lanes(): of all parameters, if they are over four
    std::uint32_t candidate = kNone; // none: the module itself
    std::uint32_t first_place = 0;   // of the successor, in Bytecode::template_codes
    bool general = false;            // parameters need evaluate()
    bool reads_own = false;          // lanes read the module's parameters
    bool special = false;            // more than one wide store of codes and one of lanes writes
};

static_assert(sizeof(Entry) == 64, "an entry is one line of the cache");

enum class RowKind : std::uint8_t {
    Fixed,   // always entry c
    Choice,  // stochastic, among the same productions for every module
    Tests,   // by the first comparison of its parameters that holds
    General, // the family's candidates are tried
};

struct Row {
    std::uint32_t base = 0;            // record r > 0 means entry base + r
    std::uint32_t code_count = 0;      // Fixed: what is written
    std::uint32_t parameter_count = 0; // Fixed
    std::uint32_t stored = 0;          // parameters the module has in the word
    std::uint32_t constants = kNone;   // of a folded module, in Bytecode::constants
    std::uint32_t source = 0;         // Choice: in choices; Tests: in test lists; else: in families
    std::uint32_t left_guard = kNone; // General: what must be next to it, in guards
    std::uint32_t right_guard = kNone;
    RowKind kind = RowKind::Fixed;
    bool copies = true; // Fixed: writes the module itself
    bool slow = false;  // entries read the parameters of a folded module
};

/// The productions that are tried for a module, in file order: those of its symbol, or of one rule.
struct Family {
    std::uint32_t first = 0; // in candidates
    std::uint32_t count = 0;
    std::uint32_t left_guard = kNone; // codes that may stand left of a module that is rewritten
    std::uint32_t right_guard = kNone;
    bool several = false; // a candidate rewrites several modules
    bool has_context = false;
    bool reads_context = false; // a formal of a context is used
    bool reads_own = false;     // an entry reads the module's parameters
    bool varies = false;        // depends on the generation: step(), or one choice a generation
    bool current = false;       // candidates and entries are up to date
};

enum class ConditionKind : std::uint8_t { Always, Never, Comparisons, Expression };

struct Candidate {
    std::uint32_t production = 0;
    std::uint32_t group = 0;
    std::uint32_t modules = 1;   // that a match uses up
    std::uint32_t own_first = 0; // formal of the module's first parameter
    std::uint32_t first_comparison = 0;
    std::uint32_t comparison_count = 0;
    std::uint32_t comparison_room = 0;
    float weight = 0.0F;
    ConditionKind condition = ConditionKind::Always;
    bool stochastic = false;
    bool has_context = false;
    bool gathers = false;       // formals are not just the module's parameters: collect them
    bool reads_context = false; // formals of contexts among them
};

/// The fixed set of a Choice row: the first record whose running weight exceeds the draw.
struct Choice {
    std::uint32_t first = 0; // in thresholds and choice_records
    std::uint32_t count = 0;
    std::uint32_t room = 0;
};

/// One of the tests of a row, in file order; the first that holds decides.
struct Test {
    Comparison comparison;
    std::uint32_t record = 0;
};
struct TestList {
    std::uint32_t first = 0; // in tests
    std::uint32_t count = 0;
    std::uint32_t room = 0;
};

/// Calls visit(R{}) with the unsigned integer type R of a record of `width` bytes, 1 or 4.
template <typename Visit>
decltype(auto) visit_record_type(std::uint32_t width, Visit&& visit) {
    return width == 1 ? visit(std::uint8_t{}) : visit(std::uint32_t{});
}

/// What a derivation fixes for all its generations.
struct PlanInputs {
    const float* globals = nullptr;
    std::uint64_t seed = 0;
    float steps = 0.0F;
};

class Plan {
public:
    /// `each_generation`: prepare() will be called for each; otherwise one plan serves all.
    /// Of the productions of one stage.
    Plan(const Bytecode& bytecode,
         const PlanInputs& inputs,
         bool each_generation,
         Stage stage = Stage::Rewrite);

    /// Brings rows and entries up to date for rewriting words of age `generation`. In parallel
    /// mode all families are in force.
    void prepare(std::uint32_t generation);
    /// Other modes: only rule `rule` is in force. After prepare().
    void select_rule(std::uint32_t rule);

    [[nodiscard]] const Bytecode& bytecode() const { return bytecode_; }
    [[nodiscard]] const PlanInputs& inputs() const { return inputs_; }
    [[nodiscard]] const Row& row(Code code) const { return rows_[code]; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] const std::vector<Lane>& lanes() const { return lanes_; }
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
    [[nodiscard]] const Choice& choice(std::uint32_t index) const { return choices_[index]; }
    [[nodiscard]] std::span<const float> thresholds(const Choice& choice) const {
        return {thresholds_.data() + choice.first, choice.count};
    }
    [[nodiscard]] std::span<const std::uint32_t> records(const Choice& choice) const {
        return {choice_records_.data() + choice.first, choice.count};
    }
    [[nodiscard]] std::span<const Test> tests(std::uint32_t index) const {
        return {tests_.data() + test_lists_[index].first, test_lists_[index].count};
    }
    /// guards()[guard + code]: whether a module of that code may be the neighbour.
    [[nodiscard]] const std::uint8_t* guards() const { return guards_.data(); }
    /// Codes at the word's width: those of the templates, then every code once, then templates with
    /// folded modules; with slack.
    [[nodiscard]] const std::byte* pool() const { return pool_.data(); }
    [[nodiscard]] Code pool_code(std::uint32_t index) const;

    /// Bytes of codes that one wide store writes: 16 or 32.
    [[nodiscard]] std::uint32_t wide_bytes() const { return wide_bytes_; }
    /// Some lanes of an entry read a parameter other than its first lane's.
    [[nodiscard]] bool mixes_inputs() const { return mixes_inputs_; }

    // Of what is in force now:
    [[nodiscard]] bool all_fixed() const { return dynamic_rows_ == 0; }
    [[nodiscard]] bool needs_contexts() const { return needs_contexts_; }
    [[nodiscard]] bool reads_contexts() const { return reads_contexts_; }
    /// The most modules that a match uses up; above 1 in a pass of one rule, of which each match
    /// uses as many, and in leftmost rewriting.
    [[nodiscard]] std::uint32_t predecessor_count() const { return predecessor_count_; }
    /// Modules that a match uses up whose successor is this entry.
    [[nodiscard]] std::uint32_t used_by(const Entry& entry) const {
        return entry.candidate == kNone ? 1 : candidates_[entry.candidate].modules;
    }
    /// From a module to the first that guards on its right may look at.
    [[nodiscard]] std::uint32_t guard_distance() const {
        return parallel_ ? 1 : predecessor_count_;
    }
    /// First symbol of a rule's predecessor.
    [[nodiscard]] SymbolId first_symbol(std::uint32_t rule) const;
    /// The codes that are modules of a symbol.
    [[nodiscard]] std::span<const Code> codes_of(SymbolId symbol) const;

    // Of the whole program:
    [[nodiscard]] bool has_parameters() const { return has_parameters_; }
    [[nodiscard]] std::uint32_t record_width() const { return record_width_; }
    [[nodiscard]] std::uint32_t code_width() const { return code_width_; }
    /// Whether brackets or ignored modules can occur at all.
    [[nodiscard]] bool has_structure() const { return has_structure_; }
    /// The draw of a rule under `choice generation`.
    [[nodiscard]] float rule_draw(std::uint32_t rule, std::uint32_t generation) const;
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    void make_codes();
    void make_families();
    void make_guards();
    void make_entries();
    void shape(Family& family);
    void shape_condition(Candidate& candidate);
    void shape_entry(const Candidate& candidate, Entry& entry);
    [[nodiscard]] ShapeKnowledge knowledge(const Candidate& candidate) const;
    void put_in_force(std::uint32_t family_index);
    void resolve(std::uint32_t family_index, Code code);
    void resolve_choice(const Family& family, std::uint32_t first_match, Code code);
    void resolve_fixed(Code code, const Entry& entry);
    [[nodiscard]] bool resolve_tests(const Family& family, Code code);
    [[nodiscard]] bool bake(const Row& row, Entry& entry) const;
    [[nodiscard]] bool fold(Code code, Entry& entry);
    void fold_records(const Family& family, Code code);
    [[nodiscard]] std::uint32_t folded_template(const Candidate& candidate, const float* own);
    [[nodiscard]] std::uint32_t add_template(const std::vector<Code>& codes);
    [[nodiscard]] ConditionKind
    condition_for(const Family& family, const Candidate& candidate, const float* own) const;
    [[nodiscard]] const float* own_constants(const Row& row) const;
    void set_kind(Code code, RowKind kind);
    void reset_row(Code code);
    [[nodiscard]] Entry identity_entry(Code code) const;
    void finish(Entry& entry);
    [[nodiscard]] bool known(const Family& family) const {
        return each_generation_ || !family.varies;
    }

    const Bytecode& bytecode_;
    PlanInputs inputs_;
    bool each_generation_;
    TableRange productions_;
    bool parallel_; // a family holds all productions of its symbol
    std::uint32_t generation_ = 0;
    std::optional<RuleDice> dice_; // with `random glibc`
    std::vector<Row> rows_;
    std::vector<Entry> entries_;
    std::vector<Lane> lanes_;
    std::vector<Family> families_;
    std::vector<Candidate> candidates_;
    std::vector<Comparison> comparisons_;
    std::vector<Choice> choices_;
    std::vector<float> thresholds_;
    std::vector<std::uint32_t> choice_records_;
    std::vector<TestList> test_lists_;
    std::vector<Test> tests_;
    std::vector<std::uint8_t> guards_;
    std::vector<std::byte> pool_;
    std::vector<std::uint32_t> codes_of_first_; // by symbol; one more at the end
    std::vector<Code> codes_of_;
    std::vector<std::uint32_t> choice_of_code_; // kNone: none yet
    std::vector<std::uint32_t> tests_of_code_;
    std::vector<std::uint32_t> varying_families_;
    std::optional<FoldedIndex> folded_index_; // where templates are folded
    std::vector<Code> folded_codes_;          // of folded templates, at the end of the pool
    std::unordered_map<std::uint64_t, std::uint32_t> templates_; // by code and candidate
    std::vector<std::uint32_t> block_of_code_; // entries of its own; kNone: those of the family
    std::uint32_t identity_first_ = 0;
    std::uint32_t dynamic_rows_ = 0;
    std::uint32_t predecessor_count_ = 1;
    std::uint32_t selected_rule_ = kNone; // in force; kNone: all
    std::uint32_t record_width_ = 1;
    std::uint32_t code_width_ = 1;
    std::uint64_t folded_budget_ = 0; // candidates that may still be tried for folded modules
    std::uint32_t wide_bytes_ = 16;
    bool mixes_inputs_ = false;
    bool has_parameters_ = false;
    bool has_structure_ = false;
    bool needs_contexts_ = false;
    bool reads_contexts_ = false;
};

} // namespace lsys
