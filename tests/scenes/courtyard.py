"""The demo: a sundial in a courtyard on a late afternoon. It is the picture that says what the
library is for: the shadow of the gnomon, the part of a sundial that casts it, on the dial.

The dial is right: the style rises towards the pole at the latitude's angle, the hour lines are
drawn by the rule tan(line) = sin(latitude) tan(hour angle), and so the shadow tells the time. All
solids are closed, each thing is a mesh of its own, and columns, pots and lanterns are instances.
Metres; the eye looks along -z; the sun stands to the left and a little behind it.
"""
import math

from gltf import png
from shapes import (bevelled, blob, block, cylinder, joined, lathe, prism, ribbon, rounded, smooth,
                    torus)
from space import turn_y
from stage import scene

LATITUDE = 41.0
NORTH = -4.0  # where the dial's north is, degrees about y from -z
SUN = (-0.916, 0.76, 0.40)
LANTERN = (0.9, 2.6, -6.3)

LIMESTONE = (0.74, 0.65, 0.50)
PLASTER = (0.74, 0.48, 0.26)
MARBLE = (0.88, 0.84, 0.76)
BRONZE = (0.26, 0.15, 0.06)
TERRACOTTA = (0.52, 0.19, 0.09)
SLATE = (0.17, 0.19, 0.22)
LEAF = (0.10, 0.20, 0.06)
WOOD = (0.20, 0.10, 0.05)
STILL = {"static": True}


@scene("zpass", "large", "the eye is in the sun, and the lantern is far under its arch")
def courtyard(s):
    """The README's picture."""
    s.eye((3.1, 2.95, 4.3), (0.5, 1.2, -0.5), 42.0)
    ground(s)
    sundial(s, (1.0, 0.0, 0.6))
    colonnade(s, -4.4)
    arcade(s, -5.2)
    pots(s)
    s.sun(SUN, 3.0, (1.0, 0.82, 0.58), name="sun")
    s.sun((0.75, 1.0, 0.9), 0.5, (0.42, 0.62, 1.0), name="sky")
    s.lamp(LANTERN, 7.0, (1.0, 0.52, 0.2), name="lantern light")


def still(s, shape, material, at=(0.0, 0.0, 0.0), turn=None, name=None):
    """A thing that never moves."""
    return s.thing(shape, material, at=at, turn=turn, name=name, gnomon=STILL)


def flagstones(x, y):
    """A pixel of the paving: rows of stones of unequal length, each of its own shade."""
    row = y // 64
    shift = (row * 52 + 13 * (row % 2)) % 256
    edges = (0, 76, 140, 212) if row % 2 else (0, 92, 158, 256)
    across = (x + shift) % 256
    stone = sum(across >= edge for edge in edges)
    start = edges[stone - 1]
    end = edges[stone] if stone < len(edges) else 256
    gap = min(across - start, end - 1 - across, y % 64, 63 - y % 64)
    grain = (x * 7919 + y * 104729 + (x * y) % 251 * 31) % 17 - 8
    tone = 204 + ((row * 4 + stone) * 37) % 41 - 20 + grain // 2
    if gap < 2:
        tone = 124 + grain // 2
    elif gap < 3:
        tone -= 26
    return (tone, tone * 94 // 100, tone * 83 // 100, 255)


def ground(s):
    """The paving, one closed slab; its texture repeats every 3.2 metres."""
    slab = block((-18.0, -0.3, -9.0), (8.0, 0.0, 9.0))
    slab.uvs = [(x / 3.2, z / 3.2) for x, y, z in slab.points]
    paving = s.texture(png(256, 256, flagstones))
    still(s, slab, s.material((1.0, 0.95, 0.88), 0.9, texture=paving), name="paving")


def sundial(s, at):
    """Two round steps, a pedestal, the plate with its hour lines, the gnomon."""
    stone, marble = s.material(LIMESTONE, 0.9), s.material(MARBLE, 0.7)
    bronze = s.material(BRONZE, 0.6)
    root = s.node(name="sundial", at=at, gnomon=STILL)
    steps = lathe([(1.62, 0.0), (1.62, 0.12), (1.59, 0.15), (1.22, 0.15), (1.22, 0.27),
                   (1.19, 0.30)], 72)
    s.thing(smooth(steps), stone, parent=root, name="steps")
    pedestal = lathe([(0.50, 0.28), (0.50, 0.38), (0.46, 0.40), (0.46, 0.43), (0.40, 0.46),
                      (0.31, 0.50), (0.28, 0.56), (0.30, 0.66), (0.33, 0.76), (0.33, 0.84),
                      (0.29, 0.94), (0.24, 1.00), (0.24, 1.03), (0.29, 1.05), (0.29, 1.08),
                      (0.36, 1.12), (0.50, 1.15), (0.54, 1.17), (0.54, 1.20)], 48)
    s.thing(smooth(pedestal, 35.0), stone, parent=root, name="pedestal")
    top = 1.28
    plate = lathe([(0.84, 1.19), (0.90, 1.21), (0.92, 1.235), (0.92, 1.255), (0.90, top)], 72)
    s.thing(smooth(plate, 50.0), marble, parent=root, name="plate")
    dial = s.node(parent=root, at=(0.0, top, 0.0), turn=turn_y(NORTH), gnomon=STILL)
    s.thing(dial_marks(), bronze, parent=dial, name="hours")
    # The style starts at the foot, south of the middle, and rises northwards, along -z.
    base = 0.54
    height = base * math.tan(math.radians(LATITUDE))
    gnomon = prism([(0.0, -0.01), (base + 0.012, -0.01), (base + 0.012, height)], -0.022, 0.022)
    s.thing(gnomon, bronze, parent=dial, at=(0.0, 0.0, FOOT), turn=turn_y(90.0), name="gnomon")


FOOT = 0.24  # where the style meets the plate, south of its middle


def dial_marks():
    """Hour lines and numerals from five to seven, ticks at the halves, and two rings, all sunk
    into the plate a little, so that no face lies in the plate's own plane."""
    marks = [torus(0.845, 0.010, 72, 6), torus(0.56, 0.007, 72, 6)]
    for half in range(10, 39):
        hour_angle = math.radians(7.5 * half - 180.0)
        tilt = math.sin(math.radians(LATITUDE))
        line = math.atan2(tilt * math.sin(hour_angle), math.cos(hour_angle))
        spoke = turn_y(-math.degrees(line))
        whole = half % 2 == 0
        near, far = (reach(line, r) for r in ((0.73, 0.815) if whole else (0.765, 0.80)))
        bars = [bar((0.0, near), (0.0, far), 0.026 if half == 24 else 0.014 if whole else 0.008)]
        if whole:
            bars += numeral((half // 2 - 1) % 12 + 1, reach(line, 0.60), 0.095)
        marks += [mark.moved((0.0, 0.0, FOOT), spoke) for mark in bars]
    return joined(*marks)


def bar(start, end, width):
    """A flat bar on the plate between two points (right, ahead)."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    shape = block((-width / 2.0, -0.004, -length), (width / 2.0, 0.006, 0.0))
    lean = math.degrees(math.atan2(end[0] - start[0], end[1] - start[1]))
    return shape.moved((start[0], 0.0, -start[1]), turn_y(-lean))


def numeral(hour, foot, height):
    """An hour in Roman numerals, upright for who stands beyond the dial's middle: bars from
    `foot` ahead to foot + height."""
    text = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII")[hour - 1]
    widths = {"I": 0.28, "V": 0.56, "X": 0.56}
    strokes = {"I": ((0.5, 0.0, 0.5, 1.0),), "V": ((0.5, 0.0, 0.1, 1.0), (0.5, 0.0, 0.9, 1.0)),
               "X": ((0.1, 0.0, 0.9, 1.0), (0.9, 0.0, 0.1, 1.0))}
    right = -height * sum(widths[letter] for letter in text) / 2.0
    bars = []
    for letter in text:
        wide = height * widths[letter]
        for x0, y0, x1, y1 in strokes[letter]:
            bars.append(bar((right + wide * x0, foot + height * y0),
                            (right + wide * x1, foot + height * y1), 0.010))
        right += wide
    return bars


def reach(line, radius):
    """How far from the style's foot an hour line meets the circle about the plate's middle."""
    ahead = FOOT * math.cos(line)
    return ahead + math.sqrt(ahead * ahead + radius * radius - FOOT * FOOT)


def doric(height, radius):
    """A fluted column with plinth, base, capital and abacus; solids that run into each other."""
    wide = radius * 1.5
    base = lathe([(radius * 1.28, 0.10), (radius * 1.40, 0.13), (radius * 1.44, 0.17),
                  (radius * 1.38, 0.22), (radius * 1.18, 0.25), (radius * 1.12, 0.29),
                  (radius * 1.06, 0.33)], 36)
    shaft = lathe([(radius, 0.32), (radius * 0.985, height * 0.4), (radius * 0.93, height * 0.7),
                   (radius * 0.86, height - 0.32)], 60, flutes=20, depth=radius * 0.09)
    head = lathe([(radius * 0.90, height - 0.34), (radius * 0.95, height - 0.31),
                  (radius * 0.95, height - 0.28), (radius * 0.88, height - 0.26),
                  (radius * 0.92, height - 0.20), (radius * 1.12, height - 0.15),
                  (radius * 1.30, height - 0.11)], 36)
    return joined(smooth(bevelled((-wide, 0.0, -wide), (wide, 0.12, wide), 0.015), 20.0),
                  smooth(base, 35.0), smooth(shaft, 20.0), smooth(head, 35.0),
                  smooth(bevelled((-wide, height - 0.12, -wide), (wide, height, wide), 0.015),
                         20.0))


def colonnade(s, x):
    """A row of columns under a lintel, on the sun's side: the shadows across the court."""
    stone = s.material(LIMESTONE, 0.9)
    column = s.mesh(doric(3.0, 0.23), stone)
    still(s, bevelled((x - 0.55, 0.0, -5.6), (x + 0.55, 0.16, 6.4), 0.02), stone, name="kerb")
    for i in range(5):
        s.node(mesh=column, at=(x, 0.15, -4.3 + 2.0 * i), gnomon=STILL)
    lintel = ribbon([(0.30, 3.14), (0.30, 3.42), (0.34, 3.42), (0.34, 3.58), (0.46, 3.64),
                     (0.46, 3.74)],
                    [(-0.30, 3.14), (-0.30, 3.42), (-0.34, 3.42), (-0.34, 3.58), (-0.46, 3.64),
                     (-0.46, 3.74)], -5.55, 6.3)
    still(s, lintel.inward(), stone, at=(x, 0.0, 0.0), name="lintel")


def arcade(s, z):
    """Arches on columns under a storey of wall, two steps up; behind them a walk with a back
    wall, where the sun draws the arches again."""
    stone, plaster = s.material(LIMESTONE, 0.9), s.material(PLASTER, 0.95)
    bays, bay, radius, spring = 5, 2.2, 0.86, 2.35
    left = -4.6
    for i in range(2):
        still(s, bevelled((left - 0.6, -0.02, z - 3.2), (7.0, 0.16 * (i + 1), z + 1.2 - 0.4 * i),
                          0.02), stone, name="step")
    floor_y = 0.32
    edge = []
    for i in range(bays):
        middle = left + bay * (i + 0.5)
        for k in range(17):
            angle = math.pi * (1.0 - k / 16.0)
            edge.append((middle + radius * math.cos(angle), spring + radius * math.sin(angle)))
    edge = [(left - 0.4, spring)] + edge + [(left + bay * bays + 1.2, spring)]
    wall = ribbon([(x, 5.6) for x, y in edge], edge, -0.24, 0.24)
    still(s, wall, plaster, at=(0.0, 0.0, z), name="facade")
    arch = ring_arch(radius - 0.02, radius + 0.15)
    arch = s.mesh(smooth(arch, 30.0), stone)
    column = s.mesh(tuscan(spring - floor_y, 0.15), stone)
    for i in range(bays):
        s.node(mesh=arch, at=(left + bay * (i + 0.5), spring, z), gnomon=STILL)
    for i in range(bays + 1):
        s.node(mesh=column, at=(left + bay * i, floor_y - 0.01, z), gnomon=STILL)
    # The house across the way, low and far enough to let the sun in.
    still(s, block((-15.0, 0.0, z - 8.0), (-14.0, 6.0, 8.0)), plaster, name="house")
    still(s, bevelled((left - 0.5, 3.55, z + 0.1), (7.0, 3.72, z + 0.36), 0.02), stone,
          name="string course")
    still(s, block((-14.5, 0.0, z - 3.0), (8.0, 3.6, z - 2.7)), plaster, name="back wall")
    still(s, block((left - 3.0, 3.5, z - 2.8), (8.0, 3.7, z + 0.1)), s.material(WOOD),
          name="ceiling")
    still(s, bevelled((0.25, 0.3, z - 2.75), (1.55, 2.45, z - 2.64), 0.02), stone, name="door case")
    still(s, bevelled((0.4, 0.3, z - 2.75), (1.4, 2.3, z - 2.61), 0.01), s.material(WOOD, 0.7),
          name="door")
    lantern(s, LANTERN, 3.55)


def ring_arch(inner, outer):
    """A half ring of stones over an arch, proud of the wall on both sides."""
    angles = [math.pi * k / 20.0 for k in range(21)]
    return ribbon([(inner * math.cos(a), inner * math.sin(a)) for a in angles],
                  [(outer * math.cos(a), outer * math.sin(a)) for a in angles], -0.29, 0.29)


def tuscan(height, radius):
    """A plain round column with a swelling, a base and a capital, in one profile."""
    profile = [(1.45, 0.0), (1.5, 0.03), (1.5, 0.07), (1.4, 0.10), (1.15, 0.13), (1.08, 0.18),
               (1.0, 0.24)]
    profile += [(1.0, height * 0.35), (0.96, height * 0.6), (0.86, height - 0.30)]
    profile += [(0.95, height - 0.28), (0.95, height - 0.25), (0.87, height - 0.23),
                (0.9, height - 0.16), (1.15, height - 0.12), (1.35, height - 0.10)]
    wide = radius * 1.5
    return joined(smooth(lathe([(r * radius, y) for r, y in profile], 32), 35.0),
                  smooth(bevelled((-wide, height - 0.11, -wide), (wide, height + 0.02, wide),
                                  0.012), 20.0))


def lantern(s, at, ceiling):
    """An open lantern on a rod: a cap, a dish and four posts about the light."""
    iron = s.material(BRONZE, 0.7)
    cap = lathe([(0.17, 0.16), (0.18, 0.18), (0.05, 0.28), (0.03, 0.32)], 16)
    dish = lathe([(0.06, -0.21), (0.13, -0.18), (0.13, -0.16)], 16)
    posts = [block((-0.008, -0.17, -0.008), (0.008, 0.17, 0.008)).moved(
        (0.115 * math.cos(a), 0.0, 0.115 * math.sin(a)))
        for a in (math.pi * (0.25 + 0.5 * k) for k in range(4))]
    rod = cylinder(0.012, 0.31, ceiling - at[1], 8)
    still(s, joined(cap, dish, rod, *posts), iron, at=at, name="lantern")


def pots(s):
    """Pots with clipped bushes: one by the columns, two before the door."""
    clay = s.material(TERRACOTTA, 0.85)
    pot = s.mesh(smooth(lathe([(0.20, 0.0), (0.22, 0.03), (0.22, 0.06), (0.25, 0.10),
                               (0.33, 0.30), (0.36, 0.44), (0.34, 0.52), (0.32, 0.55),
                               (0.39, 0.57), (0.40, 0.60), (0.39, 0.63), (0.34, 0.63),
                               (0.32, 0.57)], 36), 35.0), clay)

    def clipped(d):
        return 0.40 + 0.008 * math.sin(17.0 * d[0] + 3.0) * math.sin(15.0 * d[1]) \
            * math.sin(19.0 * d[2] + 1.0)

    bush = s.mesh(rounded(blob(clipped, 40, 24)), s.material(LEAF, 0.95))
    for x, y, z, size in ((-2.5, 0.0, -2.1, 1.0), (0.35, 0.0, -3.35, 1.0), (2.1, 0.0, -3.35, 1.0)):
        place = s.node(at=(x, y, z), scale=(size, size, size), turn=turn_y(70.0 * x),
                       gnomon=STILL)
        s.node(mesh=pot, parent=place, gnomon=STILL)
        s.node(mesh=bush, parent=place, at=(0.0, 0.86, 0.0), gnomon=STILL)
