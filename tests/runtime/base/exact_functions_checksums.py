#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Prints the checksums that exact_functions_test.cpp expects: of results that mpmath computes with
# 600 bits and rounds to binary64. Usage: exact_functions_checksums.py [COUNT];
# the test's counts are 200,000 and, for atan2, 20,000.
import math
import struct
import sys

from mpmath import atan2, cos, exp, mp, mpf, pi, sin

MASK = (1 << 64) - 1


class SplitMix:
    """Steele, Lea & Flood 2014."""

    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return z ^ (z >> 31)

    def number(self, low, high):
        """A number of either sign with a binary exponent from low to high."""
        bits = self.next()
        exponent = low + (self.next() % (high - low + 1))
        fraction = bits & ((1 << 52) - 1)
        word = (bits >> 63) << 63 | (exponent + 1023) << 52 | fraction
        return struct.unpack("<d", struct.pack("<Q", word))[0]


def rounded(value):
    """The nearest binary64, ties to even."""
    sign, mantissa, exponent, bits = value._mpf_
    mantissa = int(mantissa)
    kept = min(53, int(exponent) + bits + 1074)
    if kept < 0 or mantissa == 0:
        return -0.0 if sign else 0.0
    drop = bits - kept
    if drop > 0:
        rest = mantissa & ((1 << drop) - 1)
        mantissa >>= drop
        half = 1 << (drop - 1)
        if rest > half or (rest == half and mantissa & 1):
            mantissa += 1
        exponent += drop
    result = math.ldexp(mantissa, int(exponent))
    return -result if sign else result


def checksum(count, seed, function):
    numbers = SplitMix(seed)
    total = 0
    for _ in range(count):
        result = rounded(function(numbers))
        total = (total * 31 + struct.unpack("<Q", struct.pack("<d", result))[0]) & MASK
    return total


def main():
    mp.prec = 600
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200000
    rows = [
        ("sine", 1, lambda n: sin(mpf(n.number(-40, 40)))),
        ("cosine", 2, lambda n: cos(mpf(n.number(-40, 40)))),
        ("sine of degrees", 3, lambda n: sin(mpf(n.number(-80, 8)) * pi / 180)),
        ("cosine of degrees", 4, lambda n: cos(mpf(n.number(-80, 8)) * pi / 180)),
        ("exp", 5, lambda n: exp(mpf(n.number(-60, 8)))),
        ("atan2", 6, lambda n: atan2(mpf(n.number(-90, 90)), mpf(n.number(-20, 20)))),
    ]
    for name, seed, function in rows:
        print(f"{name}: 0x{checksum(count, seed, function):016X}")


if __name__ == "__main__":
    main()
