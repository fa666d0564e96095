// SPDX-License-Identifier: MIT
#include "runtime/turtle/plant_size.h"

#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/turtle/organs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lsys {

namespace {

/// Min height of a box relative to its longest side; smaller values may be rounding errors of
/// turns.
constexpr double kMinRelativeHeight = 1e-6;

double to_double(float value) {
    return static_cast<double>(value);
}

/// The base-2 logarithm of a number of at least 1, by the series of artanh for a mantissa within a
/// factor sqrt(2) of 1; omitted terms are below 1e-18.
double portable_log2(double value) {
    constexpr int kTerms = 12;
    int exponent = 0;
    double mantissa = std::frexp(value, &exponent); // exact, 0.5 to 1
    if (mantissa < 0.5 * std::numbers::sqrt2) {
        mantissa *= 2.0;
        --exponent;
    }
    const double z = (mantissa - 1.0) / (mantissa + 1.0);
    double sum = 0.0;
    for (int k = kTerms - 1; k >= 0; --k) {
        sum = sum * z * z + 1.0 / (2.0 * k + 1.0);
    }
    return exponent + 2.0 * z * sum / std::numbers::ln2;
}

/// 2^value for a value from 0 to 1000, by the Taylor series of 2^x for x from -1/2 to 1/2.
double portable_exp2(double value) {
    constexpr int kTerms = 16;
    const double whole = std::floor(value + 0.5);
    const double x = (value - whole) * std::numbers::ln2;
    double sum = 1.0;
    for (int k = kTerms; k > 0; --k) {
        sum = 1.0 + sum * x / k;
    }
    return std::ldexp(sum, static_cast<int>(whole)); // exact
}

float mass_of(const Segment& segment, double density) {
    return mass_of_cone(to_double(segment.length), to_double(segment.base_radius),
                        to_double(segment.tip_radius), density);
}

float spring_of(const Segment& segment, double elasticity) {
    return spring_of_beam(to_double(segment.length), to_double(segment.base_radius),
                          to_double(segment.tip_radius), elasticity);
}

/// Calls change(segment), and computes the mass and spring of the segment again. A mass or spring
/// that differs from the one computed for the old shape was given by the author and stays
/// unchanged.
template <typename Change>
void change_segment(Segment& segment, const StemMaterial& material, const Change& change) {
    const bool mass_follows = segment.mass == mass_of(segment, material.density);
    const bool spring_follows = segment.spring == spring_of(segment, material.elasticity);
    change(segment);
    if (mass_follows) {
        segment.mass = mass_of(segment, material.density);
    }
    if (spring_follows) {
        segment.spring = spring_of(segment, material.elasticity);
    }
}

/// Whether child `i`, which comes before child `chosen` of the same parent, continues the parent
/// better than `chosen`. A child on the axis of the parent is better than others, then a child with
/// more tips, then the earlier child.
bool continues_better(const Skeleton& skeleton,
                      const std::vector<std::uint32_t>& tips,
                      std::uint32_t i,
                      std::uint32_t chosen) {
    if (chosen == kNoSegment) {
        return true;
    }
    const std::uint16_t order = skeleton.segments[skeleton.segments[i].parent].order;
    const bool own = skeleton.segments[i].order == order;
    const bool other = skeleton.segments[chosen].order == order;
    return own != other ? own : tips[i] >= tips[chosen];
}

} // namespace

float mass_of_cone(double length, double base_radius, double tip_radius, double density) {
    const double volume =
        std::numbers::pi / 3.0 * std::abs(length) *
        (base_radius * base_radius + base_radius * tip_radius + tip_radius * tip_radius);
    return static_cast<float>(
        std::min(volume * density, static_cast<double>(std::numeric_limits<float>::max())));
}

float spring_of_beam(double length, double base_radius, double tip_radius, double elasticity) {
    constexpr auto kMax = static_cast<double>(std::numeric_limits<float>::max());
    const double square = (base_radius + tip_radius) * (base_radius + tip_radius);
    const double stiff = std::numbers::pi / 64.0 * square * square * elasticity;
    return static_cast<float>(std::abs(length) * kMax > stiff ? stiff / std::abs(length) : kMax);
}

StemMaterial material_of(const Settings& settings) {
    return {to_double(settings.density), to_double(settings.elasticity)};
}

double pipe_factor(std::uint32_t count, double exponent) {
    LSYS_CHECK(count >= 1 && exponent >= 1.0);
    const auto tips = static_cast<double>(count);
    if (count == 1 || exponent == 1.0) {
        return tips;
    }
    if (exponent == 2.0) {
        return std::sqrt(tips);
    }
    return portable_exp2(portable_log2(tips) / exponent);
}

std::optional<Stop> apply_pipe(const Pipe& pipe,
                               const StemMaterial& material,
                               std::uint64_t max_bytes,
                               Skeleton& skeleton) {
    const std::size_t count = skeleton.segments.size();
    const bool tapers = pipe.taper > 0.0F;
    const std::size_t number_bytes = (tapers ? 2 : 1) * sizeof(std::uint32_t);
    if (skeleton.byte_count() + count * number_bytes > max_bytes) {
        return Stop::Limit;
    }
    std::vector<std::uint32_t> tips;
    std::vector<std::uint32_t> next; // the child whose width a tapered segment has at its tip
    const bool has_memory = catch_out_of_memory(
        [&] {
            tips.resize(count, 0);
            next.resize(tapers ? count : 0, kNoSegment);
            return true;
        },
        [] { return false; });
    if (!has_memory) {
        return Stop::OutOfMemory;
    }
    std::uint32_t last_tips = 1;
    double last_factor = 1.0;
    for (std::size_t i = count; i-- > 0;) { // children come after their parents
        Segment& segment = skeleton.segments[i];
        tips[i] = std::max(tips[i], 1U);
        if (segment.parent != kNoSegment) {
            tips[segment.parent] += tips[i];
        }
        if (tips[i] != last_tips) {
            last_tips = tips[i];
            last_factor = pipe_factor(last_tips, to_double(pipe.exponent));
        }
        const auto width = static_cast<float>(std::min(
            last_factor * to_double(pipe.tip_width), to_double(std::numeric_limits<float>::max())));
        float tip_radius = 0.5F * width;
        if (tapers) {
            const std::uint32_t child = next[i];
            if (child != kNoSegment) {
                const double step =
                    to_double(skeleton.segments[child].base_radius) - to_double(tip_radius);
                tip_radius =
                    static_cast<float>(to_double(tip_radius) + to_double(pipe.taper) * step);
            }
            if (segment.parent != kNoSegment) {
                std::uint32_t& chosen = next[segment.parent];
                chosen = continues_better(skeleton, tips, static_cast<std::uint32_t>(i), chosen)
                             ? static_cast<std::uint32_t>(i)
                             : chosen;
            }
        }
        change_segment(segment, material, [&](Segment& each) {
            each.base_radius = 0.5F * width;
            each.tip_radius = tip_radius;
        });
    }
    return std::nullopt;
}

void apply_pixels(const StemMaterial& material, Skeleton& skeleton) {
    const Bounds bounds = bounds_of(skeleton);
    if (bounds.empty) {
        return;
    }
    const glm::dvec3 size = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    const double pixel = std::max({size.x, size.y, size.z}) / kPicturePixels;
    const auto metres = [&](float radius) {
        return static_cast<float>(std::min(std::max(to_double(radius), 0.5 * kMinPixels) * pixel,
                                           to_double(std::numeric_limits<float>::max())));
    };
    for (Segment& segment : skeleton.segments) {
        change_segment(segment, material, [&](Segment& each) {
            each.base_radius = metres(each.base_radius);
            each.tip_radius = metres(each.tip_radius);
        });
    }
}

Bounds bounds_of(const Skeleton& skeleton) {
    Bounds bounds;
    for (const Segment& segment : skeleton.segments) {
        bounds.add(segment.base);
        bounds.add(tip(segment));
    }
    for (const PlacedObject& object : skeleton.objects) {
        for_each_point_of(skeleton, object, [&](const glm::vec3& point) { bounds.add(point); });
    }
    for (const glm::vec3& corner : skeleton.corners) {
        bounds.add(corner);
    }
    return bounds;
}

double height_of(const Skeleton& skeleton) {
    const Bounds bounds = bounds_of(skeleton);
    return to_double(bounds.high.y) - to_double(bounds.low.y);
}

void scale_plant(double factor, const StemMaterial& material, Skeleton& skeleton) {
    const auto scaled = [factor](float value) {
        constexpr double kMax = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(to_double(value) * factor, -kMax, kMax));
    };
    const auto scaled_point = [&](const glm::vec3& at) {
        return glm::vec3(scaled(at.x), scaled(at.y), scaled(at.z));
    };
    for (Segment& segment : skeleton.segments) {
        change_segment(segment, material, [&](Segment& each) {
            each.base = scaled_point(each.base);
            each.length = scaled(each.length);
            each.base_radius = scaled(each.base_radius);
            each.tip_radius = scaled(each.tip_radius);
        });
    }
    skeleton.tube_shape.flare.height = scaled(skeleton.tube_shape.flare.height);
    for (PlacedObject& object : skeleton.objects) {
        object.position = scaled_point(object.position);
        object.size = scaled(object.size);
    }
    for (glm::vec3& corner : skeleton.corners) {
        corner = scaled_point(corner);
    }
}

bool scale_to_height(double height, const StemMaterial& material, Skeleton& skeleton) {
    const Bounds bounds = bounds_of(skeleton);
    if (bounds.empty) {
        return true;
    }
    const glm::dvec3 size = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    if (!(size.y > kMinRelativeHeight * std::max(size.x, size.z)) || size.y <= 0.0) {
        return false;
    }
    scale_plant(height / size.y, material, skeleton);
    return true;
}

} // namespace lsys
