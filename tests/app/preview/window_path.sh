#!/bin/sh
# Makes a camera path in the window with the mouse and keys, and reads the saved file with the other
# commands. Runs inside xvfb-run.
#
# usage: window_path.sh DIPTYCH
diptych=$1
config=$(cd "$(dirname "$0")/../../../config" && pwd)/courtyard.ini
. "$(dirname "$0")/on_screen.sh"

shows_something() {
    import -window root shot.png
    [ "$(deviation shot.png)" -gt 50 ]
}

"$diptych" preview --config "$config" --size 320x220 >log.txt 2>&1 &
pid=$!
await "the window opens" found Diptych
await "the window shows something" shows_something # The camera has a pose once a picture shows.
xdotool mousemove 640 250 key c
xdotool key ctrl+n
xdotool mousedown 3 mousemove 660 255
xdotool mousemove 700 260 mouseup 3
sleep 0.5
xdotool key ctrl+n
xdotool keydown w
sleep 0.6
xdotool keyup w
sleep 0.3
xdotool key ctrl+n
sleep 0.3
xdotool key ctrl+w
await "the path is saved" test -s path-0001.pth
xdotool key ctrl+w
await "the path is saved again" test -s path-0002.pth
cmp path-0001.pth path-0002.pth || fail "a second file differs"
xdotool key ctrl+q
wait "$pid" || fail "the program ends with exit code $?"
pid=

"$diptych" path info path-0001.pth >info || fail "the file cannot be read"
grep -q 'keys       3, 1 s apart' info || fail "the file has other keys: $(cat info)"
"$diptych" path convert path-0001.pth copy.bth || fail "the path cannot be converted"
"$diptych" path convert copy.bth copy.pth || fail "the path cannot be converted back"
cmp path-0001.pth copy.pth || fail "a conversion changes the file"

# A frame of the path at a key is the frame of the key's pose.
pose=$(awk '!/^#/ && NF == 7 { if (++n == 2) print }' path-0001.pth)
"$diptych" dump --config "$config" --size 64x48 --path path-0001.pth --fps 1 --frames 1:2 --hash \
    >path.hash || fail "the path cannot be dumped"
"$diptych" dump --config "$config" --size 64x48 --pose "$pose" --fps 1 --frames 1:2 --hash \
    >pose.hash || fail "the pose cannot be dumped"
[ -s path.hash ] || fail "there is no hash"
cmp path.hash pose.hash || fail "the path's frame differs from the frame of the key's pose"
