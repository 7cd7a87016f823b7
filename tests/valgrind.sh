#!/bin/sh
# valgrind.sh BUILD - the tests without a GL, and one frame and mask on softpipe (llvmpipe's generated code is not checked).
# Fails on any error that is gnomon's: leaks, invalid accesses, uninitialised values.
build=$1
${CC:-cc} -shared -fPIC tests/support/keep_open.c -o "$build/keep_open.so"
check() {
    echo "valgrind: $*"
    LD_PRELOAD="$PWD/$build/keep_open.so" valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --suppressions=tests/mesa.supp "$@" > "$build/valgrind.log" 2>&1 ||
        { cat "$build/valgrind.log"; exit 1; }
}
set -e
for test in "$build"/tests/core/test_* "$build"/tests/gltf/test_gltf "$build"/tests/gltf/test_gltf_scene "$build"/tests/gles/test_walk "$build"/tests/extremes/test_numbers "$build"/tests/measure/test_metrics; do
    case $test in *.d|*.o|*test_laws) continue ;; esac
    check "$test"
done
export GALLIUM_DRIVER=softpipe
for scene in cube_point soup ortho; do
    check "$build/gnomon" render "build/scenes/$scene.gltf" --size 64x48 -o "$build/valgrind.png" --mask-dir "$build/valgrind" --report "$build/valgrind.json"
done
check "$build/gnomon" render build/scenes/cube_point.gltf --size 64x48 -o "$build/valgrind.png" --method refine
check "$build/gnomon" render build/scenes/cube_point.gltf --size 64x48 -o "$build/valgrind.png" --method count --scale 2 --upsample depth \
    --sharpen --masks-every 2 --frames 3
check "$build/gnomon" measure build/scenes/cube_point.gltf --size 64x48 -o "$build/valgrind" --methods stencil,refine --scales 1,2 --frames 2
rm -rf "$build/valgrind" "$build/valgrind.png" "$build/valgrind.json" "$build/valgrind.log" "$build/keep_open.so"
echo "valgrind: clean"
