#include "runtime/derive/engine/prune.h"

#include <cstddef>

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
        any_ = any_ || kind.role == Role::Cut;
    }
}

namespace {

template <typename C>
PrunedSize size_typed(Pruner& pruner, const Word& word) {
    const C* const codes = word.codes<C>().data();
    if (!pruner.concerns(codes, word.module_count())) {
        return {word.module_count(), word.parameter_count()};
    }
    PrunedSize size;
    pruner.each_kept(codes, word.module_count(), [&](std::uint64_t i, std::uint64_t) {
        ++size.modules;
        size.parameters += pruner.stored(codes[i]);
    });
    return size;
}

template <typename C>
void write_typed(Pruner& pruner, const Word& word, Word& out) {
    const C* const codes = word.codes<C>().data();
    C* to_code = out.codes<C>().data();
    float* to_parameter = out.parameters().data();
    Origin* to_origin = out.keeps_origins() ? out.origins().data() : nullptr;
    pruner.each_kept(codes, word.module_count(), [&](std::uint64_t i, std::uint64_t parameter) {
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
    pruner.begin_again();
    switch (word.code_width()) {
    case 1:
        return size_typed<std::uint8_t>(pruner, word);
    case 2:
        return size_typed<std::uint16_t>(pruner, word);
    default:
        return size_typed<std::uint32_t>(pruner, word);
    }
}

void write_pruned(Pruner& pruner, const Word& word, Word& out) {
    pruner.begin_again();
    switch (word.code_width()) {
    case 1:
        write_typed<std::uint8_t>(pruner, word, out);
        break;
    case 2:
        write_typed<std::uint16_t>(pruner, word, out);
        break;
    default:
        write_typed<std::uint32_t>(pruner, word, out);
        break;
    }
}

} // namespace lsys
