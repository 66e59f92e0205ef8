#!/bin/sh
# Tests --scene and SCENE in dump, bench and cost.
#
# Usage: commands.sh DIPTYCH SOURCE_FOLDER
. "$(dirname "$0")/../program.sh"
source=$2

# A scene draws pictures with hashes; both panes with their own settings.
"$diptych" dump --scene blend --size 160x120 --hash --frames 0:60:30 --requested aa=4 >blend
[ "$(wc -l <blend)" = 4 ] || fail "dump --scene blend --hash has other lines"
[ "$(cut -d ' ' -f 3 blend | sort -u | wc -l)" = 4 ] || fail "some pictures are equal"
"$diptych" dump --scene blend --size 160x120 --out pictures --requested aa=4
[ -s pictures/requested_0000.png ] || fail "there is no picture"
grep -q '"fragments_ordered"' pictures/frames.json || fail "the record has no counters"

# The ini names a scene; --scene models goes back to the models.
sed "s|\.\./|$source/|" "$source/config/courtyard.ini" >scene.ini
echo "SCENE: blend" >>scene.ini
"$diptych" dump --config scene.ini --size 160x120 --hash --frames 0:60:30 \
    --current aa=none --requested aa=4 >from_ini
"$diptych" dump --scene blend --size 160x120 --hash --frames 0:60:30 \
    --current aa=none --requested aa=4 | diff - from_ini || fail "the ini's scene differs"
"$diptych" dump --config scene.ini --scene models --size 64x48 --hash >models
"$diptych" dump --size 64x48 --hash | diff - models || fail "the models differ"

# Looks are variants of a scene.
"$diptych" dump --scene toon --look 2 --size 96x64 --hash >look2
"$diptych" dump --scene toon --size 96x64 --hash | diff - look2 >/dev/null &&
    fail "--look changes nothing"
refuse "from 1 to 99" dump --hash --scene toon --look 0

# The tour's second scene is the gallery's second scene, at the same time.
"$diptych" dump --scene tour --size 96x64 --hash --frames 480:481 |
    cut -d ' ' -f 3 >tour
"$diptych" dump --scene shadow --size 96x64 --hash --frames 30:31 |
    cut -d ' ' -f 3 | diff - tour || fail "the tour draws another picture"

# bench and cost.
"$diptych" bench --scene tunnel --size 96x64 --sets "aa=none;af=16" --frames 2 --rounds 2 \
    >bench || fail "bench does not run"
grep -q 'tunnel, a scene of the gallery' bench || fail "bench does not name the scene"
"$diptych" cost --scene tunnel --size 96x64 --out report --places 1 --samples 16 \
    --errors-only >cost 2>&1 || fail "cost does not run" cost
grep -q 'same pipeline' report/cost.json || fail "the report does not name its truth"

# What is refused.
refuse "did you mean 'tunnel'\?" dump --hash --scene tunel
refuse "leave out one of the two options" dump --hash --scene blend --model x.glb
refuse "leave out one of the two options" dump --hash --scene blend --category AA
sed -i 's/^SCENE:.*/SCENE: watter/' scene.ini
refuse "scene.ini:$(wc -l <scene.ini): \[SCENE\]" dump --hash --config scene.ini
finish
