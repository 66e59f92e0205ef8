#!/bin/sh
# The program as users run it: exit codes, messages, what is written and what is not.
# Usage: test_cli.sh DIPTYCH SOURCE_FOLDER
set -u
diptych=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
checks=0

# expect CODE REGEX COMMAND...: the exit code, and a line of standard error that matches.
expect() {
    code=$1
    regex=$2
    shift 2
    "$@" >out.txt 2>err.txt
    found=$?
    checks=$((checks + 1))
    if [ "$found" != "$code" ] || { [ -n "$regex" ] && ! grep -qE "$regex" err.txt; }; then
        failures=$((failures + 1))
        echo "FAILED: $*"
        echo "  expected exit $code and /$regex/; found exit $found and:"
        sed 's/^/  | /' err.txt
    fi
    if [ "$code" = 2 ] && [ "$(wc -l <err.txt)" -gt "${most_lines:-1}" ]; then
        failures=$((failures + 1))
        echo "FAILED: more than one line for one fault: $*"
        sed 's/^/  | /' err.txt
    fi
}

# check DESCRIPTION COMMAND...: the command must succeed.
check() {
    description=$1
    shift
    checks=$((checks + 1))
    if ! "$@" >/dev/null 2>&1; then
        failures=$((failures + 1))
        echo "FAILED: $description"
    fi
}

# --- help and version
expect 0 '' "$diptych" --help
check "help lists every command" grep -q 'path convert' out.txt
check "help lists settings" grep -q 'miplod' out.txt
expect 0 '' "$diptych" dump --help
check "help on dump gives an example" grep -q 'dump --out out --frames 0:8' out.txt
expect 0 '' "$diptych" path --help
check "help on path tells both" grep -q 'path convert .*rewrite' out.txt
expect 0 '' "$diptych" --version
check "the version is one line" grep -qE '^diptych [0-9]+\.[0-9]+\.[0-9]+$' out.txt

# --- bad command lines: one line, exit 2, nothing written
expect 2 'diptych: \[dump\] nothing to make, accepted .*--out.*--json.*--hash' "$diptych" dump
expect 2 '\[--frmes\] no such option, nearest --frames' "$diptych" dump --hash --frmes 0:1
expect 2 "\[--frames\] '5:2', accepted FIRST:END" "$diptych" dump --hash --frames 5:2
expect 2 "\[--frames\] 'a:b'" "$diptych" dump --hash --frames a:b
expect 2 "\[--frames\] '0:9999999'" "$diptych" dump --hash --frames 0:9999999
expect 2 "\[--fps\] '0'" "$diptych" dump --hash --fps 0
expect 2 "\[--size\] '640', accepted WIDTHxHEIGHT" "$diptych" dump --hash --size 640
expect 2 "\[--size\] '0x5'" "$diptych" dump --hash --size 0x5
expect 2 "\[--size\] '9000x5'" "$diptych" dump --hash --size 9000x5
expect 2 "\[--threads\] '-1'" "$diptych" dump --hash --threads -1
expect 2 "\[--threads\] 'many'" "$diptych" dump --hash --threads many
expect 2 "\[--isa\] 'mmx', accepted auto\|scalar" "$diptych" dump --hash --isa mmx
expect 2 "\[aa\] '3' is no step, accepted none\|2\|4\|6\|8" "$diptych" dump --hash --current aa=3
expect 2 "\[aaa\] 'on' is not in this version" "$diptych" dump --hash --requested aa=4,aaa=on
expect 2 "\[--requested\] no value" "$diptych" dump --hash --requested
expect 2 "\[--hash\] takes no value" "$diptych" dump --hash=yes
expect 2 "\[--out\] is no option of .diptych path info." "$diptych" path info --out x y
expect 2 "\[path\] 'show', accepted path info FILE" "$diptych" path show x
expect 2 "\[path convert\] 1 of 2 files" "$diptych" path convert x.pth
expect 2 "\[dmp\] no such command, nearest dump" "$diptych" dmp --hash
expect 2 "\[stray\] one argument too many" "$diptych" dump --hash stray
expect 2 "\[--category\] 'SKY', accepted DEFAULT\|AA" "$diptych" dump --hash --category SKY
expect 2 "\[--category\] 'AF' .* --path takes" "$diptych" dump --hash --category AF --path x.pth
expect 2 "\[--category\] 'AF' .* orbit takes" "$diptych" dump --hash --category AF --model x.obj
expect 2 "\[path\] nothing to do, accepted path info FILE" "$diptych" path

# --- bad input files
expect 2 'none.ini: ' "$diptych" dump --hash --config none.ini
expect 2 'none.glb: ' "$diptych" dump --hash --model none.glb
expect 2 'none.pth: ' "$diptych" dump --hash --path none.pth
expect 2 'none.pth: ' "$diptych" path info none.pth
printf 'v 0 0 0\nv 1e-7 0 0\nv 0 1e-7 0\nf 1 2 3\n' >tiny.obj
expect 2 'tiny.obj: \[box\] the model is 1e-07 large' "$diptych" dump --hash --model tiny.obj
sed 's/1e-7/1e12/' tiny.obj >huge.obj
expect 2 'huge.obj: \[box\] 0\.\.9\.9+6e\+11 along axis 0' "$diptych" dump --hash --model huge.obj
printf 'diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n0 0 nan 0 0 0 1\n' >nan.pth
expect 2 'nan.pth:4: ' "$diptych" path info nan.pth
expect 2 'nan.pth:4: ' "$diptych" dump --hash --path nan.pth
sed 's#\.\./#'"$source"'/#' "$source/config/courtyard.ini" >good.ini
sed 's/^RES:.*/RES: 640/; s/^MIPDEBUG:.*/MIPDEBUG: maybe/' good.ini >bad.ini
most_lines=2 expect 2 'bad.ini:[0-9]+: \[RES\] ' "$diptych" dump --hash --config bad.ini
check "all faults of a file in one run" grep -qE 'bad.ini:[0-9]+: \[MIPDEBUG\] ' err.txt
sed 's/court.gltf/none.gltf/' good.ini >missing.ini
expect 2 'missing.ini:[0-9]+: \[XFILE\] .*none.gltf' "$diptych" dump --hash --config missing.ini
sed 's/aa.pth/none.pth/' good.ini >missing.ini
most_lines=3 expect 2 'missing.ini:[0-9]+: \[CAMPATH_AA\] .*none.pth' "$diptych" dump --hash \
    --config missing.ini
check "nothing was written so far" test -z "$(find . -name '*.png' -o -name '*.json' -o -name '*.tmp')"

sed 's/^ISA:.*/ISA: neon/' good.ini >isa.ini
if [ "$(uname -m)" = x86_64 ]; then
    expect 2 "isa.ini:[0-9]+: \[ISA\] 'neon' is not available" "$diptych" dump --hash --config isa.ini
fi
sed 's/^RES:/LOG: faults.log\nRES:/; s/court.gltf/none.gltf/' good.ini >log.ini
expect 2 'none.gltf' "$diptych" dump --hash --config log.ini
check "the ini's log file gets the errors too" grep -q 'none.gltf' faults.log

# --- what dump makes
small="--size 64x48"
expect 0 '' "$diptych" dump $small --hash --out a/b --json c.json --frames 0:5:2 --requested aa=4
cp out.txt hashes.txt
check "a line per frame and pane" test "$(grep -cE '^000[024] (current|requested) [0-9a-f]{32}$' out.txt)" = 6
check "and no other line" test "$(wc -l <out.txt)" = 6
for n in 0000 0002 0004; do
    for pane in current requested; do
        check "${pane}_$n.png is a picture of the size" \
            test "$(identify -format '%wx%h %m' "a/b/${pane}_$n.png")" = '64x48 PNG'
    done
done
check "six pictures" test "$(find a -name '*.png' | wc -l)" = 6
check "the record is in both places" cmp a/b/frames.json c.json
check "no temporary file is left" test -z "$(find . -name '*.tmp')"
for word in '"index"' '"time_s"' '"pose"' '"settings":	"aa=4,' '"stages_ms"' '"counters"' \
    '"texels_fetched"' '"effects"' '"light_map"' '"why"'; do
    check "the record holds $word" grep -q "$word" c.json
done
check "the record's hashes are those printed" \
    grep -q "$(sed -n '1s/.* //p' hashes.txt)" c.json

# --- the same picture, however it is made
same_hashes() {
    expect 0 '' "$diptych" dump $small --hash --frames 0:5:2 --requested aa=4 "$@"
    check "same hashes with $*" cmp out.txt hashes.txt
}
same_hashes --threads 1
same_hashes --threads 3
same_hashes --isa scalar
same_hashes --config good.ini
same_hashes --path "$source/campaths/ambient.pth" --fps 30
check "settings change the picture" test \
    "$(sed -n '1s/.* //p' hashes.txt)" != "$(sed -n '2s/.* //p' hashes.txt)"
expect 0 '' "$diptych" dump $small --hash --fps 15 --frames 0:3
check "frame 1 at 15 per second is frame 2 at 30" test \
    "$(sed -n '3s/.* //p' out.txt)" = "$(sed -n '3s/.* //p' hashes.txt)"

# --- a model of one's own, with an orbit made for it
expect 0 '' "$diptych" dump $small --hash --model "$source/tests/assets/data/square.gltf"

# --- failing while running
expect 1 'c.json/x' "$diptych" dump $small --json c.json/x
expect 1 '\[--out\] ' "$diptych" dump $small --out c.json

# --- camera paths
expect 0 '' "$diptych" path convert "$source/campaths/aa.pth" aa.bth
expect 0 '' "$diptych" path convert aa.bth aa.pth
expect 0 '' "$diptych" path convert aa.pth again.bth
check "conversion there and back changes no byte" cmp aa.bth again.bth
expect 0 '' "$diptych" path info aa.bth
check "info says how long it is" grep -q '^duration   24 s' out.txt
expect 2 "'aa.txt' says no format" "$diptych" path convert aa.bth aa.txt
head -c 100 aa.bth >cut.bth
expect 2 'cut.bth: ' "$diptych" path info cut.bth
expect 1 'none/x.bth: ' "$diptych" path convert aa.pth none/x.bth

echo "$checks checks, $failures failed"
[ "$failures" = 0 ]
