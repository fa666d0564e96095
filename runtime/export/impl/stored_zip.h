// SPDX-License-Identifier: MIT
// StoredZip: a zip archive without compression, whose entries begin at multiples of 64 bytes
// (PKWARE, "APPNOTE.TXT - .ZIP file format specification", 6.3.3; OpenUSD, "USDZ file format
// specification"). All entries have the earliest date that the format can state.
#pragma once

#include "runtime/export/impl/piece_writer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Size and checksum of the bytes of an entry, which the header states before the bytes.
struct EntrySize {
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0; // CRC-32 of zlib

    void add(std::string_view piece);
};

class StoredZip {
public:
    explicit StoredZip(PieceWriter& out) : out_(out) {}

    /// Whether entries of these sizes, with names of at most `name_bytes` altogether, fit into an
    /// archive, which has 32 bits for sizes and offsets.
    [[nodiscard]] static bool holds(const std::vector<EntrySize>& sizes, std::uint64_t name_bytes);

    /// Writes the header of an entry; the caller then puts its `size.bytes` bytes.
    void begin_entry(const std::string& name, const EntrySize& size);
    /// Writes the central directory, which ends the archive.
    void finish();

private:
    struct Entry {
        std::string name;
        EntrySize size;
        std::uint64_t place = 0; // offset of its header
    };

    PieceWriter& out_;
    std::vector<Entry> entries_;
    std::uint64_t end_ = 0; // offset of the end of the last entry
};

} // namespace lsys
