// Whether the bytes of a file are text: UTF-16 and binary files get one message instead of one for
// every byte that no grammar has.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// Bytes that are no text: their format, and what to do about it.
struct NoText {
    std::string what; // "UTF-16 text", "a PNG picture"
    std::string help;
};

/// What `bytes` are if they are no UTF-8 text; a few control characters or bytes of another
/// encoding do not count.
[[nodiscard]] std::optional<NoText> recognise_no_text(std::string_view bytes);

} // namespace lsys
