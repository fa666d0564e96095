// SPDX-License-Identifier: MIT
// Dither threshold of a pixel of the picture, 0 to 1; thresholds of neighbours lie far apart (Jimenez
// 2014, "Next Generation Post Processing in Call of Duty", interleaved gradient noise).
float dither_threshold() {
    vec2 at = floor(gl_FragCoord.xy) + frame.viewport.xy;
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}
// A random number of a pixel, 0 to 1, independent of its threshold. Unlike thresholds, the pixels with
// low numbers form no hatching.
float random_of_pixel() {
    uvec2 at = uvec2(ivec2(floor(gl_FragCoord.xy) + frame.viewport.xy));
    uint bits = (at.x * 1597334677u) ^ (at.y * 3812015801u);
    bits = (bits ^ (bits >> 15u)) * 2246822519u;
    bits = (bits ^ (bits >> 13u)) * 3266489917u;
    return float((bits ^ (bits >> 16u)) >> 8u) / 16777216.0;
}
