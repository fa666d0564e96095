// SPDX-License-Identifier: MIT
// Declares recognise_X() and translate_X() for each row of dialects.def; the folder of the dialect
// defines them.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Returns no names: for dialects whose files hold one system.
std::vector<std::string> no_system_names(std::string_view text);

#define LSYS_DIALECT(enumerator, name, folder, title, extensions, turtle, systems)                 \
    std::string_view recognise_##folder(std::string_view text);                                    \
    void translate_##folder(const DialectRow& row, const ParseContext& context, Translation& out); \
    std::vector<std::string> systems(std::string_view text);
#include "grammar/dialects/dialects.def"
#undef LSYS_DIALECT

} // namespace lsys
