"""Writes pairs of unit vectors above the surface, as POST …/evaluate takes them: pairs.py COUNT."""

import math
import random
import struct
import sys


def vector(rng):
    """To the sky, evenly over projected solid angle."""
    radius, turn = math.sqrt(0.999 * rng.random()), 2 * math.pi * rng.random()
    return radius * math.cos(turn), radius * math.sin(turn), math.sqrt(1 - radius * radius)


rng = random.Random(1)
for _ in range(int(sys.argv[1])):
    sys.stdout.buffer.write(struct.pack("<6f", *vector(rng), *vector(rng)))
