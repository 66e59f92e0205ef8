#!/bin/sh
# Runs `bench` with render scales, threads and instruction sets as users do. No check looks at a
# time. Usage: axes.sh DIPTYCH
. "$(dirname "$0")/../program.sh"

# bench CODE ARGUMENT...: bench must end with this exit code.
bench() {
    code=$1
    shift
    expect "$code" '' "$diptych" bench "$@"
}

bench 2 --scale 0.5,1.01
has "\[--scale\] '1.01' is not a share of the width and height from 0.1 to 1$" err.txt
"$diptych" cost axes --scales 0.5 >out.txt 2>err.txt
[ $? = 2 ] || fail "cost axes is no command"
has '\[cost axes\] is not a command any more; type `diptych bench --scale 0.5,1' err.txt

bench 0 --size 48x36 --sets 'aa=none;aa=4' --scale 0.5,1 --threads 1,2 --isa scalar,auto \
    --frames 3 --rounds 3 --seed 5 --csv all.csv --svg plots
estimate='[0-9.]+ +[0-9.]+ to [0-9.]+'
has "^  1  scale 0\.5 \(24x18\), aa=none, scalar, 1 thread +median .* $estimate +1\.000 +-$"
has "^  2  scale 0\.5 \(24x18\), aa=none, scalar, 2 threads +median .* $estimate +$estimate$"
has '^  9  scale 1 \(48x36\), aa=none, scalar, 1 thread +median .* 1\.000 +base +1\.000 +-$'
[ "$(grep -cE "median .* $estimate" out.txt)" = 15 ] || fail "15 of 16 rows have a ratio"
[ "$(wc -l <all.csv)" = $((1 + 16 * 9)) ] || fail "the CSV does not have a line per frame"
[ -s plots/time_scale.svg ] || fail "there is no plot against the render scale"
python3 - <<'PYTHON' || fail "the CSV is not as expected"
import csv
rows = list(csv.DictReader(open("all.csv")))
assert {(r["width_px"], r["height_px"]) for r in rows} == {("48", "36")} # The picture that is shown.
shaded = {}
for r in rows:
    stages = sum(float(r[s + "_ms"]) for s in ("geometry", "raster", "shading", "resolve"))
    enlarging = float(r["total_ms"]) - stages
    assert enlarging > -0.002 if r["scale"] == "1" else enlarging > 0.0 # A part of the time.
    shaded.setdefault((r["scale"], r["settings"], r["frame"]), set()).add(r["fragments_shaded_count"])
for (scale, settings, frame), counts in shaded.items():
    assert len(counts) == 1 # Threads and instruction sets have the same work.
    if scale == "0.5":
        assert int(*counts) < int(*shaded["1", settings, frame])
PYTHON

# A scene of the gallery, and one scale that is no base of another.
bench 0 --scene blend --size 48x36 --sets aa=none --scale 0.5 --frames 2 --rounds 1
has '^fixed    48x36, scale 0\.5 \(24x18\), aa=none'
has '^  1  aa=none +median .* 1\.000 +base$'
bench 0 --grid 50,500 --size 32x24 --sets aa=none --scale 1,0.5 --frames 2 --rounds 2
has "^  4  500 triangles, scale 0\.5 \(16x12\) +median .* $estimate$"

# --- Ctrl-C, as soon as the program catches it, and a while later. Shells start programs in the
# background with SIGINT ignored, so a signal that comes too early is lost.
catches() {
    sed -n 's/^SigCgt:.*\(.\)$/\1/p' "/proc/$1/status" 2>/dev/null | grep -q '[2367abef]'
}
begin_bench() {
    "$diptych" bench --rounds 1000 >out.txt 2>err.txt &
    for tenth in $(seq 600); do
        catches $! && break
        kill -0 $! 2>/dev/null || break
        sleep 0.1
    done
}
for wait in 0 1.5; do
    begin_bench
    sleep $wait
    kill -INT $!
    wait $!
    [ $? = 1 ] || fail "Ctrl-C after $wait s must end bench with code 1"
    has '\[bench\] interrupted' err.txt
done
# Both signals arrive before the program can act on the first one: the second ends it at once.
begin_bench
kill -STOP $!
kill -INT $!
kill -TERM $!
kill -CONT $!
wait $!
[ $? -gt 128 ] || fail "a second signal of another kind must end bench at once"

finish
