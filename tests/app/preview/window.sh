#!/bin/sh
# Tests the window as a user meets it: presses keys and compares screenshots. Runs inside xvfb-run
# with a screen of 1282x480. Usage: window.sh DIPTYCH
set -u
diptych=$1
folder=$(mktemp -d) || exit 1
cd "$folder" || exit 1
pid=
finish() {
    [ -n "$pid" ] && kill "$pid" 2>/dev/null
    cd / && rm -rf "$folder"
}
trap finish EXIT

fail() {
    echo "window.sh: $1" >&2
    exit 1
}

# await DESCRIPTION COMMAND...: tries for 20 seconds.
await() {
    what=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -ge 100 ] && fail "never happened: $what"
        kill -0 "$pid" 2>/dev/null || fail "the program ended while waiting: $what"
        sleep 0.2
    done
}

# Both panes without the strips above and below, as left.png and right.png.
shoot() {
    import -window root screen.png
    convert screen.png -crop 640x360+0+70 +repage left.png
    convert screen.png -crop 640x360+642+70 +repage right.png
}

differing() { # pixels that differ between two pictures
    compare -metric AE "$1" "$2" null: 2>&1
}

deviation() { # spread of grey values, 0 for a flat picture
    convert "$1" -colorspace Gray -format '%[fx:int(1000*standard_deviation)]' info:
}

panes_equal() { shoot; [ "$(differing left.png right.png)" = 0 ]; }
panes_differ() { shoot; [ "$(differing left.png right.png)" -gt "$1" ] 2>/dev/null; }
both_show_something() {
    shoot
    [ "$(deviation left.png)" -gt 50 ] && [ "$(deviation right.png)" -gt 50 ]
}
left_changed() { shoot; [ "$(differing left.png "$1")" -gt 1000 ] 2>/dev/null; }
left_same() { shoot; [ "$(differing left.png "$1")" = 0 ]; }
stands_still() {
    shoot
    cp left.png still.png
    sleep 0.5
    left_same still.png
}
screenshot_there() { [ -s diptych-0001.png ]; }
window_is() {
    xdotool getwindowgeometry "$window" | grep -q "Geometry: $1"
}

"$diptych" --size 640x480 --current aa=none,af=none --requested aa=none,af=none 2>errors.txt &
pid=$!
found() { window=$(xdotool search --onlyvisible --name '^Diptych$' 2>/dev/null | head -n 1); [ -n "$window" ]; }
await "the window opens" found
xdotool windowfocus "$window" 2>/dev/null
await "both panes show the scene" both_show_something

# It moves by itself, stands still when paused, and equal settings give equal pictures.
cp left.png before.png
await "the picture moves" left_changed before.png
xdotool key space
await "the paused picture stands still" stands_still
panes_equal || fail "panes with equal settings differ"
cp left.png before.png
xdotool key period period period
await "stepping moves the picture" left_changed before.png

# A setting changes the pane it acts on at once; Apply takes it over.
xdotool key f
await "anisotropic filtering changes the requested pane" panes_differ 2000
xdotool key Return
await "after Apply both panes are equal" panes_equal
cp left.png before.png
xdotool key m
await "mip colours show" panes_differ 100000
shoot
left_same before.png || fail "the current pane changed with the requested one's setting"
xdotool key Tab m
await "Tab makes the keys act on the current pane" panes_equal

# Camera, help, screenshot.
cp left.png before.png
xdotool key c
xdotool keydown w
await "the free camera moves" left_changed before.png
xdotool keyup w
await "the released camera stands still" stands_still
cp left.png before.png
xdotool key F1
await "the help shows" left_changed before.png
xdotool key F1
await "the help goes away" left_same before.png
xdotool key r
await "the panel shows" left_changed before.png
xdotool key r
await "the panel goes away" left_same before.png
xdotool key u
await "the costs show how to get them" left_changed before.png
xdotool key u
await "the costs go away" left_same before.png
xdotool key F12
await "a screenshot is written" screenshot_there
[ "$(identify -format '%wx%h' diptych-0001.png)" = 1282x480 ] || fail "screenshot of a wrong size"

# The panes follow the window.
xdotool windowsize "$window" 800 300
await "the window is resized" window_is 800x300
resized_panes_show() {
    import -window "$window" small.png
    convert small.png -crop 390x180+0+60 +repage left.png
    convert small.png -crop 390x180+405+60 +repage right.png
    [ "$(deviation left.png)" -gt 50 ] && [ "$(deviation right.png)" -gt 50 ]
}
await "both panes show in the smaller window" resized_panes_show

# It ends while the errors are being measured.
xdotool key r
sleep 0.3
xdotool key Escape
wait "$pid"
code=$?
pid=
[ $code = 0 ] || fail "quitting gave exit code $code: $(cat errors.txt)"
[ ! -s errors.txt ] || fail "said something unasked: $(cat errors.txt)"

# Without a display: one line that names the way out, exit code 1.
env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER "$diptych" 2>errors.txt
code=$?
[ $code = 1 ] || fail "exit code $code without a display, expected 1"
grep -q 'diptych dump' errors.txt || fail "no word of dump without a display: $(cat errors.txt)"
echo "window: done"
