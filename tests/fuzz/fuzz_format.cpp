// SPDX-License-Identifier: MIT
// Formats texts: for every text that parses, formatting is idempotent, and the formatted text
// parses.
#include "grammar/format/format.h"

#include <cstdlib>
#include <optional>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::optional<std::string> format(const std::string& text) {
    lsys::SourceMap sources;
    lsys::Names names;
    lsys::Diagnostics diagnostics;
    const lsys::FileLoader no_files = [](const std::string&) -> lsys::Result<std::string> {
        return lsys::Error{"no such file"};
    };
    const lsys::FileId file = sources.add("fuzz.lsys", text);
    return lsys::format_lsys(file, {sources, names, diagnostics, no_files});
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::optional<std::string> once = format(std::string(data, data + size));
    if (once && format(*once) != once) {
        std::abort();
    }
    return 0;
}
