// SPDX-License-Identifier: MIT
// A word as text with the origin of each module, one module per line.
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
    /// `bytecode` must outlive the object.
    explicit ModuleLines(const Bytecode& bytecode)
        : bytecode_(bytecode), modules_(bytecode), origins_(bytecode) {}

    /// Appends one line per module of `piece`. Precondition: `piece` has origins.
    void append(const StreamChunk& piece, std::string& text);
    /// Passes the text of a word to `flush` in pieces. Stops and returns false as soon as `flush`
    /// returns false.
    [[nodiscard]] bool print(const Word& word, const std::function<bool(std::string_view)>& flush);

private:
    const Bytecode& bytecode_;
    WordPrinter modules_;
    OriginPrinter origins_;
};

} // namespace lsys::lsc
