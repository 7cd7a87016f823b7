"""Scenes at the edge of what numbers hold: lights on vertices, edges and faces, at the eye, inside what
is closed, very near and very far; near planes of a ten-thousandth with a floor a hundred thousand
wide; slivers, T-junctions, edges of many faces, a Moebius strip, what passes through each other; the
eye in the plane of a side; transforms that all but flatten.
"""
import math

from shapes import Shape, block, cube, joined, quad, smooth, sphere
from space import after, turn_x, turn_y, turn_z
from stage import BLUE, GREEN, OCHRE, RED, STONE, WHITE, scene

EYE, TARGET = (2.6, 2.9, 4.6), (-0.2, 0.4, 0.0)


def things(s, half=4.0):
    """A block on whole numbers, a ball, a floor: what the lights below are on and in."""
    s.ground(half)
    s.thing(block((-1.0, 0.0, -1.0), (0.0, 1.0, 0.0)), s.material(RED))
    s.thing(smooth(sphere(0.4, 24, 12)), s.material(BLUE), at=(0.9, 0.4, 0.6))


@scene("nozpass", "extreme", "some lights are among the casters")
def lights_touching(s):
    """Lights a ten-thousandth off a face, on a vertex, on an edge, in a face's plane, on a face."""
    things(s)
    s.lamp((-0.5, 1.0001, -0.5), 0.1)
    s.lamp((0.0, 1.0, 0.0), 4.0)
    s.lamp((-0.5, 1.0, 0.0), 4.0)
    s.lamp((1.5, 1.0, -1.5), 6.0)
    s.lamp((-0.5, 1.0, -0.5), 0.5)
    s.eye(EYE, TARGET)


@scene("nozpass", "extreme", "some lights are among the casters")
def lights_far_and_in(s):
    """Lights at the eye, inside a closed mesh, a million away, at infinity in a face's plane, and at
    infinity along an edge."""
    things(s)
    s.lamp(EYE, 30.0)
    s.lamp((-0.5, 0.5, -0.5), 1.0)
    s.lamp((6e5, 7e5, 3e5), 1e12)
    s.sun((1.0, 1.0, 0.0))
    s.sun((0.0, 1.0, 0.0))
    s.eye(EYE, TARGET)


def near(s, distance, half):
    things(s, half)
    s.lamp((1.7, 2.6, -0.5), 30.0)
    s.sun((0.6, 1.0, -0.5), 0.6)
    s.eye(EYE, TARGET, near=distance)


@scene("zpass", "extreme", "the eye is above the shadows")
def near_tiny(s):
    """A near plane of a ten-thousandth: all that is seen has the last few hundred depths."""
    near(s, 1e-4, 4.0)


@scene("zpass", "extreme", "the eye is above the shadows")
def near_tiny_wide(s):
    """The same before a floor a hundred thousand wide: its corners are so far that a float cannot
    tell their depth from infinity, and no depth buffer holds them. The plan must warn."""
    near(s, 1e-4, 1e5)


@scene("zpass", "extreme", "the eye is above the shadows")
def near_small_wide(s):
    """That floor again, the near plane at a tenth."""
    near(s, 0.1, 1e5)


@scene("zpass", "extreme", "the eye is above the shadows")
def near_large(s):
    """A near plane at ten, the casters behind it, a wall four thousand away."""
    things(s, 1e5)
    s.thing(block((-3000.0, 0.0, -9000.0), (3000.0, 900.0, -8900.0)), s.material(STONE))
    s.lamp((1.7, 2.6, -0.5), 30.0)
    s.sun((0.6, 1.0, -0.5), 0.6)
    s.eye((6.0, 7.0, 11.0), (-0.2, 0.4, 0.0), 20.0, near=10.0)


@scene("zpass", "extreme", "the eye is above the shadows")
def slivers(s):
    """Triangles a hundred thousand times as long as they are wide: a strip of needles, a fan whose
    blades all but vanish, a box of such a shape."""
    s.ground(4.0)
    needles = []
    for i in range(12):
        x, y = -1.6 + 0.12 * i, 0.8 + 0.02 * i
        needles.append(Shape([(x, y, -1.2), (x + 2.4e-5, y, -1.2), (x, y + 0.1, 1.2)], [(0, 1, 2)]))
    s.thing(joined(*needles), s.material(OCHRE, both=True))
    points = [(1.2, 1.0, 0.0)]
    for i in range(41):
        angle = math.radians(2.0 * i) if i < 40 else math.radians(200.0)
        points.append((1.2 + 0.7 * math.cos(angle), 1.0, 0.7 * math.sin(angle)))
    s.thing(Shape(points, [(0, i + 2, i + 1) for i in range(40)]), s.material(BLUE, both=True))
    s.thing(block((-0.6, 0.0, 1.2), (1.6, 0.7, 1.2 + 2.2e-5)), s.material(RED))
    s.lamp((0.6, 3.2, -1.4), 26.0)
    s.sun((0.4, 1.0, 0.5), 0.6)
    s.eye(EYE, TARGET)


@scene("zpass", "extreme", "the eye is above the shadows")
def t_junctions(s):
    """A wall whose two halves meet along an edge that one of them has in two pieces, the middle off
    by a rounding; and a floor cut so."""
    third = 1.0 / 3.0
    wall = Shape([(-1.2, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.3, 0.0), (-1.2, 1.3, 0.0), (1.2, 0.0, 0.4),
                  (1.2, 1.3, 0.4), (0.0, 1.3 * third, 0.0)],
                 [(0, 1, 2), (0, 2, 3), (1, 4, 6), (4, 5, 6), (6, 5, 2)])
    s.ground(4.0)
    s.thing(wall, s.material(OCHRE, both=True))
    s.block_at(cube(0.5), RED, (1.2, 0.25, 1.4), 20.0)
    s.lamp((0.7, 2.6, -1.9), 26.0)
    s.sun((-0.5, 1.0, -0.8), 0.6)
    s.eye(EYE, TARGET)


@scene("zpass", "extreme", "the eye is above the shadows")
def many_faces(s):
    """Edges of three, four and seven faces: fins about a common edge, and a box with a wall in it."""
    s.ground(4.0)
    points, triangles = [(-1.0, 0.2, 0.0), (-1.0, 1.5, 0.0)], []
    for i in range(7):
        angle = 2.0 * math.pi * i / 7.0
        n = len(points)
        points += [(-1.0 + 0.6 * math.cos(angle), 0.2, 0.6 * math.sin(angle)),
                   (-1.0 + 0.6 * math.cos(angle), 1.5, 0.6 * math.sin(angle))]
        triangles += [(0, n, n + 1), (0, n + 1, 1)]
    s.thing(Shape(points, triangles), s.material(OCHRE, both=True))
    box = block((0.4, 0.2, -0.4), (1.2, 1.0, 0.4))
    wall = Shape(box.points, box.triangles + [(0, 3, 7), (0, 7, 4)])
    s.thing(wall, s.material(BLUE, both=True))
    s.lamp((0.3, 3.1, 1.2), 26.0)
    s.sun((-0.5, 1.0, -0.8), 0.6)
    s.eye(EYE, TARGET)


@scene("zpass", "extreme", "the eye is above the shadows")
def moebius(s):
    """A strip with one side: no way to wind it alike."""
    points, triangles = [], []
    for i in range(48):
        u = 2.0 * math.pi * i / 48.0
        for side in (-0.3, 0.3):
            r = 0.9 + side * math.cos(u / 2.0)
            points.append((r * math.cos(u), 0.9 + side * math.sin(u / 2.0), r * math.sin(u)))
    for i in range(48):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i < 47 else (1, 0)
        triangles += [(a, c, d), (a, d, b)]
    s.ground(4.0)
    s.thing(Shape(points, triangles), s.material(OCHRE, both=True))
    s.lamp((0.8, 3.2, -1.2), 26.0)
    s.sun((-0.5, 1.0, 0.8), 0.6)
    s.eye(EYE, TARGET)


@scene("zpass", "extreme", "the eye is above the shadows")
def interpenetrating(s):
    """Casters through each other and through the floor, open and closed, as objects and as one
    mesh."""
    s.ground(4.0)
    s.block_at(cube(1.0), RED, (-0.9, 0.3, 0.2), 25.0)
    s.thing(smooth(sphere(0.6, 32, 16)), s.material(BLUE), at=(-0.5, 0.5, 0.5))
    both = joined(block((0.5, -0.3, -0.8), (1.3, 0.9, 0.0)), block((0.2, 0.1, -0.5), (1.6, 0.5, -0.3)),
                  block((0.8, 0.3, -1.4), (1.0, 0.6, 0.8)))
    s.thing(both, s.material(OCHRE))
    s.thing(quad((0.0, 0.2, 1.0), (1.4, 1.2, 1.0), (1.4, 1.2, 1.8), (0.0, 0.2, 1.8)),
            s.material(GREEN, both=True))
    s.thing(quad((0.0, 1.2, 1.1), (1.4, 0.2, 1.1), (1.4, 0.2, 1.7), (0.0, 1.2, 1.7)),
            s.material(WHITE, both=True))
    s.lamp((1.7, 3.2, -0.6), 26.0)
    s.sun((-0.5, 1.0, 0.8), 0.6)
    s.eye(EYE, TARGET)


@scene("nozpass", "extreme", "the eye is in the plane of sides")
def eye_on_side(s):
    """The eye lies exactly in planes through a light and edges of a block: of the lamp's volume, of
    the sun's, and in the block's own faces' planes."""
    s.ground(6.0)
    s.thing(block((-1.0, 0.0, -1.0), (1.0, 2.0, 1.0)), s.material(RED))
    s.thing(block((2.0, 0.0, -3.0), (3.0, 1.0, -2.0)), s.material(BLUE))
    s.lamp((-3.0, 4.0, -1.0), 40.0)  # over the edge z = 1: its side has the eye's height and more
    s.lamp((1.0, 6.0, -3.0), 40.0)   # in the plane x = 1, and the eye too
    s.sun((0.0, 1.0, -1.0), 0.7)     # its sides along x = 1 too
    s.eye((1.0, 3.0, 7.0), (0.0, 0.8, 0.0), 45.0)


@scene("zpass", "extreme", "the eye is above the shadows")
def nearly_singular(s):
    """Transforms that all but flatten: to a ten-millionth along an axis, a sheared one, a tiny and
    a mirrored one of a huge mesh."""
    s.ground(4.0)
    ball, box = s.mesh(smooth(sphere(0.6, 24, 12)), s.material(BLUE, both=True)), \
        s.mesh(cube(1.0), s.material(RED, both=True))
    s.node(mesh=ball, at=(-1.0, 0.8, 0.2), turn=turn_x(25.0), scale=(1.0, 1e-7, 1.0))
    s.node(mesh=box, at=(0.6, 0.7, -0.6), turn=after(turn_y(30.0), turn_z(50.0)), scale=(1.2, 1e-6, 0.8))
    s.node(mesh=box, matrix=[0.6, 0.0, 0.0, 0.0, 0.6, 1e-6, 0.0, 0.0, 0.0, 0.3, 0.6, 0.0,
                             1.0, 0.5, 1.2, 1.0])
    huge = s.mesh(cube(1e6), s.material(OCHRE))
    s.node(mesh=huge, at=(-0.9, 0.25, 1.5), scale=(-5e-7, 5e-7, 5e-7), turn=turn_y(20.0))
    s.lamp((0.7, 3.1, -1.3), 26.0)
    s.sun((-0.5, 1.0, 0.8), 0.6)
    s.eye(EYE, TARGET)


@scene("zpass", "extreme", "the eye is above the shadows")
def fence(s):
    """A fence whose posts and rails are a pixel wide at 320x240, in one mesh, askew; beside it rods
    that are meshes of their own: small masks may miss them, and their shadows."""
    wide, high = 0.016, 0.9
    posts = [block((0.3 * i, 0.0, 0.0), (0.3 * i + wide, high, wide)) for i in range(-5, 6)]
    rails = [block((-1.6, y, 0.0), (1.6, y + wide, wide)) for y in (0.3, 0.7)]
    s.ground(4.0)
    s.thing(joined(*posts, *rails), s.material(OCHRE), turn=turn_y(17.0))
    for i in range(4):
        s.thing(block((0.0, 0.0, 0.0), (wide, 1.1, wide)), s.material(BLUE), at=(0.5 * i - 0.6, 0.0, 1.2),
                turn=after(turn_y(31.0 * i), turn_z(20.0)))
    s.block_at(cube(0.6), RED, (1.3, 0.3, -1.2), 30.0)
    s.lamp((1.7, 2.6, -2.2), 30.0)
    s.sun((0.6, 1.0, -0.7), 0.6)
    s.eye(EYE, TARGET)
