# What the tests of the window share. They run inside xvfb-run and source this file first. It gives
# them a working folder of their own, which is removed when the test ends.
set -u
unset WAYLAND_DISPLAY
folder=$(mktemp -d) || exit 1
cd "$folder" || exit 1
pid=    # The program that is tested. The test ends it, if it still runs.
beside= # A second program that the test ends.
finish() {
    for program in $pid $beside; do
        kill "$program" 2>/dev/null
    done
    cd / && rm -rf "$folder"
}
trap finish EXIT
# SDL 3 looks for Wayland first, whose library prints a line if this is not set.
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-$folder}"

# fail TEXT: ends the test, and prints what the programs have written last.
fail() {
    echo "$(basename "$0"): $1" >&2
    for file in *.txt; do
        [ -f "$file" ] && echo "$file:" >&2 && tail -n 5 "$file" >&2
    done
    exit 1
}

# await DESCRIPTION COMMAND...: repeats the command until it succeeds, for at most two minutes, while
# the program that is tested runs.
await() {
    what=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -lt 600 ] || fail "never happened: $what"
        [ -z "$pid" ] || kill -0 "$pid" 2>/dev/null || fail "the program ended while waiting: $what"
        sleep 0.2
    done
}

# found NAME: sets $window to the visible window whose name begins so.
found() {
    window=$(xdotool search --onlyvisible --name "^$1" 2>/dev/null | head -n 1)
    [ -n "$window" ]
}

# The keys F1 and F12 by their numbers on a keyboard of X. xdotool presses Alt with them if they are
# named, where xkeyboard-config 2.48 describes the keyboard.
key_f1=67
key_f12=96

deviation() { # prints the spread of a picture's grey values: 0 for one colour, 1000 at most
    convert "$1" -colorspace Gray -format '%[fx:int(1000*standard_deviation)]' info:
}
