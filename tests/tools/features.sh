#!/bin/sh
# features.sh BUILD CC - libraries built without some features (core/gni_features.h): each links with examples/minimal.c and, where it
# proves what the driver can do, draws it right; the smallest does so by what another build has proven, refuses what it lacks, is as
# small as it must be, and its masks are right. One line a test: "ok ..." or "not ok ...".
build=$1 cc=$2
gnomon=$build/gnomon
tmp=$build/features
. tests/tools/checks.sh
# shellcheck disable=SC2086,SC2046 # lists
EGL_PLATFORM=surfaceless
export EGL_PLATFORM
unset MAKEFLAGS MAKELEVEL MFLAGS

make_with() { # variant, features, targets in its folder
    variant=$1 features=$2
    shift 2
    folder=build/$variant-with$(for f in $features; do echo "$f"; done | LC_ALL=C sort | sed 's/^/-/' | tr -d '\n')
    make -s -j2 "CC=$cc" WERROR=-Werror VARIANT="$variant" FEATURES="$features" $(for t; do echo "$folder/$t"; done)
}
right() { # program, its other arguments
    program=$1
    shift
    "$program" "$tmp/frame.ppm" "$@" > /dev/null && "$python" tests/tools/minimal_truth.py "$tmp/frame.ppm"
}

rest="welding clusters solids"
for features in \
    "" \
    "messages" \
    "proofs" \
    "$rest proofs messages" \
    "culling cache $rest proofs messages text" \
    "culling batches cache $rest proofs messages text" \
    "culling batches fallback cache $rest proofs messages text" \
    "culling batches fallback refine $rest proofs messages text" \
    "culling batches fallback refine cache proofs messages" \
    "culling batches fallback refine cache welding solids proofs messages text selector" \
    "culling batches fallback refine cache welding clusters proofs messages text selector" \
    "culling batches fallback refine cache $rest messages text selector" \
    "culling batches fallback refine cache $rest proofs" \
    "culling batches fallback refine cache $rest proofs messages text"; do
    ok "is built with: ${features:-nothing}" make_with debug "$features" libgnomon.a examples/minimal
    case $features in
    *proofs*) ok "and draws right with: $features" right "$folder/examples/minimal" ;;
    esac
done

small=build/debug-with/examples/minimal
ok "what is proven here is saved" "$gnomon" probe --platform egl --save "$tmp/saved"
ok "the smallest draws right by that" right $small "$tmp/saved"
GALLIUM_DRIVER=softpipe "$gnomon" probe --platform egl --save "$tmp/softpipe" > /dev/null
GALLIUM_DRIVER=softpipe ok "on softpipe too" right $small "$tmp/softpipe"
ok "and not by what another driver has proven" sh -c "! $small '$tmp/none.ppm' '$tmp/softpipe' && [ ! -e '$tmp/none.ppm' ]"
ok "nor by nothing, and says why where it has messages" sh -c "! build/debug-with-messages/examples/minimal '$tmp/none.ppm' 2> '$tmp/err' && \
    grep -q 'proves nothing' '$tmp/err' && [ ! -e '$tmp/none.ppm' ]"
ok "a feature that stands on others is not built without" sh -c "make -n FEATURES=selector all 2>&1 | grep -q 'selector needs'"
ok "nor one that does not exist" sh -c "make -n FEATURES=none all 2>&1 | grep -q 'FEATURES has none'"

# Scenes under an orthographic camera want culling, and one has a matrix without inverse, which wants solids.
scenes=$(awk '$3 != "extreme" && $1 !~ /^(ortho|flattened)/ {print $1}' build/scenes/scenes.txt)
truth() { "$folder/tests/truth/truth_table" --size 160x120 --drivers llvmpipe,softpipe "$@"; }
refuses_scene() { # scene, feature
    truth --ways zfail build/scenes "$1" > "$tmp/refused" 2>&1
    grep -q "cannot be drawn: .*lacks the feature $2" "$tmp/refused"
}
ok "with proofs: tests are built" make_with release "messages proofs" tests/truth/truth_table tests/core/test_room
ok "with proofs: plans stay in their memory" "$folder/tests/core/test_room"
ok "with proofs: masks are right" truth --ways zfail build/scenes $scenes
ok "with proofs: so are those of the extremes" truth --ways zfail --extremes build/scenes
ok "and an orthographic camera is refused" refuses_scene ortho culling
ok "as is a matrix without inverse" refuses_scene flattened solids
ok "with culling: tests are built" make_with release "culling messages proofs" tests/truth/truth_table tests/core/test_room tests/core/test_laws
ok "with culling: plans stay in their memory" "$folder/tests/core/test_room"
ok "with culling: volumes close, and shadow what is blocked" "$folder/tests/core/test_laws"
ok "with culling: masks are right" truth --ways zfail,stencil build/scenes $scenes $(awk '$1 ~ /^ortho/ {print $1}' build/scenes/scenes.txt)

if command -v arm-linux-gnueabihf-gcc > /dev/null; then
    arm=build/arm-linux-gnueabihf-size-with
    ok "is built for armhf" make -s -j2 CROSS=arm-linux-gnueabihf- VARIANT=size FEATURES= $arm/libgnomon.a
    bytes=$("$python" tests/taken.py arm-linux-gnueabihf- $arm)
    ok "the smallest takes less than 24 KiB of code and constants on armhf: $bytes" \
        test $((${bytes%% *} + $(echo "$bytes" | cut -d' ' -f2))) -lt 24576
fi
exit $failed
