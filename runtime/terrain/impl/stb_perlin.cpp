// SPDX-License-Identifier: MIT
// stb_perlin of Debian's libstb-dev, compiled here instead of linked from its library, because results
// are the same on every machine only without contraction to fused multiply-add.
#define STB_PERLIN_IMPLEMENTATION
#include <stb/stb_perlin.h>
