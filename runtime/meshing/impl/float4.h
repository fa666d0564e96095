// SPDX-License-Identifier: MIT
// Float4: four floats in a SIMD register. Conversion to a glm::vec3 takes the first three.
#pragma once

#include <glm/vec3.hpp>

#include <cstring>

namespace lsys {

using Float4 = float __attribute__((vector_size(16)));

inline Float4 float4(const glm::vec3& v, float last = 0.0F) {
    return Float4{v.x, v.y, v.z, last};
}
inline Float4 float4(float all) {
    return Float4{all, all, all, all};
}
inline void store_four(void* to, Float4 value) {
    std::memcpy(to, &value, 16);
}
inline void store_three(void* to, Float4 value) {
    std::memcpy(to, &value, 12);
}

} // namespace lsys
