#!/bin/sh
# Tests --scene and SCENE in dump, bench and cost.
#
# Usage: commands.sh DIPTYCH SOURCE_FOLDER
set -eu
diptych=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "FAILED: $1" >&2
    exit 1
}
refuses() { # refuses TEXT ARGUMENT...: exit code 2 and a message that has TEXT
    text=$1
    shift
    code=0
    "$diptych" "$@" >"$folder/out" 2>"$folder/err" || code=$?
    [ "$code" = 2 ] || fail "'$*' ended with $code"
    grep -qF -- "$text" "$folder/err" || { cat "$folder/err"; fail "'$*' does not say '$text'"; }
}

# A scene draws pictures with hashes; both panes with their own settings.
"$diptych" dump --scene blend --size 160x120 --hash --frames 0:60:30 \
    --requested aa=4 >"$folder/blend"
[ "$(wc -l <"$folder/blend")" = 4 ] || fail "dump --scene blend --hash has other lines"
[ "$(cut -d ' ' -f 3 "$folder/blend" | sort -u | wc -l)" = 4 ] || fail "some pictures are equal"
"$diptych" dump --scene blend --size 160x120 --out "$folder/pictures" --requested aa=4
[ -s "$folder/pictures/requested_0000.png" ] || fail "there is no picture"
grep -q '"fragments_ordered"' "$folder/pictures/frames.json" || fail "the record has no counters"

# The ini names a scene; --scene models goes back to the models.
sed "s|\.\./|$source/|" "$source/config/courtyard.ini" >"$folder/scene.ini"
echo "SCENE: blend" >>"$folder/scene.ini"
"$diptych" dump --config "$folder/scene.ini" --size 160x120 --hash --frames 0:60:30 \
    --current aa=none --requested aa=4 >"$folder/from_ini"
"$diptych" dump --scene blend --size 160x120 --hash --frames 0:60:30 \
    --current aa=none --requested aa=4 | diff - "$folder/from_ini" || fail "the ini's scene differs"
"$diptych" dump --config "$folder/scene.ini" --scene models --size 64x48 --hash >"$folder/models"
"$diptych" dump --size 64x48 --hash | diff - "$folder/models" || fail "the models differ"

# Looks are variants of a scene.
"$diptych" dump --scene toon --look 2 --size 96x64 --hash >"$folder/look2"
"$diptych" dump --scene toon --size 96x64 --hash | diff - "$folder/look2" >/dev/null &&
    fail "--look changes nothing"
refuses "from 1 to 99" dump --hash --scene toon --look 0

# The tour's second scene is the gallery's second scene, at the same time.
"$diptych" dump --scene tour --size 96x64 --hash --frames 480:481 |
    cut -d ' ' -f 3 >"$folder/tour"
"$diptych" dump --scene shadow --size 96x64 --hash --frames 30:31 |
    cut -d ' ' -f 3 | diff - "$folder/tour" || fail "the tour draws another picture"

# bench and cost.
"$diptych" bench --scene tunnel --size 96x64 --sets "aa=none;af=16" --frames 2 --rounds 2 \
    >"$folder/bench" || fail "bench"
grep -q 'tunnel, a scene of the gallery' "$folder/bench" || fail "bench does not name the scene"
"$diptych" cost --scene tunnel --size 96x64 --out "$folder/report" --places 1 --samples 16 \
    --errors-only >"$folder/cost" 2>&1 || { cat "$folder/cost"; fail "cost"; }
grep -q 'same pipeline' "$folder/report/cost.json" || fail "the report does not name its truth"

# What is refused.
refuses "did you mean 'tunnel'?" dump --hash --scene tunel
refuses "leave out one of the two options" dump --hash --scene blend --model x.glb
refuses "leave out one of the two options" dump --hash --scene blend --category AA
sed -i 's/^SCENE:.*/SCENE: watter/' "$folder/scene.ini"
refuses "scene.ini:$(wc -l <"$folder/scene.ini"): [SCENE]" dump --hash --config "$folder/scene.ini"
echo "all passed"
