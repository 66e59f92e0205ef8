#!/bin/sh
# Compares programs that make up their times (fake_bench.c), so that the truth is known.
# Usage: diff_fake_programs.sh DIPTYCH FAKE_BENCH MODEL
set -u
diptych=$1
fake=$2
model=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# make NAME WORDS: makes a program that answers as the words say.
make() {
    printf '#!/bin/sh\nFAKE="%s" exec "%s" "$@"\n' "$2" "$fake" >"$1"
    chmod +x "$1"
}

# expect CODE REGEX... -- ARGUMENT...: cost diff must end with this exit code, and its output must
# have a line that matches each regex.
expect() {
    code=$1
    shift
    : >regexes
    while [ "$1" != -- ]; do
        printf '%s\n' "$1" >>regexes
        shift
    done
    shift
    rm -f seed
    "$diptych" cost diff "$@" --starts 6 --rounds 4 --frames 3 --seed 1 >out 2>&1
    found=$?
    [ $found = "$code" ] || {
        echo "FAILED: cost diff $*: exit code $found, expected $code"
        failures=$((failures + 1))
        cat out
    }
    while read -r regex; do
        grep -qE -- "$regex" out || {
            echo "FAILED: cost diff $*: no line matches $regex"
            failures=$((failures + 1))
            cat out
        }
    done <regexes
}

make ./base ""
make ./slower slower
make ./alike alike
make ./counts counts
make ./pictures pictures
make ./wild wild

expect 0 '^verdict  green' '^All pictures and counters are the same' \
    '^No row is surely slower or faster' -- ./base ./base --fail-over 1%
expect 1 '^af=16 .* slower$' '^(99|100) % of the additional time is in the stage shading\.' \
    'It grows with texels_fetched, by 5[2-8]([.][0-9]+)? ns each: this work is the likely cause' \
    'rows are slower and 0 have a greater error in ./slower, by more than 2 %' \
    -- ./base ./slower --fail-over 2%
expect 0 '^af=16 .* slower$' -- ./base ./slower
expect 0 'and [1-8] are faster' -- ./slower ./base --fail-over 2%
expect 1 '^8 of 8 rows are slower' 'the same share of shading with all settings, (4[.]9|5)' \
    -- ./base ./alike --fail-over 3%
expect 0 '^all 8 rows:' 'triangles_in +\+0\.033 %; 1000 in A, 1000.333333 in B' \
    -- ./base ./counts --fail-over 1%
expect 0 'pictures +3 frames differ' -- ./base ./pictures --fail-over 1%
expect 3 '^verdict  red' 'the machine was too busy to compare times' -- ./wild ./wild --fail-over 1%

# Both programs get the options that say what they draw.
printf '#!/bin/sh\necho "$@" >>"$0.arguments"\nexec ./base "$@"\n' >recorded
chmod +x recorded
expect 0 '^verdict' -- ./recorded ./recorded --model "$model" --no-ground --animation none --animation-time 1.5
grep -q -- '--no-ground --animation none --animation-time 1.5' recorded.arguments || {
    echo "FAILED: the programs did not get the options of the scene:"
    head -1 recorded.arguments
    failures=$((failures + 1))
}
echo "$failures failed"
[ $failures = 0 ]
