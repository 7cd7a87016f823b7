#!/bin/sh
# run.sh BUILD PROGRAM... - runs every test program, then the command's tests and the table of truth; closes with how many
# passed. A program counts its own tests (cmocka); a script is one test a line that says "ok" or "not ok".
build=$1
shift
passed=0 failed=0
log=$build/tests.log
[ $# -gt 0 ] || { echo "no tests"; exit 1; }
: > "$log"

count() { # name, exit status, output file
    p=$(awk '/^\[  PASSED  \] [0-9]+ test/ {n += $4} END {print n + 0}' "$3")
    f=$(awk '/^\[  FAILED  \] [0-9]+ test/ {n += $4} END {print n + 0}' "$3")
    p=$((p + $(grep -c '^ok ' "$3")))
    f=$((f + $(grep -c '^not ok ' "$3")))
    if [ "$2" != 0 ] && [ "$f" = 0 ]; then f=1; fi
    if [ "$p" = 0 ] && [ "$f" = 0 ]; then f=1; echo "$1 ran no test"; fi
    passed=$((passed + p)) failed=$((failed + f))
    if [ "$f" = 0 ]; then echo "$1: $p passed"; else echo "$1: $f FAILED"; cat "$3"; fi
    cat "$3" >> "$log"
}

# GL drivers keep memory until the process ends, and once unloaded they have no names to be excused by: leaks of what opens one are
# looked for by valgrind and by the counting port instead.
without_leaks() { ASAN_OPTIONS=detect_leaks=0 "$@"; }

for program in "$@"; do
    case $program in
    */gles/* | */test_scale) without_leaks "$program" > "$build/one.log" 2>&1 ;;
    *) "$program" > "$build/one.log" 2>&1 ;;
    esac
    count "${program#"$build"/}" $? "$build/one.log"
    case $program in
    */test_small | */test_upsample | */test_kept)
        GALLIUM_DRIVER=softpipe without_leaks "$program" > "$build/one.log" 2>&1
        count "${program#"$build"/}, softpipe" $? "$build/one.log"
        ;;
    esac
done
without_leaks sh tests/tools/command.sh "$build" > "$build/one.log" 2>&1
count tests/tools/command.sh $? "$build/one.log"
without_leaks sh tests/tools/measure.sh "$build" > "$build/one.log" 2>&1
count tests/tools/measure.sh $? "$build/one.log"
without_leaks sh tests/tools/select.sh "$build" > "$build/one.log" 2>&1
count tests/tools/select.sh $? "$build/one.log"
without_leaks sh tests/tools/minimal.sh "$build" > "$build/one.log" 2>&1
count tests/tools/minimal.sh $? "$build/one.log"
without_leaks sh tests/tools/view.sh "$build" > "$build/one.log" 2>&1
count tests/tools/view.sh $? "$build/one.log"
case $build in *asan*) ;; *)
    sh tests/core/lanes.sh "$build" "${CC:-gcc}" > "$build/one.log" 2>&1
    count tests/core/lanes.sh $? "$build/one.log"
    sh tests/tools/features.sh "$build" "${CC:-gcc}" > "$build/one.log" 2>&1
    count tests/tools/features.sh $? "$build/one.log"
    ;;
esac
# What is drawn, the name of the table's file, its options.
table() {
    what=$1 file=$build/$2.txt
    shift 2
    without_leaks "$build/tests/truth/truth_table" "$@" build/scenes > "$file" 2>&1
    status=$?
    if [ $status = 0 ]; then echo "ok $what"; else echo "not ok $what"; grep -E 'WRONG|FEW|cannot|differ|DIFFER|no truth' "$file"; fi > "$build/one.log"
    count "tests/truth/truth_table, $what" $status "$build/one.log"
}
table "all scenes" truth ${TRUTH_ARGS:-}
table "the extremes" extremes --extremes --size 160x120
table "the extremes in 16 bits of depth" extremes16 --extremes --size 160x120 --depth 16
table "small scenes in 16 bits of depth" truth16 --size 160x120 --depth 16 --drivers llvmpipe
table "refined small masks" refine --size 160x120 --ways zfail,refine
table "refined small masks, the extremes" refine-extremes --extremes --size 160x120 --drivers llvmpipe,softpipe --ways zfail,refine
without_stencil=zfail,count,count-565,count-two,signed,signed-fbo,alpha,screen,mediump
table "counts in colour" color --size 160x120 --ways $without_stencil
table "counts in colour, the extremes" color-extremes --extremes --size 160x120 --drivers llvmpipe,softpipe --ways $without_stencil
table "counts in colour, a target of 565 without stencil and alpha" color-565 --size 160x120 --drivers llvmpipe,osmesa \
    --bits 5,6,5,0,16,0 --ways $without_stencil
table "counts in colour, a target without alpha" color-rgb --size 160x120 --drivers llvmpipe --bits 8,8,8,0,24,0 --ways $without_stencil
table "counts in colour, a target without stencil" color-rgba --size 160x120 --drivers llvmpipe,osmesa --bits 8,8,8,8,24,0 \
    --ways $without_stencil
# shellcheck disable=SC2046 # scene by scene
if without_leaks "$build/tests/bench/bench_stencil" $(awk '{print $1}' build/scenes/scenes.txt) > "$build/stencil.csv" 2> "$build/stencil.err"; then
    echo "ok stencil costs no more than z-fail"
else
    echo "not ok stencil costs no more than z-fail"
    cat "$build/stencil.err"
fi > "$build/one.log"
count tests/bench/bench_stencil 0 "$build/one.log"
rm -f "$build/one.log"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
