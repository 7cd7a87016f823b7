"""Scenes of more layers of shadow than eight bits of stencil count: 256 volumes around a point look
like none to a count that wraps, and every 256th step of a stair would be lit.
"""
import math

from shapes import Shape, block, cube, joined, prism, quad
from stage import BLUE, OCHRE, RED, STONE, scene

LAMP = (0.0, 4.0, 0.0)


def sheets(count):
    """Flat sheets over each other, each as wide as the lamp's pyramid through the first: all their
    shadows on the floor have one and the same outline."""
    out = []
    for i in range(count):
        y = 1.0 + 0.4 * i / count
        half = 0.35 * (LAMP[1] - y) / (LAMP[1] - 1.0)
        out.append(quad((-half, y, -half), (-half, y, half), (half, y, half), (half, y, -half)))
    return out


def under_sheets(s):
    s.ground(3.0)
    s.block_at(cube(0.5), RED, (1.1, 0.25, 0.5), 30.0)
    s.lamp(LAMP, 26.0)
    s.eye((1.8, 2.9, 4.2), (0.0, 0.4, 0.0), 42.0)


@scene("zpass", "extreme", "the eye is above the shadows")
def nest_255(s):
    """As many volumes around the floor's middle as eight bits tell from none."""
    under_sheets(s)
    s.thing(joined(*sheets(255)), s.material(OCHRE, both=True))


@scene("zpass", "extreme", "the eye is above the shadows")
def nest_256(s):
    """One more: all in one mesh, which is cut into chains that each keep within the bits."""
    under_sheets(s)
    s.thing(joined(*sheets(256)), s.material(OCHRE, both=True))


@scene("zpass", "extreme", "the eye is above the shadows")
def nest_257(s):
    """One more again, each sheet a caster of its own."""
    under_sheets(s)
    material = s.material(OCHRE, both=True)
    for sheet in sheets(257):
        s.thing(sheet, material)


STEPS, RUN, RISE = 300, 0.2, 0.1


def stair_light(s):
    """The lamp rests atop the stair, just under the line of the steps' edges: that line, and all
    that is under it down the stair, is behind every edge. The eye is at the 256th step."""
    s.lamp((-RUN * 0.3, RISE * 0.1, 0.0), 900.0)
    x, y = RUN * 256.0, -RISE * 256.0
    s.eye((x + 1.9, y + 1.5, 1.6), (x, y, 0.0), 40.0)


@scene("nozpass", "extreme", "the eye is above the stair, but the edges of its treads are in it")
def stairs(s):
    """300 steps as one closed mesh."""
    outline = [(-1.0, 0.0)]
    for i in range(STEPS):
        outline += [(RUN * i, -RISE * i), (RUN * i, -RISE * (i + 1))]
    bottom = -RISE * STEPS
    outline += [(RUN * STEPS, bottom), (RUN * STEPS, bottom - 1.0), (-1.0, bottom - 1.0)]
    s.thing(upright(outline), s.material(STONE))
    stair_light(s)


@scene("nozpass", "extreme", "as for the stair in one piece")
def stairs_apart(s):
    """300 steps, each a closed block and a caster."""
    material = s.material(STONE)
    for i in range(STEPS):
        s.thing(block((RUN * (i - 1), -RISE * (i + 3), -0.8), (RUN * i, -RISE * i, 0.8)), material)
    stair_light(s)


def upright(outline):
    """A prism along z over an outline in x and y, its steps' faces quads: no triangle is longer than
    a step, and there is none in the two ends, which are open: nothing is seen of them."""
    points, triangles = [], []
    for x, y in outline:
        points += [(x, y, -0.8), (x, y, 0.8)]
    for i in range(len(outline)):
        a, b = 2 * i, 2 * ((i + 1) % len(outline))
        triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    return Shape(points, triangles)


@scene("zpass", "extreme", "the eye is above the shadows")
def helix(s):
    """A ramp of 256 turns: one sheet that hangs together and nests by itself, so that it must be
    cut through. The sun is right above, and all turns have one shadow."""
    points, triangles = [], []
    turns, segments = 256, 16
    for i in range(turns * segments + 1):
        angle, y = 2.0 * math.pi * i / segments, 0.9 + 0.3 * i / (turns * segments)
        for radius in (0.25, 0.7):
            points.append((radius * math.cos(angle), y, radius * math.sin(angle)))
    for i in range(turns * segments):
        a = 2 * i
        triangles += [(a, a + 2, a + 3), (a, a + 3, a + 1)]
    s.ground(3.0)
    s.block_at(cube(0.5), BLUE, (1.5, 0.25, 0.6), 30.0)
    s.thing(Shape(points, triangles), s.material(OCHRE, both=True))
    s.sun((0.0, 1.0, 0.0))
    s.eye((1.4, 3.4, 4.0), (0.1, 0.3, 0.0), 42.0)


SLATS, PITCH = 300, 0.1


def slat(i):
    return block((-0.6, 1.0, -PITCH * i - 0.04), (0.6, 1.3, -PITCH * i))


def along_the_slats(s):
    """Slats side by side under a sun that stands almost above: no two volumes meet, but the eye looks
    along the row under them, through all, at a wall that one block shadows."""
    far = -PITCH * SLATS - 1.0
    s.thing(quad((-3.0, -1.0, far), (3.0, -1.0, far), (3.0, 3.0, far), (-3.0, 3.0, far)), s.material(STONE))
    s.block_at(cube(0.5), RED, (0.3, 1.1, far + 0.6), 30.0)
    s.sun((0.25, 1.0, 0.3))
    s.eye((0.0, 0.45, 2.5), (0.0, 0.4, far), 5.0)


@scene("zpass", "extreme", "the eye is before all shadows")
def slats(s):
    """300 of them in one mesh: more fronts and more backs over a pixel than a channel counts."""
    s.thing(joined(*[slat(i) for i in range(SLATS)]), s.material(OCHRE))
    along_the_slats(s)


@scene("zpass", "extreme", "the eye is before all shadows")
def slats_apart(s):
    """300 casters: batches, though none lies in another's shadow."""
    material = s.material(OCHRE)
    for i in range(SLATS):
        s.thing(slat(i), material)
    along_the_slats(s)
