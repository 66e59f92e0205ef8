#!/bin/sh
# Runs `cost --fps` as users do: it searches all combinations of all settings, whatever the machine
# does meanwhile. No check looks at a time.
# Usage: fps.sh DIPTYCH SOURCES
. "$(dirname "$0")/../program.sh"
square=$2/tests/assets/data/square.gltf
cost="$diptych cost --model $square --size 48x32 --places 1 --samples 4 --cache truths --pictures none"

expect 0 '' $cost --out all --fps 60 --starts 1 --rounds 2 --timed 1
cp out.txt all.txt
expect 0 '' $cost --out some --fps 60 --combine aa,af --starts 1 --rounds 2 --timed 1
expect 0 '' $cost --out few --fps 60 --predict --combine aa,af --starts 1 --rounds 2 --timed 1
expect 0 '' $cost --out part --fps 60 --part 0:1 --starts 1 --rounds 2 --timed 1
expect 2 'these settings make more than 4096 combinations; give fewer settings, or --predict' \
    $cost --out many --fps 60 --combine aa,taa,aaa,asd,af,aaf,miplod,scale
if grep -q '^No advice:$' all.txt; then
    has '^What to do: close other programs ' all.txt
else
    check "the answer is the first line" \
        sh -c 'head -n 1 all.txt | grep -q "^At 60 frames a second (16.7 ms) on this machine:$"'
    has '^  Best of        [0-9]+ combinations of [0-9]+ settings: all predicted, [0-9]+ measured$' all.txt
    has '^  Fits           with ' all.txt
    has '^  Line for ini   REQUESTED: aa=' all.txt
fi

# The settings of which a step draws other pictures are combined; the number of combinations is that
# of each group of settings, multiplied.
python3 - all few <<'PYTHON' || fail "the reports do not hold what was searched"
import json, sys
def steps(group, changing):
    """Counts the combinations of the settings of a group, as the manual describes them."""
    def of(name, count):
        return range(count) if name in changing else range(1)
    if group == "samples":
        count = 0
        for aa in (of("aa", 5)):
            samples = (1, 2, 4, 6, 8)[aa]
            adaptive = 1
            if "aaa" in changing and samples > 1:
                sizes = [n for n in (1, 2, 3, 4) if samples % n == 0 and n < samples]
                if samples == 8:
                    sizes = [1, 2, 4]
                adaptive = 1 + 1 + len(sizes) + 1
            temporal = 1 if "taa" not in changing else 2 if samples == 1 else 3
            count += adaptive * temporal
        return count
    if group == "filtering":
        return 1 if "af" not in changing else 1 + 4 * (2 if "aaf" in changing else 1)
    if group == "scale":
        return 1 if "scale" not in changing else 4 + 4 * (3 if "upscale" in changing else 1)
    return {"opt": 3, "miplod": 6, "post": 3, "sharpen": 4, "shadows": 4, "gi": 2}[group] \
        if group in changing else 1

def check(name, swept):
    report = json.load(open(f"{name}/cost.json"))
    rows, first = report["rows"], report["combined_first"]
    base, same = report["paths"][0]["base_row"], report["paths"][0]["same_row"]
    assert [r for r, row in enumerate(rows) if row["path"] == 0 and r != same and
            row["settings"] == rows[base]["settings"]] == [base] and base >= first
    changing, named = set(), set()
    for sweep in report["sweeps"]:
        pictures = {rows[s["row"]]["places"][0]["pictures"] for s in sweep["steps"]}
        named.add(sweep["setting"])
        if len(pictures) > 1:
            changing.add(sweep["setting"])
        assert all(s["row"] >= first for s in sweep["steps"])
    assert named == swept, named
    wanted = 1
    for group in ("samples", "filtering", "opt", "miplod", "scale", "post", "sharpen", "shadows", "gi"):
        wanted *= steps(group, changing)
    assert report["predicted"]["searched"] == wanted, (report["predicted"]["searched"], wanted, changing)
    assert "gi" not in changing and "aa" in changing
    return wanted

assert check("all", set("aa taa aaa af aaf opt miplod scale upscale post sharpen shadows gi".split())) > 4096
check("few", {"aa", "af"})
for name in ("some", "part"):
    report = json.load(open(f"{name}/cost.json"))
    assert report["predicted"] is None and len(report["sweeps"]) > 2
PYTHON

finish
