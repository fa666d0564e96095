// SPDX-License-Identifier: MIT
layout(binding = 1) uniform sampler2D picture; // as large as the target
out vec4 colour;
void main() {
    colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
