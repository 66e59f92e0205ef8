#!/bin/sh
# Runs `cost axes` as users do: faults of its options, its table and files, its errors against those
# of `cost`, energy from a folder, and Ctrl-C. No check looks at a time.
# Usage: axes.sh DIPTYCH
set -u
diptych=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
    sed 's/^/  | /' err.txt
}

# axes CODE ARGUMENT...: cost axes must end with this exit code, and a fault of the input must be one
# line.
axes() {
    code=$1
    shift
    "$diptych" cost axes "$@" >out.txt 2>err.txt
    found=$?
    [ $found = "$code" ] || fail "cost axes $*: exit code $found, expected $code"
    [ "$code" != 2 ] || [ "$(wc -l <err.txt)" = 1 ] || fail "cost axes $*: expected one line"
}

# refuses REGEX ARGUMENT...
refuses() {
    regex=$1
    shift
    axes 2 "$@"
    grep -qE -- "$regex" err.txt || fail "cost axes $*: no line matches $regex"
}

# has REGEX [FILE]
has() {
    grep -qE -- "$1" "${2:-out.txt}" || {
        fail "nothing matches $1 in:"
        sed 's/^/  | /' "${2:-out.txt}"
    }
}

# --- faults
refuses "\[--axes\] 'colour' is not size, scale, threads or isa$" --axes size,colour
refuses "\[--sizes\] '64' is not WIDTHxHEIGHT" --sizes 64x48,64
refuses "\[--sizes\] '9000x5'" --sizes 9000x5
refuses "\[--sizes\] '6x5' is in the list twice; give each value once$" --sizes 6x5,7x5,6x5
refuses "\[--scales\] '1.01' is not a share of the width and height from 0.1 to 1$" --scales 1.01
refuses "\[--scales\] '0.09'" --scales 0.09
refuses "\[--scales\] 'nan'" --scales nan
refuses "\[--scales\] '0.50' is in the list twice" --scales 0.5,0.50
refuses "\[--thread-counts\] '0' is not a number of threads from 1 to [0-9]+, the processors of this" \
    --thread-counts 0
refuses "\[--thread-counts\] '257'" --thread-counts 257
refuses "\[--isas\] 'mmx' is not an instruction set; give one of auto\|scalar" --isas scalar,mmx
refuses "\[--isas\] 'scalar' is in the list twice" --isas scalar,scalar
refuses "\[--sizes\] --axes leaves out the axis size; add it, or leave out the list$" \
    --axes isa --sizes 6x5
refuses '\[--rounds\] there are 1 rounds of all starts; accepted are 2 to 10000$' --rounds 1
refuses "\[--places\] '1001' is not a whole number from 0 to 1000$" --places 1001
refuses "\[--samples\] '50' is not a square number" --samples 50
refuses "\[aa\] '3' is no step" --settings aa=3
refuses "\[stray\] is one argument too many" stray

# --- a run, and its files
small="--size 48x36 --rounds 2 --timed 2 --samples 4 --cache truths --seed 5"
axes 0 $small --places 2 --sizes 24x18,48x36 --scales 0.5,1 --thread-counts 1 --isas scalar,auto \
    --powercap nowhere --json axes.json --csv axes.csv
has '^base     48x36 pixels, [0-9]+ threads?, [a-z0-9]+, settings defaults$'
has '^energy   not told by this machine: nowhere has no counters of packages$'
# The A/A row, and one row of each axis but two of isa: 4 frames each.
has "^pictures 24 were compared with the base's and have the same bits$"
has '^machine was (green|amber|red): '
for row in 'base again' 24x18 48x36 '0\.5 \(24x18\)' '1 \(48x36\)' 1 scalar; do
    has "^  $row +[0-9.]+ [0-9.]+ to [0-9.]+ +[0-9.]+ [0-9.]+ to [0-9.]+ "
done
[ "$(wc -l <axes.csv)" = 10 ] || fail "the CSV does not have 10 lines"
[ "$(sed 's/[^,]//g' axes.csv | sort -u | wc -l)" = 1 ] || fail "the lines of the CSV differ in length"
python3 - <<'PYTHON' || fail "the JSON is not as expected"
import csv, json
axes = json.load(open("axes.json"))
assert axes["what"] == "diptych cost axes" and axes["format"] == 3 and axes["seed"] == 5
rows = axes["rows"]
assert [r["axis"] for r in rows] == ["base", "base", "size", "size", "scale", "scale", "threads",
                                     "isa", "isa"]
for row, line in zip(rows, csv.DictReader(open("axes.csv")), strict=True):
    assert line["axis"] == row["axis"] and line["value"] == row["value"]
    assert abs(float(line["ms"]) / row["ms"] - 1) < 1e-6
    assert len(row["frame_ms"]) == len(row["frame_base_ms"]) == len(row["frame_wait"]) == 4
    assert row["counters"]["fragments_shaded"] > 0 and row["frame_mj"] is None
    assert (row["flip"] is not None) == (row is rows[0] or row["axis"] == "scale") == (line["flip"] != "")
    pixels = row["shown_width"] * row["shown_height"]
    assert abs(row["ns_per_pixel"] * pixels / (1e6 * row["ms"]) - 1) < 1e-9
    if row["axis"] == "scale":
        assert 0 < row["enlarge_ms"] and 0 < row["draw_ms"]
        assert row["draw_ms"] + row["enlarge_ms"] <= row["ms"] * 1.000001 # Its parts.
    if row["axis"] == "threads":
        assert row["speed_up"] == 1 and row["efficiency"] == 1
# Half the size has less work, and the same size has the same work.
assert rows[2]["counters"]["fragments_shaded"] < rows[0]["counters"]["fragments_shaded"]
assert rows[5]["counters"] == rows[0]["counters"] == rows[7]["counters"]
assert rows[5]["flip"] == rows[0]["flip"]
assert rows[4]["flip"] > rows[0]["flip"]
PYTHON

# --- the errors of `cost`: with bursts of one frame, its baseline has the errors of the base
"$diptych" cost --out report --size 48x36 --places 2 --burst 1 --samples 4 --cache truths \
    --errors-only --combine aa --pictures none >out.txt 2>err.txt || fail "cost does not run"
python3 - <<'PYTHON' || fail "the base does not have the errors that cost measures"
import csv, json
base = json.load(open("axes.json"))["rows"][0]
found = [r for r in csv.DictReader(open("report/cost.csv")) if r["kind"] == "a/a" and
         r["path"] == "DEFAULT"]
assert len(found) == 1
assert abs(float(found[0]["all_flip"]) / base["flip"] - 1) < 1e-6
assert abs(float(found[0]["all_rmse_lin"]) / base["rmse_lin"] - 1) < 1e-6
PYTHON

# --- other scenes, no errors, energy
axes 0 $small --scene blend --places 0
has '^errors   not measured$'
has '^scene    gallery blend'
mkdir -p powercap/intel-rapl:0
echo package-0 >powercap/intel-rapl:0/name
echo 1000 >powercap/intel-rapl:0/max_energy_range_uj
echo 7 >powercap/intel-rapl:0/energy_uj
axes 0 $small --axes isa --isas scalar --powercap powercap
has '^energy   1 package in powercap$'
has '^  scalar .* 0\.0$' # The counter stands still.
axes 0 --size 8192x1 --axes size --rounds 2 --timed 1 --places 0
has '^note     Twice the size, 16384x2, is left out: a frame has at most 8192 pixels'

# --- a busy machine: the files are written all the same
"$diptych" cost axes $small --axes isa --isas scalar --require-quiet --csv quiet.csv \
    >out.txt 2>err.txt
code=$?
if grep -q '^machine was red' out.txt; then
    [ $code = 1 ] || fail "a red machine must end --require-quiet with code 1, not $code"
    has '\[--require-quiet\] the times are wrong' err.txt
else
    [ $code = 0 ] || fail "--require-quiet must end with code 0, not $code"
fi
[ -s quiet.csv ] || fail "there is no quiet.csv"

# --- Ctrl-C, as soon as the program catches it, and a while later. Shells start programs in the
# background with SIGINT ignored, so a signal that comes too early is lost.
catches() {
    sed -n 's/^SigCgt:.*\(.\)$/\1/p' "/proc/$1/status" 2>/dev/null | grep -q '[2367abef]'
}
for wait in 0 1.5; do
    "$diptych" cost axes --cache other --rounds 5000 >out.txt 2>err.txt &
    for tenth in $(seq 600); do
        catches $! && break
        kill -0 $! 2>/dev/null || break
        sleep 0.1
    done
    sleep $wait
    kill -INT $!
    wait $!
    [ $? = 1 ] || fail "Ctrl-C after $wait s must end cost axes with code 1"
    has '\[cost axes\] interrupted' err.txt
done
axes 1 $small --places 0 --csv nowhere/axes.csv
has 'nowhere/axes.csv' err.txt

echo "$failures failed"
[ $failures = 0 ]
