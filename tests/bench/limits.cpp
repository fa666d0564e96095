// SPDX-License-Identifier: MIT
#include "tests/bench/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sys/mman.h>
#include <utility>
#include <vector>

namespace lsys::bench {

FreshPages::FreshPages(std::size_t bytes, PageSize size)
    : data_(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)),
      bytes_(bytes) {
    if (data_ == MAP_FAILED) {
        std::abort();
    }
    if (size == PageSize::Huge) {
        madvise(data_, bytes, MADV_HUGEPAGE);
    }
}

FreshPages::~FreshPages() {
    munmap(data_, bytes_);
}

PlainSystem koch_w1() {
    PlainSystem system{"F", {}};
    system.successors['F'] = "F+F-F-F+F";
    return system;
}

PlainSystem weed_w2() {
    PlainSystem system{"X", {}};
    system.successors['X'] = "F-[[X]+X]+F[+FX]-X";
    system.successors['F'] = "FF";
    return system;
}

namespace {

constexpr std::size_t kTemplateBytes = 32;

/// The successor of every code. Successors are padded, so that copies have a fixed length.
struct Templates {
    alignas(32) std::uint8_t text[256][kTemplateBytes]{};
    std::uint8_t length[256]{};
};

std::size_t step_plain(const Templates& templates,
                       const std::uint8_t* in,
                       std::size_t count,
                       std::uint8_t* out) {
    std::uint8_t* cursor = out;
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(cursor, templates.text[in[i]], kTemplateBytes);
        cursor += templates.length[in[i]];
    }
    return static_cast<std::size_t>(cursor - out);
}

/// Copies codes and their parameters to index `at`.
template <std::size_t Count>
void put(std::uint8_t* codes,
         float* parameters,
         std::size_t at,
         const char (&text)[Count + 1],
         const float (&values)[Count]) {
    std::memcpy(codes + at, text, Count);
    std::memcpy(parameters + at, values, Count * sizeof(float));
}

} // namespace

std::size_t
derive_plain(const PlainSystem& system, int generations, std::uint8_t* a, std::uint8_t* b) {
    Templates templates;
    for (std::size_t c = 0; c < 256; ++c) {
        const char* successor = system.successors[c];
        templates.text[c][0] = static_cast<std::uint8_t>(c);
        templates.length[c] = 1;
        if (successor != nullptr) {
            templates.length[c] = static_cast<std::uint8_t>(std::strlen(successor));
            std::memcpy(templates.text[c], successor, templates.length[c]);
        }
    }
    std::size_t count = std::strlen(system.axiom);
    std::memcpy(a, system.axiom, count);
    for (int i = 0; i < generations; ++i) {
        count = step_plain(templates, a, count, b);
        std::swap(a, b);
    }
    return count;
}

std::size_t derive_w3(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b) {
    static constexpr float kValues[19] = {1.4F, 2, 0, 22.5F,  2, 0,     0, 112.5F, 0, 22.5F,
                                          2,    0, 0, 157.5F, 0, 22.5F, 2, 0,      0};
    put<4>(a, parameters_a, 0, "!F/A", {1.4F, 2, 45, 0});
    std::size_t count = 4;
    for (int generation = 0; generation < generations; ++generation) {
        std::size_t out = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t code = a[i];
            if (code == 'A') {
                put<19>(b, parameters_b, out, "!F[&FA]/[&FA]/[&FA]", kValues);
                out += 19;
            } else {
                b[out] = code;
                parameters_b[out] = parameters_a[i] * (code == 'F'   ? 1.1F
                                                       : code == '!' ? 1.4F
                                                                     : 1.0F);
                ++out;
            }
        }
        count = out;
        std::swap(a, b);
        std::swap(parameters_a, parameters_b);
    }
    return count;
}

std::size_t derive_w5(
    int generations, std::uint8_t* a, std::uint8_t* b, float* parameters_a, float* parameters_b) {
    put<1>(a, parameters_a, 0, "A", {12.0F});
    std::size_t count = 1;
    for (int generation = 0; generation < generations; ++generation) {
        std::size_t out = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t code = a[i];
            const float x = parameters_a[i];
            if (code == 'A' && x > 0.0F) {
                put<10>(b, parameters_b, out, "F[+A][-A]A",
                        {1, 0, 30, x - 1, 0, 0, 30, x - 1, 0, x - 1});
                out += 10;
            } else {
                b[out] = code == 'A' ? std::uint8_t{'F'} : code;
                parameters_b[out] = code == 'A' ? 1.0F : x;
                ++out;
            }
        }
        count = out;
        std::swap(a, b);
        std::swap(parameters_a, parameters_b);
    }
    return count;
}

namespace {

/// 64 random bits for module `index` of a generation.
std::uint64_t hash_of(int generation, std::size_t index) {
    std::uint64_t hash = (static_cast<std::uint64_t>(generation) << 40) ^ index ^ 0x1234567U;
    hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdU;
    return (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53U;
}

} // namespace

std::size_t derive_w4(int generations, std::uint8_t* a, std::uint8_t* b) {
    alignas(16) static constexpr char kTexts[3][17] = {"F[+F]F[-F]F", "F[+F]F", "F[-F]F"};
    static constexpr std::size_t kLengths[3] = {11, 6, 6};
    a[0] = 'F';
    std::size_t count = 1;
    for (int generation = 0; generation < generations; ++generation) {
        std::uint8_t* cursor = b;
        for (std::size_t i = 0; i < count; ++i) {
            if (a[i] != 'F') {
                *cursor++ = a[i];
                continue;
            }
            const auto u = static_cast<std::uint32_t>(hash_of(generation, i) >> 32);
            const std::size_t which = (u >= 1417339207U ? 1U : 0U) + (u >= 2834678415U ? 1U : 0U);
            std::memcpy(cursor, kTexts[which], 16);
            cursor += kLengths[which];
        }
        count = static_cast<std::size_t>(cursor - b);
        std::swap(a, b);
    }
    return count;
}

std::size_t derive_w7(int generations,
                      std::size_t count,
                      bool shared,
                      std::uint8_t* a,
                      std::uint8_t* b,
                      float* parameters_a,
                      float* parameters_b) {
    std::fill_n(a, count, std::uint8_t{'A'});
    std::fill_n(parameters_a, count, 1.0F);
    for (int generation = 0; generation < generations; ++generation) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint64_t hash = hash_of(generation, i);
            const auto high = static_cast<float>(hash >> 40);
            const float second = shared ? high : static_cast<float>((hash >> 8) & 0xFFFFFFU);
            b[2 * i] = 'A';
            b[2 * i + 1] = 'A';
            parameters_b[2 * i] = parameters_a[i] * (0.5F + 0.5F * (high * 0x1p-24F));
            parameters_b[2 * i + 1] = parameters_a[i] * (0.5F + 0.5F * (second * 0x1p-24F));
        }
        count *= 2;
        std::swap(a, b);
        std::swap(parameters_a, parameters_b);
    }
    return count;
}

std::size_t derive_w6(int generations, std::size_t count, std::uint8_t* a, std::uint8_t* b) {
    std::memset(a, 'a', count + 1);
    a[0] = 0;
    a[1] = 'b';
    for (int generation = 0; generation < generations; ++generation) {
        b[0] = 0;
        for (std::size_t i = 1; i <= count; ++i) {
            b[i] = a[i] == 'b' ? 'a' : (a[i - 1] == 'b' ? 'b' : a[i]);
        }
        std::swap(a, b);
    }
    const void* found = std::memchr(a, 'b', count + 1);
    return static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - a) - 1;
}

std::size_t derive_w8(int generations, std::size_t count, float* parameters) {
    std::fill_n(parameters, count, 0.0F);
    float first = 0.0F;
    for (int generation = 0; generation <= generations; ++generation) {
        for (std::size_t i = count - 1; i-- > 0;) {
            parameters[i] = parameters[i + 1] + 1.0F;
        }
        first = parameters[0];
        for (std::size_t i = 1; i < count; ++i) {
            parameters[i] = parameters[i - 1] - 1.0F;
        }
    }
    return static_cast<std::size_t>(first);
}

namespace {

struct Vector {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
};

struct TurtleFrame {
    Vector position;
    Vector heading{0.0F, 1.0F, 0.0F};
    Vector left{-1.0F, 0.0F, 0.0F};
    Vector up{0.0F, 0.0F, 1.0F};
};

/// Reads the word as a turtle does; calls draw(frame, end) for every F.
template <typename Draw>
void walk(const std::uint8_t* word, std::size_t count, float degrees, Draw draw) {
    const float angle = degrees * 3.14159265358979F / 180.0F;
    const float cosine = std::cos(angle);
    const float sine = std::sin(angle);
    std::array<TurtleFrame, 4096> stack;
    std::size_t depth = 0;
    TurtleFrame t;
    for (std::size_t i = 0; i < count; ++i) {
        switch (word[i]) {
        case 'F': {
            const Vector end{t.position.x + t.heading.x, t.position.y + t.heading.y,
                             t.position.z + t.heading.z};
            draw(t, end);
            t.position = end;
            break;
        }
        case '+':
        case '-': {
            const float s = word[i] == '+' ? sine : -sine;
            const Vector h = t.heading;
            const Vector l = t.left;
            t.heading = {cosine * h.x + s * l.x, cosine * h.y + s * l.y, cosine * h.z + s * l.z};
            t.left = {cosine * l.x - s * h.x, cosine * l.y - s * h.y, cosine * l.z - s * h.z};
            break;
        }
        case '[':
            stack[depth++] = t;
            break;
        case ']':
            t = stack[--depth];
            break;
        default:
            break;
        }
    }
}

} // namespace

std::size_t turtle_lines(const std::uint8_t* word, std::size_t count, float degrees, float* out) {
    float* q = out;
    walk(word, count, degrees, [&](const TurtleFrame& t, const Vector& end) {
        q[0] = t.position.x;
        q[1] = t.position.y;
        q[2] = t.position.z;
        q[3] = end.x;
        q[4] = end.y;
        q[5] = end.z;
        q += 6;
    });
    return static_cast<std::size_t>(q - out) / 3;
}

std::size_t turtle_tubes(const std::uint8_t* word, std::size_t count, float degrees, float* out) {
    constexpr float kRadius = 0.1F;
    std::array<float, 8> cosines{};
    std::array<float, 8> sines{};
    for (std::size_t k = 0; k < 8; ++k) {
        const float angle = static_cast<float>(k) * 3.14159265358979F / 4.0F;
        cosines[k] = std::cos(angle);
        sines[k] = std::sin(angle);
    }
    float* q = out;
    walk(word, count, degrees, [&](const TurtleFrame& t, const Vector& end) {
        for (std::size_t k = 0; k < 8; ++k) {
            const Vector n{t.left.x * cosines[k] + t.up.x * sines[k],
                           t.left.y * cosines[k] + t.up.y * sines[k],
                           t.left.z * cosines[k] + t.up.z * sines[k]};
            for (const Vector& at : {t.position, end}) {
                q[0] = at.x + kRadius * n.x;
                q[1] = at.y + kRadius * n.y;
                q[2] = at.z + kRadius * n.z;
                q[3] = n.x;
                q[4] = n.y;
                q[5] = n.z;
                q += 6;
            }
        }
    });
    return static_cast<std::size_t>(q - out) / 6;
}

bool shadow_limit(const std::vector<double>& positions,
                  double cell,
                  std::vector<float>& exposures) {
    constexpr std::int32_t kLevels = 8;
    constexpr double kMaxVoxels = 67'108'864.0;
    const std::size_t count = exposures.size();
    std::vector<std::array<std::int32_t, 3>> voxels(count);
    std::array<std::int32_t, 3> low{};
    std::array<std::int32_t, 3> high{};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double shift = axis == 1 ? 0x1p-20 : 0.5;
            const auto index =
                static_cast<std::int32_t>(std::floor(positions[3 * i + axis] / cell + shift));
            voxels[i][axis] = index;
            low[axis] = i == 0 ? index : std::min(low[axis], index);
            high[axis] = i == 0 ? index : std::max(high[axis], index);
        }
    }
    const std::int32_t border = kLevels + 1;
    std::array<std::size_t, 3> extents{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        extents[axis] = static_cast<std::size_t>(high[axis] - low[axis] + 1 + 2 * border);
    }
    if (static_cast<double>(extents[0]) * static_cast<double>(extents[1]) *
            static_cast<double>(extents[2]) >
        kMaxVoxels) {
        return false;
    }
    // Indexed by y, x, z, the last fastest. First counts of places, then a summed-area table over x
    // and z for each y.
    std::vector<std::uint32_t> sums(extents[0] * extents[1] * extents[2], 0);
    const auto at = [&](std::int32_t x, std::int32_t y, std::int32_t z) -> std::uint32_t& {
        return sums[(static_cast<std::size_t>(y) * extents[0] + static_cast<std::size_t>(x)) *
                        extents[2] +
                    static_cast<std::size_t>(z)];
    };
    for (std::array<std::int32_t, 3>& voxel : voxels) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            voxel[axis] += border - low[axis];
        }
        ++at(voxel[0], voxel[1], voxel[2]);
    }
    for (std::size_t line = 0; line < extents[1] * extents[0]; ++line) {
        std::uint32_t* const own = sums.data() + line * extents[2];
        const bool is_first = line % extents[0] == 0;
        std::uint32_t running = 0;
        for (std::size_t z = 0; z < extents[2]; ++z) {
            running += own[z];
            own[z] = running + (is_first ? 0 : (own - extents[2])[z]);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [x, y, z] = voxels[i];
        double shade = 0.0;
        double weight = 0.2;
        for (std::int32_t layer = 0; layer <= kLevels; ++layer) {
            const std::uint32_t places = at(x + layer, y + layer, z + layer) -
                                         at(x - layer - 1, y + layer, z + layer) -
                                         at(x + layer, y + layer, z - layer - 1) +
                                         at(x - layer - 1, y + layer, z - layer - 1);
            shade += weight * static_cast<double>(places);
            weight /= 2.0;
        }
        exposures[i] = static_cast<float>(std::max(0.0, 1.0 - shade + 0.2));
    }
    return true;
}

} // namespace lsys::bench
