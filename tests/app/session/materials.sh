#!/bin/sh
# Tests the MATERIAL_ keys of the ini: an X file that the ini marks draws the same pictures as the
# same scene in a glTF file with tags. Usage: materials.sh DIPTYCH TEST_FOLDER
. "$(dirname "$0")/../program.sh"
here=$2
mkdir scene || exit 1
python3 "$here/materials.py" scene || exit 1

# write_ini NAME MODEL LINE...: writes an ini.
write_ini() {
    name=$1
    printf 'RES: 96x72\nCURRENT: aa=none\nREQUESTED: aa=4,af=16\nXFILE: scene/%s\n' "$2" >"$name"
    shift 2
    for line in "$@"; do
        echo "$line" >>"$name"
    done
}

# draw INI OUTPUT: writes the hashes of three pictures of each pane.
draw() {
    "$diptych" dump --config "$1" --pose '0 1.5 7 0 0 0 1' --frames 0:3 --fps 1 --hash >"$2" 2>err.txt
    check "$1 is drawn without a warning: $(cat err.txt)" test ! -s err.txt
}

lit='MATERIAL_LIGHTMAP: Lit_wall = scene/light.png'
write_ini tags.ini scene.gltf
write_ini marks.ini scene.x "$lit" 'MATERIAL_CLIP: F*c?' 'MATERIAL_GLASS: Glass_?' \
    'MATERIAL_WATER: Pool_?' 'MATERIAL_SKY = *mm*' 'MATERIAL_CLIP: *ence'
write_ini plain.ini scene.x
draw tags.ini tags.txt
draw marks.ini marks.txt
draw plain.ini plain.txt
check "the X file that the ini marks draws what the tags of the glTF file draw" cmp tags.txt marks.txt
check "without marks it draws something else" sh -c '! cmp -s tags.txt plain.txt'

# --- each mark is needed
for key in LIGHTMAP CLIP GLASS WATER SKY; do
    grep -v "MATERIAL_$key" marks.ini >less.ini
    "$diptych" dump --config less.ini --pose '0 1.5 7 0 0 0 1' --hash >less.txt 2>err.txt
    head -2 marks.txt >first.txt
    check "without MATERIAL_$key the picture differs" sh -c '[ -s less.txt ] && ! cmp -s less.txt first.txt'
done

# --- rules outrank the tags of the file, and later rules the earlier ones
write_ini unmarked.ini scene.gltf 'MATERIAL_WATER: *' 'MATERIAL_SOLID: *'
sed 's/"surface": "[a-z]*"/"surface": "solid"/g' scene/scene.gltf >scene/solid.gltf
write_ini solid.ini solid.gltf
draw unmarked.ini unmarked.txt
draw solid.ini solid.txt
check "MATERIAL_SOLID outranks the file and an earlier line" cmp unmarked.txt solid.txt
write_ini own.ini scene.gltf 'MATERIAL_LIGHTMAP: Lit wall'
draw own.ini own.txt
check "without a picture, the light map is the model's" cmp own.txt tags.txt
sed 's/"lightmapped": 1//' scene/scene.gltf >scene/unlit.gltf
write_ini unlit.ini unlit.gltf 'MATERIAL_LIGHTMAP: Lit wall'
draw unlit.ini unlit.txt
check "MATERIAL_LIGHTMAP does what lightmapped does" cmp unlit.txt tags.txt

# --- --model replaces the models, and the marks with them
write_ini wrong.ini scene.x 'MATERIAL_WATER: Pond*'
"$diptych" dump --config wrong.ini --model scene/scene.x --size 8x8 --hash >out.txt 2>err.txt
check "--model ignores the marks: $(cat err.txt)" test ! -s err.txt

# --- mistakes
refuse "^diptych: wrong.ini:5: \[MATERIAL_WATER\] 'Pond\*' fits no material of the models, accepted \"Plain_wall\", \"Lit_wall\", \"Fence\", \"Glass_1\", \"Pool_é\", \"Himmel\"$" dump --config wrong.ini --hash
write_ini lost.ini scene.x 'MATERIAL_LIGHTMAP: Lit_wall = scene/lost.png'
refuse '^diptych: lost.ini:5: \[MATERIAL_LIGHTMAP\] scene/lost.png: ' dump --config lost.ini --hash
write_ini broken.ini scene.x 'MATERIAL_LIGHTMAP: Lit_wall = scene/scene.x'
refuse '^diptych: broken.ini:5: \[MATERIAL_LIGHTMAP\] scene/scene.x: ' dump --config broken.ini --hash
write_ini empty.ini scene.x 'MATERIAL_SKY:'
refuse "\[MATERIAL_SKY\] has no value, accepted a name with \* and \?, up to 32 times" dump --config empty.ini --hash
write_ini many.ini scene.x
for i in $(seq 33); do echo 'MATERIAL_SKY: Himmel' >>many.ini; done
refuse '^diptych: many.ini:37: \[MATERIAL_SKY\] is given more than 32 times, accepted up to 32 names' dump --config many.ini --hash
write_ini dark.ini scene.x 'MATERIAL_LIGHTMAP: Lit_wall'
"$diptych" dump --config dark.ini --size 8x8 --hash >out.txt 2>err.txt
check "a mark without a light map gives a warning: $(cat err.txt)" \
    grep -q 'warning: .*\[Lit_wall\] .*marked as light-mapped, but has no light map' err.txt

finish
