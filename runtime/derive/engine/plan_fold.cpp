// SPDX-License-Identifier: MIT
// Folding: a module with known arguments gets its own template in the pool. This template contains
// folded modules, and replaces the template and parameters of the production.
#include "runtime/derive/engine/plan.h"

#include <algorithm>

namespace lsys {

namespace {

/// Max codes of all folded templates together.
constexpr std::size_t kMaxFoldedTemplateCodes = std::size_t{1} << 20;
/// A family with more candidates gives its codes no entries of their own.
constexpr std::uint32_t kMaxCandidatesForOwnEntries = 256;

} // namespace

bool Plan::fold(Code code, Entry& entry) {
    if (!folding_.index || rows_[code].stored != 0 || entry.parameter_count == 0) {
        return false;
    }
    const std::uint64_t key = std::uint64_t{code} << 32 | entry.candidate;
    auto known = folding_.templates.find(key);
    if (known == folding_.templates.end()) {
        const std::uint32_t first =
            folded_template(candidates_[entry.candidate], folded_arguments(rows_[code]));
        known = folding_.templates.emplace(key, first).first;
    }
    if (known->second == kNone) {
        return false;
    }
    entry.first_code = known->second;
    entry.parameter_count = 0;
    entry.general = false;
    entry.reads_own = false;
    set_special(entry);
    return true;
}

std::uint32_t Plan::folded_template(const Candidate& candidate, const float* own) {
    const WordTemplate& successor = bytecode_.productions[candidate.production].successor;
    if (candidate.gathers || has_random_parameters(bytecode_, successor) ||
        folding_.codes.size() + successor.codes.count > kMaxFoldedTemplateCodes ||
        contains(bytecode_, successor, Opcode::Step)) {
        return kNone;
    }
    const EvalFrame frame{own, inputs_.globals, 0.0F, inputs_.steps};
    std::vector<float> values(successor.parameter_count);
    EvalFault fault;
    if (!evaluate(bytecode_, successor, frame, nullptr, values.data(), fault)) {
        return kNone;
    }
    std::vector<Code> codes;
    codes.reserve(successor.codes.count);
    const float* arguments = values.data();
    for (std::uint32_t i = 0; i < successor.codes.count; ++i) {
        Code written = bytecode_.template_codes[successor.codes.first + i];
        const std::uint32_t stored = bytecode_.stored_parameters(written);
        if (stored != 0) {
            written = folding_.index->find(static_cast<SymbolId>(written), arguments);
            arguments += stored;
        }
        if (written == kNone) {
            return kNone;
        }
        codes.push_back(written);
    }
    return add_template(codes);
}

void Plan::fold_records(const Family& family, Code code) {
    Row& row = rows_[code];
    if (!folding_.index || row.stored != 0 || family.count > kMaxCandidatesForOwnEntries) {
        return;
    }
    std::vector<Entry> block(entries_.begin() + row.base + 1,
                             entries_.begin() + row.base + 1 + family.count);
    bool any = false;
    for (Entry& entry : block) {
        any = fold(code, entry) || any;
    }
    if (!any) {
        return;
    }
    std::uint32_t& first = folding_.block_of_code[code];
    if (first == kNone) {
        first = static_cast<std::uint32_t>(entries_.size());
        entries_.resize(entries_.size() + family.count);
    }
    std::copy(block.begin(), block.end(), entries_.begin() + first);
    row.base = first - 1;
    row.slow =
        folded_arguments(row) != nullptr &&
        std::any_of(block.begin(), block.end(), [](const Entry& entry) { return entry.reads_own; });
}

} // namespace lsys
