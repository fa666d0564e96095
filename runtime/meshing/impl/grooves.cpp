// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/grooves.h"

#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr float kMaxShift = 0.4F; // max shift of the phase, in grooves
/// The phase is the BarkNoise of a tube of this many times the circumference, so it varies 6 times
/// more slowly than the bumps of the bark.
constexpr float kShiftCircumference = 6;

/// Signed distance from the middle of the groove: -1 and 1 on the two ridges beside it.
float from_middle(float x) {
    return 2.0F * (x - std::floor(x)) - 1.0F;
}

} // namespace

float groove_depth(float x) {
    const float part = std::abs(from_middle(x));
    return part * part * (3.0F - 2.0F * part) - 1.0F;
}

float groove_slope(float x) {
    const float signed_part = from_middle(x);
    const float part = std::abs(signed_part);
    const float slope = 12.0F * part * (1.0F - part);
    return signed_part < 0.0F ? -slope : slope;
}

Grooves::Grooves(std::uint32_t count, float circumference, std::uint32_t seed)
    : count_(count), shift_noise_(kShiftCircumference * circumference, seed),
      begin_(shift_noise_.at(0.0F, 0.0).value) {}

float Grooves::ridge_shift(double arc) const {
    return 0.5F * kMaxShift * (shift_noise_.at(0.0F, arc).value - begin_);
}

NoiseSample Grooves::at(float turn, double arc) const {
    const float x = static_cast<float>(count_) * turn + ridge_shift(arc);
    const float slope = groove_slope(x);
    return {.value = groove_depth(x),
            .by_angle = slope * static_cast<float>(count_) / (2.0F * std::numbers::pi_v<float>),
            .by_length = slope * 0.5F * kMaxShift * shift_noise_.at(0.0F, arc).by_length};
}

} // namespace lsys
