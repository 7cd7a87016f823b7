#!/bin/sh
# truth.sh BUILD [truth_table's options]: the table over all test scenes at 640x480.
build=$1
shift
exec "$build/tests/truth/truth_table" "$@" build/scenes
