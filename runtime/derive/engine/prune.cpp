// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/prune.h"

#include <algorithm>
#include <span>

namespace lsys {

Pruner::Pruner(const Bytecode& bytecode) {
    kinds_.resize(bytecode.code_count());
    for (Code code = 0; code < kinds_.size(); ++code) {
        const BytecodeSymbol& symbol = bytecode.symbol(bytecode.symbol_of(code));
        Kind& kind = kinds_[code];
        kind.role = symbol.turtle == TurtleOperation::Cut    ? Role::Cut
                    : symbol.kind == SymbolKind::BranchOpen  ? Role::Open
                    : symbol.kind == SymbolKind::BranchClose ? Role::Close
                                                             : Role::Other;
        kind.stored = bytecode.stored_parameters(code);
        can_cut_ = can_cut_ || kind.role == Role::Cut;
    }
}

namespace {

template <typename C>
void write_typed(Pruner& pruner, std::span<const C> codes, const Word& word, Word& out) {
    C* to_code = out.codes<C>().data();
    float* to_parameter = out.parameters().data();
    Origin* to_origin = out.keeps_origins() ? out.origins().data() : nullptr;
    pruner.each_kept(codes.data(), codes.size(), [&](std::uint64_t i, std::uint64_t parameter) {
        *to_code++ = codes[i];
        const float* const from = word.parameters().data() + parameter;
        to_parameter = std::copy(from, from + pruner.stored(codes[i]), to_parameter);
        if (to_origin != nullptr) {
            *to_origin++ = word.origins()[i];
        }
    });
}

} // namespace

PrunedSize pruned_size(Pruner& pruner, const Word& word) {
    pruner.restart();
    return word.visit([&](auto codes) {
        if (!pruner.may_prune(codes.data(), codes.size())) {
            return PrunedSize{word.module_count(), word.parameter_count()};
        }
        PrunedSize size;
        pruner.each_kept(codes.data(), codes.size(), [&](std::uint64_t i, std::uint64_t) {
            ++size.modules;
            size.parameters += pruner.stored(codes[i]);
        });
        return size;
    });
}

void write_pruned(Pruner& pruner, const Word& word, Word& out) {
    pruner.restart();
    word.visit([&](auto codes) { write_typed(pruner, codes, word, out); });
}

} // namespace lsys
