#!/bin/sh
# Installs a build into a new folder and uses the installed copy from outside this tree. The
# installed program must draw. The examples must build with the CMake package and with pkg-config,
# linked dynamically and statically. A C++ program must be able to call the libraries.
#
# Usage: check_install.sh SOURCE_DIR BUILD_DIR COMPILER CXX_COMPILER
set -eu
source=$1 build=$2 compiler=$3 cxx=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
cmake --install "$build" --prefix "$prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }

fail() {
    echo "$*"
    exit 1
}
draws() { # PROGRAM FRAGMENTS
    [ "$("$1" "$folder/picture.ppm")" = "$2 fragments shaded" ] || fail "$1 draws something else"
}

# The program must draw. The files that its help and its messages name must be installed.
"$prefix/bin/diptych" dump --hash --frames 0:1 | grep -q '^0000 current ' ||
    fail "the installed program does not draw"
for file in share/doc/diptych/README.md share/doc/diptych/docs/config.md \
    share/diptych/config/courtyard.ini; do
    [ -f "$prefix/$file" ] || fail "$file is not installed"
done

# The CMake package. The examples' folder is a project of its own.
cp -r "$source/renderer/example" "$folder/example"
cmake -S "$folder/example" -B "$folder/example/build" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$compiler" >"$folder/log" 2>&1 &&
    cmake --build "$folder/example/build" >>"$folder/log" 2>&1 ||
    { cat "$folder/log"; fail "the examples do not build with the CMake package"; }
draws "$folder/example/build/dip_example_triangle" 23224
draws "$folder/example/build/dip_example_textured" 49148
[ "$("$folder/example/build/dip_example_compare" aa=none aa=4,af=16 "$folder/picture.ppm")" = \
    "51884 and 207537 samples shown" ] || fail "dip_example_compare draws something else"

# pkg-config: shared first, then static.
libdir=$(dirname "$(find "$prefix" -name 'diptych-pipeline.pc')")
export PKG_CONFIG_PATH="$libdir"
"$compiler" "$source/renderer/example/triangle.c" -o "$folder/shared" \
    $(pkg-config --define-variable=prefix="$prefix" --cflags --libs diptych-pipeline) \
    -Wl,-rpath,"$libdir/.."
draws "$folder/shared" 23224
"$compiler" -static "$source/renderer/example/textured.c" -o "$folder/static" \
    $(pkg-config --static --define-variable=prefix="$prefix" --cflags --libs diptych-pipeline)
draws "$folder/static" 49148

# C++.
"$cxx" -std=c++17 -Wall -Wextra -Werror "$source/tests/install/scene.cpp" -o "$folder/scene" \
    $(pkg-config --define-variable=prefix="$prefix" --cflags --libs diptych-scene) \
    -Wl,-rpath,"$libdir/.."
"$folder/scene"
