// SPDX-License-Identifier: MIT
// Merges messages that one mistake in a file of a dialect repeats: a misspelt keyword makes a
// module of each letter, a lost declaration is missed at each use.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstddef>

namespace lsys {

/// Merges the diagnostics from index `first` on: errors with equal texts, and warnings whose texts
/// differ in quoted names and numbers only, become one. The first by place stays; the others become
/// its labels. Diagnostics without a file and notes stay as they are.
void merge_repeated_messages(Diagnostics& diagnostics, std::size_t first);

/// Marks, by a fact, a warning about a statement that may be lost, because another statement
/// replaces it or because the file is cut off there.
void mark_lost_statement(Diagnostic& diagnostic);

/// If a statement may be lost, drops the warnings that would follow: modules that never occur or are
/// never drawn, constants that are never used, brackets that do not balance.
void drop_follow_ups(Diagnostics& diagnostics);

} // namespace lsys
