#!/bin/sh
# Tests --pose, --fov and --path-end, and the texts of the PNG files, which hold the pose.
# Usage: cameras.sh DIPTYCH SOURCE_FOLDER
. "$(dirname "$0")/../program.sh"
source=$2

small="dump --size 48x36 --current aa=none --requested aa=2"

# --- a pose read from a record, and from the text of a PNG file, draws the same picture
cat >texts.py <<'END'
# Prints the value of a keyword in a PNG file, after checking every chunk.
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x89PNG\r\n\x1a\n"
at, texts, kinds = 8, {}, []
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + size]
    assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body)
    kinds.append(kind)
    if kind == b"tEXt":
        keyword, text = body.split(b"\0", 1)
        texts[keyword.decode("latin-1")] = text.decode("latin-1")
    if kind == b"iTXt":
        keyword, rest = body.split(b"\0", 1)
        assert rest[:4] == b"\0\0\0\0"
        texts[keyword.decode("latin-1")] = rest[4:].decode("utf-8")
    at += 12 + size
assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND"
assert max(i for i, k in enumerate(kinds) if k[1:] in (b"EXt", b"TXt")) < kinds.index(b"IDAT")
print(texts[sys.argv[2]])
END
text_of() {
    python3 texts.py "$1" "$2"
}
"$diptych" $small --frames 7:8 --category AA --out made --hash >hashes.txt 2>err.txt
picture=made/requested_0007.png
pose=$(text_of $picture Pose)
fov=$(text_of $picture 'Field of view')
check "the PNG has the record's pose" python3 -c "
import json
frame = json.load(open('made/frames.json'))['frames'][0]['pose']
found = [float(x) for x in '''$pose'''.split()]
raise SystemExit(found != frame['position'] + frame['orientation'] or float('$fov') != frame['fov_y_deg'])"
check "the PNG has the hash that is printed" test \
    "$(text_of $picture 'Requested hash')" = "$(sed -n '2s/.* //p' hashes.txt)"
check "the PNG has the program's version" test \
    "$(text_of $picture Software)" = "$("$diptych" --version | sed 's/d/D/')"
check "the PNG has the settings" sh -c "case '$(text_of $picture 'Requested settings')' in aa=2,*) ;; *) exit 1 ;; esac"
check "the PNG has the size" test "$(text_of $picture 'Requested size')" = 48x36
check "the PNG has the path" test "$(text_of $picture Path)" = AA
check "the PNG has the scene" sh -c "case '$(text_of $picture Scene)' in *court.gltf) ;; *) exit 1 ;; esac"
check "the PNG has the time of frame 7 at 30 per second" sh -c \
    "case '$(text_of $picture Time)' in 0.23333333*' s') ;; *) exit 1 ;; esac"
check "the current pane's PNG has its own settings" sh -c \
    "case '$(text_of made/current_0007.png 'Current settings')' in aa=none,*) ;; *) exit 1 ;; esac"
"$diptych" $small --frames 7:8 --pose "$pose" --fov "$fov" --hash >again.txt 2>err.txt
check "the pose of the PNG draws the same pictures: $(cat err.txt)" cmp hashes.txt again.txt
"$diptych" $small --frames 7:8 --pose "$pose" --fov 20 --hash >narrow.txt 2>err.txt
check "another field of view draws another picture" sh -c '! cmp -s hashes.txt narrow.txt'
if cp "$source/tests/assets/data/square.gltf" 'Quadrat ä.gltf' 2>check.txt; then
    cp "$source"/tests/assets/data/* . 2>check.txt
    "$diptych" $small --model 'Quadrat ä.gltf' --out model >out.txt 2>err.txt
    check "a name beyond ASCII is UTF-8 in the PNG" test \
        "$(text_of model/current_0000.png Scene)" = 'Quadrat ä.gltf'
fi

# --- the field of view of every kind of camera
fov_of() {
    "$diptych" $small "$@" --json - 2>err.txt | sed -n 's/.*"fov_y_deg":[^0-9]*\([0-9.]*\).*/\1/p'
}
check "--fov replaces the ini's" test "$(fov_of --fov 33.5)" = 33.5
check "--fov replaces that of a category" test "$(fov_of --category AAA --fov 170)" = 170
check "--fov goes with a path" test "$(fov_of --path "$source/campaths/af.pth" --fov 1)" = 1
check "--fov goes with an orbit" test "$(fov_of --model "$source/tests/assets/data/square.gltf" --fov 12)" = 12
check "--fov goes with a scene of the gallery" test "$(fov_of --scene blend --fov 71)" = 71
check "--pose goes with a scene of the gallery" test "$(fov_of --scene blend --pose '0 0 9 0 0 0 1')" = 55
check "without --fov the ini decides" test "$(fov_of --category AAA)" = 45

# --- mistakes
refuse "\[--fov\] '0' is not an angle from 1 to 170 degrees" $small --hash --fov 0
refuse "\[--fov\] '171' is not an angle" $small --hash --fov 171
refuse "\[--fov\] 'wide' is not an angle" $small --hash --fov wide
refuse "\[--pose\] '1 2 3' is not a pose: seven numbers x y z qx qy qz qw in quotes" $small --hash --pose '1 2 3'
refuse "\[--pose\] '1 2 3 0 0 0 1 0' is not a pose" $small --hash --pose '1 2 3 0 0 0 1 0'
refuse "\[--pose\] '1 2 nan 0 0 0 1' is not a pose" $small --hash --pose '1 2 nan 0 0 0 1'
refuse "\[--pose\] '1 2 3 0 0 0 x' is not a pose" $small --hash --pose '1 2 3 0 0 0 x'
refuse "\[--pose\] qx qy qz qw: the quaternion has length 0" $small --hash --pose '1 2 3 0 0 0 0'
refuse "\[--pose\] x: 1e\+10 is out of range" $small --hash --pose '1e10 2 3 0 0 0 1'
refuse "\[--pose\] says where the camera stands, but --path lets it fly" $small --hash \
    --pose '0 0 0 0 0 0 1' --path x.pth
refuse "\[--pose\] says where the camera stands, but --category" $small --hash \
    --pose '0 0 0 0 0 0 1' --category AA
refuse "\[--path-end\] 'stop' is not the end of a path; give one of loop.once.back" $small --hash \
    --path-end stop
refuse "\[--grid\] a grid replaces the scene and its path; leave out --grid or --pose" bench \
    --grid 9 --pose '0 0 0 0 0 0 1'

# --- the end of a path: the camera's x at whole seconds
printf 'diptych-path 1\nperiod 1\n0 1 2 0 0 0 1\n10 1 2 0 0 0 1\n20 1 2 0 0 0 1\n' >three.pth
square="--model $source/tests/assets/data/square.gltf" # It loads quickly.
places() {
    "$diptych" dump --size 8x8 $square --path three.pth --fps "$1" --frames 0:9 --path-end "$2" --json r.json 2>err.txt
    python3 -c "
import json
print(*['%g' % f['pose']['position'][0] for f in json.load(open('r.json'))['frames']])"
}
check "a loop returns to the first key" test "$(places 1 loop)" = "0 10 20 0 10 20 0 10 20"
check "once stops at the last key" test "$(places 1 once)" = "0 10 20 20 20 20 20 20 20"
check "back returns the way it came" test "$(places 1 back)" = "0 10 20 10 0 10 20 10 0"
check "between the keys, too" test "$(places 2 back)" = "0 5 10 15 20 15 10 5 0"
check "the loop flies the step from the last key to the first" test "$(places 2 loop)" = "0 5 10 15 20 10 0 5 10"
for end in loop once back; do
    "$diptych" bench --frames 2 --rounds 1 --size 8x8 --sets aa=none $square --path three.pth --path-end $end \
        --fov 40 >out.txt 2>err.txt
    check "bench takes --path-end $end and --fov: $(cat err.txt)" grep -q 'median' out.txt
done
"$diptych" bench --frames 2 --rounds 1 --size 8x8 --sets aa=none $square --pose '0 1.7 6 0 0 0 1' >out.txt 2>err.txt
check "bench takes --pose and says so" grep -q ', one pose$' out.txt

finish
