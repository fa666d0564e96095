// SPDX-License-Identifier: MIT
// The JSON writer: brackets, commas, numbers, strings.
#include "runtime/export/impl/json_writer.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <limits>
#include <string>

using namespace lsys;

TEST_CASE("JSON has commas between values and none elsewhere") {
    CHECK(json_document([](JsonWriter& json) { json.object().end(); }) == "{}");
    CHECK(json_document([](JsonWriter& json) { json.array().end(); }) == "[]");
    CHECK(json_document([](JsonWriter& json) {
              json.object().member("a", 1).array("b").value(1).value(2).end();
              json.object("c").end().member("d", true).end();
          }) == R"({"a":1,"b":[1,2],"c":{},"d":true})");
    CHECK(json_document([](JsonWriter& json) {
              json.array().array().end().object().end().array().value(1).end().value(2).end();
          }) == "[[],{},[1],2]");
    CHECK(json_document([](JsonWriter& json) {
              json.object().member("list", {1.5F, 2.0F}).member("one", {"x"}).end();
          }) == R"({"list":[1.5,2],"one":["x"]})");
}

TEST_CASE("the nesting of JSON is limited only by memory") {
    constexpr int kDepth = 100'000;
    const std::string text = json_document([](JsonWriter& json) {
        for (int i = 0; i < kDepth; ++i) {
            json.array();
        }
        for (int i = 0; i < kDepth; ++i) {
            json.end();
        }
    });
    CHECK(text == std::string(kDepth, '[') + std::string(kDepth, ']'));
}

TEST_CASE("strings of JSON are escaped") {
    CHECK(json_document([](JsonWriter& json) { json.value("a\"b\\c\n\x01 \xC3\xA4 \xFF"); }) ==
          "\"a\\\"b\\\\c\\u000a\\u0001 \xC3\xA4 \xEF\xBF\xBD\"");
    CHECK(json_document([](JsonWriter& json) { json.value(std::string()); }) == R"("")");
    const std::string large(1'000'000, 'x');
    CHECK(json_document([&](JsonWriter& json) { json.value(large); }) == '"' + large + '"');
}

TEST_CASE("numbers of JSON have the shortest text that reads back") {
    const auto number = [](auto value) {
        return json_document([value](JsonWriter& json) { json.value(value); });
    };
    CHECK(number(0) == "0");
    CHECK(number(-7) == "-7");
    CHECK(number(0.1F) == "0.1");
    CHECK(number(static_cast<double>(0.1F)) == "0.10000000149011612");
    CHECK(number(-0.0F) == "-0");
    CHECK(number(3.0) == "3");
    CHECK(number(std::numeric_limits<double>::lowest()) == "-1.7976931348623157e+308");
    CHECK(number(std::numeric_limits<float>::denorm_min()) == "1e-45");
    // Many readers store numbers as doubles, so larger ones are written as strings.
    CHECK(number((std::uint64_t{1} << 53U) - 1) == "9007199254740991");
    CHECK(number(std::uint64_t{1} << 53U) == R"("9007199254740992")");
    CHECK(number(~std::uint64_t{0}) == R"("18446744073709551615")");
}

TEST_CASE("a string of JSON can be written in pieces") {
    std::string text;
    const ByteSink sink = [&text](std::string_view piece) {
        text += piece;
        return true;
    };
    PieceWriter out(sink);
    JsonWriter json(out);
    json.object().name("data").text([&out] {
        for (int i = 0; i < 3; ++i) {
            out.put("abc");
        }
    });
    json.name("rate").literal("0.2500").end();
    REQUIRE(out.finish());
    CHECK(text == R"({"data":"abcabcabc","rate":0.2500})");
}

TEST_CASE("members of an object can be copied from another document") {
    const std::string members = json_document([](JsonWriter& json) { json.member("a", 1); });
    CHECK(members == R"("a":1)");
    CHECK(json_document([&](JsonWriter& json) {
              json.object().literal(members).member("b", 2).end();
          }) == R"({"a":1,"b":2})");
}
