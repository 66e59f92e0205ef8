#!/bin/sh
# Tests camera paths from the cameras of glTF models. Usage: model_cameras.sh DIPTYCH TEST_FOLDER
. "$(dirname "$0")/../program.sh"
here=$2

for seed in 1 2 3; do
    check "the paths are those of the specification, seed $seed" \
        python3 "$here/model_cameras.py" "$diptych" . $seed
done

# says REGEX: the last error output has such a line.
says() {
    check "/$1/ is printed, found: $(cat err.txt)" grep -qE "$1" err.txt
}
"$diptych" dump --model cameras.gltf --path Nope --size 8x8 --hash >out.txt 2>err.txt
check "an unknown name is an error" test $? = 2
says "^diptych: \[--path\] 'Nope' is neither a file nor a camera of the models, accepted a file, \"Flying\", \"Still\", \"Lens\", \"Still 2\", \"Busy/One\", \"Busy/Two\"$"
says 'warning: \[Flat\] the camera is skipped, because it is orthographic, accepted perspective cameras'
says 'warning: \[Wide\] the camera is skipped, because it has no field of view \(yfov\) of 1 to 170 degrees'
says 'warning: \[Tiny\] the camera is skipped, because its transform is too large, flat, or not finite'

# --- the ini, and the field of view that it gives
fov_of() {
    "$diptych" dump "$@" --size 8x8 --json - 2>err.txt | sed -n 's/.*"fov_y_deg":[^0-9]*\([0-9.]*\).*/\1/p'
}
printf 'RES: 8x8\nXFILE: cameras.gltf\nCAMPATH_DEFAULT: Still\nCAMPATH_AA: Lens\nCAMPATH_AA_FOV: 31\n' >cameras.ini
check "the ini's path can be a camera" test "$(fov_of --config cameras.ini | cut -c1-8)" = 68.75493
check "the ini's field of view comes first" test "$(fov_of --config cameras.ini --category AA)" = 31
printf 'RES: 8x8\nXFILE: cameras.gltf\nCAMPATH_DEFAULT: Lens\nCAMPATH_AA: Lens\n' >twice.ini
lens=$(fov_of --config cameras.ini --path Lens)
check "a camera has a field of view of its own, found: $lens" test "$lens" != 60 -a "$lens" != ""
check "the first of two paths can be this camera" test "$(fov_of --config twice.ini)" = "$lens"
check "the second one can be it, too" test "$(fov_of --config twice.ini --category AA)" = "$lens"
hash_of() {
    "$diptych" dump "$@" --size 16x16 --hash 2>err.txt
}
printf 'diptych-path 1\nperiod 1\n0 0 9 0 0 0 1\n' >Still
hash_of --model cameras.gltf --path ./Still >file.txt
hash_of --model cameras.gltf --path Still >name.txt
check "a file comes before a camera of its name" cmp file.txt name.txt
rm Still
hash_of --model cameras.gltf --path Still >name.txt
check "the camera draws something else" sh -c '[ -s name.txt ] && ! cmp -s file.txt name.txt'
"$diptych" bench --model cameras.gltf --path Flying --frames 2 --rounds 1 --size 8x8 --sets aa=none >out.txt 2>err.txt
check "bench flies a camera: $(cat err.txt)" grep -q 'path Flying' out.txt

# --- a file whose cameras cannot be read is drawn without them
sed 's/"interpolation": "[A-Z]*"/"interpolation": "WILD"/' cameras.gltf >bad.gltf
"$diptych" dump --model bad.gltf --size 8x8 --hash >out.txt 2>err.txt
check "a model with a bad animation is drawn: $(cat err.txt)" test -s out.txt
says 'warning: .*the cameras are not read: the interpolation is not known'

# --- the preview lists and plays them, where there is a display to test with
cat >requests.txt <<'END'
{"id":1,"request":"get","what":"paths"}
{"id":2,"request":"path","category":"Busy/Two"}
{"id":3,"request":"get","what":"state"}
{"id":4,"request":"path","category":"Nope"}
{"id":5,"request":"quit"}
END
if command -v xvfb-run >which.txt && command -v timeout >which.txt; then
    env -u WAYLAND_DISPLAY timeout 60 xvfb-run -a -n 200 "$diptych" preview --model cameras.gltf --path Flying \
        --size 64x48 --control - <requests.txt >out.txt 2>err.txt
    check "the preview lists the cameras: $(cat out.txt err.txt)" \
        grep -q '"category":"Lens","title":"Lens","available":true' out.txt
    check "--path's camera is the default path" grep -q '"category":"DEFAULT","title":"Flying"' out.txt
    check "a client chooses a camera" grep -q '"category":"Busy/Two","free_camera":false' out.txt
    check "a name that is no camera is refused" grep -q '"id":4,"ok":false.*Busy/Two' out.txt
fi

finish
