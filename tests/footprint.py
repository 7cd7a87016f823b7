"""footprint.py CROSS BUILD QEMU... - prints docs/footprint.md from a build with -Os and call graphs (make footprint).

CROSS: the compiler's prefix; BUILD: where the library's objects are, and behind "-with" those of the smallest; QEMU: what runs a program.
"""
import collections
import glob
import os
import subprocess
import sys

from taken import run, sections, sections_of_line, taken

GROUPS = [  # feature of core/gni_features.h, or what is always there; objects, each once, by the first that names it
    ("always: meshes: welding, edges, parts, silhouettes, facing", "mesh weld edges parts star casting silhouette facing chunks update"),
    ("always: plans: methods, steps, records, index streams, checks",
     "plan plan_light plan_passes plan_volumes plan_check records volume extrude camera matrix choose methods capability context text stain"),
    ("always: the walk by OpenGL ES 2.0: loading, programs, buffers, state, stencil",
     "load program walk state stencil buffers device describe volumes quad advertised saved"),
    ("always: a port for a C library", "port_libc"),
    ("`culling`", "bounds ends cases cells extent fronts intervals patches receivers slivers fan flats hull soft"),
    ("`batches`", "batches sweep"),
    ("`fallback`", "batches_color choose_color fragments color images masks"),
    ("`refine`", "plan_refine thin refine"),
    ("`cache`", "cache kept_masks kept_records streams"),
    ("`welding`", "groups"),
    ("`clusters`", "clusters order facing_floats"),
    ("`solids`", "embedded"),
    ("`proofs`", "proofs proof_* show host_state"),
    ("`selector`",
     "select selector suitability knowledge learn loads possible fuzzy rules_about rules_default select_explain traffic "
     "rules scan slices knowledge_read"),
    ("`text`", "explain plan_json"),
]
BUILDS = ["", "messages", "proofs", "messages proofs", "culling messages proofs", "culling clusters solids messages proofs",
          "culling batches fallback refine cache welding clusters solids messages proofs", None]  # None: all of them


def row(cells):
    print("| " + " | ".join(cells) + " |")


def kib(n):
    return "%.1f" % (n / 1024)


def measure(cross, features):
    """The archive's sections, and what the example takes of them, of a build with -Os."""
    folder = "build/%ssize%s" % (cross, "" if features is None else "-with" + "".join("-" + f for f in sorted(features.split())))
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "FEATURES", "VARIANT")}
    subprocess.run(["make", "-s", "-j2", "CROSS=" + cross, "VARIANT=size", folder + "/libgnomon.a"] +
                   ([] if features is None else ["FEATURES=" + features]), check=True, stdout=subprocess.DEVNULL, env=environment)
    whole = collections.Counter()
    for line in run(cross + "size", "-A", folder + "/libgnomon.a").splitlines():
        whole.update(sections_of_line(line))
    return whole, taken(cross, folder)


def main():
    cross, build, qemu = sys.argv[1], sys.argv[2], sys.argv[3:]
    objects = {os.path.basename(p)[:-2]: p for pattern in ("core/*.o", "gles/*.o", "gles/*/*.o", "port/port_libc.o")
               for p in glob.glob(os.path.join(build, pattern))}
    left, total = dict(objects), collections.Counter()
    print("# Footprint\n\nMade by `make footprint`; do not edit. For armhf (Thumb-2, `%s`), KiB of 1,024 bytes.\n\n## Code\n\n"
          "The library is one archive, from which a program takes what it calls. By features (`core/gni_features.h`), which a build may lack:\n" %
          " ".join([run(cross + "gcc", "--version").split("\n")[0], "-Os"]))
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
    print("\nWhat is always there is smaller where a feature is not. Built with `FEATURES=...` the archive has, and `examples/minimal.c` takes of it "
          "(`tests/taken.py`):\n")
    row(["FEATURES", "archive: code", "constants", "taken: code", "constants", "writable"])
    row(["---"] * 6)
    for features in BUILDS:
        whole, part = measure(cross, features)
        row([{None: "all", "": "none"}.get(features, "`%s`" % features), kib(whole["code"]), kib(whole["constants"]), kib(part["code"]),
             kib(part["constants"]), kib(part["data"])])
    print("\n## Stack\n\nThe deepest paths below public functions, in bytes, by gcc's call graphs (`tests/stack.py`); calls of the port and of the GL "
          "are not followed. Of the whole library, and of the smallest:\n")
    for folder in (build, build + "-with"):
        print("```\n%s\n```\n" % run(sys.executable, "tests/stack.py", folder).rstrip())
    print("## Heap\n\nNothing is allocated in a frame (`tests/gles/test_walk.c`, `tests/core/test_update.c`, `tests/select/test_selector.c`). Once, "
          "for a mesh; the plan's memory is the host's own (`tests/bench/bench_memory.c`). Of the whole library, and of the smallest:\n")
    for folder in (build, build + "-with"):
        print(run(*qemu, folder + "/tests/bench/bench_memory").rstrip() + "\n")
    print("## What was asked\n\nUnder 24 KiB for a build with the stencil alone: so it is, constants included (`FEATURES=`; `tests/tools/features.sh` holds it to "
          "that). Under 96 for the whole library: it is more, as above. Stacks under 8 KiB: so they are.")


if __name__ == "__main__":
    main()
