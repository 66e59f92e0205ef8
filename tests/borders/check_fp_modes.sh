#!/bin/sh
# Fails when a public function of assets/, campaths/ or config/ that may compute with floats has no
# test under other floating-point modes, or does not exist any more.
#
# Usage: check_fp_modes.sh ROOT
set -eu
cd "$1"
tests="tests/assets/test_fp_modes.c renderer/catalogue/rows/numbers.c"

# These functions compute with no float: they only create, copy, count, compare or free.
without_floats='
    dip_animated_model_def dip_animated_model_destroy dip_animated_model_find
    dip_animated_pose_destroy
    dip_camtrack_path_time dip_camtrack_restart dip_camtrack_set_end dip_camtrack_time
    dip_campath_destroy dip_campath_span_ns dip_campath_time_at_end
    dip_config_file_fault dip_config_free dip_config_key_name dip_config_same_file
    dip_model_cameras_destroy dip_model_destroy dip_model_times
    dip_name_list_add dip_name_list_end
    dip_picture_copy dip_picture_enlarge dip_picture_free dip_picture_from_bgra dip_picture_level
    dip_picture_levels dip_picture_with_opacity
    dip_scene_pack_free dip_scene_pack_note dip_scene_pack_read_note'

# Declarations, not mentions in comments.
functions=$(sed 's|//.*||' assets/animation.h assets/cameras.h assets/importer.h assets/model.h \
    assets/picture.h assets/pack/scene_pack.h campaths/campath.h campaths/camtrack.h config/config.h |
    grep -oE '\bdip_[a-z0-9_]+\(' | tr -d '(' | sort -u)
if test "$(echo "$functions" | wc -l)" -lt 50; then
    echo "only $(echo "$functions" | wc -l) functions found; have the headers moved?"
    exit 1
fi
failed=0
for function in $functions; do
    case " $(echo $without_floats) " in
    *" $function "*) continue ;;
    esac
    if ! grep -q "\b$function(" $tests; then
        echo "$function is not called in another floating-point mode by $tests"
        failed=1
    fi
done
for function in $without_floats; do
    if ! echo "$functions" | grep -qx "$function"; then
        echo "$function is listed here, but no header declares it"
        failed=1
    fi
done
exit $failed
