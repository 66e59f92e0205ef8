#!/bin/sh
# Tests --animation and --animation-time of the program.
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

finish
