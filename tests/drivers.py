"""drivers.py BUILD [DRIVER...] - runs every driver that this machine has and prints docs/drivers.md (make test-drivers).

Two tables: masks of six scenes by each exact method against the ray-traced truth (`gnomon measure`), and the programs of tests/gles.
What differs between drivers stands in words in FINDINGS; a difference that does not is a failure, and so is one that stands there
and is gone.

DRIVER names some of them, and then nothing is printed but what failed. ANGLE is looked for in build/angle (make angle), armhf and
arm64 in what `make test-arm` leaves. A virtual X server is started where Xvfb is.
"""
import collections
import csv
import glob
import os
import shutil
import subprocess
import sys
import tempfile

SCENES = ["cube_sun", "camera_in_shadow", "hole", "soup", "ortho", "two_lamps_nested"]
METHODS = ["zfail", "stencil", "count", "signed", "alpha", "screen"]
SLOW = ["test_formats", "test_hidden", "test_kept", "test_parts", "test_state", "test_targets"]  # what a slow driver runs
LONGEST = 1200  # seconds of a program

SWIFTSHADER = "/usr/lib/chromium/vk_swiftshader_icd.json"
ZINK = {"MESA_LOADER_DRIVER_OVERRIDE": "zink", "GALLIUM_DRIVER": "zink", "LIBGL_ALWAYS_SOFTWARE": "1",
        "VK_ICD_FILENAMES": SWIFTSHADER}
LLVMPIPE, SOFTPIPE = {"GALLIUM_DRIVER": "llvmpipe"}, {"GALLIUM_DRIVER": "softpipe"}

Driver = collections.namedtuple("Driver", "name about platform environment needs slow build")


def arm(arch, triple):
    qemu = {"armhf": "qemu-arm-static", "arm64": "qemu-aarch64-static"}[arch]
    root = os.path.abspath("build/root-" + arch)
    return Driver(arch + " softpipe", "softpipe of Debian's %s under qemu-user" % arch, "egl", SOFTPIPE, root, True,
                  ([qemu, "-L", root], "build/%s-release" % triple))


DRIVERS = [
    Driver("llvmpipe", "Mesa through EGL, surfaceless", "egl", LLVMPIPE, None, False, None),
    Driver("softpipe", "the same, Mesa's reference rasteriser", "egl", SOFTPIPE, None, True, None),
    Driver("ES 2.0", "llvmpipe under MESA_GLES_VERSION_OVERRIDE=2.0", "egl",
           {**LLVMPIPE, "MESA_GLES_VERSION_OVERRIDE": "2.0"}, None, False, None),
    Driver("zink", "Mesa over Vulkan by SwiftShader", "egl", ZINK, SWIFTSHADER, False, None),
    Driver("OSMesa", "desktop OpenGL into memory", "osmesa", LLVMPIPE, None, False, None),
    Driver("GLFW, EGL", "a window on Xvfb", "glfw", LLVMPIPE, "DISPLAY", False, None),
    Driver("GLFW, native", "the same through GLX", "glfw-native", LLVMPIPE, "DISPLAY", False, None),
    Driver("GLFW, OSMesa", "the same with OSMesa's context", "glfw-osmesa", LLVMPIPE, "DISPLAY", False, None),
    Driver("ANGLE", "ANGLE over SwiftShader", "angle", {"GNOMON_ANGLE": os.path.abspath("build/angle")},
           "build/angle/libEGL.so", False, None),
    arm("armhf", "arm-linux-gnueabihf"),
    arm("arm64", "aarch64-linux-gnu"),
]

# Drivers, what (methods or programs), and why that is not as elsewhere.
FINDINGS = [
    (["zink", "ANGLE"], METHODS,
     "SwiftShader places vertices to 1/16 pixel, where the truth is asked about 1/256: one pixel of ten masks, by each method."),
    (["zink", "ANGLE"], ["test_bounds", "test_cases", "test_color", "test_convex", "test_fill", "test_refine", "test_small"],
     "The same, and its depths of triangles that reach infinity stray: two ways to count one shadow, or a shadow and the truth, differ in "
     "single pixels of some views. Two ways are bit for bit alike only where rasterisation is."),
    (["zink"], ["test_state", "test_formats"],
     "These programs open OSMesa too, which crashes in Mesa itself under GALLIUM_DRIVER=zink. And where Mesa makes GL calls on a thread of its "
     "own, as it does for zink, INVALID_OPERATION is raised for a call of none of ours: with mesa_glthread=false the formats pass."),
    (["zink", "ANGLE"], ["test_lies"],
     "One of 27 lies cannot be told: that highp is mediump, which here has 32 bits as well."),
    (["OSMesa", "GLFW, OSMesa"], ["test_lies", "test_hidden"],
     "Desktop OpenGL has queries of time by other names, which these programs neither watch nor replace."),
    (["ES 2.0", "zink", "OSMesa", "GLFW, OSMesa"], ["test_targets"],
     "The program makes framebuffers of floats and sRGB, whose kind can only be asked of OpenGL ES 3; here they pass for plain levels, and are "
     "proven as such by drawing into them."),
    (["softpipe", "armhf softpipe", "arm64 softpipe"], ["test_targets"],
     "softpipe's depth clamp fails its proof (docs/boards.md), which the program does not expect of a driver, and it has no multisampled "
     "objects."),
]


def words_for(name, what):
    return next((words for names, whats, words in FINDINGS if name in names and what in whats), None)


def is_there(driver):
    if driver.build and not os.path.exists(driver.build[1] + "/gnomon"):
        return False
    if driver.needs == "DISPLAY":
        return "DISPLAY" in os.environ
    return not driver.needs or os.path.exists(driver.needs)


def command(driver, build, program):
    run, folder = driver.build or ([], build)
    return run + [os.path.join(folder, program)]


def environment(driver):
    return {**os.environ, **driver.environment, "GNOMON_TEST_PLATFORM": driver.platform}


# ---------------------------------------------------------------- masks


def measure(driver, build, folder):
    """Rows of a table of the six scenes; the renderer's name."""
    scenes = ["build/scenes/%s.gltf" % name for name in SCENES]
    run = subprocess.run(command(driver, build, "gnomon") +
                         ["measure"] + scenes + ["-o", folder, "--platform", driver.platform, "--size", "160x120",
                                                 "--frames", "1", "--scales", "1", "--methods", ",".join(METHODS)],
                         env=environment(driver), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                         timeout=LONGEST)
    if run.returncode:
        sys.exit("%s: %s" % (driver.name, run.stderr.strip()))
    with open(folder + "/trade.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return rows, rows[0]["renderer"]


def mask_cells(rows):
    """For each method: "0 of 12 masks wrong", or what is."""
    cells = {}
    for method in METHODS:
        of = [r for r in rows if r["method"] == method]
        possible = [r for r in of if not r["impossible"]]
        masks = sum(int(r["masks"]) for r in possible)
        wrong = sum(int(r["wrong_certain"]) for r in possible if not r["warning"])
        warned = sum(1 for r in possible if r["warning"])
        if not possible:
            cells[method] = "impossible"
        else:
            cells[method] = "%s in %d masks%s" % (wrong, masks, ", %d scenes warned of" % warned if warned else "")
    return cells


# ---------------------------------------------------------------- programs


def run_programs(driver, build):
    cells = {}
    for path in sorted(glob.glob("tests/gles/test_*.c")):
        program = os.path.basename(path)[:-2]
        if driver.slow and program not in SLOW:
            cells[program] = ""
            continue
        if not os.path.exists(command(driver, build, "tests/gles/" + program)[-1]):
            cells[program] = ""
            continue
        try:
            run = subprocess.run(command(driver, build, "tests/gles/" + program), env=environment(driver),
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=LONGEST,
                                 errors="replace")
        except subprocess.TimeoutExpired:
            cells[program] = "too slow"
            continue
        failed = sorted({line.split()[-1] for line in run.stdout.splitlines()
                         if line.startswith("[  FAILED  ]") and "test(s)" not in line})
        passed = sum(1 for line in run.stdout.splitlines() if line.startswith("[       OK ]"))
        cells[program] = str(passed) if run.returncode == 0 else "%d, not %s" % (passed, ", ".join(failed) or "its end")
    return cells


# ---------------------------------------------------------------- the page


def row(cells):
    print("| " + " | ".join(cells) + " |")


def compare(driver, cells, usual, found):
    """Cells that are not the first driver's need words."""
    for what, cell in cells.items():
        if cell == usual.get(what) or not cell:
            continue
        found.append((driver.name, what, cell))


def start_server():
    """A virtual X server, unless there is one; returns what ends it."""
    if "DISPLAY" in os.environ or not shutil.which("Xvfb"):
        return lambda: None
    read, write = os.pipe()
    # Without -noreset it starts anew whenever a program has ended, and refuses the next one meanwhile.
    server = subprocess.Popen(["Xvfb", "-noreset", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                              pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as file:
        os.environ["DISPLAY"] = ":" + file.readline().strip()
    return server.terminate


def main():
    build, names = sys.argv[1], sys.argv[2:]
    stop = start_server()
    masks, programs, renderers, found = {}, {}, {}, []
    drivers = [d for d in DRIVERS if is_there(d) and (not names or d.name in names or d.name == "llvmpipe")]
    try:
        for driver in drivers:
            print("%s ..." % driver.name, file=sys.stderr, flush=True)
            with tempfile.TemporaryDirectory() as folder:
                rows, renderers[driver.name] = measure(driver, build, folder)
            masks[driver.name] = mask_cells(rows)
            programs[driver.name] = run_programs(driver, build)
            compare(driver, masks[driver.name], masks[drivers[0].name], found)
            compare(driver, programs[driver.name], programs[drivers[0].name], found)
    finally:
        stop()
    if not names:
        print_page(drivers, masks, programs, renderers, found)
    unexplained = [f for f in found if not words_for(*f[:2])]
    there = [(name, what) for names, whats, _ in FINDINGS for name in names for what in whats
             if name in masks and {**masks[name], **programs[name]}[what]]
    gone = [f for f in there if f not in [g[:2] for g in found]]
    for name, what, cell in unexplained:
        print("drivers: %s: %s: %s, and no words for it" % (name, what, cell), file=sys.stderr)
    for name, what in gone:
        print("drivers: %s: %s is as elsewhere, and has words" % (name, what), file=sys.stderr)
    return bool(unexplained or gone)


def print_page(drivers, masks, programs, renderers, found):
    print("# Drivers\n\nMade by `make test-drivers`; do not edit. `make deps-drivers` installs what Debian has of them, `make angle` "
          "fetches ANGLE, `make test-arm` builds for the boards.\n")
    row(["driver", "what it is", "renderer"])
    row(["---"] * 3)
    for d in drivers:
        row([d.name, d.about, renderers[d.name]])
    print("\n## Masks\n\nPixels that the ray-traced truth is certain of and that are wrong, in the masks of %d scenes (%s) at 160x120, by every "
          "exact method. Scenes that a plan warns of before the frame are counted apart.\n" % (len(SCENES), ", ".join(SCENES)))
    row(["driver"] + METHODS)
    row(["---"] * (1 + len(METHODS)))
    for d in drivers:
        row([d.name] + [masks[d.name][m] for m in METHODS])
    print("\n## Programs of tests/gles\n\nTests that passed; an empty cell was not run: slow drivers run a part.\n")
    row(["program"] + [d.name for d in drivers])
    row(["---"] * (1 + len(drivers)))
    for program in programs[drivers[0].name]:
        row([program] + [programs[d.name][program] for d in drivers])
    print("\n## What differs, and why\n")
    for names, whats, words in FINDINGS:
        of = [f for f in found if f[0] in names and f[1] in whats]
        if of:
            print("- **%s** (%s). %s" % ("; ".join(sorted({f[0] for f in of})), ", ".join(sorted({f[1] for f in of})), words))
    for name, what, cell in found:
        if not words_for(name, what):
            print("- **%s** (%s). %s. Nobody knows why yet." % (name, what, cell))
    if not found:
        print("Nothing.")


if __name__ == "__main__":
    sys.exit(main())
