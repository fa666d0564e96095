// SPDX-License-Identifier: MIT
// JsonTemplate: JSON text with gaps for the numbers by which an item of a glTF document refers to
// others. An item that many documents have is formatted once. Made by make_json_template(); used by
// TileDocument.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Kinds of numbers in a gap, as the document numbers its items.
enum class JsonGapKind : std::uint8_t {
    Item,     // an item of a PartTable, such as a view or a material
    Accessor, // an accessor of the mesh
    Buffer,   // a buffer of a PartTable
    Fallback, // the fallback of a buffer (runtime/export/tile_document.h)
};

/// The item that a gap refers to.
struct JsonReference {
    JsonGapKind kind = JsonGapKind::Item;
    /// Accessor: counted from the first accessor of the mesh; else: number of the item or buffer in
    /// the PartTable.
    std::size_t number = 0;
};

class JsonTemplate {
public:
    /// Appends the text with number_of(reference) in each gap.
    template <typename NumberOf>
    void append_to(std::string& text, const NumberOf& number_of) const {
        std::size_t at = 0;
        for (const Gap& gap : gaps_) {
            text.append(text_, at, gap.at - at);
            append_number(text, number_of(gap.reference));
            at = gap.at;
        }
        text.append(text_, at);
    }
    /// Text that only equal templates have.
    [[nodiscard]] std::string key() const;

private:
    friend class JsonTemplateMaker;
    struct Gap {
        std::size_t at = 0; // in text_
        JsonReference reference;
    };
    static void append_number(std::string& text, std::size_t number);

    std::string text_; // without the numbers of gaps
    std::vector<Gap> gaps_;
};

/// The numbers in a value that are references.
using JsonReferences = std::map<const nlohmann::ordered_json*, JsonReference>;

/// The text of `value` as by dump(), with gaps for `references`, which point into it.
[[nodiscard]] JsonTemplate make_json_template(const nlohmann::ordered_json& value,
                                              const JsonReferences& references);

} // namespace lsys
