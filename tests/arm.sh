#!/bin/sh
# arm.sh ARCH BUILD HOST_BUILD - what was built for armhf or arm64 (make test-arm), run by qemu-user with Mesa's softpipe: programs that
# need no GL, examples/minimal.c against rays, and masks that are the same bytes as softpipe's here.
arch=$1 build=$2 host=$3
case $arch in armhf) qemu=qemu-arm-static ;; *) qemu=qemu-aarch64-static ;; esac
root=build/root-$arch
tmp=$build/arm
gnomon=$host/gnomon
. tests/tools/checks.sh
GALLIUM_DRIVER=softpipe EGL_PLATFORM=surfaceless
export GALLIUM_DRIVER EGL_PLATFORM

there() { "$qemu" -L "$root" "$@"; }
same_masks() { # scene
    there "$build/gnomon" render "build/scenes/$1.gltf" --size 160x120 --platform egl --mask-dir "$tmp/$1" &&
        "$host/gnomon" render "build/scenes/$1.gltf" --size 160x120 --platform egl --mask-dir "$tmp/$1.host" &&
        diff -r "$tmp/$1" "$tmp/$1.host"
}
minimal() { there "$build/examples/minimal" "$tmp/minimal.ppm" && "$python" tests/tools/minimal_truth.py "$tmp/minimal.ppm"; }

for program in "$build"/tests/core/test_* "$build"/tests/extremes/test_* "$build"/tests/rules/test_* "$build"/tests/select/test_*; do
    case $program in *.o | *.d) continue ;; esac
    ok "$arch ${program#"$build"/}" there "$program"
done
ok "$arch examples/minimal" minimal
for scene in cube_sun camera_in_shadow hole soup ortho two_lamps_nested; do
    ok "$arch masks of $scene" same_masks $scene
done
exit $failed
