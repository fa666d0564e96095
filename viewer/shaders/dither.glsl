// SPDX-License-Identifier: MIT
// Dither threshold of a pixel of the picture, 0 to 1; thresholds of neighbours lie far apart (Jimenez
// 2014, "Next Generation Post Processing in Call of Duty", interleaved gradient noise).
float dither_threshold() {
    vec2 at = floor(gl_FragCoord.xy) + frame.viewport.xy;
    return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))));
}
