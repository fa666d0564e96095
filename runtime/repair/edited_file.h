// SPDX-License-Identifier: MIT
// EditedFile: a file during `lsc check --fix`; maps places of the edited text to statements of the
// original.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::repair {

/// Bytes [begin, end) of a text.
struct TextPlace {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend auto operator<=>(const TextPlace&, const TextPlace&) = default;
};

class EditedFile {
public:
    /// `statements`: places in `text`, in any order.
    EditedFile(std::string_view text, std::vector<TextPlace> statements);

    /// Adds a round of edits. `text` is the text before the round. Precondition: `edits` are sorted
    /// by place and do not overlap.
    void add_round(std::string_view text, const std::vector<const Edit*>& edits);

    /// Maps an offset in the edited text to the original text. An offset within an edit maps to the
    /// begin of the edit.
    [[nodiscard]] std::uint32_t original_place(std::uint32_t at) const;
    /// The indices of the statements that a place of the edited text touches.
    [[nodiscard]] std::vector<std::size_t> statements_at(TextPlace place) const;
    /// The indices of the statements that a place of the original touches.
    [[nodiscard]] std::vector<std::size_t> original_statements_at(TextPlace place) const;

    /// The text before all rounds of edits.
    [[nodiscard]] const std::string& original() const { return original_; }
    /// Places of the statements in the original, ascending.
    [[nodiscard]] const std::vector<TextPlace>& statements() const { return statements_; }

private:
    struct RoundEdit {
        TextPlace before; // in the text before the round
        TextPlace after;  // in the text after the round
    };

    std::string original_;                       // original()
    std::vector<TextPlace> statements_;          // statements()
    std::vector<std::vector<RoundEdit>> rounds_; // the edits of each round
};

/// Whether the first line of `text` ends with CRLF.
[[nodiscard]] bool has_carriage_returns(std::string_view text);

} // namespace lsys::repair
