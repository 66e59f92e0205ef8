#!/bin/sh
# Tests that the window opens with the smallest and the largest panes, that it can be made as small
# as one pixel, and that it then still takes keys. Runs inside xvfb-run with a screen of 1282x480.
# Usage: window_sizes.sh DIPTYCH
diptych=$1
. "$(dirname "$0")/on_screen.sh"

window_is() { xdotool getwindowgeometry "$window" | grep -q "Geometry: $1"; }
shows_something() {
    import -window "$window" shot.png 2>/dev/null &&
        [ "$(deviation shot.png)" -gt 20 ]
}

# open SIZE GEOMETRY: opens the program with panes of this size; the window must have this geometry.
open() {
    "$diptych" --model one.obj --size "$1" 2>errors.txt &
    pid=$!
    await "the window opens with $1" found Diptych
    xdotool windowfocus "$window" 2>/dev/null
    await "the window has $2 pixels" window_is "$2"
    await "the window shows something with $1" shows_something
}

# quit: the program must end with exit code 0 and without a message.
quit() {
    xdotool key Escape
    wait "$pid"
    code=$?
    pid=
    [ $code = 0 ] && [ ! -s errors.txt ] || fail "exit code $code: $(cat errors.txt)"
}

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
# A window is at least 320 pixels wide and at most as large as the screen. The dock beneath the panes
# is 240 pixels high.
open 1x1 320x241
xdotool windowsize "$window" 1 1
await "the window shrinks" window_is 1x1
xdotool key r
sleep 0.3
quit
open 8192x8192 1282x720
quit
open 8192x1 1282x241
quit
echo "window_sizes: done"
