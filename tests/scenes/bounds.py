"""Scenes of many lights that reach so far and no farther: by range, by cone, by falloff, behind
walls, out of view. What a light cannot reach costs nothing, and no pixel of the frame tells.
"""
from shapes import block, cube, cylinder, joined, smooth, sphere
from stage import BLUE, GREEN, OCHRE, RED, SAND, SLATE, STONE, WHITE, scene


def column(s, x, z, height=2.4):
    s.thing(smooth(cylinder(0.18, 0.0, height, 20)), s.material(STONE), at=(x, 0.0, z))


@scene("nozpass", "large", "the near lamps' columns shadow the eye")
def hall(s):
    """A hall of columns with a lamp in each bay: ten lamps with a range, the farthest a few pixels,
    two behind the eye."""
    s.thing(block((-3.0, 0.0, -26.0), (3.0, 3.2, 5.0)).inward(), s.material(SAND))
    for bay in range(10):
        z = 2.0 - 2.8 * bay
        for x in (-1.7, 1.7):
            column(s, x, z - 1.4, 3.2)
        s.block_at(cube(0.5), (RED, BLUE, GREEN)[bay % 3], (0.9 - 0.3 * (bay % 4), 0.25, z), 17.0 * bay)
        s.lamp((-0.5 + 0.4 * (bay % 3), 2.5, z), 5.0, ((1.0, 0.8, 0.5), (0.7, 0.9, 1.0))[bay % 2],
               range=3.4)
    s.eye((0.3, 1.6, 1.2), (-0.1, 1.2, -4.0), 55.0)


@scene("zpass", "large", "the eye is above the lamps' shadows")
def street(s):
    """A street at night: eight lamps that point down, cones side by side, over parked blocks."""
    s.ground(16.0, color=SLATE)
    for i in range(8):
        x, z = -2.2 + 4.4 * (i % 2), 2.5 - 3.0 * (i // 2)
        s.thing(joined(block((-0.05, 0.0, -0.05), (0.05, 3.0, 0.05)).moved((x * 1.25, 0.0, z)),
                       block((-0.3, 2.94, -0.06), (0.3, 3.0, 0.06)).moved((x * 1.12, 0.0, z))),
                s.material(STONE))
        s.block_at(block((-0.45, 0.0, -0.8), (0.45, 0.6, 0.8)), (RED, BLUE, WHITE, OCHRE)[i % 4],
                   (x * 0.55, 0.0, z + 0.4), 8.0 * i)
        s.spot((x * 0.98, 2.9, z), (x * 0.9, 0.0, z), 24.0, (24.0, 36.0), (1.0, 0.85, 0.6), range=6.0)
    s.eye((0.6, 4.6, 8.2), (-0.2, 0.2, -1.0), 45.0)


@scene("zpass", "small", "the eye is above the shadows")
def torches(s):
    """Five torches, each a flame in its own shaft's way: the shaft does not shadow its flame, and it
    shadows the others'."""
    s.ground(4.0)
    colors = ((1.0, 0.6, 0.3), (0.5, 0.7, 1.0), (0.6, 1.0, 0.6), (1.0, 0.9, 0.5), (0.9, 0.5, 0.9))
    for i, (x, z) in enumerate(((-1.6, 0.8), (1.5, 0.9), (0.0, -1.3), (-1.9, -1.6), (2.0, -1.5))):
        shaft = s.thing(smooth(cylinder(0.09, 0.0, 1.05, 16)), s.material(OCHRE), at=(x, 0.0, z))
        s.lamp((x, 1.0, z), 3.0, colors[i], range=3.0, gnomon={"exempt": [shaft]})
    s.block_at(cube(0.6), RED, (0.2, 0.3, 0.5), 30.0)
    s.thing(smooth(sphere(0.3, 24, 12)), s.material(WHITE), at=(-0.7, 0.3, -0.3))
    s.eye((0.6, 3.6, 4.6), (0.0, 0.3, -0.3), 46.0)


@scene("zpass", "small", "the eye is above the shadows")
def dim_lights(s):
    """Six lamps of no range: four so dim that falloff alone bounds them, one out of view, one that
    no bit of the frame shows."""
    s.ground(5.0)
    for i in range(4):
        x, z = -2.1 + 1.4 * i, 0.9 - 0.8 * (i % 2)
        s.block_at(cube(0.4), (RED, BLUE, GREEN, OCHRE)[i], (x, 0.2, z), 20.0 * i)
        s.lamp((x + 0.35, 0.7, z + 0.2), 0.02, (1.0, 0.9, 0.8))
    s.lamp((0.6, 1.0, 9.0), 0.05)
    s.lamp((-1.2, 0.9, 0.2), 1e-9)
    s.lamp((1.0, 4.0, 1.5), 12.0)
    s.eye((0.3, 2.8, 4.6), (0.0, 0.2, 0.0), 46.0)


@scene("nozpass", "large", "walls and desks are between the lamps and the eye")
def offices(s):
    """Six rooms in two rows, open to the eye above, each with a lamp that reaches its own walls and
    a little of its neighbours' floor."""
    s.ground(9.0, 7.0, color=SLATE)
    for i in range(4):
        x = -6.0 + 4.0 * i
        s.thing(block((x - 0.08, 0.0, -4.0), (x + 0.08, 2.0, 4.0)), s.material(WHITE))
    for z in (-4.0, 0.0, 4.0):
        s.thing(block((-6.0, 0.0, z - 0.08), (6.0, 2.0, z + 0.08)), s.material(SAND))
    for i in range(6):
        x, z = -4.0 + 4.0 * (i % 3), -2.0 + 4.0 * (i // 3)
        s.block_at(joined(block((-0.8, 0.7, -0.4), (0.8, 0.76, 0.4)),
                          block((-0.75, 0.0, -0.35), (-0.65, 0.7, 0.35)),
                          block((0.65, 0.0, -0.35), (0.75, 0.7, 0.35))), OCHRE, (x, 0.0, z), 25.0 * i)
        s.block_at(cube(0.4), (RED, BLUE, GREEN)[i % 3], (x + 1.1, 0.2, z + 1.1), 40.0)
        s.lamp((x - 0.5, 1.7, z + 0.3), 4.0, ((1.0, 0.9, 0.7), (0.8, 0.9, 1.0))[i % 2], range=3.2)
    s.eye((3.0, 9.5, 9.0), (0.0, 0.0, 0.3), 48.0)


@scene("zpass", "large", "the eye is above the lamps")
def runway(s):
    """Sixteen low lamps along a runway, each a small pool of light, most of them far off."""
    s.ground(6.0, 40.0, color=SLATE)
    for i in range(16):
        x, z = (-1.6, 1.6)[i % 2], 4.0 - 4.2 * (i // 2)
        s.thing(smooth(cylinder(0.12, 0.0, 0.25, 12)), s.material(WHITE), at=(x, 0.0, z))
        s.block_at(block((-0.15, 0.0, -0.3), (0.15, 0.5, 0.3)), (RED, OCHRE, BLUE)[i % 3],
                   (x * 0.55, 0.0, z - 0.5), 30.0 * i)
        s.lamp((x, 0.6, z), 1.2, ((1.0, 0.9, 0.6), (0.6, 1.0, 0.7))[i % 2], range=2.2)
    s.eye((0.4, 3.4, 9.0), (0.0, 0.0, -4.0), 42.0)


@scene("zpass", "small", "the eye is above the shadows")
def coplanar(s):
    """Everything twice in the same place, and a mat in the plane of the floor: whichever is drawn
    first is seen; added up, light comes twice."""
    mat = s.mesh(block((-0.9, -0.3, -0.7), (0.9, 0.0, 0.7)), s.material(SLATE))
    box = s.mesh(cube(0.8), s.material(RED))
    for _ in range(2):
        s.ground(3.5)
        s.node(mesh=box, at=(-0.6, 0.4, -0.5))
    s.node(mesh=mat, at=(0.7, 0.0, 0.7))
    s.lamp((1.2, 3.0, -0.4), 20.0)
    s.sun((-0.4, 1.0, 0.7), 0.5)
    s.eye((1.0, 3.0, 4.2), (0.0, 0.2, 0.0), 45.0)
