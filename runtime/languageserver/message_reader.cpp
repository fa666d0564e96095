// SPDX-License-Identifier: MIT
#include "runtime/languageserver/message_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kHeaderEnd = "\r\n\r\n";
constexpr std::size_t kMaxHeaderEnd = 64; // bytes of a `Content-Length` with the end of the header

bool equal_ignoring_case(std::string_view text, std::string_view lower) {
    return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
}

/// The value of `Content-Length` in a header; nullopt if it is missing or no number.
std::optional<std::size_t> content_length(std::string_view header) {
    std::optional<std::size_t> length;
    while (!header.empty()) {
        const std::size_t end = std::min(header.find("\r\n"), header.size());
        const std::string_view line = header.substr(0, end);
        header.remove_prefix(std::min(end + 2, header.size()));
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) {
            return std::nullopt;
        }
        if (!equal_ignoring_case(line.substr(0, colon), "content-length")) {
            continue;
        }
        std::string_view digits = line.substr(colon + 1);
        digits.remove_prefix(std::min(digits.find_first_not_of(" \t"), digits.size()));
        std::size_t value = 0;
        const auto [stop, failure] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (failure != std::errc() || stop != digits.data() + digits.size() || length) {
            return std::nullopt;
        }
        length = value;
    }
    return length;
}

/// The offset of a header that does not begin a line, because a message that was cut stands before
/// it; npos if there is none.
std::size_t header_after_cut(std::string_view bytes) {
    const std::size_t found = bytes.rfind("Content-Length:");
    const bool is_within = found != std::string_view::npos && found > 0 && bytes[found - 1] != '\n';
    return is_within && content_length(bytes.substr(found)) ? found : std::string_view::npos;
}

} // namespace

void MessageReader::add(std::string_view bytes) {
    if (skipped_ > 0) {
        const auto count = std::min(skipped_, bytes.size());
        skipped_ -= count;
        bytes.remove_prefix(count);
    }
    buffer_.erase(0, begin_);
    begin_ = 0;
    buffer_ += bytes;
}

bool MessageReader::is_between_messages() const {
    return begin_ == buffer_.size() && !expected_ && skipped_ == 0 && !in_long_header_;
}

std::optional<ReadMessage> MessageReader::read_header() {
    const std::string_view rest = std::string_view(buffer_).substr(begin_);
    const std::size_t end = rest.find(kHeaderEnd);
    if (end == std::string_view::npos) {
        if (rest.size() > kMaxHeaderBytes) {
            // Keep the last bytes, with which the end of the header, or another header, may begin.
            begin_ = buffer_.size() - kMaxHeaderEnd;
            if (!in_long_header_) {
                in_long_header_ = true;
                return ReadMessage{{}, "the header of a message is too long"};
            }
        }
        return std::nullopt;
    }
    const std::string_view header = rest.substr(0, end);
    const bool was_reported = std::exchange(in_long_header_, false);
    const bool is_long = was_reported || header.size() > kMaxHeaderBytes;
    const std::optional<std::size_t> length = is_long ? std::nullopt : content_length(header);
    if (!length) {
        const std::size_t next_header = header_after_cut(header);
        begin_ += next_header != std::string_view::npos ? next_header : end + kHeaderEnd.size();
        return was_reported ? next()
               : is_long    ? ReadMessage{{}, "the header of a message is too long"}
                         : ReadMessage{{}, "the header of a message has no valid Content-Length"};
    }
    begin_ += end + kHeaderEnd.size();
    if (*length > kMaxMessageBytes) {
        const std::size_t received = std::min(*length, buffer_.size() - begin_);
        begin_ += received;
        skipped_ = *length - received;
        return ReadMessage{{}, "a message is longer than 64 MiB"};
    }
    expected_ = length;
    return next();
}

std::optional<ReadMessage> MessageReader::next() {
    if (!expected_) {
        return read_header();
    }
    const std::size_t length = *expected_;
    if (buffer_.size() - begin_ < length) {
        return std::nullopt;
    }
    ReadMessage message{buffer_.substr(begin_, length), {}};
    begin_ += length;
    expected_.reset();
    return message;
}

std::string framed(std::string_view body) {
    std::string bytes = "Content-Length: " + std::to_string(body.size());
    bytes += kHeaderEnd;
    bytes += body;
    return bytes;
}

} // namespace lsys
