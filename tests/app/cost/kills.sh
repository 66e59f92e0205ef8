#!/bin/sh
# Kills `diptych cost` at random moments and gives the same command again until the report is
# complete. The report must be that of an uninterrupted run in everything but the times, and it must
# keep the times of the rounds that were finished before a kill. Then checks that a journal of other
# poses, another build, another size or other effects is never joined.
# Usage: kills.sh DIPTYCH COMPARE_REPORTS SOURCE_FOLDER KILLS [SEED]
set -u
diptych=$1
compare=$2
source=$3
kills=$4
seed=${5:-$(date +%s)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
landed=0
kept=0
echo "seed $seed"

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
}

# run FOLDER: runs the command in $cost to its end.
run() {
    $cost --out "$1" --cache "$1/truths" >"$1.out" 2>"$1.err" || {
        fail "$cost --out $1"
        sed 's/^/  | /' "$1.err"
    }
}

expect_same() {
    "$compare" same "$1/cost.json" "$2/cost.json" 0 || fail "$1 and $2 are not the same report"
}

# Compares the report in `part` with the uninterrupted one, and its times with the journals that
# were there after each kill.
check_part() {
    expect_same whole part
    [ ! -e part/cost.state ] || fail "the finished report leaves its journal"
    for journal in journal.*; do
        [ -e "$journal" ] || continue
        count=$("$compare" kept part/cost.json "$journal") || fail "times were not kept: $count"
        kept=$((kept + ${count##*[!0-9]}))
    done
    rm -rf part journal.*
}

# moments COUNT: prints COUNT shares of a run in random order, one in each of COUNT equal parts.
moments() {
    awk -v seed="$seed" -v n="$1" 'BEGIN {
        srand(seed)
        for (i = 0; i < n; i++) order[i] = i
        for (i = n - 1; i > 0; i--) {
            j = int(rand() * (i + 1)); t = order[i]; order[i] = order[j]; order[j] = t
        }
        for (i = 0; i < n; i++) printf "%.4f\n", (order[i] + rand()) / n
    }'
}

# kill_at SECONDS: gives the command and kills it after this time. A run that ends earlier has its
# report checked, and the next attempt kills a new report after half the time: on a machine with
# other work, runs of the same command differ in length by several times.
kill_at() {
    after=$1
    for attempt in 1 2 3 4 5 6; do
        timeout -s KILL "$after" $cost --out part --cache part/truths >part.out 2>part.err
        code=$?
        if [ $code = 137 ]; then
            landed=$((landed + 1))
            [ ! -e part/cost.json ] || [ -s part/cost.html ] || fail "an incomplete report is left"
            [ ! -s part/cost.state ] || cp part/cost.state "journal.$landed"
            # The kill came after the report was complete: another run would begin a new one.
            [ ! -e part/cost.json ] || [ -e part/cost.state ] || check_part
            return
        fi
        [ $code = 0 ] || fail "exit code $code after a kill: $(cat part.err)"
        check_part
        after=$(awk -v s="$after" 'BEGIN { printf "%.3f", s / 2 }')
    done
}

# kill_often COUNT: the uninterrupted report, then COUNT kills over the whole length of a run.
kill_often() {
    rm -rf whole part journal.*
    landed=0
    from=$(date +%s%N)
    run whole
    length=$((($(date +%s%N) - from) / 1000000))
    for share in $(moments "$1"); do
        kill_at "$(awk -v l=$length -v s="$share" 'BEGIN { printf "%.3f", 0.001 + l * s / 1000 }')"
    done
    run part
    check_part
    echo "$landed of $1 kills landed in runs of $length ms; $kept pairs were kept so far"
    [ $((2 * landed)) -gt "$1" ] || fail "too few kills landed"
}

# has_round: whether the journal in folder `left` has a whole round. A line is longer than what the
# program writes at a time, so its beginning may be there without its end, which sed and wc tell.
has_round() {
    [ "$(sed -n '/^round ./p' left/cost.state 2>/dev/null | wc -l)" -gt 0 ]
}

# leave_journal COMMAND...: runs the command in folder `left` until its journal has a round, and
# kills it. A run that ends before the kill, on a busy machine, is repeated.
leave_journal() {
    for attempt in 1 2 3 4 5 6; do
        rm -rf left
        "$@" --out left --cache truths >left.out 2>left.err &
        for hundredth in $(seq 3000); do
            has_round && break
            sleep 0.01
        done
        kill -KILL $!
        wait $! 2>/dev/null
        ! has_round || return
    done
    fail "there is no journal of an unfinished run"
}

# joins_nothing WHAT KINDS COMMAND...: forges lines of these kinds in the journal that $cost
# leaves. The command must then write the report that it writes in an empty folder.
joins_nothing() {
    what=$1
    kinds=$2
    shift 2
    rm -rf fresh
    "$@" --out fresh --cache truths >fresh.out 2>fresh.err || fail "$*: $(cat fresh.err)"
    leave_journal $cost
    "$compare" forge left/cost.state $kinds || fail "nothing was forged"
    "$@" --out left --cache truths >left.out 2>left.err || fail "$*: $(cat left.err)"
    "$compare" same fresh/cost.json left/cost.json 0 || fail "$what: the journal was joined"
}

options="cost --config $source/config/courtyard.ini --size 48x32 --places 2 --samples 16 --timed 1 --combine aa"
square="$options --model $source/tests/assets/data/square.gltf"
cost="$diptych $square --starts 2 --rounds 8"
kill_often "$kills"
[ $kept -gt 0 ] || fail "no kill came after a round"
# The courtyard has more paths, and combinations that draw the same pictures.
cost="$diptych $options --places 1 --samples 4 --starts 1 --rounds 2"
kill_often $(((kills + 9) / 10))

# --- journals of other runs
cp "$source/campaths/aa.pth" poses.pth
cost="$diptych $square --starts 1 --rounds 20 --path poses.pth"
# Control: the same command joins a forged round, and the comparison sees it.
leave_journal $cost
"$compare" forge left/cost.state round || fail "nothing was forged"
$cost --out left --cache truths >left.out 2>left.err
"$compare" same left/cost.json left/cost.json 0 >/dev/null && fail "a forged time is not seen"

# Control: a forged error is seen as well.
run whole_path
leave_journal $cost
"$compare" forge left/cost.state errors || fail "nothing was forged"
$cost --out left --cache truths >left.out 2>left.err
"$compare" same whole_path/cost.json left/cost.json 0 >/dev/null && fail "a forged error is not seen"

# The errors of equal pictures may be joined if only the effects differ, so only rounds are forged.
joins_nothing "other effects" round $cost --force-all-effects
joins_nothing "another size" "round errors" $cost --size 40x32
cp "$diptych" ./other_build
printf x >>other_build
joins_nothing "another build" "round errors" ./other_build ${cost#"$diptych"}

# Other poses in the same file. The commands themselves change the file. The camera moves by 1 cm
# only, so that the same combinations draw equal pictures and the rounds have equally many times.
with_poses() {
    cat >"$1" <<TEXT
#!/bin/sh
awk 'NF == 7 { \$1 += $2 } 1' "$source/campaths/aa.pth" >poses.pth
exec $cost "\$@"
TEXT
    chmod +x "$1"
}
with_poses poses_before 0
with_poses poses_after 0.01
cost=./poses_before
joins_nothing "other poses" "round errors" ./poses_after

[ "$failures" = 0 ]
