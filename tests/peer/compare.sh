#!/bin/sh
# Measures Diptych beside every peer that it finds, on all scenes, and prints one table.
#
# Usage: compare.sh [OPTION]...
#   --results FILE   keep the results here (build/peers.tsv); what the file has is not measured again
#   --scenes LIST    courtyard,forest,city,million,atrium,large,tiny,grid=N (all, with grids of 1000,
#                    10000, 100000 and 1000000 triangles)
#   --sizes LIST     sizes of the picture (640x480,1920x1080)
#   --rows LIST      settings (none,af16,4x)
#   --peers LIST     system-gl,system-vulkan,newest-gl,newest-vulkan (all that are installed)
#   --frames N       frames along the camera path (6)
#   --rounds N       how often each frame is measured (5)
#   --threads N      threads of each side (2)
#   --isa NAME       Diptych's instruction set (the best of this processor)
#   --newest DIR     the folder that newest.sh has made (build/newest-sid)
#   --build DIR      the build (build/release)
#   --table          only print the table of the results
#
# "system" is the Mesa of this machine, "newest" the Mesa in newest.sh's folder; "gl" is llvmpipe,
# "vulkan" is lavapipe. Each run of dip_peer draws every frame with Diptych and with the peer in turn,
# so a ratio compares times that were taken side by side. Progress and the time left go to standard
# error.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
results=$root/build/peers.tsv
scenes=courtyard,forest,city,million,atrium,large,tiny,grid=1000,grid=10000,grid=100000,grid=1000000
sizes=640x480,1920x1080
rows=none,af16,4x
peers=system-gl,system-vulkan,newest-gl,newest-vulkan
frames=6
rounds=5
threads=2
isa=
newest=$root/build/newest-sid
build=$root/build/release
only_table=
while [ $# -gt 0 ]; do
    case $1 in
    --table) only_table=yes && shift && continue ;;
    --help) sed -n '2,/^set -eu/s/^# \{0,1\}//p' "$0" && exit 0 ;;
    --results | --scenes | --sizes | --rows | --peers | --frames | --rounds | --threads | --isa | \
        --newest | --build)
        if [ $# -lt 2 ]; then
            echo "compare.sh: the value of $1 is missing" >&2
            exit 2
        fi
        eval "${1#--}=\$2"
        shift 2
        ;;
    *) echo "compare.sh: no option is called $1; --help lists the options" >&2 && exit 2 ;;
    esac
done
dip_peer=$build/tests/peer/dip_peer

# Runs dip_peer beside a peer.
run_peer() { # PEER ARGUMENT...
    api=${1#*-}
    case $1 in
    newest-*) shift && "$here/newest.sh" --folder "$newest" "$dip_peer" --api "$api" "$@" ;;
    *) shift && "$dip_peer" --api "$api" "$@" ;;
    esac
}

# Prints the peers of the list that are installed here.
find_peers() {
    for peer in $(echo "$peers" | tr , ' '); do
        case $peer in
        newest-*)
            if [ ! -d "$newest/root" ]; then
                echo "compare.sh: without $peer: $newest does not exist; newest.sh makes it" >&2
                continue
            fi
            ;;
        esac
        if run_peer "$peer" --scene large --size 32x32 --check >"$scratch" 2>&1; then
            echo "$peer"
        else
            echo "compare.sh: without $peer: $(tail -n 1 "$scratch")" >&2
        fi
    done
}

# Prints the arguments that choose a scene.
scene_arguments() { # SCENE
    case $1 in
    courtyard) ;;
    forest | city | million | atrium)
        echo "--model $root/build/scenes/$1.glb --path $root/build/scenes/$1.pth"
        ;;
    *) echo "--scene $1" ;;
    esac
}

write_scenes() {
    for scene in $(echo "$scenes" | tr , ' '); do
        case $scene in
        forest | city | million | atrium)
            test -f "$root/build/scenes/$scene.pth" ||
                python3 "$here/scenes.py" "$root/build/scenes" "$scene"
            ;;
        esac
    done
}

# Prints the work that is left, a line for each run of dip_peer: pixels, peer, scene, size, rows.
list_work() {
    for size in $(echo "$sizes" | tr , ' '); do
        for scene in $(echo "$scenes" | tr , ' '); do
            for peer in $found; do
                left=
                for row in $(echo "$rows" | tr , ' '); do
                    grep -q "^$peer:$scene	.*	$size	$row	" "$results" || left=$left,$row
                done
                if [ -n "$left" ]; then
                    echo "$((${size%x*} * ${size#*x} + 300000)) $peer $scene $size ${left#,}"
                fi
            done
        done
    done
}

measure() {
    found=$(find_peers)
    write_scenes
    list_work >"$scratch.work"
    total=$(awk '{ sum += $1 } END { printf "%d", sum }' "$scratch.work")
    begin=$(date +%s)
    finished=0
    # The file descriptor 3 keeps standard input free for the programs.
    while read -r pixels peer scene size left <&3; do
        seconds=$(($(date +%s) - begin))
        estimate=
        if [ "$finished" -gt 0 ]; then
            estimate=", about $(((total - finished) * seconds / finished / 60 + 1)) min left"
        fi
        echo "compare.sh: $((100 * finished / total)) %: $scene $size, $peer$estimate" >&2
        # The arguments of a scene are several words.
        # shellcheck disable=SC2046
        run_peer "$peer" $(scene_arguments "$scene") --size "$size" --rows "$left" \
            --frames "$frames" --rounds "$rounds" --threads "$threads" ${isa:+--isa "$isa"} \
            --append "$peer:$scene,$results" >"$scratch" 2>&1 ||
            echo "compare.sh: $scene $size, $peer: $(tail -n 1 "$scratch")" >&2
        finished=$((finished + pixels))
    done 3<"$scratch.work"
}

# Prints the table: for each scene, size and setting the strongest peer, the one that comes nearest to
# Diptych's speed or lies ahead of it.
print_table() {
    awk -F '\t' '
    {
        split($1, name, ":")
        peer = name[1]
        cell = sprintf("%-13s %-10s %-5s", name[2], $4, $5)
        if (!(cell in least)) {
            cells[++cell_count] = cell
        }
        if (!(peer in version)) {
            peers[++peer_count] = peer
        }
        version[peer] = $12
        ratio[cell, peer] = $8
        if (!(cell in least) || $8 < least[cell]) {
            least[cell] = $8
            text[cell] = sprintf("%-13s %9.2f %9.2f %7.2f  %6.2f to %-6.2f %6.1f", peer, $6, $7,
                $8, $9, $10, $11)
        }
        made["Diptych at commit " $13 ", " $14 ", " $15 " threads each, " $16] = 1
    }
    END {
        for (m in made) {
            print m
        }
        for (p = 1; p <= peer_count; p++) {
            printf "%-13s %s\n", peers[p], version[peers[p]]
        }
        print "\nThe ratio is the time of the strongest peer over that of Diptych; the last columns have"
        print "the ratios of all peers."
        printf "\n%-30s %-13s %9s %9s %7s  %-16s %6s", "scene, size, settings", "strongest",
            "peer ms", "ours ms", "ratio", "95 % interval", "PSNR"
        for (p = 1; p <= peer_count; p++) {
            printf " %13s", peers[p]
        }
        print ""
        for (c = 1; c <= cell_count; c++) {
            cell = cells[c]
            printf "%s %s", cell, text[cell]
            for (p = 1; p <= peer_count; p++) {
                if ((cell, peers[p]) in ratio) {
                    printf " %13.2f", ratio[cell, peers[p]]
                    logs[p] += log(ratio[cell, peers[p]])
                    counts[p]++
                } else {
                    printf " %13s", "-"
                }
            }
            print ""
            log_sum += log(least[cell])
            behind += least[cell] < 1
        }
        if (cell_count) {
            printf "%-30s %-13s %9s %9s %7.2f  %-16s %6s", "geometric mean", "", "", "",
                exp(log_sum / cell_count), "", ""
            for (p = 1; p <= peer_count; p++) {
                printf " %13.2f", exp(logs[p] / counts[p])
            }
            printf "\nDiptych is behind the strongest peer in %d of %d rows.\n", behind, cell_count
        }
    }' "$results"
}

mkdir -p "$(dirname "$results")"
touch "$results"
scratch=$(mktemp)
trap 'rm -f "$scratch" "$scratch.work"' EXIT
if [ -z "$only_table" ]; then
    measure
fi
print_table
