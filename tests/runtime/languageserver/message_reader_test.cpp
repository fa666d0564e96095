// SPDX-License-Identifier: MIT
#include "runtime/languageserver/message_reader.h"

#include <catch2/catch.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace {

using lsys::framed;
using lsys::MessageReader;
using lsys::ReadMessage;

/// All messages of bytes that arrive in pieces of `size`; errors as `! reason`.
std::vector<std::string> read_all(std::string_view bytes, std::size_t size) {
    MessageReader reader;
    std::vector<std::string> all;
    for (std::size_t at = 0; at < bytes.size(); at += size) {
        reader.add(bytes.substr(at, size));
        while (const std::optional<ReadMessage> message = reader.next()) {
            all.push_back(message->error.empty() ? message->body : "! " + message->error);
        }
    }
    return all;
}

} // namespace

TEST_CASE("messages are read from pieces of any size") {
    const std::string bytes = framed("{\"a\":1}") + framed("") + framed("\xC3\xA4\r\n\r\n") +
                              "content-length:2\r\nContent-Type: x; charset=utf-8\r\n\r\n{}";
    const std::vector<std::string> wanted{"{\"a\":1}", "", "\xC3\xA4\r\n\r\n", "{}"};
    for (std::size_t size = 1; size < 40; ++size) {
        CHECK(read_all(bytes, size) == wanted);
    }
    CHECK(read_all(bytes, bytes.size()) == wanted);
}

TEST_CASE("a header without a valid length is an error, and reading goes on") {
    for (const char* header :
         {"Content-Length: x\r\n\r\n", "Content-Length: -3\r\n\r\n", "Content-Length:\r\n\r\n",
          "Content-Type: x\r\n\r\n", "nothing\r\n\r\n", "Content-Length: 2 2\r\n\r\n",
          "Content-Length: 2\r\nContent-Length: 3\r\n\r\n",
          "Content-Length: 99999999999999999999999999\r\n\r\n"}) {
        CAPTURE(header);
        const std::vector<std::string> all = read_all(header + framed("{}"), 7);
        REQUIRE(all.size() == 2);
        CHECK(all[0] == "! the header of a message has no valid Content-Length");
        CHECK(all[1] == "{}");
    }
}

TEST_CASE("headers and messages that are too long are skipped") {
    const std::string long_header = "X: " + std::string(100'000, 'a') + "\r\n\r\n" + framed("{}");
    for (const std::size_t size : {1UL, 1000UL, 5000UL, 1'000'000UL}) {
        CHECK(read_all(long_header, size) ==
              std::vector<std::string>{"! the header of a message is too long", "{}"});
    }
    const std::string body(MessageReader::kMaxMessageBytes + 1, ' ');
    CHECK(read_all(framed(body) + framed("{}"), 1 << 20) ==
          std::vector<std::string>{"! a message is longer than 64 MiB", "{}"});
}

TEST_CASE("after a cut message reading goes on with the next one but one") {
    const std::string cut = framed("{\"method\":\"cut\"}");
    const std::string swallowed = framed("{\"padding\":\"" + std::string(5000, ' ') + "\"}");
    for (std::size_t size = 1; size < cut.size(); ++size) {
        for (const std::size_t piece : {1UL, 7UL, 10'000UL}) {
            CAPTURE(size, piece);
            const std::vector<std::string> all =
                read_all(cut.substr(0, size) + swallowed + framed("{}"), piece);
            REQUIRE(all.size() >= 2);
            CHECK(all.back() == "{}");
        }
    }
}

TEST_CASE("a cut message is not between messages") {
    const std::string bytes = framed("{}");
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        MessageReader reader;
        reader.add(std::string_view(bytes).substr(0, size));
        const bool is_read = reader.next().has_value();
        CHECK(is_read == (size == bytes.size()));
        CHECK(reader.is_between_messages() == (size == 0 || size == bytes.size()));
    }
}
