#!/bin/sh
# Drops good and bad files onto the real window under Xvfb. Usage: window_drop.sh DIPTYCH DROP_FILE
diptych=$1
drop_file=$2
. "$(dirname "$0")/on_screen.sh"

printf 'v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >'a triangle.obj'
printf 'diptych-path 1\nperiod 1\n0 0 3 0 0 0 1\n' >still.pth
echo nonsense >bad.pth
"$diptych" --size 200x150 --threads 1 2>log.txt &
pid=$!
await "the window opens" found Diptych

# shows TEXT: asks for a screenshot and looks for the text in the newest one that exists.
shows() {
    xdotool key --window "$window" $key_f12
    sleep 0.3
    grep -qa "$1" "$(ls diptych-*.png 2>/dev/null | tail -n 1)" 2>/dev/null
}

# twice TEXT: two lines of the log have the text.
twice() {
    [ "$(grep -c "$1" log.txt)" -ge 2 ]
}

"$drop_file" "$window" "$folder/bad.pth" || fail "the window does not take a file"
await "a bad path is reported" grep -q 'bad.pth:1: .*not a camera path' log.txt
"$drop_file" "$window" "$folder/none.obj" || fail "the window does not take a name"
await "a missing model is reported" grep -q 'none.obj: cannot open the model' log.txt
kill -0 "$pid" || fail "a bad file has ended the preview"
"$drop_file" "$window" "$folder/a%20triangle.obj" || fail "the window does not take a model"
await "the model is shown" shows 'a triangle.obj'
"$drop_file" "$window" "$folder/still.pth" || fail "the window does not take a path"
await "the path is flown" shows '0 0 3 0 0 0 1'

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
    "$drop_file" "$window" "$folder/$file" || fail "the window does not take $file"
    await "$file is reported" grep -q "$file" log.txt
    kill -0 "$pid" || fail "$file has ended the preview"
    await "the path is flown after $file" shows '0 0 3 0 0 0 1'
    rm -f diptych-*.png
    dropped=$((dropped + 1))
done

# A program that dies while it drops a file leaves the X server with windows that are gone.
for moment in enter status drop request; do
    for round in 1 2 3; do
        "$drop_file" "$window" "$folder/still.pth" --die $moment 2>/dev/null
        sleep 0.2
        kill -0 "$pid" || fail "the preview dies with a program that dies at: $moment ($round)"
    done
done
"$drop_file" "$window" "$folder/bad.pth" || fail "no file is taken after others were given up"
await "a file is opened after others were given up" twice 'bad.pth:1'

xdotool windowfocus "$window" key ctrl+q 2>/dev/null
wait "$pid" || fail "the preview ends with exit code $?"
echo "$((5 + dropped)) drops on the window, and twelve by programs that die"
