// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "compiler/bytecode/verify.h"
#include "tests/compiler/small_bytecode.h"

#include <catch2/catch.hpp>

#include <random>

using namespace lsys;

namespace {

std::string refusal(std::string_view bytes) {
    const Result<Bytecode> result = read_module_file(bytes);
    return result ? "accepted" : result.error().message;
}

/// `bytes` with one byte changed and the checksum corrected, so that the other checks of the reader
/// must refuse the file.
std::string with_byte(std::string bytes, std::size_t offset, char value) {
    bytes[offset] = value;
    const std::uint64_t sum = checksum(std::string_view(bytes).substr(32));
    for (std::size_t i = 0; i < 8; ++i) {
        bytes[24 + i] = static_cast<char>((sum >> (8 * i)) & 0xFF);
    }
    return bytes;
}

} // namespace

TEST_CASE("a module file is read back as it was written") {
    const Bytecode bytecode = test::small_bytecode();
    REQUIRE(verify(bytecode) == std::nullopt);
    const std::string bytes = write_module_file(bytecode);
    CHECK(is_module_file(bytes));
    const Result<Bytecode> read = read_module_file(bytes);
    REQUIRE(read.ok());
    CHECK(digest(read.value()) == digest(bytecode));
    CHECK(write_module_file(read.value()) == bytes);
    CHECK(read.value().symbols[2].name == "f");
    CHECK(read.value().symbols[2].turtle == TurtleOperation::Move);
    CHECK(read.value().generations == 6U);
    CHECK(read.value().sites[3].column == 20);
    CHECK(read.value().template_places[1].stride == 2);
}

TEST_CASE("contours are read back as they were written") {
    Bytecode bytecode = test::small_bytecode();
    bytecode.contours = {{"ring", {{0.5F, 0.0F}, {0.0F, 0.25F}}}};
    const Result<Bytecode> read = read_module_file(write_module_file(bytecode));
    REQUIRE(read.ok());
    REQUIRE(read.value().contours.size() == 1);
    CHECK(read.value().contours[0].name == "ring");
    CHECK(read.value().contours[0].points == bytecode.contours[0].points);
    CHECK(digest(read.value()) == digest(test::small_bytecode())); // words do not depend on them
}

TEST_CASE("the bytes of a module file change only with its version") {
    // If this number changes, the format of the file has changed: increase kModuleFileVersion.
    REQUIRE(kModuleFileVersion == 15);
    CHECK(checksum(write_module_file(test::small_bytecode())) == 0x2B494211035B1CA1);
}

TEST_CASE("every truncation of a module file is refused") {
    const std::string bytes = write_module_file(test::small_bytecode());
    CHECK(refusal("") == "the file is empty");
    for (std::size_t size = 1; size < bytes.size(); ++size) {
        CAPTURE(size);
        const std::string message = refusal(std::string_view(bytes).substr(0, size));
        CHECK(message.starts_with("the file is cut off"));
    }
}

TEST_CASE("every change of one byte of a module file is refused") {
    const std::string bytes = write_module_file(test::small_bytecode());
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (const int change : {0x01, 0x20, 0x80, 0xFF}) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ change);
            CAPTURE(at, change);
            CHECK(refusal(damaged) != "accepted");
        }
    }
}

TEST_CASE("foreign, older, newer and longer files have different errors") {
    const std::string bytes = write_module_file(test::small_bytecode());
    CHECK(refusal("#w : A;\n") == "not a compiled grammar (.lsb)");
    std::string newer = bytes;
    newer[8] = static_cast<char>(kModuleFileVersion + 1);
    CHECK(refusal(newer) == "made by a newer lsc (format 16, this one reads 15)");
    std::string older = bytes;
    older[8] = 5;
    CHECK(refusal(older) ==
          "made by an older lsc (format 5, this one reads 15): compile the grammar again");
    CHECK(refusal(bytes + "x") == "the file is damaged: 1 bytes follow its end");
    std::string damaged = bytes;
    damaged.back() = static_cast<char>(damaged.back() ^ 1);
    CHECK(refusal(damaged) == "the file is damaged: its checksum does not fit");
}

TEST_CASE("contents with a correct checksum are still checked") {
    const std::string bytes = write_module_file(test::small_bytecode());
    std::uint32_t refused = 0;
    for (std::size_t at = 32; at < bytes.size(); ++at) {
        for (const char value : {'\0', '\1', '\x7F', '\xFF'}) {
            const Result<Bytecode> read = read_module_file(with_byte(bytes, at, value));
            if (read) {
                CHECK(verify(read.value()) == std::nullopt);
            } else {
                ++refused;
                CHECK(read.error().message.starts_with("the file is malformed: "));
            }
        }
    }
    CHECK(refused > bytes.size());
}

TEST_CASE("random bytes after a valid header are refused without a crash") {
    std::mt19937 random(7);
    for (int round = 0; round < 2'000; ++round) {
        std::string bytes = write_module_file(test::small_bytecode());
        const std::size_t changes = 1 + random() % 20;
        for (std::size_t i = 0; i < changes; ++i) {
            bytes[32 + random() % (bytes.size() - 32)] = static_cast<char>(random() & 0xFF);
        }
        const std::string fitting = with_byte(bytes, 32, bytes[32]);
        if (const Result<Bytecode> read = read_module_file(fitting)) {
            CHECK(verify(read.value()) == std::nullopt);
        }
    }
    for (int round = 0; round < 2'000; ++round) {
        std::string bytes(random() % 200, '\0');
        for (char& byte : bytes) {
            byte = static_cast<char>(random() & 0xFF);
        }
        CHECK(refusal(bytes) != "accepted");
    }
}

TEST_CASE("tropisms, the unit of widths and the first colour are read back and checked") {
    Bytecode bytecode = test::small_bytecode();
    Settings& settings = bytecode.settings;
    settings.tropisms[0] = {TropismKind::Before, {0.0F, 1.0F, 0.0F}, 0.2F, 0.1F, 90.0F};
    settings.tropisms[1] = {TropismKind::Twist, {1.0F, 0.0F, 0.0F}, 0.3F, 0.0F, 0.0F};
    settings.width_unit = WidthUnit::Pixels;
    settings.width_increment = 0.5F;
    settings.colour = 128;
    settings.colour_increment = 255;
    settings.scale = 2.0F;
    CHECK(digest(bytecode) == digest(test::small_bytecode())); // saved words stay valid
    const Result<Bytecode> read = read_module_file(write_module_file(bytecode));
    REQUIRE(read.ok());
    CHECK(read.value().settings.tropisms == settings.tropisms);
    CHECK(read.value().settings.width_unit == WidthUnit::Pixels);
    CHECK(read.value().settings.width_increment == 0.5F);
    CHECK(read.value().settings.colour == 128);
    CHECK(read.value().settings.colour_increment == 255);
    CHECK(read.value().settings.scale == 2.0F);
    CHECK(read.value().settings.word_shape == WordShape::Line);
    settings.word_shape = WordShape::Ring;
    CHECK(digest(bytecode) != digest(test::small_bytecode()));
    CHECK(verify(bytecode) == std::nullopt);
    settings.tropisms[3] = settings.tropisms[1];
    CHECK(verify(bytecode) == "a tropism behind the last one");
    settings.tropisms[3] = {};
    settings.colour = 65536;
    CHECK(verify(bytecode) == "the first colour 65536");
}

TEST_CASE("sizes of a plant are read back and checked") {
    Bytecode bytecode = test::small_bytecode();
    bytecode.settings.height = 20.5F;
    bytecode.settings.pipe = {2.5F, 0.01F, 0.5F};
    bytecode.settings.flare = {1.8F, 1.2F, 5};
    bytecode.settings.collar = 1.5F;
    bytecode.settings.tips = TipShape::Broken;
    const std::uint64_t word_digest = digest(test::small_bytecode());
    CHECK(digest(bytecode) == word_digest); // saved words stay valid
    const Result<Bytecode> read = read_module_file(write_module_file(bytecode));
    REQUIRE(read.ok());
    CHECK(read.value().settings.height == 20.5F);
    CHECK(read.value().settings.pipe == Pipe{2.5F, 0.01F, 0.5F});
    CHECK(read.value().settings.flare == Flare{1.8F, 1.2F, 5});
    CHECK(read.value().settings.collar == 1.5F);
    CHECK(read.value().settings.tips == TipShape::Broken);
    bytecode.settings.height = -1.0F;
    CHECK(verify(bytecode) == "a plant -1 m high");
    bytecode.settings.height = 1.0F;
    bytecode.settings.pipe = {5.0F, 0.01F};
    CHECK(verify(bytecode) == "a pipe model of exponent 5 and width 0.01");
    bytecode.settings.pipe = {2.0F, 0.01F, 1.5F};
    CHECK(verify(bytecode) == "a pipe model of taper 1.5");
    bytecode.settings.pipe.taper = 1.0F;
    CHECK(verify(bytecode) == std::nullopt);
    for (const Flare& flare : {Flare{0.9F, 1.0F, 0}, Flare{11.0F, 1.0F, 0}, Flare{2.0F, 0.0F, 0},
                               Flare{2.0F, 1.0F, 2}, Flare{2.0F, 1.0F, 10}}) {
        bytecode.settings.flare = flare;
        CHECK(verify(bytecode).has_value());
    }
    bytecode.settings.flare = {2.0F, 1.0F, 3};
    bytecode.settings.collar = -1.0F;
    CHECK(verify(bytecode) == "a collar of factor -1");
    bytecode.settings.collar = 0.0F;
    bytecode.settings.pipe = {0.0F, 0.01F};
    CHECK(verify(bytecode).has_value());
}
