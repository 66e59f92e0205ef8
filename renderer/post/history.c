// Runs temporal antialiasing over the rows of a picture, in bands on the worker pool.
//
// Colours are 16-bit linear light in YCoCg: y = r/4 + g/2 + b/4, co = (r - b)/2,
// cg = g/2 - (r + b)/4. The sums of sixteen pictures of it are exact in floats.
#include "renderer/post/history.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/base/srgb.h"
#include "renderer/post/filters/filter.h"

#include <stdlib.h>
#include <string.h>

static const float least_alpha = 0.2f; // share of the new picture

// The rows of a picture that a band needs: its own, one above and one below.
enum { WINDOW_ROWS = DIP_POST_BAND + 2 };

// What one worker has unpacked, and counted.
typedef struct Worker {
    DipPostWindow colours[3];
    DipPostWindow depths;
    uint64_t pixels_reprojected;
} Worker;

struct DipHistory {
    DipHistoryDef def;
    const DipPostKernels *kernels;
    void *memory;
    size_t bytes;
    Worker *workers;
    int worker_count;
    DipPostPlane planes[2][3]; // the last result, and room for the next one
    int last;                  // the planes that hold the last result
    float *light16;            // 16-bit linear light of the 256 codes
    DipSrgbEncodeTable *codes;

    int summed; // pictures whose sum the last planes hold; 0 if they hold a blended picture
    int kept;   // pictures that the history has, at most DIP_HISTORY_PICTURES
    bool holds; // the last result is a blended picture

    // The current run.
    const DipHistoryPicture *picture;
    uint8_t *to;
    size_t to_stride_bytes;
    float alpha;
    bool sums; // a picture at rest is added to the sums
    bool shows;
};

static void take(DipHistory *history, DipPostArena *arena) {
    const int width = history->def.width;
    history->workers = dip_post_take(arena, (size_t)history->worker_count, sizeof(Worker));
    for (int w = 0; w < history->worker_count; w++) {
        Worker worker = {.depths = dip_post_take_window(arena, width, WINDOW_ROWS)};
        for (int c = 0; c < 3; c++) {
            worker.colours[c] = dip_post_take_window(arena, width, WINDOW_ROWS);
        }
        if (history->workers) {
            history->workers[w] = worker;
        }
    }
    for (int i = 0; i < 6; i++) {
        history->planes[i / 3][i % 3] = dip_post_take_plane(arena, width, history->def.height);
    }
    history->light16 = dip_post_take(arena, 256, sizeof *history->light16);
    history->codes = dip_post_take(arena, 1, sizeof *history->codes);
}

static void fill_tables(DipHistory *history) {
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    for (int i = 0; i < 256; i++) {
        history->light16[i] = (float)(int)(table.linear[i] * DIP_LINEAR16_MAX + 0.5);
    }
    dip_srgb_encode_table(history->codes);
}

static bool check(const DipHistoryDef *def, DipError *err) {
    if (def->width < 1 || def->height < 1 || def->width > DIP_MAX_POST_SIZE ||
        def->height > DIP_MAX_POST_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "history",
                             "pictures of %d x %d, accepted: sizes of 1 to %d", def->width,
                             def->height, DIP_MAX_POST_SIZE);
    }
    return dip_isa_available(def->isa) ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "history",
                         "the instruction set %s, which this machine does not have",
                         dip_isa_name(def->isa));
}

DipHistory *dip_history_create(const DipHistoryDef *def, DipError *err) {
    if (!check(def, err)) {
        return NULL;
    }
    const DipFpMode mode = dip_fp_mode_set();
    DipHistory *history = calloc(1, sizeof *history);
    if (history) {
        history->def = *def;
        history->kernels = dip_post_kernels(def->isa);
        history->worker_count = dip_pool_thread_count(def->pool);
        DipPostArena arena = {0};
        take(history, &arena);
        history->bytes = arena.used;
        history->memory = dip_pages_alloc(arena.used);
    }
    if (history && history->memory) {
        // Also lets the system find the pages now, not in the first frame.
        memset(history->memory, 0, history->bytes);
        DipPostArena arena = {.memory = history->memory};
        take(history, &arena);
        fill_tables(history);
    } else {
        free(history);
        history = NULL;
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "history",
                      "out of memory for pictures of %d x %d", def->width, def->height);
    }
    dip_fp_mode_restore(mode);
    return history;
}

void dip_history_destroy(DipHistory **history) {
    if (*history) {
        dip_lines_free((*history)->memory);
        free(*history);
        *history = NULL;
    }
}

size_t dip_history_bytes(const DipHistory *history) {
    return sizeof *history + history->bytes;
}

// --- rows ----------------------------------------------------------------------------------------

static int clamp(int at, int count) {
    return at < 0 ? 0 : at >= count ? count - 1 : at;
}

// Unpacks row y of the picture, and its depths, into row `slot` of a worker's windows. Rows beyond
// the borders are the nearest rows.
static void unpack(const DipHistory *history, const Worker *worker, int slot, int y) {
    const DipHistoryPicture *picture = history->picture;
    const int width = history->def.width;
    const int row = clamp(y, history->def.height);
    float *colours[3];
    for (int c = 0; c < 3; c++) {
        colours[c] = dip_post_window_row(&worker->colours[c], slot);
    }
    history->kernels->dip_kernel_history_unpack(
        picture->rgba8 + (size_t)row * picture->stride_bytes, width, history->light16, colours);
    for (int c = 0; c < 3; c++) {
        dip_post_extend_row(colours[c], width);
    }
    if (history->sums) {
        return;
    }
    const int64_t down = picture->depths_height;
    const int64_t across = picture->depths_width;
    const float *from = picture->depths + (2 * row + 1) * down / (2 * history->def.height) * across;
    float *depths = dip_post_window_row(&worker->depths, slot);
    if (across == width) {
        memcpy(depths, from, (size_t)width * sizeof *depths);
    } else {
        for (int x = 0; x < width; x++) {
            depths[x] = from[(2 * x + 1) * across / (2 * width)];
        }
    }
    dip_post_extend_row(depths, width);
}

// Repeats the first and the last value of row y of a plane into its borders, and the first and the
// last row into the rows that a cubic filter reads beyond them.
static void extend(const DipPostPlane *plane, int y, int width, int height) {
    float *row = plane->at + (ptrdiff_t)y * plane->stride;
    const size_t bytes = (size_t)(width + 2 * DIP_POST_BORDER) * sizeof *row;
    dip_post_extend_row(row, width);
    for (int i = 1; i <= 2; i++) {
        if (y == 0) {
            memcpy(row - DIP_POST_BORDER - (ptrdiff_t)i * plane->stride, row - DIP_POST_BORDER,
                   bytes);
        }
        if (y == height - 1) {
            memcpy(row - DIP_POST_BORDER + (ptrdiff_t)i * plane->stride, row - DIP_POST_BORDER,
                   bytes);
        }
    }
}

static void add_row(DipHistory *history, Worker *worker, int slot, int y) {
    const DipHistoryPicture *picture = history->picture;
    const int next = history->sums ? history->last : 1 - history->last;
    DipHistoryRow row = {
        .y = y,
        .width = history->def.width,
        .height = history->def.height,
        .from = picture->rgba8 + (size_t)y * picture->stride_bytes,
        .to = history->shows ? history->to + (size_t)y * history->to_stride_bytes : NULL,
        .srgb = history->codes,
        .begins = picture->step == DIP_HISTORY_BEGIN,
        .summed = history->summed,
        .past_scale = history->summed ? 1.0f / (float)history->summed : 1.0f,
        .alpha = history->alpha,
        .plane_stride = history->planes[0][0].stride,
    };
    memcpy(row.to_before, picture->to_before, sizeof row.to_before);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 3; i++) {
            row.colours[i][c] = dip_post_window_row(&worker->colours[c], slot - 1 + i);
        }
        row.past[c] = history->planes[history->last][c].at;
        row.result[c] =
            history->planes[next][c].at + (ptrdiff_t)y * history->planes[next][c].stride;
    }
    for (int i = 0; i < 3; i++) {
        row.depths[i] = dip_post_window_row(&worker->depths, slot - 1 + i);
    }
    if (history->sums) {
        history->kernels->dip_kernel_history_rest(&row);
    } else {
        worker->pixels_reprojected += history->kernels->dip_kernel_history_move(&row);
    }
    for (int c = 0; c < 3; c++) {
        extend(&history->planes[next][c], y, row.width, row.height);
    }
}

static void add_band(void *context, int band, int worker) {
    DipHistory *history = context;
    const int begin = band * DIP_POST_BAND;
    const int height = history->def.height;
    const int end = begin + DIP_POST_BAND < height ? begin + DIP_POST_BAND : height;
    for (int y = begin - 1; y <= end; y++) {
        unpack(history, &history->workers[worker], y - begin + 1, y);
    }
    for (int y = begin; y < end; y++) {
        add_row(history, &history->workers[worker], y - begin + 1, y);
    }
}

// --- a picture -----------------------------------------------------------------------------------

// Decides what the run does, and what the history holds after it. Returns false if it does nothing.
static bool plan(DipHistory *history) {
    const DipHistoryStep step = history->picture->step;
    history->sums = step == DIP_HISTORY_REST;
    if (history->sums) {
        if (history->summed == DIP_HISTORY_PICTURES) {
            return false;
        }
        history->shows = !history->holds || history->summed + 1 >= DIP_HISTORY_HELD;
        return true;
    }
    const float mean = 1.0f / (float)(history->kept + 1);
    history->alpha = mean > least_alpha ? mean : least_alpha;
    history->shows = true;
    return true;
}

// Notes what the history holds after the run.
static void note(DipHistory *history) {
    switch (history->picture->step) {
    case DIP_HISTORY_BEGIN:
        history->summed = 1;
        history->kept = 1;
        history->holds = false;
        break;
    case DIP_HISTORY_MOVE:
        history->summed = 0;
        history->kept += history->kept < DIP_HISTORY_PICTURES;
        history->holds = true;
        break;
    default:
        history->summed++;
        history->kept = history->summed;
        history->holds = history->holds && !history->shows;
        break;
    }
    if (!history->sums) {
        history->last = 1 - history->last;
    }
}

DipHistoryWork dip_history_add(DipHistory *history, const DipHistoryPicture *picture,
                               uint8_t *to_rgba8, size_t to_stride_bytes) {
    DIP_FP_MODE_SCOPE();
    DipHistoryWork work = {0};
    const int height = history->def.height;
    history->picture = picture;
    history->to = to_rgba8;
    history->to_stride_bytes = to_stride_bytes;
    if (!plan(history)) {
        return work;
    }
    dip_pool_run(history->def.pool, (height + DIP_POST_BAND - 1) / DIP_POST_BAND, add_band,
                 history);
    note(history);
    work.pixels_filtered =
        history->shows ? (uint64_t)history->def.width * (uint64_t)height : work.pixels_filtered;
    for (int w = 0; w < history->worker_count; w++) {
        work.pixels_reprojected += history->workers[w].pixels_reprojected;
        history->workers[w].pixels_reprojected = 0;
    }
    return work;
}
