// Four floats that are added and multiplied together, of which a vector takes three.
#pragma once

#include <glm/vec3.hpp>

#include <cstring>

namespace lsys {

using Lanes = float __attribute__((vector_size(16)));

inline Lanes lanes(const glm::vec3& v, float last = 0.0F) {
    return Lanes{v.x, v.y, v.z, last};
}
inline Lanes lanes(float all) {
    return Lanes{all, all, all, all};
}
inline void store_four(void* to, Lanes value) {
    std::memcpy(to, &value, 16);
}
inline void store_three(void* to, Lanes value) {
    std::memcpy(to, &value, 12);
}

} // namespace lsys
