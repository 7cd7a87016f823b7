"""Scenes about where things are: the light, the eye, the near and far planes, and the casters
between them. Their meshes are plain; what is hard about each is said in its docstring.
"""
from shapes import (Shape, block, cube, cylinder, lathe, open_box, ribbon, smooth, sphere, torus)
from space import after, turn_x, turn_y, turn_z
from stage import BLUE, GREEN, OCHRE, RED, SLATE, STONE, WHITE, scene


def lone_cube(s):
    """One cube standing on a floor, and the eye that the first three scenes share."""
    s.ground(4.0)
    s.block_at(cube(1.2), RED, (0.0, 0.6, 0.0), 28.0)
    s.eye((2.6, 2.9, 4.6), (-0.2, 0.4, 0.0))


@scene("zpass", "small", "the eye is above the shadow")
def cube_point(s):
    """The least that casts: a closed cube, a point light, a floor."""
    lone_cube(s)
    s.lamp((1.7, 2.6, -0.5), 30.0)


@scene("zpass", "small", "the eye is above the shadow")
def cube_spot(s):
    """A spot light's shadow is a point light's; only the shading ends at the cone."""
    lone_cube(s)
    s.spot((2.4, 3.2, -0.6), (-0.2, 0.3, 0.0), 60.0, (18.0, 26.0))


@scene("zpass", "small", "the eye is above the shadow")
def cube_sun(s):
    """A light at infinity: every extruded vertex goes the same way."""
    lone_cube(s)
    s.sun((1.0, 0.9, -0.3))


@scene("zpass", "small", "all lights are above or behind the casters as the eye sees them")
def colours(s):
    """Four lights, each with its own mask; where shadows cross, colours mix."""
    s.ground(5.0, color=STONE)
    s.block_at(cube(0.9), WHITE, (-1.3, 0.45, 0.3), 20.0)
    s.thing(smooth(sphere(0.55, 32, 16)), s.material(WHITE, 0.6), at=(0.2, 0.55, 1.0))
    s.thing(smooth(lathe([(0.55, 0.0), (0.0, 1.5)], 32)), s.material(WHITE), at=(1.4, 0.0, -0.2))
    s.thing(smooth(torus(0.55, 0.2, 32, 16)), s.material(WHITE), at=(-0.1, 0.75, -1.1),
            turn=turn_x(75.0))
    s.sun((0.3, 1.0, -0.8), 0.4, (0.5, 0.6, 1.0))
    s.lamp((-3.2, 3.0, 1.0), 14.0, (1.0, 0.25, 0.15))
    s.lamp((3.4, 2.6, 1.6), 14.0, (0.2, 1.0, 0.3))
    s.spot((0.4, 3.6, 3.2), (0.0, 0.3, 0.0), 24.0, (24.0, 32.0), (1.0, 0.7, 0.15))
    s.eye((0.0, 3.6, 5.2), (0.0, 0.3, 0.0), 42.0)


@scene("nozpass", "small", "the whole near rectangle is in the canopy's shadow")
def camera_in_shadow(s):
    """The eye stands in the shadow of a canopy and looks out at what is lit: counts from the eye
    start at one, not nought."""
    s.ground(7.0)
    s.thing(block((-2.4, 2.6, 0.0), (2.4, 2.8, 5.4)), s.material(SLATE))
    for x in (-2.1, 2.1):
        s.thing(block((x - 0.12, 0.0, 0.2), (x + 0.12, 2.6, 0.44)), s.material(STONE))
    s.block_at(cube(1.0), RED, (-1.4, 0.5, -0.7), 30.0)
    s.block_at(cylinder(0.35, 0.0, 1.6), BLUE, (1.6, 0.0, -1.0))
    s.lamp((0.6, 6.0, -1.0), 60.0)
    s.eye((0.2, 1.5, 4.6), (0.0, 0.8, 0.0), 50.0)


@scene("nozpass", "small", "the near rectangle is partly in, partly out of two posts' shadows")
def near_cuts_volume(s):
    """The near plane is far out and cuts shadow volumes, so that some pixels count from inside and
    their neighbours from outside."""
    s.ground(5.0)
    s.block_at(block((-0.14, 0.0, -0.14), (0.14, 3.2, 0.14)), OCHRE, (1.75, 0.0, 1.3), 15.0)
    s.block_at(block((-0.2, 0.0, -0.2), (0.2, 2.6, 0.2)), BLUE, (0.6, 0.0, 0.5), 40.0)
    s.block_at(cube(0.8), RED, (-1.4, 0.4, 0.2), 25.0)
    s.lamp((-0.6, 2.9, -2.0), 40.0)
    s.eye((2.2, 2.0, 4.6), (-0.1, 0.6, 0.0), 50.0, near=1.2)


@scene("zpass", "small", "the eye is above the line from the light over the rim")
def open_container(s):
    """A light inside an open box of thick walls: it is within the caster's bounds, so that a fan
    for a dark cap is wholly wrong, though the lit directions leave a half space free."""
    s.ground(5.5)
    s.thing(open_box(1.0, 1.0, 0.14, 0.12), s.material(OCHRE), turn=turn_y(18.0))
    s.thing(block((-5.5, 0.0, -4.6), (5.5, 4.6, -4.3)), s.material(STONE))
    s.thing(block((-4.6, 0.0, -4.3), (-4.3, 4.6, 5.5)), s.material(STONE))
    s.block_at(block((-0.3, 0.0, -0.3), (0.3, 3.0, 0.3)), BLUE, (1.9, 0.0, -2.2), 30.0)
    s.block_at(cube(0.7), RED, (-0.7, 2.3, -0.9), 35.0)
    s.lamp((0.15, 0.8, 0.1), 20.0)
    s.eye((3.6, 4.4, 5.4), (-0.8, 1.0, -0.8), 50.0)


@scene("nozpass", "small", "the eye is in the box's shadow, as is all the world")
def closed_box(s):
    """A light inside a closed box that faces outwards: no triangle of the box is lit, and yet all
    cast. Outside, that light must be dark everywhere; a second light shows the scene."""
    s.ground(5.0)
    s.block_at(block((-0.8, 0.0, -0.6), (0.8, 1.2, 0.6)), OCHRE, (-0.4, 0.15, 0.0), 24.0)
    s.block_at(cube(0.7), BLUE, (1.4, 0.35, 1.0), 50.0)
    s.lamp((-0.3, 0.8, 0.1), 0.2, (1.0, 0.4, 0.3))
    s.lamp((1.6, 3.6, -1.4), 40.0)
    s.eye((2.4, 3.2, 4.6), (0.0, 0.5, 0.1), 45.0)


def room(s):
    """A room of single-sided walls that face inwards, furnished; a lamp in it, the sun outside."""
    s.ground(8.0, y=-0.4, color=SLATE)
    walls = block((-3.0, 0.0, -2.4), (3.0, 2.8, 2.4)).inward()
    s.thing(walls, s.material(WHITE, 0.95))
    s.thing(block((-0.9, 0.75, -0.5), (0.9, 0.85, 0.5)), s.material(OCHRE), at=(0.6, 0.0, -0.7))
    for x in (-0.8, 0.8):
        for z in (-0.4, 0.4):
            s.thing(block((-0.05, 0.0, -0.05), (0.05, 0.75, 0.05)), s.material(OCHRE),
                    at=(0.6 + x, 0.0, z - 0.7))
    s.thing(smooth(sphere(0.22, 24, 12)), s.material(RED, 0.6), at=(0.3, 1.07, -0.6))
    s.block_at(cube(0.8), BLUE, (-1.7, 0.4, 0.4), 32.0)
    s.lamp((-0.3, 2.3, 0.5), 14.0, (1.0, 0.9, 0.75))
    s.sun((0.5, 1.0, 0.9), 3.0)


@scene("nozpass", "small", "the eye is inside the room, in the shadow that it casts for the sun")
def room_eye_in(s):
    """Walls that face inwards cast for the sun outside: by lit triangles alone the far walls would
    cast and the near ones not. For the lamp nothing of the room is in the way."""
    room(s)
    s.eye((2.2, 1.7, 1.8), (-0.4, 0.8, -0.8), 65.0, near=0.05)


@scene("nozpass", "small", "for the lamp the eye is in the shadow of walls that it looks through")
def room_eye_out(s):
    """The eye outside sees through the culled near walls; they cast, though nothing of them is in
    the depth buffer: caps at z = w in their place would be wrong."""
    room(s)
    s.eye((4.2, 5.2, 6.4), (0.0, 0.5, 0.0), 45.0)


@scene("nozpass", "small", "the near rectangle is in the ball's shadow")
def towards_light(s):
    """Looking at a light past a caster whose shadow comes over the eye; volumes run through the
    eye's own plane, where x / w changes sign."""
    s.ground(6.0)
    s.thing(smooth(sphere(0.75, 40, 20)), s.material(RED, 0.6), at=(0.1, 1.35, 1.4))
    s.block_at(block((-0.25, 0.0, -0.25), (0.25, 1.6, 0.25)), BLUE, (-1.9, 0.0, 0.2), 20.0)
    s.block_at(cube(0.8), OCHRE, (1.7, 0.4, -0.4), 30.0)
    s.block_at(cylinder(0.25, 0.0, 1.9), WHITE, (0.9, 0.0, -2.6))
    s.lamp((-0.2, 1.6, -2.6), 16.0)
    s.eye((0.4, 1.25, 5.2), (-0.1, 0.9, 0.0), 45.0)


@scene("zpass", "small", "the near rectangle is above the casters and on the lights' side")
def ortho(s):
    """An orthographic camera cannot image points at infinity: volumes end on planes. One caster is
    higher than the point light, so that part of its volume rises and never meets the floor."""
    s.ground(5.0)
    s.block_at(block((-0.3, 0.0, -0.3), (0.3, 3.6, 0.3)), BLUE, (-1.2, 0.0, -1.0), 25.0)
    s.block_at(cube(0.9), RED, (0.7, 0.45, 0.6), 40.0)
    s.thing(smooth(sphere(0.5, 32, 16)), s.material(OCHRE, 0.6), at=(-1.0, 0.5, 1.4))
    s.sun((1.0, 1.6, 0.4), 2.0, (1.0, 0.95, 0.85))
    s.lamp((1.1, 2.4, 1.9), 14.0, (0.7, 0.8, 1.0))
    s.flat_eye((4.0, 5.0, 6.0), (-0.3, 1.0, 0.1), 3.1, 0.1, 20.0)


@scene("zpass", "small", "the near rectangle is within the cone that leaves the container")
def ortho_container(s):
    """Orthographic, and a light inside an open container: neither a fan nor an end on a plane
    parallel to the floor can close the volume where the light is below the rim."""
    s.ground(4.0)
    s.thing(open_box(1.1, 0.9, 0.15, 0.12), s.material(OCHRE), turn=turn_y(27.0))
    s.thing(smooth(sphere(0.25, 32, 16)), s.material(RED, 0.6), at=(-0.45, 0.37, 0.0))
    s.block_at(block((-0.25, 0.0, -0.25), (0.25, 2.4, 0.25)), BLUE, (-1.9, 0.0, -1.1), 20.0)
    s.block_at(block((-0.2, 0.0, -0.2), (0.2, 1.5, 0.2)), GREEN, (1.9, 0.0, -0.9), 40.0)
    s.lamp((0.25, 0.6, 0.15), 8.0)
    s.flat_eye((1.2, 7.0, 4.5), (0.0, 0.4, -0.1), 2.6, 0.1, 16.0)


@scene("zpass", "small", "the near rectangle is above the casters and the lamp")
def ortho_wide(s):
    """Orthographic over a floor a hundred times as wide as what is seen, with a lamp just above it:
    where the floor's own volume ends decides how much depth is left for everything else."""
    s.ground(500.0)
    s.block_at(cube(0.8), RED, (0.9, 0.4, 0.2), 30.0)
    s.block_at(block((-0.2, 0.0, -0.2), (0.2, 1.8, 0.2)), BLUE, (-1.2, 0.0, 0.6), 15.0)
    s.lamp((0.1, 0.02, 1.3), 1.5)
    s.lamp((-0.6, 1.4, -1.2), 4.0, (0.6, 0.75, 1.0))
    s.flat_eye((2.5, 5.0, 5.0), (0.0, 0.4, 0.2), 2.2, 0.1, 40.0)


@scene("zpass", "small", "the eye is above the shadows")
def zfar(s):
    """A far plane that cuts the floor and a wall: what is beyond is not seen, but its shadows come
    back into view; and shadow volumes go on behind the far plane."""
    s.ground(6.0)
    s.block_at(block((-1.6, 0.0, -0.12), (1.6, 1.3, 0.12)), RED, (1.4, 0.0, -1.0), 55.0)
    s.block_at(cube(0.8), BLUE, (-1.3, 0.4, 1.5), 20.0)
    s.block_at(block((-0.3, 0.0, -0.3), (0.3, 4.0, 0.3)), OCHRE, (-1.6, 0.0, -4.6), 10.0)
    s.sun((-0.3, 0.75, -1.0), 2.0, (1.0, 0.9, 0.75))
    s.lamp((3.6, 3.4, 2.4), 16.0, (0.6, 0.75, 1.0))
    s.eye((0.6, 3.2, 5.4), (-0.1, 0.5, 0.0), 48.0, far=7.4)


@scene("zpass", "large", "the eye is above the plates' shadows")
def two_lamps_nested(s):
    """Ten layers of shadow over one another, twice: a stack of plates under two lamps. Counts
    grow with every layer, and each plate is receiver and caster at once."""
    s.ground(4.5)
    plate = s.mesh(block((-0.9, -0.03, -0.6), (0.9, 0.03, 0.6)), s.material(OCHRE))
    for i in range(10):
        s.node(mesh=plate, at=(-0.2, 0.25 + 0.22 * i, 0.0), turn=turn_y(9.0 * i))
    s.thing(block((-0.06, 0.0, -0.06), (0.06, 2.6, 0.06)), s.material(SLATE), at=(-0.2, 0.0, 0.0))
    s.block_at(cube(0.5), BLUE, (-1.7, 0.25, 1.1), 20.0)
    s.lamp((1.4, 3.8, 1.0), 34.0, (1.0, 0.9, 0.7))
    s.lamp((-2.2, 3.4, 1.4), 18.0, (0.5, 0.7, 1.0))
    s.eye((1.6, 3.3, 5.0), (-0.2, 0.8, 0.0), 45.0)


@scene("zpass", "small", "no caster is between the eye and a light")
def flat_light(s):
    """Lights exactly in the planes of a cube's faces, all on whole numbers: the first in the plane
    of the top, the second on the line of an edge, in two planes at once. The facing of such a
    triangle may be decided either way, but once. The eye is in no plane of a side: what depth a
    side has that is seen exactly edge-on is a matter of rounding, by any method."""
    s.ground(7.0)
    s.thing(block((-1.0, 0.0, -1.0), (1.0, 2.0, 1.0)), s.material(RED))
    s.thing(block((-3.0, 0.0, 2.0), (-2.0, 1.0, 3.0)), s.material(BLUE))
    s.lamp((4.0, 2.0, 0.0), 24.0, (1.0, 0.85, 0.6))
    s.lamp((1.0, 2.0, 5.0), 16.0, (0.6, 0.8, 1.0))
    s.lamp((1.0, 6.0, 3.0), 20.0)
    s.eye((6.0, 4.1, 9.0), (-0.5, 0.8, 0.5), 40.0)


@scene("zpass", "small", "the lights are behind the eye, and nothing is between them and it")
def behind_eye(s):
    """Lights behind the camera: shadows run away from the viewer, silhouettes hide their own
    volumes, and the light has a negative depth."""
    s.ground(6.0)
    s.thing(block((-6.0, 0.0, -4.2), (6.0, 3.5, -4.0)), s.material(STONE))
    s.block_at(cube(1.0), RED, (-1.2, 0.5, 0.0), 30.0)
    s.thing(smooth(torus(0.6, 0.22, 40, 20)), s.material(OCHRE, 0.6), at=(0.7, 0.85, 0.6),
            turn=after(turn_y(30.0), turn_x(80.0)))
    s.block_at(cylinder(0.3, 0.0, 1.8), BLUE, (1.9, 0.0, -1.2))
    s.sun((-0.9, 1.1, 1.3), 1.6, (1.0, 0.9, 0.7))
    s.lamp((3.4, 4.2, 8.0), 70.0, (0.7, 0.8, 1.0))
    s.eye((0.4, 2.2, 5.4), (0.0, 0.8, 0.0), 48.0)


@scene("zpass", "small", "the eye is on the lights' side, far from the shadows")
def transforms(s):
    """Mirrored, unevenly scaled, nested and sheared: one mesh with a handedness, an L with a spike,
    under eight transforms. A mirror turns winding about, and with it inside and outside."""
    s.ground(6.0)
    mesh = s.mesh(elbow(), s.material(OCHRE))
    s.node(mesh=mesh, at=(-2.0, 0.0, 1.4))
    s.node(mesh=mesh, at=(2.0, 0.0, 1.4), scale=(-1.0, 1.0, 1.0))
    s.node(mesh=mesh, at=(-0.2, 1.4, 1.6), scale=(1.0, -0.8, 1.0), turn=turn_y(40.0))
    s.node(mesh=mesh, at=(-2.4, 0.5, -1.4), scale=(-0.7, -0.7, -0.7), turn=turn_x(-60.0))
    s.node(mesh=mesh, at=(0.2, 0.0, -1.2), scale=(0.5, 1.9, 0.7), turn=turn_y(-30.0))
    nest = s.node(name="nest", at=(2.4, 0.3, -1.2), scale=(1.6, 0.8, 0.7), turn=turn_y(25.0))
    inner = s.node(parent=nest, turn=after(turn_z(25.0), turn_y(40.0)), scale=(1.0, 1.0, -1.0))
    s.node(parent=inner, mesh=mesh, at=(0.0, 0.3, 0.0), turn=turn_x(20.0))
    # A matrix that shears and mirrors, columns first.
    s.node(mesh=mesh, matrix=[-0.8, 0.0, 0.2, 0.0, 0.4, 0.9, 0.0, 0.0, 0.0, 0.0, 0.8, 0.0,
                              0.9, 0.0, 3.0, 1.0])
    s.lamp((0.8, 5.0, 3.0), 50.0)
    s.sun((-0.9, 1.2, 0.5), 0.7, (0.6, 0.75, 1.0))
    s.eye((0.4, 4.6, 7.4), (0.1, 0.3, 0.3), 42.0)


def elbow():
    """A closed L whose upright ends in a slant: it differs from its mirror image."""
    shape = ribbon([(0.3, 1.0), (0.3, 0.3), (0.9, 0.3)], [(0.0, 1.0), (0.0, 0.0), (0.9, 0.0)],
                   -0.2, 0.2)
    points = [(x, y + 0.5 if y > 0.9 and z > 0.0 else y, z) for x, y, z in shape.points]
    return Shape(points, shape.triangles)
