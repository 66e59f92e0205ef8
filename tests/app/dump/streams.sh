#!/bin/sh
# Tests the streams of `diptych dump` as another program reads them: standard output holds the
# stream and nothing else, a reader that ends early is answered with one line, and ffmpeg decodes
# the streams to the same colours. Usage: streams.sh DIPTYCH
. "$(dirname "$0")/../program.sh"

size_of() {
    wc -c <"$1"
}

small="dump --size 64x48 --current aa=none --requested aa=4,af=16"
frame_bytes=$((3 * 64 * 48))

# --- standard output holds the stream and nothing else
"$diptych" $small --frames 0:6:2 --fps 59.94 --y4m - >both.y4m 2>err.txt
check "a stream to standard output ends well" test $? = 0
header=$(head -n 1 both.y4m)
check "the header has the size of both panes and the rate of every second frame: $header" test \
    "$header" = 'YUV4MPEG2 W128 H48 F2997:100 Ip A1:1 C444 XCOLORRANGE=LIMITED'
check "three frames follow the header, and nothing else" test \
    "$(size_of both.y4m)" = $((${#header} + 1 + 3 * (6 + 2 * frame_bytes)))
for pane in current requested both difference; do
    "$diptych" $small --frames 0:2 --pane $pane --raw - >$pane.rgb 2>$pane.txt
    width=$([ $pane = both ] && echo 128 || echo 64)
    check "raw frames of $pane have 3 bytes per pixel" test "$(size_of $pane.rgb)" = \
        $((2 * 3 * width * 48))
    check "one line tells how to read the raw frames of $pane" grep -qE \
        "^diptych: raw video: -pixel_format rgb24 -video_size ${width}x48 -framerate 30/1 " $pane.txt
done
"$diptych" $small --frames 0:2 --out pictures --y4m file.y4m --raw file.rgb --json r.json 2>err.txt
check "streams to files go with pictures and a record" test $? = 0 -a -s pictures/frames.json
check "both panes are the default" cmp file.rgb both.rgb
if command -v convert >/dev/null; then
    for pane in current requested; do
        for n in 0000 0001; do
            convert "pictures/${pane}_$n.png" -depth 8 "rgb:${pane}_$n.rgb"
        done
        cat ${pane}_0000.rgb ${pane}_0001.rgb >pngs.rgb
        check "raw frames of $pane are the pixels of the PNG files" cmp pngs.rgb $pane.rgb
    done
fi

# --- mistakes
refuse '\[--raw -\] prints to standard output, and so does --y4m -;' \
    $small --y4m - --raw -
refuse '\[--hash\] prints to standard output, and so does --y4m -;' \
    $small --y4m - --hash
refuse "\[--pane\] 'left' is not a picture; give one of current.requested.both.difference" \
    $small --raw - --pane left
expect 1 'none/x.y4m: \[--y4m\] cannot be written: ' "$diptych" $small --y4m none/x.y4m
if command -v script >/dev/null; then
    script -qec "$diptych $small --y4m - ; echo code \$?" /dev/null </dev/null >terminal.txt 2>&1
    check "a terminal gets no video" grep -q 'standard output is a terminal; send it' terminal.txt
    check "a terminal is wrong input" grep -q 'code 2' terminal.txt
fi

# --- readers that end early, and full disks
for kind in y4m raw; do
    { "$diptych" $small --frames 0:300 --$kind - 2>err.txt; echo $? >code.txt; } | head -c 1000 >/dev/null
    check "a closed pipe is exit code 1, found $(cat code.txt)" test "$(cat code.txt)" = 1
    check "a closed pipe is named in one line: $(cat err.txt)" sh -c \
        "[ \$(grep -c 'the program that reads the stream has closed it after [0-9]* frames' err.txt) = 1 ]"
done
if [ -c /dev/full ]; then
    "$diptych" $small --frames 0:3 --y4m - >/dev/full 2>err.txt
    check "a full disk is exit code 1" test $? = 1
    check "a full disk is named" grep -q 'standard output: \[--y4m\] cannot be written: No space' err.txt
fi

# --- ffmpeg
if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
    ffprobe -v error -show_entries stream=pix_fmt,color_range,r_frame_rate,width,height,nb_read_frames \
        -count_frames -of default=nw=1 both.y4m >probe.txt
    for line in pix_fmt=yuv444p color_range=tv r_frame_rate=2997/100 width=128 height=48 nb_read_frames=3; do
        check "ffprobe finds $line" grep -qx "$line" probe.txt
    done
    ffmpeg -v error -i file.y4m -f rawvideo -pix_fmt yuv444p planes.yuv
    tail -c $((2 * (6 + 2 * frame_bytes))) file.y4m >body.bin # The frames without the header.
    { head -c $((6 + 2 * frame_bytes)) body.bin | tail -c $((2 * frame_bytes))
        tail -c $((2 * frame_bytes)) body.bin; } >expected.yuv
    check "ffmpeg reads the planes" cmp planes.yuv expected.yuv
    ffmpeg -v error -i file.y4m -f rawvideo -pix_fmt rgb24 -sws_flags accurate_rnd+full_chroma_int \
        -vf scale=in_color_matrix=bt709:in_range=tv:out_range=pc decoded.rgb
    # Limited range has 219 steps, so a value returns with an error of up to 2.
    check "ffmpeg decodes the colours of BT.709 in limited range" python3 -c "
a, b = open('decoded.rgb', 'rb').read(), open('file.rgb', 'rb').read()
worst = max(abs(x - y) for x, y in zip(a, b))
print(len(a), len(b), worst)
raise SystemExit(len(a) != len(b) or worst > 3)"
    ffmpeg -v error -f rawvideo -pixel_format rgb24 -video_size 128x48 -framerate 30/1 -i file.rgb \
        -f rawvideo -pix_fmt rgb24 again.rgb
    check "ffmpeg reads the raw stream with the options of the note" cmp again.rgb file.rgb
else
    echo "ffmpeg is missing, so nothing is decoded"
fi
finish
