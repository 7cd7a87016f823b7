"""What every scene shares: the register of scenes, lights and eyes placed by what they look at, and
a few colours.

A scene is a function that takes a Stage and fills it. The register keeps beside it what a test must
know before it picks a method for the scene: see scene().
"""
from gltf import Gltf
from shapes import floor
from space import looking, turn_y

SCENES = {}  # name: (function, "zpass" or "nozpass", "small", "large" or "extreme", reason)

# Linear base colours.
SAND = (0.62, 0.50, 0.34)
STONE = (0.55, 0.55, 0.52)
SLATE = (0.22, 0.25, 0.30)
RED = (0.70, 0.16, 0.10)
GREEN = (0.20, 0.50, 0.18)
BLUE = (0.12, 0.24, 0.60)
OCHRE = (0.72, 0.45, 0.12)
WHITE = (0.80, 0.80, 0.78)


def scene(zpass, size, why):
    """Registers a scene under its function's name.

    zpass "zpass" where no shadow volume meets the near plane's rectangle, so that counting from
          the eye (z-pass) is right; "nozpass" where one does, and z-pass must go wrong
    size  "small" where softpipe gets through it: few triangles, few layers; "extreme" for those
          that are drawn small, by z-fail and stencil only, and by every driver
    why   the reason for the first, in one line
    """
    def register(function):
        SCENES[function.__name__] = (function, zpass, size, why)
        return function
    return register


class Stage(Gltf):
    """A Gltf with the habits of these scenes."""

    def ground(self, half=5.0, half_z=None, y=0.0, color=SAND, **place):
        """A floor: an open quad that faces upwards."""
        return self.thing(floor(half, half_z, y), self.material(color, 0.95), **place)

    def lamp(self, at, intensity, color=(1.0, 1.0, 1.0), range=None, **place):
        """A point light."""
        return self.node(at=at, light=self.light("point", intensity, color, None, range), **place)

    def spot(self, at, target, intensity, cone, color=(1.0, 1.0, 1.0), range=None, **place):
        """A spot light that points at `target`; cone: inner and outer degrees from the axis."""
        return self.node(at=at, turn=looking(at, target),
                         light=self.light("spot", intensity, color, cone, range), **place)

    def sun(self, towards, intensity=3.0, color=(1.0, 1.0, 1.0), **place):
        """A directional light; `towards` points from the scene to the light."""
        return self.node(turn=looking(towards, (0.0, 0.0, 0.0)),
                         light=self.light("directional", intensity, color), **place)

    def eye(self, at, target, degrees=45.0, near=0.1, far=None, **place):
        """The perspective camera at `at` that looks at `target`."""
        return self.node(name="eye", at=at, turn=looking(at, target),
                         camera=self.perspective(degrees, near, far), **place)

    def flat_eye(self, at, target, ymag, near, far, **place):
        """The orthographic camera."""
        return self.node(name="eye", at=at, turn=looking(at, target),
                         camera=self.orthographic(ymag, near, far), **place)

    def block_at(self, shape, color, at, degrees=0.0, both=False, **place):
        """A Shape in a colour, turned about y and put at `at`."""
        return self.thing(shape, self.material(color, both=both), at=at,
                          turn=turn_y(degrees), **place)
