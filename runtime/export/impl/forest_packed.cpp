// SPDX-License-Identifier: MIT
// Transforms of instances compressed by EXT_meshopt_compression (Khronos, vendor extension). The
// filters of this extension are implemented here, because the filters of meshoptimizer round
// differently on different machines.
#include "runtime/base/workers.h"
#include "runtime/export/impl/forest_document.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr std::int32_t kMaxMantissa = (1 << 23) - 1;
constexpr int kScaleBits = 16;    // significant bits of scales
constexpr int kMaxExponent = 100; // max absolute exponent of the filter's items

template <typename T>
void append(std::string& items, const T& value) {
    items.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The exponent of the largest power of two that is at most `value`.
int exponent_of(float value) {
    int exponent = 0;
    static_cast<void>(std::frexp(value, &exponent));
    return exponent - 1;
}

/// An item of the filter EXPONENTIAL: `value` rounded to a multiple of two to the power of
/// `exponent`, or of the first larger exponent with which the mantissa fits.
std::uint32_t exponential_item(float value, int exponent) {
    exponent = std::clamp(exponent, -kMaxExponent, kMaxExponent);
    double steps = std::ldexp(static_cast<double>(value), -exponent);
    for (; std::abs(steps) > kMaxMantissa && exponent < kMaxExponent; ++exponent) {
        steps /= 2.0;
    }
    const double max_mantissa = kMaxMantissa;
    const auto mantissa =
        static_cast<std::int32_t>(std::clamp(std::floor(steps + 0.5), -max_mantissa, max_mantissa));
    return static_cast<std::uint32_t>(exponent) << 24U |
           (static_cast<std::uint32_t>(mantissa) & 0xFFFFFFU);
}

/// An item of the filter QUATERNION: the largest component is made positive and left out, the
/// others are fractions of sqrt(1/2); the two lowest bits of the last number hold the index of the
/// largest component.
std::array<std::int16_t, 4> quaternion_item(std::span<const float> quaternion) {
    constexpr double kSteps = 32767.0;
    std::size_t largest = 0;
    for (std::size_t i = 1; i < quaternion.size(); ++i) {
        largest = std::abs(quaternion[i]) > std::abs(quaternion[largest]) ? i : largest;
    }
    const double sign = quaternion[largest] < 0.0F ? -1.0 : 1.0;
    std::array<std::int16_t, 4> item{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double part = static_cast<double>(quaternion[(largest + 1 + i) % 4]);
        const double steps = std::floor(sign * std::numbers::sqrt2 * part * kSteps + 0.5);
        item[i] = static_cast<std::int16_t>(std::clamp(steps, -kSteps, kSteps));
    }
    item[3] = static_cast<std::int16_t>(0x7FFC | static_cast<int>(largest));
    return item;
}

} // namespace

PackedTransforms pack_transforms(std::span<const ForestGroup> groups,
                                 std::span<const float> floats,
                                 std::uint32_t threads) {
    PackedTransforms packed;
    packed.first = groups.front().first;
    packed.group_count = groups.size();
    const std::uint64_t count = groups.back().first + groups.back().count - packed.first;
    packed.views[0].array = GltfArray::Translations;
    packed.views[0].type = {kGltfFloat, "VEC3", false, 12};
    packed.views[0].filter = "EXPONENTIAL";
    packed.views[1].array = GltfArray::Rotations;
    packed.views[1].type = {kGltfShort, "VEC4", true, 8};
    packed.views[1].filter = "QUATERNION";
    packed.views[2].array = GltfArray::Scales;
    packed.views[2].type = {kGltfFloat, "VEC3", false, 12};
    packed.views[2].filter = "EXPONENTIAL";
    Workers workers(threads);
    workers.for_each(packed.views.size(), [&](std::uint64_t number) {
        ForestView& view = packed.views[number];
        view.count = count;
        std::string items;
        items.reserve(view.item_bytes());
        for (const ForestGroup& group : groups) {
            const float* const translations = floats.data() + 10 * (group.first - packed.first);
            const float* const rotations = translations + 3 * group.count;
            const float* const scales = rotations + 4 * group.count;
            for (std::uint64_t i = 0; i < group.count; ++i) {
                const float scale = scales[3 * i]; // equal along all axes
                if (view.array == GltfArray::Rotations) {
                    append(items, quaternion_item(std::span(rotations + 4 * i, 4)));
                    continue;
                }
                for (std::uint64_t k = 3 * i; k < 3 * i + 3; ++k) {
                    append(items, view.array == GltfArray::Scales
                                      ? exponential_item(scale, exponent_of(scale) + 1 - kScaleBits)
                                      : exponential_item(translations[k], exponent_of(scale) - 1));
                }
            }
        }
        view.compressed = compress_items(std::as_bytes(std::span(items)), view.type.stride);
    });
    return packed;
}

} // namespace lsys
