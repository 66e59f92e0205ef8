# ./test fuzz [SECONDS]: builds the fuzzers of tests/fuzz and runs each for this long, two at a
# time. ./test sources this file.
#
# New inputs that reach new code are kept in build/fuzz/corpus/READER, so that a later run goes on
# from there. Inputs that show a fault, and the output of each fuzzer, are in build/fuzz/found and
# build/fuzz/READER.log.

FUZZERS=${FUZZERS:-ini pth bth settings control picture animation journal cost_json scene_pack frame model}

# run_fuzzer READER SECONDS
run_fuzzer() {
    mkdir -p "build/fuzz/corpus/$1" build/fuzz/found
    ls "build/fuzz/corpus/$1" | wc -l >"build/fuzz/$1.before"
    dictionary=tests/fuzz/$1.dict
    [ ! -f "$dictionary" ] || set -- "$1" "$2" "-dict=$dictionary"
    # An input may take 60 s by the clock, which is long even on a busy machine, and 2 GiB.
    # -close_fd_mask=1 drops what the readers print.
    nice "build/fuzz/tests/fuzz/fuzz_$1" "build/fuzz/corpus/$1" "tests/fuzz/corpus/$1" \
        -max_total_time="$2" -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
        -close_fd_mask=1 -artifact_prefix="build/fuzz/found/$1-" ${3:+"$3"} \
        >"build/fuzz/$1.log" 2>&1
    echo $? >"build/fuzz/$1.exit"
}

# statistic NAME READER: a number that libFuzzer prints at its end.
statistic() {
    sed -n "s/^stat::$1: *//p" "build/fuzz/$2.log"
}

# Prints a line for a fuzzer that has ended. A fuzzer stops at its first finding.
report_fuzzer() {
    code=$(cat "build/fuzz/$1.exit")
    executions=$(statistic number_of_executed_units "$1")
    seconds=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) second.*/\1/p' "build/fuzz/$1.log")
    new=$(($(ls "build/fuzz/corpus/$1" | wc -l) - $(cat "build/fuzz/$1.before")))
    printf '%-12s %12s %8s %10s %8s %9s\n' "$1" "${executions:--}" "${seconds:--}" \
        "$(statistic average_exec_per_sec "$1")" "$new" "$([ "$code" = 0 ] && echo 0 || echo 1)"
    [ "$code" = 0 ] || fuzz_findings="$fuzz_findings $1"
}

# fuzz_all SECONDS
fuzz_all() {
    fuzz_findings=
    TMPDIR=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)/diptych-fuzz.XXXXXX")
    export TMPDIR
    trap 'rm -rf "$TMPDIR"' EXIT
    printf '%-12s %12s %8s %10s %8s %9s\n' reader executions seconds 'per second' new findings
    set -- "$1" $FUZZERS
    while [ $# -gt 1 ]; do
        run_fuzzer "$2" "$1" &
        if [ $# -gt 2 ]; then
            run_fuzzer "$3" "$1" &
        fi
        wait
        report_fuzzer "$2"
        [ $# -le 2 ] || report_fuzzer "$3"
        seconds_each=$1
        shift "$(($# > 2 ? 3 : 2))"
        set -- "$seconds_each" "$@"
    done
    for reader in $fuzz_findings; do
        echo "== $reader" >&2
        grep -E 'broken promise|runtime error|ERROR|SUMMARY|Test unit' "build/fuzz/$reader.log" >&2
    done
    [ -z "$fuzz_findings" ]
}
