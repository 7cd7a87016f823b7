"""Procedural meshes: everything that stands in the scenes, made from a few numbers.

A Shape is points and triangles, counter-clockwise seen from outside; solids are closed, every edge
shared by exactly two triangles, so that they take the library's fast path. Without normals a
reader shades flat; smooth() adds normals, splitting vertices at creases and nowhere else.
"""
import math

from space import add, cross, dot, mul, sub, turned, unit


class Shape:
    """Points, triangles of their numbers, and per point perhaps normals and texture coordinates."""

    def __init__(self, points, triangles, normals=None, uvs=None):
        self.points, self.triangles = list(points), list(triangles)
        self.normals, self.uvs = normals, uvs

    def moved(self, at=(0.0, 0.0, 0.0), turn=None, scale=(1.0, 1.0, 1.0)):
        """A copy scaled, then turned, then moved. Before smooth(), so that there are no normals
        to care for; the scale is positive."""
        points = [(p[0] * scale[0], p[1] * scale[1], p[2] * scale[2]) for p in self.points]
        if turn:
            points = [turned(p, turn) for p in points]
        return Shape([add(p, at) for p in points], self.triangles, None, self.uvs)

    def inward(self):
        """A copy that faces the other way: a box becomes a room."""
        return Shape(self.points, [(a, c, b) for a, b, c in self.triangles], None, self.uvs)

    def without(self, drop):
        """A copy that lacks the triangles whose centre satisfies drop(centre)."""
        def centre(triangle):
            a, b, c = (self.points[i] for i in triangle)
            return mul(add(add(a, b), c), 1.0 / 3.0)
        kept = [t for t in self.triangles if not drop(centre(t))]
        return Shape(self.points, kept, self.normals, self.uvs)


def joined(*shapes):
    """Several shapes as one mesh (of several parts, to the library)."""
    points, triangles, normals, uvs = [], [], [], []
    for shape in shapes:
        first = len(points)
        points += shape.points
        triangles += [(a + first, b + first, c + first) for a, b, c in shape.triangles]
        normals += shape.normals or []
        uvs += shape.uvs or []
    whole = len(points)
    return Shape(points, triangles, normals if len(normals) == whole else None,
                 uvs if len(uvs) == whole else None)


def smooth(shape, crease=40.0):
    """Normals averaged over the faces around a point, except across edges sharper than `crease`
    degrees; a point on such an edge becomes several at one place."""
    faces = []
    around = [[] for _ in shape.points]
    for number, triangle in enumerate(shape.triangles):
        a, b, c = (shape.points[i] for i in triangle)
        faces.append(unit(cross(sub(b, a), sub(c, a))))
        for i in range(3):
            p, q, r = (shape.points[triangle[(i + k) % 3]] for k in range(3))
            spread = dot(unit(sub(q, p)), unit(sub(r, p)))
            around[triangle[i]].append((number, math.acos(max(-1.0, min(1.0, spread)))))
    limit = math.cos(math.radians(crease))
    made, points, normals, uvs, triangles = {}, [], [], [], []
    for number, triangle in enumerate(shape.triangles):
        corners = []
        for i in triangle:
            total = (0.0, 0.0, 0.0)
            for other, angle in around[i]:
                if dot(faces[number], faces[other]) >= limit:
                    total = add(total, mul(faces[other], angle))
            normal = unit(total) if dot(total, total) > 0.0 else (0.0, 1.0, 0.0)
            key = (i,) + tuple(round(x, 5) for x in normal)
            if key not in made:
                made[key] = len(points)
                points.append(shape.points[i])
                normals.append(normal)
                if shape.uvs:
                    uvs.append(shape.uvs[i])
            corners.append(made[key])
        triangles.append(tuple(corners))
    return Shape(points, triangles, normals, uvs or None)


def rounded(shape):
    """Normals averaged over all faces around each point: smooth() for what has no creases."""
    totals = [(0.0, 0.0, 0.0)] * len(shape.points)
    for triangle in shape.triangles:
        a, b, c = (shape.points[i] for i in triangle)
        face = cross(sub(b, a), sub(c, a))
        for i in triangle:
            totals[i] = add(totals[i], face)
    return Shape(shape.points, shape.triangles, [unit(total) for total in totals], shape.uvs)


def quad(a, b, c, d):
    """A quad, counter-clockwise seen from its front; texture coordinates from 0 to 1."""
    return Shape([a, b, c, d], [(0, 1, 2), (0, 2, 3)],
                 uvs=[(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)])


def floor(half, half_z=None, y=0.0):
    """A horizontal quad that faces upwards."""
    z = half if half_z is None else half_z
    return quad((-half, y, z), (half, y, z), (half, y, -z), (-half, y, -z))


def convex(points, polygons):
    """A convex solid: polygons in any order of winding are turned outward."""
    middle = mul(tuple(sum(p[k] for p in points) for k in range(3)), 1.0 / len(points))
    triangles = []
    for polygon in polygons:
        a, b, c = (points[i] for i in polygon[:3])
        if dot(cross(sub(b, a), sub(c, a)), sub(a, middle)) < 0.0:
            polygon = polygon[::-1]
        triangles += [(polygon[0], polygon[k], polygon[k + 1]) for k in range(1, len(polygon) - 1)]
    return Shape(points, triangles)


def block(low, high):
    """A box from corner to corner."""
    points = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
              for z in (low[2], high[2])]
    return convex(points, [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4),
                           (1, 3, 7, 5)])


def cube(side=1.0):
    """A cube about the origin."""
    half = side / 2.0
    return block((-half, -half, -half), (half, half, half))


def bevelled(low, high, bevel):
    """A box whose edges and corners are cut by `bevel`."""
    points, number = [], {}
    for corner in range(8):
        for axis in range(3):  # the corner's point on the face across `axis`
            point = []
            for k in range(3):
                top = corner >> k & 1
                inset = 0.0 if k == axis else bevel
                point.append(high[k] - inset if top else low[k] + inset)
            number[corner, axis] = len(points)
            points.append(tuple(point))
    polygons = [tuple(number[corner, axis] for axis in range(3)) for corner in range(8)]
    for axis in range(3):
        u, v = 1 << (axis + 1) % 3, 1 << (axis + 2) % 3
        for side in (0, 1 << axis):
            polygons.append(tuple(number[side | c, axis] for c in (0, u, u | v, v)))
        for other in (0, u, v, u | v):  # the four edges along `axis`
            ends = (other, other | 1 << axis)
            p, q = (axis + 1) % 3, (axis + 2) % 3
            polygons.append((number[ends[0], p], number[ends[1], p],
                             number[ends[1], q], number[ends[0], q]))
    return convex(points, polygons)


def open_box(half, height, wall, base):
    """A box without a lid whose walls and floor have thickness; it stands on y = 0."""
    def ring(h, y):
        return [(-h, y, h), (h, y, h), (h, y, -h), (-h, y, -h)]

    points = (ring(half, 0.0) + ring(half, height) + ring(half - wall, height) +
              ring(half - wall, base))
    triangles = [(0, 2, 1), (0, 3, 2), (12, 13, 14), (12, 14, 15)]
    for row in (0, 4, 8):
        for i in range(4):
            a, b = row + i, row + (i + 1) % 4
            triangles += [(a, b, b + 4), (a, b + 4, a + 4)]
    return Shape(points, triangles)


def lathe(profile, sides, flutes=0, depth=0.0):
    """A solid of revolution about y from (radius, height) pairs, foot to head; ends that are not
    on the axis are closed by discs. flutes: so many grooves, `depth` deep, between the ends."""
    profile = list(profile)
    if profile[0][0] > 0.0:
        profile.insert(0, (0.0, profile[0][1]))
    if profile[-1][0] > 0.0:
        profile.append((0.0, profile[-1][1]))
    points, rows = [], []
    for radius, y in profile:
        rows.append([])
        for j in range(sides if radius > 0.0 else 1):
            angle = 2.0 * math.pi * j / sides
            r = radius - depth * (0.5 - 0.5 * math.cos(flutes * angle))
            rows[-1].append(len(points))
            points.append((r * math.cos(angle), y, r * math.sin(angle)) if radius > 0.0 else
                          (0.0, y, 0.0))
    triangles = []
    for low, high in zip(rows, rows[1:]):
        for j in range(sides):
            a, b = low[j % len(low)], low[(j + 1) % len(low)]
            c, d = high[j % len(high)], high[(j + 1) % len(high)]
            if a != b:
                triangles.append((a, c, b))
            if c != d:
                triangles.append((b, c, d))
    return Shape(points, triangles)


def cylinder(radius, low, high, sides=24):
    return lathe([(radius, low), (radius, high)], sides)


def sphere(radius, sides=24, rings=12):
    """A sphere about the origin."""
    return blob(lambda direction: radius, sides, rings)


def blob(radius, sides, rings):
    """A closed surface about the origin; radius(direction) is its distance there."""
    points = [(0.0, -radius((0.0, -1.0, 0.0)), 0.0)]
    for i in range(1, rings):
        up = math.pi * (i / rings - 0.5)
        for j in range(sides):
            angle = 2.0 * math.pi * j / sides
            direction = (math.cos(up) * math.cos(angle), math.sin(up),
                         math.cos(up) * math.sin(angle))
            points.append(mul(direction, radius(direction)))
    points.append((0.0, radius((0.0, 1.0, 0.0)), 0.0))
    top, triangles = len(points) - 1, []
    for j in range(sides):
        k = (j + 1) % sides
        triangles.append((0, 1 + j, 1 + k))
        for i in range(rings - 2):
            a, b = 1 + i * sides + j, 1 + i * sides + k
            triangles += [(a, a + sides, b), (b, a + sides, b + sides)]
        last = 1 + (rings - 2) * sides
        triangles.append((last + j, top, last + k))
    return Shape(points, triangles)


def tube(along, steps, sides):
    """A closed tube: along(t), t from 0 to 1, gives a centre and the two vectors that span the
    cross-section there; their cross product points along the direction of travel."""
    points, triangles = [], []
    for i in range(steps):
        centre, u, v = along(i / steps)
        for j in range(sides):
            angle = 2.0 * math.pi * j / sides
            points.append(add(centre, add(mul(u, math.cos(angle)), mul(v, math.sin(angle)))))
    for i in range(steps):
        for j in range(sides):
            k = (j + 1) % sides
            a, b = i * sides + j, i * sides + k
            c, d = (i + 1) % steps * sides + j, (i + 1) % steps * sides + k
            triangles += [(a, b, c), (b, d, c)]
    return Shape(points, triangles)


def torus(big, small, steps=24, sides=12):
    """A ring about y."""
    def along(t):
        angle = 2.0 * math.pi * t
        out = (math.cos(angle), 0.0, math.sin(angle))
        return mul(out, big), mul(out, small), (0.0, small, 0.0)
    return tube(along, steps, sides)


def knot_tube(p, q, big, small, thick, steps, sides):
    """A tube of radius `thick` along the (p, q) knot on the torus (big, small) about y. The
    torus's own normal frames the cross-section, so that the tube closes without a twist."""
    def place(t):
        a, b = 2.0 * math.pi * p * t, 2.0 * math.pi * q * t
        ring = (math.cos(a), 0.0, math.sin(a))
        out = add(mul(ring, math.cos(b)), (0.0, math.sin(b), 0.0))
        return add(mul(ring, big), mul(out, small)), out

    def along(t):
        centre, out = place(t)
        ahead = unit(sub(place(t + 1e-4)[0], place(t - 1e-4)[0]))
        u = unit(sub(out, mul(ahead, dot(out, ahead))))
        return centre, mul(u, thick), mul(cross(ahead, u), thick)
    return tube(along, steps, sides)


def ribbon(inner, outer, low, high):
    """A solid whose cross-section in x, y lies between two polylines of the same length, inner to
    the left of outer when walking along them from above; it reaches from z = low to z = high.
    Where both polylines meet in a point the section ends in an edge."""
    count = len(inner)
    points = [(x, y, z) for line in (inner, outer) for z in (low, high) for x, y in line]
    il, ih, ol, oh = (k * count for k in range(4))
    triangles = []
    for i in range(count - 1):
        j = i + 1
        for a, b, c, d in ((ih + i, oh + i, oh + j, ih + j), (ol + i, il + i, il + j, ol + j),
                           (oh + i, ol + i, ol + j, oh + j), (il + i, ih + i, ih + j, il + j)):
            triangles += [(a, b, c), (a, c, d)]
    last = count - 1
    triangles += [(il, ol, oh), (il, oh, ih)]
    triangles += [(ol + last, il + last, ih + last), (ol + last, ih + last, oh + last)]
    return Shape(points, triangles)


def prism(outline, low, high):
    """A convex outline in x, y, drawn out from z = low to z = high."""
    count = len(outline)
    points = [(x, y, z) for z in (low, high) for x, y in outline]
    sides = [(i, (i + 1) % count, (i + 1) % count + count, i + count) for i in range(count)]
    return convex(points, [tuple(range(count)), tuple(range(count, 2 * count))] + sides)
