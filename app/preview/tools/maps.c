// Measures the work of the panes' frames with a painter of the maps' own, and keeps the newest
// errors from the error thread.
#include "app/preview/tools/maps.h"

#include "app/measure/stats/estimate.h"
#include "app/preview/tools/compare.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_DRAWS = 3 }; // Every pane is drawn this often before any pane is drawn more often.

static void free_work(DipMapWork *work) {
    free(work->records);
    free(work->draws_ms);
    free(work->ms);
    free(work->mixed);
    free(work->mips);
    *work = (DipMapWork){0};
}

void dip_maps_free(DipMaps *maps) {
    dip_painter_destroy(&maps->painter);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        free_work(&maps->panes[p]);
        dip_canvas_free(&maps->pictures[p].canvas);
    }
}

// --- errors --------------------------------------------------------------------------------------

bool dip_maps_need_errors(const DipToolState *tools) {
    return tools->map == DIP_MAP_FLIP || dip_compare_wants_truth(tools);
}

void dip_maps_set_errors(DipMaps *maps, const DipErrorReading *reading,
                         const DipErrorPictures *pictures) {
    maps->reading = *reading;
    maps->errors = pictures;
}

const DipPixels *dip_maps_truth(DipMaps *maps, uint64_t *version) {
    const DipErrorPictures *errors = maps->errors;
    if (!errors) {
        return NULL;
    }
    maps->truth =
        (DipPixels){errors->truth_rgba8, 4 * (size_t)errors->width, errors->width, errors->height};
    *version = DIP_MAP_TRUTH_VERSION + errors->version;
    return &maps->truth;
}

// --- measuring work ------------------------------------------------------------------------------

static bool make_arrays(DipMapWork *work, const DipFrame *frame) {
    const size_t tiles = (size_t)frame->tiles.across * (size_t)frame->tiles.down;
    work->width = frame->width;
    work->height = frame->height;
    work->across = frame->tiles.across;
    work->down = frame->tiles.down;
    work->records = malloc(tiles * sizeof *work->records);
    work->draws_ms = malloc(tiles * DIP_MAP_DRAWS * sizeof *work->draws_ms);
    work->ms = malloc(tiles * sizeof *work->ms);
    work->mixed = malloc((size_t)frame->width * (size_t)frame->height);
    if (!work->records || !work->draws_ms || !work->ms || !work->mixed) {
        free_work(work);
        return false;
    }
    return true;
}

// Adds a draw of a pane's frame. Keeps its times beside those of the earlier draws. Its counters
// replace the earlier ones, since each draw of a frame does the same work.
static bool add_draw(DipMapWork *work, const DipFrame *frame) {
    if (!frame->tiles.records || (!work->records && !make_arrays(work, frame))) {
        return false; // Frames with a render scale have no records of tiles. Otherwise, memory ran
                      // out.
    }
    const int tiles = work->across * work->down;
    const int draw = work->draws++;
    memcpy(work->records, frame->tiles.records, (size_t)tiles * sizeof *work->records);
    memcpy(work->mixed, frame->tiles.mixed, (size_t)work->width * (size_t)work->height);
    work->mirrored_ms = frame->tiles.mirrored_times.total_ms;
    work->geometry_ms = frame->stages.geometry_ms - frame->tiles.mirrored_times.geometry_ms;
    for (int t = 0; t < tiles; t++) {
        const DipTileRecord *record = &work->records[t];
        double *draws_ms = work->draws_ms + (size_t)t * DIP_MAP_DRAWS, scratch[DIP_MAP_DRAWS];
        draws_ms[draw] =
            1e-6 * (double)(record->raster_ns + record->shading_ns + record->resolve_ns);
        work->ms[t] = dip_percentile_of(draws_ms, work->draws, 0.5, scratch);
    }
    return true;
}

static bool keep_mips(DipMapWork *work, const DipFrame *frame) {
    const size_t row_bytes = 4 * (size_t)frame->width;
    work->mips = malloc(row_bytes * (size_t)frame->height);
    work->width = frame->width;
    work->height = frame->height;
    for (int y = 0; work->mips && y < frame->height; y++) {
        memcpy(work->mips + (size_t)y * row_bytes, frame->rgba8 + (size_t)y * frame->stride_bytes,
               row_bytes);
    }
    return work->mips != NULL;
}

// Forgets all measurements if the panes no longer show the frames that were measured.
static void follow_frames(DipMaps *maps, const DipToolsInput *input) {
    DipMapKey key;
    memset(&key, 0, sizeof key); // Clears the padding, which memcmp compares, too.
    key.pose = *input->pose;
    key.play_ns = input->play_ns;
    key.scene = input->session->scene;
    key.gallery = input->session->gallery;
    key.width = input->width;
    key.height = input->height;
    key.copied = input->copied;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipQuality quality = dip_painter_quality(input->session->renderers[p]);
        // Temporal antialiasing changes the picture from frame to frame, so the picture's version
        // does not count.
        const bool steady = quality.step[DIP_SETTING_TAA] == 0;
        memcpy(&key.quality[p], &quality, sizeof quality);
        key.versions[p] = steady ? input->versions[p] : 0;
    }
    if (memcmp(&key, &maps->key, sizeof key) == 0) {
        return;
    }
    if (key.gallery != maps->key.gallery || key.scene != maps->key.scene) {
        dip_painter_destroy(&maps->painter);
    }
    maps->key = key;
    maps->failed = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        free_work(&maps->panes[p]);
    }
    maps->generation++;
}

// Makes the maps' painter, or gives it the settings and the size of a pane.
static bool prepare_painter(DipMaps *maps, const DipToolsInput *input, const DipQuality *quality) {
    DipSession *session = input->session;
    DipGallery *gallery = session->shows_gallery ? session->gallery : NULL;
    DipError err;
    if (maps->painter) {
        return dip_painter_set_quality(maps->painter, quality, &err) &&
               dip_painter_resize(maps->painter, input->width, input->height, &err);
    }
    maps->painter =
        dip_session_make_painter(session, gallery, quality, input->width, input->height, &err);
    return maps->painter && (gallery || dip_painter_record_tiles(maps->painter, true, &err));
}

static bool draw(DipMaps *maps, const DipToolsInput *input, int pane) {
    DipQuality quality = dip_painter_quality(input->session->renderers[pane]);
    DipFrame frame;
    DipError err;
    if (maps->wanted == DIP_MAP_MIPS) {
        quality.step[DIP_SETTING_MIPDEBUG] = 1;
    }
    if (!prepare_painter(maps, input, &quality)) {
        return false;
    }
    dip_painter_set_frame_index(maps->painter, input->frame_index);
    if (!dip_painter_draw(maps->painter, input->session->scene, input->pose, input->play_ns, &frame,
                          &err)) {
        return false;
    }
    return maps->wanted == DIP_MAP_MIPS ? keep_mips(&maps->panes[pane], &frame)
                                        : add_draw(&maps->panes[pane], &frame);
}

// Returns how many draws of a pane are missing until it has `wanted_draws` draws for the wanted
// map; 0 or less if none is missing. The map of mip levels always needs one draw.
static int draws_left(const DipMaps *maps, int pane, int wanted_draws) {
    const DipMapWork *work = &maps->panes[pane];
    if (pane == DIP_PANE_REQUESTED && maps->key.copied) {
        return 0;
    }
    if (maps->wanted == DIP_MAP_MIPS) {
        return work->mips ? 0 : 1;
    }
    if (maps->key.quality[pane].step[DIP_SETTING_SCALE] != DIP_SCALE_1) {
        return 0; // With a render scale, the tiles that are drawn are not tiles of the frame.
    }
    return wanted_draws - work->draws;
}

// Returns the pane to draw next, or -1 if the wanted map is complete.
static int next_pane(const DipMaps *maps) {
    const int all = maps->wanted == DIP_MAP_TIME ? DIP_MAP_DRAWS : 1;
    const int wanted[] = {dip_min(all, FIRST_DRAWS), all};
    for (int i = 0; i < 2 * DIP_PANE_COUNT; i++) {
        if (draws_left(maps, i % DIP_PANE_COUNT, wanted[i / DIP_PANE_COUNT]) > 0) {
            return i % DIP_PANE_COUNT;
        }
    }
    return -1;
}

bool dip_maps_update(DipMaps *maps, const DipToolsInput *input) {
    const bool draws = maps->wanted != DIP_MAP_NONE && maps->wanted != DIP_MAP_FLIP;
    if (!draws || !input->still ||
        (input->session->shows_gallery && maps->wanted != DIP_MAP_MIPS)) {
        return false;
    }
    follow_frames(maps, input);
    const int pane = next_pane(maps);
    if (pane < 0 || maps->failed) {
        return false;
    }
    maps->failed = !draw(maps, input, pane);
    maps->generation++;
    return true;
}

// --- what is known -------------------------------------------------------------------------------

const DipMapWork *dip_maps_work(const DipMaps *maps, int pane) {
    return &maps->panes[maps->key.copied ? DIP_PANE_CURRENT : pane];
}

int dip_map_tile(const DipMapWork *work, int x, int y) {
    return y / DIP_TARGET_TILE * work->across + x / DIP_TARGET_TILE;
}

int dip_map_tile_pixels(const DipMapWork *work, int tile) {
    const int x = tile % work->across * DIP_TARGET_TILE;
    const int y = tile / work->across * DIP_TARGET_TILE;
    return dip_min(work->width - x, DIP_TARGET_TILE) * dip_min(work->height - y, DIP_TARGET_TILE);
}

double dip_map_value(const DipMapWork *work, DipMap map, int tile) {
    const DipPipelineCounters *counters = &work->records[tile].counters;
    const double pixels = dip_map_tile_pixels(work, tile);
    switch (map) {
    case DIP_MAP_TIME:
        return work->ms[tile];
    case DIP_MAP_FRAGMENTS:
        return (double)(counters->fragments_shaded + counters->fragments_ordered) / pixels;
    case DIP_MAP_PROBES:
        return (double)counters->texture_probes / pixels;
    case DIP_MAP_SAMPLES:
        return (double)counters->pixels_resolved / pixels;
    default:
        return 0.0;
    }
}

double dip_maps_end(const DipMaps *maps, const DipToolState *tools) {
    double greatest = tools->map == DIP_MAP_FLIP ? 1.0 : 0.0;
    for (int p = 0; p < DIP_PANE_COUNT && tools->map != DIP_MAP_FLIP; p++) {
        const DipMapWork *work = dip_maps_work(maps, p);
        for (int t = 0; work->draws && t < work->across * work->down; t++) {
            const double value = dip_map_value(work, tools->map, t);
            greatest = value > greatest ? value : greatest;
        }
    }
    return dip_map_round_up(greatest) / dip_max(1, tools->brightness);
}
