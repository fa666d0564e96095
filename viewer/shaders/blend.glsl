// SPDX-License-Identifier: MIT
// Samples of a pixel that a surface covers. LOD bands blend by dithering: each draws the pixels
// with thresholds in its range (BlendRange in C++). Cut-out pictures have smooth edges.
#include "dither.glsl"

bool is_in_range(float threshold, vec2 range) {
    return threshold >= range.x && threshold < range.y;
}
#ifdef ONE_SAMPLE
// The functions below for pixels with one sample. A sample mask, even a full one, is costly for
// software renderers.
void keep_range(vec2 range) {
    if (!is_in_range(stratified_random(0u, 0.25), range)) {
        discard;
    }
}
void keep_cover(float opacity) {
    if (opacity < 0.5) {
        discard;
    }
}
void keep_cover_in_range(float opacity, vec2 range) {
    if (opacity < 0.5 || !is_in_range(stratified_random(0u, 0.25), range)) {
        discard;
    }
}
#else
// Mask of the samples of a pixel whose thresholds are in `range`. Thresholds are evenly spaced, and
// equal in all pixels, because random ones show as dots; each refinement shifts the thresholds.
int samples_in(vec2 range) {
    float first = fract(0.5 + 0.618034 * frame.time_before.y);
    int mask = 0;
    for (int i = 0; i < gl_NumSamples; ++i) {
        mask |= is_in_range((float(i) + first) / float(gl_NumSamples), range) ? 1 << i : 0;
    }
    return mask;
}
void keep_samples(int mask) {
    if (mask == 0) {
        discard;
    }
    gl_SampleMask[0] = mask;
}
// Keeps the samples of a pixel whose thresholds are in `range`.
void keep_range(vec2 range) {
    keep_samples(samples_in(range));
}
// Fraction of a pixel that a cut-out picture covers. Its edge lies at opacity 0.5 and is one pixel
// wide with multisampling, else hard. Call before any discard, which would spoil fwidth().
float cut_out_cover(float opacity) {
    float cover = (opacity - 0.5) / max(fwidth(opacity), 1e-4) + 0.5;
    return gl_NumSamples > 1 ? clamp(cover, 0.0, 1.0) : step(0.5, opacity);
}
// Keeps the samples that a cut-out picture covers.
void keep_cover(float opacity) {
    keep_range(vec2(0.0, cut_out_cover(opacity)));
}
// Keeps the samples that a cut-out picture covers in a band. All bands together keep the samples
// that keep_cover() keeps.
void keep_cover_in_range(float opacity, vec2 range) {
    keep_range(vec2(range.x, min(range.y, cut_out_cover(opacity))));
}
#endif
