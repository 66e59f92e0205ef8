#!/bin/sh
# Runs the program as users do and checks its exit codes, its messages and the files that it writes.
# Usage: test_cli.sh DIPTYCH SOURCE_FOLDER
. "$(dirname "$0")/program.sh"
source=$2

# --- help and version
expect 0 '' "$diptych" --help
check "help lists every command" grep -q 'path convert' out.txt
check "help lists settings" grep -q 'miplod' out.txt
expect 0 '' "$diptych" dump --help
check "help on dump gives an example" grep -q 'dump --out out --frames 0:8' out.txt
for word in preview dump bench cost "cost merge" "cost diff" "cost advise" "cost predict" "path info" "path convert" compare verify; do
    expect 0 '' "$diptych" $word --help
    check "help on $word gives its usage and an example" sh -c \
        "grep -q '^Usage: diptych $word' out.txt && grep -q '^  diptych' out.txt"
    check "help on $word fits 80 columns" sh -c '! grep -qE "^ {6}.{75}" out.txt'
done
expect 0 '' "$diptych" bench --help
check "help on bench gives examples" grep -q 'bench --vs' out.txt
check "help on bench explains lists" grep -q -- '--threads LIST' out.txt
expect 0 '' "$diptych" path --help
check "help on path names both commands" grep -q 'path convert .*rewrite' out.txt
expect 0 '' "$diptych" --version
check "the version is one line" grep -qE '^diptych [0-9]+\.[0-9]+\.[0-9]+$' out.txt

refuse '\[import\] only Diptych itself runs this command' import
refuse '\[import\] only Diptych itself runs this command' import -- 1 1 1 1 1 1 a.obj
check "help does not show the hidden command" sh -c '! "$0" --help | grep -q "^  import"' "$diptych"

# --- bad command lines: one line of error, exit code 2, nothing written
refuse 'diptych: \[dump\] nothing to do; give one of --out DIR, --json FILE, --hash, --y4m FILE, --raw FILE$' dump
refuse '\[--frmes\] is not an option of .diptych dump.; did you mean --frames\?$' dump --hash --frmes 0:1
refuse "\[--frames\] '5:2' is not FIRST:END" dump --hash --frames 5:2
refuse "\[--frames\] 'a:b'" dump --hash --frames a:b
refuse "\[--frames\] '0:9999999'" dump --hash --frames 0:9999999
refuse "\[--fps\] '0'" dump --hash --fps 0
refuse "\[--size\] '640' is not WIDTHxHEIGHT .* such as 640x480" dump --hash --size 640
refuse "\[--size\] '0x5'" dump --hash --size 0x5
refuse "\[--size\] '9000x5'" dump --hash --size 9000x5
refuse "\[--threads\] '-1'" dump --hash --threads -1
refuse "\[--threads\] 'many'" dump --hash --threads many
refuse "\[--isa\] 'mmx' is not an instruction set; give one of auto\|scalar" dump --hash --isa mmx
refuse "\[aa\] '3' is no step, accepted none\|2\|4\|6\|8" dump --hash --current aa=3
refuse "\[opt\] 'on' is no step" dump --hash --requested opt=on
refuse "\[asd\] asd=3 needs aa=6; with aa=4, give asd=1\|2$" \
    dump --hash --requested aa=4,aaa=on,asd=3
refuse "\[--requested\] needs a value: --requested SET" dump --hash --requested
refuse "\[--hash\] takes no value" dump --hash=yes
refuse "\[--out\] is not an option of .diptych path info." path info --out x y
refuse "\[path\] 'show' is not a command; give one of path info FILE, path convert IN OUT" path show x
refuse "\[path convert\] needs two files but got 1: path convert IN OUT" path convert x.pth
refuse "\[dmp\] is not a command; did you mean dump\?" dmp --hash
refuse "\[stray\] is one argument too many for .diptych dump." dump --hash stray
refuse "\[--category\] 'SKY' is not a camera path of the ini; give one of DEFAULT\|AA" dump --hash --category SKY
refuse "\[--category\] 'AF' .* follows --path; leave out one" dump --hash --category AF --path x.pth
refuse "\[--category\] 'AF' .* follows an orbit .* leave out one" dump --hash --category AF --model x.obj
refuse "\[path\] nothing to do; give one of path info FILE, path convert IN OUT" path

# The hint for a mistyped option names only options of the same command: dump has --requested, bench
# does not.
refuse "\[--requsted\] is not an option of .diptych bench.; .diptych bench --help. lists" \
    bench --requsted aa=2
refuse "\[--requsted\] is not an option of .diptych preview.; did you mean --requested\?" \
    --requsted aa=2
refuse "\[show\] is not a command; .diptych --help. lists" show
refuse "\[--hash\] prints to standard output, and so does --json -;" \
    dump --hash --json -
refuse "\[path convert\] needs two files but got 0" path convert
refuse "\[--threads\] '257' is not a number of threads from 1 to 256" \
    dump --hash --threads 257

refuse "\[aa\] '3' is no step" bench --sets "aa=none;aa=3"
refuse "\[--sets\] 'aa=2;' holds an empty value; write one ';' between two values" bench --sets "aa=2;"
refuse "\[--threads\] 'two' is not a whole number from 0 to 256" bench --threads 1,two
refuse "\[--isa\] 'mmx' is not an instruction set; give one of auto\|scalar" bench --isa scalar,mmx
refuse "\[--size\] '64' is not WIDTHxHEIGHT" bench --size 64x48,64
refuse "\[--grid\] '1' is not a whole number from 2 to 20000000" bench --grid 1
refuse "\[--frames\] '0:4' is not a whole number from 1 to 10000" bench --frames 0:4
refuse "\[--rounds\] '0' is not a whole number from 1" bench --rounds 0
refuse "\[--grid-out-of-view\] there is no grid; give one with --grid" bench --grid-out-of-view
refuse "\[--grid\] a grid replaces the scene and its path; leave out --grid or --path" bench --grid 9 --path x.pth
refuse "\[--svg\] there is nothing to plot; give more than one value" bench --sets aa=none --svg plots
refuse "none: \[--vs\] cannot be run" bench --vs ./none
refuse "\[--svg\] plots show one program; leave out" bench --svg plots --vs "$diptych"
refuse "\[bench\] the lists make 1024 combinations; give values for at most 512" bench --sets "aa=none;aa=2" \
    --threads "1$(printf ',%d' $(seq 2 32))" --size "1x1$(printf ',%dx1' $(seq 2 16))"
refuse "\[--current\] is not an option of .diptych bench.; .diptych bench --help. lists" bench --current aa=2

# --- bad input files
refuse 'none.ini: ' dump --hash --config none.ini
refuse 'none.glb: ' dump --hash --model none.glb
refuse 'none.pth: ' dump --hash --path none.pth
refuse 'none.pth: ' path info none.pth
# assimp 5 looks for the end of a PLY file's header beyond the file, or for ever; assimp 6 refuses both.
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nelement face 1\n' >hang.ply
{ cat hang.ply && head -c 60 /dev/zero; } >crash.ply
# In a build with the address sanitizer, the importer also prints the sanitizer's report.
importer_lines=1
grep -aq __asan_init "$diptych" && importer_lines=100
most_lines=$importer_lines expect 2 \
    'crash.ply: the (importer (crashed|ended) while it read the model|model cannot be read: )' \
    "$diptych" dump --hash --model crash.ply
refuse 'hang.ply: the (importer hung while it read the model, accepted at most 2 s|model cannot be read: )' \
    dump --hash --import-seconds 2 --model hang.ply
refuse "\[--shading\] 'toon' is not a shading; give one of auto\|flat\|gouraud\|phong" \
    dump --hash --shading toon
refuse "\[--up\] 'x' is not an axis; give one of auto\|y\|z" dump --hash --up x
printf 'v 0 0 0\nv 1e-10 0 0\nv 0 1e-10 0\nf 1 2 3\n' >tiny.obj
refuse "tiny.obj: \[box\] the model's size is 1e-10" dump --hash --model tiny.obj
refuse 'tiny.obj:1: .* not a camera path, .*; load a model with --model$' \
    path convert tiny.obj tiny.pth
sed 's/1e-10/1e-7/' tiny.obj >small.obj
expect 0 '' "$diptych" dump --hash --model small.obj
sed 's/1e-10/1e12/' tiny.obj >huge.obj
refuse 'huge.obj: \[box\] 0\.\.9\.9+6e\+11 along axis 0' dump --hash --model huge.obj
printf 'diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n0 0 nan 0 0 0 1\n' >nan.pth
refuse 'nan.pth:4: ' path info nan.pth
refuse 'nan.pth:4: ' dump --hash --path nan.pth
sed 's#\.\./#'"$source"'/#' "$source/config/courtyard.ini" >good.ini
sed 's/^RES:.*/RES: 640/; s/^MIPDEBUG:.*/MIPDEBUG: maybe/' good.ini >bad.ini
most_lines=2 expect 2 'bad.ini:[0-9]+: \[RES\] ' "$diptych" dump --hash --config bad.ini
check "one run reports all faults of a file" grep -qE 'bad.ini:[0-9]+: \[MIPDEBUG\] ' err.txt
sed 's/court.gltf/none.gltf/' good.ini >missing.ini
refuse 'missing.ini:[0-9]+: \[XFILE\] .*none.gltf' dump --hash --config missing.ini
sed 's/aa.pth/none.pth/' good.ini >missing.ini
most_lines=3 expect 2 'missing.ini:[0-9]+: \[CAMPATH_AA\] .*none.pth' "$diptych" dump --hash \
    --config missing.ini
printf 'XFILE: %s/assets/courtyard/court.gltf\nRES: 32x24\n' "$source" >minimal.ini
expect 0 '' "$diptych" dump --hash --config minimal.ini --frames 0:1
check "an ini with only a model and a resolution gives no warning" test ! -s err.txt
check "nothing was written so far" test -z "$(find . -name '*.png' -o -name '*.json' -o -name '*.tmp')"

sed 's/^ISA:.*/ISA: neon/' good.ini >isa.ini
if [ "$(uname -m)" = x86_64 ]; then
    expect 2 "isa.ini:[0-9]+: \[ISA\] this machine cannot run 'neon'" "$diptych" dump --hash --config isa.ini
fi
sed 's/^RES:/LOG: faults.log\nRES:/; s/court.gltf/none.gltf/' good.ini >log.ini
refuse 'none.gltf' dump --hash --config log.ini
check "the ini's log file gets the errors too" grep -q 'none.gltf' faults.log

# --- what dump writes
small="--size 64x48"
expect 0 '' "$diptych" dump $small --hash --out a/b --json c.json --frames 0:5:2 --requested aa=4
cp out.txt hashes.txt
check "dump --hash prints a line per frame and pane" test "$(grep -cE '^000[024] (current|requested) [0-9a-f]{32}$' out.txt)" = 6
check "dump --hash prints no other line" test "$(wc -l <out.txt)" = 6
for n in 0000 0002 0004; do
    for pane in current requested; do
        check "${pane}_$n.png is a picture of the right size" \
            test "$(identify -format '%wx%h %m' "a/b/${pane}_$n.png")" = '64x48 PNG'
    done
done
check "dump writes six pictures" test "$(find a -name '*.png' | wc -l)" = 6
check "both files hold the same record" cmp a/b/frames.json c.json
check "no temporary file is left" test -z "$(find . -name '*.tmp')"
for word in '"index"' '"time_s"' '"pose"' '"settings": "aa=4,' '"stages_ms"' '"counters"' \
    '"texels_fetched"' '"effects"' '"light_map"' '"why"'; do
    check "the record holds $word" grep -q "$word" c.json
done
check "the record's hashes are those printed" \
    grep -q "$(sed -n '1s/.* //p' hashes.txt)" c.json

# --- the record on standard output
expect 0 '' "$diptych" dump $small --json - --frames 0:5:2 --requested aa=4
check "standard output is the record and nothing else" python3 -m json.tool out.txt
check "the record on standard output has the same hash" grep -q "$(sed -n '1s/.* //p' hashes.txt)" out.txt
check "no file is called -" test ! -e ./-

# --- standard output on a full disk: one line of error, exit code 1
quick_scene="--model $source/tests/assets/data/square.gltf" # It loads quickly.
full() { "$@" >/dev/full; }
if [ -c /dev/full ]; then
    for arguments in --help --version "dump --help" "dump $small $quick_scene --hash" \
        "dump $small $quick_scene --json -" "path info $source/campaths/aa.pth" \
        "bench $quick_scene --frames 1 --rounds 1 --size 8x8 --sets aa=none"; do
        expect 1 'standard output cannot be written' full "$diptych" $arguments
    done
fi

# --- options that must not change the picture
same_hashes() {
    expect 0 '' "$diptych" dump $small --hash --frames 0:5:2 --requested aa=4 "$@"
    check "same hashes with $*" cmp out.txt hashes.txt
}
same_hashes --threads 1
same_hashes --threads 3
same_hashes --isa scalar
same_hashes --force-all-effects
same_hashes --config good.ini
same_hashes --path "$source/campaths/ambient.pth" --fps 30
check "settings change the picture" test \
    "$(sed -n '1s/.* //p' hashes.txt)" != "$(sed -n '2s/.* //p' hashes.txt)"

# --- panes with the same settings: drawn once
equal="dump $small --hash --frames 4:6 --current aa=4,taa=on --requested aa=4,taa=on"
expect 0 '' "$diptych" $equal --json copied.json
cp out.txt copied.txt
check "the requested pane shows the current pane's picture" \
    test "$(sed -n '1s/.* //p' out.txt)" = "$(sed -n '2s/.* //p' out.txt)"
check "the record says that it is copied" test "$(grep -c '"copied": true' copied.json)" = 2
check "the record says that the copy took no time" test "$(grep -c '"ms": 0,' copied.json)" = 2
check "panes with different settings are not copied" sh -c '! grep -q "\"copied\": true" c.json'
expect 0 '' "$diptych" $equal --json forced.json --force-all-effects
check "drawing both panes gives the same pictures" cmp out.txt copied.txt
check "the record says that no pane is copied" sh -c '! grep -q "\"copied\": true" forced.json'

# --- a history: a frame does not depend on the frames that were drawn before it
history="dump $small --hash --current taa=history --requested aa=4"
expect 0 '' "$diptych" $history --frames 18:36:17
cp out.txt jumps.txt
expect 0 '' "$diptych" $history --frames 33:36
check "a frame with a history is the same alone and after others" \
    test "$(grep '^0035' out.txt)" = "$(grep '^0035' jumps.txt)"

expect 0 '' "$diptych" dump $small --hash --fps 15 --frames 0:3
check "frame 1 at 15 per second is frame 2 at 30" test \
    "$(sed -n '3s/.* //p' out.txt)" = "$(sed -n '3s/.* //p' hashes.txt)"

expect 0 'start, ms: ini [0-9.]+ import .* total [0-9.]+; shutdown [0-9.]+ ms; peak [0-9.]+ MiB' \
    "$diptych" dump $small --hash --timing
check "the record has the load times" grep -q '"load_ms"' c.json
check "the record has the peak memory" grep -q '"peak_rss_bytes"' c.json

# --- the bench: what it prints and writes; no times are judged
quick="--frames 2 --rounds 2"
expect 0 'plot written: plots/time_samples.svg' "$diptych" bench $quick --size 32x24,64x48 \
    --sets "aa=none;aa=4" --threads 1,2 --seed 7 --csv all.csv --svg plots
check "the heading tells the seed" grep -q 'order by seed 7$' out.txt
check "the table has a row per combination" test "$(grep -cE '^ +[1-8]  .*median' out.txt)" = 8
check "each row has its p95 and its minimum" test "$(grep -cE '^ +(p95|min) ' out.txt)" = 16
check "the table has the work counters" test "$(awk '$1 == "fragments_shaded" { all = $2 }
    $1 == "fragments_mirrored" { print all - $2 }' out.txt)" = 768
check "a cycle takes less than 10 ns" grep -qE 'One cycle is [0-9]\.[0-9]{3} ns' out.txt
check "the table of gaps has a row per combination" test "$(grep -cE '^ +[1-8] +[0-9.]+ +[0-9.]+x ' out.txt)" = 8
check "the CSV has a line per combination, round and frame" test "$(wc -l <all.csv)" = 33
check "the names of the CSV's columns have units" grep -q '^settings,width_px,.*,total_ms,.*_count' all.csv
for axis in pixels samples threads; do
    check "time_$axis.svg is whole" grep -q '^</svg>$' "plots/time_$axis.svg"
done
check "bench writes no other file" test "$(find plots -type f | wc -l)" = 3
expect 0 'time_triangles.svg' "$diptych" bench $quick --size 32x24 --grid 10,200 \
    --sets aa=none --svg plots
check "triangles in view are drawn" test "$(awk '$1 == "triangles_drawn" { print ($2 > 4) }' out.txt)" = 1
expect 0 '' "$diptych" bench $quick --size 32x24 --sets aa=none --grid 200 \
    --grid-out-of-view
check "triangles out of view are not drawn" test "$(awk '$1 == "triangles_drawn" { print $2 }' out.txt)" = 0
expect 0 '' "$diptych" bench $quick --size 32x24 --sets "aa=none;aa=2" --vs "$diptych" --csv vs.csv
check "a comparison with itself finds the same pictures" test "$(grep -cE '^aa=.* same$' out.txt)" = 2
check "the CSV has the rows of both programs" test "$(grep -c '^other,' vs.csv)" = 8
expect 1 "\[--vs\] .*true has ended" "$diptych" bench $quick $quick_scene --vs /bin/true
expect 1 "\[--vs\] .*echo did not answer as diptych's bench does" "$diptych" bench $quick $quick_scene --vs /bin/echo
expect 1 'none/a.csv' "$diptych" bench $quick $quick_scene --size 8x8 --csv none/a.csv
printf 'draw 0 0 1\ndraw 9 0 0\n' >asked.txt
serve() { "$diptych" bench $quick $quick_scene --size 32x24 --sets aa=none --serve <asked.txt; }
expect 1 "\[--serve\] 'draw 9 0 0'" serve
check "the child greets and answers" test "$(grep -cE '^diptych-bench 1 1 2$|total_ms=.*hash=[0-9a-f]{32}$' out.txt)" = 2

# --- a model given on the command line, with an orbit made for it
expect 0 '' "$diptych" dump $small --hash $quick_scene

# --- failures at run time
expect 1 'c.json/x' "$diptych" dump $small $quick_scene --json c.json/x
expect 1 '\[--out\] ' "$diptych" dump $small $quick_scene --out c.json

# --- wrong input and failures at run time have different exit codes
refuse 'none.json: ' --cost none.json
expect 1 'none/x.png: |\[--out\] ' "$diptych" dump $small $quick_scene --out c.json/x

# --- camera paths
expect 0 '' "$diptych" path convert "$source/campaths/aa.pth" aa.bth
expect 0 '' "$diptych" path convert aa.bth aa.pth
expect 0 '' "$diptych" path convert aa.pth again.bth
check "conversion to .pth and back changes no byte" cmp aa.bth again.bth
expect 0 '' "$diptych" path info aa.bth
check "path info prints the duration" grep -q '^duration   24 s' out.txt
expect 0 '' "$diptych" path info "$source/assets/gallery/crab.md2"
check "path info lists the animations of a model" grep -q '^animation  walk, 1.2 s' out.txt
refuse "'aa.txt' names no format; write to a file that ends in .pth" path convert aa.bth aa.txt
head -c 100 aa.bth >cut.bth
refuse 'cut.bth: ' path info cut.bth
expect 1 'none/x.bth: ' "$diptych" path convert aa.pth none/x.bth

# --- what cost writes
refuse "\[--out\] there is no folder for the report; give one with --out DIR" cost
refuse "\[--samples\] '50' is not a square number from 1 to 4096" cost --out x --samples 50
refuse "\[--part\] '3:2' is not A:B" cost --out x --part 3:2
refuse "\[--part\] ends at 4 of 3 viewpoints" cost --out x --part 0:4
refuse "\[--budget-ms\] 'x' is not a number of milliseconds" cost --out x --budget-ms 8,x
refuse "\[--budget-ms\] advice needs times" cost --out x --budget-ms 8 --errors-only
refuse "\[--combine\] 'ab' is not a setting; give none, or some of aa, taa" cost --out x --combine aa,ab
refuse "\[--pixels-per-degree\] '2' is not a number from 5 to 500" cost --out x --pixels-per-degree 2
refuse "\[--viewing\] 'tv' is not phone, monitor, uhd or headset" cost --out x --viewing tv
refuse "\[--pictures\] 'all' is not crops, full or none" cost --out x --pictures all
refuse "\[cost merge\] there are no parts to join; give the cost.json of each" cost merge --out x
refuse 'none.json: cannot open report' cost merge --out x none.json
echo '{}' >empty.json
refuse 'empty.json: \[version\] is missing' cost merge --out x empty.json
rm -rf x
expect 0 '' "$diptych" cost --help
check "help on cost gives examples" grep -q 'cost merge --out report' out.txt
# The scene loads quickly. one_truth_of_fresh_reports measures the courtyard for budgets.
few="--places 2 --samples 4 --timed 1 --cache truths $quick_scene"
# No set of settings draws a picture of this size within the smallest budget.
expect 0 '' "$diptych" cost --size 96x72 $few --out whole --rounds 3 --combine aa --budget-ms 0.01,1000
check "the report is there" test -s whole/cost.html -a -s whole/cost.csv -a -s whole/cost.json
check "the finished report leaves no cost.state" test ! -e whole/cost.state
if grep -q '^No advice:$' out.txt; then
    check "a busy machine gets no advice" grep -q 'no settings are advised' out.txt
else
    check "the answer is the first line" sh -c 'head -n 1 out.txt | grep -q "^Within 0.01 ms a frame on this machine:$"'
    check "no combination is within the smallest budget" grep -q '^Nothing that was measured surely fits' out.txt
    check "some combination is within the largest budget" grep -q '^  Line for ini   REQUESTED: aa=' out.txt
fi
check "the page contains its pictures" grep -q 'data:image/png;base64' whole/cost.html
cost="$diptych cost --size 48x32 $few"
expect 0 '' $cost --out part0 --part 0:1 --starts 1 --rounds 2 --combine aa --pictures full
check "the page has whole frames" grep -q 'data-part="frame"[^>]*data:image/jpeg;base64' part0/cost.html
expect 0 '' $cost --out part1 --part 1:2 --errors-only --starts 1 --rounds 2 --combine aa \
    --pictures none --save-truths pfm
check "the page has no pictures" test "$(grep -c '<img' part1/cost.html)" = 0
check "the truths of the part's viewpoints are saved" \
    test "$(ls pfm | sort | head -n 2 | tr '\n' ' ')" = 'DEFAULT-1-0.pfm DEFAULT-1-1.pfm '
square="--cache truths $quick_scene"
expect 0 '' "$diptych" cost merge --out merged $square part1/cost.json part0
sums_of() {
    grep -oE '"(sums|half_against_half)":\[[^]]*\]' "$1/cost.json" | sort
}
expect 0 '' $cost --out once --starts 1 --rounds 2 --combine aa
sums_of once >once.txt
sums_of merged >merged.txt
figures_of() {
    grep '^<figure' "$1/cost.html" | grep -v 'data-set="front"'
}
figures_of once >once-figures.txt
figures_of merged >merged-figures.txt
check "the page has figures" test "$(wc -l <once-figures.txt)" -gt 20
check "merged parts have the same pictures as one run" cmp once-figures.txt merged-figures.txt
expect 0 '' "$diptych" cost merge --out merged-full $square --pictures full part0
check "a merged page has whole frames" grep -q 'data-part="frame"[^>]*data:image/jpeg' merged-full/cost.html
expect 0 '' "$diptych" cost merge --out merged-none --pictures none part0
check "a merged page has no pictures if none are asked for" test "$(grep -c '<img' merged-none/cost.html)" = 0
check "parts of one build are joined without a warning" sh -c '! grep -q "different builds" out.txt'
mkdir other
sed 's/"build": *"[^"]*"/"build":"other"/' part1/cost.json >other/cost.json
expect 0 '' "$diptych" cost merge --out merged-builds --pictures none part0 other
builds='measured by different builds of Diptych'
check "the merged report says that its parts are of different builds" grep -q "$builds" out.txt
check "so does its page" grep -q "$builds" merged-builds/cost.html
expect 0 '' "$diptych" cost merge --out merged-again --pictures none merged-builds
check "a merged report keeps saying so" grep -q "$builds" out.txt
refuse 'the parts show "square.gltf", and the pictures of the page would be drawn from' \
    cost merge --out x part0 part1
check "the report has errors" test "$(wc -l <once.txt)" -gt 50
check "merged parts have the same errors as one run" cmp once.txt merged.txt
# A cache whose files cannot be written: folders stand in their places.
cp -r truths unwritable
for truth in unwritable/truth-*.bin; do
    rm "$truth"
    mkdir -p "$truth/full"
done
expect 1 'truth-[0-9a-f]*.bin: \[--cache\] cannot be written: ' $cost --cache unwritable --out x \
    --errors-only --combine none --pictures none
expect 0 '' $cost --out phone --part 0:1 --errors-only --combine none --viewing phone --pictures none
check "a way of viewing sets the pixels per degree" grep -q '"pixels_per_degree":94.2,' phone/cost.json
expect 0 '' $cost --out one-thread --errors-only --combine aa --threads 1 --isa scalar
sums_of one-thread >other.txt
check "errors are the same on one thread, without vectors" cmp once.txt other.txt
sed 's/"samples":4,/"samples":9,/' part1/cost.json >else.json
refuse 'else.json: is not a part of the same report' \
    cost merge --out x part0/cost.json else.json

# --- two reports, or two programs
refuse "\[cost diff\] there is nothing to compare; give two reports or programs" cost diff once
refuse "\[c\] is one argument too many" cost diff a b c
refuse "\[--fail-over\] '3' is not a share from 0.1% to 1000%" cost diff once part0 --fail-over 3
refuse 'none.json: cannot open report' cost diff once none.json
refuse 'empty.json: \[version\] is missing' cost diff once empty.json
head -c 3000 once/cost.json >broken.json
refuse 'broken.json: is not a JSON file' cost diff broken.json once
refuse "\[cost diff\] /bin/true has ended" cost diff /bin/true .
refuse "\[cost diff\] /bin/echo did not answer as diptych's bench does" cost diff . /bin/echo
expect 0 '' "$diptych" cost diff once one-thread --json same.json --fail-over 1%
check "errors are the same on one thread" grep -q 'All errors and counters that both sides have are the same' out.txt
check "a report without times is named" grep -q 'times and counters are not compared: B has none' out.txt
check "the comparison is there as JSON" grep -q '"failed_errors":' same.json
sed 's/"samples":4,/"samples":9,/' once/cost.json >else.json
expect 0 '' "$diptych" cost diff one-thread else.json
check "reports with other truths are not compared" grep -q 'errors are not compared: A has 2 viewpoints' out.txt
sed -E '0,/"sums":/s/("sums":\[[0-9.]+,)([0-9.]+)/\199\2/' one-thread/cost.json >worse.json
expect 1 '\[--fail-over\] 0 rows are slower and 1 have a greater error in worse.json, by more than 3 %' \
    "$diptych" cost diff one-thread worse.json --fail-over 3%
duel="$quick_scene --starts 2 --rounds 2"
"$diptych" cost diff . "$diptych" $duel --size 32x24 --frames 2 --sets "aa=none;aa=4" >out.txt 2>err.txt
check "two programs are compared, or the machine is busy" test $? = 0 -o $? = 3
check "the same program draws the same pictures" grep -q 'All pictures and counters are the same' out.txt
"$diptych" cost diff once . $duel >out.txt 2>err.txt
check "a report and a program are compared, or the machine is busy" test $? = 0 -o $? = 3
check "the program counts what the report has" grep -q 'All errors and counters that both sides have are the same' out.txt
"$diptych" cost diff . . --frames 100 --size 640x480 >out.txt 2>err.txt &
sleep 1
kill -INT $!
wait $!
check "Ctrl-C ends cost diff with code 1" test $? = 1
check "Ctrl-C is named" grep -q '\[cost diff\] interrupted' err.txt

# --- one choice for several reports
refuse "\[cost advise\] there are no reports; give the cost.json of each" cost advise
refuse "\[--fps\] '0' is not a number of frames a second" cost advise once --fps 60,0
refuse "\[--budget-of\] 'median' is not p95, mean or worst" cost advise once --budget-ms 8 --budget-of median
refuse 'none.json: cannot open report' cost advise none.json --budget-ms 8
refuse 'part1: has no times' cost advise part1 --budget-ms 8
"$diptych" cost advise once merged/cost.json --budget-ms 1000 --json advice.json >out.txt 2>err.txt
case $? in
0)
    check "common advice names both reports" grep -qE ' 2  merged/cost.json  +square.gltf  DEFAULT ' out.txt
    check "something is within a large budget" grep -q '^Within 1000 ms a frame in every report:$' out.txt
    check "the common advice is there as JSON" grep -q '"mean_flip":' advice.json
    ;;
3) check "a report of a busy machine is named" grep -q 'has wrong times: the machine was too busy' err.txt ;;
*) check "cost advise ends with code 0, or with 3 after a busy machine" false ;;
esac

# --- cost, interrupted while it runs
for wait in 0.4 0.8 1.2; do
    timeout -s KILL $wait $cost --out killed --starts 1 --rounds 8 >out.txt 2>err.txt
    check "there is no incomplete report after $wait s" test ! -e killed/cost.json -o -s killed/cost.html
done
# The program catches signals from its start, before it writes its first line.
$cost --out stopped --rounds 2500 >out.txt 2>err.txt &
for tenth in $(seq 600); do
    [ -s stopped/cost.state ] && break
    sleep 0.1
done
kill -INT $!
wait $!
check "after Ctrl-C, cost says that the same command continues the report" grep -q 'interrupted; run the same command again' err.txt
check "the measurements are kept" test -s stopped/cost.state
expect 0 '' $cost --out stopped --rounds 1
check "the same command finishes the report" test -s stopped/cost.html -a ! -e stopped/cost.state
expect 0 '' $cost --out killed --starts 1 --rounds 8
check "the killed run is finished, too" test -s killed/cost.html -a ! -e killed/cost.state

finish
