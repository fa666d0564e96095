// SPDX-License-Identifier: MIT
// MOVES: the program writes how surfaces have moved in the wind since the picture before, for
// temporal.frag.glsl. Programs for pictures without wind need not write it.
#if QUALITY > 1 && defined(WIND) && !defined(PICK) && !defined(BAKE) && !defined(DEPTH) && \
    !defined(SHADOW)
#define MOVES
#endif
