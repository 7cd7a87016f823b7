#!/bin/sh
# lanes.sh BUILD CC - the index streams of volumes are the same bytes, one triangle at a time, in the compiler's own vectors, in
# AVX2's where the processor has them, and in those of armhf and arm64 where cross compilers and qemu are installed.
build=$1/lanes cc=$2
mkdir -p "$build"
flags="-std=c99 -O2 -ffp-contract=off -Iport -Icore -I$1/rules -Itests/support"
sources="core/*.c port/port_libc.c tests/support/pile.c tests/bench/bench_rebuild.c"
expected=
# shellcheck disable=SC2086 # lists
compare() { # name, what runs it, compiler and flags
    name=$1 run=$2
    shift 2
    if ! "$@" $flags $sources -lm -o "$build/$name" 2> "$build/$name.log"; then
        echo "not ok $name compiles"
        cat "$build/$name.log"
        return
    fi
    found=$(for triangles in 500 3700 20000; do $run "$build/$name" streams $triangles 12; done)
    expected=${expected:-$found}
    if [ "$found" = "$expected" ] && [ -n "$found" ]; then echo "ok streams, $name"; else echo "not ok streams, $name: $found, not $expected"; fi
}
compare scalar "" "$cc" -DGNI_SCALAR
compare vectors "" "$cc"
grep -q avx2 /proc/cpuinfo && compare avx2 "" "$cc" -mavx2 -mfma
command -v aarch64-linux-gnu-gcc >/dev/null && command -v qemu-aarch64-static >/dev/null &&
    compare neon qemu-aarch64-static aarch64-linux-gnu-gcc -static
command -v arm-linux-gnueabihf-gcc >/dev/null && command -v qemu-arm-static >/dev/null && {
    compare armhf qemu-arm-static arm-linux-gnueabihf-gcc -static
    compare armhf-neon qemu-arm-static arm-linux-gnueabihf-gcc -static -mfpu=neon
}
exit 0
