// SPDX-License-Identifier: MIT
// JsonWriter: writes a JSON document (RFC 8259) as a stream, without white space. It adds commas
// and closing brackets, and stores only the open brackets. Used by the writers of glTF and by the
// statistics of forests.
//
//     JsonWriter json(out);
//     json.object().member("name", "oak").array("sizes").value(1).value(2.5).end().end();
//
// writes {"name":"oak","sizes":[1,2.5]}.
#pragma once

#include "runtime/export/impl/piece_writer.h"
#include "runtime/export/impl/text.h"

#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

class JsonWriter {
public:
    /// `out` must outlive the writer.
    explicit JsonWriter(PieceWriter& out) : out_(out) {}

    /// Begins an object or an array; end() closes the innermost one.
    JsonWriter& object() { return begin('{', '}'); }
    JsonWriter& array() { return begin('[', ']'); }
    JsonWriter& object(std::string_view key) { return name(key).object(); }
    JsonWriter& array(std::string_view key) { return name(key).array(); }
    JsonWriter& end();

    /// The key of the next value: plain letters, not escaped.
    JsonWriter& name(std::string_view key);
    /// A string, escaped; bytes that are not UTF-8 become U+FFFD.
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
    JsonWriter& value(bool value) { return literal(value ? "true" : "false"); }
    /// The shortest digits that read back as the same number.
    template <std::floating_point T>
    JsonWriter& value(T number) {
        return put(number);
    }
    /// Decimal digits; in quotes from 2^53 on, because some readers of JSON round larger numbers.
    template <std::integral T>
    JsonWriter& value(T number) {
        constexpr std::uint64_t kFirstUnsafe = std::uint64_t{1} << 53U;
        return std::cmp_less(number, kFirstUnsafe) ? put(number) : value(std::to_string(number));
    }
    /// Raw JSON, unchanged.
    JsonWriter& literal(std::string_view json);
    /// A string whose characters `write` writes to the PieceWriter, unescaped.
    template <typename Write>
    JsonWriter& text(const Write& write) {
        literal("\"");
        write();
        out_.put("\"");
        return *this;
    }

    template <typename T>
    JsonWriter& member(std::string_view key, const T& what) {
        return name(key).value(what);
    }
    template <typename T>
    JsonWriter& member(std::string_view key, std::initializer_list<T> items) {
        array(key);
        for (const T& item : items) {
            value(item);
        }
        return end();
    }

private:
    JsonWriter& begin(char open, char close);
    template <typename T>
    JsonWriter& put(T number) {
        char* const at = begin_value(kNumberBytes + 1);
        out_.advance_to(fmt::format_to(at, FMT_COMPILE("{}"), number));
        return *this;
    }
    /// Room for `bytes - 1` bytes of a value, after a comma if the value needs one.
    [[nodiscard]] char* begin_value(std::size_t bytes) {
        char* at = out_.room(bytes);
        if (comma_) {
            *at++ = ',';
        }
        comma_ = true;
        return at;
    }

    PieceWriter& out_;
    std::string closing_; // closing brackets of open values, the innermost last
    bool comma_ = false;  // whether the next value needs a comma before it
};

/// The document that `write` creates.
[[nodiscard]] std::string json_document(const std::function<void(JsonWriter&)>& write);

} // namespace lsys
