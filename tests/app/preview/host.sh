#!/bin/sh
# Tests the preview inside the window of the sample host: settings pushed by the host's buttons,
# keys and clicks in the preview, sizes, and either program killed first. Runs inside xvfb-run.
# Usage: host.sh DIPTYCH HOST
diptych=$1
host=$2
. "$(dirname "$0")/on_screen.sh"

last_settings() { grep '"event":"settings"' lines.txt | tail -n 1; }
requested_has() { last_settings | sed 's/.*"requested"//' | grep -q "$1"; }
current_has() { last_settings | sed 's/"requested".*//' | grep -q "$1"; }
panes_are() { grep '"event":"times"' lines.txt | tail -n 1 | grep -q "\"width\":$1,\"height\":$2,"; }
is_gone() { # also true for a process that has ended but that nobody has waited for
    [ ! -e "/proc/$1/stat" ] || grep -q '^[0-9]* ([a-z]*) Z' "/proc/$1/stat"
}
press_button() { # number from 0
    xdotool mousemove $((8 + 88 * $1 + 40)) 20 click 1
}
area_shows() { # the guest draws in the lower right corner of the host's window of this size
    import -window root screen.png
    convert screen.png -crop "100x100+$(($1 - 130))+$(($2 - 160))" +repage corner.png
    [ "$(deviation corner.png)" -gt 20 ]
}

start() {
    : >lines.txt
    "$host" "$diptych" --current aa=none --requested aa=none "$@" >lines.txt 2>errors.txt &
    pid=$!
    await "the preview greets its host" grep -q '"protocol":1' lines.txt
    await "the host hears of the settings" grep -q '"event":"settings"' lines.txt
    guest=$(sed -n 's/^guest started with process id //p' lines.txt)
    beside=$guest
    window=$(xdotool search --name '^Settings panel$' | head -n 1)
}

start
await "the first times arrive" panes_are 320 208
await "the preview shows in the host's window" area_shows 642 280

# Settings are pushed.
press_button 0
await "the button AA 4x changes the requested pane" requested_has aa=4
press_button 2
await "the button AF 16x changes the requested pane" requested_has af=16
press_button 4
await "the button Apply copies the settings" current_has aa=4

# Mouse and keyboard of the preview. The first click gives it the focus, and is a click all the same.
xdotool mousemove 500 150 click 1
await "a click in the preview is a pick" grep -q '"event":"picks","pane":"requested","button":"left"' lines.txt
xdotool key t
await "a key in the preview changes a setting" requested_has taa=alternate
xdotool mousemove 600 20
xdotool key m
await "keys arrive while the pointer is elsewhere" requested_has mipdebug=on

# The preview follows the window's size. The dock's bar takes 32 pixels of the panes' height, or a
# quarter of the window's height if that is less.
xdotool windowsize "$window" 386 260
await "the panes follow the host's window" panes_are 192 188
await "the small preview shows" area_shows 386 260
xdotool windowsize "$window" 902 400
await "the panes follow the larger window" panes_are 450 328
await "the large preview shows" area_shows 902 400
xdotool windowsize "$window" 40 44
await "panes of 19x3 pixels are drawn" panes_are 19 3

# The guest is killed first: the host goes on.
kill -9 "$guest"
await "the host notices that the guest has ended" grep -q 'guest ended' lines.txt
kill -0 "$pid" || fail "the host ended with its guest"
kill "$pid"
wait "$pid" 2>/dev/null

# The guest ends by itself: Escape.
start
await "the times arrive again" panes_are 320 208
xdotool mousemove 500 150 click 1
await "the preview has the focus" grep -q '"event":"picks"' lines.txt
xdotool key Escape
await "the guest quits" grep -q 'guest ended with exit code 0' lines.txt
[ ! -s errors.txt ] || fail "the guest printed a message"
kill "$pid"
wait "$pid" 2>/dev/null

# The host is killed first: the guest says so and ends.
start
await "the times arrive once more" panes_are 320 208
kill -9 "$pid"
wait "$pid" 2>/dev/null
pid=
await "the guest ends after its host" is_gone "$guest"
grep -q 'has closed it' errors.txt || fail "the guest does not say why it ended"
[ "$(wc -l <errors.txt)" = 1 ] || fail "the guest printed more than one line"
beside=

# Windows that do not exist.
"$diptych" --window-id 0x1fffff 2>errors.txt
code=$?
[ $code = 2 ] || fail "exit code $code for a window that does not exist, expected 2"
grep -q 'there is no window 2097151' errors.txt || fail "the message does not name the window"
"$diptych" --window-id panel 2>errors.txt
[ $? = 2 ] || fail "a window that is no number is accepted"
echo "host: done"
