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
    */gles/*) without_leaks "$program" > "$build/one.log" 2>&1 ;;
    *) "$program" > "$build/one.log" 2>&1 ;;
    esac
    count "${program#"$build"/}" $? "$build/one.log"
done
without_leaks sh tests/tools/command.sh "$build" > "$build/one.log" 2>&1
count tests/tools/command.sh $? "$build/one.log"
if [ -x "$build/tests/truth/truth_table" ]; then
    without_leaks "$build/tests/truth/truth_table" ${TRUTH_ARGS:-} build/scenes > "$build/truth.txt" 2>&1
    status=$?
    if [ $status = 0 ]; then echo "ok the masks of all scenes"; else echo "not ok the masks of all scenes"; grep -E 'WRONG|FEW|cannot|differ|no truth' "$build/truth.txt"; fi > "$build/one.log"
    count tests/truth/truth_table $status "$build/one.log"
fi
rm -f "$build/one.log"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
