#!/bin/sh
# view.sh BUILD - `gnomon view`: scripted sessions in a window of a virtual X server, judged by masks and by what the panel says;
# and without a window. One line a test: "ok ..." or "not ok ...".
build=$1
gnomon=$build/gnomon
tmp=$build/view
scene=build/scenes/colours.gltf
. tests/tools/checks.sh

if command -v Xvfb > /dev/null; then
    mkfifo "$tmp/display"
    Xvfb -noreset -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3> "$tmp/display" 2> /dev/null &
    server=$!
    trap 'kill $server' EXIT
    read -r number < "$tmp/display"
    DISPLAY=:$number
    export DISPLAY
fi
window=glfw
[ -n "$DISPLAY" ] || window=egl # the same without what only windows do

# A session: its lines, then further options. Reports and pictures go to $tmp by the names that the lines give.
session() {
    lines=$1
    shift
    printf '%b' "$lines" | sed "s|@|$tmp/|" > "$tmp/script.txt"
    "$gnomon" view "$scene" --script "$tmp/script.txt" --size 320x240 --platform $window "$@"
}
# An expression over reports by their names: a.json is a.
says() {
    python3 - "$tmp" "$1" << 'END'
import glob, json, math, os, sys
values = {os.path.basename(p)[:-5]: json.load(open(p)) for p in glob.glob(sys.argv[1] + "/*.json")}
way = lambda r, side=0: r["sides"][side]["way"]
distance = lambda a, b: math.dist(a, b)
reach = lambda r: distance(r["eye"], r["target"])
sys.exit(0 if eval(sys.argv[2], {**globals(), **values}) else "%s is false" % sys.argv[2])
END
}

# The first view is that of `gnomon render`, and so are its masks.
"$gnomon" render $scene --size 320x240 --mask-dir "$tmp/wanted" --platform egl
ok "a session in a window" session '0 masks @plain\n0 report @plain.json\n0 shot @plain.png\n1 quit\n'
for light in 0 1 2 3; do
    ok "mask $light is the renderer's" cmp "$tmp/wanted/light$light.png" "$tmp/plain/light$light.png"
done
ok "it says whose GL it is, and how" says 'plain["renderer"] and way(plain) == "stencil" and plain["size"] == [320, 240]'
ok "shadows cost something" says 'plain["sides"][0]["fragments"] > 1000 and plain["sides"][0]["milliwatts"] > 0'

# On a screen of small pixels letters are twice as large, but for a list that would have no room.
if [ $window = glfw ] && command -v xprop > /dev/null; then
    xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER "Xft.dpi: 192"
    ok "a session on fine pixels" session '0 report @fine.json\n0 shot @fine.png\n1 key ?\n1 shot @list.png\n2 quit\n'
    ok "letters are larger there" says 'fine["fine"] and not plain["fine"]'
    xprop -root -remove RESOURCE_MANAGER
fi

# Every exact method, from another side and with a light that was dragged: no certain pixel is wrong.
ok "keys, drags and the truth" session '0 drag 160,120 200,110\n0 scroll 2\n1 drag 40,200 40,201\n1 key T
    1 report @stencil.json\n2 key M\n2 key T\n2 report @zfail.json\n3 key M\n3 key M\n3 key M\n3 report @refine.json
    4 key M\n4 key T\n4 report @count.json\n5 quit\n'
ok "exact methods are not wrong" says \
    'all(r["difference"]["wrong_certain"] == 0 and r["difference"]["certain"] > 40000 for r in (stencil, zfail, count))'
ok "M goes through methods that are possible" says 'len({way(r) for r in (stencil, zfail, refine, count)}) == 4'
ok "a view is moved" session '0 drag 160,120 161,120\n0 report @moved.json\n1 drag 160,120 200,100\n1 report @turned.json\n2 scroll 2\n2 report @near.json
    3 drag right 160,120 180,130\n3 report @panned.json\n4 key F\n4 key W\n20 release W\n20 report @flown.json\n21 quit\n'
ok "turning keeps target and distance" says \
    'distance(turned["target"], moved["target"]) < 1e-9 and abs(reach(turned) - reach(moved)) < 1e-9 and distance(turned["eye"], moved["eye"]) > 0.1'
ok "two notches of the wheel leave 0.81 of it" says 'abs(reach(near) / reach(turned) - 0.81) < 1e-9 and distance(near["target"], turned["target"]) < 1e-9'
ok "panning moves eye and target alike" says 'abs(reach(panned) - reach(near)) < 1e-9 and distance(panned["target"], near["target"]) > 0.01'
ok "flying goes where one looks" says \
    'distance(flown["target"], panned["target"]) > 0.1 and abs(distance(flown["eye"], panned["target"]) + distance(flown["eye"], panned["eye"]) - reach(panned)) < 1e-6'

# What is coarse is found to be wrong, and said to be.
ok "quarter masks" session '0 key R\n0 key R\n0 key T\n0 report @quarter.json\n0 shot @marked.png\n1 key T\n1 report @unmarked.json\n2 quit\n'
ok "quarter masks are wrong near borders" says 'quarter["difference"]["wrong"] > 200 and way(quarter) == "stencil@1/4-bilinear"'
ok "T takes marks away again" says '"difference" not in unmarked'

# Lights.
ok "lights turn, and turn back" session '0 report @lights.json\n1 key K\n31 key K\n32 report @gone.json\n33 key 0\n33 report @back.json\n34 quit\n'
ok "lights go round, and are as they were" says \
    'all(a["position"] + a["towards"] != b["position"] + b["towards"] for a, b in zip(lights["lights"], gone["lights"])) and back["lights"] == lights["lights"]'
scene=build/scenes/torches.gltf
ok "where a light is on the screen" session '0 report @before.json\n1 quit\n'
at=$(python3 -c 'import json, sys
x, y = next(l["at"] for l in json.load(open(sys.argv[1]))["lights"] if "at" in l and 40 < l["at"][0] < 280 and 40 < l["at"][1] < 200)
print("%d,%d %d,%d" % (x, y, x + 30, y + 10))' "$tmp/before.json")
ok "a light is dragged by its disc" session "0 report @before.json\\n1 drag $at\\n1 key T\\n1 report @dragged.json\\n2 quit\\n"
ok "one light moves, as far as the pointer, and its shadows are right" says \
    '[[round(q - p) for p, q in zip(a["at"], b["at"])] for a, b in zip(before["lights"], dragged["lights"]) if a != b] == [[30, 10]] and dragged["difference"]["wrong_certain"] == 0'
scene=build/scenes/colours.gltf

# Both sides of a split.
ok "two methods side by side" session '0 key X\n0 key N\n0 report @split.json\n0 shot @split.png\n1 key V\n1 key V\n1 key V\n1 key V\n1 report @mask.json\n2 quit\n'
ok "each has its name and cost" says 'len(split["sides"]) == 2 and way(split) != way(split, 1) and all(s["ms"] > 0 for s in split["sides"])'
ok "V shows the mask at last" says 'mask["show"] == "mask"'

# What cannot be made says so, and is drawn without shadows; the rest goes on.
ok "capabilities are hidden and shown" session '0 key M\n0 key C\n0 key A\n0 key C\n0 report @hidden.json\n1 key C\n1 key A\n1 key C\n1 report @shown.json\n1 masks @shown\n2 quit\n'
ok "a method without its capability says so" says '"stencil" in hidden["sides"][0]["impossible"] and hidden["sides"][0]["fragments"] == 0'
ok "and comes back with it" says 'shown["sides"][0]["impossible"] == ""'
ok "with the same mask" cmp "$tmp/wanted/light0.png" "$tmp/shown/light0.png"

ok "without depth there is nothing, and it says so" session '0 key C\n1 key E\n1 key C\n2 report @nothing.json\n3 key C\n3 key E\n3 key C\n4 report @again.json\n5 quit\n'
ok "and all of it again with it" says '"depth" in nothing["sides"][0]["impossible"] and again["sides"][0]["impossible"] == "" and way(again) == "stencil"'
ok "marks go when lights do" session '0 key T\n0 report @still.json\n1 key K\n2 report @gone_on.json\n3 quit\n'
ok "and only then" says '"difference" in still and "difference" not in gone_on'
cp build/scenes/colours.bin "$tmp"
python3 -c 'import json, sys
g = json.load(open("build/scenes/colours.gltf"))
light = next(i for i, n in enumerate(g["nodes"]) if "KHR_lights_punctual" in n.get("extensions", {}))
for n in range(67):
    g["nodes"].append(dict(g["nodes"][light]))
    g["scenes"][0]["nodes"].append(len(g["nodes"]) - 1)
json.dump(g, open(sys.argv[1], "w"))' "$tmp/crowd.gltf"
scene=$tmp/crowd.gltf
ok "more lights than the selector takes are seen" session '0 key G\n0 report @crowd.json\n1 quit\n' --size 64x48
ok "and G says why not" says 'len(crowd["lights"]) == 71 and not crowd["adaptive"] and "64" in crowd["notice"]'
refuses 1 "view: the selector takes at most 64 lights (71)" view "$scene" --script "$tmp/script.txt" --budget-ms 10 --platform $window
scene=build/scenes/colours.gltf

# The selector.
ok "within a budget" session '0 report @ample.json\n1 key B\n40 report @less.json\n41 quit\n' --budget-ms 100000
ok "ample: exact; a budget is said" says \
    'ample["adaptive"] and all(l["way"] == "stencil" for l in ample["lights"]) and less["budget_ms"] < ample["budget_ms"] == 100000'
ok "scarce: no shadows" session '40 report @scarce.json\n41 quit\n' --budget-ms 0.01
ok "and it says none" says 'all(l["way"] == "none" for l in scarce["lights"])'

# Lost, and of another size.
ok "a lost context is made again" session '0 key M\n2 lose\n3 masks @lost\n3 report @lost.json\n4 quit\n'
ok "the method is still the one chosen" says 'way(lost) == "zfail" and "lost" in lost["notice"]'
ok "another size" session '1 resize 400x200\n2 report @wide.json\n2 masks @wide\n3 quit\n'
ok "the frame has it" says 'wide["size"] == [400, 200]'
"$gnomon" render $scene --size 400x200 --mask-dir "$tmp/wide-wanted" --platform egl
ok "and the mask is the renderer's" cmp "$tmp/wide-wanted/light0.png" "$tmp/wide/light0.png"

# The panel.
ok "keys are listed" session '0 shot @panel.png\n1 key ?\n1 shot @keys.png\n2 key ?\n2 key O\n2 shot @bare.png\n3 quit\n'
"$gnomon" render $scene --size 320x240 -o "$tmp/frame.png" --platform egl
ok "the frame alone is the renderer's, to a level" python3 - "$tmp" << 'END'
import subprocess, sys
sys.exit(subprocess.call(["/usr/bin/python3" , "-c", """
import sys
from skimage import io
a, b, c = (io.imread(sys.argv[1] + n).astype(int)[..., :3] for n in ("/bare.png", "/frame.png", "/keys.png"))
assert abs(a - b).max() <= 1, abs(a - b).max()
assert (abs(a - c).max(axis=2) > 40).mean() > 0.3
""", sys.argv[1]]))
END

printf '0 key M\nx\n' > "$tmp/bad.txt"
refuses 1 "line 2: is no input (x)" view $scene --script "$tmp/bad.txt"
for line in '0 key Z' '0 resize 20x20zz' '0 scroll nan' '0 drag 1,1 2,2 3' '0 quit now' '0 shot'; do
    printf '%s\n' "$line" > "$tmp/bad.txt"
    refuses 1 "line 1: is no input" view $scene --script "$tmp/bad.txt"
done
printf '5 quit\n3 quit\n' > "$tmp/bad.txt"
refuses 1 "line 2: its frame is before" view $scene --script "$tmp/bad.txt"
printf '# nothing\n' > "$tmp/bad.txt"
refuses 1 "no input in it (0 lines)" view $scene --script "$tmp/bad.txt"
refuses 1 "cannot be read" view $scene --script "$tmp/none.txt"
printf '0 quit\n' > "$tmp/quit.txt"
refuses 1 "none.gltf" view build/scenes/none.gltf --script "$tmp/quit.txt"
refuses 2 "a window is needed: glfw (egl)" view $scene --platform egl
refuses 2 "no method that is shown here" view $scene --method zfail/one-sided
refuses 2 "takes one scene (none given)" view
refuses 2 "takes 1, 2 or 4 (3)" view $scene --scale 3
DISPLAY='' WAYLAND_DISPLAY='' refuses 3 "glfw" view $scene --script "$tmp/quit.txt"
ok "without a window" session '0 report @alone.json\n1 quit\n' --platform egl
exit $failed
