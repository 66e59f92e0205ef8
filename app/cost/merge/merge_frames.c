// Collects the frames of parts, and chooses and reads those of a set of pictures.
#include "app/cost/merge/merge_frames.h"

#include "app/cli/log.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- collecting ----------------------------------------------------------------------------------

// Writes the folder of a file, "." if the name has none. Returns false if it is too long.
static bool find_folder(const char *file, char folder[PATH_MAX]) {
    const char *slash = strrchr(file, '/');
    const int length = slash ? (int)(slash - file) : 1;
    return snprintf(folder, PATH_MAX, "%.*s", length ? length : 1, slash ? file : ".") < PATH_MAX;
}

// Says once for a part how many of its frames cannot be shown.
static void warn(const char *file, const int counts[3]) {
    const int missing = counts[DIP_COST_KEPT_MISSING];
    const int damaged = counts[DIP_COST_KEPT_DAMAGED];
    if (missing + damaged > 0) {
        dip_log_note("warning: %s: [frames] of %d pictures that the part keeps, %d %s missing and "
                     "%d %s damaged (another hash); the page does without them",
                     file, missing + damaged + counts[DIP_COST_KEPT_WHOLE], missing,
                     missing == 1 ? "is" : "are", damaged, damaged == 1 ? "is" : "are");
    }
}

// Removes the frames whose file is missing or damaged.
static bool remove_unusable(DipCostPartFrames *part, DipError *err) {
    DipCostKeptFrames *kept = &part->kept;
    int counts[3] = {0};
    int left = 0;
    for (int i = 0; i < kept->count; i++) {
        DipCostKeptState state;
        if (!dip_cost_kept_frame_check(&kept->list[i], part->folder, &state, err)) {
            return false;
        }
        counts[state]++;
        if (state == DIP_COST_KEPT_WHOLE) {
            kept->list[left++] = kept->list[i];
        }
    }
    kept->count = left;
    warn(part->file, counts);
    return true;
}

bool dip_cost_merge_frames_add(DipCostMergeFrames *frames, DipCostReport *part, const char *file,
                               DipError *err) {
    if (part->kept.count == 0) {
        return true;
    }
    DipCostPartFrames *parts =
        realloc(frames->parts, ((size_t)frames->part_count + 1) * sizeof *parts);
    if (!parts) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, NULL, "out of memory");
    }
    frames->parts = parts;
    DipCostPartFrames *added = &parts[frames->part_count++];
    added->kept = part->kept;
    part->kept = (DipCostKeptFrames){0};
    added->file = file;
    return find_folder(file, added->folder) ||
           dip_error_set(err, DIP_ERROR_OVERSIZED, file, 0, NULL, "the name is too long");
}

bool dip_cost_merge_frames_check(DipCostMergeFrames *frames, DipError *err) {
    bool checked = true;
    for (int i = 0; checked && i < frames->part_count; i++) {
        checked = remove_unusable(&frames->parts[i], err);
    }
    return checked;
}

void dip_cost_merge_frames_free(DipCostMergeFrames *frames) {
    for (int i = 0; i < frames->part_count; i++) {
        dip_cost_kept_frames_free(&frames->parts[i].kept);
    }
    free(frames->parts);
    *frames = (DipCostMergeFrames){0};
}

// --- choosing ------------------------------------------------------------------------------------

// A frame, and the part that keeps it.
typedef struct Found {
    const DipCostPartFrames *part; // NULL if no part has the frame.
    const DipCostKeptFrame *frame;
} Found;

static bool is_wanted(const DipCostKeptFrame *frame, int path, const DipQuality *quality) {
    return frame->path == path && frame->is_truth == !quality &&
           (!quality || memcmp(&frame->quality, quality, sizeof *quality) == 0);
}

// Finds the frame of a row at a viewpoint, or that of the truth if `row` is -1.
static Found find(const DipCostMergeFrames *frames, int path, int viewpoint, int row) {
    const DipQuality *quality = row >= 0 ? &frames->report->rows[row].quality : NULL;
    for (int p = 0; p < frames->part_count; p++) {
        const DipCostKeptFrames *kept = &frames->parts[p].kept;
        for (int i = 0; kept->viewpoint == viewpoint && i < kept->count; i++) {
            if (is_wanted(&kept->list[i], path, quality)) {
                return (Found){&frames->parts[p], &kept->list[i]};
            }
        }
    }
    return (Found){NULL, NULL};
}

// Returns how many of the set's rows can be shown at a viewpoint: none without the truth.
static int count_rows(const DipCostMergeFrames *frames, const DipCostPictureSet *set,
                      int viewpoint) {
    int count = 0;
    for (int i = 0; i < set->count && find(frames, set->path, viewpoint, -1).part; i++) {
        count += find(frames, set->path, viewpoint, set->pictures[i].row).part != NULL;
    }
    return count;
}

// Returns the viewpoint that the set shows.
static int choose_viewpoint(const DipCostMergeFrames *frames, const DipCostPictureSet *set) {
    const int middle = (frames->report->options.places - 1) / 2;
    int best = middle;
    int most = count_rows(frames, set, middle);
    for (int p = 0; p < frames->part_count; p++) {
        const int viewpoint = frames->parts[p].kept.viewpoint;
        const int count = count_rows(frames, set, viewpoint);
        if (count > most ||
            (count == most && count > 0 && abs(viewpoint - middle) < abs(best - middle))) {
            most = count;
            best = viewpoint;
        }
    }
    return best;
}

static void choose_kept(void *context, DipCostPictureSet *set) {
    const DipCostMergeFrames *frames = context;
    set->viewpoint = choose_viewpoint(frames, set);
    const bool has_truth = find(frames, set->path, set->viewpoint, -1).part;
    int left = 0;
    for (int i = 0; i < set->count; i++) {
        const int row = set->pictures[i].row;
        if (has_truth && find(frames, set->path, set->viewpoint, row).part) {
            set->pictures[left++].row = row;
        } else {
            set->missing[set->missing_count++] = row;
        }
    }
    set->count = left;
}

static bool read_kept(void *context, const DipCostPictureSet *set, int row, uint8_t *rgba8,
                      DipError *err) {
    const DipCostMergeFrames *frames = context;
    const Found found = find(frames, set->path, set->viewpoint, row);
    return dip_cost_kept_frame_read(found.frame, found.part->folder, rgba8, frames->report->width,
                                    frames->report->height, err);
}

DipCostFrameSource dip_cost_merge_frames_source(DipCostMergeFrames *frames) {
    return (DipCostFrameSource){frames, choose_kept, read_kept};
}
