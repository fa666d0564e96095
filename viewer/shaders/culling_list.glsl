// SPDX-License-Identifier: MIT
// Lists of elements in the order of their input: one kernel classifies the elements and sums the
// counts of each workgroup, culling_sum.comp.glsl adds the sums of the workgroups before, and another
// kernel writes the lists (prefix sums: Blelloch 1990, "Prefix Sums and Their Applications").
layout(std430, binding = 6) buffer Codes { uvec2 codes[]; }; // class and value of each element
layout(std430, binding = 7) buffer Sums { uvec4 sums[]; };   // sums of each workgroup
shared uvec4 partial[kBlock];

// Sum of `value` over the invocations before this one. `total`: sum over the whole workgroup.
uvec4 sum_before(uvec4 value, out uvec4 total) {
    uint at = gl_LocalInvocationIndex;
    partial[at] = value;
    memoryBarrierShared();
    barrier();
    for (uint step = 1u; step < kBlock; step *= 2u) {
        uvec4 other = at >= step ? partial[at - step] : uvec4(0u);
        memoryBarrierShared();
        barrier();
        partial[at] += other;
        memoryBarrierShared();
        barrier();
    }
    total = partial[kBlock - 1u];
    return partial[at] - value;
}
void store_sum(uvec4 value) {
    uvec4 total;
    sum_before(value, total);
    // The last row of a dispatch in two dimensions may have workgroups without elements.
    if (gl_LocalInvocationIndex == 0u && block_number() < uint(sums.length())) {
        sums[block_number()] = total;
    }
}
// Places of this invocation's element in the lists.
uvec4 places_of(uvec4 value) {
    uvec4 total;
    uvec4 before = sum_before(value, total);
    return sums[min(block_number(), uint(sums.length()) - 1u)] + before;
}
