#!/bin/sh
# Tests that the preview leaves the processors alone while nobody sees its window: hidden by itself,
# or inside a window of another program that is hidden. Runs inside xvfb-run.
# Usage: window_hidden.sh DIPTYCH
set -u
diptych=$1
folder=$(mktemp -d) || exit 1
cd "$folder" || exit 1
pid=
outer=
finish() {
    [ -n "$pid" ] && kill "$pid" 2>/dev/null
    [ -n "$outer" ] && kill "$outer" 2>/dev/null
    cd / && rm -rf "$folder"
}
trap finish EXIT

fail() {
    echo "window_hidden.sh: $1" >&2
    exit 1
}

# await DESCRIPTION COMMAND...: repeats the command until it succeeds, for at most two minutes.
await() {
    what=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -ge 600 ] && fail "never happened: $what"
        kill -0 "$pid" 2>/dev/null || fail "the program ended while waiting: $what"
        sleep 0.2
    done
}

ticks() { # prints the processor time that the program has used, in hundredths of a second
    sed 's/.*) //' "/proc/$pid/stat" | awk '{print $12 + $13}'
}
uses_little() { # in three seconds, less than a twentieth of a processor
    before=$(ticks)
    sleep 3
    used=$(($(ticks) - before))
    echo "used $used of 300 ticks"
    [ $used -lt 15 ]
}
uses_much() {
    before=$(ticks)
    sleep 1
    [ $(($(ticks) - before)) -gt 20 ]
}
found() {
    window=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | head -n 1)
    [ -n "$window" ]
}
check_hiding() { # WINDOW WHAT
    await "$2 draws while it shows" uses_much
    xdotool windowunmap "$1"
    await "$2 rests while it is hidden" uses_little
    xdotool windowmap "$1"
    await "$2 draws again" uses_much
}

"$diptych" --size 320x240 2>errors.txt &
pid=$!
await "the window opens" found '^Diptych'
check_hiding "$window" "the window"
xdotool windowunmap "$window"
kill "$pid"
wait "$pid" 2>/dev/null

# The window of another program holds the preview. It is a child of the window that is hidden.
"$diptych" --size 320x240 2>errors.txt &
outer=$!
pid=$outer
await "a window for the guest opens" found '^Diptych'
kill -STOP "$outer"
host=$window
"$diptych" --window-id "$host" --size 320x240 2>errors.txt &
pid=$!
check_hiding "$host" "the guest"
kill "$pid"
wait "$pid" 2>/dev/null
kill -CONT "$outer"
pid=
echo "window_hidden: done"
