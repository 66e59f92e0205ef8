#!/bin/sh
# Tests --animation and --animation-time of the program, and ANIMATION of the ini.
# Usage: animations.sh DIPTYCH SOURCE_FOLDER
. "$(dirname "$0")/../program.sh"
model=$2/tests/assets/data/motion.gltf

# hashes ARGUMENTS...: the hashes of the left pane, without the numbers of the frames.
hashes() {
    "$diptych" dump --model "$model" --size 96x72 --pose '1 2 18 0 0 0 1' --fov 45 --no-ground --hash "$@" 2>err.txt |
        awk '$2 == "current" { print $3 }'
}

hashes --frames 0:75 >all.txt
check "75 frames are drawn: $(cat err.txt)" test "$(wc -l <all.txt)" = 75
check "frame 74 alone is frame 74 after 74 others" \
    test "$(hashes --frames 74:75)" = "$(tail -n 1 all.txt)"
check "the animation of 2 s repeats after 60 frames" \
    test "$(sed -n 8p all.txt)" = "$(sed -n 68p all.txt)"
check "the first animation plays without a name" \
    test "$(hashes --frames 23:24 --animation all)" = "$(sed -n 24p all.txt)"
check "one thread draws the same" \
    test "$(hashes --frames 23:24 --threads 1)" = "$(sed -n 24p all.txt)"
check "the frames differ" test "$(sort -u all.txt | wc -l)" -gt 50
hashes --frames 0:75:30 --animation-time 0.5 | sort -u >held.txt
check "a held animation is one picture" test "$(wc -l <held.txt)" = 1
check "and that of its time" test "$(cat held.txt)" = "$(sed -n 16p all.txt)"
hashes --frames 0:75:30 --animation none | sort -u >none.txt
check "nothing moves without an animation" test "$(wc -l <none.txt)" = 1
check "the model at rest is no moment of the animation" \
    sh -c '! grep -qF "$(cat none.txt)" all.txt'
hashes --animation dance >out.txt
check "an unknown animation is refused" grep -q \
    "'dance' is not an animation of the models, accepted none, \"all\", \"still\"" err.txt
hashes --animation-time -1 >out.txt
check "a time before 0 is refused" grep -q 'a time from 0 to 1,000,000 seconds' err.txt

# The key frames of MD2 files play as well.
model=$2/assets/gallery/crab.md2
hashes --frames 0:40 >stand.txt
check "the first run of key frames plays: $(cat err.txt)" test "$(sort -u stand.txt | wc -l)" -gt 20
check "its 10 frames last a second" test "$(sed -n 8p stand.txt)" = "$(sed -n 38p stand.txt)"
check "frame 39 alone is frame 39 after 39 others" \
    test "$(hashes --frames 39:40 --threads 1)" = "$(tail -n 1 stand.txt)"
hashes --frames 7:8 --animation wave >wave.txt
check "a named run plays" test "$(cat wave.txt)" != "$(sed -n 8p stand.txt)"
hashes --frames 0:40:8 --animation none | sort -u >none.txt
check "and none stands still" test "$(wc -l <none.txt)" = 1
hashes --animation dance >out.txt
check "the message lists the runs" grep -q 'accepted none, "stand", "walk", "wave"' err.txt

# of_ini VALUE: the hash of frame 7 with this value of ANIMATION.
of_ini() {
    printf 'RES: 96x72\nXFILE: %s\nANIMATION: %s\n' "$model" "$1" >scene.ini
    "$diptych" dump --config scene.ini --pose '0 0 90 0 0 0 1' --fov 45 --hash --frames 7:8 2>err.txt |
        awk '$2 == "current" { print $3 }'
}
check "the ini chooses among the runs" test "$(of_ini wave)" != "$(of_ini walk)"
check "and may choose none" test "$(of_ini none)" != "$(of_ini stand)"
of_ini dance >out.txt
check "a mistake names the line of the ini" grep -q \
    "scene.ini:3: .*ANIMATION.*'dance' is not an animation of the models, accepted none, \"stand\"" err.txt

finish
