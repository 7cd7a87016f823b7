#!/bin/sh
# minimal.sh BUILD - examples/minimal.c, run on what Mesa has, against rays; and that it is as short as docs/porting.md says. One line
# a test: "ok ..." or "not ok ...".
build=$1
gnomon=$build/gnomon
tmp=$build/minimal
. tests/tools/checks.sh
EGL_PLATFORM=surfaceless
export EGL_PLATFORM

# The way that it says that it took, by words of it; and the picture.
right() {
    "$build/examples/minimal" "$tmp/frame.ppm" > "$tmp/way" && grep -q "$1" "$tmp/way" &&
        "$python" tests/tools/minimal_truth.py "$tmp/frame.ppm"
}

ok "exact shadows on llvmpipe" right '^exact for any view$'
GALLIUM_DRIVER=softpipe ok "on softpipe" right '^exact for any view$'
GNOMON_HIDE=two-sided-stencil,stencil-wrap ok "with a stencil of one side that does not wrap" right 'one side at a time.*counts from -128'
GNOMON_HIDE=w0,depth-clamp ok "where nothing may be at infinity" right 'volumes end behind what is seen'
ok "in less than 150 lines" sh -c '[ "$(wc -l < examples/minimal.c)" -lt 150 ]'
GNOMON_HIDE=stencil ok "without a stencil: by counting in alpha" right 'the best that is possible here: count makes its mask in a texture'
ok "without depth it says so, and draws nothing" sh -c "! GNOMON_HIDE=depth '$build/examples/minimal' '$tmp/none.ppm' 2> '$tmp/err' && \
    grep -q 'minimal: .*depth' '$tmp/err' && [ ! -e '$tmp/none.ppm' ]"
exit $failed
