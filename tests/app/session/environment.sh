#!/bin/sh
# Tests the ini's ENVIRONMENT: metal balls reflect it, it is shown behind them where this is asked for,
# and a bad file ends the program with one line.
# Usage: environment.sh DIPTYCH TEST_FOLDER
. "$(dirname "$0")/../program.sh"
here=$2
python3 "$here/environment.py" . || exit 1

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

# refuse_picture FILE REGEX: the program must refuse the picture with one line.
refuse_picture() {
    write_ini bad.ini "ENVIRONMENT: $1"
    refuse "bad.ini:5: \[ENVIRONMENT\] .*$2" dump --config bad.ini --hash
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

write_ini shown.ini 'ENVIRONMENT: studio.hdr' 'ENVIRONMENT_BACKGROUND: true' 'GROUND: true'
"$diptych" dump --config shown.ini --pane current --raw shown.rgb --pose '0 0 8 0 0 0 1' --fov 50 \
    --frames 0:1 --json shown.json >out.txt 2>err.txt
check "the background is the environment" python3 "$here/environment.py" . shown.rgb
draw shown1.txt --config shown.ini --threads 1
draw shown3.txt --config shown.ini --threads 3 --isa scalar
check "nor does the background depend on threads and instruction sets" cmp shown1.txt shown3.txt
has '"environment": {"run": true, "why": "metallic-roughness surfaces that see the environment' shown.json
has '"fragments_surrounded": [1-9]' shown.json
draw alone.txt --config plain.ini --json plain.json
has '"environment": {"run": false, "why": "the scene has no environment"' plain.json
has '"fragments_surrounded": 0' plain.json

write_ini bad.ini 'ENVIRONMENT_BACKGROUND: true'
refuse 'bad.ini:5: \[ENVIRONMENT_BACKGROUND\] there is no ENVIRONMENT' dump --config bad.ini --hash
refuse_picture missing.hdr 'missing.hdr'
refuse_picture square.hdr '64x64 pixels, accepted 2x1..4096x2048, twice as wide as high'
refuse_picture short.hdr "ends"
refuse_picture text.hdr 'accepted: Radiance HDR'

finish
