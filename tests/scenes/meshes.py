"""Scenes about what casts: open, torn, tangled, huge and far meshes, and the many ways in which
glTF can write one. Their lights and eyes are plain.
"""
import math
import struct

from gltf import FAN, FLOAT, STRIP, UBYTE, UINT, VERTICES, pack, png
from shapes import Shape, blob, block, cube, floor, knot_tube, quad, rounded, smooth, sphere
from space import after, turn_x, turn_y, turn_z
from stage import BLUE, GREEN, OCHRE, RED, SAND, SLATE, STONE, WHITE, scene


@scene("zpass", "large", "the eye is above the shadows")
def torus_knot(s):
    """A closed mesh of 4,000 triangles whose silhouette crosses itself again and again."""
    s.ground(5.0)
    knot = knot_tube(2, 3, 1.0, 0.45, 0.24, 250, 8)
    s.thing(smooth(knot, 80.0), s.material(BLUE, 0.6), at=(0.0, 1.25, 0.0), turn=turn_x(25.0))
    s.lamp((2.0, 4.6, 1.2), 60.0, (1.0, 0.92, 0.8))
    s.sun((-1.0, 1.3, 0.5), 0.9, (0.6, 0.75, 1.0))
    s.eye((0.6, 3.9, 5.6), (0.0, 0.7, 0.0), 45.0)


@scene("zpass", "small", "the eye is above the shadows; an unseen caster needs its light cap drawn")
def open_quad(s):
    """Open meshes of one quad: every triangle casts, turned towards the light. One is double-sided;
    of two single-sided ones the first is seen, with one light before and one behind it, and the
    second turns its culled back to the eye: it is not seen, and casts."""
    s.ground(5.0)
    sheet = quad((-0.7, -0.5, 0.0), (0.7, -0.5, 0.0), (0.7, 0.5, 0.0), (-0.7, 0.5, 0.0))
    s.thing(sheet, s.material(RED, both=True), at=(0.1, 1.2, 0.3),
            turn=after(turn_y(20.0), turn_x(-60.0)))
    single = s.mesh(sheet, s.material(OCHRE))
    s.node(mesh=single, at=(-1.7, 0.9, 0.2), turn=after(turn_y(35.0), turn_x(-15.0)))
    s.node(mesh=single, at=(1.9, 0.9, 0.0), turn=turn_y(165.0))
    s.lamp((-0.6, 3.2, 3.0), 30.0, (1.0, 0.9, 0.7))
    s.lamp((0.4, 3.2, -2.6), 24.0, (0.6, 0.75, 1.0))
    s.eye((0.0, 3.4, 5.2), (0.0, 0.5, 0.1), 45.0)


@scene("zpass", "small", "the eye is above the shadows and on the lights' side")
def hole(s):
    """Closed meshes torn open: light falls in through the hole and lights the inside, whose far
    wall casts outwards again."""
    s.ground(4.5)
    ball = sphere(0.9, 36, 18).without(
        lambda c: c[0] * 0.35 + c[1] * 0.75 + c[2] * 0.55 > 0.76)
    s.thing(smooth(ball), s.material(OCHRE, both=True), at=(-0.9, 1.0, 0.2))
    crate = block((-0.6, 0.0, -0.6), (0.6, 1.2, 0.6))
    torn = Shape(crate.points, crate.triangles[:3] + crate.triangles[4:-1])
    s.block_at(torn, BLUE, (1.4, 0.15, 0.2), 30.0, both=True)
    s.lamp((0.5, 4.2, 2.2), 40.0)
    s.sun((-0.8, 1.4, -0.3), 0.8, (0.6, 0.75, 1.0))
    s.eye((0.8, 3.2, 4.8), (0.1, 0.6, 0.1), 42.0)


@scene("zpass", "large", "the eye is above the shadows")
def big_mesh(s):
    """One closed mesh of 70,000 vertices: past what 16-bit indices reach, so that the library has
    to cut it into chunks, and no chunk's border may show."""
    def radius(d):
        return 1.0 + 0.16 * math.sin(3.0 * d[0] + 1.0) * math.sin(4.0 * d[1] + 2.0 * d[2]) \
            + 0.03 * math.sin(9.0 * d[2] - 6.0 * d[0]) * (1.0 - d[1] * d[1])

    s.ground(5.0)
    s.thing(rounded(blob(radius, 350, 201)), s.material(STONE), at=(0.0, 1.35, 0.0))
    s.lamp((2.6, 3.8, 1.4), 40.0, (1.0, 0.92, 0.8))
    s.sun((-0.9, 1.0, 0.6), 0.8, (0.6, 0.75, 1.0))
    s.eye((0.6, 3.2, 5.4), (0.0, 0.8, 0.0), 45.0)


@scene("zpass", "small", "the eye is above the shadows")
def far_away(s):
    """All of it a hundred kilometres from the origin, where floats are steps of 8 mm: nodes must
    be composed in double and the eye taken off first. One caster's nodes partly cancel."""
    root = s.node(name="far", at=(1.0e5, 2.0e4, -1.0e5))
    s.ground(4.5, parent=root)
    s.block_at(cube(0.9), RED, (-1.1, 0.45, 0.3), 25.0, parent=root)
    s.thing(smooth(sphere(0.5, 32, 16)), s.material(OCHRE, 0.6), at=(0.3, 0.9, -0.6), parent=root)
    away = s.node(name="away", at=(3.0e5, 0.0, 7.0e4), turn=turn_y(90.0), parent=root)
    # The quarter turn takes the child's (x, z) to (z, -x).
    s.node(mesh=s.mesh(block((-0.2, 0.0, -0.2), (0.2, 1.7, 0.2)), s.material(BLUE)),
           at=(7.0e4 - 0.6, 0.0, -3.0e5 + 1.4), turn=turn_y(-60.0), parent=away)
    s.lamp((1.6, 3.2, 1.8), 26.0, parent=root)
    s.sun((-0.7, 1.2, 0.4), 0.7, (0.6, 0.75, 1.0), parent=root)
    s.eye((0.4, 3.0, 4.8), (0.1, 0.4, 0.0), 45.0, parent=root)


@scene("zpass", "small", "the eye is above the shadows")
def soup(s):
    """Whatever people load: three quads at one edge, a T, two tetrahedra that share an edge, and a
    leaf with doubled and empty triangles. All of it casts; none of it is a surface."""
    s.ground(5.0)
    # Three quads about one edge, as a book of three pages.
    points = [(0.0, 0.0, 0.0), (0.0, 1.1, 0.0)]
    pages = []
    for i in range(3):
        angle = math.radians(20.0 + 115.0 * i)
        x, z = 0.8 * math.cos(angle), 0.8 * math.sin(angle)
        a = len(points)
        points += [(x, 0.0, z), (x, 1.1, z)]
        pages += [(0, a, a + 1), (0, a + 1, 1)]
    s.block_at(Shape(points, pages), RED, (-1.8, 0.15, 0.8), 10.0, both=True)
    # A T: the stem ends on the middle of the bar, where the bar has vertices, but no edge there.
    tee = Shape([(-0.7, 0.0, 0.0), (0.7, 0.0, 0.0), (0.7, 1.0, 0.0), (-0.7, 1.0, 0.0),
                 (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.8), (0.0, 1.0, 0.8)],
                [(0, 1, 2), (0, 2, 3), (4, 6, 7), (4, 7, 5)])
    s.block_at(tee, BLUE, (0.2, 0.2, -1.0), 25.0, both=True)
    # Two tetrahedra on one edge: four triangles meet there.
    twin = Shape([(0.0, 0.0, -0.5), (0.0, 0.0, 0.5), (-0.8, 0.1, 0.0), (-0.3, 0.9, 0.0),
                  (0.8, 0.1, 0.0), (0.3, 0.9, 0.0)],
                 [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2),
                  (0, 4, 1), (0, 5, 4), (0, 1, 5), (1, 4, 5)])
    s.block_at(twin, OCHRE, (0.5, 0.4, 1.2), 30.0, both=True)
    # A leaf: each half twice, once the other way about; two triangles without area, one of them
    # with a corner named twice, one with three points in a line.
    leaf = Shape([(-0.6, 0.0, -0.4), (0.6, 0.1, -0.4), (0.6, 0.5, 0.4), (-0.6, 0.4, 0.4),
                  (0.0, 0.05, -0.4)],
                 [(0, 1, 2), (0, 2, 3), (0, 1, 2), (0, 3, 2), (1, 1, 2), (0, 4, 1)])
    s.block_at(leaf, GREEN, (1.9, 0.9, 0.0), -15.0, both=True)
    s.lamp((-0.4, 3.6, 2.6), 34.0, (1.0, 0.92, 0.8))
    s.sun((0.9, 1.3, 0.3), 0.8, (0.6, 0.75, 1.0))
    s.eye((0.2, 3.2, 5.4), (0.1, 0.4, 0.2), 42.0)


@scene("zpass", "small", "the eye is above the shadows")
def flattened(s):
    """Transforms without inverse: a floor that is a cube of no height, a cube flattened into a
    plate and one flattened into a wall. They are seen, lit and cast like any sheet,
    though two sheets lie in one place."""
    s.thing(cube(2.0), s.material(SAND, 0.95), scale=(4.0, 0.0, 4.0))
    s.thing(cube(1.4), s.material(RED), at=(-0.9, 1.1, 0.2), turn=turn_z(20.0), scale=(1.0, 0.0, 1.0))
    s.thing(cube(1.4), s.material(BLUE), at=(1.2, 0.75, -0.3), turn=turn_y(35.0),
            scale=(0.0, 1.0, 1.0))
    s.lamp((0.4, 3.2, 1.6), 24.0)
    s.sun((-0.7, 1.0, 0.5), 0.8, (0.6, 0.75, 1.0))
    s.eye((1.2, 3.2, 5.2), (0.0, 0.4, 0.0), 45.0)


@scene("zpass", "small", "the eye is above the shadows")
def many_lights(s):
    """Seven lights, and a pane of glass that is a mesh by itself: no triangle of it is solid."""
    s.ground(4.0)
    s.block_at(cube(0.9), WHITE, (-0.6, 0.45, 0.1), 25.0)
    pane = quad((0.4, 0.1, 0.9), (1.6, 0.1, 0.4), (1.6, 1.3, 0.4), (0.4, 1.3, 0.9))
    s.thing(pane, s.material((0.3, 0.6, 0.7, 0.4), both=True, alpha="BLEND"))
    for i in range(7):
        angle = 2.0 * math.pi * i / 7.0
        color = tuple(0.5 + 0.5 * math.cos(angle - 2.0 * math.pi * k / 3.0) for k in range(3))
        s.lamp((2.6 * math.cos(angle), 1.6 + 0.2 * i, 2.6 * math.sin(angle)), 4.0, color)
    s.eye((0.6, 3.0, 4.8), (0.0, 0.3, 0.0), 42.0)


@scene("zpass", "small", "the eye is above the shadows at every time")
def animated(s):
    """A cube that turns, one that swings under a pivot, and a lamp that moves, in two seconds."""
    s.ground(4.5)
    spin = s.block_at(cube(1.0), RED, (-0.8, 0.75, 0.3))
    pivot = s.node(name="pivot", at=(1.1, 2.4, -0.2))
    s.thing(block((-0.03, -1.6, -0.03), (0.03, 0.0, 0.03)), s.material(SLATE), parent=pivot)
    s.thing(smooth(sphere(0.3, 24, 12)), s.material(OCHRE, 0.6), at=(0.0, -1.8, 0.0), parent=pivot)
    lamp = s.lamp((1.8, 3.4, 1.6), 30.0)
    s.sun((-0.8, 1.4, 0.6), 0.7, (0.6, 0.75, 1.0))
    s.eye((0.4, 3.0, 5.0), (0.1, 0.6, 0.0), 45.0)
    s.animate((spin, "rotation", (0.0, 0.5, 1.0, 1.5, 2.0),
               [after(turn_y(a), turn_x(35.0)) for a in (0.0, 90.0, 180.0, 270.0, 360.0)]),
              (pivot, "rotation", (0.0, 0.5, 1.0, 1.5, 2.0),
               [turn_z(a) for a in (0.0, 25.0, 0.0, -25.0, 0.0)]),
              (lamp, "translation", (0.0, 1.0, 2.0),
               [(1.8, 3.4, 1.6), (-1.6, 3.0, 2.2), (1.8, 3.4, 1.6)]))


@scene("zpass", "small", "the eye is above the shadows")
def textured(s):
    """A texture on the floor, in the .gltf itself as a data URI; smooth normals on a ball."""
    def tile(x, y):
        grout = x % 32 < 2 or y % 32 < 2
        shade = 90 if grout else 170 + 12 * ((x // 32 * 3 + y // 32 * 5) % 7)
        return (shade, shade - 8, shade - 24, 255)

    face = floor(4.5)
    face.uvs = [(u * 3.0, v * 3.0) for u, v in face.uvs]
    tiles = s.texture(png(128, 128, tile), inline=True)
    s.thing(face, s.material((0.9, 0.9, 0.9), 0.8, texture=tiles))
    s.thing(smooth(sphere(0.8, 48, 24)), s.material(RED, 0.6), at=(-0.5, 0.95, 0.0))
    s.block_at(cube(0.8), WHITE, (1.1, 0.4, 0.7), 35.0)
    s.sun((0.8, 1.2, 0.5), 2.0, (1.0, 0.95, 0.85))
    s.lamp((-2.4, 3.0, 1.6), 6.0, (0.6, 0.75, 1.0))
    s.eye((0.6, 2.8, 4.8), (0.0, 0.5, 0.0), 45.0)


@scene("zpass", "small", "the eye is above the shadows; the sheet with holes needs its light cap")
def primitives(s):
    """One mesh in every dialect of glTF: strip, fan, no indices, 8, 16 and 32-bit indices,
    interleaved, normalised and sparse accessors, a texture with holes, glass; and nodes that do
    not cast or do not receive."""
    s.ground(5.0)
    mesh = {"primitives": [strip_wall(s), fan_disc(s), loose_tent(s), interleaved_cube(s),
                           byte_pyramid(s), sparse_step(s), grating(s), glass(s)]}
    s.node(mesh=s.put("meshes", mesh))
    s.block_at(cube(0.6), RED, (-0.4, 0.3, 2.2), 30.0, gnomon={"casts": False})
    s.block_at(block((-0.35, 0.0, -0.35), (0.35, 0.12, 0.35)), GREEN, (1.0, 0.0, 0.9), 10.0,
               gnomon={"receives": False})
    s.block_at(block((-0.08, 0.0, -0.08), (0.08, 1.5, 0.08)), SLATE, (1.55, 0.0, 1.15), 0.0,
               gnomon={"static": True})
    s.lamp((2.6, 3.6, 2.6), 36.0, (1.0, 0.92, 0.8))
    s.sun((-0.6, 1.3, 0.7), 0.7, (0.6, 0.75, 1.0))
    s.eye((0.2, 3.8, 6.0), (0.0, 0.5, 0.1), 42.0)


def strip_wall(s):
    """A wall in waves: a triangle strip of 16-bit indices, double-sided."""
    rows = []
    for i in range(9):
        x, z = -2.6 + 0.22 * i, -1.4 + 0.18 * math.sin(1.4 * i)
        rows += [(x, 0.0, z), (x, 1.2, z)]
    return {"attributes": {"POSITION": s.vertices(rows, bounds=True)}, "mode": STRIP,
            "indices": s.indices(range(len(rows))), "material": s.material(BLUE, both=True)}


def fan_disc(s):
    """A leaning disc: a triangle fan without indices."""
    rows = [(0.0, 1.1, -1.3)]
    for i in range(13):
        angle = math.radians(30.0 * (i % 12))
        rows.append((0.6 * math.cos(angle), 1.1 + 0.6 * math.sin(angle),
                     -1.3 - 0.2 * math.sin(angle)))
    return {"attributes": {"POSITION": s.vertices(rows, bounds=True)}, "mode": FAN,
            "material": s.material(OCHRE, both=True)}


def loose_tent(s):
    """A closed wedge: triangles without indices, so that welding has to find every edge."""
    wedge = block((1.2, 0.0, -1.8), (2.4, 0.9, -1.0))
    points = [(1.8 if y > 0.0 else x, y, z) for x, y, z in wedge.points]
    # Two of the wedge's triangles have no area now; it stays closed with them.
    rows = [points[i] for triangle in wedge.triangles for i in triangle]
    return {"attributes": {"POSITION": s.vertices(rows, bounds=True)},
            "material": s.material(RED)}


def interleaved_cube(s):
    """Positions, normals and colours in one view with a stride of 28: colours are normalised
    bytes, darker towards the foot."""
    shape = smooth(cube(0.7).moved((-1.9, 0.35, 0.6), turn_y(30.0)))
    data = bytearray()
    for point, normal in zip(shape.points, shape.normals):
        grey = 255 if point[1] > 0.5 else 140
        data += struct.pack("<6f4B", *point, *normal, grey, grey, grey, 255)
    view, count = s.view(bytes(data), VERTICES, stride=28), len(shape.points)
    numbers = [corner for triangle in shape.triangles for corner in triangle]
    return {"attributes": {
                "POSITION": s.accessor(view, FLOAT, "VEC3", count, bounds=shape.points),
                "NORMAL": s.accessor(view, FLOAT, "VEC3", count, offset=12),
                "COLOR_0": s.accessor(view, UBYTE, "VEC4", count, offset=24, normalized=True)},
            "indices": s.indices(numbers, UINT), "material": s.material(OCHRE)}


def byte_pyramid(s):
    """A closed pyramid of 8-bit indices."""
    points = [(-0.5, 0.0, -0.1), (0.5, 0.0, -0.1), (0.5, 0.0, 0.9), (-0.5, 0.0, 0.9),
              (0.0, 1.0, 0.4)]
    shape = Shape(points, [(0, 1, 2), (0, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)])
    return s.primitive(shape, s.material(WHITE), UBYTE)


def sparse_step(s):
    """A box whose upper corners are a sparse accessor's over the lower ones' buffer: without the
    replacement it is flat on the floor."""
    shape = block((-1.5, 0.0, 1.5), (-0.9, 0.8, 2.1))
    flat = [(x, 0.0, z) for x, y, z in shape.points]
    high = [i for i, point in enumerate(shape.points) if point[1] > 0.0]
    base = s.view(pack(flat, FLOAT), VERTICES)
    sparse = {"count": len(high),
              "indices": {"bufferView": s.view(pack([high], UBYTE)), "componentType": UBYTE},
              "values": {"bufferView": s.view(pack([shape.points[i] for i in high], FLOAT))}}
    position = s.accessor(base, FLOAT, "VEC3", len(flat), bounds=shape.points, sparse=sparse)
    numbers = [corner for triangle in shape.triangles for corner in triangle]
    return {"attributes": {"POSITION": position}, "indices": s.indices(numbers),
            "material": s.material(STONE)}


def grating(s):
    """A sheet with a checkerboard of holes: seen through, and yet it casts whole."""
    def checker(x, y):
        return (200, 170, 110, 255 if (x // 2 + y // 2) % 2 else 0)

    texture = s.texture(png(16, 16, checker), nearest=True)
    sheet = quad((1.5, 0.1, 0.2), (2.9, 0.1, -0.3), (2.9, 1.3, -0.3), (1.5, 1.3, 0.2))
    return s.primitive(sheet, s.material((1.0, 1.0, 1.0), both=True, texture=texture,
                                         alpha="MASK", cutoff=0.5))


def glass(s):
    """A pane that is drawn last and casts nothing."""
    sheet = quad((0.3, 0.2, 1.9), (1.7, 0.2, 2.2), (1.7, 1.1, 2.2), (0.3, 1.1, 1.9))
    return s.primitive(sheet, s.material((0.3, 0.6, 0.7, 0.35), both=True, alpha="BLEND"))
