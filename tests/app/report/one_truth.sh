#!/bin/sh
# Measures three scenes now, and asks every part of the program about the three reports: none may
# contradict another. How busy the machine is changes the answers, but not that they are equal.
#
# Usage: one_truth.sh DIPTYCH TEST_ONE_TRUTH SOURCES
set -eu
diptych=$1
test_one_truth=$2
sources=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# measure NAME ARGUMENT...: budgets lie between the fastest and the slowest combinations, so that
# some have advice and some have none.
measure() {
    name=$1
    shift
    "$diptych" cost --out "$name" --size 96x72 --places 2 --samples 4 --starts 2 --rounds 2 \
        --timed 1 --pictures none --budget-ms 0.5,1,2,3,4,6,8,12 "$@" >"$name.txt" 2>&1 || {
        code=$?
        cat "$name.txt"
        exit $code
    }
}

measure courtyard --config "$sources/config/courtyard.ini" --predict
measure tunnel --scene tunnel --combine aa,af,aaf
measure square --model "$sources/tests/assets/data/square.gltf" --combine aa,af,opt
"$test_one_truth" courtyard/cost.json tunnel/cost.json square/cost.json
