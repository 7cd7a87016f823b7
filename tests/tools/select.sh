#!/bin/sh
# select.sh BUILD - `gnomon select` and `gnomon calibrate`, and `gnomon render` within a budget. One line a test: "ok ..." or "not ok ...".
build=$1
gnomon=$build/gnomon
tmp=$build/select
scene=build/scenes/colours.gltf
. tests/tools/checks.sh

prints() { # what is to be printed, arguments of select
    wanted=$1
    shift
    got=$("$gnomon" select "$@" 2>&1)
    if [ "$got" = "$wanted" ]; then echo "ok select: $*"; else echo "not ok select: $* ('$got', wanted '$wanted')"; failed=1; fi
}

prints "stencil"
prints "count" --hide stencil
prints "signed" --hide stencil,fbo-rgba8,fbo-rgba4,fbo-rgb5a1,fbo-rgb565
prints "none" --budget-ms 0.01
prints "stencil@1/4-bilinear" --budget-ms 0.01 --quality rough
prints "stencil
stencil
none" --lights 3 --budget-ms 0.9 --fact layers=0.2 --fact edges=100 --fact pixels=20000
# Rautenbach's six and thirteen moving lights, near and far
prints "refine@1/4" --rules rules/rautenbach.fcl --prefer --fact moving=6 --fact nearness=0.9
prints "stencil@1/2-bilinear" --rules rules/rautenbach.fcl --prefer --fact moving=13 --fact nearness=0.1
prints "stencil" --rules rules/rautenbach.fcl --prefer --fact moving=0 --fact nearness=0.1
ok "explains: a sentence, facts, rules, ways" sh -c "$gnomon select --explain --budget-ms 20 --fact motion=0.5 > $tmp/why && \
    grep -q '^stencil: exact, .* ms and .* mJ predicted of 20 ms a frame' $tmp/why && grep -q '  motion 0.5: still 0.00, slow 0.00, fast 0.75' $tmp/why && \
    grep -q '  1.00 if power is high and headroom is ample then full is good' $tmp/why && grep -q '  stencil@1/2-depth: fair, .*: less accurate' $tmp/why"
ok "says what is not possible" sh -c "$gnomon select --explain --hide stencil | grep -q '  stencil: not possible here'"
if command -v gnuplot > /dev/null; then
    ok "a surface of an output" sh -c "$gnomon select -o $tmp/s.svg --surface layers,nearness --output refine && grep -q '<svg' $tmp/s.svg"
    ok "a surface of what is taken" sh -c "$gnomon select -o $tmp/w.svg --surface layers,pixels --budget-ms 12 && grep -q 'stencil' $tmp/w.svg"
fi
refuses 2 "no fact has that name (speed)" select --fact speed=1
refuses 2 "takes NAME=VALUE (motion)" select --fact motion
refuses 2 "takes a number from 0 to 1e12 (motion=fast)" select --fact motion=fast
refuses 2 "none, rough, fair, fine or exact (good)" select --quality good
refuses 2 "a surface takes -o FILE.svg and --surface A,B" select --surface layers
refuses 2 "the rules have no output of that name (tripled)" select -o "$tmp/x.svg" --surface layers,motion --output tripled
printf 'FUNCTION_BLOK' > "$tmp/rules.fcl"
refuses 1 "rules.fcl: rules: line 1, column 1: FUNCTION_BLOCK is missing before 'FUNCTION_BLOK'" select --rules "$tmp/rules.fcl"
printf 'method,scale\n' > "$tmp/bad.csv"
refuses 1 "bad.csv: knowledge: line 2, column 1: , is missing" select --knowledge "$tmp/bad.csv"
refuses 3 "no way that is possible here is exact: the best is fair" select --quality exact \
    --hide stencil,fbo-rgba8,fbo-rgba4,fbo-rgb5a1,fbo-rgb565,blend-subtract

ok "calibrates" "$gnomon" calibrate -o "$tmp/knowledge.csv"
ok "a row for each way that is possible" [ "$(grep -c . "$tmp/knowledge.csv")" -ge 25 ]
ok "select reads it" sh -c "$gnomon select --knowledge $tmp/knowledge.csv | grep -q '^stencil$'"
ok "without what is hidden" sh -c "$gnomon calibrate -o $tmp/hidden.csv --hide stencil && ! grep -q '^stencil' $tmp/hidden.csv && grep -q '^count' $tmp/hidden.csv"
refuses 2 "calibrate: takes -o FILE.csv and no scene (none given)" calibrate
refuses 1 "none.csv: cannot be read" calibrate -o "$tmp/k.csv" --trade "$tmp/none.csv"

"$gnomon" render $scene --size 160x120 -o "$tmp/plain.png"
ok "ample: exact, and the same picture" sh -c "$gnomon render $scene --size 160x120 --frames 3 --budget-ms 100000 --trace $tmp/ample.csv -o $tmp/ample.png && \
    cmp $tmp/plain.png $tmp/ample.png && [ \$(grep -c ',exact,\"stencil\",\"stencil\"' $tmp/ample.csv) = 3 ]"
# where small masks cost next to nothing
sed 's/^stencil,4,bilinear,rough.*/stencil,4,bilinear,rough,1,0,0,0,0,1,0,0,0,0,0,0/' "$tmp/knowledge.csv" > "$tmp/rough.csv"
ok "scarce: as rough as may be" sh -c "$gnomon render $scene --size 160x120 --frames 40 --budget-ms 0.001 --quality rough --knowledge $tmp/rough.csv --trace $tmp/scarce.csv \
    -o $tmp/scarce.png && tail -n 1 $tmp/scarce.csv | grep -q 'rough' && ! grep -q ',none,' $tmp/scarce.csv"
ok "or none" sh -c "$gnomon render $scene --size 160x120 --frames 40 --budget-ms 0.001 --trace $tmp/none.csv && tail -n 1 $tmp/none.csv | grep -q ',none,'"
ok "within power" sh -c "$gnomon render $scene --size 160x120 --frames 20 --budget-mw 0.5 --quality rough --trace $tmp/power.csv && ! tail -n 1 $tmp/power.csv | grep -q exact"
printf '# load\n2 lights 1\n4 lights 4\n5 host 3\n6 budget 50\n7 power 0.2\n' > "$tmp/load.txt"
ok "a load script" sh -c "$gnomon render $scene --size 160x120 --frames 8 --budget-ms 1000 --load $tmp/load.txt --trace $tmp/load.csv && \
    [ \$(cut -d, -f5 $tmp/load.csv | tr '\n' ' ' | tr -d ' ') = lights44114444 ] && [ \$(tail -n 1 $tmp/load.csv | cut -d, -f4,6) = 50,3 ]"
ok "without a stencil" sh -c "$gnomon render $scene --size 160x120 --frames 4 --hide stencil --budget-ms 1000 --trace $tmp/count.csv && tail -n 1 $tmp/count.csv | grep -q '\"count\"'"
ok "explains what it took" sh -c "$gnomon render $scene --size 160x120 --frames 2 --budget-ms 1000 --explain | grep -q '^light 3: stencil; wanted: stencil: exact'"
printf '2 lamps 1\n' > "$tmp/load.txt"
refuses 1 "line 1 is no frame with lights, host, budget or power" render $scene --budget-ms 9 --load "$tmp/load.txt" --trace "$tmp/x.csv"
ok "and writes nothing" [ ! -e "$tmp/x.csv" ]
refuses 2 "leave out --method" render $scene --budget-ms 9 --method count -o "$tmp/x.png"
refuses 2 "leave out --mask-dir" render $scene --budget-ms 9 --mask-dir "$tmp/masks"
exit $failed
