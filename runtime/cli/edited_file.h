// A file while `lsc check --fix` edits it: finds the statement of the text as it was that a place
// of the text as it is belongs to.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

/// Bytes [begin, end) of a text.
struct TextPlace {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    friend auto operator<=>(const TextPlace&, const TextPlace&) = default;
};

class EditedFile {
public:
    /// `statements`: their places, in any order.
    EditedFile(std::string_view text, std::vector<TextPlace> statements);

    /// Takes over a round of edits, in order of place, which do not overlap.
    void add_round(std::string_view text, const std::vector<const Edit*>& edits);

    /// A place of the text after all rounds, as one of the text before them. Within an edit it is
    /// where the edit begins.
    [[nodiscard]] std::uint32_t original_place(std::uint32_t at) const;
    /// The statements that the place touches, by number; the place is of the text after all rounds.
    [[nodiscard]] std::vector<std::size_t> statements_at(TextPlace place) const;
    /// The same, where the place is of the text before all rounds.
    [[nodiscard]] std::vector<std::size_t> original_statements_at(TextPlace place) const;

    [[nodiscard]] const std::string& original() const { return original_; }
    /// In order of place.
    [[nodiscard]] const std::vector<TextPlace>& statements() const { return statements_; }

private:
    struct RoundEdit {
        TextPlace before;
        TextPlace after;
    };

    std::string original_;
    std::vector<TextPlace> statements_;
    std::vector<std::vector<RoundEdit>> rounds_;
};

/// Whether the first line of `text` ends with CRLF.
[[nodiscard]] bool has_carriage_returns(std::string_view text);

} // namespace lsys::lsc
