// Formats the panel's lines of times, errors and work.
#include "app/preview/live/panel.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

typedef struct Lines {
    DipPanelLine *items;
    int count;
} Lines;

__attribute__((format(printf, 4, 5))) static void add(Lines *lines, bool head, const char *name,
                                                      const char *format, ...) {
    DIP_ASSERT(lines->count < DIP_PANEL_MAX_LINES);
    DipPanelLine *line = &lines->items[lines->count++];
    va_list arguments;
    line->head = head;
    snprintf(line->name, sizeof line->name, "%s", name);
    va_start(arguments, format);
    vsnprintf(line->value, sizeof line->value, format, arguments);
    va_end(arguments);
}

static void add_times(Lines *lines, const DipPaneFigures *figures) {
    static const char *const names[DIP_STAGE_COUNT] = {"Geometry", "Raster", "Shading", "Resolve"};
    double sum = 0.0;
    for (int s = 0; s < DIP_STAGE_COUNT; s++) {
        sum += figures->stage_ms[s];
    }
    add(lines, true, figures->frames == 1 ? "One frame" : "Frame, last second", "%.1f ms",
        figures->ms);
    for (int s = 0; s < DIP_STAGE_COUNT; s++) {
        add(lines, false, names[s], "%.2f ms %3.0f %%", figures->stage_ms[s],
            sum > 0.0 ? 100.0 * figures->stage_ms[s] / sum : 0.0);
    }
}

static void add_error(Lines *lines, const DipPaneFigures *figures, int pane) {
    const DipErrorReading *errors = &figures->errors;
    const DipErrorJobResult *result = &errors->result;
    const DipPaneError *error = &result->panes[pane];
    if (figures->mip_colours || error->unjudged) {
        add(lines, true, "Error", "none, since mip colours show");
        return;
    }
    if (errors->status == DIP_ERROR_STATUS_PAUSED) {
        add(lines, true, "Error", "pause to measure");
        return;
    }
    if (errors->status == DIP_ERROR_STATUS_FAILED) {
        add(lines, true, "Error", "not enough memory");
        return;
    }
    if (result->samples == 0) {
        add(lines, true, "Error", "measuring");
        return;
    }
    // The truth is the mean of two halves with equal numbers of samples.
    const int all_samples = 2 * DIP_TRUTH_SAMPLES;
    if (result->last) {
        add(lines, true, "Error", "%d samples", result->samples);
    } else {
        add(lines, true, "Error", "refining: %d of %d samples", result->samples, all_samples);
    }
    // A coarse truth is noisy, so an error that lies in its noise may prove to be larger.
    const char *const floor = result->last ? " at floor" : " at floor so far";
    add(lines, false, "RMSE, linear", "%.4f%s", error->rmse_lin, error->at_floor ? floor : "");
    if (isinf(error->psnr_db)) {
        add(lines, false, "PSNR", "no difference");
    } else {
        add(lines, false, "PSNR", "%.1f dB", error->psnr_db);
    }
    add(lines, false, "FLIP", "%.4f", error->flip);
}

static void add_count(Lines *lines, bool head, const char *name, uint64_t count) {
    if (count < 100000) {
        add(lines, head, name, "%llu", (unsigned long long)count);
    } else if (count < 1000000) {
        add(lines, head, name, "%.1f k", 1e-3 * (double)count);
    } else {
        add(lines, head, name, "%.2f M", 1e-6 * (double)count);
    }
}

static void add_work(Lines *lines, const DipCounters *counters) {
    add_count(lines, true, "Fragments shaded", counters->fragments_shaded);
    add_count(lines, false, "Visible samples", counters->samples_shown);
    add_count(lines, false, "Texels read", counters->texels_fetched);
    add_count(lines, false, "Texture probes", counters->texture_probes);
    add_count(lines, false, "Triangles drawn", counters->triangles_drawn);
    add_count(lines, false, "Triangles submitted", counters->triangles_in);
    add_count(lines, false, "Pixels resolved", counters->pixels_resolved);
    add_count(lines, false, "Tiles drawn", counters->tiles_drawn);
    add_count(lines, false, "Objects in view", counters->draws_in_view);
    add_count(lines, false, "Objects culled", counters->draws_culled);
}

int dip_panel_lines(const DipPaneFigures *figures, int pane,
                    DipPanelLine lines[DIP_PANEL_MAX_LINES]) {
    Lines all = {.items = lines};
    if (figures->copied) {
        add(&all, true, "Frame", "copied: same settings");
    } else {
        add_times(&all, figures);
    }
    if (!figures->no_errors) {
        add_error(&all, figures, pane);
    }
    if (!figures->copied) {
        add_work(&all, &figures->counters);
    }
    return all.count;
}
