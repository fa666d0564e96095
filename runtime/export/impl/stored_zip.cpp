// SPDX-License-Identifier: MIT
#include "runtime/export/impl/stored_zip.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <zlib.h>

namespace lsys {

namespace {

constexpr std::uint64_t kAlignment = 64;   // bytes, of the contents of entries in the file
constexpr std::uint64_t kHeaderBytes = 30; // bytes of an entry, without name and padding
constexpr std::uint64_t kDirectoryEntryBytes =
    46;                                 // of an entry of the central directory, without its name
constexpr std::uint64_t kEndBytes = 22; // bytes of the end of central directory record
constexpr std::uint64_t kExtraHeaderBytes = 4; // kind and size of an extra field
constexpr std::uint16_t kPaddingKind = 0x1986; // as in OpenUSD's archives
constexpr std::uint16_t kVersion = 10;         // of the format: 1.0, stored entries
constexpr std::uint16_t kUtf8Names = 0x0800;
constexpr std::uint16_t kFirstDate = 0x0021; // 1 January 1980

/// Little-endian fields of 16 and 32 bits.
class Record {
public:
    Record& u16(std::uint64_t value) {
        bytes_ += static_cast<char>(value & 0xFFU);
        bytes_ += static_cast<char>(value >> 8U & 0xFFU);
        return *this;
    }
    Record& u32(std::uint64_t value) { return u16(value & 0xFFFFU).u16(value >> 16U & 0xFFFFU); }
    Record& text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    Record& zeros(std::uint64_t count) {
        bytes_.append(count, '\0');
        return *this;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// The fields common to both headers of an entry: version, flags, method, time, date, checksum,
/// sizes and length of the name.
void put_common_fields(Record& record, const std::string& name, const EntrySize& size) {
    constexpr std::uint16_t kStoredMethod = 0;
    record.u16(kVersion).u16(kUtf8Names).u16(kStoredMethod).u16(0).u16(kFirstDate);
    record.u32(size.checksum).u32(size.bytes).u32(size.bytes).u16(name.size());
}

/// Bytes of the extra field that aligns an entry whose bytes would begin at `place` without it.
std::uint64_t padding_of(std::uint64_t place) {
    const std::uint64_t missing = (kAlignment - place % kAlignment) % kAlignment;
    return missing == 0 || missing >= kExtraHeaderBytes ? missing : missing + kAlignment;
}

} // namespace

void EntrySize::add(std::string_view piece) {
    constexpr std::size_t kMaxZlibBytes = std::size_t{1} << 30; // zlib takes sizes as `unsigned`
    bytes += piece.size();
    while (!piece.empty()) {
        const std::string_view part = piece.substr(0, kMaxZlibBytes);
        checksum = static_cast<std::uint32_t>(crc32(
            checksum, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(part.size())));
        piece.remove_prefix(part.size());
    }
}

bool StoredZip::holds(const std::vector<EntrySize>& sizes, std::uint64_t name_bytes) {
    std::uint64_t total = kEndBytes + 2 * name_bytes;
    for (const EntrySize& size : sizes) {
        constexpr std::uint64_t kMaxPadding = kAlignment + kExtraHeaderBytes;
        total += kHeaderBytes + kDirectoryEntryBytes + kMaxPadding + size.bytes;
    }
    return total < std::numeric_limits<std::uint32_t>::max() &&
           sizes.size() < std::numeric_limits<std::uint16_t>::max();
}

void StoredZip::begin_entry(const std::string& name, const EntrySize& size) {
    const std::uint64_t padding = padding_of(end_ + kHeaderBytes + name.size());
    Record header;
    header.text("PK\x03\x04");
    put_common_fields(header, name, size);
    header.u16(padding).text(name);
    if (padding > 0) {
        header.u16(kPaddingKind)
            .u16(padding - kExtraHeaderBytes)
            .zeros(padding - kExtraHeaderBytes);
    }
    out_.put(header.bytes());
    entries_.push_back({name, size, end_});
    end_ += header.bytes().size() + size.bytes;
}

void StoredZip::finish() {
    Record list;
    for (const Entry& entry : entries_) {
        list.text("PK\x01\x02").u16(kVersion);
        put_common_fields(list, entry.name, entry.size);
        // No extra field, no comment, first disk, no attributes.
        list.u16(0).u16(0).u16(0).u16(0).u32(0).u32(entry.place).text(entry.name);
    }
    const std::uint64_t list_bytes = list.bytes().size();
    list.text("PK\x05\x06").u16(0).u16(0).u16(entries_.size()).u16(entries_.size());
    list.u32(list_bytes).u32(end_).u16(0);
    out_.put(list.bytes());
}

} // namespace lsys
