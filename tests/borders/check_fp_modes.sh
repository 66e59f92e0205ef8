#!/bin/sh
# Fails when a public function that may compute with floats has no test under other floating-point
# modes (tests/support/fp_walk.h), or does not exist any more.
#
# Usage: check_fp_modes.sh ROOT
set -eu
cd "$1"
tests="renderer/catalogue/rows/numbers.c tests/assets/test_fp_modes.c
    tests/app/measure/test_measure_fp_modes.c tests/app/measure/test_timing_fp_modes.c
    tests/renderer/pipeline/test_pipeline_fp_modes.c tests/renderer/post/test_post_fp_modes.c
    tests/renderer/scene/test_scene_fp_modes.c tests/renderer/shapes/test_shapes_fp_modes.c"

# These functions compute with no float: they only create, copy, count, compare whole numbers or
# free.
without_floats='
    dip_animated_model_def dip_animated_model_destroy dip_animated_model_find
    dip_animated_pose_destroy
    dip_camtrack_path_time dip_camtrack_playing dip_camtrack_restart dip_camtrack_set_end
    dip_camtrack_time
    dip_campath_destroy dip_campath_span_ns dip_campath_time_at_end
    dip_config_file_fault dip_config_free dip_config_key_name dip_config_same_file
    dip_model_cameras_destroy dip_model_destroy dip_model_times
    dip_name_list_add dip_name_list_end
    dip_picture_copy dip_picture_enlarge dip_picture_free dip_picture_from_bgra dip_picture_level
    dip_picture_levels dip_picture_with_opacity
    dip_scene_pack_free dip_scene_pack_note dip_scene_pack_read_note

    dip_bench_sample_set dip_bench_sample_time
    dip_child_confine dip_child_thread_count
    dip_driver_drop_round dip_driver_progress
    dip_estimate_unknown dip_flicker_restart dip_flip_tail_restart
    dip_meter_begin_burst dip_meter_set_standard
    dip_picture_block dip_picture_block_count dip_picture_block_with_margin dip_picture_part
    dip_processors_confine dip_processors_sort
    dip_random_below dip_random_next dip_random_shuffle dip_rounds_deal
    dip_thread_watch_close dip_thread_watch_count dip_thread_watch_open
    dip_thread_watch_open_process dip_thread_watch_read
    dip_truth_default_folder dip_truth_standard

    dip_assert_failed dip_clock_ns dip_error_code_name dip_error_list_add
    dip_file_open_code dip_file_read dip_integer_parse
    dip_isa_available dip_isa_name dip_isa_parse dip_lines_alloc dip_lines_free
    dip_nearest_likely dip_nearest_name dip_pages_alloc dip_pool_thread_count
    dip_srgb_code
    dip_utf8_mend dip_utf8_read dip_utf8_valid_bytes dip_utf8_write dip_version

    dip_bc1_choice dip_depth_copy dip_depth_height dip_depth_sample_count dip_depth_width
    dip_mesh_bytes dip_mesh_triangle_count dip_pattern_kind dip_pipeline_record_tiles
    dip_root_codes_read dip_sample_groups_exist dip_sample_groups_make dip_sample_index
    dip_sample_pattern dip_sample_pattern_of dip_sample_room
    dip_samples_format dip_samples_height dip_samples_sample_count dip_samples_width
    dip_stencil_row dip_texture_alpha_bytes dip_texture_colour_bytes

    dip_history_bytes dip_post_bytes dip_post_name dip_post_parse

    dip_lighting_fixed dip_mip_debug_colour dip_mip_debug_levels dip_motion_copy dip_motion_free
    dip_quality_alternates dip_quality_bias_lod8 dip_quality_check dip_quality_compresses
    dip_quality_count_changes dip_quality_covers_by_alpha dip_quality_drawn_size
    dip_quality_effective dip_quality_equal dip_quality_format dip_quality_format_changes
    dip_quality_groups_bias_lod8 dip_quality_groups_shade_all dip_quality_has_history
    dip_quality_max_anisotropy dip_quality_mirrored dip_quality_needs dip_quality_sample_count
    dip_quality_samples_per_group dip_quality_shadow_size dip_quality_upscales
    dip_reference_set_frame_index
    dip_renderer_copy_shading dip_renderer_cut dip_renderer_quality dip_renderer_record_tiles
    dip_scene_has_shadows dip_scene_texture_bytes dip_scene_times dip_scene_triangle_count
    dip_setting_step_at dip_track_value_count'

# These functions compute with floats, but no mode can change what they give.
# dip_counters_add: sums of whole numbers, which are exact.
# dip_error_set, dip_error_set_runtime: texts for people. A mode may change the last digit of a
# number in them.
# dip_fp_mode_*: they set the modes.
# dip_pool_run: it sets the mode in which the tasks run.
in_any_mode='
    dip_counters_add dip_error_set dip_error_set_runtime
    dip_fp_mode_leave dip_fp_mode_load dip_fp_mode_restore dip_fp_mode_set
    dip_pool_run'

headers="assets/animation.h assets/cameras.h assets/importer.h assets/model.h assets/picture.h
    assets/pack/scene_pack.h campaths/campath.h campaths/camtrack.h config/config.h
    $(ls app/measure/metrics/*.h app/measure/stats/*.h app/measure/timing/*.h renderer/base/*.h \
        renderer/pipeline/*.h renderer/post/*.h renderer/reference/*.h renderer/scene/*.h \
        renderer/shapes/*.h | grep -v '_private\.h$')"
# Declarations, not mentions in comments.
functions=$(sed 's|//.*||' $headers | grep -oE '\bdip_[a-z0-9_]+\(' | tr -d '(' | sort -u)
if test "$(echo "$functions" | wc -l)" -lt 350; then
    echo "only $(echo "$functions" | wc -l) functions found; have the headers moved?"
    exit 1
fi
# Functions that the tests call, not those that their comments mention.
called=$(sed 's|//.*||' $tests | grep -oE '\bdip_[a-z0-9_]+\(' | tr -d '(' | sort -u)
failed=0
listed=" $(echo $without_floats $in_any_mode) "
for function in $functions; do
    case "$listed" in
    *" $function "*) continue ;;
    esac
    if ! echo "$called" | grep -qx "$function"; then
        echo "$function is not called in another floating-point mode by" $tests
        failed=1
    fi
done
for function in $listed; do
    if ! echo "$functions" | grep -qx "$function"; then
        echo "$function is listed here, but no header declares it"
        failed=1
    fi
done
exit $failed
