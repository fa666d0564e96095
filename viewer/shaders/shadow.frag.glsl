// SPDX-License-Identifier: MIT
layout(binding = 1) uniform sampler2D base_texture;
layout(location = 1) uniform ivec4 kind;
in vec2 uv;
void main() {
    if (kind.x != 0 && kind.z != 0 && texture(base_texture, uv).a < 0.5) {
        discard;
    }
}
