// SPDX-License-Identifier: MIT
// MessageReader: splits a stream of bytes into the messages of the base protocol of LSP 3.17, each
// with a header `Content-Length: N`. Memory is bounded: headers of at most kMaxHeaderBytes,
// messages of at most kMaxMessageBytes; larger ones are skipped and reported. After a message that
// was cut, reading goes on with the next header.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// A message, or the reason why the bytes are none.
struct ReadMessage {
    std::string body;
    std::string error; // empty for a message
};

class MessageReader {
public:
    static constexpr std::size_t kMaxHeaderBytes = 4096;
    static constexpr std::size_t kMaxMessageBytes = std::size_t{64} << 20U;

    /// Appends bytes of the stream, in pieces of any size.
    void add(std::string_view bytes);
    /// The next complete message or error; nullopt if more bytes are needed.
    [[nodiscard]] std::optional<ReadMessage> next();
    /// Whether the stream so far ends between two messages.
    [[nodiscard]] bool is_between_messages() const;

private:
    [[nodiscard]] std::optional<ReadMessage> read_header();

    std::string buffer_;
    std::size_t begin_ = 0;               // index of the first unread byte in buffer_
    std::optional<std::size_t> expected_; // length of the body after the header
    std::size_t skipped_ = 0;             // bytes to skip of a message that is too large
    bool in_long_header_ = false;         // skips a header that is too long
};

/// The bytes of a message with its header.
[[nodiscard]] std::string framed(std::string_view body);

} // namespace lsys
