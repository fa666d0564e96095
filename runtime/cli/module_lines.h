// A word as text with the origin of each module: one module a line.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/origin.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word.h"
#include "runtime/derive/word_text.h"

#include <functional>
#include <string>
#include <string_view>

namespace lsys::lsc {

class ModuleLines {
public:
    /// `bytecode` outlives it.
    explicit ModuleLines(const Bytecode& bytecode)
        : bytecode_(bytecode), modules_(bytecode), origins_(bytecode) {}

    /// Precondition: the piece has origins.
    void append(const StreamChunk& piece, std::string& text);
    /// Hands the text of a whole word to `flush` in pieces; false as soon as flush returns false.
    [[nodiscard]] bool print(const Word& word, const std::function<bool(std::string_view)>& flush);

private:
    const Bytecode& bytecode_;
    WordPrinter modules_;
    OriginPrinter origins_;
};

} // namespace lsys::lsc
