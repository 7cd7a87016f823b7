#!/bin/sh
# arm_root.sh ARCH FOLDER - a root of Debian for armhf or arm64: what the command and its tests need there, unpacked and not set up,
# since qemu-user runs programs in it and nothing else. Some 400 MB; needs debootstrap.
set -e
arch=$1 root=$2
packages=libc6-dev,libegl1,libgles2,libegl-dev,libgles-dev,libgl1-mesa-dri,libosmesa6,libcjson-dev,libpng-dev,libmeshoptimizer-dev,libcmocka-dev,libglfw3-dev
[ -n "$root" ] || { echo "arm_root: no folder"; exit 1; }
[ -e "$root/.whole" ] && exit 0
# The archive that this machine itself installs from.
set -- $(apt-get indextargets --format '$(SITE) $(CODENAME)' | head -n 1)
site=$1 release=$2
[ -n "$release" ] || { echo "arm_root: apt knows no archive to install from"; exit 1; }
rm -rf "$root.part"
mkdir -p "$root.part"
debootstrap --foreign --arch="$arch" --variant=minbase --include="$packages" "$release" "$root.part" "$site" > "$root.log" 2>&1 ||
    { tail -n 3 "$root.log"; exit 1; }
for package in "$root.part"/var/cache/apt/archives/*.deb; do
    dpkg -x "$package" "$root.part"
done
rm -rf "$root.part"/var/cache/apt/archives "$root"
touch "$root.part/.whole"
mv "$root.part" "$root"
