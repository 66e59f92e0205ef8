#!/bin/sh
# Both programs that `bench --vs` compares must draw on the same processors: with one thread, both on
# the same one. Usage: same_processors.sh DIPTYCH
. "$(dirname "$0")/../program.sh"
if [ "$(nproc)" = 1 ] || ! grep -q Cpus_allowed_list /proc/self/status; then
    echo "skipped: this system lets the test use one processor, or does not tell which"
    exit 77
fi

"$diptych" bench --grid 100 --size 64x48 --sets aa=none --vs "$diptych" --threads 1 \
    --rounds 1000 >out.txt 2>err.txt &
bench=$!
places=''
children=0
for _ in $(seq 100); do # Until both programs have started and are confined.
    sleep .1
    children=$(pgrep -P "$bench" | wc -l)
    places=$(cat $(pgrep -P "$bench" | sed 's:.*:/proc/&/task/*/status:') </dev/null |
        sed -n 's/^Cpus_allowed_list:[[:space:]]*//p' | sort -u)
    [ "$children" = 2 ] && expr "$places" : '[0-9]*$' >/dev/null && break
done
kill "$bench"
wait "$bench"
check "two programs draw, not $children" [ "$children" = 2 ]
check "all threads may run on one processor only, not on: $places" expr "$places" : '[0-9]*$'
finish
