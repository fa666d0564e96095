// SPDX-License-Identifier: MIT
// Blending of LOD bands by dithering: each band draws a range of the pixels: BlendRange in C++.

// Dither threshold of a pixel of the picture, 0 to 1; thresholds of neighbours lie far apart (Jimenez
// 2014, "Next Generation Post Processing in Call of Duty", interleaved gradient noise).
float dither_threshold() {
    vec2 at = floor(gl_FragCoord.xy) + frame.viewport.xy;
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}
bool is_in_range(float threshold, vec2 range) {
    return threshold >= range.x && threshold < range.y;
}
// Keeps the samples of a pixel whose thresholds are in `range`. Sample thresholds are evenly spaced,
// from the threshold of the pixel on.
void keep_range(vec2 range) {
    float threshold = dither_threshold();
    int mask = 0;
    for (int i = 0; i < gl_NumSamples; ++i) {
        mask |= is_in_range(fract(threshold + float(i) / float(gl_NumSamples)), range) ? 1 << i : 0;
    }
    if (mask == 0) {
        discard;
    }
    gl_SampleMask[0] = mask;
}
