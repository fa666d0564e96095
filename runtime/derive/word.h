// SPDX-License-Identifier: MIT
// Word: the derived string, packed. A stream of codes of one width (1, 2 or 4 bytes, little-endian)
// and a stream of the binary32 parameters that these codes store, in order. Made by class
// Derivation, read by dumps and by the turtle. Memory comes from arenas, which are reused and not
// initialised. A word may also keep the origin of each module.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/arena.h"
#include "runtime/derive/origin.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace lsys {

/// Calls visit(C{}) with the unsigned integer type C of `code_width` bytes: 1, 2 or 4.
template <typename Visit>
decltype(auto) visit_code_type(std::uint32_t code_width, Visit&& visit) {
    switch (code_width) {
    case 1:
        return visit(std::uint8_t{});
    case 2:
        return visit(std::uint16_t{});
    default:
        return visit(std::uint32_t{});
    }
}

/// Bytes past the last code and parameter that writers may touch with wide stores. The slack of the
/// parameters holds finite numbers, so that wide loads may read it.
inline constexpr std::size_t kWordSlack = 256;

class Word {
public:
    Word() = default;
    explicit Word(std::uint32_t code_width) : code_width_(code_width) {}

    /// Resizes the word; the contents are lost. Returns false if there is no memory: the word is
    /// then empty.
    [[nodiscard]] bool resize(std::uint64_t module_count, std::uint64_t parameter_count);

    /// Makes room for the origin of each module, now and in later resizes; the origins are not
    /// initialised. Returns false if there is no memory.
    [[nodiscard]] bool keep_origins();
    void drop_origins();

    [[nodiscard]] std::uint64_t module_count() const { return module_count_; }
    [[nodiscard]] std::uint64_t parameter_count() const { return parameter_count_; }
    [[nodiscard]] std::uint32_t code_width() const { return code_width_; }
    /// Bytes of codes and parameters.
    [[nodiscard]] std::uint64_t byte_count() const {
        return module_count_ * code_width_ + parameter_count_ * sizeof(float);
    }
    /// Bytes obtained from the system.
    [[nodiscard]] std::uint64_t held_bytes() const {
        return codes_.max_reserved() + parameters_.max_reserved() + origins_.max_reserved();
    }
    /// held_bytes() after resize() to these sizes; saturates.
    [[nodiscard]] std::uint64_t held_bytes_after(std::uint64_t module_count,
                                                 std::uint64_t parameter_count) const;

    /// The codes as integers of the word's width. Precondition: sizeof(C) == code_width().
    template <typename C>
    [[nodiscard]] std::span<const C> codes() const {
        return {codes_.as<C>(), module_count_};
    }
    template <typename C>
    [[nodiscard]] std::span<C> codes() {
        return {codes_.as<C>(), module_count_};
    }
    /// Calls visit with the codes as a span of integers of the word's width.
    template <typename Visit>
    decltype(auto) visit(Visit&& visitor) const {
        return visit_code_type(code_width_,
                               [&](auto type) { return visitor(codes<decltype(type)>()); });
    }
    template <typename Visit>
    decltype(auto) visit(Visit&& visitor) {
        return visit_code_type(code_width_,
                               [&](auto type) { return visitor(codes<decltype(type)>()); });
    }
    [[nodiscard]] std::span<const std::byte> code_bytes() const {
        return {codes_.as<std::byte>(), module_count_ * code_width_};
    }
    [[nodiscard]] std::span<std::byte> code_bytes() {
        return {codes_.as<std::byte>(), module_count_ * code_width_};
    }
    [[nodiscard]] std::span<const float> parameters() const {
        return {parameters_.as<float>(), parameter_count_};
    }
    [[nodiscard]] std::span<float> parameters() {
        return {parameters_.as<float>(), parameter_count_};
    }
    [[nodiscard]] Code code(std::uint64_t index) const;
    /// The origin of each module; empty if the word does not keep them.
    [[nodiscard]] std::span<const Origin> origins() const {
        return {origins_.as<Origin>(), keeps_origins_ ? module_count_ : 0};
    }
    [[nodiscard]] std::span<Origin> origins() {
        return {origins_.as<Origin>(), keeps_origins_ ? module_count_ : 0};
    }
    [[nodiscard]] bool keeps_origins() const { return keeps_origins_; }

private:
    Arena codes_;
    Arena parameters_;
    Arena origins_;
    bool keeps_origins_ = false;
    std::uint64_t module_count_ = 0;
    std::uint64_t parameter_count_ = 0;
    std::uint32_t code_width_ = 1;
};

} // namespace lsys
