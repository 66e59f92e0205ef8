#!/bin/sh
# Tests that the preview leaves the processors alone while nobody sees its window: hidden by itself,
# or inside a window of another program that is hidden. Runs inside xvfb-run.
# Usage: window_hidden.sh DIPTYCH
diptych=$1
. "$(dirname "$0")/on_screen.sh"

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
check_hiding() { # WINDOW WHAT
    await "$2 draws while it shows" uses_much
    xdotool windowunmap "$1"
    await "$2 rests while it is hidden" uses_little
    xdotool windowmap "$1"
    await "$2 draws again" uses_much
}

"$diptych" --size 320x240 2>errors.txt &
pid=$!
await "the window opens" found Diptych
check_hiding "$window" "the window"
xdotool windowunmap "$window"
kill "$pid"
wait "$pid" 2>/dev/null

# The window of another program holds the preview. It is a child of the window that is hidden.
"$diptych" --size 320x240 2>errors.txt &
beside=$!
pid=$beside
await "a window for the guest opens" found Diptych
kill -STOP "$beside"
host=$window
"$diptych" --window-id "$host" --size 320x240 2>errors.txt &
pid=$!
check_hiding "$host" "the guest"
kill "$pid"
wait "$pid" 2>/dev/null
kill -CONT "$beside"
pid=
echo "window_hidden: done"
