#!/bin/sh
# Drops good and bad files onto the real window under Xvfb. Usage: window_drop.sh DIPTYCH DROP_FILE
set -u
diptych=$1
drop_file=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

fail() {
    echo "FAILED: $*"
    cat log.txt
    kill "$program" 2>/dev/null
    exit 1
}

# wait_for COMMAND...: repeats the command until it succeeds, for at most two minutes.
wait_for() {
    tries=0
    until "$@" >/dev/null 2>&1; do
        tries=$((tries + 1))
        [ $tries -lt 1200 ] || return 1
        sleep 0.1
    done
}

printf 'v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >'a triangle.obj'
printf 'diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n' >still.pth
echo nonsense >bad.pth
"$diptych" --size 200x150 --threads 1 2>log.txt &
program=$!
wait_for xdotool search --onlyvisible --name '^Diptych' || fail "no window appears"
window=$(xdotool search --onlyvisible --name '^Diptych' | head -n 1)

# shows TEXT: asks for a screenshot and looks for the text in the newest one that exists.
shows() {
    xdotool key --window "$window" F12
    sleep 0.3
    grep -qa "$1" "$(ls diptych-*.png | tail -n 1)"
}

# twice TEXT: two lines of the log have the text.
twice() {
    [ "$(grep -c "$1" log.txt)" -ge 2 ]
}

"$drop_file" "$window" "$work/bad.pth" || fail "the window does not take a file"
wait_for grep -q 'bad.pth:1: .*not a camera path' log.txt || fail "a bad path is not reported"
"$drop_file" "$window" "$work/none.obj" || fail "the window does not take a name"
wait_for grep -q 'none.obj: cannot open the model' log.txt || fail "a missing model is not reported"
kill -0 "$program" || fail "a bad file has ended the preview"
"$drop_file" "$window" "$work/a%20triangle.obj" || fail "the window does not take a model"
wait_for shows 'a triangle.obj' || fail "the model is not shown"
"$drop_file" "$window" "$work/still.pth" || fail "the window does not take a path"
wait_for shows '0 0 3 0 0 0 1' || fail "the path is not flown"

# Bad files of every kind: each is reported, and the program lives and still draws.
: >empty.obj
mkdir folder.obj
mkfifo pipe.obj pipe.ini
head -c 5000 "$diptych" >noise.glb
echo 'Dear reader,' >text.txt
echo 'NONSENSE' >bad.ini
echo '{"header":' >cut.json
echo no >bad.bth
printf 'v 0 0 0\nf 1 2 3\n' >bad.obj
dropped=0
for file in empty.obj folder.obj pipe.obj pipe.ini noise.glb text.txt bad.ini cut.json bad.bth \
    bad.obj none.ini none.json none.bth; do
    "$drop_file" "$window" "$work/$file" || fail "the window does not take $file"
    wait_for grep -q "$file" log.txt || fail "$file is not reported"
    kill -0 "$program" || fail "$file has ended the preview"
    wait_for shows '0 0 3 0 0 0 1' || fail "the path is gone after $file"
    rm -f diptych-*.png
    dropped=$((dropped + 1))
done

# A program that dies while it drops a file leaves the X server with windows that are gone.
for moment in enter status drop request; do
    for round in 1 2 3; do
        "$drop_file" "$window" "$work/still.pth" --die $moment 2>/dev/null
        sleep 0.2
        kill -0 "$program" || fail "the preview dies with a program that dies at: $moment ($round)"
    done
done
"$drop_file" "$window" "$work/bad.pth" || fail "no file is taken after others were given up"
wait_for twice 'bad.pth:1' || fail "a file is not opened after others were given up"

xdotool windowfocus "$window" key ctrl+q 2>/dev/null
wait "$program" || fail "the preview ends with exit code $?"
echo "$((5 + dropped)) drops on the window, and twelve by programs that die"
