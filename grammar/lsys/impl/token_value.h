// What tokens and symbols of the parser carry. A plain struct: the parser moves a value for every
// step it makes, and copying bytes is all that this may cost.
#pragma once

#include "grammar/ast/ast_builder.h"

#include <cstdint>

namespace lsys::lsys_grammar {

struct TokenValue {
    ModuleList modules;
    TextRange names; // a run of them
    union {
        NameId name;
        float number;
        ExpressionId expression;
        std::uint32_t count = 0;
    };
};

} // namespace lsys::lsys_grammar
