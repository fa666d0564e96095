// SPDX-License-Identifier: MIT
#include "runtime/derive/word.h"

#include "grammar/base/contract.h"
#include "runtime/base/saturating.h"

#include <algorithm>
#include <cstring>

namespace lsys {

namespace {

/// Bytes of `count` items with their slack; saturates.
std::uint64_t bytes_with_slack(std::uint64_t count, std::uint64_t item_bytes) {
    return saturating_add(saturating_multiply(count, item_bytes), kWordSlack);
}

} // namespace

bool Word::resize(std::uint64_t module_count, std::uint64_t parameter_count) {
    module_count_ = 0;
    parameter_count_ = 0;
    if (!codes_.reserve(bytes_with_slack(module_count, code_width_)) ||
        !parameters_.reserve(bytes_with_slack(parameter_count, sizeof(float))) ||
        (keeps_origins_ && !origins_.reserve(saturating_multiply(module_count, sizeof(Origin))))) {
        return false;
    }
    std::memset(parameters_.as<float>() + parameter_count, 0, kWordSlack);
    module_count_ = module_count;
    parameter_count_ = parameter_count;
    return true;
}

bool Word::keep_origins() {
    keeps_origins_ = origins_.reserve(saturating_multiply(module_count_, sizeof(Origin)));
    return keeps_origins_;
}

void Word::drop_origins() {
    origins_.release();
    keeps_origins_ = false;
}

std::uint64_t Word::held_bytes_after(std::uint64_t module_count,
                                     std::uint64_t parameter_count) const {
    // An arena that is too small is released before it grows.
    const auto held = [](const Arena& arena, std::uint64_t bytes) {
        return bytes > arena.capacity() ? bytes
                                        : std::max<std::uint64_t>(arena.max_reserved(), bytes);
    };
    const std::uint64_t codes = held(codes_, bytes_with_slack(module_count, code_width_));
    const std::uint64_t parameters =
        held(parameters_, bytes_with_slack(parameter_count, sizeof(float)));
    const std::uint64_t origins =
        held(origins_, keeps_origins_ ? saturating_multiply(module_count, sizeof(Origin)) : 0);
    return saturating_add(saturating_add(codes, parameters), origins);
}

Code Word::code(std::uint64_t index) const {
    LSYS_DCHECK(index < module_count_, index, module_count_);
    return visit([index](auto codes) -> Code { return codes[index]; });
}

} // namespace lsys
