"""minimal_truth.py FRAME.ppm - the picture of examples/minimal.c against rays: which surface each pixel shows, and whether the light
reaches it. Pixels whose nine subsamples disagree are left out; of the others none may be wrong. Says how many there are.

The scene stands here once more, apart from the program: a floor, a box, a light, an eye.
"""
import sys

import numpy as np

FLOOR = np.array([(-4, 0, -4), (-4, 0, 4), (4, 0, 4), (4, 0, -4)], float)
LOW, HIGH = np.array((-1.0, 1, -1)), np.array((1.0, 2, 1))
LIGHT, EYE = np.array((1.5, 5.0, 2.0)), np.array((0.0, 4, 8))
SINE = -0.382683
COLORS = np.array([(0.80, 0.75, 0.65), (0.85, 0.35, 0.25)])
CAN = 1e-9


def meet_box(origin, direction):
    """Where rays enter and leave the box; enter > leave where they miss."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (LOW - origin) / direction, (HIGH - origin) / direction
    return np.minimum(a, b).max(axis=-1), np.maximum(a, b).min(axis=-1)


def see(x, y):
    """Surface (-1 nothing, 0 floor, 1 box) and whether it is lit, for points of the image from -1 to 1."""
    cosine = np.sqrt(1 - SINE * SINE)
    v = np.stack([0.6 * x, 0.45 * y, -np.ones_like(x)], axis=-1)
    direction = np.stack([v[..., 0], cosine * v[..., 1] - SINE * v[..., 2], SINE * v[..., 1] + cosine * v[..., 2]], axis=-1)
    to_floor = -EYE[1] / direction[..., 1]
    on_floor = EYE + to_floor[..., None] * direction
    floor = (to_floor > 0) & (np.abs(on_floor[..., 0]) < 4) & (np.abs(on_floor[..., 2]) < 4)
    enter, leave = meet_box(EYE, direction)
    box = (enter < leave) & (enter > 0) & ~(floor & (to_floor < enter))
    at = np.where(box[..., None], EYE + enter[..., None] * direction, on_floor)
    enter, leave = meet_box(at, LIGHT - at)
    # from the box's own surface a ray starts at 0: it is blocked if it goes in
    blocked = (np.minimum(leave, 1.0) - np.maximum(enter, 0.0)) > CAN
    return np.where(box, 1, np.where(floor, 0, -1)), ~blocked


def main(path):
    with open(path, "rb") as file:
        kind, width, height, most = file.readline().split()
        width, height = int(width), int(height)
        assert (kind, most) == (b"P6", b"255"), (kind, most)
        picture = np.frombuffer(file.read(), np.uint8).reshape(height, width, 3)
    px, py = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    seen = [see(2 * (px + i) / width - 1, 1 - 2 * (py + k) / height) for i in (0, -0.6, 0.6) for k in (0, -0.6, 0.6)]
    surface, lit = seen[0]
    certain = np.ones_like(lit)
    for other, other_lit in seen[1:]:
        certain &= (other == surface) & (other_lit == lit)
    wanted = np.where((surface >= 0)[..., None], COLORS[np.maximum(surface, 0)] * np.where(lit, 1.0, 0.25)[..., None], 0.0)
    wrong = certain & (np.abs(picture - 255.0 * wanted).max(axis=-1) > 2.0)
    shadowed = certain & (surface >= 0) & ~lit
    print("%d of %d certain pixels are wrong; %d of the box, %d in shadow" %
          (wrong.sum(), certain.sum(), (certain & (surface == 1)).sum(), shadowed.sum()))
    return not (wrong.sum() == 0 and certain.mean() > 0.9 and shadowed.sum() > 1000)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
