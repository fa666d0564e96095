// SPDX-License-Identifier: MIT
#include "runtime/export/impl/base64.h"

#include "runtime/export/base64.h"

#include <algorithm>
#include <cstring>

namespace lsys {

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The two Base64 digits of each 12-bit value.
constexpr std::array<std::array<char, 2>, 4096> kPairs = [] {
    std::array<std::array<char, 2>, 4096> pairs{};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i] = {kDigits[i / 64], kDigits[i % 64]};
    }
    return pairs;
}();

char* put_group(char* at, const std::byte* bytes) {
    const std::uint32_t bits = std::to_integer<std::uint32_t>(bytes[0]) << 16U |
                               std::to_integer<std::uint32_t>(bytes[1]) << 8U |
                               std::to_integer<std::uint32_t>(bytes[2]);
    std::memcpy(at, kPairs[bits >> 12U].data(), 2);
    std::memcpy(at + 2, kPairs[bits & 0xFFFU].data(), 2);
    return at + 4;
}

} // namespace

void Base64Writer::put(std::span<const std::byte> bytes) {
    while (pending_size_ != 0 && pending_size_ < 3 && !bytes.empty()) {
        pending_[pending_size_++] = bytes.front();
        bytes = bytes.subspan(1);
    }
    if (pending_size_ == 3) {
        out_.advance_to(put_group(out_.room(4), pending_.data()));
        pending_size_ = 0;
    }
    constexpr std::size_t kGroups = 4096;
    while (bytes.size() >= 3 && !out_.stopped()) {
        const std::size_t groups = std::min(bytes.size() / 3, kGroups);
        char* at = out_.room(4 * groups);
        for (std::size_t i = 0; i < groups; ++i) {
            at = put_group(at, bytes.data() + 3 * i);
        }
        out_.advance_to(at);
        bytes = bytes.subspan(3 * groups);
    }
    if (bytes.size() < 3) {
        for (const std::byte byte : bytes) {
            pending_[pending_size_++] = byte;
        }
    }
}

void Base64Writer::finish() {
    if (pending_size_ != 0) {
        std::fill(pending_.begin() + static_cast<std::ptrdiff_t>(pending_size_), pending_.end(),
                  std::byte{0});
        char* const at = out_.room(4);
        put_group(at, pending_.data());
        std::fill(at + pending_size_ + 1, at + 4, '=');
        out_.advance_to(at + 4);
        pending_size_ = 0;
    }
}

std::string base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    const ByteSink sink = [&text](std::string_view piece) {
        text += piece;
        return true;
    };
    PieceWriter out(sink);
    Base64Writer writer(out);
    writer.put(std::as_bytes(std::span(bytes.data(), bytes.size())));
    writer.finish();
    static_cast<void>(out.finish());
    return text;
}

} // namespace lsys
