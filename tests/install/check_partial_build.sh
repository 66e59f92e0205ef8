#!/bin/sh
# ./run builds the program alone. Installing and packing such a build must still work: what is
# missing is built first. This test builds even less: nothing at all.
#
# Usage: check_partial_build.sh SOURCE_DIR COMPILER
set -eu
source=$1 compiler=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -S "$source" -B "$folder/build" -DBUILD_TESTING=OFF -DCMAKE_C_COMPILER="$compiler" \
    -G Ninja >"$folder/log" 2>&1 &&
    cmake --install "$folder/build" --prefix "$folder/prefix" >>"$folder/log" 2>&1 &&
    cpack --config "$folder/build/CPackConfig.cmake" >>"$folder/log" 2>&1 ||
    { tail -30 "$folder/log"; echo "a build without libraries cannot be installed"; exit 1; }
for file in bin/diptych share/man/man1/diptych.1 lib/libdiptych-scene.so; do
    [ -f "$folder/prefix/$file" ] || { echo "$file is not installed"; exit 1; }
done
[ "$(find "$folder/build" -maxdepth 1 -name 'diptych-*.zip' -size +1M)" ] ||
    { echo "there is no archive"; exit 1; }
