// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/folded_index.h"

#include "grammar/base/hash.h"

#include <bit>
#include <cstddef>
#include <cstring>

namespace lsys {

FoldedIndex::FoldedIndex(const Bytecode& bytecode) : bytecode_(bytecode) {
    const auto first = static_cast<Code>(bytecode.symbols.size());
    codes_.reserve(bytecode.folded.size());
    for (Code code = first; code < bytecode.code_count(); ++code) {
        add(code);
    }
}

Code FoldedIndex::find(SymbolId symbol, const float* arguments) const {
    const std::size_t bytes = bytecode_.symbol(symbol).parameter_count * sizeof(float);
    const auto [begin, end] = codes_.equal_range(hash(symbol, arguments));
    for (auto at = begin; at != end; ++at) {
        if (bytecode_.symbol_of(at->second) == symbol &&
            std::memcmp(constants_of(at->second), arguments, bytes) == 0) {
            return at->second;
        }
    }
    return kNone;
}

void FoldedIndex::add(Code code) {
    codes_.emplace(hash(bytecode_.symbol_of(code), constants_of(code)), code);
}

std::uint64_t FoldedIndex::hash(SymbolId symbol, const float* arguments) const {
    std::uint64_t mixed = combine(0, static_cast<std::uint32_t>(symbol));
    for (std::uint32_t i = 0; i < bytecode_.symbol(symbol).parameter_count; ++i) {
        mixed = combine(mixed, std::bit_cast<std::uint32_t>(arguments[i]));
    }
    return mixed;
}

const float* FoldedIndex::constants_of(Code code) const {
    return bytecode_.constants.data() +
           bytecode_.folded[code - bytecode_.symbols.size()].first_constant;
}

} // namespace lsys
