// SPDX-License-Identifier: MIT
// The semantic value of tokens and symbols: a trivially copyable struct, because the parser moves
// one in every step.
#pragma once

#include "grammar/ast/ast_builder.h"

#include <cstdint>

namespace lsys::lsys_grammar {

struct TokenValue {
    ModuleList modules;
    TextRange names; // a run of names
    union {
        NameId name;
        float number;
        ExpressionId expression;
        std::uint32_t count = 0;
    };
};

} // namespace lsys::lsys_grammar
