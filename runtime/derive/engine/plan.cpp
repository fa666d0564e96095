// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/plan.h"

#include "grammar/base/contract.h"
#include "runtime/base/random.h"
#include "runtime/derive/word.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lsys {

namespace {

/// Appends a code at the word's width.
void append_code(Code code, std::uint32_t width, std::vector<std::byte>& pool) {
    const auto bytes = std::bit_cast<std::array<std::byte, sizeof code>>(code); // little-endian
    pool.insert(pool.end(), bytes.begin(), bytes.begin() + width);
}

/// Programs with more codes are rewritten without folded templates.
constexpr Code kMaxFoldedCodes = 4096;

bool uses_step(const Bytecode& bytecode, const BytecodeProduction& production) {
    return contains(bytecode, production.condition, Opcode::Step) ||
           contains(bytecode, production.weight_code, Opcode::Step) ||
           contains(bytecode, production.successor, Opcode::Step);
}

template <typename T>
std::uint64_t bytes_of(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

} // namespace

Plan::Plan(const Bytecode& bytecode, const PlanInputs& inputs, bool each_generation, Stage stage)
    : bytecode_(bytecode), inputs_(inputs), each_generation_(each_generation),
      productions_(bytecode.productions_of(stage)),
      families_by_symbol_(stage != Stage::Rewrite ||
                          bytecode.settings.rewriting == RewritingMode::Parallel ||
                          bytecode.settings.rewriting == RewritingMode::Leftmost) {
    if (bytecode.settings.random == RandomSource::Glibc) {
        glibc_draws_.emplace(bytecode, inputs.seed);
    }
    make_codes();
    make_families();
    make_guards();
    make_entries();
    if (families_by_symbol_) {
        if (has_parameters_ && bytecode_.code_count() <= kMaxFoldedCodes) {
            folding_.index.emplace(bytecode_);
        }
        for (const Candidate& candidate : candidates_) {
            active_.predecessor_count = std::max(active_.predecessor_count, candidate.modules);
        }
        for (std::uint32_t i = 0; i < families_.size(); ++i) {
            activate_family(i);
        }
    }
}

void Plan::make_codes() {
    const Code count = bytecode_.code_count();
    codes_.width = lsys::code_width(count);
    codes_.first_identity = static_cast<std::uint32_t>(bytecode_.template_codes.size());
    codes_.pool.reserve((std::size_t{codes_.first_identity} + count) * codes_.width + kWordSlack);
    for (const Code code : bytecode_.template_codes) {
        append_code(code, codes_.width, codes_.pool);
    }
    for (Code code = 0; code < count; ++code) {
        append_code(code, codes_.width, codes_.pool);
    }
    codes_.pool.resize(codes_.pool.size() + kWordSlack);

    has_structure_ = bytecode_.settings.word_shape == WordShape::Ring;
    std::uint32_t max_stored = 0;
    for (const BytecodeSymbol& symbol : bytecode_.symbols) {
        max_stored = std::max(max_stored, symbol.parameter_count);
        has_structure_ = has_structure_ || symbol.ignored ||
                         symbol.kind == SymbolKind::BranchOpen ||
                         symbol.kind == SymbolKind::BranchClose;
    }
    has_parameters_ = max_stored != 0;
    has_several_parameters_ = max_stored > 1;
    for (const BytecodeProduction& production : bytecode_.productions) {
        if (std::uint64_t{production.successor.codes.count} * codes_.width > codes_.wide_bytes) {
            codes_.wide_bytes = 32;
        }
    }
    terms_.resize(max_stored); // identity terms, which all entries that copy a module share
    for (std::uint32_t i = 0; i < max_stored; ++i) {
        terms_[i].input = i;
    }

    const std::size_t symbols = bytecode_.symbols.size();
    codes_.first_of_symbol.assign(symbols + 1, 0);
    for (Code code = 0; code < count; ++code) {
        ++codes_.first_of_symbol[static_cast<std::size_t>(bytecode_.symbol_of(code)) + 1];
    }
    for (std::size_t i = 0; i < symbols; ++i) {
        codes_.first_of_symbol[i + 1] += codes_.first_of_symbol[i];
    }
    codes_.by_symbol.resize(count);
    std::vector<std::uint32_t> next(codes_.first_of_symbol.begin(),
                                    codes_.first_of_symbol.end() - 1);
    for (Code code = 0; code < count; ++code) {
        codes_.by_symbol[next[static_cast<std::size_t>(bytecode_.symbol_of(code))]++] = code;
    }
}

std::span<const Code> Plan::codes_of(SymbolId symbol) const {
    const auto index = static_cast<std::size_t>(symbol);
    return {codes_.by_symbol.data() + codes_.first_of_symbol[index],
            codes_.first_of_symbol[index + 1] - codes_.first_of_symbol[index]};
}

SymbolId Plan::first_symbol(std::uint32_t rule) const {
    const Candidate& candidate = candidates_[families_[rule].first];
    return bytecode_.patterns[bytecode_.productions[candidate.production].predecessor.first].symbol;
}

void Plan::make_families() {
    const bool one_choice = bytecode_.settings.choice == ChoiceScope::Generation;
    std::vector<std::uint32_t> family_of_production;
    family_of_production.reserve(productions_.count);
    std::vector<std::uint32_t> family_of_symbol(families_by_symbol_ ? bytecode_.symbols.size() : 0,
                                                kNone);
    for (std::uint32_t p = productions_.first; p < productions_.first + productions_.count; ++p) {
        const BytecodeProduction& production = bytecode_.productions[p];
        std::uint32_t index = production.rule;
        if (families_by_symbol_) {
            const SymbolId symbol = bytecode_.patterns[production.predecessor.first].symbol;
            std::uint32_t& known = family_of_symbol[static_cast<std::size_t>(symbol)];
            if (known == kNone) {
                known = static_cast<std::uint32_t>(families_.size());
            }
            index = known;
        }
        if (index >= families_.size()) {
            families_.resize(std::size_t{index} + 1);
        }
        ++families_[index].count;
        family_of_production.push_back(index);
    }
    std::uint32_t first = 0;
    std::uint32_t max_count = 0;
    for (Family& family : families_) {
        family.first = first;
        first += family.count;
        max_count = std::max(max_count, family.count);
    }
    record_width_ = max_count <= 0xFF ? 1 : 4;

    candidates_.resize(productions_.count);
    std::vector<std::uint32_t> filled(families_.size(), 0);
    for (std::uint32_t p = productions_.first; p < productions_.first + productions_.count; ++p) {
        const BytecodeProduction& production = bytecode_.productions[p];
        const std::uint32_t index = family_of_production[p - productions_.first];
        Family& family = families_[index];
        Candidate& candidate = candidates_[family.first + filled[index]++];
        const PatternItem& item = bytecode_.patterns[production.predecessor.first];
        std::uint32_t own_count = 0; // formals of all predecessor modules
        for (std::uint32_t i = 0; i < production.predecessor.count; ++i) {
            own_count +=
                bytecode_.symbol(bytecode_.patterns[production.predecessor.first + i].symbol)
                    .parameter_count;
        }
        const std::uint32_t own_end = item.first_formal + own_count;
        candidate.production = p;
        candidate.modules = production.predecessor.count;
        candidate.group = production.group;
        candidate.own_first = item.first_formal;
        candidate.weight = production.weight;
        candidate.stochastic = production.stochastic;
        candidate.computes_weight = production.weight_code != kNone;
        candidate.has_context = production.has_left || production.has_right;
        candidate.reads_context =
            uses_formal_outside(bytecode_, production.condition, item.first_formal, own_end) ||
            uses_formal_outside(bytecode_, production.weight_code, item.first_formal, own_end) ||
            uses_formal_outside(bytecode_, production.successor.locals, item.first_formal,
                                own_end) ||
            uses_formal_outside(bytecode_, production.successor.arguments, item.first_formal,
                                own_end);
        candidate.gathers = candidate.reads_context || item.first_formal != 0 ||
                            (production.predecessor.count > 1 && own_count > 0);
        family.replaces_several = family.replaces_several || candidate.modules > 1;
        family.has_context = family.has_context || candidate.has_context;
        family.reads_context = family.reads_context || candidate.reads_context;
        family.depends_on_generation = family.depends_on_generation ||
                                       (one_choice && production.stochastic) ||
                                       uses_step(bytecode_, production);
    }
    for (std::uint32_t i = 0; i < families_.size(); ++i) {
        if (families_[i].depends_on_generation) {
            generation_families_.push_back(i);
        }
    }
}

void Plan::make_guards() {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 22;
    const Code codes = bytecode_.code_count();
    if (std::uint64_t{codes} * families_.size() * 2 > kMaxBytes) {
        return;
    }
    const auto accept = [&](std::uint32_t& guard, SymbolId symbol) {
        if (guard == kNone) {
            guard = static_cast<std::uint32_t>(guards_.size());
            guards_.resize(guards_.size() + codes);
        }
        for (const Code code : codes_of(symbol)) {
            guards_[guard + code] = 1;
        }
    };
    for (Family& family : families_) {
        bool all_left = true;
        bool all_right = true;
        for (const Candidate& candidate : candidates(family)) {
            const BytecodeProduction& production = bytecode_.productions[candidate.production];
            all_left = all_left && production.has_left;
            all_right = all_right && production.has_right &&
                        !(families_by_symbol_ && family.replaces_several) &&
                        bytecode_.patterns[production.right.first].kind == PatternKind::Module;
        }
        for (const Candidate& candidate : candidates(family)) {
            const BytecodeProduction& production = bytecode_.productions[candidate.production];
            if (all_left) {
                const std::uint32_t nearest = production.left.first + production.left.count - 1;
                accept(family.left_guard, bytecode_.patterns[nearest].symbol);
            }
            if (all_right) {
                accept(family.right_guard, bytecode_.patterns[production.right.first].symbol);
            }
        }
    }
}

void Plan::make_entries() {
    const Code count = bytecode_.code_count();
    rows_.resize(count);
    folding_.block_of_code.assign(count, kNone);
    choices_.of_code.assign(count, kNone);
    tests_.of_code.assign(count, kNone);
    entries_.resize(std::size_t{count} + candidates_.size());
    for (Code code = 0; code < count; ++code) {
        Row& row = rows_[code];
        row.stored = bytecode_.stored_parameters(code);
        if (code >= bytecode_.symbols.size()) {
            row.constants = bytecode_.folded[code - bytecode_.symbols.size()].first_constant;
        }
        reset_row(code);
    }
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const WordTemplate& successor = bytecode_.productions[candidates_[i].production].successor;
        Entry& entry = entries_[count + i];
        entry.candidate = static_cast<std::uint32_t>(i);
        entry.first_code = successor.codes.first;
        entry.first_place = successor.codes.first;
        entry.code_count = successor.codes.count;
        entry.parameter_count = successor.parameter_count;
        if (entry.parameter_count > kEntryTerms) {
            candidates_[i].first_term = static_cast<std::uint32_t>(terms_.size());
            terms_.resize(terms_.size() + entry.parameter_count);
        }
    }
}

Code Plan::pool_code(std::uint32_t index) const {
    if (index < codes_.first_identity) {
        return bytecode_.template_codes[index];
    }
    const Code code = index - codes_.first_identity;
    return code < bytecode_.code_count() ? code : folding_.codes[code - bytecode_.code_count()];
}

std::uint32_t Plan::add_template(const std::vector<Code>& codes) {
    codes_.pool.resize(codes_.pool.size() - kWordSlack);
    const auto first = static_cast<std::uint32_t>(codes_.pool.size() / codes_.width);
    for (const Code code : codes) {
        append_code(code, codes_.width, codes_.pool);
    }
    codes_.pool.resize(codes_.pool.size() + kWordSlack);
    folding_.codes.insert(folding_.codes.end(), codes.begin(), codes.end());
    return first;
}

Entry Plan::identity_entry(Code code) const {
    Entry entry;
    entry.first_code = codes_.first_identity + code;
    entry.code_count = 1;
    entry.parameter_count = rows_[code].stored;
    for (std::uint32_t term = 0; term < kEntryTerms && term < entry.parameter_count; ++term) {
        entry.scale[term] = 1.0F;
        entry.offset[term] = -0.0F;
        entry.input[term] = static_cast<std::uint8_t>(term);
    }
    entry.reads_own = entry.parameter_count != 0;
    entry.special = entry.parameter_count > kEntryTerms;
    return entry;
}

void Plan::set_special(Entry& entry) const {
    const bool is_short = std::uint64_t{entry.code_count} * codes_.width <= codes_.wide_bytes;
    entry.special = entry.general || entry.parameter_count > kEntryTerms || !is_short;
    const Candidate& candidate = candidates_[entry.candidate];
    entry.batched = entry.general && is_short && entry.parameter_count <= kMaxBatchedParameters &&
                    entry.terms_or_program != kNone && !candidate.gathers;
}

void Plan::set_kind(Code code, RowKind kind) {
    Row& row = rows_[code];
    active_.dynamic_rows -= row.kind != RowKind::Fixed ? 1 : 0;
    active_.dynamic_rows += kind != RowKind::Fixed ? 1 : 0;
    row.kind = kind;
    row.copies = row.copies && kind == RowKind::Fixed;
}

void Plan::reset_row(Code code) {
    set_kind(code, RowKind::Fixed);
    Row& row = rows_[code];
    row.slow = false;
    row.copies = true;
    row.code_count = 1;
    row.parameter_count = row.stored;
    entries_[code] = identity_entry(code);
}

void Plan::prepare(std::uint32_t generation) {
    LSYS_CHECK(each_generation_);
    generation_ = generation;
    if (glibc_draws_) {
        glibc_draws_->prepare(generation);
    }
    for (const std::uint32_t index : generation_families_) {
        families_[index].current = false;
        if (families_by_symbol_) {
            activate_family(index);
        }
    }
}

void Plan::select_rule(std::uint32_t rule) {
    if (active_.selected_rule != kNone) {
        for (const Code code : codes_of(first_symbol(active_.selected_rule))) {
            reset_row(code);
        }
    }
    active_.needs_contexts = false;
    active_.reads_contexts = false;
    active_.selected_rule = rule;
    active_.predecessor_count =
        bytecode_.productions[candidates_[families_[rule].first].production].predecessor.count;
    activate_family(rule);
}

float Plan::rule_draw(std::uint32_t rule, std::uint32_t generation) const {
    if (glibc_draws_) {
        return glibc_draws_->draw(rule, generation);
    }
    const std::uint64_t position = ~std::uint64_t{0} - rule;
    return unit_interval(draw_block(inputs_.seed, generation, position, 0)[0]);
}

std::uint64_t Plan::held_bytes() const {
    return bytes_of(rows_) + bytes_of(entries_) + bytes_of(terms_) + bytes_of(families_) +
           bytes_of(candidates_) + bytes_of(comparisons_) + bytes_of(batch_programs_) +
           bytes_of(choices_.list) + bytes_of(choices_.thresholds) + bytes_of(choices_.records) +
           bytes_of(codes_.pool) + bytes_of(codes_.first_of_symbol) + bytes_of(codes_.by_symbol) +
           bytes_of(choices_.of_code) + bytes_of(tests_.of_code) + bytes_of(tests_.lists) +
           bytes_of(tests_.list) + bytes_of(guards_) + bytes_of(generation_families_) +
           bytes_of(folding_.codes) + bytes_of(folding_.block_of_code);
}

} // namespace lsys
