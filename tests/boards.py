"""boards.py GNOMON - probes every driver that this machine can run and prints docs/boards.md (make boards).

A driver is a way to start `gnomon probe --json`: an environment, a platform, a file that must be there. Two kinds of board
run elsewhere: ARMHF, in the environment, is a command that runs an armhf gnomon, say "qemu-arm-static -L ROOT
build/arm-linux-gnueabihf-release/gnomon".
"""
import json
import os
import shlex
import subprocess
import sys

SWIFTSHADER = "/usr/lib/chromium/vk_swiftshader_icd.json"
ZINK = {"MESA_LOADER_DRIVER_OVERRIDE": "zink", "GALLIUM_DRIVER": "zink", "LIBGL_ALWAYS_SOFTWARE": "1",
        "VK_ICD_FILENAMES": SWIFTSHADER}

gnomon = [sys.argv[1]]
armhf = shlex.split(os.environ.get("ARMHF", ""))

DRIVERS = [  # name, command, platform, environment, needs
    ("llvmpipe", gnomon, "egl", {"GALLIUM_DRIVER": "llvmpipe"}, None),
    ("OSMesa", gnomon, "osmesa", {"GALLIUM_DRIVER": "llvmpipe"}, None),
    ("ES 2.0", gnomon, "egl", {"GALLIUM_DRIVER": "llvmpipe", "MESA_GLES_VERSION_OVERRIDE": "2.0"}, None),
    ("softpipe", gnomon, "egl", {"GALLIUM_DRIVER": "softpipe"}, None),
    ("zink", gnomon, "egl", ZINK, SWIFTSHADER),
    ("armhf softpipe", armhf, "egl", {"GALLIUM_DRIVER": "softpipe"}, None),
    ("armhf llvmpipe", armhf, "egl", {"GALLIUM_DRIVER": "llvmpipe"}, None),
    ("armhf, 1 thread", armhf, "egl", {"GALLIUM_DRIVER": "llvmpipe", "LP_NUM_THREADS": "0"}, None),
]


def probe(command, platform, environment):
    run = subprocess.run(command + ["probe", "--json", "--platform", platform], env={**os.environ, **environment},
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=300)
    return json.loads(run.stdout)[0]


def cell(capability):
    if capability["proven"]:
        return "yes"
    return "**fails**" if capability["advertised"] else "no"


def row(cells):
    print("| " + " | ".join(cells) + " |")


def main():
    found = []
    for name, command, platform, environment, needs in DRIVERS:
        if command and (not needs or os.path.exists(needs)):
            about = probe(command, platform, environment)
            if "absent" not in about:
                found.append((name, platform, about))
    print("# What drivers can do\n\nMade by `make boards` from `gnomon probe --json`; do not edit. *yes* is proven by drawing and "
          "reading back, *no* is not\nadvertised, **fails** is advertised and found wanting. What each name means stands in "
          "`core/gn_capability.h`, how it is proven in\n`gles/proofs/`. ES 2.0 is llvmpipe under "
          "MESA_GLES_VERSION_OVERRIDE=2.0; zink runs over SwiftShader; armhf under qemu.\n")
    row(["driver", "platform", "version", "renderer", "colour, depth, stencil bits", "mediump keeps"])
    row(["---"] * 6)
    for name, platform, a in found:
        b = a["bits"]
        row([name, platform, a["driver"], a["renderer"],
             "%d%d%d%d, %d, %d" % (b["red"], b["green"], b["blue"], b["alpha"], b["depth"], b["stencil"]),
             "%d bits" % b["mediump"]])
    print()
    row(["capability"] + [name for name, _, _ in found])
    row(["---"] * (len(found) + 1))
    for capability in found[0][2]["capabilities"]:
        row([capability] + [cell(a["capabilities"][capability]) for _, _, a in found])
    print()
    row(["method"] + [name for name, _, _ in found])
    row(["---"] * (len(found) + 1))
    for method in found[0][2]["methods"]:
        row([method] + [a["methods"][method] for _, _, a in found])
    print("\n## What failed\n")
    for name, _, a in found:
        for capability, c in a["capabilities"].items():
            if c["advertised"] and not c["proven"]:
                print("- %s, %s: %s" % (name, capability, c.get("symptom", "")))
    print("""
## What is known of the reasons

- softpipe keeps a tile's colours as floats until it writes the tile back: a value between two levels outlives the draw that
  made it, and halves of 128 / 255 grow by 1 / 255 with each that is doubled again. Batches of alpha and screen hold too few for
  that to matter (`tests/bench/bench_ranges.c`).
- softpipe clamps each vertex to the depth range when it applies a polygon offset: under depth clamp, triangles that leave
  the range are tilted.
- armhf llvmpipe on an emulated processor draws depth wrongly unless LP_NUM_THREADS=0. It is the one driver here on which
  frames would come out wrong; it is refused.""")


main()
