// A derivation saved in its middle: `--save-state`, `--from`. Holds the digest of the program,
// seed, number of generations asked for, age and word, with magic, version and a checksum.
#pragma once

#include "compiler/bytecode.h"
#include "grammar/result.h"
#include "runtime/word.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

struct SavedState {
    std::uint64_t program_digest = 0;
    std::uint64_t seed = 0;
    std::uint32_t generations = 0; // asked for
    std::uint32_t age = 0;
    Word word;
};

/// The bytes of a state file around a word that is not copied: header, then codes, then parameters,
/// then the checksum.
[[nodiscard]] std::string write_state(const SavedState& state);
/// Refuses foreign, newer, truncated or damaged bytes, states of another program, and words that
/// the program could not hold. The message does not name the file.
[[nodiscard]] Result<SavedState> read_state(std::string_view bytes, const Bytecode& bytecode);

} // namespace lsys
