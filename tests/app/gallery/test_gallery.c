// Tests of gallery.h: the list of scenes, cameras that close their loops, the tour, and that each
// scene gives its memory back. Usage: test_gallery ASSETS
#include "app/gallery/gallery.h"
#include "tests/support/allocation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 64 };

static const char *assets;
static const int64_t second_ns = 1000000000;

static void every_scene_is_found_by_its_name(void **state) {
    (void)state;
    int found;
    assert_int_equal(dip_gallery_scene_count(), 12);
    for (int s = 0; s < dip_gallery_scene_count(); s++) {
        const DipGalleryInfo *info = dip_gallery_info(s);
        assert_true(dip_gallery_find(info->name, &found, NULL));
        assert_int_equal(found, s);
        assert_true(info->title[0] && info->text[0] && info->look_count >= 1);
    }
    assert_true(dip_gallery_find("tour", &found, NULL));
    assert_int_equal(found, DIP_GALLERY_TOUR);
}

static void another_name_is_refused_with_the_nearest(void **state) {
    (void)state;
    int found;
    DipError err;
    assert_false(dip_gallery_find("tunel", &found, &err));
    assert_int_equal(err.code, DIP_ERROR_UNKNOWN);
    assert_non_null(strstr(err.message, "did you mean 'tunnel'?"));
    assert_non_null(strstr(err.message, "water|tour"));
}

// Rotates a vector of camera space to world space.
static void rotate(const double q[4], const double v[3], double out[3]) {
    const double t[3] = {2.0 * (q[1] * v[2] - q[2] * v[1]), 2.0 * (q[2] * v[0] - q[0] * v[2]),
                         2.0 * (q[0] * v[1] - q[1] * v[0])};
    out[0] = v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1];
    out[1] = v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2];
    out[2] = v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0];
}

// Each scene is built around the origin, so the camera must look roughly there, with its upper edge
// up. This holds the quaternion to its definition.
static void cameras_look_at_their_scenes_and_close_their_loops(void **state) {
    (void)state;
    for (int s = 0; s < dip_gallery_scene_count(); s++) {
        DipPose begin;
        DipPose end;
        dip_gallery_pose(s, 0, &begin);
        dip_gallery_pose(s, DIP_GALLERY_SECONDS * second_ns - 1, &end);
        for (int i = 0; i < 3; i++) {
            assert_true(fabs(begin.position_world[i] - end.position_world[i]) < 1e-4);
        }
        for (int64_t t = 0; t < DIP_GALLERY_SECONDS; t++) {
            static const double ahead[3] = {0.0, 0.0, -1.0};
            static const double up[3] = {0.0, 1.0, 0.0};
            DipPose pose;
            double looks[3];
            double above[3];
            dip_gallery_pose(s, t * second_ns, &pose);
            rotate(pose.orientation, ahead, looks);
            rotate(pose.orientation, up, above);
            const double *p = pose.position_world;
            const double size = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            const double toward = -(looks[0] * p[0] + looks[1] * p[1] + looks[2] * p[2]) / size;
            assert_true(toward > 0.75 || strcmp(dip_gallery_info(s)->name, "tunnel") == 0);
            assert_true(above[1] > 0.7);
        }
    }
}

static void the_tour_shows_each_scene_for_fifteen_seconds(void **state) {
    (void)state;
    const int count = dip_gallery_scene_count();
    assert_int_equal(dip_gallery_duration_ns(DIP_GALLERY_TOUR), count * 15 * second_ns);
    for (int s = 0; s < count; s++) {
        DipPose own;
        DipPose tour;
        const int64_t time_ns = 15 * s * second_ns;
        assert_int_equal(dip_gallery_scene_at(DIP_GALLERY_TOUR, time_ns), s);
        assert_int_equal(dip_gallery_scene_at(DIP_GALLERY_TOUR, time_ns + 15 * second_ns - 1), s);
        dip_gallery_pose(s, 4 * second_ns, &own);
        dip_gallery_pose(DIP_GALLERY_TOUR, time_ns + 4 * second_ns, &tour);
        assert_memory_equal(&own, &tour, sizeof own);
    }
    assert_int_equal(dip_gallery_scene_at(DIP_GALLERY_TOUR, count * 15 * second_ns), 0);
    assert_int_equal(dip_gallery_scene_at(DIP_GALLERY_TOUR, -1), count - 1);
}

static DipGalleryPane *make_pane(DipGallery *gallery, const char *settings) {
    DipGalleryPaneDef def = {gallery, dip_isa_best(), WIDTH, HEIGHT, dip_quality_default()};
    DipError err;
    assert_true(dip_quality_parse(settings, &def.quality, &err));
    DipGalleryPane *pane = dip_gallery_pane_create(&def, &err);
    if (!pane) {
        fail_msg("%s", err.message);
    }
    return pane;
}

static void draw_at(DipGalleryPane *pane, int scene, int64_t time_ns, DipFrame *frame) {
    DipPose pose;
    DipError err;
    dip_gallery_pose(scene, time_ns, &pose);
    if (!dip_gallery_pane_draw(pane, &pose, time_ns, frame, &err)) {
        fail_msg("%s: %s: %s", err.file, err.key, err.message);
    }
}

// Two panes of different settings and sizes share a gallery. A tour draws what the scene alone
// does, and holds no more memory after a round than before it.
static void the_tour_draws_the_scenes_and_frees_them(void **state) {
    (void)state;
    DipPool *pool = dip_pool_create(1, NULL);
    const DipGalleryDef def = {DIP_GALLERY_TOUR, pool, dip_isa_best(), assets};
    DipError err;
    DipGallery *gallery = dip_gallery_create(&def, &err);
    assert_non_null(gallery);
    DipGalleryPane *panes[2] = {make_pane(gallery, "aa=none"), make_pane(gallery, "aa=4,af=8")};
    int64_t bytes[2] = {0, 0};
    for (int round = 0; round < 3; round++) {
        for (int s = 0; s < dip_gallery_scene_count(); s++) {
            const int64_t time_ns = (15 * s + 5) * second_ns;
            DipFrame frames[2];
            char hashes[2][33];
            for (int p = 0; p < 2; p++) {
                draw_at(panes[p], DIP_GALLERY_TOUR, time_ns, &frames[p]);
                dip_frame_hash(&frames[p], hashes[p]);
            }
            assert_string_not_equal(hashes[0], hashes[1]);
            assert_true(frames[0].counters.fragments_shaded + frames[0].counters.fragments_ordered >
                        WIDTH * HEIGHT / 10);
            // After the first round, the panes' pipelines have grown to their greatest need.
            if (s == 0 && round > 0) {
                bytes[round - 1] = dip_allocation_holdings().bytes;
            }
        }
    }
    assert_int_equal(bytes[0], bytes[1]);
    dip_gallery_pane_destroy(&panes[0]);
    dip_gallery_pane_destroy(&panes[1]);
    dip_gallery_destroy(&gallery);
    dip_pool_destroy(&pool);
}

static void each_scene_gives_all_its_memory_back(void **state) {
    (void)state;
    DipPool *pool = dip_pool_create(1, NULL);
    for (int s = 0; s < dip_gallery_scene_count(); s++) {
        const DipHoldings before = dip_allocation_holdings();
        const DipGalleryDef def = {s, pool, dip_isa_best(), assets};
        DipError err;
        DipFrame frame;
        DipGallery *gallery = dip_gallery_create(&def, &err);
        if (!gallery) {
            fail_msg("%s: %s: %s", dip_gallery_info(s)->name, err.file, err.message);
        }
        DipGalleryPane *pane = make_pane(gallery, "aa=4,af=8,opt=standard");
        for (int look = 0; look < dip_gallery_info(s)->look_count; look++) {
            dip_gallery_set_look(gallery, look);
            draw_at(pane, s, 3 * second_ns, &frame);
        }
        assert_true(dip_gallery_pane_resize(pane, WIDTH / 2, HEIGHT, NULL));
        draw_at(pane, s, 4 * second_ns, &frame);
        assert_int_equal(frame.width, WIDTH / 2);
        dip_gallery_pane_destroy(&pane);
        dip_gallery_destroy(&gallery);
        assert_int_equal(dip_allocation_holdings().blocks, before.blocks);
    }
    dip_pool_destroy(&pool);
}

static void bad_poses_and_settings_are_refused(void **state) {
    (void)state;
    DipPool *pool = dip_pool_create(1, NULL);
    int blend;
    assert_true(dip_gallery_find("blend", &blend, NULL));
    const DipGalleryDef def = {blend, pool, dip_isa_best(), assets};
    DipGallery *gallery = dip_gallery_create(&def, NULL);
    DipGalleryPane *pane = make_pane(gallery, "aa=2");
    DipPose pose;
    DipFrame frame;
    DipError err;
    dip_gallery_pose(blend, 0, &pose);
    pose.position_world[1] = (double)NAN;
    assert_false(dip_gallery_pane_draw(pane, &pose, 0, &frame, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    pose.position_world[1] = 0.0;
    pose.fov_y_deg = 0.0;
    assert_false(dip_gallery_pane_draw(pane, &pose, 0, &frame, &err));
    assert_string_equal(err.key, "fov_y_deg");
    DipQuality quality = dip_quality_default();
    quality.step[DIP_SETTING_AA] = 99;
    assert_false(dip_gallery_pane_set_quality(pane, &quality, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_false(dip_gallery_pane_resize(pane, 0, 10, &err));
    dip_gallery_pane_destroy(&pane);
    dip_gallery_destroy(&gallery);
    dip_pool_destroy(&pool);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_is_found_by_its_name),
        cmocka_unit_test(another_name_is_refused_with_the_nearest),
        cmocka_unit_test(cameras_look_at_their_scenes_and_close_their_loops),
        cmocka_unit_test(the_tour_shows_each_scene_for_fifteen_seconds),
        cmocka_unit_test(the_tour_draws_the_scenes_and_frees_them),
        cmocka_unit_test(each_scene_gives_all_its_memory_back),
        cmocka_unit_test(bad_poses_and_settings_are_refused),
    };
    assets = argc > 1 ? argv[1] : "assets";
    return cmocka_run_group_tests(tests, NULL, NULL);
}
