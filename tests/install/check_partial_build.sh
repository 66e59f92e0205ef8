#!/bin/sh
# ./run builds the program alone. Installing and packing such a build must still work: what is
# missing, or older than the sources, is built first. This test builds even less: nothing at all.
#
# Usage: check_partial_build.sh SOURCE_DIR COMPILER
set -eu
source=$1 compiler=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/source"
for part in "$source"/*; do
    [ "$(basename "$part")" = build ] || cp -r "$part" "$folder/source"
done
cmake -S "$folder/source" -B "$folder/build" -DBUILD_TESTING=OFF -DCMAKE_C_COMPILER="$compiler" \
    -G Ninja >"$folder/log" 2>&1 &&
    cmake --install "$folder/build" --prefix "$folder/prefix" >>"$folder/log" 2>&1 &&
    cpack --config "$folder/build/CPackConfig.cmake" >>"$folder/log" 2>&1 ||
    { tail -30 "$folder/log"; echo "a build without libraries cannot be installed"; exit 1; }
for file in bin/diptych share/man/man1/diptych.1 lib/libdiptych-scene.so; do
    [ -f "$folder/prefix/$file" ] || { echo "$file is not installed"; exit 1; }
done
[ "$(find "$folder/build" -maxdepth 1 -name 'diptych-*.zip' -size +1M)" ] ||
    { echo "there is no archive"; exit 1; }

# A header of an older version would not fit the libraries.
echo "void dip_of_a_newer_version(void);" >>"$folder/source/app/files/y4m.h"
cmake --install "$folder/build" --prefix "$folder/prefix" >>"$folder/log" 2>&1
grep -q dip_of_a_newer_version "$folder/prefix/include/diptych/diptych.cdef" ||
    { echo "what is older than the sources is installed"; exit 1; }
