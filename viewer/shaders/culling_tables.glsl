// SPDX-License-Identifier: MIT
// Forms, instances and exits of a forest for the compute shaders; gl/impl/culling_tables.cpp writes
// them. Offsets are in words of 32 bits.
layout(std430, binding = 2) readonly buffer Tables { uint tables[]; };
const uint kFormWords = 32u;
const uint kInstanceWords = 16u;
const uint kExitWords = 8u;

float table_float(uint at) {
    return uintBitsToFloat(tables[at]);
}
vec3 table_vec3(uint at) {
    return vec3(table_float(at), table_float(at + 1u), table_float(at + 2u));
}
vec4 table_vec4(uint at) {
    return vec4(table_vec3(at), table_float(at + 3u));
}

// Lengths in m at scale 1.
struct LodForm {
    vec3 centre; // of the bounding sphere at yaw 0
    float radius; // of that sphere
    float height;
    float low;
    float high;
    float impostor_radius; // of a sphere around the middle of `low` and `high`
    float width; // max distance from the root, for sway_of()
};
LodForm form_at(uint form) {
    uint at = kFormWords * form;
    return LodForm(table_vec3(at), table_float(at + 3u), table_float(at + 4u), table_float(at + 5u),
                   table_float(at + 6u), table_float(at + 7u), table_float(at + 8u));
}
uint triangles_of(uint form, uint level) {
    return level < 4u ? tables[kFormWords * form + 9u + level] : 0u;
}
uint first_key_of(uint form) { return tables[kFormWords * form + 13u]; }
uint instances_of(uint form) { return tables[kFormWords * form + 14u]; }
uint slots_at(uint form) { return tables[kFormWords * form + 15u]; }
uint instances_at(uint form) { return tables[kFormWords * form + 16u]; }
uint exits_at(uint form) { return tables[kFormWords * form + 17u]; }

float sway_of(LodForm form, float scale) {
    return culling.sway.x * (scale * form.height) + culling.sway.y * (scale * form.width) +
           culling.sway.z;
}
