#!/bin/sh
# angle.sh FOLDER - ANGLE's libEGL and libGLESv2 over SwiftShader, from the npm package of a headless Chromium. 70 MB are fetched; needs npm and
# node, which unpacks brotli.
set -e
folder=$1
package=@sparticuz/chromium@138.0.2 # 112 lacks EXT_depth_clamp
rm -rf "$folder.part"
mkdir -p "$folder.part"
npm pack --silent --pack-destination "$folder.part" "$package" > /dev/null
tar xzf "$folder.part"/*.tgz -C "$folder.part" package/bin/swiftshader.tar.br
node -e 'const f = require("fs"), z = require("zlib");
f.writeFileSync(process.argv[2], z.brotliDecompressSync(f.readFileSync(process.argv[1])))' \
    "$folder.part/package/bin/swiftshader.tar.br" "$folder.part/swiftshader.tar"
mkdir -p "$folder"
tar xf "$folder.part/swiftshader.tar" -C "$folder"
rm -rf "$folder.part"
