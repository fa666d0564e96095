// stb_perlin of Debian's libstb-dev, compiled here and not linked from its library: numbers are the
// same on every machine only without contraction to fused multiply-add.
#define STB_PERLIN_IMPLEMENTATION
#include <stb/stb_perlin.h>
