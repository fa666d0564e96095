// SPDX-License-Identifier: MIT
// USDZ archives: stored entries at multiples of 64 bytes, and their contents.
#include "runtime/export/export.h"
#include "runtime/export/impl/stored_zip.h"
#include "tests/support/meshes.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;

namespace {

std::uint64_t field(const std::string& bytes, std::size_t at, std::size_t size) {
    REQUIRE(at + size <= bytes.size());
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
    }
    return value;
}

struct ZipEntry {
    std::string name;
    std::string bytes;
    std::size_t place = 0; // offset of the contents
};

/// Entries by the central directory; checks that the local headers agree with it.
std::vector<ZipEntry> entries_of(const std::string& archive) {
    std::vector<ZipEntry> entries;
    REQUIRE(archive.size() >= 22);
    const std::size_t end = archive.size() - 22;
    REQUIRE(field(archive, end, 4) == 0x06054b50);
    std::size_t at = field(archive, end + 16, 4);
    CHECK(at + field(archive, end + 12, 4) == end);
    for (std::uint64_t i = 0; i < field(archive, end + 10, 2); ++i) {
        REQUIRE(field(archive, at, 4) == 0x02014b50);
        const std::size_t header = field(archive, at + 42, 4);
        REQUIRE(field(archive, header, 4) == 0x04034b50);
        CHECK(archive.substr(header + 4, 24) == archive.substr(at + 6, 24));
        CHECK(field(archive, header + 8, 2) == 0);
        const std::size_t name_bytes = field(archive, header + 26, 2);
        const std::size_t begin = header + 30 + name_bytes + field(archive, header + 28, 2);
        entries.push_back({archive.substr(header + 30, name_bytes),
                           archive.substr(begin, field(archive, header + 22, 4)), begin});
        at += 46 + name_bytes;
    }
    CHECK(at == end);
    return entries;
}

std::string exported_usdz(const Mesh& mesh, const ExportInfo& info) {
    std::string bytes;
    REQUIRE(export_mesh(mesh, {}, ExportFormat::Usdz, info, [&bytes](std::string_view piece) {
                bytes += piece;
                return true;
            }).ok());
    return bytes;
}

} // namespace

TEST_CASE("the checksum of an entry is CRC-32 for any division into pieces") {
    EntrySize whole; // the check value of the CRC-32 of ISO 3309
    whole.add("123456789");
    CHECK(whole.checksum == 0xCBF43926U);
    CHECK(whole.bytes == 9);
    EntrySize parts;
    for (const std::string_view piece : {"1234", "", "56789"}) {
        parts.add(piece);
    }
    CHECK(parts.checksum == whole.checksum);
    CHECK(EntrySize().checksum == 0);
}

TEST_CASE("entries with any name and size begin at multiples of 64 bytes") {
    // A header without padding has 30 bytes and the name, so these lengths give all remainders
    // modulo 64.
    for (std::size_t name_bytes = 1; name_bytes <= 65; ++name_bytes) {
        std::string archive;
        const ByteSink append = [&archive](std::string_view piece) {
            archive += piece;
            return true;
        };
        PieceWriter out(append);
        StoredZip zip(out);
        const std::vector<std::string> contents{std::string(name_bytes, 'x'), "", "PK\x05\x06"};
        for (std::size_t i = 0; i < contents.size(); ++i) {
            EntrySize size;
            size.add(contents[i]);
            zip.begin_entry(std::string(name_bytes, static_cast<char>('a' + i)), size);
            out.put(contents[i]);
        }
        zip.finish();
        REQUIRE(out.finish());
        const std::vector<ZipEntry> entries = entries_of(archive);
        REQUIRE(entries.size() == 3);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            CHECK(entries[i].name == std::string(name_bytes, static_cast<char>('a' + i)));
            CHECK(entries[i].bytes == contents[i]);
            CHECK(entries[i].place % 64 == 0);
        }
    }
}

TEST_CASE("an archive of 4 GiB is refused") {
    EntrySize size;
    size.bytes = 0xFFFF'0000U;
    CHECK(StoredZip::holds({size}, 10));
    size.bytes = 0xFFFF'FFC0U;
    CHECK_FALSE(StoredZip::holds({size}, 10));
    CHECK_FALSE(StoredZip::holds(std::vector<EntrySize>(65535), 0));
}

TEST_CASE("a USDZ holds the USDA and its pictures") {
    const Mesh mesh = test::plant_mesh();
    ExportInfo info{.grammar = "g.lsys",
                    .seed = 1,
                    .generations = 2,
                    .generator = "lsc",
                    .mtl_name = "",
                    .picture_prefix = ""};
    const std::vector<ZipEntry> entries = entries_of(exported_usdz(mesh, info));
    REQUIRE(entries.size() == 4);
    CHECK(entries[0].name == "plant.usda");
    CHECK(entries[1].name == "plant.bark.png");
    CHECK(entries[2].name == "plant.bark_normals.png");
    CHECK(entries[3].name == "plant.leaf.png");

    info.picture_prefix = "plant";
    std::string layer;
    REQUIRE(export_mesh(mesh, {}, ExportFormat::Usda, info, [&layer](std::string_view piece) {
                layer += piece;
                return true;
            }).ok());
    CHECK(entries[0].bytes == layer);
    const Outcome<std::vector<PictureFile>> pictures =
        make_picture_files(mesh, ExportFormat::Usda, info);
    REQUIRE(pictures.ok());
    for (std::size_t i = 0; i < pictures.value().size(); ++i) {
        CHECK(entries.at(i + 1).bytes == pictures.value()[i].bytes);
    }
    CHECK(make_picture_files(mesh, ExportFormat::Usdz, info).value().empty());
}
