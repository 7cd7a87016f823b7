"""footprint.py CROSS BUILD CC MEMORY... - prints docs/footprint.md from a build with -Os and call graphs (make footprint).

CROSS: the compiler's prefix; BUILD: where the library's objects are; CC: what links, with its system; MEMORY: the command that runs
bench_memory.
"""
import collections
import glob
import os
import subprocess
import sys

GROUPS = [  # what, objects; each object once, the first that names it
    ("meshes: welding, parts, silhouettes, facing",
     "mesh weld edges parts embedded casting facing silhouette chunks clusters order groups update"),
    ("what a scene requires: bounds, ends, intervals, flat receivers, scissors",
     "bounds extent ends cells intervals patches hull fronts receivers cases slivers"),
    ("plans: methods, steps, records, index streams, checks",
     "plan plan_light plan_passes plan_volumes plan_check records volume streams extrude fan camera matrix choose methods capability "
     "context traffic text stain soft"),
    ("more layers than bits: bounds on layers, batches", "batches sweep fragments"),
    ("no stencil: counts in colour, images and masks in textures", "choose_color batches_color color images masks"),
    ("refined small masks", "refine plan_refine thin"),
    ("kept shadows and masks", "cache kept_masks"),
    ("the walk by OpenGL ES 2.0: loading, programs, buffers, state, stencil",
     "load program walk state stencil buffers device describe volumes quad host_state advertised"),
    ("capabilities proven by drawing, and saved", "proofs proof_* saved"),
    ("the selector with its own rules", "select selector suitability knowledge learn loads possible fuzzy rules_about rules_default"),
    ("rules and knowledge as text", "rules scan slices knowledge_read"),
    ("explanations and JSON", "explain select_explain plan_json"),
    ("port for a C library", "port_libc"),
]


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def sections(cross, path):
    """Code, constants and writable data of an object or program."""
    sums = collections.Counter()
    for line in run(cross + "size", "-A", path).splitlines():
        words = line.split()
        if len(words) == 3 and words[0].startswith("."):
            name = words[0]
            kind = ("code" if name.startswith((".text", ".init", ".fini", ".plt")) else
                    "constants" if name.startswith((".rodata", ".data.rel.ro", ".ARM.ex")) else
                    "data" if name.startswith((".data", ".bss")) else None)
            sums[kind] += int(words[1])
    return sums


def row(cells):
    print("| " + " | ".join(cells) + " |")


def kib(n):
    return "%.1f" % (n / 1024)


def main():
    cross, build, compiler, memory = sys.argv[1], sys.argv[2], sys.argv[3].split(), sys.argv[4:]
    objects = {os.path.basename(p)[:-2]: p for pattern in ("core/*.o", "gles/*.o", "gles/*/*.o", "port/port_libc.o")
               for p in glob.glob(os.path.join(build, pattern))}
    left, total = dict(objects), collections.Counter()
    print("# Footprint\n\nMade by `make footprint`; do not edit. For armhf (Thumb-2, `%s`), KiB of 1,024 bytes.\n\n## Code\n\n"
          "The library is one archive, from which a program takes what it calls. By what it is for:\n" %
          " ".join([run(compiler[0], "--version").split("\n")[0], "-Os"]))
    row(["what", "code", "constants", "writable"])
    row(["---"] * 4)
    for what, names in GROUPS:
        sums = collections.Counter()
        for name in names.split():
            for found in [n for n in list(left) if n == name or (name.endswith("*") and n.startswith(name[:-1]))]:
                sums.update(sections(cross, left.pop(found)))
        total.update(sums)
        row([what, kib(sums["code"]), kib(sums["constants"]), kib(sums["data"])])
    if left:
        sys.exit("footprint: no group has %s" % ", ".join(sorted(left)))
    row(["**all**", kib(total["code"]), kib(total["constants"]), kib(total["data"])])
    program = os.path.join(build, "minimal")
    subprocess.run(compiler + ["-std=c99", "-Os", "-ffunction-sections", "-fdata-sections", "-Iport", "-Icore", "-Igles",
                               "examples/minimal.c", os.path.join(build, "libgnomon.a"), "-lEGL", "-lm", "-Wl,--gc-sections", "-o", program],
                   check=True)
    sums = sections(cross, program)
    print("\n`examples/minimal.c`, which takes any method that its board can do, is %s of code and %s of constants, itself and the C library's start "
          "included (`-Wl,--gc-sections`)." % (kib(sums["code"]), kib(sums["constants"])))
    print("\n## Stack\n\nThe deepest paths below public functions, in bytes, by gcc's call graphs (`tests/stack.py`); calls of the port and of the GL "
          "are not followed.\n\n```")
    print(run(sys.executable, "tests/stack.py", build).rstrip())
    print("```\n\n## Heap\n\nNothing is allocated in a frame (`tests/gles/test_walk.c`, `tests/core/test_update.c`, `tests/select/test_selector.c`). Once, for a mesh; the plan's memory is the "
          "host's own (`tests/bench/bench_memory.c`).\n")
    print(run(*memory).rstrip())
    print("\n## What was asked\n\nUnder 96 KiB for the whole library and under 24 for a build with the stencil alone. Neither is so: the whole is as above, and a "
          "build without some of the groups is not to be had yet. Stacks were to be under 8 KiB, and are.")


if __name__ == "__main__":
    main()
