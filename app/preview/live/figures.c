// Computes medians of frame times, four times a second.
#include "app/preview/live/figures.h"

static const int64_t graph_ns = 5000000000;
static const int64_t period_ns = 250000000; // Figures that change faster cannot be read.

void dip_figures_forget(DipFigures *figures, int pane) {
    dip_timing_clear(&figures->total[pane]);
    for (int s = 0; s < DIP_STAGE_COUNT; ++s) {
        dip_timing_clear(&figures->stages[pane][s]);
    }
    figures->shown[pane].frames = 0;
    figures->outdated = true;
}

static void add_times(DipFigures *figures, int pane, const DipStageTimes *times, int64_t now_ns) {
    DipTiming *stage = figures->stages[pane];
    dip_timing_add(&figures->total[pane], now_ns, times->total_ms);
#define ADD_STAGE(name, text) dip_timing_add(stage++, now_ns, times->name##_ms);
    DIP_STAGE_LIST(ADD_STAGE)
#undef ADD_STAGE
}

void dip_figures_add(DipFigures *figures, const DipSessionFrame *frame, int64_t now_ns) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        figures->shown[p].effects = frame->panes[p].effects;
        figures->shown[p].counters = frame->panes[p].counters;
        figures->shown[p].copied = p == DIP_PANE_REQUESTED && frame->copied;
        add_times(figures, p, &frame->panes[p].stages, now_ns);
    }
}

void dip_figures_count_presented(DipFigures *figures, bool moving, int64_t refresh_ns,
                                 int64_t now_ns) {
    dip_timing_add(&figures->presented, now_ns, 0.0);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        figures->shown[p].budget_ms = 1e-6 * (double)refresh_ns;
    }
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
    double ms[DIP_TIMING_SAMPLES];
    int64_t age_ns[DIP_TIMING_SAMPLES];
    double dropped = 0.0;
    const int count = dip_timing_recent(&figures->dropped, now_ns, graph_ns, ms, age_ns);
    for (int i = 0; i < count; ++i) {
        dropped += ms[i];
    }
    return (int)dropped;
}

// Takes the median of the last second. If no frame was drawn in it, the median before stays, unless
// the settings have changed since. Returns whether the median is new.
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
        for (int s = 0; s < DIP_STAGE_COUNT; ++s) {
            shown->stage_ms[s] = dip_timing_median_ms(&figures->stages[p][s], now_ns);
        }
    }
}
