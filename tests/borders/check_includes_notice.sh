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
must_refuse() { # FILE INCLUDE
    mkdir -p "$folder/renderer" "$folder/config" "$folder/campaths" "$folder/assets" "$folder/app"
    mkdir -p "$(dirname "$folder/$1")"
    echo "#include $2" >"$folder/$1"
    if sh "$check" "$layers" "$folder" 0; then
        echo "not refused: $1 includes $2"
        exit 1
    fi
    rm "$folder/$1"
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
must_refuse renderer/scene/plan/crossed.h '"renderer/scene/draw/draws.h"'
must_refuse renderer/scene/view/crossed.c '"renderer/scene/plan/plan.h"'
must_refuse renderer/scene/new/crossed.c '"renderer/scene/view/view.h"'
must_refuse app/verify/crossed.c '"renderer/catalogue/rows/crossed.h"'
must_refuse app/verify/crossed.c '"tests/stability/document.h"'
