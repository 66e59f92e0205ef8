// Choosing what the page shows, and fitting it into the page.
#include "app/report/page/report_pictures.h"

#include "app/report/front.h"
#include "app/cli/progress.h"

#include <stdlib.h>
#include <string.h>

enum {
    SET_COUNT = DIP_COST_MAX_SWEEPS + 1,
    TEXT_BYTES = 400000,  // Room for the style, the scripts and the texts of a page.
    ROW_TEXT_BYTES = 1500 // Room for what the tables and plots have about a row.
};

// --- fitting -------------------------------------------------------------------------------------

static double size_of(const char *uri) {
    return uri ? (double)strlen(uri) : 0.0;
}

static void drop(char **uri) {
    free(*uri);
    *uri = NULL;
}

// True if some row of the set has a crop.
static bool has_crops(const DipCostPictureSet *set) {
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].crop) {
            return true;
        }
    }
    return false;
}

// Keeps the crops of a set that fit. Returns the bytes left.
static double fit_crops(DipCostPictureSet *set, double room, int *left_out) {
    double need = size_of(set->truth.crop);
    for (int i = 0; i < set->count; i++) {
        DipCostPicture *picture = &set->pictures[i];
        need += size_of(picture->crop) + size_of(picture->map);
        if (need <= room) {
            room -= need;
            need = 0.0;
        } else {
            need -= size_of(picture->crop) + size_of(picture->map);
            drop(&picture->crop);
            drop(&picture->map);
            ++*left_out;
        }
    }
    if (!has_crops(set)) {
        drop(&set->truth.crop);
    }
    return room;
}

// Replaces the crops of a set by whole frames where these fit. Returns the bytes left.
static double fit_frames(DipCostPictureSet *set, double room, int *left_out) {
    double need = size_of(set->truth.frame);
    bool has_frames = false;
    for (int i = 0; i < set->count; i++) {
        DipCostPicture *picture = &set->pictures[i];
        const double more =
            size_of(picture->frame) - size_of(picture->crop) - size_of(picture->map);
        if (need + more <= room) {
            room -= need + more;
            need = 0.0;
            has_frames = true;
            drop(&picture->crop);
            drop(&picture->map);
        } else {
            drop(&picture->frame);
            ++*left_out;
        }
    }
    if (!has_frames) {
        drop(&set->truth.frame);
    } else if (!has_crops(set)) {
        drop(&set->truth.crop);
    }
    return room;
}

void dip_cost_pictures_fit(DipCostPictures *pictures, double room) {
    bool whole = pictures->front.truth.frame != NULL;
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        whole = whole || pictures->sweeps[s].truth.frame;
        room = fit_crops(&pictures->sweeps[s], room, &pictures->crops_left_out);
    }
    room = fit_crops(&pictures->front, room, &pictures->crops_left_out);
    if (!whole) {
        return;
    }
    room = fit_frames(&pictures->front, room, &pictures->frames_left_out);
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        room = fit_frames(&pictures->sweeps[s], room, &pictures->frames_left_out);
    }
}

// --- making --------------------------------------------------------------------------------------

static void add_row(DipCostPictureSet *set, int row) {
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].row == row) {
            return;
        }
    }
    if (set->count < DIP_COST_SET_ROWS) {
        set->pictures[set->count++].row = row;
    }
}

static void sort_by_time(const DipCostReport *report, DipCostPictureSet *set) {
    for (int i = 1; i < set->count; i++) {
        const int row = set->pictures[i].row;
        int to = i;
        for (; to > 0 && dip_cost_ms(report, set->pictures[to - 1].row) > dip_cost_ms(report, row);
             to--) {
            set->pictures[to].row = set->pictures[to - 1].row;
        }
        set->pictures[to].row = row;
    }
}

// The set of combinations gets the advised rows first, since a set has a limited number of rows.
static void plan_front(const DipCostReport *report, DipCostPictureSet *set) {
    int rows[DIP_COST_MAX_ROWS];
    const int count = dip_cost_list_front(report, rows);
    for (int i = 0; i < report->advice_count; i++) {
        if (report->advice[i].row >= 0) {
            add_row(set, report->advice[i].row);
        }
    }
    for (int i = 0; i < count; i++) {
        add_row(set, rows[i]);
    }
    sort_by_time(report, set);
}

static void plan_sweep(const DipCostSweep *sweep, DipCostPictureSet *set) {
    set->path = sweep->path;
    for (int i = 0; i < sweep->row_count; i++) {
        add_row(set, sweep->rows[i]);
    }
}

// Makes all sets that have rows.
static bool make_sets(DipCostPictures *pictures, const DipCostReport *report,
                      const DipCostFrameSource *source, DipError *err) {
    DipCostPictureSet *sets[SET_COUNT];
    int total = 0, most = 1, done = 0;
    for (int s = 0; s < SET_COUNT; s++) {
        sets[s] = s < DIP_COST_MAX_SWEEPS ? &pictures->sweeps[s] : &pictures->front;
        sets[s]->viewpoint = (report->options.first_place + report->options.end_place - 1) / 2;
        total += sets[s]->count;
        most = sets[s]->count > most ? sets[s]->count : most;
    }
    DipCostCutter cutter;
    if (!dip_cost_cutter_open(&cutter, report, source, most, err)) {
        return false;
    }
    const bool whole = report->options.pictures == DIP_COST_PICTURES_FULL;
    DipProgress progress = dip_progress_begin("pictures cut out", total);
    bool made = true;
    for (int s = 0; made && s < SET_COUNT; s++) {
        const int count = sets[s]->count;
        made = count == 0 || dip_cost_picture_set_make(sets[s], &cutter, whole, err);
        dip_progress_show(&progress, done += count);
    }
    dip_progress_end(&progress, done);
    dip_cost_cutter_close(&cutter);
    return made;
}

bool dip_cost_pictures_make(DipCostPictures *pictures, const DipCostReport *report,
                            const DipCostFrameSource *source, DipError *err) {
    memset(pictures, 0, sizeof *pictures);
    if (report->options.pictures == DIP_COST_PICTURES_NONE) {
        return true;
    }
    for (int s = 0; s < report->sweep_count; s++) {
        plan_sweep(&report->sweeps[s], &pictures->sweeps[s]);
    }
    plan_front(report, &pictures->front);
    if (!make_sets(pictures, report, source, err)) {
        dip_cost_pictures_free(pictures);
        return false;
    }
    dip_cost_pictures_fit(pictures, DIP_COST_PAGE_BYTES - TEXT_BYTES -
                                        (double)ROW_TEXT_BYTES * report->row_count);
    return true;
}

void dip_cost_pictures_free(DipCostPictures *pictures) {
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        dip_cost_picture_set_free(&pictures->sweeps[s]);
    }
    dip_cost_picture_set_free(&pictures->front);
    memset(pictures, 0, sizeof *pictures);
}
