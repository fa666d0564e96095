// SPDX-License-Identifier: MIT
// ImpostorEntry: index, and a BlendRange. Blended entries fill the list from its end.
layout(std430, binding = 9) writeonly buffer Entries { uint entries[]; };
void write_entry(uint place, uint index, float low, float high) {
    entries[3u * place] = index;
    entries[3u * place + 1u] = floatBitsToUint(low);
    entries[3u * place + 2u] = floatBitsToUint(high);
}
