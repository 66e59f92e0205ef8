// Plays the courtyard in the preview for an hour, at an accelerated clock on a fake display.
//
// The run repeats one script: 600 s of playback, after which all camera paths and the clouds are
// where they began. The script changes settings, paths, display sizes, sheets and the free camera.
// Each turn of the preview advances the playback by 250 ms. So the run draws 2400 pictures per
// repetition, and some more while the free camera flies and time stands still.
//
// At regular turns, the test draws the panes' pictures again and compares them with those of the
// same turn of the first repetition, and with those at a time that is a random number of periods
// later, up to centuries. It also looks at every pixel's alpha, and compares small pictures with
// the reference renderer, whose pixels must be finite. At the end of each repetition, memory must
// be what it was at the end of the second one. Errors of the panes are not measured during the run.
//
// Usage: test_long_run SOURCE_FOLDER [--hour]. Without --hour, the clouds are faster, so that a
// repetition takes 120 s of playback; there are three.
#include "tests/app/display/fake_display.h"
#include "app/preview/loop/loop.h"
#include "renderer/base/srgb.h"
#include "renderer/reference/reference.h"
#include "tests/support/live_blocks.h"
#include "renderer/catalogue/random.h"

#include <malloc.h>
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

enum {
    CHECK_TURNS = 10,         // turns from one check to the next
    REFERENCE_CHECKS = 6,     // checks from one comparison with the reference to the next
    MAX_CHECKS = 300,         // checks of one repetition
    REFERENCE_PIXELS = 10000, // the reference draws panes of at most this many pixels
};

static const int64_t second_ns = 1000000000;
// Growth of memory from the end of the second repetition on. A late picture may still need a
// character of the font that no earlier one needed, which takes a block. The numbers of bytes vary,
// because the C library rounds sizes in two ways, and keeps freed memory, depending on the order in
// which threads free blocks.
static const int max_block_growth = 16;
static const size_t max_byte_growth = 1 << 20;
static const size_t max_resident_growth = 32 << 20;
static const double max_reference_rms = 0.02; // of light; the pictures differ by about 0.002

static const char *source; // The folder of the sources.
static bool hour;

typedef struct Run {
    DipSession session;
    DipReference *reference;
    DipDisplay display;
    DipFakeDisplay *fake;
    DipPreview *preview;
    DipErrorList faults;
    char ini[64];
    int period_s;
    int repetitions;
    char hashes[MAX_CHECKS][DIP_PANE_COUNT][33]; // of the first repetition
    int checks;
    int reference_checks;
    int far_checks;
    double worst_rms;
} Run;

static Run run;

// --- the fixture -------------------------------------------------------------------------------

// Writes a copy of the shipped ini with absolute file names. In the short form, clouds move 2.5 and
// -5 texture widths per minute.
static void write_ini(const char *file) {
    char text[1024];
    snprintf(text, sizeof text, "%s/config/courtyard.ini", source);
    FILE *in = fopen(text, "r");
    FILE *out = fopen(file, "w");
    assert_non_null(in);
    assert_non_null(out);
    while (fgets(text, sizeof text, in)) {
        char *relative = strstr(text, "../");
        if (!hour && strncmp(text, "SKY_LAYER1_SPEED", 16) == 0) {
            fputs("SKY_LAYER1_SPEED: 2.5\n", out);
        } else if (!hour && strncmp(text, "SKY_LAYER2_SPEED", 16) == 0) {
            fputs("SKY_LAYER2_SPEED: -5\n", out);
        } else if (relative && text[0] != ';') {
            fprintf(out, "%.*s%s/%s", (int)(relative - text), text, source, relative + 3);
        } else {
            fputs(text, out);
        }
    }
    fclose(in);
    fclose(out);
}

static int set_up(void **state) {
    static DipSessionOptions options;
    (void)state;
    run.period_s = hour ? 600 : 120;
    run.repetitions = hour ? 6 : 3;
    snprintf(run.ini, sizeof run.ini, "/tmp/test_long_run.%d.ini", (int)getpid());
    write_ini(run.ini);
    options = (DipSessionOptions){.config = run.ini, .has_threads = true, .threads = 2};
    const DipSessionDef def = {
        .options = &options, .scene = true, .renderers = true, .keep_model = true};
    assert_true(dip_session_open(&run.session, &def, &run.faults));
    run.reference = dip_reference_create(&run.session.scene_def, NULL);
    run.fake = dip_fake_display_open(&run.display, 402, 150);
    const DipPreviewDef preview = {
        .session = &run.session, .display = run.display, .load_scene_def = dip_session_keep_model};
    run.preview = dip_preview_create(&preview, NULL);
    assert_true(run.reference && run.fake && run.preview);
    dip_reference_set_reflection(run.reference, &run.session.reflection);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_preview_destroy(&run.preview);
    run.display.close(run.display.context);
    dip_reference_destroy(&run.reference);
    dip_session_close(&run.session);
    dip_error_list_free(&run.faults);
    unlink(run.ini);
    return 0;
}

// --- the script --------------------------------------------------------------------------------

// Runs a turn that advances the playback by 250 ms, unless it is paused.
static void turn(void) {
    DipError err = {0};
    dip_fake_display_advance(run.fake, second_ns);
    if (!dip_preview_turn(run.preview, &err)) {
        fail_msg("%s", err.message);
    }
}

static void push(DipKeycode key) {
    dip_fake_display_press(run.fake, key, 0);
}

static void hold(DipKeycode key, bool down) {
    const DipEvent event = {
        .kind = down ? DIP_EVENT_KEY_DOWN : DIP_EVENT_KEY_UP, .key = key, .position = key};
    dip_fake_display_push(run.fake, &event);
}

// The keys of the settings, but for those that are changed with Ctrl.
static const char setting_keys[DIP_SETTING_COUNT] = {
    [DIP_SETTING_AA] = 'x',      [DIP_SETTING_TAA] = 't',    [DIP_SETTING_AAA] = 'v',
    [DIP_SETTING_ASD] = 'b',     [DIP_SETTING_AF] = 'f',     [DIP_SETTING_AAF] = 'g',
    [DIP_SETTING_OPT] = 'o',     [DIP_SETTING_MIPLOD] = 'l', [DIP_SETTING_GI] = 'i',
    [DIP_SETTING_MIPDEBUG] = 'm'};

// Presses keys until a pane has its default settings. A setting may have to wait for another one
// that conflicts with it.
static void reset_settings(int pane) {
    const DipPreviewState *state = dip_preview_state(run.preview);
    const DipQuality wanted = dip_quality_default();
    for (int presses = 0; !state->edited[pane] || state->edited[1 - pane]; presses++) {
        assert_true(presses < DIP_PANE_COUNT + 1);
        push('`');
        turn();
    }
    for (int presses = 0; memcmp(&state->quality[pane], &wanted, sizeof wanted) != 0; presses++) {
        int s = 0;
        while (state->quality[pane].step[s] == wanted.step[s]) {
            s++;
        }
        assert_true(presses < 100);
        push((DipKeycode)setting_keys[s]);
        turn();
    }
}

// Brings everything that the script changes to the state in which each repetition begins. Time
// stands still meanwhile.
static void begin_repetition(void) {
    push(DIP_KEYCODE_SPACE);
    turn();
    assert_true(dip_preview_state(run.preview)->paused);
    reset_settings(DIP_PANE_CURRENT);
    reset_settings(DIP_PANE_REQUESTED);
    assert_true(dip_fake_display_resize(run.fake, 402, 150));
    push('1'); // A change of path returns the new path to its beginning.
    push('0');
    turn();
    push(DIP_KEYCODE_SPACE);
}

// Does what the script says before a turn of a repetition. The script depends on nothing but the
// turn's number.
static void follow_script(int number) {
    static const int sizes[][2] = {{402, 150}, {202, 100}, {1, 1},    {642, 240}, {130, 333},
                                   {3, 2},     {98, 75},   {322, 64}, {962, 360}};
    Random random = {(uint64_t)number * 77777 + 1};
    for (int i = 0; i < 3; i++) {
        random_u64(&random);
    }
    if (number % 7 == 3) {
        const int s = random_int(&random, 0, DIP_SETTING_COUNT - 1);
        if (setting_keys[s]) {
            push((DipKeycode)setting_keys[s]);
        }
    }
    if (number % 31 == 5) {
        push('`');
    }
    if (number % 40 == 20) {
        push((DipKeycode)('0' + random_int(&random, 0, 9)));
    }
    if (number % 60 == 30) {
        const int *size = sizes[number / 60 % 9];
        assert_true(dip_fake_display_resize(run.fake, size[0], size[1]));
    }
    static const DipKeycode sheets[] = {'r', 'u', DIP_KEYCODE_F1, DIP_KEYCODE_F11};
    if (number % 50 == 10 || number % 50 == 14) { // opens and closes a sheet
        push(sheets[number / 50 % 4]);
    }
    if (number % 120 == 100) { // flies away for a moment
        push('c');
        hold('w', true);
    } else if (number % 120 == 104) {
        hold('w', false);
        push('c');
    }
}

// --- checks ------------------------------------------------------------------------------------

// Draws the panes' pictures as the preview shows them, `later_ns` later.
static void draw_panes(int number, int64_t later_ns, DipSessionFrame *frame) {
    const DipPreviewState *state = dip_preview_state(run.preview);
    DipError err = {0};
    DipPose pose;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipQuality drawn = dip_painter_quality(run.session.renderers[p]);
        assert_memory_equal(&drawn, &state->quality[p], sizeof drawn);
    }
    if (!dip_session_draw(&run.session, state->play_ns + later_ns, (uint64_t)number, &pose, frame,
                          &err)) {
        fail_msg("%s", err.message);
    }
}

static void check_alpha(const DipFrame *frame) {
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            assert_int_equal(frame->rgba8[(size_t)y * frame->stride_bytes + 4 * (size_t)x + 3],
                             255);
        }
    }
}

// Compares a pane with the reference, all of whose pixels must be finite.
static void check_reference(int number, int pane, const DipFrame *frame) {
    static double expected[3 * REFERENCE_PIXELS];
    const DipPreviewState *state = dip_preview_state(run.preview);
    DipSrgbDecodeTable table;
    DipPose pose;
    double squares = 0.0;
    dip_srgb_decode_table(&table);
    dip_camtrack_pose(&run.session.track, state->play_ns, &pose);
    dip_reference_set_time(run.reference, state->play_ns);
    dip_reference_set_frame_index(run.reference, (uint64_t)number);
    assert_true(dip_reference_draw(run.reference, &state->quality[pane], &pose, frame->width,
                                   frame->height, expected, NULL));
    const int count = 3 * frame->width * frame->height;
    for (int i = 0; i < count; i++) {
        const int pixel = i / 3;
        const uint8_t *row = frame->rgba8 + (size_t)(pixel / frame->width) * frame->stride_bytes;
        const double found = table.linear[row[4 * (pixel % frame->width) + i % 3]];
        assert_true(isfinite(expected[i]));
        squares += (found - expected[i]) * (found - expected[i]);
    }
    // A pane of a few pixels has no statistics.
    const double rms = count > 1000 ? sqrt(squares / count) : 0.0;
    run.worst_rms = fmax(run.worst_rms, rms);
    run.reference_checks++;
    if (!(rms <= max_reference_rms)) {
        fail_msg("turn %d: RMS %g", number, rms);
    }
}

static void check_pictures(int repetition, int number) {
    const int check = number / CHECK_TURNS;
    assert_true(check < MAX_CHECKS);
    const int64_t period_ns = run.period_s * second_ns;
    DipSessionFrame frame;
    char found[DIP_PANE_COUNT][33];
    draw_panes(number, 0, &frame);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_frame_hash(&frame.panes[p], found[p]);
        check_alpha(&frame.panes[p]);
        if (repetition == 0) {
            memcpy(run.hashes[check][p], found[p], sizeof found[p]);
        } else if (strcmp(found[p], run.hashes[check][p]) != 0) {
            fail_msg("repetition %d, turn %d: the %s pane differs from the first repetition",
                     repetition, number, dip_pane_names[p]);
        }
        const bool small = frame.panes[p].width * frame.panes[p].height <= REFERENCE_PIXELS;
        if (small && repetition == 1 && check % REFERENCE_CHECKS == 1) {
            check_reference(number, p, &frame.panes[p]);
        }
    }
    run.checks++;
    Random random = {(uint64_t)(repetition * 100000 + number + 1)};
    const int64_t most = (INT64_MAX - dip_preview_state(run.preview)->play_ns) / period_ns;
    const int64_t later = (int64_t)(random_u64(&random) % (uint64_t)most);
    if (check % 3 == 0) {
        draw_panes(number, later * period_ns, &frame);
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            char far[33];
            dip_frame_hash(&frame.panes[p], far);
            if (strcmp(found[p], far) != 0) {
                fail_msg("turn %d: the %s pane differs %lld periods later", number,
                         dip_pane_names[p], (long long)later);
            }
        }
        run.far_checks++;
    }
}

// --- memory ------------------------------------------------------------------------------------

typedef struct Memory {
    int blocks;      // blocks that Diptych's libraries have allocated and not freed
    size_t bytes;    // bytes that the process has allocated and not freed
    size_t resident; // bytes of physical memory
} Memory;

static Memory memory_now(void) {
    unsigned long pages = 0;
    unsigned long resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%lu %lu", &pages, &resident), 2);
    fclose(file);
    const struct mallinfo2 info = mallinfo2();
    return (Memory){.blocks = live_blocks(),
                    .bytes = info.uordblks + info.hblkhd,
                    .resident = resident * (size_t)sysconf(_SC_PAGESIZE)};
}

static void an_hour_of_playback_repeats_itself_in_flat_memory(void **state) {
    (void)state;
    Memory warm = {0};
    for (int r = 0; r < run.repetitions; r++) {
        begin_repetition();
        const DipPreviewState *preview = dip_preview_state(run.preview);
        const int64_t end_ns = preview->play_ns + run.period_s * second_ns;
        for (int i = 0; preview->play_ns < end_ns; i++) {
            follow_script(i);
            turn();
            if (i % CHECK_TURNS == 0 && !preview->manual) {
                check_pictures(r, i);
            }
        }
        assert_true(preview->play_ns == end_ns);
        const Memory now = memory_now();
        printf("repetition %d: %d blocks, %zu bytes allocated, %.1f MiB resident\n", r, now.blocks,
               now.bytes, (double)now.resident / 1048576.0);
        fflush(stdout);
        warm = r <= 1 ? now : warm;
        assert_true(now.blocks <= warm.blocks + max_block_growth);
        assert_true(now.bytes <= warm.bytes + max_byte_growth);
        assert_true(now.resident <= warm.resident + max_resident_growth);
    }
    printf("%d pictures, %d checks, %d of them centuries later, %d against the reference (RMS at "
           "most %.4f)\n",
           dip_fake_display_present_count(run.fake), run.checks, run.far_checks,
           run.reference_checks, run.worst_rms);
    assert_true(run.reference_checks > 0);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_hour_of_playback_repeats_itself_in_flat_memory)};
    assert_true(argc > 1);
    source = argv[1];
    hour = argc > 2 && strcmp(argv[2], "--hour") == 0;
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
