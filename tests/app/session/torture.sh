#!/bin/sh
# Tests the scene torture: --scene finds it, each of its cameras flies, the settings that its places
# are for change the picture there, and options that do not fit it are refused.
#
# Usage: torture.sh DIPTYCH
. "$(dirname "$0")/../program.sh"

# changes CAMERA SET: at this camera, SET and the set aa=4 differ, and the pictures draw.
changes() {
    "$diptych" dump --scene torture --path "$1" --size 160x120 --hash --current aa=4 \
        --requested "$2" >"$1.txt"
    [ "$(cut -d ' ' -f 3 "$1.txt" | sort -u | wc -l)" = 2 ] || fail "$2 changes nothing at $1"
}
changes WIRES aa=8
changes FOLIAGE aa=4,aaa=coverage
changes SPECULAR aa=4,aaa=all
changes TEXT aa=4,post=fxaa
changes WATER aa=4,scale=2
changes TOUR aa=none
cat WIRES.txt FOLIAGE.txt SPECULAR.txt TEXT.txt WATER.txt TOUR.txt | cut -d ' ' -f 3 |
    sort | uniq -d | grep -q . && fail "two cameras show the same picture"

# A category of settings plays the camera that shows it.
"$diptych" dump --scene torture --category AAA --size 160x120 --hash --current aa=4 \
    --requested aa=4,aaa=coverage | cmp - FOLIAGE.txt || fail "the category AAA is not FOLIAGE"

# A folder is no camera path, so it does not hide the camera of its name; a file does.
mkdir TEXT
"$diptych" dump --scene torture --path TEXT --size 64x48 --hash >/dev/null ||
    fail "a folder hides the camera"
rmdir TEXT
echo nonsense >TEXT
refuse "not a camera path" dump --hash --scene torture --path TEXT
rm TEXT

# --scene courtyard is what is drawn without options.
"$diptych" dump --scene courtyard --size 64x48 --hash >courtyard.txt
"$diptych" dump --size 64x48 --hash | cmp - courtyard.txt || fail "the courtyard differs"

refuse "\|models\|courtyard\|torture" dump --hash --scene tortur
refuse "has an ini of its own" dump --hash --scene torture --config x.ini
refuse "has camera paths instead" dump --hash --scene torture --look 2
refuse "leave out one of the two options" dump --hash --scene torture --model x.glb
finish
