#!/bin/sh
# Tests the window as a user sees it: presses keys and compares screenshots. Runs inside xvfb-run
# with a screen of 1282x720. Usage: window.sh DIPTYCH
diptych=$1
. "$(dirname "$0")/on_screen.sh"

# Takes a screenshot and writes both panes, without the labels and notices, to left.bmp and
# right.bmp, and the contents of the dock to dock.bmp.
shoot() {
    import -window root screen.bmp
    convert screen.bmp \( -clone 0 -crop 640x360+0+70 +repage -write left.bmp +delete \) \
        \( -clone 0 -crop 640x360+642+70 +repage -write right.bmp +delete \) \
        -crop 1282x200+0+516 +repage dock.bmp
}

differing() { # prints the number of pixels that differ between two pictures
    # `compare -metric AE` counts in newer versions of ImageMagick something else.
    convert "$1" "$2" -compose difference -composite -separate -evaluate-sequence max \
        -threshold 0 -format '%[fx:int(mean*w*h+0.5)]' info:
}

deviation() { # prints the spread of grey values; 0 for a picture of one colour
    convert "$1" -colorspace Gray -format '%[fx:int(1000*standard_deviation)]' info:
}

panes_equal() { shoot; [ "$(differing left.bmp right.bmp)" = 0 ]; }
panes_differ() { shoot; [ "$(differing left.bmp right.bmp)" -gt "$1" ] 2>/dev/null; }
both_show_something() {
    shoot
    [ "$(deviation left.bmp)" -gt 50 ] && [ "$(deviation right.bmp)" -gt 50 ]
}
left_changed() { shoot; [ "$(differing left.bmp "$1")" -gt 1000 ] 2>/dev/null; }
dock_changed() { shoot; [ "$(differing dock.bmp "$1")" -gt 1000 ] 2>/dev/null; }
left_same() { shoot; [ "$(differing left.bmp "$1")" = 0 ]; }
stands_still() {
    shoot
    cp left.bmp still.bmp
    sleep 0.5
    left_same still.bmp
}
screenshot_there() { [ -s diptych-0001.png ]; }
window_is() {
    xdotool getwindowgeometry "$window" | grep -q "Geometry: $1"
}

"$diptych" --size 640x480 --current aa=none,af=none --requested aa=none,af=none 2>errors.txt &
pid=$!
await "the window opens" found Diptych
xdotool windowfocus "$window" 2>/dev/null
await "both panes show the scene" both_show_something

# The picture moves by itself and stands still when paused. Equal settings give equal pictures.
cp left.bmp before.bmp
await "the picture moves" left_changed before.bmp
xdotool key space
await "the paused picture stands still" stands_still
panes_equal || fail "panes with equal settings differ"
cp left.bmp before.bmp
xdotool key period period period
await "stepping moves the picture" left_changed before.bmp

# A setting changes its pane at once. Apply copies the setting to the other pane.
xdotool key f
await "anisotropic filtering changes the requested pane" panes_differ 2000
xdotool key Return
await "after Apply both panes are equal" panes_equal
cp left.bmp before.bmp
xdotool key m
await "mip colours show" panes_differ 100000
shoot
left_same before.bmp || fail "a setting of the requested pane changed the current pane"
xdotool key grave m
await "the key of the panes makes the keys act on the current pane" panes_equal

# The mouse does the same: a click on a step changes the requested pane, a drag changes it on the
# way, and Apply copies it to the current pane.
click() {
    xdotool mousemove --window "$window" "$1" "$2" click 1
}
xdotool key grave grave
click 152 560 # The list's entry Antialiasing, which the editor then shows.
click 935 558 # Antialiasing 8x.
await "a click on 8x changes the requested pane" panes_differ 200
click 676 558 # Antialiasing none.
await "a click on none takes it back" panes_equal
xdotool mousemove --window "$window" 676 558 mousedown 1 mousemove --window "$window" 935 558 \
    mouseup 1
await "a drag to 8x changes the requested pane" panes_differ 200
click 1034 652
await "after a click on Apply both panes are equal" panes_equal
xdotool key ctrl+z
await "Undo takes Apply back" panes_differ 200
xdotool key ctrl+z
await "Undo takes the drag back" panes_equal

# Camera, help, screenshot.
cp left.bmp before.bmp
xdotool key c
xdotool keydown w
await "the free camera moves" left_changed before.bmp
xdotool keyup w
await "the released camera stands still" stands_still
cp left.bmp before.bmp
xdotool key $key_f1
await "the help shows" left_changed before.bmp
xdotool key $key_f1
await "the help goes away" left_same before.bmp
cp dock.bmp settings.bmp
xdotool key r
await "the times show in the dock" dock_changed settings.bmp
xdotool key u
await "the costs sheet says how to make a report" left_changed before.bmp
xdotool key u
await "the costs go away" left_same before.bmp
xdotool key $key_f12
await "a screenshot is written" screenshot_there
[ "$(identify -format '%wx%h' diptych-0001.png)" = 1282x720 ] || fail "the screenshot has the wrong size"

# The panes follow the window. The camera returns to its path first: on a slow machine the free
# camera may have flown up to a bare wall. The panel goes: in a small window, its tab covers a pane.
xdotool key c slash
xdotool windowsize "$window" 800 300
await "the window is resized" window_is 800x300
resized_panes_show() {
    import -window "$window" small.bmp
    convert small.bmp -crop 390x180+0+60 +repage left.bmp
    convert small.bmp -crop 390x180+405+60 +repage right.bmp
    [ "$(deviation left.bmp)" -gt 50 ] && [ "$(deviation right.bmp)" -gt 50 ]
}
await "both panes show in the smaller window" resized_panes_show

# The program ends while it measures errors.
xdotool key r
sleep 0.3
xdotool key Escape
wait "$pid"
code=$?
pid=
[ $code = 0 ] || fail "quitting gave exit code $code, expected 0: $(cat errors.txt)"
[ ! -s errors.txt ] || fail "the program printed a message: $(cat errors.txt)"

# Without a display, the program ends with exit code 1 and a line that names `diptych dump`.
env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER "$diptych" 2>errors.txt
code=$?
[ $code = 1 ] || fail "exit code $code without a display, expected 1"
grep -q 'diptych dump' errors.txt || fail "the message without a display does not name dump: $(cat errors.txt)"
echo "window: done"
