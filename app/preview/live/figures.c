// Computes medians of frame times four times a second, judges the pace of frames, and formats the
// panel's lines.
#include "app/preview/live/figures.h"

#include "app/files/put.h"
#include "app/measure/stats/estimate.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const int64_t second_ns = 1000000000;
static const int64_t graph_ns = 5000000000;
static const int64_t period_ns = 250000000; // Figures that change faster cannot be read.

// --- times ---------------------------------------------------------------------------------------

void dip_timing_add(DipTiming *timing, int64_t now_ns, double ms) {
    const unsigned slot = timing->count++ % DIP_TIMING_SAMPLES;
    timing->at_ns[slot] = now_ns;
    timing->ms[slot] = ms;
}

void dip_timing_clear(DipTiming *timing) {
    timing->count = 0;
}

int dip_timing_recent(const DipTiming *timing, int64_t now_ns, int64_t span_ns,
                      double ms[DIP_TIMING_SAMPLES], int64_t age_ns[DIP_TIMING_SAMPLES]) {
    const unsigned kept = timing->count < DIP_TIMING_SAMPLES ? timing->count : DIP_TIMING_SAMPLES;
    int found = 0;
    for (unsigned i = 1; i <= kept; ++i) {
        const unsigned slot = (timing->count - i) % DIP_TIMING_SAMPLES;
        if (now_ns - timing->at_ns[slot] >= span_ns) {
            break;
        }
        if (age_ns) {
            age_ns[found] = now_ns - timing->at_ns[slot];
        }
        ms[found++] = timing->ms[slot];
    }
    return found;
}

double dip_timing_median_ms(const DipTiming *timing, int64_t now_ns) {
    double ms[DIP_TIMING_SAMPLES];
    const int found = dip_timing_recent(timing, now_ns, second_ns, ms, NULL);
    if (found == 0) {
        return timing->count ? timing->ms[(timing->count - 1) % DIP_TIMING_SAMPLES] : 0.0;
    }
    return dip_percentile(ms, found, 0.5);
}

int dip_timing_per_second(const DipTiming *timing, int64_t now_ns) {
    double ms[DIP_TIMING_SAMPLES];
    return dip_timing_recent(timing, now_ns, second_ns, ms, NULL);
}

// --- the pace of temporal antialiasing -----------------------------------------------------------

DipTaaSpeed dip_taa_pace_update(DipTaaPace *pace, bool on, const DipTiming *presented,
                                int64_t refresh_ns, int64_t now_ns) {
    DipTaaSpeed speed = {.too_slow = false};
    if (!on || refresh_ns <= 0) {
        pace->on = false;
        return speed;
    }
    if (!pace->on) {
        *pace = (DipTaaPace){.on = true, .since_ns = now_ns};
    }
    speed.shown = dip_timing_per_second(presented, now_ns);
    speed.wanted = (int)((second_ns + refresh_ns / 2) / refresh_ns);
    speed.too_slow =
        now_ns - pace->since_ns >= second_ns && speed.shown < dip_taa_pace_share * speed.wanted;
    return speed;
}

int64_t dip_taa_pace_next_ns(int64_t due_ns, int64_t turn_ns, int64_t refresh_ns, int64_t now_ns) {
    const int64_t next_ns = due_ns + refresh_ns;
    return next_ns > now_ns && next_ns <= now_ns + refresh_ns ? next_ns : turn_ns + refresh_ns;
}

// --- figures -------------------------------------------------------------------------------------

void dip_figures_forget(DipFigures *figures, int pane) {
    dip_timing_clear(&figures->total[pane]);
    for (int s = 0; s < DIP_TIMED_PARTS; ++s) {
        dip_timing_clear(&figures->stages[pane][s]);
    }
    figures->shown[pane].frames = 0;
    figures->outdated = true;
}

bool dip_figures_have_times(const DipFigures *figures) {
    bool have = true;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        have = have && figures->total[p].count > 0;
    }
    return have;
}

void dip_figures_add(DipFigures *figures, const DipSessionFrame *frame, int64_t now_ns) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (frame->panes[p].counters.fragments_copied) {
            continue;
        }
        figures->shown[p].effects = frame->panes[p].effects;
        figures->shown[p].counters = frame->panes[p].counters;
        figures->shown[p].copied = p == DIP_PANE_REQUESTED && frame->copied;
        const DipStageTimes *times = &frame->panes[p].stages;
        DipTiming *stage = figures->stages[p];
        dip_timing_add(&figures->total[p], now_ns, times->total_ms);
#define ADD_STAGE(name, text) dip_timing_add(stage++, now_ns, times->name##_ms);
        DIP_STAGE_LIST(ADD_STAGE)
#undef ADD_STAGE
    }
}

void dip_figures_count_presented(DipFigures *figures, bool moving, int64_t refresh_ns,
                                 int64_t now_ns) {
    dip_timing_add(&figures->presented, now_ns, 0.0);
    if (moving && figures->presented_ns && refresh_ns > 0) {
        const int64_t refreshes =
            (now_ns - figures->presented_ns + refresh_ns / 2) / refresh_ns - 1;
        if (refreshes > 0) {
            dip_timing_add(&figures->dropped, now_ns, (double)refreshes);
        }
    }
    figures->presented_ns = moving ? now_ns : 0;
}

static int count_dropped(const DipFigures *figures, int64_t now_ns) {
    double numbers[DIP_TIMING_SAMPLES];
    double dropped = 0.0;
    const int count = dip_timing_recent(&figures->dropped, now_ns, graph_ns, numbers, NULL);
    for (int i = 0; i < count; ++i) {
        dropped += numbers[i];
    }
    return (int)dropped;
}

// Sets a pane's shown time to the median of the last second. If no frame was drawn in that second,
// the previous median stays, unless the pane's times were forgotten. Returns whether the median is
// new.
static bool follow_median(DipPaneFigures *shown, const DipTiming *total, int64_t now_ns) {
    const int frames = dip_timing_per_second(total, now_ns);
    if (frames == 0 && shown->frames > 0) {
        return false;
    }
    shown->ms = dip_timing_median_ms(total, now_ns);
    shown->frames = frames == 0 && total->count > 0 ? 1 : frames;
    return true;
}

void dip_figures_update(DipFigures *figures, bool moving, int64_t now_ns) {
    if (!figures->outdated && now_ns - figures->updated_ns < period_ns) {
        return;
    }
    figures->outdated = false;
    figures->updated_ns = now_ns;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipPaneFigures *shown = &figures->shown[p];
        shown->times = &figures->total[p];
        shown->fps = moving ? dip_timing_per_second(&figures->presented, now_ns) : 0;
        shown->dropped = count_dropped(figures, now_ns);
        if (!follow_median(shown, &figures->total[p], now_ns)) {
            continue;
        }
        for (int s = 0; s < DIP_TIMED_PARTS; ++s) {
            shown->stage_ms[s] = dip_timing_median_ms(&figures->stages[p][s], now_ns);
        }
    }
}

// --- the panel's lines ---------------------------------------------------------------------------

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
    static const char *const names[DIP_TIMED_PARTS] = {"Geometry", "Raster", "Shading", "Resolve"};
    double sum = 0.0;
    for (int s = 0; s < DIP_TIMED_PARTS; s++) {
        sum += figures->stage_ms[s];
    }
    add(lines, true, figures->frames == 1 ? "One frame" : "Frame, last second", "%.1f ms",
        figures->ms);
    for (int s = 0; s < DIP_TIMED_PARTS; s++) {
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
    // The finest truth is the mean of two halves with DIP_TRUTH_SAMPLES samples each.
    const int all_samples = 2 * DIP_TRUTH_SAMPLES;
    if (result->last) {
        add(lines, true, "Error", "%d samples", result->samples);
    } else {
        add(lines, true, "Error", "refining: %d of %d samples", result->samples, all_samples);
    }
    // The noise of the truth shrinks with more samples. An error that cannot be told from the noise
    // so far may stand out later.
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

// --- effects -------------------------------------------------------------------------------------

typedef struct Effect {
    const char *title;
    DipEffect effect;
} Effect;

#define COUNT_EFFECT(name, title) +1
enum { EFFECT_COUNT = DIP_EFFECT_LIST(COUNT_EFFECT) };
#undef COUNT_EFFECT

static void list_effects(const DipEffects *effects, Effect list[EFFECT_COUNT]) {
    int count = 0;
#define LIST_EFFECT(name, title) list[count++] = (Effect){title, effects->name};
    DIP_EFFECT_LIST(LIST_EFFECT)
#undef LIST_EFFECT
}

// Returns whether two effects ran, or did not run for the same reason.
static bool is_alike(const DipEffect *a, const DipEffect *b) {
    return a->run == b->run && (a->run || strcmp(a->why, b->why) == 0);
}

// Returns whether the scene has an effect, and a frame has said whether it ran.
static bool is_in_scene(const DipEffect *effect) {
    static const char lacks[] = "the scene has no ";
    return effect->why && strncmp(effect->why, lacks, strlen(lacks)) != 0;
}

// Appends the titles of all effects that are like the first one, and for effects that did not run
// the reason.
static void add_alike(const Effect *first, const Effect *end, char text[DIP_EFFECTS_TEXT_BYTES]) {
    const char *before = first->effect.run ? "Effects that ran: " : "";
    for (const Effect *e = first; e < end; e++) {
        if (is_in_scene(&e->effect) && is_alike(&e->effect, &first->effect)) {
            dip_put_append(text, DIP_EFFECTS_TEXT_BYTES, "%s%s", before, e->title);
            before = ", ";
        }
    }
    if (!first->effect.run) {
        dip_put_append(text, DIP_EFFECTS_TEXT_BYTES, ": %s", first->effect.why);
    }
}

void dip_effects_text(const DipEffects *effects, char text[DIP_EFFECTS_TEXT_BYTES]) {
    Effect list[EFFECT_COUNT];
    list_effects(effects, list);
    text[0] = '\0';
    for (int run = 1; run >= 0; run--) {
        for (int i = 0; i < EFFECT_COUNT; i++) {
            bool is_first = list[i].effect.run == run && is_in_scene(&list[i].effect);
            for (int j = 0; j < i && is_first; j++) {
                is_first =
                    !is_in_scene(&list[j].effect) || !is_alike(&list[i].effect, &list[j].effect);
            }
            if (is_first) {
                dip_put_append(text, DIP_EFFECTS_TEXT_BYTES, "%s", text[0] ? "\n" : "");
                add_alike(&list[i], list + EFFECT_COUNT, text);
            }
        }
    }
}

static void add_effects(Lines *lines, const DipEffects *effects) {
    Effect list[EFFECT_COUNT];
    int count = 0;
    list_effects(effects, list);
    for (int i = 0; i < EFFECT_COUNT; i++) {
        count += list[i].effect.run;
    }
    add(lines, true, "Effects that ran", "%d", count);
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
        add_effects(&all, &figures->effects);
    }
    return all.count;
}
