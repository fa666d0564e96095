// SPDX-License-Identifier: MIT
// Base64Writer: writes bytes that arrive in pieces as Base64 (RFC 4648).
#pragma once

#include "runtime/export/impl/piece_writer.h"

#include <array>

namespace lsys {

class Base64Writer {
public:
    explicit Base64Writer(PieceWriter& out) : out_(out) {}

    void put(std::span<const std::byte> bytes);
    /// Writes the digits of the last, incomplete group of three bytes, with padding.
    void finish();

private:
    PieceWriter& out_;
    std::array<std::byte, 3> pending_{}; // bytes of the incomplete group of three
    std::size_t pending_size_ = 0;
};

} // namespace lsys
