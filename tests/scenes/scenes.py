"""Writes the test scenes: python3 scenes.py FOLDER [NAME...]

Every scene is a function of lights.py (where light, eye and casters are), meshes.py (what casts),
bounds.py (what lights reach), piles.py (what is measured), nests.py (more layers than a stencil counts), extremes.py (the edge
of numbers) or courtyard.py (the picture); this file only runs them. It writes FOLDER/NAME.gltf and NAME.bin, the
same bytes each time, and without names also FOLDER/scenes.txt, one line per scene:

    NAME zpass|nozpass small|large|extreme # why z-pass holds there or not

See stage.scene() for what the words promise.
"""
import os
import sys

import bounds     # noqa: F401  (registers its scenes, as do the next six)
import courtyard  # noqa: F401
import extremes   # noqa: F401
import lights     # noqa: F401
import meshes     # noqa: F401
import nests      # noqa: F401
import piles      # noqa: F401
from stage import SCENES, Stage


def write(folder, names):
    """Writes the named scenes into `folder`."""
    for name in names:
        stage = Stage()
        SCENES[name][0](stage)
        stage.save(folder, name)


def main(arguments):
    if not arguments or arguments[0].startswith("-"):
        print("usage: scenes.py FOLDER [NAME...]", file=sys.stderr)
        return 2
    folder, names = arguments[0], arguments[1:]
    for name in names:
        if name not in SCENES:
            print("scenes.py: no such scene: %s (there are %s)" % (name, " ".join(sorted(SCENES))),
                  file=sys.stderr)
            return 2
    os.makedirs(folder, exist_ok=True)
    write(folder, names or sorted(SCENES))
    if not names:
        with open(os.path.join(folder, "scenes.txt"), "w", encoding="utf-8") as file:
            for name in sorted(SCENES):
                file.write("%s %s %s # %s\n" % ((name,) + SCENES[name][1:]))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
