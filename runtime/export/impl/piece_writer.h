// SPDX-License-Identifier: MIT
// PieceWriter: buffers the output of a sink. Small writes are collected into pieces of kPieceBytes;
// large arrays go to the sink in pieces of this size without a copy. After the sink has returned
// false, bytes are discarded.
#pragma once

#include "runtime/export/export.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace lsys {

inline constexpr std::size_t kPieceBytes = std::size_t{256} << 10;

class PieceWriter {
public:
    explicit PieceWriter(const ByteSink& sink); // `sink` must outlive the writer
    explicit PieceWriter(ByteSink&&) = delete;

    /// Room for the next `bytes` bytes, at most kPieceBytes. The caller writes there and calls
    /// advance_to() with the end of what it wrote.
    [[nodiscard]] char* room(std::size_t bytes) {
        if (static_cast<std::size_t>(end_ - at_) < bytes) {
            flush();
        }
        return at_;
    }
    /// Keeps the bytes written to room() up to `end`.
    void advance_to(char* end) { at_ = end; }

    void put(std::string_view text);
    /// Passes long spans to the sink without a copy.
    void put_bytes(std::span<const std::byte> bytes);
    template <typename T>
    void put_array(std::span<const T> items) {
        put_bytes(std::as_bytes(items));
    }

    [[nodiscard]] bool stopped() const { return stopped_; }
    /// Passes the buffered bytes to the sink. Returns false if the sink has stopped.
    [[nodiscard]] bool finish();

private:
    /// Passes the buffered bytes to the sink.
    void flush();
    /// Passes `piece` to the sink, unless the sink has refused an earlier piece.
    void pass_on(std::string_view piece);

    const ByteSink& sink_;
    std::unique_ptr<char[]> buffer_;
    char* at_;  // next byte of buffer_ to write
    char* end_; // end of buffer_
    bool stopped_ = false;
};

} // namespace lsys
