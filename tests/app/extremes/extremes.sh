#!/bin/sh
# Runs the program with the smallest and the largest inputs that it accepts, and with inputs just
# beyond them. Each must be drawn, or be refused with one line and exit code 2. The pictures are
# compared with truths that do not need Diptych's own idea of a picture: exact numbers of samples,
# and other inputs that must show the same.
# Usage: extremes.sh DIPTYCH MAKE_INPUTS small|big
. "$(dirname "$0")/../program.sh"
make_inputs=$2
part=$3

# run COMMAND...: runs a command that must succeed, with its output in out.txt and err.txt. In the
# big part, prints how long it took and how much memory it used.
run() {
    checks=$((checks + 1))
    begin=$(date +%s)
    "$@" >out.txt 2>err.txt || fail "exit code $? of $*"
    [ "$part" = small ] || {
        echo "$(($(date +%s) - begin)) s: $*" | sed "s|$diptych|diptych|"
        grep -o 'peak .* resident' err.txt | sed 's/^/    /'
    }
}

# counter PANE NAME: prints a counter of the first frame of the record in out.txt.
counter() {
    sed -n "/\"$1\":/,\$p" out.txt | sed -n "s/.*\"$2\":[^0-9]*\([0-9]*\).*/\1/p" | head -n 1
}

# count_is PANE NAME LEAST MOST
count_is() {
    checks=$((checks + 1))
    count=$(counter "$1" "$2")
    { [ "${count:-0}" -ge "$3" ] && [ "${count:-0}" -le "$4" ]; } 2>/dev/null ||
        fail "$2 of the $1 pane is '$count', expected $3 to $4"
}

# hashes FILE COMMAND...: keeps the hashes of a run.
hashes() {
    file=$1
    shift
    run "$diptych" dump --hash --timing "$@"
    cp out.txt "$file"
}

# same A B WHAT: two runs must have drawn the same pictures.
same() {
    checks=$((checks + 1))
    { [ -s "$1" ] && cmp -s "$1" "$2"; } || fail "pictures differ: $3"
}

# pane SIZE: draws a square that fills a pane of this size. Every sample must show it.
pane() {
    pixels=$((${1%x*} * ${1#*x}))
    run "$diptych" dump --json - --timing --size "$1" --model square.glb --path near.pth \
        --current aa=none --requested aa=8,af=16,aaa=on,asd=1
    count_is current samples_shown $pixels $pixels
    count_is requested samples_shown $((8 * pixels)) $((8 * pixels))
    count_is current fragments_shaded $pixels $pixels
}

# textured SIZE: draws an orbit around a square with a texture of this size. All textures have one
# colour, so the pictures must be those of the texture of 1x1 texels.
textured() {
    "$make_inputs" picture "${1%x*}" "${1#*x}" "t$1.png" || fail "no texture"
    sed "s/SIZE/$1/" square.obj >"t$1.obj"
    printf 'newmtl m\nmap_Kd t%s.png\n' "$1" >"t$1.mtl"
    for set in aa=none aa=8,af=16,aaf=on aa=4,af=8,opt=advanced; do
        hashes "$1-$set.txt" --size 160x120 --model "t$1.obj" --frames 0:300:100 \
            --current aa=2,opt=standard,miplod=performance --requested $set
        [ ! -s err.txt ] || ! grep -q warning err.txt || fail "a warning with a texture of $1"
        same "1x1-$set.txt" "$1-$set.txt" "a texture of $1 and of 1x1 texels with $set"
    done
    rm -f "t$1.png"
}

"$make_inputs" grid 1 square.glb || exit 1
cat >square.obj <<TEXT
mtllib tSIZE.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 3 0
vt 3 3
vt 0 3
usemtl m
f 1/1 2/2 3/3
f 1/1 3/3 4/4
TEXT
printf 'diptych-path 1\nperiod 0.5\n0 0 0.001 0 0 0 1\n' >near.pth
printf 'diptych-path 1\nperiod 0.5\n0 0 1.8 0 0 0 1\n' >square.pth

if [ "$part" = small ]; then
    # Panes.
    for size in 1x1 2x1 1x7 1x8192 8192x5 63x65; do
        pane $size
    done
    refuse "\[--size\] '0x1'" dump --hash --size 0x1
    refuse "\[--size\] '8193x1'" dump --hash --size 8193x1
    refuse "\[--size\] '1x8193'" bench --size 1x8193
    for size in 1x1 8192x1; do
        hashes court.txt --size $size --frames 0:90:30 --requested aa=8,af=16,aaa=on,asd=1
        hashes court_scalar.txt --size $size --frames 0:90:30 --requested aa=8,af=16,aaa=on,asd=1 \
            --isa scalar --threads 1
        same court.txt court_scalar.txt "the courtyard at $size pixels with other instructions"
    done
    run "$diptych" bench --size 1x1 --frames 1 --rounds 1

    # Scenes without triangles.
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >points.obj
    printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >lines.obj
    : >blank.obj
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{}]}' >node.gltf
    printf '{"asset":{"version":"2.0"}}' >none.gltf
    printf 'solid x\nendsolid x\n' >empty.stl
    printf 'RES: 8x8\n' >none.ini
    refuse 'points.obj: the model has no triangles' dump --hash --model points.obj
    refuse 'lines.obj: the model has no triangles' dump --hash --model lines.obj
    refuse 'blank.obj: the model file is empty' dump --hash --model blank.obj
    refuse 'node.gltf: the model has no triangles' dump --hash --model node.gltf
    refuse 'none.gltf: the model has no triangles' dump --hash --model none.gltf
    refuse 'empty.stl: the model has no triangles' dump --hash --model empty.stl
    refuse 'none.ini: \[XFILE\] is missing' dump --hash --config none.ini

    # One triangle: its area is that of a perspective projection, 6642 pixels, more or less the
    # 394 pixels of its outline.
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
    printf 'diptych-path 1\nperiod 0.5\n0 0 4 0 0 0 1\n' >one.pth
    run "$diptych" dump --json - --size 640x480 --model one.obj --path one.pth --current aa=none
    count_is current samples_shown 6445 6839
    count_is current triangles_drawn 1 1
    run "$diptych" bench --model one.obj --size 64x64 --frames 2 --rounds 1
    # A triangle without area is a model of triangles, but none is drawn.
    printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >flat.obj
    run "$diptych" dump --json - --size 64x64 --model flat.obj
    count_is current samples_shown 0 0

    # Textures.
    for size in 1x1 1x4096 4096x1 7x333 333x7 3x1 1x8192; do
        textured $size
    done
    "$make_inputs" picture 8193 1 t8193x1.png
    sed 's/SIZE/8193x1/' square.obj >t8193x1.obj
    printf 'newmtl m\nmap_Kd t8193x1.png\n' >t8193x1.mtl
    run "$diptych" dump --hash --size 8x8 --model t8193x1.obj
    grep -q 't8193x1.png: warning: .* 8193 x 1 pixels, accepted 1..8192' err.txt ||
        fail "a texture that is too large gives no warning"

    # Camera paths with one key: all frames are the same, in both formats.
    run "$diptych" path convert one.pth one.bth
    run "$diptych" path info one.bth
    hashes pth.txt --size 64x48 --model one.obj --path one.pth
    hashes bth.txt --size 64x48 --model one.obj --path one.bth
    same pth.txt bth.txt "a path with one key as .pth and as .bth"
    hashes late.txt --size 64x48 --model one.obj --path one.bth --frames 777:778
    sed 's/^0777/0000/' late.txt >first.txt
    same pth.txt first.txt "the first and the 777th frame of a path with one key"
    run "$diptych" bench --model one.obj --path one.bth --size 64x48 --frames 2 --rounds 1
    printf 'diptych-path 1\nperiod 0.5\n' >zero.pth
    head -c 12 one.bth >zero.bth
    printf '\0\0\0\0' >>zero.bth
    tail -c +17 one.bth | head -c 8 >>zero.bth
    refuse 'zero.pth:2: \[keys\] there are no keys' dump --hash --model one.obj --path zero.pth
    refuse 'zero.bth: \[keys\] at byte 12: 0 keys' dump --hash --model one.obj --path zero.bth
else
    pane 8192x8192
    run "$diptych" dump --hash --timing --size 8192x8192 --category WATER --current aa=none \
        --requested aa=8,af=16,aaf=on,aaa=on,asd=1
    run "$diptych" bench --size 8192x8192 --frames 1 --rounds 1 --sets aa=8,af=16
    run "$diptych" dump --out out --timing --size 8192x8192 --model square.glb --path near.pth
    [ "$(head -c 24 out/requested_0000.png | tail -c 8 | od -An -tx1 | tr -d ' \n')" = 0000200000002000 ] ||
        fail "the PNG file of a pane of 8192x8192 pixels has another size"
    textured 1x1
    textured 8192x8192
    textured 8191x8191

    # 10,008,338 triangles of a flat square show what 2 triangles show.
    "$make_inputs" grid 2237 ten_million.glb || fail "no model"
    hashes two.txt --size 512x512 --model square.glb --path square.pth --requested aa=8
    hashes ten_million.txt --size 512x512 --model ten_million.glb --path square.pth --requested aa=8
    same two.txt ten_million.txt "a square of 2 and of 10 million triangles"
    run "$diptych" bench --grid 10000000 --size 512x512 --frames 1 --rounds 1 --sets aa=4
    refuse "\[--grid\] '20000001' is not a whole number" bench --grid 20000001
fi
finish
