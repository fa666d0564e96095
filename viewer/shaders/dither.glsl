// SPDX-License-Identifier: MIT
// Dither thresholds of a pixel of the picture, 0 to 1.

// A random number of a pixel. The numbers of the four pixels of a square of 2 x 2 pixels are `step`
// apart, so that the mean of a square is near the wanted one. Squares have random numbers of their
// own, so that equal pixels form no lines. Another `seed` gives independent numbers.
float stratified_random(uint seed, float step) {
    uvec2 at = uvec2(ivec2(floor(gl_FragCoord.xy) + frame.viewport.xy));
    uvec2 square = at >> 1u;
    uint bits = (square.x * 1597334677u) ^ (square.y * 3812015801u) ^ seed;
    bits = (bits ^ (bits >> 15u)) * 2246822519u;
    bits = (bits ^ (bits >> 13u)) * 3266489917u;
    uint place = ((at.x & 1u) << 1u | ((at.x ^ at.y) & 1u)) ^ (bits & 3u);
    return fract(float(bits >> 8u) / 16777216.0 + step * float(place));
}
// A threshold for smooth colours, far from those beside it (Jimenez 2014, "Next Generation
// Post Processing in Call of Duty", interleaved gradient noise).
float dither_threshold() {
    vec2 at = floor(gl_FragCoord.xy) + frame.viewport.xy;
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}
