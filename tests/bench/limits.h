// Hand-written programs for one L-system each: what the machine can do when nothing is general.
// Each derives into buffers that it gets and returns the number of modules.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lsys::bench {

enum class PageSize : std::uint8_t { Small, Huge };

/// Anonymous pages that no one has touched; releases them at its end. Huge: advised for huge pages.
class FreshPages {
public:
    FreshPages(std::size_t bytes, PageSize size);
    ~FreshPages();
    FreshPages(const FreshPages&) = delete;
    FreshPages& operator=(const FreshPages&) = delete;
    template <typename T>
    [[nodiscard]] T* as() const {
        return static_cast<T*>(data_);
    }

private:
    void* data_;
    std::size_t bytes_;
};

/// Context-free systems of one-byte modules without parameters: `successors[c]` or null for a copy.
struct PlainSystem {
    const char* axiom;
    const char* successors[256];
};
[[nodiscard]] PlainSystem koch_w1();
[[nodiscard]] PlainSystem weed_w2();
[[nodiscard]] std::size_t
derive_plain(const PlainSystem& system, int generations, std::uint8_t* a, std::uint8_t* b);

/// W3: codes and a float for each.
[[nodiscard]] std::size_t derive_w3(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b);
/// W5.
[[nodiscard]] std::size_t derive_w5(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b);
/// W4 with a cheap hash in place of Philox.
[[nodiscard]] std::size_t derive_w4(int generations, std::uint8_t* a, std::uint8_t* b);
/// W7 with a cheap hash in place of Philox: a draw for both parameters, or one for each.
[[nodiscard]] std::size_t derive_w7(int generations,
                                    bool shared,
                                    std::uint8_t* a,
                                    std::uint8_t* b,
                                    float* parameters_a,
                                    float* parameters_b);
/// W6 on `count` modules; returns the index of the one `b`.
[[nodiscard]] std::size_t
derive_w6(int generations, std::size_t count, std::uint8_t* a, std::uint8_t* b);

/// Turtles over a word of F + - [ ] for one angle in the plane of two axes. Each writes its
/// vertices to `out` and returns their number: 2 of 3 floats a segment, or two rings of 8 with
/// normals, 6 floats.
[[nodiscard]] std::size_t
turtle_lines(const std::uint8_t* word, std::size_t count, float degrees, float* out);
[[nodiscard]] std::size_t
turtle_tubes(const std::uint8_t* word, std::size_t count, float degrees, float* out);

} // namespace lsys::bench
