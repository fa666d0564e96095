// Blending of LOD bands: each draws a range of the pixels. BlendRange has the ranges.

// Number of a pixel of the picture, 0 to 1; numbers of neighbours lie far apart (Jimenez 2014, "Next
// Generation Post Processing in Call of Duty", interleaved gradient noise).
float pixel_number() {
    vec2 at = floor(gl_FragCoord.xy) + frame.viewport.xy;
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}
bool is_in_range(float number, vec2 range) {
    return number >= range.x && number < range.y;
}
// Keeps the samples of a pixel whose numbers are in `range`. Sample numbers are evenly spaced from the
// number of the pixel on.
void keep_range(vec2 range) {
    float number = pixel_number();
    int mask = 0;
    for (int i = 0; i < gl_NumSamples; ++i) {
        mask |= is_in_range(fract(number + float(i) / float(gl_NumSamples)), range) ? 1 << i : 0;
    }
    if (mask == 0) {
        discard;
    }
    gl_SampleMask[0] = mask;
}
