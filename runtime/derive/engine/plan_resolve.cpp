// SPDX-License-Identifier: MIT
// Activates families: finds the shapes (shape.h) of their conditions and arguments, and resolves
// the rows of their codes.
#include "grammar/base/contract.h"
#include "runtime/derive/engine/plan.h"

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// Whether the term 0 * input + value yields `value` for every finite input. False for -0, because
/// the sign of the sum would depend on the input.
bool is_term_constant(float value) {
    return std::isfinite(value) && !(value == 0.0F && std::signbit(value));
}

/// Max candidates evaluated in advance for all folded modules of one family; further ones are
/// evaluated per module during a pass.
constexpr std::uint64_t kFoldedBudget = std::uint64_t{1} << 16;

} // namespace

ShapeKnowledge Plan::knowledge(const Candidate& candidate) const {
    const BytecodeProduction& production = bytecode_.productions[candidate.production];
    ShapeKnowledge known;
    known.own_first = candidate.own_first;
    if (production.predecessor.count == 1) {
        const SymbolId symbol = bytecode_.patterns[production.predecessor.first].symbol;
        known.own_count = bytecode_.symbol(symbol).parameter_count;
    }
    known.globals = inputs_.globals;
    known.steps = inputs_.steps;
    if (each_generation_) {
        known.step = static_cast<float>(generation_);
    }
    return known;
}

void Plan::shape_condition(Candidate& candidate) {
    const BytecodeProduction& production = bytecode_.productions[candidate.production];
    if (production.condition == kNone) {
        candidate.condition = ConditionKind::Always;
        return;
    }
    candidate.condition = ConditionKind::Expression;
    const std::vector<ValueShape> shapes =
        shapes_of(bytecode_, kNone, production.condition, knowledge(candidate));
    if (shapes.size() != 1) {
        return;
    }
    const ValueShape& shape = shapes[0];
    if (shape.kind == ShapeKind::Constant && std::isfinite(shape.constant)) {
        candidate.condition = shape.constant != 0.0F ? ConditionKind::Always : ConditionKind::Never;
    } else if (shape.kind == ShapeKind::Comparisons) {
        candidate.condition = ConditionKind::Comparisons;
        const auto count = static_cast<std::uint32_t>(shape.comparisons.size());
        if (count > candidate.comparison_room) {
            candidate.first_comparison = static_cast<std::uint32_t>(comparisons_.size());
            candidate.comparison_room = count;
            comparisons_.resize(comparisons_.size() + count);
        }
        candidate.comparison_count = count;
        std::copy(shape.comparisons.begin(), shape.comparisons.end(),
                  comparisons_.begin() + candidate.first_comparison);
    }
}

void Plan::shape_entry(const Candidate& candidate, Entry& entry) {
    const WordTemplate& successor = bytecode_.productions[candidate.production].successor;
    // A random range of a local value can be invalid even if no argument uses the value, so all
    // local values are evaluated.
    const bool has_drawn_locals = bytecode_.local_count != 0 && successor.draw_count != 0;
    entry.general = has_drawn_locals;
    entry.reads_own = false;
    if (successor.parameter_count == 0 || has_drawn_locals) {
        return;
    }
    const std::vector<ValueShape> shapes =
        shapes_of(bytecode_, successor.locals, successor.arguments, knowledge(candidate));
    entry.general = shapes.size() != successor.parameter_count;
    for (std::uint32_t i = 0; i < shapes.size() && !entry.general; ++i) {
        AffineTerm term;
        if (shapes[i].kind == ShapeKind::Constant && is_term_constant(shapes[i].constant)) {
            term = {0, 0.0F, shapes[i].constant};
        } else if (shapes[i].kind == ShapeKind::Affine && shapes[i].affine.input <= 0xFF) {
            term = shapes[i].affine;
            entry.reads_own = true;
        } else {
            entry.general = true;
        }
        if (i < kEntryTerms) {
            entry.scale[i] = term.scale;
            entry.offset[i] = term.offset;
            entry.input[i] = static_cast<std::uint8_t>(term.input);
        }
        if (entry.parameter_count > kEntryTerms) {
            terms_[candidate.first_term + i] = term;
        }
    }
}

void Plan::make_batch_program(Candidate& candidate) {
    constexpr std::size_t kMaxPrograms = 1024; // each writer has a queue per program
    if (candidate.batch_program != kNone || batch_programs_.size() == kMaxPrograms) {
        return;
    }
    std::optional<BatchProgram> program =
        batch_program(bytecode_, candidate.production, candidate.gathers);
    if (program) {
        candidate.batch_program = static_cast<std::uint32_t>(batch_programs_.size());
        batch_programs_.push_back(std::move(*program));
    }
}

void Plan::shape(Family& family) {
    family.reads_own = false;
    for (std::uint32_t i = family.first; i < family.first + family.count; ++i) {
        Entry& entry = entries_[std::size_t{bytecode_.code_count()} + i];
        shape_condition(candidates_[i]);
        shape_entry(candidates_[i], entry);
        entry.terms_or_program = candidates_[i].first_term;
        if (entry.general) {
            make_batch_program(candidates_[i]);
            entry.terms_or_program = candidates_[i].batch_program;
            checks_unstored_ = checks_unstored_ || entry.parameter_count == 0;
            if (entry.parameter_count <= kMaxBatchedParameters) {
                wide_parameters_ = std::max(wide_parameters_, entry.parameter_count);
            }
        }
        set_special(entry);
        has_batched_ = has_batched_ || entry.batched;
        const std::uint32_t draws =
            bytecode_.productions[candidates_[i].production].successor.draw_count;
        has_batched_draws_ = has_batched_draws_ || (entry.batched && draws != 0);
        family.reads_own = family.reads_own || entry.reads_own;
    }
    family.current = true;
}

void Plan::activate_family(std::uint32_t family_index) {
    Family& family = families_[family_index];
    if (!family.current) {
        shape(family);
    }
    active_.needs_contexts = active_.needs_contexts || family.has_context;
    active_.reads_contexts = active_.reads_contexts || family.reads_context;
    const BytecodeProduction& example = bytecode_.productions[candidates_[family.first].production];
    folding_.budget = kFoldedBudget;
    for (const Code code : codes_of(bytecode_.patterns[example.predecessor.first].symbol)) {
        resolve(family_index, code);
    }
}

const float* Plan::folded_arguments(const Row& row) const {
    return row.constants == kNone ? nullptr : bytecode_.constants.data() + row.constants;
}

ConditionKind
Plan::condition_for(const Family& family, const Candidate& candidate, const float* own) const {
    if (own == nullptr) {
        return candidate.condition;
    }
    if (candidate.condition == ConditionKind::Comparisons) {
        const std::span<const Comparison> all = comparisons(candidate);
        return std::all_of(all.begin(), all.end(),
                           [own](const Comparison& each) { return holds(each, own); })
                   ? ConditionKind::Always
                   : ConditionKind::Never;
    }
    if (candidate.condition == ConditionKind::Expression && !candidate.gathers &&
        knows_generation(family)) {
        const EvalFrame frame{own, inputs_.globals, static_cast<float>(generation_), inputs_.steps};
        float value = 0.0F;
        EvalFault fault;
        if (evaluate(bytecode_, bytecode_.productions[candidate.production].condition, frame,
                     nullptr, &value, fault)) {
            return value != 0.0F ? ConditionKind::Always : ConditionKind::Never;
        }
    }
    return candidate.condition;
}

void Plan::resolve(std::uint32_t family_index, Code code) {
    const Family& family = families_[family_index];
    reset_row(code);
    Row& row = rows_[code];
    row.base = bytecode_.code_count() + family.first - 1;
    row.source = family_index;
    row.left_guard = family.left_guard;
    row.right_guard = family.right_guard;
    const float* const own = folded_arguments(row);
    row.slow = own != nullptr && family.reads_own;
    if (family.replaces_several) {
        set_kind(code, RowKind::General);
        return;
    }
    for (std::uint32_t i = 0; i < family.count; ++i) {
        const Candidate& candidate = candidates_[family.first + i];
        if (own != nullptr) {
            if (folding_.budget == 0) {
                set_kind(code, RowKind::General);
                return;
            }
            --folding_.budget;
        }
        const ConditionKind condition = condition_for(family, candidate, own);
        if (condition == ConditionKind::Never) {
            continue;
        }
        if (candidate.has_context || condition != ConditionKind::Always) {
            set_kind(code, resolve_tests(family, code) ? RowKind::Tests : RowKind::General);
            fold_records(family, code);
            return;
        }
        if (candidate.stochastic) {
            resolve_choice(family, i, code);
        } else {
            resolve_fixed(code, entries_[row.base + 1 + i]);
        }
        return;
    }
    row.slow = false; // no production can match
}

bool Plan::resolve_tests(const Family& family, Code code) {
    constexpr std::size_t kMaxTests = 16;
    Row& row = rows_[code];
    if (row.constants != kNone) {
        return false;
    }
    std::vector<Test> found;
    for (std::uint32_t i = 0; i < family.count; ++i) {
        const Candidate& candidate = candidates_[family.first + i];
        const std::span<const Comparison> all = comparisons(candidate);
        if (candidate.condition == ConditionKind::Never) {
            continue;
        }
        if (candidate.has_context || candidate.stochastic || found.size() == kMaxTests ||
            candidate.condition == ConditionKind::Expression ||
            (candidate.condition == ConditionKind::Comparisons && all.size() != 1)) {
            return false;
        }
        if (candidate.condition == ConditionKind::Always) {
            constexpr std::uint32_t kAny =
                Comparison::kLess | Comparison::kEqual | Comparison::kGreater;
            found.push_back({{{}, 0.0F, kAny}, i + 1});
            break;
        }
        found.push_back({all[0], i + 1});
    }
    std::uint32_t& index = tests_.of_code[code];
    if (index == kNone) {
        index = static_cast<std::uint32_t>(tests_.lists.size());
        tests_.lists.emplace_back();
    }
    TestList& list = tests_.lists[index];
    const auto count = static_cast<std::uint32_t>(found.size());
    if (count > list.room) {
        list.room = count;
        list.first = static_cast<std::uint32_t>(tests_.list.size());
        tests_.list.resize(tests_.list.size() + count);
    }
    list.count = count;
    std::copy(found.begin(), found.end(), tests_.list.begin() + list.first);
    row.source = index;
    return true;
}

void Plan::resolve_choice(const Family& family, std::uint32_t first_match, Code code) {
    Row& row = rows_[code];
    const Candidate& first = candidates_[family.first + first_match];
    if (folded_arguments(row) != nullptr) {
        if (folding_.budget < family.count) {
            set_kind(code, RowKind::General);
            return;
        }
        folding_.budget -= family.count;
    }
    std::vector<std::uint32_t> records;
    float sum = 0.0F;
    for (std::uint32_t i = first_match; i < family.count; ++i) {
        const Candidate& candidate = candidates_[family.first + i];
        if (candidate.group != first.group || !candidate.stochastic) {
            continue;
        }
        const ConditionKind condition = condition_for(family, candidate, folded_arguments(row));
        if (condition == ConditionKind::Never) {
            continue;
        }
        if (condition != ConditionKind::Always || candidate.computes_weight) {
            set_kind(code, RowKind::General);
            fold_records(family, code);
            return;
        }
        records.push_back(i + 1);
        sum += candidate.weight;
    }
    if (records.size() == 1) {
        resolve_fixed(code, entries_[row.base + records[0]]);
        return;
    }
    std::vector<float> cumulative;
    float total = 0.0F;
    for (const std::uint32_t record : records) {
        total += candidates_[family.first + record - 1].weight / sum;
        cumulative.push_back(total);
    }
    if (bytecode_.settings.choice == ChoiceScope::Generation) {
        if (!each_generation_) {
            set_kind(code, RowKind::General);
            return;
        }
        const float u = rule_draw(bytecode_.productions[first.production].rule, generation_);
        std::size_t taken = 0;
        while (taken + 1 < records.size() && !(cumulative[taken] > u)) {
            ++taken;
        }
        resolve_fixed(code, entries_[row.base + records[taken]]);
        return;
    }
    std::uint32_t& index = choices_.of_code[code];
    if (index == kNone) {
        index = static_cast<std::uint32_t>(choices_.list.size());
        choices_.list.emplace_back();
    }
    Choice& choice = choices_.list[index];
    const auto count = static_cast<std::uint32_t>(records.size());
    if (count > choice.room) {
        choice.room = count;
        choice.first = static_cast<std::uint32_t>(choices_.thresholds.size());
        choices_.thresholds.resize(choices_.thresholds.size() + count);
        choices_.records.resize(choices_.records.size() + count);
    }
    choice.count = count;
    std::copy(cumulative.begin(), cumulative.end(), choices_.thresholds.begin() + choice.first);
    std::copy(records.begin(), records.end(), choices_.records.begin() + choice.first);
    row.source = index;
    set_kind(code, RowKind::Choice);
    fold_records(family, code);
}

void Plan::resolve_fixed(Code code, const Entry& taken) {
    Row& row = rows_[code];
    Entry entry = taken;
    row.slow = false;
    if (!fold(code, entry) && folded_arguments(row) != nullptr &&
        (entry.reads_own || entry.general)) {
        row.slow = !make_constant(row, entry);
    }
    row.copies = false;
    row.code_count = entry.code_count;
    row.parameter_count = entry.parameter_count;
    set_special(entry);
    entry.special = entry.special || row.slow;
    entries_[code] = entry;
    set_kind(code, RowKind::Fixed);
}

bool Plan::make_constant(const Row& row, Entry& entry) const {
    const BytecodeProduction& production =
        bytecode_.productions[candidates_[entry.candidate].production];
    const float* const own = folded_arguments(row);
    if (entry.parameter_count > kEntryTerms) {
        return false;
    }
    std::array<float, kEntryTerms> values{};
    if (entry.general) {
        const bool steady =
            each_generation_ || !contains(bytecode_, production.successor, Opcode::Step);
        if (has_random_parameters(bytecode_, production.successor) || !steady) {
            return false;
        }
        const EvalFrame frame{own, inputs_.globals, static_cast<float>(generation_), inputs_.steps};
        EvalFault fault;
        if (!evaluate(bytecode_, production.successor, frame, nullptr, values.data(), fault)) {
            return false;
        }
    } else {
        for (std::size_t i = 0; i < entry.parameter_count; ++i) {
            values[i] = own[entry.input[i]] * entry.scale[i] + entry.offset[i];
        }
    }
    if (!std::all_of(values.begin(), values.begin() + entry.parameter_count, is_term_constant)) {
        return false;
    }
    for (std::size_t i = 0; i < entry.parameter_count; ++i) {
        entry.scale[i] = 0.0F;
        entry.offset[i] = values[i];
        entry.input[i] = 0;
    }
    entry.general = false;
    entry.reads_own = false;
    return true;
}

} // namespace lsys
