// SPDX-License-Identifier: MIT
#include "runtime/cli/module_lines.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys::lsc {

void ModuleLines::append(const StreamChunk& piece, std::string& text) {
    std::span<const float> parameters = piece.parameters;
    for (std::size_t i = 0; i < piece.codes.size(); ++i) {
        const std::uint32_t stored = bytecode_.stored_parameters(piece.codes[i]);
        modules_.begin();
        text += modules_.quote();
        modules_.append(piece.codes.subspan(i, 1), parameters.first(stored), text);
        text += modules_.quote();
        parameters = parameters.subspan(stored);
        text += ' ';
        origins_.append(piece.origins[i], text);
        text += '\n';
    }
}

bool ModuleLines::print(const Word& word, const std::function<bool(std::string_view)>& flush) {
    constexpr std::uint64_t kModulesPerFlush = 4096;
    std::vector<Code> codes;
    std::string text;
    std::size_t parameter = 0;
    for (std::uint64_t first = 0; first < word.module_count(); first += kModulesPerFlush) {
        const std::uint64_t count = std::min(kModulesPerFlush, word.module_count() - first);
        codes.clear();
        std::size_t stored = 0;
        for (std::uint64_t i = first; i < first + count; ++i) {
            codes.push_back(word.code(i));
            stored += bytecode_.stored_parameters(codes.back());
        }
        text.clear();
        append({codes, word.parameters().subspan(parameter, stored),
                word.origins().subspan(first, count)},
               text);
        if (!flush(text)) {
            return false;
        }
        parameter += stored;
    }
    return true;
}

} // namespace lsys::lsc
