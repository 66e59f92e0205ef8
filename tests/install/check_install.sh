#!/bin/sh
# Installs a build into a new folder and uses the installed copy from outside this tree. The
# installed program must draw. The examples must build by the documented commands, linked
# dynamically and statically. Every installed header must compile alone, every function that a
# header declares must be exported, and every link of an installed page must lead to a file.
#
# Usage: check_install.sh SOURCE_DIR BUILD_DIR COMPILER CXX_COMPILER
set -eu
source=$1 build=$2 compiler=$3 cxx=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix

fail() {
    echo "$*"
    exit 1
}
draws() { # PROGRAM FRAGMENTS
    [ "$("$1" "$folder/picture.ppm")" = "$2 fragments shaded" ] || fail "$1 draws something else"
}
# documented PAGE START: prints the line of a page that begins with START, for this installed copy.
documented() {
    line=$(grep -F -- "$2" "$source/docs/$1" | grep "^$2" | head -1)
    [ -n "$line" ] || fail "docs/$1 has no line that begins with: $2"
    echo "$line" | sed "s|build/release|$build|g; s|\<DIR\>|$prefix|g"
}

# The files move after they are installed: nothing in them may name the folder.
eval "$(documented install.md 'cmake --install')" >"$folder/log" || { cat "$folder/log"; exit 1; }
mv "$prefix" "$folder/moved"
prefix=$folder/moved

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

# The documented lines of CMake.
mkdir "$folder/cmake"
cp "$source/renderer/example/triangle.c" "$folder/cmake"
{
    echo 'cmake_minimum_required(VERSION 3.25)'
    echo 'project(documented LANGUAGES C)'
    documented libraries.md 'find_package(Diptych'
    echo 'add_executable(my_program triangle.c)'
    documented libraries.md 'target_link_libraries(my_program'
} >"$folder/cmake/CMakeLists.txt"
cmake -S "$folder/cmake" -B "$folder/cmake/build" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$compiler" >"$folder/log" 2>&1 &&
    cmake --build "$folder/cmake/build" >>"$folder/log" 2>&1 ||
    { cat "$folder/log"; fail "the documented lines of CMake do not work"; }
draws "$folder/cmake/build/my_program" 23224
sed -i 's/COMPONENTS pipeline/COMPONENTS pipelines/' "$folder/cmake/CMakeLists.txt"
! cmake -S "$folder/cmake" -B "$folder/cmake/wrong" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$compiler" >"$folder/log" 2>&1 || fail "an unknown component is accepted"

# The documented commands for pkg-config: shared, then static. `cc` is the compiler of this build.
mkdir "$folder/pkg" "$folder/bin"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$compiler" >"$folder/bin/cc"
chmod +x "$folder/bin/cc"
cp "$source/renderer/example/triangle.c" "$folder/pkg"
(
    cd "$folder/pkg"
    PATH=$folder/bin:$PATH
    eval "$(documented libraries.md 'export PKG_CONFIG_PATH')"
    eval "$(documented libraries.md 'cc triangle.c')"
    eval "$(documented libraries.md 'cc -static triangle.c')"
    draws ./triangle 23224
    draws ./triangle_static 23224
    readelf -d triangle | grep -q 'libdiptych-pipeline\.so\.[0-9]*\.[0-9]*\]' ||
        fail "the shared library's name lacks its minor version"
    # Libraries of other minor versions do not replace these, and a program can tell its library's.
    cat >version.c <<'TEXT'
#include "renderer/base/version.h"
#include <stdio.h>
int main(void) {
    puts(dip_version());
    return 0;
}
TEXT
    cc version.c $(pkg-config --cflags --libs diptych-base) -o version
    [ "$(./version)" = "$(pkg-config --modversion diptych-base)" ] ||
        fail "dip_version and pkg-config differ"
    # C++.
    "$cxx" -std=c++17 -Wall -Wextra -Werror "$source/tests/install/scene.cpp" -o scene \
        $(pkg-config --cflags --libs diptych-scene)
    ./scene
)

# Each header alone: in strict C without any definition, and in C++ with assertions.
include=$prefix/include/diptych
(cd "$include" && find . -name '*.h' | sed 's|^\./||' | sort) >"$folder/headers"
[ "$(wc -l <"$folder/headers")" -gt 30 ] || fail "there are few headers"
while read -r header; do
    printf "#include \"%s\"\nextern int unused;\n" "$header" >"$folder/header.c"
    cp "$folder/header.c" "$folder/header.cpp"
    "$compiler" -std=c17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$include" \
        "$folder/header.c" || fail "$header does not compile in C17"
    "$cxx" -std=c++17 -Wall -Wextra -Wpedantic -Werror -DDIP_ASSERTS=1 -fsyntax-only \
        -I"$include" "$folder/header.cpp" || fail "$header does not compile in C++ with assertions"
done <"$folder/headers"

# Every function that a header declares is exported by a shared library.
nm -D --defined-only "$prefix"/lib*/libdiptych-*.so "$prefix"/lib/*/libdiptych-*.so 2>/dev/null |
    awk 'NF == 3 { print $3 }' | sort -u >"$folder/exported"
(cd "$include" && xargs cat <"$folder/headers") | grep -E '^[A-Za-z].*\<dip_[a-z0-9_]+\(' |
    grep -vE '^(static|typedef|VEC_INLINE)' | sed -E 's/.*\<(dip_[a-z0-9_]+)\(.*/\1/' | sort -u \
    >"$folder/declared"
[ "$(wc -l <"$folder/declared")" -gt 100 ] || fail "few functions were found in the headers"
hidden=$(comm -13 "$folder/exported" "$folder/declared")
[ -z "$hidden" ] || fail "these functions are declared but not exported: $hidden"

# Links of installed pages.
pages=$prefix/share/doc/diptych
(cd "$pages" && find . -name '*.md') | while read -r page; do
    place=$pages/$(dirname "$page")
    grep -oE '\]\([^)# ]+' "$pages/$page" | sed 's/^](//' | grep -v '://' | while read -r link; do
        [ -e "$place/$link" ] || echo "$page: $link"
    done || true
done >"$folder/dead"
[ ! -s "$folder/dead" ] || { cat "$folder/dead"; fail "these links of installed pages are dead"; }
