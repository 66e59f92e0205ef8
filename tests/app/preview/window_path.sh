#!/bin/sh
# Makes a camera path in the window with the mouse and keys, and reads the saved file with the other
# commands. Needs an X display, xdotool and a working folder of its own.
#
# usage: window_path.sh DIPTYCH
set -eu
diptych=$1
unset WAYLAND_DISPLAY
folder=$(mktemp -d)
trap 'kill "$pid" 2>/dev/null || true; rm -rf "$folder"' EXIT
config=$(cd "$(dirname "$0")/../../../config" && pwd)/courtyard.ini
cd "$folder"

fail() {
    echo "window_path: $1" >&2
    cat log >&2
    exit 1
}

# Waits for at most two minutes until a command succeeds.
await() {
    tries=0
    until "$@" >/dev/null 2>&1; do
        tries=$((tries + 1))
        [ "$tries" -lt 1200 ] || fail "waited in vain for: $*"
        sleep 0.1
    done
}

shows_something() {
    import -window root shot.png
    [ "$(convert shot.png -colorspace Gray -format '%[fx:int(1000*standard_deviation)]' info:)" -gt 50 ]
}

"$diptych" preview --config "$config" --size 320x220 >log 2>&1 &
pid=$!
await xdotool search --onlyvisible --pid "$pid"
await shows_something # The camera has a pose once a picture shows.
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
await test -s path-0001.pth
xdotool key ctrl+w
await test -s path-0002.pth
cmp path-0001.pth path-0002.pth || fail "a second file differs"
xdotool key ctrl+q
await sh -c "! kill -0 $pid"

"$diptych" path info path-0001.pth >info || fail "the file cannot be read"
grep -q 'keys       3, 1 s apart' info || fail "the file has other keys: $(cat info)"
"$diptych" path convert path-0001.pth copy.bth
"$diptych" path convert copy.bth copy.pth
cmp path-0001.pth copy.pth || fail "a conversion changes the file"

# A frame of the path at a key is the frame of the key's pose.
pose=$(awk '!/^#/ && NF == 7 { if (++n == 2) print }' path-0001.pth)
"$diptych" dump --config "$config" --size 64x48 --path path-0001.pth --fps 1 --frames 1:2 --hash \
    >path.hash || fail "the path cannot be dumped"
"$diptych" dump --config "$config" --size 64x48 --pose "$pose" --fps 1 --frames 1:2 --hash \
    >pose.hash || fail "the pose cannot be dumped"
[ -s path.hash ] || fail "there is no hash"
cmp path.hash pose.hash || fail "the path's frame differs from the frame of the key's pose"
