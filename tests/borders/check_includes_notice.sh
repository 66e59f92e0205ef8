#!/bin/sh
# Tests check_includes.sh: it must accept this tree and refuse small trees that have a forbidden
# include.
#
# Usage: check_includes_notice.sh SOURCE_DIR
set -eu
source=$1
check="$source/tests/borders/check_includes.sh"
layers="$source/tests/borders/layers.txt"
sh "$check" "$layers" "$source"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
write() { # FILE INCLUDE...: a new tree with these files, each with one include
    rm -rf "$folder/tree"
    for library in renderer config campaths assets app; do
        mkdir -p "$folder/tree/$library"
    done
    while test $# -gt 0; do
        mkdir -p "$(dirname "$folder/tree/$1")"
        echo "#include $2" >"$folder/tree/$1"
        shift 2
    done
}
must_refuse() { # FILE INCLUDE...
    write "$@"
    if sh "$check" "$layers" "$folder/tree" 0; then
        echo "not refused: $*"
        exit 1
    fi
}
must_accept() { # FILE INCLUDE...
    write "$@"
    sh "$check" "$layers" "$folder/tree" 0
}
must_refuse renderer/pipeline/geometry/crossed.c '"renderer/scene/scene.h"'
must_refuse renderer/scene/crossed.c '"renderer/pipeline/geometry/mesh_layout.h"'
must_refuse renderer/base/crossed.h '"renderer/pipeline/mesh.h"'
must_refuse config/crossed.c '"app/cli/log.h"'
must_refuse app/measure/timing/crossed.c '"app/session/session.h"'
must_refuse app/session/crossed.c '"config/config_private.h"'
must_refuse app/preview/crossed.c '<SDL2/SDL.h>'
must_refuse app/cost/crossed.c '"app/preview/loop/loop.h"'
must_refuse app/preview/live/crossed.c '"app/preview/state/state.h"'
must_refuse app/verify/crossed.c '"renderer/catalogue/rows/crossed.h"'
must_refuse app/verify/crossed.c '"tests/stability/document.h"'

# Cycles of two and of three folders, and one through the headers at the top of a library. Sources
# count, too, except for those that include headers of folders below their own.
must_refuse renderer/scene/plan/a.h '"renderer/scene/draw/b.h"' \
    renderer/scene/draw/b.h '"renderer/scene/plan/a.h"'
must_refuse renderer/scene/plan/a.c '"renderer/scene/draw/b.h"' \
    renderer/scene/draw/c.c '"renderer/scene/plan/d.h"'
must_refuse assets/gltf/a.h '"assets/pack/b.h"' assets/pack/b.h '"assets/animation/c.h"' \
    assets/animation/d.c '"assets/gltf/a.h"'
must_refuse assets/a.h '"assets/pack/b.h"' assets/pack/b.h '"assets/c.h"'
must_accept assets/a.c '"assets/pack/b.h"' assets/pack/b.h '"assets/c.h"'
must_accept renderer/scene/plan/a.h '"renderer/scene/view/b.h"' \
    renderer/scene/draw/c.c '"renderer/scene/plan/a.h"' \
    renderer/scene/draw/d.h '"renderer/scene/view/b.h"'
