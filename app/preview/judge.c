// Levels of the truth, tile by tile, and errors, block by block.
#include "app/preview/judge.h"

#include "app/measure/difference.h"
#include "app/measure/flip.h"
#include "app/measure/truth.h"
#include "renderer/reference/convergence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Parts of the picture that are dealt with in one step.
enum {
    HALVES = 2,
    FINISH_PIXELS = 1 << 14,
    BAND_PIXELS = 1 << 15, // of the errors that are sums over pixels
    BLOCK = 96,            // pixels of a side, of FLIP, which also looks at what is around
};

const int dip_judge_samples[DIP_JUDGE_LEVELS] = {4, 16, 64};

typedef struct Rect {
    int x;
    int y;
    int width;
    int height;
} Rect;

typedef struct PaneSums {
    DipMapSum squared_lin;
    DipMapSum squared_codes;
    DipMapSum flip;
} PaneSums;

struct DipJudge {
    DipReference *reference;
    DipSrgbEncodeTable encode;
    int flip_margin; // pixels that FLIP looks at beyond a block
    DipJudgeShot shot;
    bool has_shot;
    size_t pixels; // there is room for
    double *halves[HALVES];
    float *rgb_lin;              // the mean of the halves of the last finished level
    uint8_t *rgba8;              // the same, encoded
    float *map;                  // 3 values for each pixel of a band or a block with its margin
    DipConvergence *convergence; // NULL: not made yet
    int level;                   // in drawing
    int drawn;                   // tiles of its halves
    size_t finished;             // pixels whose mean is taken; only when all tiles are drawn
    double half_squares;         // of half less half, over these
    double floor_rmse;           // of the last finished level
    int truth_level;             // -1: none is finished
    int judged;                  // parts of the pictures; -1: all
    PaneSums sums[DIP_PANE_COUNT];
    DipJudgeResult result;
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static size_t pixel_count(const DipJudge *judge) {
    return (size_t)judge->shot.width * (size_t)judge->shot.height;
}

bool dip_judge_same_truth(const DipJudgeShot *a, const DipJudgeShot *b) {
    return memcmp(&a->pose, &b->pose, sizeof a->pose) == 0 && a->time_ns == b->time_ns &&
           a->width == b->width && a->height == b->height;
}

DipJudge *dip_judge_create(DipReference *reference, DipError *err) {
    DipJudge *judge = calloc(1, sizeof *judge);
    if (!judge) {
        out_of_memory(err);
        return NULL;
    }
    judge->reference = reference;
    judge->flip_margin = dip_flip_reach_px(DIP_FLIP_PIXELS_PER_DEGREE);
    dip_srgb_encode_table(&judge->encode);
    return judge;
}

static void free_pictures(DipJudge *judge) {
    free(judge->halves[0]);
    free(judge->halves[1]);
    free(judge->rgb_lin);
    free(judge->rgba8);
    free(judge->map);
    judge->halves[0] = judge->halves[1] = NULL;
    judge->rgb_lin = judge->map = NULL;
    judge->rgba8 = NULL;
    judge->pixels = 0;
}

void dip_judge_destroy(DipJudge **judge) {
    if (!*judge) {
        return;
    }
    dip_convergence_destroy(&(*judge)->convergence);
    free_pictures(*judge);
    free(*judge);
    *judge = NULL;
}

// Whole rows, at least one.
static int band_rows(const DipJudge *judge) {
    return larger(1, BAND_PIXELS / judge->shot.width);
}

static bool make_room(DipJudge *judge, DipError *err) {
    const size_t pixels = pixel_count(judge);
    const size_t side = (size_t)(BLOCK + 2 * judge->flip_margin);
    const size_t band = (size_t)judge->shot.width * (size_t)band_rows(judge);
    if (judge->pixels == pixels) {
        return true;
    }
    free_pictures(judge);
    for (int h = 0; h < HALVES; h++) {
        judge->halves[h] = malloc(pixels * 3 * sizeof(double));
    }
    judge->rgb_lin = malloc(pixels * 3 * sizeof(float));
    judge->rgba8 = malloc(pixels * 4);
    judge->map = malloc((band > side * side ? band : side * side) * 3 * sizeof(float));
    judge->pixels = pixels;
    return (judge->halves[0] && judge->halves[1] && judge->rgb_lin && judge->rgba8 && judge->map) ||
           out_of_memory(err);
}

bool dip_judge_begin(DipJudge *judge, const DipJudgeShot *shot, DipError *err) {
    const bool same = judge->has_shot && dip_judge_same_truth(&judge->shot, shot);
    judge->shot = *shot;
    judge->judged = 0;
    memset(judge->sums, 0, sizeof judge->sums);
    judge->result = (DipJudgeResult){0};
    if (same) {
        return true;
    }
    dip_convergence_destroy(&judge->convergence);
    judge->level = judge->drawn = 0;
    judge->finished = 0;
    judge->half_squares = 0.0;
    judge->truth_level = -1;
    judge->has_shot = make_room(judge, err);
    if (!judge->has_shot) {
        free_pictures(judge);
    }
    return judge->has_shot;
}

// --- the truth ---------------------------------------------------------------------------------

// Its halves are seeded as the cost report's, so that the last level is the same picture.
static bool draw_next_tile(DipJudge *judge, DipError *err) {
    const int tiles = dip_convergence_tile_count(judge->convergence);
    const int half = judge->drawn / tiles;
    if (judge->drawn % tiles == 0) {
        memset(judge->halves[half], 0, pixel_count(judge) * 3 * sizeof(double));
    }
    const bool added = dip_convergence_add_tile(judge->convergence, judge->drawn % tiles,
                                                dip_judge_samples[judge->level], (uint32_t)half + 1,
                                                1.0, judge->halves[half], NULL, err);
    judge->drawn += added;
    return added;
}

static bool is_drawn(const DipJudge *judge) {
    return judge->convergence &&
           judge->drawn == HALVES * dip_convergence_tile_count(judge->convergence);
}

// Takes the mean of the halves and adds up their difference.
static void finish_pixels(DipJudge *judge) {
    const size_t left = pixel_count(judge) - judge->finished;
    const size_t count = left < FINISH_PIXELS ? left : FINISH_PIXELS;
    double *a = judge->halves[0] + 3 * judge->finished;
    const double *b = judge->halves[1] + 3 * judge->finished;
    float *rgb_lin = judge->rgb_lin + 3 * judge->finished;
    for (size_t i = 0; i < 3 * count; i++) {
        const double difference = a[i] - b[i];
        judge->half_squares += difference * difference;
        a[i] = 0.5 * (a[i] + b[i]);
        rgb_lin[i] = (float)a[i];
    }
    dip_truth_encode(&judge->encode, a, count, judge->rgba8 + 4 * judge->finished);
    judge->finished += count;
}

static void next_level(DipJudge *judge) {
    judge->floor_rmse = sqrt(judge->half_squares / (3.0 * (double)pixel_count(judge))) / 2.0;
    judge->truth_level = judge->level++;
    judge->drawn = 0;
    judge->finished = 0;
    judge->half_squares = 0.0;
    judge->judged = 0;
    memset(judge->sums, 0, sizeof judge->sums);
}

// --- the errors --------------------------------------------------------------------------------

static void add_sum(DipMapSum *to, DipMapSum sum) {
    to->sum += sum.sum;
    to->pixel_count += sum.pixel_count;
}

// A rectangle of a pane's picture and of the truth.
static void cut_out(const DipJudge *judge, int pane, const Rect *rect, DipSrgbPicture *test,
                    DipSrgbPicture *truth) {
    const size_t stride = judge->shot.stride_bytes, packed = 4 * (size_t)judge->shot.width;
    const size_t x = 4 * (size_t)rect->x, y = (size_t)rect->y;
    *test = (DipSrgbPicture){judge->shot.rgba8[pane] + y * stride + x, stride, rect->width,
                             rect->height};
    *truth = (DipSrgbPicture){judge->rgba8 + y * packed + x, packed, rect->width, rect->height};
}

static void judge_band(DipJudge *judge, int pane, int band) {
    const int y = band * band_rows(judge);
    const int rows = smaller(band_rows(judge), judge->shot.height - y);
    const size_t width = (size_t)judge->shot.width;
    const size_t pixels = width * (size_t)rows;
    DipSrgbPicture test, truth;
    cut_out(judge, pane, &(Rect){0, y, judge->shot.width, rows}, &test, &truth);
    PaneSums *sums = &judge->sums[pane];
    dip_difference_lin(&test, judge->rgb_lin + (size_t)y * width * 3, judge->map);
    dip_difference_squared_map(judge->map, pixels, judge->map);
    add_sum(&sums->squared_lin, dip_map_sum(judge->map, pixels, (DipPixelMask){0}));
    dip_difference_codes_map(&test, &truth, judge->map);
    add_sum(&sums->squared_codes, dip_map_sum(judge->map, pixels, (DipPixelMask){0}));
}

// A block with what FLIP looks at around it; there the picture's border is the only one that shows.
static bool judge_block(DipJudge *judge, int pane, int block) {
    const int across = (judge->shot.width + BLOCK - 1) / BLOCK;
    const int x = block % across * BLOCK, y = block / across * BLOCK;
    const int x1 = smaller(x + BLOCK, judge->shot.width);
    const int y1 = smaller(y + BLOCK, judge->shot.height);
    const int left = larger(0, x - judge->flip_margin), top = larger(0, y - judge->flip_margin);
    const Rect rect = {left, top, smaller(judge->shot.width, x1 + judge->flip_margin) - left,
                       smaller(judge->shot.height, y1 + judge->flip_margin) - top};
    DipSrgbPicture test, truth;
    cut_out(judge, pane, &rect, &test, &truth);
    DipFlip flip = {0};
    DipFlipAnalysis sides[2] = {0};
    const bool made = dip_flip_init(&flip, rect.width, rect.height, DIP_FLIP_PIXELS_PER_DEGREE) &&
                      dip_flip_analysis_init(&flip, &sides[0]) &&
                      dip_flip_analysis_init(&flip, &sides[1]);
    if (made) {
        dip_flip_analyse(&flip, &test, &sides[0]);
        dip_flip_analyse(&flip, &truth, &sides[1]);
        dip_flip_compare(&flip, &sides[0], &sides[1], judge->map);
        for (int row = y - top; row < y1 - top; row++) {
            const float *from = judge->map + (size_t)row * (size_t)rect.width + (x - left);
            add_sum(&judge->sums[pane].flip,
                    dip_map_sum(from, (size_t)(x1 - x), (DipPixelMask){0}));
        }
    }
    dip_flip_analysis_free(&sides[0]);
    dip_flip_analysis_free(&sides[1]);
    dip_flip_free(&flip);
    return made;
}

static void publish(DipJudge *judge) {
    judge->judged = -1;
    judge->result.samples = HALVES * dip_judge_samples[judge->truth_level];
    judge->result.last = judge->truth_level == DIP_JUDGE_LEVELS - 1;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const PaneSums *sums = &judge->sums[judge->shot.rgba8[p] ? p : DIP_PANE_CURRENT];
        const double rmse_lin = sqrt(dip_map_mean(sums->squared_lin));
        judge->result.panes[p] = (DipPaneError){
            .rmse_lin = rmse_lin,
            .psnr_db = dip_psnr_db(dip_map_mean(sums->squared_codes)),
            .flip = dip_map_mean(sums->flip),
            .at_floor = rmse_lin < 3.0 * judge->floor_rmse,
        };
    }
}

// Bands of a pane, blocks of a pane, the same of the next.
static bool judge_next_part(DipJudge *judge) {
    const int bands = (judge->shot.height + band_rows(judge) - 1) / band_rows(judge);
    const int blocks =
        ((judge->shot.width + BLOCK - 1) / BLOCK) * ((judge->shot.height + BLOCK - 1) / BLOCK);
    const int panes = judge->shot.rgba8[DIP_PANE_REQUESTED] ? DIP_PANE_COUNT : 1;
    const int pane = judge->judged / (bands + blocks);
    const int part = judge->judged % (bands + blocks);
    if (part < bands) {
        judge_band(judge, pane, part);
    } else if (!judge_block(judge, pane, part - bands)) {
        return false;
    }
    if (++judge->judged == panes * (bands + blocks)) {
        publish(judge);
    }
    return true;
}

DipJudgeStep dip_judge_step(DipJudge *judge, DipError *err) {
    if (!judge->has_shot) {
        return DIP_JUDGE_IDLE;
    }
    if (is_drawn(judge)) {
        finish_pixels(judge);
        if (judge->finished == pixel_count(judge)) {
            next_level(judge);
        }
        return DIP_JUDGE_WORKING;
    }
    if (judge->truth_level >= 0 && judge->judged >= 0) {
        if (!judge_next_part(judge)) {
            out_of_memory(err);
            return DIP_JUDGE_FAILED;
        }
        return judge->judged < 0 ? DIP_JUDGE_NEWS : DIP_JUDGE_WORKING;
    }
    if (judge->level == DIP_JUDGE_LEVELS) {
        return DIP_JUDGE_IDLE;
    }
    if (!judge->convergence) {
        dip_reference_set_time(judge->reference, judge->shot.time_ns);
        judge->convergence = dip_convergence_create(judge->reference, &judge->shot.pose,
                                                    judge->shot.width, judge->shot.height, err);
        return judge->convergence ? DIP_JUDGE_WORKING : DIP_JUDGE_FAILED;
    }
    return draw_next_tile(judge, err) ? DIP_JUDGE_WORKING : DIP_JUDGE_FAILED;
}

const DipJudgeResult *dip_judge_result(const DipJudge *judge) {
    return &judge->result;
}
