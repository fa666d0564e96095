// SPDX-License-Identifier: MIT
// Layout, little-endian, without gaps:
//   0  magic "lsystate"
//   8  version            u32    12  bytecode version    u32
//  16  program digest     u64    24  seed                u64
//  32  generations        u32    36  age                 u32
//  40  modules            u64    48  parameters          u64
//  56  code width         u64    64  bytes of senses     u64
//  72  codes, of the code width each
//      parameters, binary32
//      senses: the state of the environments
//      checksum           u64, over the checksums of header, codes, parameters and senses
#include "runtime/derive/state_file.h"

#include "compiler/bytecode/module_file.h"
#include "grammar/base/contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

namespace lsys {

namespace {

static_assert(std::endian::native == std::endian::little,
              "words are written as they are in memory");

constexpr std::string_view kMagic = "lsystate";
constexpr std::size_t kHeaderBytes = 72;
constexpr std::size_t kChecksumBytes = 8;

template <typename T>
void put(char*& at, T value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
}

template <typename T>
T get(const char*& at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return value;
}

template <typename T>
std::string_view bytes_of(std::span<const T> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// The parts of a file that its checksum covers.
struct Parts {
    std::string_view header;
    std::string_view codes;
    std::string_view parameters;
    std::string_view senses;
};

std::uint64_t checksum_of(const Parts& parts) {
    const std::array<std::uint64_t, 4> sums{checksum(parts.header), checksum(parts.codes),
                                            checksum(parts.parameters), checksum(parts.senses)};
    return checksum(bytes_of(std::span<const std::uint64_t>(sums)));
}

/// Whether every code exists, the parameters are as many as the codes store, and all are finite.
bool fits(const Bytecode& bytecode, const Word& word) {
    const std::optional<std::uint64_t> stored =
        word.visit([&](auto codes) -> std::optional<std::uint64_t> {
            std::uint64_t sum = 0;
            for (const auto code : codes) {
                if (code >= bytecode.code_count()) {
                    return std::nullopt;
                }
                sum += bytecode.stored_parameters(code);
            }
            return sum;
        });
    return stored == word.parameter_count() &&
           std::all_of(word.parameters().begin(), word.parameters().end(),
                       [](float value) { return std::isfinite(value); });
}

/// `what`: the noun for the version; `own`: the version of this program.
Error other_version(std::string_view what, std::uint32_t version, std::uint32_t own) {
    const bool newer = version > own;
    return {fmt::format(
        "the saved state was made by {} lsc ({} is version {}, this one reads {}){}",
        newer ? "a newer" : "an older", what, version, own, newer ? "" : ": derive it again")};
}

} // namespace

bool is_state_file(std::string_view bytes) {
    return bytes.substr(0, kMagic.size()) == kMagic;
}

bool write_state(const StateHeader& header,
                 const Word& word,
                 std::string_view sense_state,
                 const std::function<bool(std::string_view)>& flush) {
    std::array<char, kHeaderBytes> head{};
    char* at = head.data();
    std::memcpy(at, kMagic.data(), kMagic.size());
    at += kMagic.size();
    put(at, kStateFileVersion);
    put(at, kModuleFileVersion);
    put(at, header.program_digest);
    put(at, header.seed);
    put(at, header.generations);
    put(at, header.age);
    put(at, word.module_count());
    put(at, word.parameter_count());
    put(at, std::uint64_t{word.code_width()});
    put(at, std::uint64_t{sense_state.size()});
    const Parts parts{{head.data(), head.size()},
                      bytes_of(word.code_bytes()),
                      bytes_of(word.parameters()),
                      sense_state};
    std::array<char, kChecksumBytes> tail{};
    at = tail.data();
    put(at, checksum_of(parts));
    for (const std::string_view part :
         {parts.header, parts.codes, parts.parameters, parts.senses}) {
        if (!part.empty() && !flush(part)) {
            return false;
        }
    }
    return flush({tail.data(), tail.size()});
}

Result<SavedState> read_state(std::string_view bytes, const Bytecode& bytecode) {
    if (!is_state_file(bytes)) {
        return Error{"not a saved state of lsc"};
    }
    if (bytes.size() < kHeaderBytes + kChecksumBytes) {
        return Error{"the saved state is cut off: its header is incomplete"};
    }
    const char* at = bytes.data() + kMagic.size();
    const auto version = get<std::uint32_t>(at);
    const auto bytecode_version = get<std::uint32_t>(at);
    if (version != kStateFileVersion) {
        return other_version("its format", version, kStateFileVersion);
    }
    // The version is compared before the digest: digests may differ between versions, and a wrong
    // digest is reported as a state of another program.
    if (bytecode_version != kModuleFileVersion) {
        return other_version("its bytecode", bytecode_version, kModuleFileVersion);
    }
    SavedState state;
    state.header.program_digest = get<std::uint64_t>(at);
    state.header.seed = get<std::uint64_t>(at);
    state.header.generations = get<std::uint32_t>(at);
    state.header.age = get<std::uint32_t>(at);
    const auto modules = get<std::uint64_t>(at);
    const auto parameters = get<std::uint64_t>(at);
    const auto width = get<std::uint64_t>(at);
    const auto sense_size = get<std::uint64_t>(at);

    // Sizes are compared before they are multiplied, so that no product overflows.
    const std::uint64_t body = bytes.size() - kHeaderBytes - kChecksumBytes;
    if ((width != 1 && width != 2 && width != 4) || modules > body / width ||
        parameters > (body - modules * width) / sizeof(float)) {
        return Error{"the saved state is cut off or damaged: it is shorter than its header says"};
    }
    const std::uint64_t code_size = modules * width;
    const std::uint64_t parameter_size = parameters * sizeof(float);
    const std::uint64_t rest = body - code_size - parameter_size;
    if (sense_size > rest) {
        return Error{"the saved state is cut off or damaged: it is shorter than its header says"};
    }
    if (sense_size != rest) {
        return Error{"the saved state is damaged: it is longer than its header says"};
    }
    const Parts parts{bytes.substr(0, kHeaderBytes), bytes.substr(kHeaderBytes, code_size),
                      bytes.substr(kHeaderBytes + code_size, parameter_size),
                      bytes.substr(kHeaderBytes + code_size + parameter_size, sense_size)};
    const char* tail = bytes.data() + kHeaderBytes + body;
    if (get<std::uint64_t>(tail) != checksum_of(parts)) {
        return Error{"the saved state is damaged: its checksum does not fit"};
    }
    if (state.header.program_digest != digest(bytecode)) {
        return Error{"the saved state is of another program: the grammar or its definitions have "
                     "changed since"};
    }
    if (width != code_width(bytecode.code_count())) {
        return Error{"the saved state is damaged: its codes have the wrong width"};
    }
    state.word = Word(static_cast<std::uint32_t>(width));
    if (!state.word.resize(modules, parameters)) {
        return Error{"there is not enough memory for the saved word"};
    }
    std::memcpy(state.word.code_bytes().data(), parts.codes.data(), code_size);
    std::memcpy(state.word.parameters().data(), parts.parameters.data(), parameter_size);
    state.sense_state = parts.senses;
    if (!fits(bytecode, state.word) || (!state.sense_state.empty() && !bytecode.has_senses())) {
        return Error{"the saved state is damaged: the program has no such word"};
    }
    return state;
}

} // namespace lsys
