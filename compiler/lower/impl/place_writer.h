// SPDX-License-Identifier: MIT
// Writes Bytecode::template_places, the places of the modules of axiom and successors. Used by
// lower().
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

class PlaceWriter {
public:
    PlaceWriter(const Program& program,
                const Names& names,
                const SourceMap& sources,
                Bytecode& bytecode);

    /// Appends the places of a word whose codes begin at template_codes[first].
    void word(const ProgramWord& word, std::uint32_t first);

private:
    /// Goes to byte `offset` of a file.
    void set_position(const SourceFile& file, std::uint32_t offset);
    /// Moves to the module at `offset`. Returns whether the text between the last module and that
    /// module is ASCII without a line end.
    [[nodiscard]] bool move_to(std::uint32_t offset);
    [[nodiscard]] std::uint32_t length_of(const ProgramWord& word,
                                          const ProgramModule& module) const;
    [[nodiscard]] std::uint32_t name_length_in_source(const ProgramWord& word,
                                                      const ProgramModule& module) const;

    struct Spelling {
        std::uint32_t length = 0; // length of the name in bytes
        bool has_arguments = false;
        bool may_be_quoted = true; // the name itself contains no back quote
    };

    const Program& program_;
    const Names& names_;
    const SourceMap& sources_;
    std::vector<PlaceRun>& runs_;      // Bytecode::template_places
    std::vector<Spelling> spellings_;  // per symbol
    const SourceFile* file_ = nullptr; // file of place_; null before the first module
    std::string_view text_;            // of file_
    std::uint32_t offset_ = 0;         // byte offset of the last module
    LineColumn place_;                 // place of the last module
};

} // namespace lsys
