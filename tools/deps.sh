#!/bin/sh
# deps.sh [drivers] - finds what building and testing gnomon needs and this machine lacks. As root on Debian it installs it; otherwise it
# prints the one command that does. Where nothing is missing it says nothing. With "drivers" what other drivers and boards need.
missing=
need() { # package, then a command that succeeds where it is there
    package=$1
    shift
    "$@" >/dev/null 2>&1 || missing="$missing $package"
}
header() { printf '#include <%s>\n' "$1" | ${CC:-gcc} -E - ; }
library() { ldconfig -p 2>/dev/null | grep -q "$1" || /sbin/ldconfig -p 2>/dev/null | grep -q "$1"; }

if [ "$1" = drivers ]; then
    need chromium-common test -e /usr/lib/chromium/vk_swiftshader_icd.json
    need libvulkan1 library libvulkan.so.1
    need libgl1 library libGL.so.1
    need libglx-mesa0 library libGLX_mesa.so.0
    need debootstrap command -v debootstrap
    need npm command -v npm
    need qemu-user-static command -v qemu-arm-static
    need gcc-arm-linux-gnueabihf command -v arm-linux-gnueabihf-gcc
    need libc6-dev-armhf-cross test -e /usr/arm-linux-gnueabihf/include/stdio.h
    need gcc-aarch64-linux-gnu command -v aarch64-linux-gnu-gcc
    need libc6-dev-arm64-cross test -e /usr/aarch64-linux-gnu/include/stdio.h
else
    need gcc command -v gcc
    need g++ command -v g++
    need libc6-dev header stdio.h
    need binutils command -v nm
    need pkg-config command -v pkg-config
    need python3 command -v python3
    need libcjson-dev header cjson/cJSON.h
    need libpng-dev header png.h
    need libmeshoptimizer-dev header meshoptimizer.h
    need libcmocka-dev test -e /usr/include/cmocka.h
    need libgles-dev header GLES2/gl2.h
    need libegl-dev header EGL/egl.h
    need libegl1 library libEGL.so.1
    need libgles2 library libGLESv2.so.2
    need libgl1-mesa-dri sh -c 'ls /usr/lib/*/dri/swrast_dri.so'
    need libosmesa6 library libOSMesa.so
    need libglfw3-dev header GLFW/glfw3.h
    need libglfw3 library libglfw.so.3
    need libfreetype-dev sh -c 'pkg-config --exists freetype2'
    need fonts-dejavu-core test -e /usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf
    need xvfb command -v Xvfb
    need x11-utils command -v xprop
    need gnuplot-nox command -v gnuplot
    need chromium command -v chromium
    need python3-skimage /usr/bin/python3 -c "import skimage"
    need fuzzylite command -v fuzzylite
fi

[ -z "$missing" ] && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    echo "installing:$missing"
    apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
else
    echo "missing:$missing"
    echo "on Debian: apt-get install --no-install-recommends$missing"
    exit 1
fi
