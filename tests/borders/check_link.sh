#!/bin/sh
# Tests the names that the pipeline's library exports. A program that calls a public function must
# link. A program that calls a private function must not link.
#
# Usage: check_link.sh COMPILER SOURCE_DIR PIPELINE_LIBRARY BASE_LIBRARY
set -eu
compiler=$1 source=$2 pipeline=$3 base=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
link() {
    "$compiler" "$1" -I "$source" -o "$folder/program" "$pipeline" "$base" \
        -Wl,-rpath,"$(dirname "$pipeline")" -Wl,-rpath,"$(dirname "$base")" 2>"$folder/log"
}
if ! link "$source/renderer/example/triangle.c"; then
    cat "$folder/log"
    echo "the example does not link against the shared pipeline"
    exit 1
fi
"$folder/program" "$folder/triangle.ppm"
if link "$source/tests/borders/crossed_link.c"; then
    echo "a private function of the pipeline can be linked"
    exit 1
fi
grep -q dip_kernels "$folder/log" || { cat "$folder/log"; exit 1; }
