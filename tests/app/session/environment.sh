#!/bin/sh
# Tests the ini's ENVIRONMENT: metal balls reflect it, and a bad file ends the program with one line.
# Usage: environment.sh DIPTYCH TEST_FOLDER
set -u
diptych=$1
here=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
python3 "$here/environment.py" . || exit 1
failures=0
checks=0

check() {
    description=$1
    shift
    checks=$((checks + 1))
    if ! "$@" >check.txt 2>&1; then
        failures=$((failures + 1))
        echo "FAILED: $description"
        sed 's/^/  | /' check.txt
    fi
}

# write_ini NAME LINE...: writes an ini of the balls.
write_ini() {
    name=$1
    shift
    printf 'RES: 96x72\nCURRENT: aa=none\nREQUESTED: aa=4\nXFILE: balls.gltf\n' >"$name"
    for line in "$@"; do
        echo "$line" >>"$name"
    done
}

# draw OUTPUT OPTION...: writes the hashes of a picture of each pane.
draw() {
    output=$1
    shift
    "$diptych" dump "$@" --pose '0 0 8 0 0 0 1' --frames 0:1 --hash >"$output" 2>err.txt
    check "$output is drawn without a warning: $(cat err.txt)" test ! -s err.txt
}

# refuse FILE REGEX: the program must end with exit code 2 and one line of error.
refuse() {
    write_ini bad.ini "ENVIRONMENT: $1"
    "$diptych" dump --config bad.ini --hash >out.txt 2>err.txt
    check "exit 2 and /$2/ for $1, found exit $? and: $(cat err.txt)" \
        sh -c "[ $? = 2 ] && [ \$(wc -l <err.txt) = 1 ] && grep -qE \"\$0\" err.txt" \
        "bad.ini:5: \\[ENVIRONMENT\\] .*$2"
}

write_ini plain.ini
write_ini studio.ini 'ENVIRONMENT: studio.hdr'
draw plain.txt --config plain.ini
draw studio.txt --config studio.ini --threads 1
draw threads.txt --config studio.ini --threads 3
draw scalar.txt --config studio.ini --isa scalar
check "an environment changes the picture" sh -c '! cmp -s plain.txt studio.txt'
check "it does not depend on threads" cmp studio.txt threads.txt
check "it does not depend on the instruction set" cmp studio.txt scalar.txt
draw model.txt --config plain.ini --model balls.gltf
draw dropped.txt --config studio.ini --model balls.gltf
check "a model of --model does not see it" cmp model.txt dropped.txt

refuse missing.hdr 'missing.hdr'
refuse square.hdr '64x64 pixels, accepted 2x1..4096x2048, twice as wide as high'
refuse short.hdr "ends"
refuse text.hdr 'accepted: Radiance HDR'

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
