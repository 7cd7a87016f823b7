"""Piles: closed lumps in a cube over a floor, lamps around them; what volumes cost is measured on such a pile
(tests/support/pile.h), and what each saves must not change what is right.
"""
import math

from shapes import blob, floor, smooth
from space import turn_y
from stage import SAND, STONE, scene


def lump(direction):
    """The radius of hills and hollows."""
    x, y, z = direction
    return 0.42 + 0.08 * math.sin(5 * x + 1) * math.sin(4 * y + 2) * math.sin(6 * z + 3)


def pile(s, side, lamps, sectors, rings):
    """side * side * side lumps of extent 1, spaced 1.5, and lamps that stand around them."""
    extent = 1.5 * side
    middle = 0.75 * (side - 1)
    half = 4.0 * side + 6.0
    mesh = s.mesh(smooth(blob(lump, sectors, rings)), s.material(STONE))
    s.thing(floor(half), s.material(SAND, 0.95))
    for i in range(side ** 3):
        s.node(mesh=mesh, turn=turn_y(39.0 * i),
               at=(1.5 * (i % side) - middle, 0.9 + 1.5 * (i // side % side), 1.5 * (i // side // side) - middle))
    for i in range(lamps):
        angle, radius = 2 * math.pi * i / lamps + 0.3, 0.8 * extent + 1.6
        s.lamp((radius * math.cos(angle), 1.05 * extent + 2.2, radius * math.sin(angle)), 30.0)
    s.eye((0.45 * extent + 0.5, 0.65 * extent + 1.2, 1.2 * extent + 1.6), (0.0, 0.45 * extent, 0.0), 45.0, 0.1, 100.0)


@scene("zpass", "large", "the lamps stand behind the lumps as the eye sees them, or above it")
def pile_of_8(s):
    """Eight lumps of 3,696 triangles, two lamps."""
    pile(s, 2, 2, 44, 43)


@scene("zpass", "small", "the lamps stand behind the lumps as the eye sees them, or above it")
def pile_of_27(s):
    """Twenty-seven lumps of 480 triangles, four lamps."""
    pile(s, 3, 4, 16, 16)
