// SPDX-License-Identifier: MIT
// Hand-written programs, each for one L-system. Their speed is an upper bound of the speed that a
// general program can reach on the machine. Each program derives into two buffers of the caller,
// `a` and `b`, which generations use in turn, and returns the number of modules. tests/README.md
// explains the names W1 to W8 of the systems.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys::bench {

enum class PageSize : std::uint8_t { Small, Huge };

/// Anonymous memory whose pages have not been touched yet; the destructor frees it. With
/// PageSize::Huge, the kernel is advised to use huge pages.
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

/// A context-free system of one-byte modules without parameters. `successors[c]` is null if the
/// module `c` is copied.
struct PlainSystem {
    const char* axiom;
    const char* successors[256];
};
[[nodiscard]] PlainSystem koch_w1();
[[nodiscard]] PlainSystem weed_w2();
[[nodiscard]] std::size_t
derive_plain(const PlainSystem& system, int generations, std::uint8_t* a, std::uint8_t* b);

/// Derives W3: a code and a float per module.
[[nodiscard]] std::size_t derive_w3(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b);
/// Derives W5: a code and a float per module.
[[nodiscard]] std::size_t derive_w5(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b);
/// Derives W4; draws random numbers by a cheap hash instead of Philox.
[[nodiscard]] std::size_t derive_w4(int generations, std::uint8_t* a, std::uint8_t* b);
/// Derives W7 from `count` modules; draws random numbers by a cheap hash instead of Philox.
/// `shared`: both parameters get the same random number, else each gets its own.
[[nodiscard]] std::size_t derive_w7(int generations,
                                    std::size_t count,
                                    bool shared,
                                    std::uint8_t* a,
                                    std::uint8_t* b,
                                    float* parameters_a,
                                    float* parameters_b);
/// Derives W6 from `count` modules; returns the index of the only `b`.
[[nodiscard]] std::size_t
derive_w6(int generations, std::size_t count, std::uint8_t* a, std::uint8_t* b);
/// Derives W8, whose two sweeps begin with `count` modules with the parameter 0. Returns the
/// parameter of the first module after the down sweep of the last generation.
[[nodiscard]] std::size_t derive_w8(int generations, std::size_t count, float* parameters);

/// Turtles in a plane that read a word of F + - [ ] with one angle. Each writes vertices to `out`
/// and returns their number. Per segment, turtle_lines() writes 2 vertices of 3 floats, and
/// turtle_tubes() writes 2 rings of 8 vertices of 6 floats (position, normal).
[[nodiscard]] std::size_t
turtle_lines(const std::uint8_t* word, std::size_t count, float degrees, float* out);
[[nodiscard]] std::size_t
turtle_tubes(const std::uint8_t* word, std::size_t count, float degrees, float* out);

/// Computes the exposure of an environment of kind Shadow with 8 levels, strength 0.2 and ratio 2,
/// without directions: with a grid of all voxels of the bounding box, and a summed-area table over
/// x and z for each y. `positions`: x, y, z of each place in m. Returns false if the grid has more
/// than 2^26 voxels.
[[nodiscard]] bool
shadow_limit(const std::vector<double>& positions, double cell, std::vector<float>& exposures);

} // namespace lsys::bench
