// Word: the derived string, packed. A stream of codes of one width (1, 2 or 4 bytes, little-endian)
// and a stream of binary32 parameters of those codes that store any, in order. Made by derive, read
// by dumps and by the turtle. Memory comes from one arena that is reused, advised for huge pages,
// and never initialised. A word may keep the origin of each module beside them.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/origin.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace lsys {

/// Anonymous memory that grows without keeping what it holds. Move only. It takes more addresses
/// than it is asked for, so that a word that grows a little each generation stays where it is;
/// pages that nobody writes cost nothing.
class Arena {
public:
    Arena() = default;
    ~Arena();
    Arena(Arena&& other) noexcept;
    Arena& operator=(Arena&& other) noexcept;
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Makes room for at least `bytes`; contents are lost if it grows. False: the system has no
    /// memory.
    [[nodiscard]] bool reserve(std::size_t bytes);
    void release();
    [[nodiscard]] std::byte* data() { return data_; }
    [[nodiscard]] const std::byte* data() const { return data_; }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    /// Bytes that were ever asked for here: what may be held from the system.
    [[nodiscard]] std::size_t used() const { return used_; }

private:
    void advise();

    std::byte* data_ = nullptr;
    std::size_t capacity_ = 0;
    std::size_t used_ = 0;
    std::size_t advised_ = 0; // from the begin on
};

/// Bytes past the last code and parameter that writers may touch with wide stores. Those past the
/// parameters hold finite numbers, so that wide loads may read them.
inline constexpr std::size_t kWordSlack = 256;

class Word {
public:
    Word() = default;
    explicit Word(std::uint32_t code_width) : code_width_(code_width) {}

    /// Makes room for a word of exactly these sizes and takes them as its own; the contents are
    /// lost. False: no memory, and the word is empty.
    [[nodiscard]] bool resize(std::uint64_t module_count, std::uint64_t parameter_count);

    /// From now on the word has room for the origin of each module; what is there is not written.
    /// False: no memory.
    [[nodiscard]] bool keep_origins();
    void drop_origins();

    [[nodiscard]] std::uint64_t module_count() const { return module_count_; }
    [[nodiscard]] std::uint64_t parameter_count() const { return parameter_count_; }
    [[nodiscard]] std::uint32_t code_width() const { return code_width_; }
    /// Bytes of the word itself.
    [[nodiscard]] std::uint64_t byte_count() const {
        return module_count_ * code_width_ + parameter_count_ * sizeof(float);
    }
    /// Bytes held from the system.
    [[nodiscard]] std::uint64_t held_bytes() const {
        return codes_.used() + parameters_.used() + origins_.used();
    }
    /// What held_bytes() would be after resize() to these sizes; saturates.
    [[nodiscard]] std::uint64_t held_bytes_after(std::uint64_t module_count,
                                                 std::uint64_t parameter_count) const;

    /// The codes as integers of the word's width; precondition: sizeof(T) == code_width().
    template <typename T>
    [[nodiscard]] std::span<const T> codes() const {
        return {reinterpret_cast<const T*>(codes_.data()), module_count_};
    }
    template <typename T>
    [[nodiscard]] std::span<T> codes() {
        return {reinterpret_cast<T*>(codes_.data()), module_count_};
    }
    [[nodiscard]] std::span<const float> parameters() const {
        return {reinterpret_cast<const float*>(parameters_.data()), parameter_count_};
    }
    [[nodiscard]] std::span<float> parameters() {
        return {reinterpret_cast<float*>(parameters_.data()), parameter_count_};
    }
    [[nodiscard]] Code code(std::uint64_t index) const;
    /// Of each module; empty if the word does not keep them.
    [[nodiscard]] std::span<const Origin> origins() const {
        return {reinterpret_cast<const Origin*>(origins_.data()),
                keeps_origins_ ? module_count_ : 0};
    }
    [[nodiscard]] std::span<Origin> origins() {
        return {reinterpret_cast<Origin*>(origins_.data()), keeps_origins_ ? module_count_ : 0};
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
