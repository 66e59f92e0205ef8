#!/bin/sh
# Runs the commands of docs/cost-machines.md, section "On several machines", as they stand there:
# those for GNU parallel on this machine instead of four others, and the Slurm script on a Slurm of
# one node that this test starts. One Slurm job is killed and queued again. The merged reports must equal an
# undivided one in everything but the times, and their pages must show the same pictures.
# Usage: machines.sh DIPTYCH COMPARE_REPORTS SOURCE_FOLDER
# Exit code 77: skipped, since a package is missing or the test does not run as root.
set -u
program=$1
compare=$2
source=$3
failures=0

skip() {
    echo "SKIPPED: $*"
    exit 77
}

for tool in parallel munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin
    command -v $tool >/dev/null || skip "$tool is missing; install parallel, munge and slurm-wlm"
done
[ "$(id -u)" = 0 ] || skip "Slurm of one node needs root"

work=$(mktemp -d)
# munged wants to be reached by every user.
chmod 755 "$work"
servers=

stop_all() {
    if [ -n "$servers" ]; then
        scancel --signal=KILL --full --user=root 2>/dev/null
        scancel --user=root 2>/dev/null
        wait_for 20 "jobs end" no_jobs
        kill $servers 2>/dev/null
        wait $servers 2>/dev/null
    fi
    rm -rf "$work"
}
trap stop_all EXIT
trap 'exit 1' INT TERM HUP

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
}

# wait_for SECONDS WHAT COMMAND...: waits until the command succeeds.
wait_for() {
    tries=$(($1 * 50))
    what=$2
    shift 2
    while [ $tries -gt 0 ]; do
        "$@" >/dev/null 2>&1 && return 0
        tries=$((tries - 1))
        sleep 0.02
    done
    echo "waited in vain: $what"
    return 1
}

# documented N: prints the N-th code block of the section.
documented() {
    awk -v wanted="$1" '
        /^## / { inside = $0 == "## On several machines"; next }
        inside && /^```/ { block += !open; open = !open; next }
        inside && open && block == wanted' "$source/docs/cost-machines.md"
}

# The commands call a `diptych` that draws small pictures.
mkdir "$work/bin" "$work/scratch"
cat >"$work/bin/diptych" <<TEXT
#!/bin/sh
[ "\$2" != merge ] || exec "$program" "\$@"
exec "$program" "\$@" --config "$source/config/courtyard.ini" --size 48x32 --samples 4 \
    --starts 1 --rounds 3 --timed 1 --combine aa,aaa ${MACHINES_SCENE:+--model "$MACHINES_SCENE"}
TEXT
chmod +x "$work/bin/diptych"
PATH="$work/bin:$PATH"
export PATH
export XDG_CACHE_HOME="$work/cache" SCRATCH="$work/scratch" PARALLEL_HOME="$work"

# figures REPORT: prints the pictures of the page's sweeps, each with what it shows, one on a line.
figures() {
    grep '^<figure' "$1/cost.html" | grep -v 'data-set="front"'
}

# front_figure REPORT ROW: prints the picture of a row of the Pareto front, if the page has it.
front_figure() {
    grep "^<figure.* data-set=\"front\" data-row=\"$2\"" "$1/cost.html"
}

# expect_pictures REPORT: the page must have the pictures of the undivided report. The Pareto front
# depends on times, so only those rows of the front are compared that both pages have. (A crop is the
# whole picture here, so that it does not depend on the other rows.)
expect_pictures() {
    figures "$work/undivided" >"$work/expected"
    figures "$1" >"$work/found"
    [ "$(wc -l <"$work/expected")" -gt 30 ] || fail "the undivided report lacks pictures"
    cmp "$work/expected" "$work/found" || fail "$1 has other pictures than the undivided report"
    for row in $(sed -n 's/^<figure.* data-set="front" data-row="\([0-9]*\)".*/\1/p' "$1/cost.html"); do
        front_figure "$work/undivided" "$row" >"$work/expected" || continue
        front_figure "$1" "$row" >"$work/found"
        cmp "$work/expected" "$work/found" || fail "$1 has another picture of row $row of the front"
    done
}

# expect_undivided REPORT: the report must be that of one machine, and its page must be there.
expect_undivided() {
    "$compare" same "$work/undivided/cost.json" "$1/cost.json" 1e-12 ||
        fail "$1 is not the undivided report"
    [ -s "$1/cost.html" ] && [ -s "$1/cost.csv" ] || fail "$1 lacks its page or its table"
    [ "$(wc -c <"$1/cost.html")" -lt 10000000 ] || fail "the page of $1 has more than 10 MB"
    expect_pictures "$1"
}

# With the times of the undivided report, the Pareto front is the same, too.
expect_same_front() {
    grep -q '"same_pictures":\[\]' "$work/undivided/cost.json" ||
        fail "the undivided report joins rows, so it cannot be merged with parts"
    diptych cost merge --out again "$work/undivided/cost.json" part*/cost.json >again.out 2>&1 ||
        fail "the parts cannot be merged with the undivided report: $(tail -5 again.out)"
    grep '^<figure' "$work/undivided/cost.html" >"$work/expected"
    grep '^<figure' again/cost.html >"$work/found"
    cmp "$work/expected" "$work/found" || fail "with equal times, the front has other pictures"
}

# --- GNU parallel ------------------------------------------------------------------------------

test_parallel() {
    mkdir "$work/parallel"
    cd "$work/parallel" || exit 1
    documented 1 >commands
    grep -q 'sshlogin a,b,c,d' commands || fail "docs/cost-machines.md has no commands for GNU parallel"
    # ":" is this machine, without ssh; two jobs at a time.
    sed 's|--sshlogin a,b,c,d|--sshlogin 2/:|' commands >script
    sh -eu script >script.out 2>&1 || fail "the commands for GNU parallel: $(tail -5 script.out)"
    expect_undivided report
    expect_same_front
}

# --- Slurm -------------------------------------------------------------------------------------

write_slurm_conf() {
    host=$(hostname -s)
    port=$((20000 + $$ % 20000))
    cat >"$work/slurm.conf" <<TEXT
ClusterName=diptych
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket,cred_expire=10
CredType=cred/munge
StateSaveLocation=$work/slurm/state
SlurmdSpoolDir=$work/slurm/spool
SlurmctldPidFile=$work/slurm/slurmctld.pid
SlurmdPidFile=$work/slurm/slurmd.pid
SlurmctldLogFile=$work/slurm/slurmctld.log
SlurmdLogFile=$work/slurm/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=16 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
TEXT
    export SLURM_CONF="$work/slurm.conf"
}

node_is_idle() {
    sinfo --noheader --format %T | grep -qx idle
}

no_jobs() {
    [ -z "$(squeue --noheader)" ]
}

start_slurm() {
    mkdir -p "$work/slurm/state" "$work/slurm/spool"
    write_slurm_conf
    head -c 1024 /dev/urandom >"$work/munge.key"
    chmod 600 "$work/munge.key"
    munged --foreground --socket="$work/munge.socket" --key-file="$work/munge.key" \
        --pid-file="$work/munge.pid" --log-file="$work/munge.log" --seed-file="$work/munge.seed" \
        >"$work/munge.out" 2>&1 &
    servers=$!
    wait_for 20 "munged starts" test -S "$work/munge.socket" || return 1
    slurmctld -D >"$work/slurm/slurmctld.out" 2>&1 &
    servers="$servers $!"
    slurmd -D >"$work/slurm/slurmd.out" 2>&1 &
    servers="$servers $!"
    wait_for 60 "the node is idle" node_is_idle
}

show_logs() {
    tail -n 20 "$work"/munge.out "$work"/slurm/*.log "$work"/slurm/*.out
}

# kill_and_requeue JOB TASK: kills a job of the array once its journal has measurements, and queues
# it again. A job that ended before is begun anew.
kill_and_requeue() {
    for attempt in 1 2 3 4 5; do
        wait_for 300 "task $2 measures" test -s "part$2/cost.state" -o -s "part$2/cost.json"
        scancel --signal=KILL --full "$1_$2"
        wait_for 60 "task $2 ends" task_ended "$1_$2"
        if [ -s "part$2/cost.state" ]; then
            cp "part$2/cost.state" "$work/state"
            scontrol requeue "$1_$2" || fail "a killed job cannot be queued again"
            return
        fi
        rm -rf "part$2"
        scontrol requeue "$1_$2"
    done
    fail "task $2 always ended before it was killed"
}

task_ended() {
    scontrol show job "$1" | grep -qE 'JobState=(FAILED|CANCELLED|COMPLETED|NODE_FAIL)'
}

test_slurm() {
    mkdir "$work/array"
    cd "$work/array" || exit 1
    if ! start_slurm; then
        fail "Slurm does not start"
        show_logs
        return
    fi
    documented 2 >cost.sh
    grep -q '^#SBATCH' cost.sh || fail "docs/cost-machines.md has no script for Slurm"
    documented 3 >commands
    job=$(sed -n 's/^sbatch/sbatch --parsable/p' commands | sh)
    [ -n "$job" ] || fail "docs/cost-machines.md has no sbatch command, or it failed"
    kill_and_requeue "$job" 3
    wait_for 1200 "all jobs end" no_jobs
    [ ! -e part3/cost.state ] || fail "the killed job did not finish"
    sed '/^sbatch/d' commands >script
    sh -eu script >script.out 2>&1 || fail "the commands after Slurm: $(tail -5 script.out)"
    expect_undivided report
    expect_same_front
    [ $failures = 0 ] || tail -n 5 slurm-*.out
}

diptych cost --out "$work/undivided" --places 8 >"$work/undivided.out" 2>&1 ||
    fail "the undivided report: $(tail -5 "$work/undivided.out")"
test_parallel
test_slurm
[ $failures = 0 ] && echo "the merged reports of GNU parallel and of Slurm equal the undivided one, with its pictures"
[ $failures = 0 ]
