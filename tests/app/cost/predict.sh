#!/bin/sh
# Runs `cost predict` as users do: faults of its options and of reports, its table and its files. No
# check looks at a time.
# Usage: predict.sh DIPTYCH SOURCES
. "$(dirname "$0")/../program.sh"
square=$2/tests/assets/data/square.gltf
courtyard=$2/config/courtyard.ini

# predict ARGUMENT...: cost predict must run.
predict() {
    expect 0 '' "$diptych" cost predict "$@"
}

# refuses REGEX ARGUMENT...
refuses() {
    regex=$1
    shift
    refuse "$regex" cost predict "$@"
}

# measure FOLDER ARGUMENT...
measure() {
    folder=$1
    shift
    expect 0 '' "$diptych" cost --out "$folder" --places 1 --samples 4 --cache truths --pictures none "$@"
}

measure report --model "$square" --size 96x64 --starts 1 --rounds 2 --timed 2
measure tiny --model "$square" --size 48x36 --starts 1 --rounds 2 --timed 2
measure errors --model "$square" --size 96x64 --errors-only

# --- faults
refuses "there is no report; give the cost.json of one: cost predict REPORT --size WxH$"
refuses "\[errors\] is one argument too many" report errors
refuses "nothing/cost.json|nothing: .*cannot be opened|nothing" nothing
refuses "report: is of another scene \(square.gltf\)" report --config "$courtyard"
refuses "report: has another camera path DEFAULT than the scene has now; give its --path, or" \
    report --model "$square" --path "$2/campaths/aa.pth"
refuses "errors: has no times; measure the report without --errors-only$" errors --model "$square"
refuses "\[--time\] '201' is not a whole number from 0 to 200$" report --time 201
refuses "\[--check\] '-1'" report --check -1

# --- half the size was timed, unless the picture is small
python3 - <<'PYTHON' || fail "the reports do not have the combinations of half the size"
import json
smaller = json.load(open("report/cost.json"))["smaller"]
assert (smaller["width"], smaller["height"]) == (48, 32) and len(smaller["combinations"]) == 4
for c in smaller["combinations"]:
    assert abs(sum(c["stages_ms"].values()) / c["ms"] - 1) < 1e-9
    assert 0 < c["counters"]["fragments_shaded"] <= 48 * 32
assert json.load(open("tiny/cost.json"))["smaller"] is None
PYTHON

# --- from the report alone: exact, and the same each time
predict report/cost.json --model "$square" --size 192x128 --time 0 --csv a.csv --json a.json
has "^  There +192x128 pixels, path DEFAULT, "
has "^  Model +prices of work from [0-9]+ rows and 4 at 48x32 of the report$"
has "^  Timed +nothing: the predictions come from the report alone$"
predict report --model "$square" --size 192x128 --time 0 --csv b.csv
cmp a.csv b.csv || fail "two predictions from the same report differ"
predict report --model "$square" --size 192x128 --time 3 --check 4 --csv c.csv --json c.json
has "^  Timed +3 combinations there, "
has "^  Checked +4 other combinations there$"
predict tiny --model "$square" --threads 1 --time 1
has "^  There +48x36 pixels, path DEFAULT, 1 thread, "
python3 - <<'PYTHON' || fail "the files are not as expected"
import csv, json
alone, both = json.load(open("a.json")), json.load(open("c.json"))
combined = json.load(open("report/cost.json"))
measured = {r["settings"]: r["ms"] for r in combined["rows"][combined["combined_first"]:]}
assert alone["factor"] == 1 and both["factor"] > 0 and [
    name for name, m in alone["misses"].items() if m["rows"]] == ["report_rows_left_out"]
roles = [c["role"] for c in both["combinations"]]
assert roles.count("timed") == 3 and roles.count("checked") == 4
for a, c, line in zip(alone["combinations"], both["combinations"],
                      csv.DictReader(open("c.csv")), strict=True):
    assert a["settings"] == c["settings"] == line["settings"] and line["role"] == c["role"]
    assert abs(a["report_ms"] / measured[a["settings"]] - 1) < 1e-9
    assert a["report_alone_ms"] == a["ms"] == c["report_alone_ms"] > 0
    assert c["ms"] > 0
    assert (c["timed"] is not None) == (line["timed_ms"] != "") == (c["role"] != "predicted")
    if c["timed"]:
        timed = c["timed"]
        # Where too few rounds stayed undisturbed for an interval, both of its ends are null.
        low, high = timed["ms_low"], timed["ms_high"]
        assert (low is None) == (high is None)
        assert low is None or low <= timed["ms"] <= high
        assert abs(sum(timed["stages_ms"].values()) / timed["ms"] - 1) < 1e-9
        assert 0 < timed["counters"]["fragments_shaded"]
assert len(measured) == len(alone["combinations"])
PYTHON

# --- another camera path of the courtyard, and a scene of the gallery
measure court --config "$courtyard" --size 96x72 --starts 1 --rounds 2 --timed 1 --combine af
predict court --config "$courtyard" --category AAA --time 2
has "^  There +96x72 pixels, path AAA, "
measure blend --scene blend --size 96x72 --starts 1 --rounds 2 --timed 1 --combine aa
predict blend --scene blend --size 64x64 --time 2
refuses "blend: is of another scene " blend --scene toon

finish
