#!/bin/sh
# rebuild.sh BUILD CC - instructions a triangle that rebuilding a volume takes, counted under callgrind, as CSV: facing one by
# one, in vectors (as the compiler has them by default, and AVX2's), and by the tree; sides and caps by the tree and of every
# triangle; and the one-time build. Lumps of 1,000 to 1,000,000 triangles, and the models of Debian's glmark2-data, if there.
# Each figure is the difference of two runs, so that start and set-up do not count.
build=$1/bench cc=$2
sources="core/*.c port/port_libc.c tests/support/pile.c tests/bench/bench_rebuild.c"
flags="-std=c99 -O2 -ffp-contract=off -Iport -Icore -I$1/rules -Itests/support"
mkdir -p "$build"
# shellcheck disable=SC2086 # lists
for way in scalar: vectors: avx2:; do
    case $way in scalar:) more=-DGNI_SCALAR ;; avx2:) more=-mavx2 ;; *) more= ;; esac
    $cc $flags $more $sources -lm -o "$build/rebuild-${way%:}" 2>/dev/null || rm -f "$build/rebuild-${way%:}"
done

count() { # way, step, triangles or model, times
    valgrind --tool=callgrind --callgrind-out-file="$build/callgrind.out" "$build/rebuild-$1" "$2" "$3" "$4" 2>&1 >/dev/null |
        awk '/Collected/ {print $4}'
}
per_triangle() { # way, step, triangles or model
    [ -x "$build/rebuild-$1" ] || { printf ,; return; }
    times=8
    [ "$2" = build ] && times=1
    triangles=$("$build/rebuild-$1" "$2" "$3" 0 | cut -d, -f1)
    awk -v a="$(count "$1" "$2" "$3" 0)" -v b="$(count "$1" "$2" "$3" "$times")" -v n="$triangles" -v t="$times" \
        'BEGIN {printf ",%.2f", (b - a) / t / n}'
}

echo "mesh,triangles,looked_at,silhouette_edges,facing_scalar,facing_vectors,facing_avx2,facing_tree,sides_full_scan,sides_and_caps_full_scan,sides_tree,sides_and_caps_tree,build"
for mesh in 1000 3700 10000 48000 100000 200000 1000000 /usr/share/glmark2/models/*.obj /usr/share/glmark2/models/*.3ds; do
    case $mesh in *\**) continue ;; esac
    printf '%s,%s' "$(basename "$mesh")" "$("$build/rebuild-vectors" sides "$mesh" 8 | cut -d, -f1-3)"
    per_triangle scalar scan "$mesh"
    per_triangle vectors scan "$mesh"
    per_triangle avx2 scan "$mesh"
    per_triangle vectors tree "$mesh"
    per_triangle vectors all-sides "$mesh"
    per_triangle vectors all-caps "$mesh"
    per_triangle vectors sides "$mesh"
    per_triangle vectors caps "$mesh"
    per_triangle vectors build "$mesh"
    echo
done
