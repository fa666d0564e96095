// SPDX-License-Identifier: MIT
// Decompositions and homomorphisms of several modules as one: `S T --> ...`. A production of .lsys
// in these stages rewrites one module. cpfg matches the modules within one successor, so each
// sequence `S T` in a successor becomes one module `ST`, with the parameters of both.
#pragma once

#include "grammar/dialects/cpfg/session.h"

namespace lsys {

/// Joins the sequences that productions of decomposition and homomorphism rewrite. Leaves a
/// production as it is if the sequence could stand in a word, where its modules must stay apart.
void join_module_sequences(CpfgSession& session);

} // namespace lsys
