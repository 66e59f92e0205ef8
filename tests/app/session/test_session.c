// Tests of session.h: what a session loads, that it reports every fault, and that neither a failed
// nor a closed session keeps memory. Usage: test_session SOURCE_FOLDER
#include "app/session/session.h"
#include "tests/support/allocation.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static int64_t live_blocks(void) {
    return dip_allocation_holdings().blocks;
}

// --- sessions for tests --------------------------------------------------------------------------

static const char *source; // The folder of the sources.
static char model[512];    // A square with a texture.
static char path[512];
static char shipped[512]; // The ini of the courtyard.

// Writes the shipped ini to a temporary file, with absolute file names. `line` replaces the lines
// of `key`.
static void write_ini(char file[64], const char *key, const char *line) {
    char text[512];
    snprintf(file, 64, "/tmp/test_session.%d.ini", (int)getpid());
    FILE *in = fopen(shipped, "r");
    FILE *out = fopen(file, "w");
    assert_non_null(in);
    assert_non_null(out);
    while (fgets(text, sizeof text, in)) {
        char *relative = strstr(text, "../");
        if (key && strncmp(text, key, strlen(key)) == 0 && text[strlen(key)] == ':') {
            fprintf(out, "%s\n", line);
        } else if (relative && text[0] != '#' && text[0] != ';') {
            fprintf(out, "%.*s%s/%s", (int)(relative - text), text, source, relative + 3);
        } else {
            fputs(text, out);
        }
    }
    fclose(in);
    fclose(out);
}

static DipSessionOptions small_options(void) {
    return (DipSessionOptions){.config = shipped,
                               .models = {model},
                               .model_count = 1,
                               .has_size = true,
                               .size = {32, 24},
                               .has_threads = true,
                               .threads = 2};
}

// Opens a session that must fail. Checks that the session is empty and keeps no memory. Returns the
// faults; the caller frees them.
static DipErrorList open_badly(const DipSessionOptions *options) {
    const DipSessionDef def = {.options = options, .scene = true, .renderers = true};
    DipErrorList faults = {0};
    DipSession session;
    const int64_t before = live_blocks();
    assert_false(dip_session_open(&session, &def, &faults));
    assert_null(session.pool);
    assert_null(session.scene);
    assert_null(session.model);
    assert_null(session.paths);
    assert_null(session.renderers[0]);
    assert_null(session.renderers[1]);
    assert_true(faults.error_count > 0);
    assert_int_equal(live_blocks(), before + 1); // The one block is the list of faults.
    return faults;
}

// Returns whether one of the faults has this code and key, and names this file.
static bool has_fault(const DipErrorList *faults, DipErrorCode code, const char *key,
                      const char *file) {
    for (size_t i = 0; i < faults->count; i++) {
        const DipError *fault = &faults->items[i];
        if (fault->code == code && strcmp(fault->key, key) == 0 &&
            (strstr(fault->file, file) || strstr(fault->message, file))) {
            return true;
        }
    }
    return false;
}

// --- tests ---------------------------------------------------------------------------------------

static void session_loads_what_its_def_asks_for(void **state) {
    (void)state;
    const DipSessionOptions options = small_options();
    const int64_t before = live_blocks();
    for (int what = 0; what < 4; what++) {
        const DipSessionDef def = {
            .options = &options, .scene = what > 0, .renderers = what > 1, .keep_model = what > 2};
        DipErrorList faults = {0};
        DipSession session;
        assert_true(dip_session_open(&session, &def, &faults));
        dip_error_list_free(&faults);
        assert_non_null(session.pool);
        assert_int_equal(session.pane_size.width, 32);
        assert_int_equal(session.scene != NULL, what > 0);
        assert_int_equal(session.orbiting, what > 0);
        assert_int_equal(session.renderers[1] != NULL, what > 1);
        assert_int_equal(session.model != NULL, what > 2);
        assert_string_equal(dip_session_scene_file(&session), model);
        dip_session_close(&session);
        assert_null(session.pool);
        assert_int_equal(live_blocks(), before);
    }
}

static void model_can_be_loaded_later(void **state) {
    (void)state;
    const DipSessionOptions options = small_options();
    const DipSessionDef def = {.options = &options, .scene = true};
    const int64_t before = live_blocks();
    DipErrorList faults = {0};
    DipSession session;
    DipError err;
    assert_true(dip_session_open(&session, &def, &faults));
    dip_error_list_free(&faults);
    assert_null(session.model);
    assert_true(dip_session_keep_model(&session, &err));
    assert_non_null(session.model);
    assert_true(session.scene_def.object_count > 0);
    const DipModel *kept = session.model;
    assert_true(dip_session_keep_model(&session, &err));
    assert_ptr_equal(session.model, kept);
    dip_session_close(&session);
    assert_int_equal(live_blocks(), before);
}

static void session_draws_both_panes(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.has_current = options.has_requested = true;
    options.current = options.requested = dip_quality_default();
    for (int same = 0; same < 2; same++) {
        const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
        DipErrorList faults = {0};
        DipSession session;
        DipSessionFrame frame;
        DipPose pose;
        DipError err;
        options.requested.step[DIP_SETTING_AA] = same ? 0 : 2;
        assert_true(dip_session_open(&session, &def, &faults));
        dip_error_list_free(&faults);
        assert_true(dip_session_draw(&session, 0, 0, &pose, &frame, &err));
        assert_int_equal(frame.copied, same);
        assert_int_equal(frame.panes[0].width, 32);
        assert_int_equal(frame.panes[1].height, 24);
        assert_int_equal(frame.panes[0].rgba8 == frame.panes[1].rgba8, same);
        assert_true(session.times.total_ms > 0.0 || def.begin_ns == 0);
        dip_session_close(&session);
    }
}

// Panes that share shading draw the same pictures, and take turns at copying.
static void panes_that_share_shading_take_turns(void **state) {
    (void)state;
    enum { FRAMES = 8 };
    DipSessionOptions options = small_options();
    options.has_current = options.has_requested = true;
    options.current = options.requested = dip_quality_default();
    options.requested.step[DIP_SETTING_AA] = 2;
    const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
    DipErrorList faults = {0};
    DipSession session;
    assert_true(dip_session_open(&session, &def, &faults));
    dip_error_list_free(&faults);
    char alone[DIP_PANE_COUNT][33];
    int copying[DIP_PANE_COUNT] = {0};
    for (int i = 0; i <= FRAMES; i++) {
        DipSessionFrame frame;
        DipPose pose;
        session.shares_shading = i > 0;
        assert_true(dip_session_draw(&session, 0, 0, &pose, &frame, NULL));
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            char hash[33];
            dip_frame_hash(&frame.panes[p], hash);
            if (i == 0) {
                memcpy(alone[p], hash, sizeof hash);
            }
            assert_string_equal(hash, alone[p]);
            copying[p] += frame.panes[p].counters.fragments_copied > 0;
        }
        assert_int_equal(copying[0] + copying[1], i);
    }
    assert_int_equal(copying[0], FRAMES / 2);
    dip_session_close(&session);
}

// The ini's pictures of mip levels show again after a round through the gallery.
static void models_come_back_as_they_were(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.has_current = true;
    assert_true(dip_quality_parse("mipdebug=on", &options.current, NULL));
    char ini[64], lines[2048] = "MIPDEBUG: true";
    for (int size = 8; size <= 512; size *= 2) {
        const size_t length = strlen(lines);
        snprintf(lines + length, sizeof lines - length, "\nMIPDEBUG%d: %s/docs/images/guide_8.png",
                 size, source);
    }
    write_ini(ini, "MIPDEBUG", lines);
    options.config = ini;
    const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
    DipErrorList faults = {0};
    DipSession session;
    char hashes[2][33];
    assert_true(dip_session_open(&session, &def, &faults));
    dip_error_list_free(&faults);
    for (int back = 0; back < 2; back++) {
        DipSessionFrame frame;
        DipPose pose;
        assert_true(dip_session_draw(&session, 0, 0, &pose, &frame, NULL));
        dip_frame_hash(&frame.panes[0], hashes[back]);
        // Nine scenes on are the quads, which read no file; four more are the models.
        for (int step = 9; step >= 4 && !back; step -= 5) {
            DipError err;
            if (!dip_session_step_scene(&session, step, &err)) {
                fail_msg("%s: %s", err.file, err.message);
            }
            assert_int_equal(session.shows_gallery, step == 9);
        }
    }
    assert_string_equal(hashes[0], hashes[1]);
    dip_session_close(&session);
    assert_int_equal(remove(ini), 0);
}

static void missing_ini_is_a_fault(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.config = "none.ini";
    DipErrorList faults = open_badly(&options);
    assert_int_equal(faults.count, 1);
    assert_string_equal(faults.items[0].file, "none.ini");
    assert_int_equal(faults.items[0].origin, DIP_ORIGIN_INPUT);
    dip_error_list_free(&faults);
}

static void faults_of_scene_and_path_are_both_told(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.models[0] = "none.glb";
    options.path = "none.pth";
    DipErrorList faults = open_badly(&options);
    assert_int_equal(faults.error_count, 2);
    assert_true(has_fault(&faults, DIP_ERROR_MISSING, "", "none.glb"));
    assert_true(has_fault(&faults, DIP_ERROR_MISSING, "", "none.pth"));
    dip_error_list_free(&faults);
}

static void good_scene_is_freed_when_the_path_is_bad(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.path = model;
    DipErrorList faults = open_badly(&options);
    assert_int_equal(faults.error_count, 1);
    dip_error_list_free(&faults);
}

static void good_path_is_freed_when_the_scene_is_bad(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.models[0] = path;
    options.path = path;
    DipErrorList faults = open_badly(&options);
    assert_int_equal(faults.error_count, 1);
    dip_error_list_free(&faults);
}

static void faults_of_files_name_their_line_in_the_ini(void **state) {
    (void)state;
    static const struct {
        const char *key;
        const char *line;
        DipErrorCode code;
    } cases[] = {
        {"XFILE", "XFILE: none.glb", DIP_ERROR_MISSING},
        {"CAMPATH_AA", "CAMPATH_AA: none.pth", DIP_ERROR_MISSING},
        {"LOG", "LOG: none/x.log", DIP_ERROR_IO},
        {"RES", "RES: 640", DIP_ERROR_TYPE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char ini[64];
        const bool adds = strcmp(cases[i].key, "LOG") == 0;
        DipSessionOptions options = small_options();
        options.config = ini;
        options.model_count = 0;
        write_ini(ini, cases[i].key, cases[i].line);
        if (adds) {
            FILE *out = fopen(ini, "a");
            assert_non_null(out);
            fprintf(out, "%s\n", cases[i].line);
            fclose(out);
        }
        DipErrorList faults = open_badly(&options);
        bool placed = false;
        for (size_t f = 0; f < faults.count; f++) {
            const DipError *fault = &faults.items[f];
            placed |= fault->code == cases[i].code && strcmp(fault->key, cases[i].key) == 0 &&
                      strcmp(fault->file, ini) == 0 && fault->line > 0;
        }
        assert_true(placed);
        dip_error_list_free(&faults);
        remove(ini);
    }
}

static void unknown_category_is_a_fault(void **state) {
    (void)state;
    DipSessionOptions options = small_options();
    options.model_count = 0;
    options.category = "SKY";
    DipErrorList faults = open_badly(&options);
    assert_int_equal(faults.error_count, 1);
    assert_true(has_fault(&faults, DIP_ERROR_UNKNOWN, "--category", "DEFAULT|AA"));
    dip_error_list_free(&faults);
}

static void closing_twice_is_harmless(void **state) {
    (void)state;
    const DipSessionOptions options = small_options();
    const DipSessionDef def = {.options = &options, .scene = true, .renderers = true};
    DipErrorList faults = {0};
    DipSession session;
    assert_true(dip_session_open(&session, &def, &faults));
    dip_error_list_free(&faults);
    dip_session_close(&session);
    dip_session_close(&session);
}

// The lights of the ini are for the ini's models. --shading is for those of --model, too.
static void lights_and_shading_reach_the_scene(void **state) {
    (void)state;
    static const char lights[] = "NEAR: 0.1\nLIGHT: point at=1,2,3 strength=4\n"
                                 "LIGHT: directional to=0,-1,0\nAMBIENT: 255,0,0\n"
                                 "SHADING: gouraud\n";
    char ini[64];
    write_ini(ini, "NEAR", lights);
    for (int what = 0; what < 4; what++) {
        DipSessionOptions options = small_options();
        options.config = ini;
        options.model_count = what % 2;
        options.has_shading = what >= 2;
        options.shading = DIP_MODEL_SHADING_phong;
        const DipSessionDef def = {.options = &options, .scene = true, .keep_model = true};
        DipErrorList faults = {0};
        DipSession session;
        assert_true(dip_session_open(&session, &def, &faults));
        dip_error_list_free(&faults);
        const DipLightingDef *lighting = session.scene_def.lighting;
        assert_int_equal(lighting == NULL, what == 1);
        if (lighting) {
            assert_int_equal(lighting->shading, what ? DIP_SHADING_PHONG : DIP_SHADING_GOURAUD);
        }
        if (what % 2 == 0) {
            assert_int_equal(lighting->light_count, 2);
            assert_true(lighting->lights[0].colour_lin[0] == 4.0f);
            assert_true(lighting->ambient_lin[0] == 1.0f && lighting->ambient_lin[1] == 0.0f);
        }
        dip_session_close(&session);
    }
    remove(ini);
}

// Opens a session that may have warnings, but no errors.
static void open_model(DipSession *session, const DipSessionOptions *options,
                       DipErrorList *faults) {
    const DipSessionDef def = {.options = options, .scene = true};
    assert_true(dip_session_open(session, &def, faults));
    assert_int_equal(faults->error_count, 0);
}

// The session's list is the caller's list of warnings, from the call on.
static void warnings_of_loading_are_kept_in_order(void **state) {
    (void)state;
    const int64_t before = live_blocks();
    char ini[64], losses[600];
    snprintf(losses, sizeof losses, "%s/tests/assets/data/gltf/losses.gltf", source);
    write_ini(ini, "NEAR", "NEAR: 0.1\nNEAR: 0.2\nNEAR: 0.3");
    DipSessionOptions options = small_options();
    options.config = ini;
    options.models[0] = losses;
    DipError earlier = {.severity = DIP_SEVERITY_WARNING, .message = "of another session"};
    DipErrorList faults = {0};
    DipSession session;
    dip_error_list_add(&faults, &earlier);
    open_model(&session, &options, &faults);
    assert_int_equal(session.warnings.count, 2 + 13); // Of the ini and of the model.
    assert_int_equal(session.warnings_left_out, 0);
    assert_int_equal(faults.count, 1 + session.warnings.count);
    assert_memory_equal(session.warnings.items, faults.items + 1,
                        session.warnings.count * sizeof *faults.items);
    assert_string_equal(session.warnings.items[0].key, "NEAR");
    assert_true(session.warnings.items[0].line > 0);
    assert_non_null(strstr(session.warnings.items[2].file, "losses.gltf"));
    dip_error_list_free(&faults);
    dip_session_close(&session);
    assert_int_equal(live_blocks(), before);
    options.models[0] = model;
    open_model(&session, &options, &faults);
    assert_int_equal(session.warnings.count, 2); // None of the session before.
    dip_error_list_free(&faults);
    dip_session_close(&session);
    remove(ini);
}

// Writes an OBJ file whose materials name pictures that are missing, and a file of its materials.
static void write_without_pictures(const char *obj, const char *mtl, int materials) {
    FILE *out = fopen(obj, "w");
    FILE *list = fopen(mtl, "w");
    assert_true(out && list);
    fprintf(out, "mtllib %s\no made\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n", strrchr(mtl, '/') + 1);
    for (int i = 0; i < materials; i++) {
        fprintf(out, "usemtl m%d\nf 1/1 2/1 3/1\n", i);
        fprintf(list, "newmtl m%d\nmap_Kd none%d.png\n", i, i);
    }
    fclose(out);
    fclose(list);
}

// A model may give any number of warnings. Those that are not kept are counted.
static void warnings_beyond_the_limit_are_counted(void **state) {
    (void)state;
    static const int materials[] = {DIP_SESSION_MAX_WARNINGS, DIP_SESSION_MAX_WARNINGS + 44};
    for (int i = 0; i < 2; i++) {
        char obj[64], mtl[64];
        snprintf(obj, sizeof obj, "/tmp/test_session.%d.obj", (int)getpid());
        snprintf(mtl, sizeof mtl, "/tmp/test_session.%d.mtl", (int)getpid());
        write_without_pictures(obj, mtl, materials[i]);
        DipSessionOptions options = small_options();
        options.models[0] = obj;
        DipErrorList faults = {0};
        DipSession session;
        open_model(&session, &options, &faults);
        assert_int_equal(faults.count, materials[i]);
        assert_int_equal(session.warnings.count, DIP_SESSION_MAX_WARNINGS);
        assert_int_equal(session.warnings_left_out, materials[i] - DIP_SESSION_MAX_WARNINGS);
        dip_error_list_free(&faults);
        dip_session_close(&session);
        remove(obj);
        remove(mtl);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(session_loads_what_its_def_asks_for),
        cmocka_unit_test(lights_and_shading_reach_the_scene),
        cmocka_unit_test(model_can_be_loaded_later),
        cmocka_unit_test(warnings_of_loading_are_kept_in_order),
        cmocka_unit_test(warnings_beyond_the_limit_are_counted),
        cmocka_unit_test(session_draws_both_panes),
        cmocka_unit_test(panes_that_share_shading_take_turns),
        cmocka_unit_test(models_come_back_as_they_were),
        cmocka_unit_test(missing_ini_is_a_fault),
        cmocka_unit_test(faults_of_scene_and_path_are_both_told),
        cmocka_unit_test(good_scene_is_freed_when_the_path_is_bad),
        cmocka_unit_test(good_path_is_freed_when_the_scene_is_bad),
        cmocka_unit_test(faults_of_files_name_their_line_in_the_ini),
        cmocka_unit_test(unknown_category_is_a_fault),
        cmocka_unit_test(closing_twice_is_harmless),
    };
    source = argc > 1 ? argv[1] : ".";
    snprintf(model, sizeof model, "%s/tests/assets/data/square.gltf", source);
    snprintf(path, sizeof path, "%s/campaths/aa.pth", source);
    snprintf(shipped, sizeof shipped, "%s/config/courtyard.ini", source);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
