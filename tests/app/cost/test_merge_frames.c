// Tests of the frames that the parts of a report keep, and of the pictures that the merged report
// has from them. Frames are made by a formula, so that the same pictures can be made without files.
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/cost/merge/merge_frames.h"
#include "app/report/page/report_pictures.h"
#include "app/files/folder.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define FOLDER "test_merge_frames.d"

// Larger than a crop, so that the crop has to be found.
enum { WIDTH = 260, HEIGHT = 190, VIEWPOINTS = 3, MIDDLE = 1 };

static uint8_t pixels[WIDTH * HEIGHT * 4];

// Draws a row (or the truth: quality NULL) at a viewpoint. Rows differ from the truth in a square
// whose position depends on the viewpoint.
static void draw(int path, int viewpoint, const DipQuality *quality, uint8_t *rgba8) {
    const int error =
        quality ? 20 + 11 * quality->step[DIP_SETTING_AA] + 5 * quality->step[DIP_SETTING_AF] : 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const bool inside = abs(x - 190 - 15 * viewpoint) < 40 && abs(y - 155 + 20 * path) < 30;
        rgba8[4 * i] = (uint8_t)(x / 2 + (inside ? error : 0));
        rgba8[4 * i + 1] = (uint8_t)(y + 3 * viewpoint);
        rgba8[4 * i + 2] = (uint8_t)((x + y) / 8 % 2 ? 90 : 40 + 10 * path);
        rgba8[4 * i + 3] = 255;
    }
}

static void make_report(DipCostReport *report) {
    dip_made_report(report, 3);
    report->width = WIDTH;
    report->height = HEIGHT;
    report->advice_count = 0;
    dip_cost_kept_frames_free(&report->kept);
    for (uint8_t af = 1; af <= 2; af++) {
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_AF] = af;
        dip_made_combination(report, &quality, 2.0 * af, 0.1 / af);
    }
    assert_true(dip_cost_estimate_times(report, NULL));
}

// --- expected pictures ---------------------------------------------------------------------------

// A source that draws. The context is the report.
static void choose_middle(void *context, DipCostPictureSet *set) {
    (void)context;
    set->viewpoint = MIDDLE;
}

static bool read_drawn(void *context, const DipCostPictureSet *set, int row, uint8_t *rgba8,
                       DipError *err) {
    const DipCostReport *report = context;
    (void)err;
    draw(set->path, set->viewpoint, row < 0 ? NULL : &report->rows[row].quality, rgba8);
    return true;
}

static void make_expected(DipCostPictures *pictures, DipCostReport *report) {
    const DipCostFrameSource source = {report, choose_middle, read_drawn};
    assert_true(dip_cost_pictures_make(pictures, report, &source, NULL));
}

// --- parts ---------------------------------------------------------------------------------------

static void keep(DipCostReport *report, const char *folder, int path, const DipQuality *quality) {
    DipCostKeptFrame *frame = &report->kept.list[report->kept.count++];
    *frame = (DipCostKeptFrame){.path = path, .is_truth = !quality};
    if (quality) {
        frame->quality = *quality;
    }
    draw(path, report->kept.viewpoint, quality, pixels);
    assert_true(dip_cost_kept_frame_write(frame, folder, pixels, WIDTH, HEIGHT, NULL));
}

static const char *part_name(int viewpoint, char name[64]) {
    snprintf(name, 64, FOLDER "/part%d", viewpoint);
    return name;
}

static const char *part_file(int viewpoint, char name[64]) {
    snprintf(name, 64, FOLDER "/part%d/cost.json", viewpoint);
    return name;
}

// Writes a part that keeps the frames of one viewpoint.
static void write_part(int viewpoint) {
    DipCostReport report;
    char folder[64], frames[96], file[64];
    make_report(&report);
    part_name(viewpoint, folder);
    snprintf(frames, sizeof frames, "%s/frames", folder);
    assert_true(dip_folder_make(frames, "--out", NULL));
    report.kept.list =
        calloc((size_t)(report.path_count + report.row_count), sizeof *report.kept.list);
    assert_non_null(report.kept.list);
    report.kept.viewpoint = viewpoint;
    for (int path = 0; path < report.path_count; path++) {
        keep(&report, folder, path, NULL);
    }
    for (int row = 0; row < report.row_count; row++) {
        keep(&report, folder, report.rows[row].path, &report.rows[row].quality);
    }
    assert_true(dip_cost_write_json(&report, part_file(viewpoint, file), NULL));
    dip_cost_report_free(&report);
}

static int write_parts(void **state) {
    (void)state;
    for (int v = 0; v < VIEWPOINTS; v++) {
        write_part(v);
    }
    return 0;
}

static int remove_parts(void **state) {
    (void)state;
    return system("rm -rf " FOLDER);
}

static void add_part(DipCostMergeFrames *frames, int viewpoint) {
    DipCostReport part;
    DipError err = {0};
    char file[64];
    part_file(viewpoint, file);
    if (!dip_cost_read_json(&part, file, &err) ||
        !dip_cost_merge_frames_add(frames, &part, file, &err)) {
        fail_msg("%s: %s", file, err.message);
    }
    assert_int_equal(part.kept.count, 0);
    dip_cost_report_free(&part);
}

// Makes the pictures of a report from the frames of the parts from `first` to `last`.
static void make_merged(DipCostPictures *pictures, DipCostReport *report, int first, int last) {
    DipCostMergeFrames frames = {.report = report};
    DipError err = {0};
    for (int v = first; v <= last; v++) {
        add_part(&frames, v);
    }
    assert_true(dip_cost_merge_frames_check(&frames, &err));
    const DipCostFrameSource source = dip_cost_merge_frames_source(&frames);
    if (!dip_cost_pictures_make(pictures, report, &source, &err)) {
        fail_msg("%s: %s", err.file, err.message);
    }
    pictures->from_parts = true;
    dip_cost_merge_frames_free(&frames);
}

// Writes the name of the file that a part keeps of a step of AA.
static void frame_file(int viewpoint, uint8_t aa, char file[PATH_MAX]) {
    DipCostReport part;
    char name[64];
    assert_true(dip_cost_read_json(&part, part_file(viewpoint, name), NULL));
    file[0] = '\0';
    for (int i = 0; i < part.kept.count; i++) {
        const DipCostKeptFrame *frame = &part.kept.list[i];
        if (!frame->is_truth && frame->path == 0 && frame->quality.step[DIP_SETTING_AA] == aa) {
            part_name(viewpoint, name);
            assert_true(dip_cost_kept_frame_file(name, frame->hash, file));
        }
    }
    assert_true(file[0]);
    dip_cost_report_free(&part);
}

// --- comparing -----------------------------------------------------------------------------------

static bool same_text(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static bool same_picture(const DipCostPicture *a, const DipCostPicture *b) {
    return a->row == b->row && same_text(a->crop, b->crop) && same_text(a->map, b->map) &&
           same_text(a->frame, b->frame);
}

static bool same_set(const DipCostPictureSet *a, const DipCostPictureSet *b) {
    bool same = a->count == b->count && a->path == b->path && a->viewpoint == b->viewpoint &&
                a->x == b->x && a->y == b->y && a->crop_width == b->crop_width &&
                a->crop_height == b->crop_height && same_picture(&a->truth, &b->truth);
    for (int i = 0; same && i < a->count; i++) {
        same = same_picture(&a->pictures[i], &b->pictures[i]);
    }
    return same;
}

// --- tests ---------------------------------------------------------------------------------------

static void merged_pictures_are_those_of_one_report(void **state) {
    (void)state;
    const DipCostPictureKind kinds[] = {DIP_COST_PICTURES_CROPS, DIP_COST_PICTURES_FULL};
    for (int k = 0; k < 2; k++) {
        DipCostReport report;
        static DipCostPictures expected, merged;
        make_report(&report);
        report.options.pictures = kinds[k];
        make_expected(&expected, &report);
        make_merged(&merged, &report, 0, VIEWPOINTS - 1);
        assert_int_equal(merged.front.count, 2);
        assert_int_equal(merged.sweeps[0].count, 3);
        assert_true(merged.front.x > 0 && merged.front.y > 0); // The crop was found.
        assert_true(!merged.front.truth.frame == (k == 0));
        assert_true(same_set(&expected.sweeps[0], &merged.sweeps[0]));
        assert_true(same_set(&expected.front, &merged.front));
        assert_int_equal(merged.sweeps[0].missing_count + merged.front.missing_count, 0);
        dip_cost_pictures_free(&merged);
        make_merged(&merged, &report, 0, 0); // Another viewpoint has other pictures.
        assert_int_equal(merged.sweeps[0].viewpoint, 0);
        assert_false(same_picture(&expected.sweeps[0].truth, &merged.sweeps[0].truth));
        dip_cost_pictures_free(&merged);
        dip_cost_pictures_free(&expected);
        dip_cost_report_free(&report);
    }
}

// Standard error goes to a file until end_capture, which returns the number of its lines and finds
// out whether the last one has the text.
static int old_stderr;
static const char *const captured = FOLDER "/stderr";

static void begin_capture(void) {
    fflush(stderr);
    old_stderr = dup(STDERR_FILENO);
    assert_non_null(freopen(captured, "w", stderr));
}

static int end_capture(const char *text, bool *has_text) {
    char line[1024];
    int lines = 0;
    fflush(stderr);
    assert_true(dup2(old_stderr, STDERR_FILENO) >= 0);
    close(old_stderr);
    FILE *in = fopen(captured, "r");
    assert_non_null(in);
    *has_text = false;
    while (fgets(line, sizeof line, in)) {
        lines++;
        *has_text = strstr(line, text) != NULL;
    }
    fclose(in);
    return lines;
}

static void damage(const char *file) {
    FILE *to = fopen(file, "r+b");
    assert_non_null(to);
    assert_int_equal(fseek(to, 60, SEEK_SET), 0);
    const int byte = getc(to);
    assert_int_equal(fseek(to, 60, SEEK_SET), 0);
    putc(byte ^ 1, to);
    assert_int_equal(fclose(to), 0);
}

static bool page_says(const DipCostReport *report, const DipCostPictures *pictures,
                      const char *text) {
    static char page[1 << 22];
    assert_true(dip_cost_write_html(report, pictures, FOLDER "/page.html", NULL));
    FILE *in = fopen(FOLDER "/page.html", "r");
    assert_non_null(in);
    page[fread(page, 1, sizeof page - 1, in)] = '\0';
    fclose(in);
    return strstr(page, text) != NULL;
}

static void missing_and_damaged_frames_are_named_once(void **state) {
    (void)state;
    DipCostReport report;
    static DipCostPictures merged;
    char file[PATH_MAX];
    bool has_text;
    make_report(&report);
    frame_file(MIDDLE, 1, file);
    assert_int_equal(remove(file), 0);
    frame_file(MIDDLE, 2, file);
    damage(file);

    begin_capture();
    make_merged(&merged, &report, MIDDLE, MIDDLE);
    const int lines = end_capture("warning: " FOLDER "/part1/cost.json: [frames] of 9 pictures "
                                  "that the part keeps, 1 is missing and 1 is damaged",
                                  &has_text);
    assert_int_equal(lines, 1);
    assert_true(has_text);
    assert_int_equal(merged.sweeps[0].count, 1); // aa=none is still there.
    assert_int_equal(merged.sweeps[0].missing_count, 2);
    assert_int_equal(merged.front.missing_count, 0);
    assert_true(page_says(&report, &merged,
                          "No part has the pictures of these rows: aa=2 on DEFAULT; aa=4 on "
                          "DEFAULT.</p>"));
    assert_false(page_says(&report, &merged, "other viewpoints are shown"));
    dip_cost_pictures_free(&merged);

    // With the other parts, the sweep shows the first viewpoint, of which all frames are there.
    begin_capture();
    make_merged(&merged, &report, 0, VIEWPOINTS - 1);
    assert_int_equal(end_capture("", &has_text), 1);
    assert_int_equal(merged.sweeps[0].missing_count, 0);
    assert_int_equal(merged.sweeps[0].viewpoint, 0);
    assert_int_equal(merged.front.viewpoint, MIDDLE);
    assert_true(
        page_says(&report, &merged, "other viewpoints are shown: Antialiasing, viewpoint 1 of 3"));
    assert_false(page_says(&report, &merged, "No part has the pictures of these rows"));
    dip_cost_pictures_free(&merged);
    dip_cost_report_free(&report);
    write_part(MIDDLE);
}

static void without_frames_all_pictures_are_missing(void **state) {
    (void)state;
    DipCostReport report;
    static DipCostPictures merged;
    DipCostMergeFrames frames = {.report = &report};
    make_report(&report);
    assert_true(dip_cost_merge_frames_add(&frames, &report, "none/cost.json", NULL));
    assert_int_equal(frames.part_count, 0);
    const DipCostFrameSource source = dip_cost_merge_frames_source(&frames);
    assert_true(dip_cost_pictures_make(&merged, &report, &source, NULL));
    assert_int_equal(merged.sweeps[0].count + merged.front.count, 0);
    assert_int_equal(merged.sweeps[0].missing_count, 3);
    assert_int_equal(merged.front.missing_count, 2);
    dip_cost_pictures_free(&merged);
    dip_cost_report_free(&report);
}

// The hash becomes part of a file name, so a report cannot name any other file.
static void a_hash_that_is_none_is_refused(void **state) {
    (void)state;
    static const char *const hashes[] = {"", "../../../../../../../../../etc/p",
                                         "0123456789abcdef0123456789abcdeF"};
    for (size_t i = 0; i < sizeof hashes / sizeof *hashes; i++) {
        DipCostReport report, read;
        DipError err = {0};
        make_report(&report);
        report.kept.list = calloc(1, sizeof *report.kept.list);
        assert_non_null(report.kept.list);
        report.kept.count = 1;
        memset(report.kept.list[0].hash, 'a', DIP_HASH_HEX_SIZE - 1);
        assert_true(dip_cost_write_json(&report, FOLDER "/x.json", NULL));
        assert_true(dip_cost_read_json(&read, FOLDER "/x.json", &err));
        assert_int_equal(read.kept.count, 1);
        dip_cost_report_free(&read);
        strcpy(report.kept.list[0].hash, hashes[i]);
        assert_true(dip_cost_write_json(&report, FOLDER "/x.json", NULL));
        assert_false(dip_cost_read_json(&read, FOLDER "/x.json", &err));
        assert_string_equal(err.key, "frames");
        dip_cost_report_free(&report);
    }
}

// The advice of a merged report is chosen by the errors of all viewpoints.
static void advice_is_chosen_anew(void **state) {
    (void)state;
    DipCostReport report;
    make_report(&report);
    report.advice_count = 1;
    report.advice[0] = (DipCostAdvice){.budget_ms = 100.0, .row = report.combined_first};
    assert_true(dip_cost_choose_again(&report, NULL));
    assert_int_equal(report.advice[0].row, report.combined_first + 1); // Half of the other's FLIP.
    for (int p = 0; p < report.options.places; p++) {
        report.rows[report.combined_first + 1].viewpoints[p].regions[0].flip *= 3.0;
    }
    assert_true(dip_cost_choose_again(&report, NULL));
    assert_int_equal(report.advice[0].row, report.combined_first);
    dip_cost_report_free(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merged_pictures_are_those_of_one_report),
        cmocka_unit_test(missing_and_damaged_frames_are_named_once),
        cmocka_unit_test(without_frames_all_pictures_are_missing),
        cmocka_unit_test(a_hash_that_is_none_is_refused),
        cmocka_unit_test(advice_is_chosen_anew),
    };
    return cmocka_run_group_tests(tests, write_parts, remove_parts);
}
