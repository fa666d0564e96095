// SPDX-License-Identifier: MIT
// Walk over the instances of a tree, depth first, exits in order: TreeExpander::expand(). Instance k
// is chosen by draw 0 of block k (docs/language.md section 9.6), by Philox4x32-10 (Salmon, Moraes,
// Dror, Shaw 2011): runtime/base/random.h. Include after the definition of
// void visit(uint node, uint instance, uint parent, uint exit).
const uint kNone = 0xFFFFFFFFu;
const uint kMaxDepth = 64u; // max nesting of instances: kMaxWalkDepth in gl/impl/culling_tables.h

uint draw_of(uint tree_number, uint node) {
    const uint kExpansionGeneration = 0xFFFFFFFEu;
    uvec4 counter = uvec4(tree_number, 0u, kExpansionGeneration, node);
    uvec2 key = culling.key.xy;
    for (int round = 0; round < 10; ++round) {
        uint high0, low0, high1, low1;
        umulExtended(0xD2511F53u, counter.x, high0, low0);
        umulExtended(0xCD9E8D57u, counter.z, high1, low1);
        counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key += uvec2(0x9E3779B9u, 0xBB67AE85u);
    }
    return counter.x;
}
// The instance that fills a slot.
uint choose(uint slots, uint slot, uint tree_number, uint node) {
    uint first = tables[slots + 2u * slot];
    uint count = tables[slots + 2u * slot + 1u];
    if (count == 1u) {
        return tables[first];
    }
    uint u = draw_of(tree_number, node) >> 8;
    // (u * count) >> 24 in 64 bits
    uint high, low;
    umulExtended(u, count, high, low);
    return tables[first + (high << 8 | low >> 24)];
}
// Returns the count of instances.
uint walk(uint form, uint tree_number) {
    uint slots = slots_at(form);
    uint instances = instances_at(form);
    uint exits = exits_at(form);
    uint nodes[kMaxDepth];  // nodes of the instances that are not finished, from the root on
    uint next[kMaxDepth];   // index of the next exit of each of these nodes
    uint ends[kMaxDepth];   // index after its last exit
    uint node = 0u;
    uint depth = 0u;
    uint slot = 0u;
    uint from = kNone;
    while (true) {
        uint instance = choose(slots, slot, tree_number, node);
        visit(node, instance, depth == 0u ? kNone : nodes[depth - 1u], from);
        uint at = instances + kInstanceWords * instance;
        nodes[depth] = node;
        next[depth] = tables[at + 7u];
        ends[depth] = tables[at + 7u] + tables[at + 8u];
        ++node;
        while (next[depth] == ends[depth]) {
            if (depth == 0u) {
                return node;
            }
            --depth;
        }
        from = next[depth]++;
        slot = tables[exits + kExitWords * from + 7u];
        ++depth;
    }
    return node;
}
