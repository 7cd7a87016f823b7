#!/bin/sh
# install.sh BUILD VARIANT CC FEATURES - `make install` into a scratch root, and a program that is built from what pkg-config says and draws
# nothing: it makes a mesh and a plan. Fails when a header or the library is missing from what is installed.
set -e
build=$1 variant=$2 cc=$3 features=$4 root=$PWD/$1/installed
case $build in *arm*|*aarch64*) exit 0 ;; esac
rm -rf "$root"
${MAKE:-make} -s --no-print-directory VARIANT="$variant" FEATURES="$features" DESTDIR="$root" PREFIX=/usr install > /dev/null
cat > "$build/installed.c" <<'C'
#include <gn_matrix.h>
#include <gnomon_gles.h>
#include <stdio.h>
int main(void)
{
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t indices[3] = {0, 1, 2};
    const gn_mesh_desc desc = {positions, 3, 0, indices, 1};
    gn_context *context;
    gn_mesh *mesh;
    int ok = gn_context_create(NULL, &context) == GN_OK && gn_mesh_create(context, &desc, &mesh) == GN_OK &&
             gn_mesh_get_info(mesh)->edge_count == 3 && gn_gles_create(context, NULL, NULL) == GN_E_ARG;
    gn_mesh_destroy(mesh);
    gn_context_destroy(context);
    return !ok;
}
C
flags=$(PKG_CONFIG_PATH=$root/usr/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root ${PKG_CONFIG:-pkg-config} --cflags --libs gnomon)
case $build in *asan) flags="$flags -fsanitize=address,undefined" ;; esac
$cc -std=c99 "$build/installed.c" $flags -o "$build/installed.bin"
"$build/installed.bin"
rm -rf "$root" "$build/installed.c" "$build/installed.bin"
