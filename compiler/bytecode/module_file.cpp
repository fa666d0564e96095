// SPDX-License-Identifier: MIT
// The layout of a .lsb file. Numbers are little-endian; f32 is the bits of an IEEE binary32.
//
//   offset  size
//        0     8  magic: 89 4C 53 42 0D 0A 1A 0A. The bytes show whether a transfer changed line
//                 ends or cleared the eighth bit of bytes.
//        8     4  version
//       12     4  0
//       16     8  size of the whole file
//       24     8  checksum() of the contents
//       32        the contents, in the order of describe() in bytecode_contents.h
//
// A table is its number of rows (u64) and the rows; a text is its number of bytes (u32) and the
// bytes; a truth is one byte, 0 or 1; an enumerator is one byte; an optional number is a truth and
// a number. A template code takes code_width(code_count) bytes.

#include "compiler/bytecode/module_file.h"

#include "compiler/bytecode/impl/bytecode_contents.h"
#include "compiler/bytecode/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <concepts>
#include <limits>

namespace lsys {

namespace {

constexpr std::string_view kMagic = "\x89LSB\r\n\x1A\n";
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kSizeAt = 16;
constexpr std::size_t kChecksumAt = 24;
constexpr std::size_t kContentsAt = 32;

class Writer {
public:
    explicit Writer(std::string& out) : out_(out) {}

    Writer& outside_digest() { return *this; }
    void implied(bool /*value*/) {}
    template <std::unsigned_integral T>
    void number(const T& value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            out_.push_back(static_cast<char>((value >> (8 * i)) & 0xFF));
        }
    }
    template <typename Value>
    void number_or_none(const Value& value) {
        number(static_cast<std::uint32_t>(value));
    }
    void real(const float& value) { number(std::bit_cast<std::uint32_t>(value)); }
    void truth(const bool& value) { out_.push_back(value ? '\1' : '\0'); }
    template <typename Enum>
    void tag(const Enum& value) {
        static_assert(kCountOf<Enum> <= 256, "an enumerator is one byte");
        out_.push_back(static_cast<char>(value));
    }
    template <typename Id>
    void id(const Id& value) {
        number(static_cast<std::uint32_t>(value));
    }
    void text(const std::string& value) {
        number(static_cast<std::uint32_t>(value.size()));
        out_.append(value);
    }
    void optional_number(const std::optional<std::uint32_t>& value) {
        truth(value.has_value());
        number(value.value_or(0));
    }
    template <typename Row, typename Function>
    void table(const std::vector<Row>& rows, Function row) {
        number(std::uint64_t{rows.size()});
        for (const Row& each : rows) {
            row(*this, each);
        }
    }
    template <typename Row, typename Function>
    void table_or_none(const std::vector<Row>& rows, Function row) {
        table(rows, row);
    }
    void codes(const std::vector<Code>& codes, std::uint32_t width) {
        number(std::uint64_t{codes.size()});
        for (const Code code : codes) {
            for (std::uint32_t i = 0; i < width; ++i) {
                out_.push_back(static_cast<char>((code >> (8 * i)) & 0xFF));
            }
        }
    }

private:
    std::string& out_;
};

/// Reads the output of a Writer. After the first missing or invalid value failed() holds, and all
/// further numbers are zero.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    Reader& outside_digest() { return *this; }
    void implied(bool /*value*/) {}
    [[nodiscard]] bool failed() const { return failed_; }
    /// Number of bytes not read yet.
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

    template <std::unsigned_integral T>
    void number(T& value) {
        value = static_cast<T>(take_number(sizeof(T)));
    }
    template <typename Value>
    void number_or_none(Value& value) {
        std::uint32_t read = kNone;
        number(read);
        value = static_cast<Value>(read);
    }
    void real(float& value) {
        value = std::bit_cast<float>(static_cast<std::uint32_t>(take_number(4)));
    }
    void truth(bool& value) {
        const std::uint64_t byte = take_number(1);
        value = byte == 1;
        failed_ = failed_ || byte > 1;
    }
    template <typename Enum>
    void tag(Enum& value) {
        const std::uint64_t byte = take_number(1);
        if (byte >= kCountOf<Enum>) {
            failed_ = true;
            return;
        }
        value = static_cast<Enum>(byte);
    }
    template <typename Id>
    void id(Id& value) {
        value = static_cast<Id>(static_cast<std::uint32_t>(take_number(4)));
    }
    void text(std::string& value) {
        const std::uint64_t size = take_number(4);
        if (size > bytes_.size()) {
            failed_ = true;
            return;
        }
        value.assign(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
    }
    void optional_number(std::optional<std::uint32_t>& value) {
        bool has = false;
        std::uint32_t stored = 0;
        truth(has);
        number(stored);
        value = has ? std::optional(stored) : std::nullopt;
    }
    /// Same as table(): only the digest treats an empty table specially.
    template <typename Row, typename Function>
    void table_or_none(std::vector<Row>& rows, Function row) {
        table(rows, row);
    }
    /// Fails for more rows than the remaining bytes can hold, before any row is made.
    template <typename Row, typename Function>
    void table(std::vector<Row>& rows, Function row) {
        std::string smallest; // bytes of a row with empty texts, the min size of a row
        Writer writer(smallest);
        const Row empty{};
        row(writer, empty);
        const std::uint64_t count = take_number(8);
        if (count > bytes_.size() / smallest.size()) {
            failed_ = true;
            return;
        }
        rows.resize(count);
        for (Row& each : rows) {
            row(*this, each);
            if (failed_) {
                return;
            }
        }
    }
    void codes(std::vector<Code>& codes, std::uint32_t width) {
        const std::uint64_t count = take_number(8);
        if (count > bytes_.size() / width) {
            failed_ = true;
            return;
        }
        codes.resize(count);
        for (Code& code : codes) {
            code = static_cast<Code>(take_number(width));
        }
    }

private:
    std::uint64_t take_number(std::size_t size) {
        if (failed_ || size > bytes_.size()) {
            failed_ = true;
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            value |= std::uint64_t{static_cast<unsigned char>(bytes_[i])} << (8 * i);
        }
        bytes_.remove_prefix(size);
        return value;
    }

    std::string_view bytes_;
    bool failed_ = false;
};

template <std::unsigned_integral T>
T number_at(std::string_view bytes, std::size_t offset) {
    T value = 0;
    Reader(bytes.substr(offset)).number(value);
    return value;
}

void overwrite(std::string& bytes, std::size_t offset, std::uint64_t value) {
    std::string number;
    Writer(number).number(value);
    bytes.replace(offset, number.size(), number);
}

} // namespace

std::string write_module_file(const Bytecode& bytecode) {
    std::string bytes(kContentsAt, '\0');
    Writer writer(bytes);
    describe(writer, bytecode);
    seal_module_file(bytes);
    return bytes;
}

void seal_module_file(std::string& bytes) {
    bytes.resize(std::max(bytes.size(), kContentsAt));
    bytes.replace(0, kMagic.size(), kMagic);
    overwrite(bytes, kVersionAt, std::uint64_t{kModuleFileVersion});
    overwrite(bytes, kSizeAt, bytes.size());
    overwrite(bytes, kChecksumAt, checksum(std::string_view(bytes).substr(kContentsAt)));
}

bool is_module_file(std::string_view bytes) {
    return bytes.starts_with(kMagic);
}

Result<Bytecode> read_module_file(std::string_view bytes) {
    if (bytes.empty()) {
        return Error{"the file is empty"};
    }
    if (!is_module_file(bytes)) {
        if (bytes.size() < kMagic.size() && kMagic.starts_with(bytes)) {
            return Error{"the file is cut off within its first bytes"};
        }
        return Error{"not a compiled grammar (.lsb)"};
    }
    if (bytes.size() < kContentsAt) {
        return Error{"the file is cut off within its first bytes"};
    }
    const auto version = number_at<std::uint32_t>(bytes, kVersionAt);
    if (version > kModuleFileVersion) {
        return Error{fmt::format("made by a newer lsc (format {}, this one reads {})", version,
                                 kModuleFileVersion)};
    }
    if (version < kModuleFileVersion) {
        return Error{fmt::format("made by an older lsc (format {}, this one reads {}): compile the "
                                 "grammar again",
                                 version, kModuleFileVersion)};
    }
    const auto size = number_at<std::uint64_t>(bytes, kSizeAt);
    if (size > bytes.size()) {
        return Error{fmt::format("the file is cut off: {} of {} bytes", bytes.size(), size)};
    }
    if (size < bytes.size()) {
        return Error{
            fmt::format("the file is damaged: {} bytes follow its end", bytes.size() - size)};
    }
    if (number_at<std::uint32_t>(bytes, kVersionAt + 4) != 0 ||
        number_at<std::uint64_t>(bytes, kChecksumAt) != checksum(bytes.substr(kContentsAt))) {
        return Error{"the file is damaged: its checksum does not fit"};
    }
    Bytecode bytecode;
    Reader reader(bytes.substr(kContentsAt));
    describe(reader, bytecode);
    if (reader.failed() || reader.left() != 0) {
        return Error{"the file is malformed: its tables do not fill it"};
    }
    if (const auto problem = verify(bytecode)) {
        return Error{"the file is malformed: " + *problem};
    }
    for (BytecodeCurve& curve : bytecode.curves) {
        set_slopes(curve.points);
    }
    return bytecode;
}

} // namespace lsys
