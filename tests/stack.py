"""stack.py FOLDER... - the deepest stack below each public function, from what `gcc -fcallgraph-info=su` leaves beside objects (make footprint).

Calls through pointers (the port, the GL) and into the C library are not followed. Prints the deepest paths.
"""
import glob
import re
import sys

sizes, calls, public = {}, {}, set()


def read(path):
    static = "/" + path.rsplit("/", 1)[-1]
    names = {}
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for title, label in re.findall(r'node: \{ title: "([^"]*)" label: "([^"]*)"', text):
        own = re.search(r"\\n(\d+) bytes \((\w[\w,]*)\)", label)
        name = title.rsplit(":", 1)[-1]
        key = name if ":" not in title else name + static
        names[title] = key
        if own:
            sizes[key] = int(own[1])
            if "dynamic" in own[2]:
                print("stack: %s has a stack of no fixed size" % name)
        if ":" not in title and own and name.startswith("gn_"):
            public.add(key)
    for source, target in re.findall(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', text):
        calls.setdefault(names.get(source, source), set()).add(names.get(target, target))


def deepest(name, above=()):
    """Bytes and the path; what recurs is counted once more for each level that it is known to have: none here knows it."""
    if name in above:
        return 0, ["(" + name.split("/")[0] + " again)"]
    if name not in memory:
        best, path = 0, []
        for callee in calls.get(name, ()):
            size, way = deepest(callee, above + (name,))
            if size > best:
                best, path = size, way
        memory[name] = (sizes.get(name, 0) + best, [name.split("/")[0]] + path)
    return memory[name]


memory = {}
for folder in sys.argv[1:]:
    for file in glob.glob(folder + "/**/*.ci", recursive=True):
        read(file)
worst = sorted(((deepest(name), name) for name in public), reverse=True)
for (size, path), name in worst[:8]:
    print("%6d %s: %s" % (size, name, " > ".join(path[1:])))
