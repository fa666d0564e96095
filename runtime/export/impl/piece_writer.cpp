// SPDX-License-Identifier: MIT
#include "runtime/export/impl/piece_writer.h"

#include <algorithm>
#include <cstring>

namespace lsys {

PieceWriter::PieceWriter(const ByteSink& sink)
    : sink_(sink), buffer_(new char[kPieceBytes]), at_(buffer_.get()), end_(at_ + kPieceBytes) {}

void PieceWriter::pass_on(std::string_view piece) {
    stopped_ = stopped_ || !sink_(piece);
}

void PieceWriter::flush() {
    if (at_ != buffer_.get()) {
        pass_on({buffer_.get(), static_cast<std::size_t>(at_ - buffer_.get())});
        at_ = buffer_.get();
    }
}

void PieceWriter::put(std::string_view text) {
    put_bytes(std::as_bytes(std::span(text.data(), text.size())));
}

void PieceWriter::put_bytes(std::span<const std::byte> bytes) {
    if (bytes.size() < kPieceBytes / 4) {
        char* const to = room(bytes.size());
        std::copy_n(reinterpret_cast<const char*>(bytes.data()), bytes.size(), to);
        advance_to(to + bytes.size());
        return;
    }
    flush();
    for (std::size_t first = 0; first < bytes.size() && !stopped_; first += kPieceBytes) {
        const std::span<const std::byte> piece =
            bytes.subspan(first, std::min(kPieceBytes, bytes.size() - first));
        pass_on({reinterpret_cast<const char*>(piece.data()), piece.size()});
    }
}

bool PieceWriter::finish() {
    flush();
    return !stopped_;
}

} // namespace lsys
