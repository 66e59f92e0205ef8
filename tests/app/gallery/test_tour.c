// Plays the gallery's tour in two panes and watches its memory: whenever a scene comes again, as
// much memory is in use as when it came first; a scene that is closed leaves nothing behind.
//
// Usage: test_tour ASSETS_FOLDER [--seconds N]. With --seconds, the tour plays for that long at the
// speed of the clock, as fast as frames can be drawn. Without it, each scene has two frames, and
// the tour plays twice.
#include "app/gallery/gallery.h"
#include "renderer/base/clock.h"
#include "tests/support/live_blocks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 240, MAX_SCENES = 32, SHORT_FRAMES = 2, SHORT_TOURS = 2, PANES = 2 };

static const int64_t second_ns = 1000000000;
static const char *assets;
static int seconds; // 0: the short form.

typedef struct Show {
    DipPool *pool;
    DipGallery *gallery;
    DipGalleryPane *panes[PANES];
} Show;

static void check(bool succeeded, const DipError *err) {
    if (!succeeded) {
        fail_msg("%s: %s: %s", err->file, err->key, err->message);
    }
}

static void open_show(Show *show, int scene) {
    static const char *const settings[PANES] = {"aa=none", "aa=4,aaa=on,af=16"};
    const DipGalleryDef def = {scene, show->pool, dip_isa_best(), assets};
    DipError err;
    show->gallery = dip_gallery_create(&def, &err);
    check(show->gallery != NULL, &err);
    for (int p = 0; p < PANES; p++) {
        DipGalleryPaneDef pane = {show->gallery, dip_isa_best(), WIDTH, HEIGHT,
                                  dip_quality_default()};
        check(dip_quality_parse(settings[p], &pane.quality, &err), &err);
        show->panes[p] = dip_gallery_pane_create(&pane, &err);
        check(show->panes[p] != NULL, &err);
    }
}

static void close_show(Show *show) {
    for (int p = 0; p < PANES; p++) {
        dip_gallery_pane_destroy(&show->panes[p]);
    }
    dip_gallery_destroy(&show->gallery);
}

static void draw(Show *show, int scene, int64_t time_ns) {
    DipPose pose;
    DipError err;
    dip_gallery_pose(scene, time_ns, &pose);
    for (int p = 0; p < PANES; p++) {
        DipFrame frame;
        check(dip_gallery_pane_draw(show->panes[p], &pose, time_ns, &frame, &err), &err);
        assert_int_equal(frame.rgba8[3], 255);
    }
}

typedef struct Memory {
    int blocks;
    size_t bytes;
} Memory;

static Memory memory_now(void) {
    return (Memory){live_blocks(), live_bytes()};
}

static void a_closed_scene_leaves_nothing_behind(void **state) {
    Show *show = *state;
    for (int s = 0; s < dip_gallery_scene_count(); s++) {
        Memory before = {0};
        for (int round = 0; round < 2; round++) {
            before = memory_now();
            open_show(show, s);
            for (int f = 0; f < SHORT_FRAMES; f++) {
                draw(show, s, f * DIP_GALLERY_SECONDS * second_ns / SHORT_FRAMES);
            }
            close_show(show);
        }
        assert_int_equal(live_blocks(), before.blocks);
        assert_int_equal(live_bytes(), before.bytes);
    }
}

// Notes the memory at a scene's last frame, or compares it with that of the tour before. The first
// tour only warms up: later scenes of a tour may leave larger buffers to the earlier ones.
static void judge(Memory seen[MAX_SCENES], int scene, int tour) {
    const Memory now = memory_now();
    if (seconds) {
        printf("tour %d, after %-8s %7d blocks, %10zu bytes\n", tour, dip_gallery_info(scene)->name,
               now.blocks, now.bytes);
        fflush(stdout);
    }
    if (tour > 1) {
        assert_int_equal(now.blocks, seen[scene].blocks);
        assert_true(now.bytes <= seen[scene].bytes + seen[scene].bytes / 100);
    }
    seen[scene] = now;
}

// Plays at the speed of the clock. A scene's last frame is never at the same time twice, so its
// buffers may differ a little.
static int play_for(Show *show, int64_t length_ns) {
    Memory seen[MAX_SCENES];
    const int64_t begin_ns = dip_clock_ns();
    const int64_t tour_ns = dip_gallery_duration_ns(DIP_GALLERY_TOUR);
    int scene = 0, frames = 0, judged = 0;
    int64_t at_ns = 0;
    while (at_ns < length_ns) {
        draw(show, DIP_GALLERY_TOUR, at_ns);
        frames++;
        at_ns = dip_clock_ns() - begin_ns;
        const int next = dip_gallery_scene_at(DIP_GALLERY_TOUR, at_ns);
        if (next != scene) {
            judge(seen, scene, (int)((at_ns - second_ns) / tour_ns));
            judged++;
        }
        scene = next;
    }
    printf("%d frames of two panes, %d ends of scenes\n", frames, judged);
    return judged;
}

static void play_briefly(Show *show) {
    Memory seen[MAX_SCENES];
    const int frames = dip_gallery_scene_count() * SHORT_FRAMES;
    for (int tour = 0; tour <= SHORT_TOURS; tour++) {
        for (int f = 0; f < frames; f++) {
            draw(show, DIP_GALLERY_TOUR, f * DIP_GALLERY_SECONDS * second_ns / SHORT_FRAMES);
            if ((f + 1) % SHORT_FRAMES == 0) {
                judge(seen, f / SHORT_FRAMES, tour);
            }
        }
    }
}

static void the_tour_needs_no_more_memory_each_time(void **state) {
    Show *show = *state;
    const Memory before = memory_now();
    open_show(show, DIP_GALLERY_TOUR);
    if (seconds) {
        assert_true(play_for(show, seconds * second_ns) > 0);
    } else {
        play_briefly(show);
    }
    close_show(show);
    assert_int_equal(live_blocks(), before.blocks);
    assert_int_equal(live_bytes(), before.bytes);
}

static int set_up(void **state) {
    static Show show;
    show.pool = dip_pool_create(2, NULL);
    *state = &show;
    return show.pool && dip_gallery_scene_count() <= MAX_SCENES ? 0 : -1;
}

static int tear_down(void **state) {
    Show *show = *state;
    dip_pool_destroy(&show->pool);
    return 0;
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_closed_scene_leaves_nothing_behind, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_tour_needs_no_more_memory_each_time, set_up, tear_down),
    };
    assert_true(argc > 1);
    assets = argv[1];
    seconds = argc > 3 && strcmp(argv[2], "--seconds") == 0 ? atoi(argv[3]) : 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
