"""Vectors and turns: the little geometry that meshes and nodes share.

Points and vectors are tuples of three floats, turns are unit quaternions (x, y, z, w) as glTF
writes them. y is up; cameras and lights look along their own -z, as glTF says.
"""
import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    """The unit vector along `a`, or zero for a zero vector."""
    length = math.sqrt(dot(a, a))
    return mul(a, 1.0 / length) if length > 0.0 else (0.0, 0.0, 0.0)


def turn(axis, degrees):
    """A turn about `axis`, counter-clockwise for who looks against it."""
    axis = unit(axis)
    half = math.radians(degrees) / 2.0
    return mul(axis, math.sin(half)) + (math.cos(half),)


def turn_x(degrees):
    return turn((1.0, 0.0, 0.0), degrees)


def turn_y(degrees):
    return turn((0.0, 1.0, 0.0), degrees)


def turn_z(degrees):
    return turn((0.0, 0.0, 1.0), degrees)


def after(second, first):
    """The turn that does `first`, then `second`."""
    x1, y1, z1, w1 = second
    x2, y2, z2, w2 = first
    return (w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
            w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
            w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
            w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2)


def turned(point, q):
    """`point` after the turn q."""
    axis = q[:3]
    t = mul(cross(axis, point), 2.0)
    return add(add(point, mul(t, q[3])), cross(axis, t))


def looking(eye, target, up=(0.0, 1.0, 0.0)):
    """The turn of a camera or light at `eye` whose -z points at `target`."""
    back = unit(sub(eye, target))
    if abs(dot(back, unit(up))) > 0.999999:
        up = (0.0, 0.0, -1.0)
    right = unit(cross(up, back))
    above = cross(back, right)
    m = (right, above, back)  # m[column][row]
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0.0:
        s = 2.0 * math.sqrt(trace + 1.0)
        q = ((m[1][2] - m[2][1]) / s, (m[2][0] - m[0][2]) / s, (m[0][1] - m[1][0]) / s, s / 4.0)
    else:
        i = max(range(3), key=lambda k: m[k][k])
        j, k = (i + 1) % 3, (i + 2) % 3
        s = 2.0 * math.sqrt(max(0.0, 1.0 + m[i][i] - m[j][j] - m[k][k]))
        q = [0.0] * 4
        q[i] = s / 4.0
        q[j] = (m[i][j] + m[j][i]) / s
        q[k] = (m[i][k] + m[k][i]) / s
        q[3] = (m[j][k] - m[k][j]) / s
    length = math.sqrt(sum(c * c for c in q))
    return tuple(c / length for c in q)
