"""taken.py CROSS BUILD - bytes that examples/minimal.c takes of a library: code, constants, and data, without its own and the C library's.

The linker keeps what the example calls, and what that calls (--gc-sections), of objects whose functions stand in sections of their own
(VARIANT=size).
"""
import collections
import os
import subprocess
import sys


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def sections_of_line(line):
    """What a line of `size -A` adds to code, constants or data."""
    words = line.split()
    if len(words) != 3 or not words[0].startswith("."):
        return {}
    kind = ("code" if words[0].startswith((".text", ".init", ".fini", ".plt")) else
            "constants" if words[0].startswith((".rodata", ".data.rel.ro", ".ARM.ex")) else
            "data" if words[0].startswith((".data", ".bss")) else None)
    return {kind: int(words[1])}


def sections(cross, path):
    sums = collections.Counter()
    for line in run(cross + "size", "-A", path).splitlines():
        sums.update(sections_of_line(line))
    return sums


def taken(cross, build):
    host, out = os.path.join(build, "calls.o"), os.path.join(build, "taken.o")
    subprocess.run([cross + "gcc", "-std=c99", "-Os", "-Iport", "-Icore", "-Igles", "-c", "examples/minimal.c", "-o", host], check=True)
    calls = [line.split()[1] for line in run(cross + "nm", "-u", host).splitlines() if line.split()[1].startswith("gn_")]
    subprocess.run([cross + "ld", "-r", "--gc-sections", "-e", calls[0]] + ["-u" + call for call in calls] +
                   [os.path.join(build, "libgnomon.a"), "-o", out], check=True)
    return sections(cross, out)


if __name__ == "__main__":
    found = taken(sys.argv[1], sys.argv[2])
    print(found["code"], found["constants"], found["data"])
