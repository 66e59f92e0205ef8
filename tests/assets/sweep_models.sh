#!/bin/sh
# Draws every model of a folder with `diptych dump` and says which were drawn and which were refused,
# with the reason. Fails if one crashes or hangs the program, or is refused with more than one line.
# Usage: sweep_models.sh DIPTYCH [FOLDER [OUTPUT]]
#
# FOLDER: the models of Debian's package assimp-testmodels if it is not given.
# OUTPUT: a folder that gets the pictures and table.txt. Without it, only the table is printed.
set -u
diptych=$1
models=${2:-/usr/share/assimp/models}
output=${3:-}
# Files that belong to models, but are none.
companions='png|jpg|jpeg|tga|bmp|dds|tif|tiff|gif|bin|txt|mtl|glsl|vert|frag|material|md|gz|license|uc|readme'
seconds=180 # longer than the limit of the importer, whose end is a clear line

if [ ! -d "$models" ]; then
    echo "There is no folder $models. On Debian, install the package assimp-testmodels." >&2
    exit 77 # CTest counts the test as skipped.
fi
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
pictures=${output:-$work/pictures}
mkdir -p "$pictures" || exit 1

# Draws $1 and sets `result` and `reason`. A result in capitals is a fault of Diptych.
draw() {
    rm -rf "$work/frame"
    timeout "$seconds" "$diptych" dump --model "$1" --size 320x240 --current aa=4,af=4 \
        --requested aa=4,af=4 --frames 45:46 --out "$work/frame" >/dev/null 2>"$work/messages"
    code=$?
    errors=$(grep -vc ': warning: ' "$work/messages")
    reason=$(grep -v ': warning: ' "$work/messages" | tail -n 1 | sed 's/^diptych: //')
    case $code in
    0) result=drawn reason=$(grep -c ': warning: ' "$work/messages")\ warnings ;;
    2) [ "$errors" = 1 ] && result=refused || result=UNCLEAR ;;
    124) result=HUNG reason="more than $seconds s" ;;
    *) result=FAILED reason="exit code $code: $reason" ;;
    esac
}

find "$models" -type f | LC_ALL=C sort | grep -Eiv "/[^/.]*\$|\.($companions)\$" >"$work/files"
while read -r file; do
    name=${file#"$models"/}
    draw "$file"
    printf '%-8s %-60s %s\n' "$result" "$name" "${reason#"$file": }"
    if [ "$result" = drawn ]; then
        mv "$work/frame/current_0045.png" "$pictures/$(echo "$name" | tr '/ ' '__').png"
    fi
done <"$work/files" >"$work/table"
cat "$work/table"
[ -z "$output" ] || cp "$work/table" "$output/table.txt"

count() { grep -c "^$1 " "$work/table"; }
echo
echo "$(wc -l <"$work/table") models: $(count drawn) drawn, $(count refused) refused," \
    "$(count UNCLEAR) refused unclearly, $(count FAILED) failed, $(count HUNG) hung."
! grep -qE '^(UNCLEAR|FAILED|HUNG) ' "$work/table"
