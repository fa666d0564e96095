// SPDX-License-Identifier: MIT
// Stable radix sort of branches by key, eight bits a pass (Satish, Harris and Garland 2009,
// "Designing Efficient Sorting Algorithms for Manycore GPUs"). COUNT counts the digits of each
// workgroup; SUM makes prefix sums, in pass 0 also first branches of keys. Neither: moves branches.
#include "culling.glsl"
layout(location = 0) uniform uint shift;
const uint kDigits = 256u;
const uint kPart = 2048u; // branches of a workgroup
layout(std430, binding = 17) buffer Digits { uint digits[]; }; // by digit, then by workgroup
uint branch_count() {
    return state.pool_used + state.coarser_used;
}
uint part_count() {
    return (branch_count() + kPart - 1u) / kPart;
}
#ifdef SUM
layout(local_size_x = 1024) in;
layout(std430, binding = 16) buffer Keys { uint keys[]; }; // by key: count, first branch
shared uint partial[1024];
// Sum of `value` over the invocations before this one. `total`: sum over all invocations.
uint sum_before(uint value, out uint total) {
    uint at = gl_LocalInvocationIndex;
    partial[at] = value;
    memoryBarrierShared();
    barrier();
    for (uint step = 1u; step < 1024u; step *= 2u) {
        uint other = at >= step ? partial[at - step] : 0u;
        memoryBarrierShared();
        barrier();
        partial[at] += other;
        memoryBarrierShared();
        barrier();
    }
    total = partial[1023];
    return partial[at] - value;
}
void main() {
    uint index = gl_LocalInvocationIndex;
    uint count = kDigits * part_count();
    uint part = (count + 1023u) / 1024u;
    uint begin = min(index * part, count);
    uint end = min(begin + part, count);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum += digits[i];
    }
    uint total;
    uint before = sum_before(sum, total);
    for (uint i = begin; i < end; ++i) {
        uint here = digits[i];
        digits[i] = before;
        before += here;
    }
    if (shift != 0u) {
        return;
    }
    barrier();
    part = (culling.key.w + 1023u) / 1024u;
    begin = min(index * part, culling.key.w);
    end = min(begin + part, culling.key.w);
    sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum += keys[2u * i];
    }
    before = sum_before(sum, total);
    for (uint i = begin; i < end; ++i) {
        keys[2u * i + 1u] = before;
        before += keys[2u * i];
    }
    if (index == 0u) {
        state.drawn_branches = total;
    }
}
#else
layout(local_size_x = 256) in;
layout(std430, binding = 14) readonly buffer Unsorted { uvec2 unsorted[]; };
shared uint next[kDigits];
#ifdef COUNT
void main() {
    uint index = gl_LocalInvocationIndex;
    uint block = block_number();
    next[index] = 0u;
    memoryBarrierShared();
    barrier();
    for (uint row = 0u; row < kPart; row += 256u) {
        uint at = block * kPart + row + index;
        if (at < branch_count()) {
            atomicAdd(next[(unsorted[at].x >> shift) & 0xFFu], 1u);
        }
    }
    memoryBarrierShared();
    barrier();
    if (block < part_count()) {
        digits[index * part_count() + block] = next[index];
    }
}
#else
layout(std430, binding = 15) writeonly buffer Sorted { uvec2 sorted[]; };
shared uint row_digits[256];
void main() {
    uint index = gl_LocalInvocationIndex;
    uint block = block_number();
    next[index] = block < part_count() ? digits[index * part_count() + block] : 0u;
    for (uint row = 0u; row < kPart; row += 256u) {
        uint at = block * kPart + row + index;
        bool exists = at < branch_count();
        uvec2 branch = exists ? unsorted[at] : uvec2(0u);
        uint digit = (branch.x >> shift) & 0xFFu;
        row_digits[index] = exists ? digit : kDigits;
        memoryBarrierShared();
        barrier();
        if (exists) {
            uint place = next[digit];
            for (uint i = 0u; i < index; ++i) {
                place += row_digits[i] == digit ? 1u : 0u;
            }
            sorted[place] = branch;
        }
        memoryBarrierShared();
        barrier();
        if (exists) {
            atomicAdd(next[digit], 1u);
        }
        memoryBarrierShared();
        barrier();
    }
}
#endif
#endif
