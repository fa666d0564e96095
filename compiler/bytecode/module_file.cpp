// The layout of a .lsb file. Numbers are little-endian; f32 is the bits of an IEEE binary32.
//
//   offset  size
//        0     8  magic: 89 4C 53 42 0D 0A 1A 0A. Damaged by any transfer that changes line ends or
//                 drops the eighth bit.
//        8     4  version
//       12     4  0
//       16     8  size of the whole file
//       24     8  checksum() of all that follows
//       32        the contents, in order:
//                   settings, generations, files, symbols, folded, constants, globals, patterns,
//                   template codes, instructions, sites, site marks, template places, productions,
//                   counts, axiom
//
// Version 2 added the template places, version 3 stages of productions, version 4 the source of
// random numbers and words as one text.
//
// A table is its number of rows (u64) and the rows; a text is its number of bytes (u32) and the
// bytes; a truth is one byte, 0 or 1; an enumerator is one byte. A template code takes
// code_width(code_count) bytes. Whatever changes here raises kModuleFileVersion.
#include "compiler/bytecode/module_file.h"

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

// One description of the contents serves writing and reading: `contents()` below hands every field
// to a Writer or to a Reader, which have the same functions.

class Writer {
public:
    explicit Writer(std::string& out) : out_(out) {}

    template <std::unsigned_integral T>
    void number(const T& value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            out_.push_back(static_cast<char>((value >> (8 * i)) & 0xFF));
        }
    }
    void real(const float& value) { number(std::bit_cast<std::uint32_t>(value)); }
    void truth(const bool& value) { out_.push_back(value ? '\1' : '\0'); }
    template <typename Enum>
    void tag(const Enum& value, Enum /*last*/) {
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
    template <typename Row, typename Function>
    void table(const std::vector<Row>& rows, std::size_t /*least_bytes*/, Function row) {
        number(std::uint64_t{rows.size()});
        for (const Row& each : rows) {
            row(*this, each);
        }
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

/// Reads what a Writer wrote. After the first thing that does not fit it yields zeros and nothing
/// more, and failed() holds.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

    template <std::unsigned_integral T>
    void number(T& value) {
        value = static_cast<T>(take_number(sizeof(T)));
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
    void tag(Enum& value, Enum last) {
        const std::uint64_t byte = take_number(1);
        if (byte > static_cast<std::uint64_t>(last)) {
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
    /// A row takes at least `least_bytes`: no more rows are made than the bytes left can hold.
    template <typename Row, typename Function>
    void table(std::vector<Row>& rows, std::size_t least_bytes, Function row) {
        const std::uint64_t count = take_number(8);
        if (count > bytes_.size() / least_bytes) {
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

// `Stream` is Writer or Reader; `Value` is const for the one and not for the other.

template <typename Stream, typename Value>
void settings(Stream& stream, Value& s) {
    stream.tag(s.turtle, kLastTurtleProfile);
    stream.tag(s.rewriting, RewritingMode::Leftmost);
    stream.tag(s.choice, ChoiceScope::Generation);
    stream.tag(s.weights, WeightRule::Any);
    stream.tag(s.random, RandomSource::Glibc);
    stream.truth(s.print_letters);
    stream.truth(s.print_characters);
    stream.real(s.angle);
    stream.real(s.step);
    stream.real(s.width);
    stream.real(s.angle_scale);
    stream.real(s.step_scale);
    stream.real(s.width_scale);
    stream.number(s.sides);
    stream.truth(s.has_tropism);
    for (auto& component : s.tropism) {
        stream.real(component);
    }
    stream.truth(s.has_seed);
    stream.number(s.seed);
    stream.real(s.spring);
    stream.real(s.density);
    stream.real(s.damping);
    stream.tag(s.at_depth, AtDepth::Stop);
    stream.number(s.decompose_depth);
    stream.number(s.interpret_depth);
}

template <typename Stream, typename Value>
void table_range(Stream& stream, Value& range) {
    stream.number(range.first);
    stream.number(range.count);
}

template <typename Stream, typename Value>
void word_template(Stream& stream, Value& word) {
    table_range(stream, word.codes);
    stream.number(word.arguments);
    stream.number(word.parameter_count);
    stream.number(word.draw_count);
}

template <typename Stream, typename Value>
void symbol_row(Stream& stream, Value& symbol) {
    stream.text(symbol.name);
    stream.number(symbol.parameter_count);
    stream.tag(symbol.kind, SymbolKind::PolygonClose);
    stream.truth(symbol.ignored);
    stream.tag(symbol.turtle, static_cast<TurtleOperation>(kTurtleOperationCount - 1));
    stream.text(symbol.mesh_file);
}

template <typename Stream, typename Value>
void global_row(Stream& stream, Value& global) {
    stream.text(global.name);
    stream.number(global.instruction);
    stream.number(global.draw_position);
    stream.number(global.draw_count);
    stream.truth(global.has_bounds);
    stream.real(global.minimum);
    stream.real(global.maximum);
    stream.number(global.site);
}

template <typename Stream, typename Value>
void production_row(Stream& stream, Value& p) {
    stream.text(p.name);
    stream.number(p.name_site);
    stream.number(p.rule);
    stream.number(p.group);
    stream.tag(p.stage, Stage::Interpret);
    stream.truth(p.has_left);
    stream.truth(p.has_right);
    table_range(stream, p.left);
    table_range(stream, p.predecessor);
    table_range(stream, p.right);
    stream.number(p.formal_count);
    stream.number(p.condition);
    stream.truth(p.stochastic);
    stream.real(p.weight);
    word_template(stream, p.successor);
}

template <typename Stream, typename Generations>
void generations(Stream& stream, Generations& value) {
    bool has = value.has_value();
    std::uint32_t count = value.value_or(0);
    stream.truth(has);
    stream.number(count);
    if constexpr (std::same_as<Stream, Reader>) {
        if (has) {
            value = count;
        }
    }
}

template <typename Stream, typename Value>
void contents(Stream& stream, Value& bytecode) {
    settings(stream, bytecode.settings);
    generations(stream, bytecode.generations);
    stream.table(bytecode.files, 4, [](Stream& s, auto& path) { s.text(path); });
    stream.table(bytecode.symbols, 15, [](Stream& s, auto& row) { symbol_row(s, row); });
    stream.table(bytecode.folded, 8, [](Stream& s, auto& row) {
        s.id(row.symbol);
        s.number(row.first_constant);
    });
    stream.table(bytecode.constants, 4, [](Stream& s, auto& value) { s.real(value); });
    stream.table(bytecode.globals, 29, [](Stream& s, auto& row) { global_row(s, row); });
    stream.table(bytecode.patterns, 9, [](Stream& s, auto& row) {
        s.tag(row.kind, PatternKind::Close);
        s.id(row.symbol);
        s.number(row.first_formal);
    });
    stream.codes(bytecode.template_codes,
                 code_width(std::uint64_t{bytecode.symbols.size()} + bytecode.folded.size()));
    stream.table(bytecode.instructions, 4, [](Stream& s, auto& word) { s.number(word); });
    stream.table(bytecode.sites, 20, [](Stream& s, auto& row) {
        s.id(row.span.file);
        s.number(row.span.begin);
        s.number(row.span.end);
        s.number(row.line);
        s.number(row.column);
    });
    stream.table(bytecode.site_marks, 8, [](Stream& s, auto& row) {
        s.number(row.instruction);
        s.number(row.site);
    });
    stream.table(bytecode.template_places, 24, [](Stream& s, auto& run) {
        s.number(run.first);
        s.number(run.begin);
        s.number(run.length);
        s.number(run.stride);
        s.number(run.line);
        s.number(run.column);
    });
    stream.table(bytecode.productions, 76, [](Stream& s, auto& row) { production_row(s, row); });
    stream.number(bytecode.rule_count);
    stream.number(bytecode.group_count);
    word_template(stream, bytecode.axiom);
    stream.number(bytecode.axiom_site);
    stream.number(bytecode.axiom_draw_position);
    stream.truth(bytecode.uses_steps);
}

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
    contents(writer, bytecode);
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
    if (version != kModuleFileVersion) {
        return Error{fmt::format("compiled by {} version of lsc (format {}, this one reads {}): {}",
                                 version > kModuleFileVersion ? "a newer" : "an older", version,
                                 kModuleFileVersion, "compile the grammar again")};
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
    contents(reader, bytecode);
    if (reader.failed() || reader.left() != 0) {
        return Error{"the file is malformed: its tables do not fill it"};
    }
    if (const auto problem = verify(bytecode)) {
        return Error{"the file is malformed: " + *problem};
    }
    return bytecode;
}

} // namespace lsys
