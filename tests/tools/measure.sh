#!/bin/sh
# measure.sh BUILD - `gnomon measure`: what it writes, that it is the same each time, that it goes on where it was stopped, and
# that a browser shows its page. One line a test: "ok ..." or "not ok ...".
build=$1
gnomon=$build/gnomon
tmp=$build/measure
scene=build/scenes/colours.gltf
. tests/tools/checks.sh

measure() { # directory, further options
    directory=$1
    shift
    "$gnomon" measure "$scene" -o "$tmp/$directory" --size 160x120 --frames 2 --lights 1,2 --methods zpass,stencil,refine,count,alpha \
        --scales 1,2 "$@"
}
# The rows' columns before those of the clock.
figures() { "$python" -c 'import csv,sys
for r in csv.DictReader(open(sys.argv[1])): print([v for k,v in r.items() if not k.split("_p")[0].endswith("_ms") and k != "clock"])' "$1"; }
rows() { "$python" -c 'import csv,sys; print(len(list(csv.DictReader(open(sys.argv[1])))))' "$1"; }
column() { "$python" -c 'import csv,sys
print(max(r[sys.argv[3]] for r in csv.DictReader(open(sys.argv[1])) if r["config"] == sys.argv[2]))' "$1" "$2" "$3"; } # the greatest

ok "measures" measure a
ok "a row for each configuration and number of lights" [ "$(rows "$tmp/a/trade.csv")" = 18 ]
ok "exact methods have no certain pixel wrong" sh -c "[ \"$(column "$tmp/a/trade.csv" stencil wrong_certain)\" = 0 ]"
ok "half resolution has some wrong, and is not as good a picture" sh -c \
    "[ $(column "$tmp/a/trade.csv" count@1/2-bilinear wrong) -gt 50 ] && \
     awk 'BEGIN {exit !($(column "$tmp/a/trade.csv" count@1/2-bilinear ssim) < $(column "$tmp/a/trade.csv" count ssim))}'"
ok "a picture under its masks is the right one" sh -c "awk 'BEGIN {exit !($(column "$tmp/a/trade.csv" stencil ssim) > 0.995)}'"
ok "the worst masks are there" sh -c "[ -s $tmp/a/worst/colours-count-1-2-bilinear-160x120-2.png ]"
sed -n '/^# colours-count-1-2-bilinear-160x120-2/{n;p;}' "$tmp/a/worst/commands.txt" | head -n 1 > "$tmp/again.sh"
ok "their command makes them again" sh -c "cd $tmp && mkdir -p again build && ln -sf ../../../scenes build/scenes && \
    PATH=$(pwd)/$build:\$PATH sh again.sh && cmp again/worst/colours-count-1-2-bilinear-160x120-2.png a/worst/colours-count-1-2-bilinear-160x120-2.png"
measure b > /dev/null 2>&1
figures "$tmp/a/trade.csv" > "$tmp/a.txt"
figures "$tmp/b/trade.csv" > "$tmp/b.txt"
ok "a second run has the same figures" cmp "$tmp/a.txt" "$tmp/b.txt"
sed '12,$d' "$tmp/a/trade.csv" > "$tmp/b/trade.csv" # interrupted after ten rows
measure b > /dev/null 2>&1
figures "$tmp/b/trade.csv" > "$tmp/b.txt"
ok "one that was stopped goes on" cmp "$tmp/a.txt" "$tmp/b.txt"
head -n 11 "$tmp/a/trade.csv" > "$tmp/a.txt"
head -n 11 "$tmp/b/trade.csv" > "$tmp/b.txt"
ok "and keeps what was there" cmp "$tmp/a.txt" "$tmp/b.txt"
ok "what is impossible says why" sh -c "$gnomon measure $scene -o $tmp/c --size 64x48 --frames 1 --methods refine --scales 2 --hide packed-depth-stencil && \
    grep -q 'packed-depth-stencil, which is hidden' $tmp/c/trade.csv"
ok "certifies" sh -c "$gnomon measure --certify $scene build/scenes/torches.gltf --size 160x120 --frames 2 | grep -q '^certified: 0 pixels'"
for late in "" "--update-every 2" "--masks-every 2" "--weld-angle 10"; do
    # shellcheck disable=SC2086
    "$gnomon" measure $scene -o "$tmp/late" --size 160x120 --frames 3 --lights 2 --methods count --scales 1 --spin 4 $late > /dev/null 2>&1
done
wrong() { column "$tmp/late/trade.csv" "count+spin4$1" wrong; }
ok "late and welded shadows are farther from the truth" sh -c \
    "[ $(wrong +weld10) -gt $(wrong "") ] && [ $(wrong +update2) -gt $(wrong "") ] && [ $(wrong +masks2) -gt $(wrong +update2) ]"
printf '# eye, target\n2.6 2.9 4.6  0 0.4 0\n2.6, 2.9, 4.5, 0, 0.4, 0\n' > "$tmp/path.txt"
ok "a path from a file" sh -c "$gnomon measure $scene -o $tmp/d --size 64x48 --frames 2 --methods stencil --scales 1 --camera-path $tmp/path.txt"
printf '1 2 3 4 5\n' > "$tmp/bad.txt"
refuses 1 "line 1 is no eye" measure "$scene" -o "$tmp/e" --camera-path "$tmp/bad.txt"
refuses 2 "takes scenes and -o DIR" measure "$scene"
refuses 2 "takes 1, 2 and 4 (3)" measure "$scene" -o "$tmp/e" --scales 3
refuses 2 "no method has that name" measure "$scene" -o "$tmp/e" --methods zfial
refuses 2 "takes WxH of 16 to 8192" measure "$scene" -o "$tmp/e" --size 8x8
refuses 1 "none.gltf: No such file" measure build/scenes/none.gltf -o "$tmp/e"
printf 'a,b\n1,2\n' > "$tmp/d/trade.csv"
refuses 1 "is no table of this version" measure "$scene" -o "$tmp/d"
ok "and leaves it alone" grep -q '^a,b$' "$tmp/d/trade.csv"
if command -v chromium > /dev/null; then
    chromium --headless --no-sandbox --disable-gpu --user-data-dir="$tmp/browser" --dump-dom "file://$(pwd)/$tmp/a/report.html" > "$tmp/page.html" 2> /dev/null
    ok "a browser finds the table" [ "$(grep -c '<tr' "$tmp/page.html")" = 19 ]
    ok "and the pictures" sh -c "[ $(grep -c 'data:image/png;base64,iVBOR' "$tmp/page.html") -gt 8 ] && grep -q '<svg' $tmp/page.html"
    cat > "$tmp/click.js" << 'END'
document.querySelectorAll('th')[1].click();
END
    sed "s|</body>|<script>$(cat "$tmp/click.js")</script></body>|" "$tmp/a/report.html" > "$tmp/a/clicked.html"
    chromium --headless --no-sandbox --disable-gpu --user-data-dir="$tmp/browser" --dump-dom "file://$(pwd)/$tmp/a/clicked.html" > "$tmp/page.html" 2> /dev/null
    ok "sorts by a column" sh -c "sed -n '/<tr class/p' $tmp/page.html | grep -v '<th' | head -n 1 | grep -q alpha"
fi
exit $failed
