// SPDX-License-Identifier: MIT
// Sets, in each draw command, the instance count and the first instance: the branches of its key.
#include "culling.glsl"
layout(local_size_x = 256) in;
layout(location = 0) uniform uint command_count;
layout(std430, binding = 16) readonly buffer Keys { uint keys[]; };          // by key: count, first
layout(std430, binding = 18) readonly buffer CommandKeys { uint command_keys[]; };
layout(std430, binding = 19) buffer Commands { uint commands[]; }; // DrawCommand: five words

void main() {
    uint index = block_number() * kBlock + gl_LocalInvocationIndex;
    if (index >= command_count) {
        return;
    }
    uint key = command_keys[index];
    uint count = keys[2u * key];
    commands[5u * index + 1u] = count;
    commands[5u * index + 4u] = keys[2u * key + 1u];
    if (count == 0u) {
        return;
    }
    uint high, low;
    umulExtended(count, commands[5u * index] / 3u, high, low);
    uint before = atomicAdd(state.triangles[0], low);
    atomicAdd(state.triangles[1], high + (before + low < before ? 1u : 0u));
}
