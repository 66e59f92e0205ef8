// Tests of the path that the user makes in the window: edits follow a plain model, a saved file is
// read back with the same poses, and between keys it agrees with an evaluation in long double.
#include "app/preview/state/keys.h"
#include "app/preview/state/pilot.h"
#include "config/config.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { MOST = 60 };

static DipCamPath *path;
static DipCamTrack track;
static DipPreviewState state;
static DipSession session;
static DipPose pose;
static char folder[] = "/tmp/path_editor_XXXXXX";
static char home[4096];

static int set_up(void **unused) {
    (void)unused;
    strcpy(folder, "/tmp/path_editor_XXXXXX");
    assert_non_null(getcwd(home, sizeof home));
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    const DipCamKey keys[3] = {
        {{0, 0, 0}, {0, 0, 0, 1}}, {{1, 1, 0}, {0, 0, 0, 1}}, {{3, 1, 0}, {0, 0, 0, 1}}};
    assert_true(dip_campath_create(keys, 3, INT64_C(250000000), &path, NULL));
    track = dip_camtrack_make(true);
    dip_camtrack_set(&track, DIP_CATEGORY_DEFAULT, path, 60.0);
    const DipQuality quality[2] = {dip_quality_default(), dip_quality_default()};
    state = dip_preview_state_make(quality, &track);
    state.editor = dip_path_editor_create(NULL);
    assert_non_null(state.editor);
    session = (DipSession){.track = track};
    dip_pilot_enter(&state.flight, &session);
    pose = (DipPose){.orientation = {0, 0, 0, 1}, .fov_y_deg = 60};
    srand(7);
    return 0;
}

static int tear_down(void **unused) {
    (void)unused;
    dip_path_editor_destroy(&state.editor);
    dip_campath_destroy(&path);
    for (int i = 1; i <= 9; ++i) {
        char file[32];
        snprintf(file, sizeof file, "path-%04d.pth", i);
        unlink(file);
    }
    assert_int_equal(chdir(home), 0);
    return rmdir(folder);
}

// --- driving -------------------------------------------------------------------------------------

static bool turn(int64_t elapsed_ns) {
    const DipPilotTurn pilot = {.session = &session, .elapsed_ns = elapsed_ns};
    return dip_pilot_turn(&state, &pilot, &pose);
}

static void edit(DipPathEdit what) {
    dip_preview_act(&state, DIP_ACTION_PATH_EDIT, (int)what, false, 0);
}

static double random_share(void) {
    return (double)rand() / RAND_MAX;
}

// Flies the camera to a random pose, by the functions that the mouse uses.
static void wander(void) {
    for (int i = 0; i < 3; ++i) {
        pose.position_world[i] = 200.0 * random_share() - 100.0;
    }
    dip_camera_look(&pose, 720.0 * random_share() - 360.0, 100.0 * random_share() - 50.0);
    const DipCameraKeys roll = {.up = random_share() < 0.5 ? 1 : -1, .turn = true};
    dip_camera_move(&pose, &roll, 1.0, random_share());
}

static DipPose record(void) {
    wander();
    turn(0);
    edit(DIP_PATH_EDIT_ADD);
    return pose;
}

// --- looking -------------------------------------------------------------------------------------

// Asserts that both are the same position and orientation to the bit; q and -q are the same.
static void assert_pose(const DipPose *a, const DipPose *b) {
    const double sign =
        a->orientation[0] * b->orientation[0] + a->orientation[1] * b->orientation[1] +
                    a->orientation[2] * b->orientation[2] + a->orientation[3] * b->orientation[3] <
                0
            ? -1.0
            : 1.0;
    for (int i = 0; i < 3; ++i) {
        assert_true(a->position_world[i] == b->position_world[i]);
    }
    for (int i = 0; i < 4; ++i) {
        assert_true(a->orientation[i] == sign * b->orientation[i]);
    }
}

static DipPose pose_of(const DipCamKey *key) {
    DipPose of = {.fov_y_deg = 60};
    memcpy(of.position_world, key->position_world, sizeof key->position_world);
    memcpy(of.orientation, key->orientation, sizeof key->orientation);
    return of;
}

// Columns of the rotation matrix: the camera's axes in world space.
static void matrix_of(const double q[4], long double m[3][3]) {
    const long double x = q[0], y = q[1], z = q[2], w = q[3];
    const long double rows[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    memcpy(m, rows, sizeof rows);
}

// Turns `from` by a share of the rotation that leads to `to`, about the axis of that rotation
// (Rodrigues' formula). The rotation's angle must lie well between 0 and 180 degrees.
static void turn_towards(const double from[4], const double to[4], long double share,
                         long double m[3][3]) {
    long double a[3][3], b[3][3], between[3][3], partial[3][3];
    matrix_of(from, a);
    matrix_of(to, b);
    for (int i = 0; i < 9; ++i) { // between = b a^T
        const int r = i / 3, c = i % 3;
        between[r][c] = b[r][0] * a[c][0] + b[r][1] * a[c][1] + b[r][2] * a[c][2];
    }
    const long double cosine = (between[0][0] + between[1][1] + between[2][2] - 1) / 2;
    const long double angle = acosl(cosine);
    const long double scale = 1 / (2 * sinl(angle));
    const long double axis[3] = {scale * (between[2][1] - between[1][2]),
                                 scale * (between[0][2] - between[2][0]),
                                 scale * (between[1][0] - between[0][1])};
    const long double s = sinl(share * angle), c = cosl(share * angle);
    for (int i = 0; i < 9; ++i) {
        const int r = i / 3, col = i % 3;
        const long double cross =
            r == col ? 0 : ((col - r + 3) % 3 == 1 ? -1 : 1) * axis[3 - r - col];
        partial[r][col] = (r == col ? c : 0) + (1 - c) * axis[r] * axis[col] + s * cross;
    }
    for (int i = 0; i < 9; ++i) {
        const int r = i / 3, col = i % 3;
        m[r][col] =
            partial[r][0] * a[0][col] + partial[r][1] * a[1][col] + partial[r][2] * a[2][col];
    }
}

// --- the tests -----------------------------------------------------------------------------------

// Random edits do to the editor's keys what plain array operations do to a copy.
static void edits_follow_a_plain_model(void **unused) {
    (void)unused;
    DipPose keys[MOST];
    size_t count = 0, chosen = 0;
    for (int step = 0; step < 3000; ++step) {
        wander();
        turn(0);
        const int what = rand() % 5;
        if (what == 0 && count < MOST) {
            const size_t at = count ? chosen + 1 : 0;
            memmove(keys + at + 1, keys + at, (count - at) * sizeof *keys);
            keys[at] = pose;
            chosen = at;
            ++count;
            edit(DIP_PATH_EDIT_ADD);
        } else if (what == 1 && count > 0) {
            keys[chosen] = pose;
            edit(DIP_PATH_EDIT_REPLACE);
        } else if (what == 2 && count > 0 && rand() % 2) {
            memmove(keys + chosen, keys + chosen + 1, (count - chosen - 1) * sizeof *keys);
            --count;
            chosen = chosen > 0 ? chosen - 1 : 0;
            edit(DIP_PATH_EDIT_DELETE);
        } else if (what >= 3 && count > 0) {
            chosen = (chosen + (what == 3 ? 1 : count - 1)) % count;
            edit(what == 3 ? DIP_PATH_EDIT_NEXT : DIP_PATH_EDIT_BEFORE);
            assert_true(turn(0));
            assert_pose(&pose, &keys[chosen]); // The camera is at the chosen key.
        }
        assert_int_equal(state.editor->count, count);
        assert_int_equal(state.editor->chosen, count ? chosen : 0);
        for (size_t i = 0; i < count; ++i) {
            const DipCamKey key = state.editor->keys[i];
            const DipPose edited = pose_of(&key);
            assert_pose(&edited, &keys[i]);
        }
    }
}

// The saved file has every pose of the camera to the bit.
static void a_saved_path_has_the_recorded_poses(void **unused) {
    (void)unused;
    DipPose recorded[MOST];
    DipCamPath *loaded;
    for (int i = 0; i < MOST; ++i) {
        recorded[i] = record();
    }
    edit(DIP_PATH_EDIT_SLOWER); // 1.5 s
    edit(DIP_PATH_EDIT_SAVE);
    assert_non_null(strstr(state.notice, "path-0001.pth"));
    assert_true(dip_campath_load("path-0001.pth", &loaded, NULL));
    const DipCamPathInfo info = dip_campath_info(loaded);
    assert_int_equal(info.key_count, MOST);
    assert_int_equal(info.period_ns, INT64_C(1500000000));
    for (int i = 0; i < MOST; ++i) {
        DipPose shown = {.fov_y_deg = 60};
        dip_campath_sample(loaded, i * info.period_ns, &shown);
        assert_pose(&shown, &recorded[i]);
    }
    dip_campath_destroy(&loaded);
}

// Between keys, the saved path agrees with rotation matrices and straight lines in long double.
static void a_saved_path_agrees_with_another_evaluation(void **unused) {
    (void)unused;
    DipPose recorded[MOST];
    DipCamPath *loaded;
    for (int i = 0; i < MOST; ++i) {
        recorded[i] = record();
    }
    edit(DIP_PATH_EDIT_SAVE);
    assert_true(dip_campath_load("path-0001.pth", &loaded, NULL));
    for (int i = 0; i < MOST; ++i) {
        const DipPose *from = &recorded[i], *to = &recorded[(i + 1) % MOST];
        double along = 0.0;
        for (int c = 0; c < 4; ++c) {
            along += from->orientation[c] * to->orientation[c];
        }
        if (fabs(along) < 0.1 || fabs(along) > 0.99) {
            continue; // Rodrigues' formula loses digits near 0 and 180 degrees.
        }
        for (int part = 1; part < 8; ++part) {
            const long double share = part / 8.0L;
            long double wanted[3][3], found[3][3];
            DipPose shown = {.fov_y_deg = 60};
            dip_campath_sample(loaded, i * INT64_C(1000000000) + part * INT64_C(125000000), &shown);
            turn_towards(from->orientation, to->orientation, share, wanted);
            matrix_of(shown.orientation, found);
            for (int c = 0; c < 9; ++c) {
                assert_true(fabsl(wanted[c / 3][c % 3] - found[c / 3][c % 3]) < 1e-13L);
            }
            for (int c = 0; c < 3; ++c) {
                const long double straight =
                    from->position_world[c] +
                    share * ((long double)to->position_world[c] - from->position_world[c]);
                assert_true(fabsl(straight - shown.position_world[c]) < 1e-12L);
            }
        }
    }
    dip_campath_destroy(&loaded);
}

static void saving_never_overwrites(void **unused) {
    (void)unused;
    static const char text[] = "someone's file";
    char read[32] = "";
    FILE *file = fopen("path-0001.pth", "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    record();
    assert_true(state.editor->unsaved);
    edit(DIP_PATH_EDIT_SAVE);
    assert_false(state.editor->unsaved);
    assert_string_equal(state.editor->file, "path-0002.pth");
    edit(DIP_PATH_EDIT_SAVE);
    assert_string_equal(state.editor->file, "path-0003.pth");
    file = fopen("path-0001.pth", "r");
    assert_non_null(fgets(read, sizeof read, file));
    fclose(file);
    assert_string_equal(read, text);
}

// Flying shows the poses that the saved file has at the same times, and does at its end what paths
// do. Any movement by the user stops it.
static void flying_shows_the_path_being_edited(void **unused) {
    (void)unused;
    DipCamPath *loaded;
    for (int i = 0; i < 4; ++i) {
        record();
    }
    edit(DIP_PATH_EDIT_SAVE);
    assert_true(dip_campath_load("path-0001.pth", &loaded, NULL));
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; ++end) {
        dip_camtrack_set_end(&track, (DipCamPathEnd)end);
        state.manual = false;
        edit(DIP_PATH_EDIT_FLY); // The last key is the chosen one, so it begins with the first.
        assert_true(state.manual);
        for (int i = 1; i < 100; ++i) {
            DipPose wanted = {.fov_y_deg = 60};
            const int64_t at_ns = i * INT64_C(110000000);
            const bool over = end == DIP_CAMPATH_END_once && at_ns > INT64_C(3100000000);
            dip_campath_sample(loaded, dip_campath_time_at_end(loaded, (DipCamPathEnd)end, at_ns),
                               &wanted);
            assert_true(turn(110000000) != over);
            assert_pose(&pose, &wanted);
        }
        state.flight.drag_right = 0.1;
        assert_true(turn(1000000));
        assert_false((state.editor->fly != NULL));
        assert_false(turn(1000000));
    }
    dip_campath_destroy(&loaded);
}

static void the_path_that_plays_can_be_edited(void **unused) {
    (void)unused;
    DipCamPath *loaded;
    edit(DIP_PATH_EDIT_TAKE);
    assert_int_equal(state.editor->count, 3);
    edit(DIP_PATH_EDIT_NEXT);
    edit(DIP_PATH_EDIT_DELETE);
    edit(DIP_PATH_EDIT_SAVE);
    assert_true(dip_campath_load("path-0001.pth", &loaded, NULL));
    const DipCamPathInfo info = dip_campath_info(loaded);
    assert_int_equal(info.key_count, 2);
    assert_int_equal(info.period_ns, INT64_C(250000000));
    assert_true(dip_campath_key(loaded, 1).position_world[0] == 3.0);
    dip_campath_destroy(&loaded);
}

static void without_keys_nothing_is_saved(void **unused) {
    (void)unused;
    for (int i = 0; i < DIP_PATH_EDIT_COUNT; ++i) {
        if (i != DIP_PATH_EDIT_TAKE) {
            edit((DipPathEdit)i);
        }
    }
    assert_int_equal(state.editor->count, 0); // The camera has had no pose.
    assert_int_not_equal(access("path-0001.pth", F_OK), 0);
    assert_int_equal(track.end, DIP_CAMPATH_END_loop);
}

// Every edit has a key, and a key that is held edits once.
static void keys_reach_every_edit(void **unused) {
    (void)unused;
    DipEvent event = {.kind = DIP_EVENT_KEY_DOWN, .key = (DipKeycode)'n'};
    event.modifiers = DIP_MODIFIER_CTRL;
    wander();
    turn(0);
    assert_true(dip_keys_press(&state, &event, 0));
    event.repeat = true;
    assert_true(dip_keys_press(&state, &event, 0));
    assert_int_equal(state.editor->count, 1);
    event.repeat = false;
    static const int keys[] = {'r',
                               DIP_KEYCODE_LEFT,
                               DIP_KEYCODE_RIGHT,
                               'f',
                               'w',
                               'o',
                               DIP_KEYCODE_UP,
                               DIP_KEYCODE_DOWN,
                               'e',
                               'p',
                               DIP_KEYCODE_DELETE};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i) {
        state.notice[0] = '\0';
        event.key = (DipKeycode)keys[i];
        assert_true(dip_keys_press(&state, &event, 0));
        assert_true(state.notice[0] || state.tools.tab == DIP_TAB_PATH);
    }
    assert_int_equal(state.editor->count, 2); // Those of the path but one.
}

int main(void) {
#define EDITOR_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        EDITOR_TEST(edits_follow_a_plain_model),
        EDITOR_TEST(a_saved_path_has_the_recorded_poses),
        EDITOR_TEST(a_saved_path_agrees_with_another_evaluation),
        EDITOR_TEST(saving_never_overwrites),
        EDITOR_TEST(flying_shows_the_path_being_edited),
        EDITOR_TEST(the_path_that_plays_can_be_edited),
        EDITOR_TEST(without_keys_nothing_is_saved),
        EDITOR_TEST(keys_reach_every_edit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
