# How long each part of ./test takes, and which tests were left out. ./test sources this file.

SUMMARY=$(mktemp -d)
trap 'print_summary' EXIT

# Sets `used` to the processor time, in seconds, of all programs that have ended so far.
read_used() {
    times >"$SUMMARY/times" # A subshell would tell its own time.
    used=$(awk -F '[ms ]+' 'NR == 2 { printf "%d", 60 * $1 + $2 + 60 * $3 + $4 }' "$SUMMARY/times")
}

# part NAME COMMAND...: runs a part and keeps what it took.
part() {
    name=$1
    shift
    read_used
    part_used=$used
    part_from=$(date +%s)
    part_name=$name
    "$@"
    keep_part
}

keep_part() {
    read_used
    printf '%-28s %5d s %6d s\n' "$part_name" $(($(date +%s) - part_from)) \
        $((used - part_used)) >>"$SUMMARY/parts"
    part_name=
}

# run_ctest PRESET [CTEST OPTION]...: two jobs more than there are processors, since some tests wait
# (tests/CMakeLists.txt).
run_ctest() {
    ctest_preset=$1
    shift
    ctest_count=$(ls "$SUMMARY" | wc -l)
    ctest --test-dir "build/$ctest_preset" --output-on-failure --no-tests=error \
        --output-junit "$SUMMARY/$ctest_count-$ctest_preset.xml" -j $(($(nproc) + 2)) "$@"
}

# Prints, also after a failure, what the parts took and which tests were left out or skipped.
print_summary() {
    code=$?
    if [ -n "${part_name:-}" ]; then
        part_name="$part_name (failed)"
        keep_part
    fi
    if [ -s "$SUMMARY/parts" ]; then
        {
            echo
            printf '%-28s %7s %8s\n' "part" "time" "processor"
            cat "$SUMMARY/parts"
            awk '{ time += $(NF - 3); used += $(NF - 1) }
                END { printf "%-28s %5d s %6d s\n", "total", time, used }' "$SUMMARY/parts"
            python3 .ci/skipped.py build "$SUMMARY" || true
        } >&2
    fi
    rm -rf "$SUMMARY"
    exit $code
}
