#!/bin/sh
# Uses an installed copy from outside this tree. The installed program must draw. The installed
# examples, the programs in docs/pipeline.md and docs/post.md and a program in C++ must build by the
# documented commands, linked dynamically and statically, and every link of an installed page must
# lead to a file.
#
# Usage: check_install.sh SOURCE_DIR COPY_DIR COMPILER CXX_COMPILER
set -eu
source=$1 copy=$2 compiler=$3 cxx=$4
. "$source/tests/install/installed.sh"
examples=$prefix/share/doc/diptych/renderer/example
warnings="-Wall -Wextra -Wpedantic -Werror"

draws() { # PROGRAM FRAGMENTS
    [ "$("$1" "$folder/picture.ppm")" = "$2 fragments shaded" ] || fail "$1 draws something else"
}
# With make, CMake takes about twice the processor time that it takes with Ninja.
ninja=
command -v ninja >/dev/null && ninja='-G Ninja'
# build_project FOLDER [CMAKE OPTION]...: builds a CMake project against the installed copy.
build_project() {
    project=$1
    shift
    run_quietly "the project $project cannot be configured" cmake -S "$project" -B "$project/build" \
        -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$compiler" -DCMAKE_CXX_COMPILER="$cxx" "$@"
    run_quietly "the project $project does not build" cmake --build "$project/build"
}

# The program must draw. The files that its help and its messages name must be installed.
"$prefix/bin/diptych" dump --hash --frames 0:1 | grep -q '^0000 current ' ||
    fail "the installed program does not draw"
"$prefix/bin/diptych" dump --hash --frames 0:1 --scene torture --size 64x48 | grep -q '^0000 current ' ||
    fail "the installed program does not draw the scene torture"
for file in share/doc/diptych/README.md share/doc/diptych/docs/config.md \
    share/diptych/config/courtyard.ini; do
    [ -f "$prefix/$file" ] || fail "$file is not installed"
done

# The CMake package. The examples' folder is a project of its own.
cp -r "$examples" "$folder/example"
build_project "$folder/example" $ninja
draws "$folder/example/build/dip_example_triangle" 23224
draws "$folder/example/build/dip_example_textured" 49148
[ "$("$folder/example/build/dip_example_compare" aa=none aa=4,af=16 "$folder/picture.ppm")" = \
    "51884 and 207537 samples shown" ] || fail "dip_example_compare draws something else"

# The documented lines of CMake, with CMake's own choice of a generator.
mkdir "$folder/cmake"
cp "$examples/triangle.c" "$folder/cmake"
{
    echo 'cmake_minimum_required(VERSION 3.25)'
    echo 'project(documented LANGUAGES C)'
    documented libraries.md 'find_package(Diptych'
    echo 'add_executable(my_program triangle.c)'
    documented libraries.md 'target_link_libraries(my_program'
} >"$folder/cmake/CMakeLists.txt"
build_project "$folder/cmake"
draws "$folder/cmake/build/my_program" 23224
sed -i 's/COMPONENTS pipeline/COMPONENTS pipelines/' "$folder/cmake/CMakeLists.txt"
! cmake -S "$folder/cmake" -B "$folder/cmake/wrong" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$compiler" >"$folder/log" 2>&1 || fail "an unknown component is accepted"

# first_program PAGE: the first block of C of an installed page, which is a whole program.
first_program() {
    awk '/^```c$/ { inside = 1; next } /^```$/ && inside { exit } inside' \
        "$prefix/share/doc/diptych/docs/$1"
}
first_program pipeline.md >"$folder/first.c"
first_draws() { # PROGRAM: it writes first.png.
    [ "$("$1")" = "37015 fragments shaded" ] || fail "the guide's first program, $1, draws something else"
    [ "$(od -A n -t x1 -N 24 first.png | tr -d ' \n')" = \
        89504e470d0a1a0a0000000d4948445200000140000000f0 ] ||
        fail "the guide's first program, $1, writes no PNG of 320x240 pixels"
    rm first.png
}
# The border of the white area of docs/post.md crosses 160 columns and has 31 steps to the right. What
# the program makes of it must be what the installed `diptych compare` makes of it.
first_program post.md >"$folder/smaa.c"
smooths() { # PROGRAM: it writes jagged.png and smooth.png.
    [ "$("$1")" = "191 pixels at an edge" ] || fail "the program of docs/post.md, $1, finds other edges"
    for filter in none smaa; do
        "$prefix/bin/diptych" compare jagged.png smooth.png --filter $filter --json >"$folder/$filter" ||
            fail "the pictures of $1 cannot be compared"
    done
    grep -q '"different_pixels": 0,' "$folder/smaa" && ! grep -q '"different_pixels": 0,' "$folder/none" ||
        fail "the program of docs/post.md, $1, does not apply SMAA"
    rm jagged.png smooth.png
}

# The programs of both pages, and programs in C++ with a scene alone and with models, camera paths and
# metrics: static, then shared. The measuring example: static.
mkdir "$folder/model"
cp "$folder/first.c" "$folder/smaa.c" "$source/tests/install/scene.cpp" "$source/tests/install/model.cpp" \
    "$prefix/share/doc/diptych/app/measure/example/two_ways.c" "$folder/model"
cat >"$folder/model/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(model LANGUAGES C CXX)
find_package(Diptych REQUIRED COMPONENTS assets campaths measure)
foreach(kind "" "_shared")
    add_executable(first${kind} first.c)
    target_link_libraries(first${kind} PRIVATE Diptych::pipeline${kind} Diptych::files${kind})
    add_executable(smaa${kind} smaa.c)
    target_link_libraries(smaa${kind} PRIVATE Diptych::post${kind} Diptych::files${kind})
    add_executable(scene${kind} scene.cpp)
    target_compile_features(scene${kind} PRIVATE cxx_std_17)
    target_link_libraries(scene${kind} PRIVATE Diptych::scene${kind})
    add_executable(model${kind} model.cpp)
    target_compile_features(model${kind} PRIVATE cxx_std_17)
    target_link_libraries(model${kind} PRIVATE
        Diptych::assets${kind} Diptych::campaths${kind} Diptych::measure${kind})
endforeach()
add_executable(two_ways two_ways.c)
target_link_libraries(two_ways PRIVATE Diptych::measure m)
TEXT
build_project "$folder/model" $ninja
for kind in "" _shared; do
    (cd "$folder" && first_draws "$folder/model/build/first$kind")
    (cd "$folder" && smooths "$folder/model/build/smaa$kind")
    "$folder/model/build/scene$kind" || fail "scene$kind fails"
    "$folder/model/build/model$kind" "$prefix/share/diptych" || fail "model$kind fails"
done
"$folder/model/build/two_ways" >"$folder/log" || fail "two_ways fails"

# The documented commands for pkg-config: shared, then static. `cc` is the compiler of this build.
mkdir "$folder/pkg" "$folder/bin"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$(command -v "$compiler")" >"$folder/bin/cc"
chmod +x "$folder/bin/cc"
cp "$examples/triangle.c" "$folder/pkg"
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
#include <diptych/renderer/base/version.h>
#include <stdio.h>
int main(void) {
    puts(dip_version());
    return 0;
}
TEXT
    cc version.c $(pkg-config --cflags --libs diptych-base) -o version
    [ "$(./version)" = "$(pkg-config --modversion diptych-base)" ] ||
        fail "dip_version and pkg-config differ"
    # C++: shared, then static.
    "$cxx" -std=c++17 $warnings "$source/tests/install/scene.cpp" -o scene \
        $(pkg-config --cflags --libs diptych-scene)
    ./scene
    "$cxx" -std=c++17 -static $warnings "$source/tests/install/scene.cpp" -o scene_static \
        $(pkg-config --static --cflags --libs diptych-scene)
    ./scene_static
    # Models, camera paths and metrics.
    "$cxx" -std=c++17 $warnings "$source/tests/install/model.cpp" -o model \
        $(pkg-config --cflags --libs diptych-assets diptych-campaths diptych-measure)
    ./model "$prefix/share/diptych"

    # The guide's program must also build beside folders whose headers have the same names as those
    # of this tree. Shared, then static.
    cp "$folder/first.c" "$folder/smaa.c" .
    mkdir -p renderer/base renderer/pipeline
    echo '#error "This is the header of another program."' >renderer/base/error.h
    cp renderer/base/error.h renderer/pipeline/pipeline.h
    cc -std=c11 $warnings -I. -c first.c -o first.o $(pkg-config --cflags diptych-pipeline)
    unset PKG_CONFIG_PATH LD_LIBRARY_PATH
    eval "$(documented pipeline.md 'export PKG_CONFIG_PATH')"
    eval "$(documented pipeline.md 'cc first.c')" >/dev/null
    first_draws ./first
    cc -static first.c $(pkg-config --static --cflags --libs diptych-pipeline diptych-files) -o first
    first_draws ./first

    # The program that filters a picture.
    cc -std=c11 $warnings -c smaa.c -o smaa.o $(pkg-config --cflags diptych-post)
    unset PKG_CONFIG_PATH LD_LIBRARY_PATH
    eval "$(documented post.md 'export PKG_CONFIG_PATH')"
    eval "$(documented post.md 'cc smaa.c')" >/dev/null
    smooths ./smaa
    cc -static smaa.c $(pkg-config --static --cflags --libs diptych-post diptych-files) -o smaa
    smooths ./smaa

    # The gallery's sources build against the installed headers and need only exported functions.
    gallery=$prefix/share/doc/diptych/app/gallery
    cc -std=c17 -D_POSIX_C_SOURCE=200809L $warnings -shared -fPIC -Wl,-z,defs -o gallery.so \
        -I"$prefix/share/doc/diptych" "$gallery"/*.c "$gallery"/*/*.c \
        $(pkg-config --cflags --libs diptych-assets diptych-scene diptych-shapes) -lm
)

# Links of installed pages.
pages=$prefix/share/doc/diptych
(cd "$pages" && find . -name '*.md') | while read -r page; do
    place=$pages/$(dirname "$page")
    grep -oE '\]\([^)# ]+' "$pages/$page" | sed 's/^](//' | grep -v '://' | while read -r link; do
        [ -e "$place/$link" ] || echo "$page: $link"
    done || true
done >"$folder/dead"
[ ! -s "$folder/dead" ] || { cat "$folder/dead"; fail "these links of installed pages are dead"; }

# Every command of the libraries' page was run.
awk '/^```/ { inside = $0 == "```" && !inside; next } inside' "$source/docs/libraries.md" |
    grep -vxF -f "$folder/documented" | grep -v '^python3 ' >"$folder/left" || true
[ ! -s "$folder/left" ] || { cat "$folder/left"; fail "these lines of docs/libraries.md were not run"; }
