"""Writes the rig that `gnomon measure` is run on: python3 rig.py FOLDER

Rautenbach's (2008, chapter 4): a room, one caster in its middle of about 600, 1,600, 5,000 or 9,700
faces, sixteen lamps of which the first so many are taken. FOLDER/rig_600.gltf and the others.
"""
import math
import os
import sys

from shapes import blob, quad
from stage import OCHRE, SAND, STONE, WHITE, Stage

MESHES = {"rig_600": (20, 16), "rig_1600": (32, 26), "rig_5000": (50, 51), "rig_9700": (97, 51)}  # sides, rings
HALF, HEIGHT = 3.0, 3.0


def lump(p):
    """How far a thing that is no ball reaches in a direction."""
    return 0.75 + 0.14 * math.sin(5.0 * p[0] + 1.0) * math.sin(4.0 * p[1] + 2.0) * math.sin(6.0 * p[2] + 3.0)


def room(s):
    """A floor and three walls that face inwards; the fourth is where the eye is."""
    corners = [(-HALF, HALF), (-HALF, -HALF), (HALF, -HALF), (HALF, HALF)]
    s.ground(HALF, color=SAND)
    for (x0, z0), (x1, z1) in zip(corners, corners[1:]):
        s.thing(quad((x0, 0.0, z0), (x1, 0.0, z1), (x1, HEIGHT, z1), (x0, HEIGHT, z0)), s.material(STONE, 0.9))


def fill(s, sides, rings):
    """The room, the caster, the lamps, the eye."""
    room(s)
    s.thing(blob(lump, sides, rings), s.material(OCHRE), at=(0.0, 1.0, 0.0))
    for i in range(16):
        angle = 2.0 * math.pi * (i * 7 % 16) / 16.0  # the first few stand apart
        s.lamp((1.9 * math.cos(angle), 2.1 + 0.5 * (i % 3), 1.9 * math.sin(angle)), 6.0, WHITE)
    s.eye((0.6, 2.0, 6.2), (0.0, 1.0, 0.0), 42.0)


def main(arguments):
    """Each mesh in the same room."""
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print("usage: rig.py FOLDER", file=sys.stderr)
        return 2
    os.makedirs(arguments[0], exist_ok=True)
    for name, (sides, rings) in MESHES.items():
        s = Stage()
        fill(s, sides, rings)
        s.save(arguments[0], name)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
