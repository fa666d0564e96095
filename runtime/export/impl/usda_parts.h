// Pieces of USDA that its writers share: lists of numbers, and materials.
#pragma once

#include "runtime/export/impl/piece_writer.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

inline constexpr std::size_t kUsdaItemsOfLine = 8;
inline constexpr std::size_t kUsdaItemBytes = 16 + 3 * (kNumberBytes + 2);

/// Names of the parts, no two alike.
[[nodiscard]] std::vector<std::string> usda_part_names(const Mesh& mesh);

/// `name = [...]` with `put(i, at)` for each item.
template <typename Put>
void put_list(PieceWriter& out, std::string_view name, std::uint64_t count, const Put& put) {
    out.put(fmt::format("        {} = [", name));
    for (std::uint64_t i = 0; i < count && !out.stopped(); ++i) {
        char* at = out.room(kUsdaItemBytes);
        at = put_text(at, i == 0 ? "" : i % kUsdaItemsOfLine == 0 ? ",\n            " : ", ");
        out.used(put(i, at));
    }
    out.put("]");
}

template <std::size_t kCount>
[[nodiscard]] char* put_tuple(char* at, const std::array<float, kCount>& values) {
    for (std::size_t i = 0; i < kCount; ++i) {
        at = put_text(at, i == 0 ? "(" : ", ");
        at = put_number(at, values[i]);
    }
    return put_text(at, ")");
}

/// A scope `Materials` within the prim at path `root`: a material for each part of the mesh.
void put_usda_materials(const Mesh& mesh,
                        const std::vector<std::string>& names,
                        const ExportInfo& info,
                        std::string_view root,
                        PieceWriter& out);

} // namespace lsys
