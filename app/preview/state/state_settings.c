// Changes settings by steps, presets, advice and undo, and describes settings in words.
#include "app/preview/state/state_private.h"

#include "app/files/put.h"
#include "renderer/base/assert.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int dip_preview_category_of(DipSetting setting) {
    static const int categories[DIP_SETTING_COUNT] = {
        [DIP_SETTING_AA] = DIP_CATEGORY_AA,
        [DIP_SETTING_TAA] = DIP_CATEGORY_TAA,
        [DIP_SETTING_AAA] = DIP_CATEGORY_AAA,
        [DIP_SETTING_ASD] = DIP_CATEGORY_AAA,
        [DIP_SETTING_AF] = DIP_CATEGORY_AF,
        [DIP_SETTING_AAF] = DIP_CATEGORY_AAF,
        [DIP_SETTING_OPT] = DIP_CATEGORY_CAI,
        [DIP_SETTING_MIPLOD] = DIP_CATEGORY_MIPLOD,
        [DIP_SETTING_SCALE] = -1,   // Any path shows it.
        [DIP_SETTING_UPSCALE] = -1, // Any path shows it.
        [DIP_SETTING_POST] = DIP_CATEGORY_AA,
        [DIP_SETTING_SHARPEN] = -1, // Any path shows it.
        [DIP_SETTING_SHADOWS] = -1, // Any path shows it.
        [DIP_SETTING_GI] = DIP_CATEGORY_GI,
        [DIP_SETTING_MIPDEBUG] = -1, // Any path shows it.
    };
    return categories[setting];
}

// Saves both panes' settings before a change, and forgets the changes that have been undone.
static void remember(DipPreviewState *state) {
    if (state->undo_count == DIP_UNDO_DEPTH) {
        memmove(state->undo[0], state->undo[1], (DIP_UNDO_DEPTH - 1) * sizeof state->undo[0]);
        state->undo_count--;
    }
    memcpy(state->undo[state->undo_count++], state->quality, sizeof state->quality);
    state->redo_count = 0;
}

static void swap_settings(DipPreviewState *state, int slot) {
    DipQuality held[DIP_PANE_COUNT];
    memcpy(held, state->undo[slot], sizeof held);
    memcpy(state->undo[slot], state->quality, sizeof held);
    memcpy(state->quality, held, sizeof held);
    ++state->scene_changes;
}

void dip_state_undo(const DipAct *act) {
    DipPreviewState *state = act->state;
    const bool reverse = act->reverse;
    if (reverse ? state->redo_count == 0 : state->undo_count == 0) {
        dip_preview_notice(state, act->now_ns, reverse ? "Nothing to do again" : "Nothing to undo");
        return;
    }
    if (reverse) {
        swap_settings(state, state->undo_count);
        state->undo_count++;
        state->redo_count--;
    } else {
        state->undo_count--;
        state->redo_count++;
        swap_settings(state, state->undo_count);
    }
    dip_preview_notice(state, act->now_ns,
                       reverse ? "Made the change again" : "Took the change back");
}

// Shows a notice with the new step of a setting. While the camera follows a path, switches to the
// path that shows the setting best. A camera that is paused or free stays where it is.
static void follow_setting(DipPreviewState *state, DipSetting setting, const char *step,
                           int64_t now_ns) {
    const int category = dip_preview_category_of(setting);
    const DipCamPath *before = dip_preview_playing_path(state);
    if (category >= 0 && !state->manual && !state->paused) {
        dip_camtrack_switch(state->track, category, state->play_ns);
    }
    const bool moved = dip_preview_playing_path(state) != before;
    dip_preview_notice(state, now_ns, "%s: %s%s%s", dip_setting_info(setting)->title, step,
                       moved ? ", on the path " : "",
                       moved ? dip_preview_path_title(state, state->track->active) : "");
    ++state->scene_changes;
}

// Gives a setting a step. If the setting is AA and the new number of samples does not fit the group
// size of adaptive AA, also resets the group size to its default. Returns whether the settings are
// valid then.
static bool take_step(DipQuality *quality, DipSetting setting, int step, DipError *err) {
    quality->step[setting] = (uint8_t)step;
    if (setting == DIP_SETTING_AA && !dip_quality_check(quality, NULL)) {
        quality->step[DIP_SETTING_ASD] = dip_quality_default().step[DIP_SETTING_ASD];
    }
    return dip_quality_check(quality, err);
}

// Gives a setting the next step that is valid with the other settings or, with `reverse`, the valid
// step before. Steps wrap around. Returns false if no other step is valid.
static bool cycle(DipQuality *quality, DipSetting setting, bool reverse) {
    const DipSettingInfo *info = dip_setting_info(setting);
    DipQuality candidate;
    for (int i = 1; i < info->step_count; ++i) {
        const int offset = reverse ? info->step_count - i : i;
        const int step = (quality->step[setting] + offset) % info->step_count;
        candidate = *quality;
        if (take_step(&candidate, setting, step, NULL)) {
            *quality = candidate;
            return true;
        }
    }
    return false;
}

// Gives the panes the settings `wanted` if these differ from the old ones. `step` is the name of
// the new step of `setting`, for the notice.
static void take_settings(DipPreviewState *state, const DipQuality wanted[DIP_PANE_COUNT],
                          DipSetting setting, const char *step, int64_t now_ns) {
    if (memcmp(wanted, state->quality, sizeof state->quality) != 0) {
        remember(state);
        memcpy(state->quality, wanted, sizeof state->quality);
        follow_setting(state, setting, step, now_ns);
    }
}

void dip_preview_set_step(DipPreviewState *state, DipSetting setting, int step, int64_t now_ns) {
    DipQuality wanted[DIP_PANE_COUNT];
    DipError err;
    memcpy(wanted, state->quality, sizeof wanted);
    for (int pane = 0; pane < DIP_PANE_COUNT; ++pane) {
        if (state->edited[pane] && !take_step(&wanted[pane], setting, step, &err)) {
            dip_preview_notice(state, now_ns, "%s", err.message);
            return;
        }
    }
    state->open_setting = setting;
    take_settings(state, wanted, setting, dip_setting_info(setting)->steps[step], now_ns);
}

void dip_state_change_setting(const DipAct *act) {
    DipPreviewState *state = act->state;
    const DipSetting setting = (DipSetting)act->argument;
    const DipSettingInfo *info = dip_setting_info(setting);
    const char *step = NULL;
    DipQuality wanted[DIP_PANE_COUNT];
    memcpy(wanted, state->quality, sizeof wanted);
    for (int pane = 0; pane < DIP_PANE_COUNT; ++pane) {
        if (state->edited[pane] && cycle(&wanted[pane], setting, act->reverse)) {
            step = info->steps[wanted[pane].step[setting]];
        }
    }
    if (!step) {
        dip_preview_notice(state, act->now_ns, "%s: no other step fits the other settings",
                           info->title);
        return;
    }
    state->open_setting = setting;
    take_settings(state, wanted, setting, step, act->now_ns);
}

void dip_preview_set_quality(DipPreviewState *state, int pane, const DipQuality *quality,
                             int64_t now_ns) {
    char text[96];
    if (!dip_quality_equal(&state->quality[pane], quality)) {
        remember(state);
        state->quality[pane] = *quality;
        dip_preview_describe(quality, true, text, sizeof text);
        dip_preview_notice(state, now_ns, "%s: %s", dip_pane_titles[pane], text);
        ++state->scene_changes;
    }
}

bool dip_preview_preset(const DipPreviewState *state, DipPreset preset, DipQuality *quality) {
    const DipPreviewChoice *choice = state->choice;
    switch (preset) {
    case DIP_PRESET_INI:
        *quality = state->begun_quality[DIP_PANE_REQUESTED];
        return true;
    case DIP_PRESET_CURRENT:
        *quality = state->quality[DIP_PANE_CURRENT];
        return true;
    default:
        if (!dip_preview_advised(choice)) {
            return false;
        }
        *quality = choice->candidates.list[choice->presets[preset]].quality;
        return true;
    }
}

const char *dip_preview_preset_name(DipPreset preset) {
    static const char *const names[DIP_PRESET_COUNT] = {"Performance", "Balanced",    "Quality",
                                                        "Best",        "As at start", "As current"};
    return names[preset];
}

void dip_state_choose_preset(const DipAct *act) {
    DipPreviewState *state = act->state;
    const DipPreset preset = (DipPreset)act->argument;
    DipQuality quality;
    char why[DIP_NOTICE_SIZE];
    if (!dip_preview_preset(state, preset, &quality)) {
        dip_preview_choice_why(state->choice, "", why, sizeof why);
        dip_preview_notice(state, act->now_ns, "%s: %.120s", dip_preview_preset_name(preset), why);
        return;
    }
    dip_preview_set_quality(state, DIP_PANE_REQUESTED, &quality, act->now_ns);
    dip_preview_notice(state, act->now_ns, "Requested: %s", dip_preview_preset_name(preset));
}

void dip_state_choose_pane(const DipAct *act) {
    bool *edited = act->state->edited;
    const bool both = edited[DIP_PANE_CURRENT] && edited[DIP_PANE_REQUESTED];
    const bool current_only = edited[DIP_PANE_CURRENT] && !both;
    edited[DIP_PANE_REQUESTED] = both || current_only;
    edited[DIP_PANE_CURRENT] = !both;
    const char *which = edited[0] && edited[1] ? "both panes"
                        : edited[0]            ? "the current pane"
                                               : "the requested pane";
    dip_preview_notice(act->state, act->now_ns, "Keys change %s", which);
}

void dip_state_apply(const DipAct *act) {
    dip_preview_set_quality(act->state, DIP_PANE_CURRENT, &act->state->quality[DIP_PANE_REQUESTED],
                            act->now_ns);
    dip_preview_notice(act->state, act->now_ns, "Copied requested to current");
}

// --- budgets and advice --------------------------------------------------------------------------

int dip_preview_budgets(const DipPreviewState *state, double list[DIP_COST_MAX_BUDGETS]) {
    static const double usual_ms[] = {1000.0 / 240.0, 1000.0 / 120.0, 1000.0 / 60.0, 1000.0 / 30.0};
    const bool has_report = state->costs && state->costs->options.budget_count > 0;
    const int count =
        has_report ? state->costs->options.budget_count : (int)DIP_ARRAY_COUNT(usual_ms);
    memcpy(list, has_report ? state->costs->options.budgets_ms : usual_ms,
           (size_t)count * sizeof *list);
    return count;
}

void dip_preview_set_budget(DipPreviewState *state, double budget_ms) {
    state->has_budget = budget_ms > 0.0;
    state->budget_ms = state->has_budget ? fmin(fmax(budget_ms, 1.0), 1000.0) : state->refresh_ms;
    if (state->choice) {
        dip_preview_choice_set_budget(state->choice, state->budget_ms);
    }
}

void dip_preview_step_frame_rate(DipPreviewState *state, int steps) {
    static const int rates[] = {24, 25, 30, 50, 60, 72, 90, 120, 144, 165, 240};
    const int count = (int)DIP_ARRAY_COUNT(rates);
    for (; steps != 0; steps += steps > 0 ? -1 : 1) {
        const double now = 1000.0 / state->budget_ms;
        int next = steps > 0 ? 0 : count - 1;
        while (next >= 0 && next < count &&
               (steps > 0 ? rates[next] <= now * 1.001 : rates[next] >= now * 0.999)) {
            next += steps > 0 ? 1 : -1;
        }
        if (next >= 0 && next < count) {
            dip_preview_set_budget(state, 1000.0 / rates[next]);
        }
    }
}

void dip_preview_follow_refresh(DipPreviewState *state, double refresh_ms) {
    state->refresh_ms = refresh_ms;
    if (!state->has_budget) {
        state->budget_ms = refresh_ms;
    }
}

// Goes on to the next budget of the list, or to the first one if the present budget is not in it.
static void next_budget(DipPreviewState *state) {
    double list[DIP_COST_MAX_BUDGETS];
    const int count = dip_preview_budgets(state, list);
    int at = count - 1;
    for (int i = 0; i < count; ++i) {
        at = fabs(list[i] - state->budget_ms) < 1e-9 ? i : at;
    }
    dip_preview_set_budget(state, list[(at + 1) % count]);
}

void dip_state_take_advice(const DipAct *act) {
    DipPreviewState *state = act->state;
    const int64_t now_ns = act->now_ns;
    char text[DIP_NOTICE_SIZE];
    if (state->choice && act->reverse) {
        next_budget(state);
    }
    const DipCandidate *advised = dip_preview_advised(state->choice);
    if (advised) {
        const unsigned changes = state->scene_changes;
        dip_preview_set_quality(state, DIP_PANE_REQUESTED, &advised->quality, now_ns);
        state->scene_changes = changes + 1;
    }
    const DipCostReport *costs = state->choice && !state->choice->live ? state->costs : NULL;
    if (!state->choice) {
        snprintf(text, sizeof text, "Nothing is measured yet; U says how to make a cost report");
    } else {
        dip_preview_choice_describe(state->choice, text, sizeof text);
    }
    if (costs && state->pane_width > 0 &&
        (state->pane_width != costs->width || state->pane_height != costs->height)) {
        dip_preview_notice(state, now_ns, "%s (measured at %dx%d)", text, costs->width,
                           costs->height);
    } else {
        dip_preview_notice(state, now_ns, "%s", text);
    }
    state->notice_end_ns =
        now_ns + 2 * dip_state_notice_ns; // This text takes longer to read than other notices.
}

// --- texts ---------------------------------------------------------------------------------------

// The short forms of settings, in which %s stands for the step. A short form without %s names a
// setting that is on; "no" precedes it if the step is "off", and a step other than "on" and "off"
// follows it.
static const char *const brief_forms[DIP_SETTING_COUNT] = {
    [DIP_SETTING_AA] = "AA %sx",
    [DIP_SETTING_TAA] = "temporal AA",
    [DIP_SETTING_AAA] = "adaptive AA",
    [DIP_SETTING_ASD] = "groups of %s",
    [DIP_SETTING_AF] = "AF %sx",
    [DIP_SETTING_AAF] = "advanced AF",
    [DIP_SETTING_OPT] = "%s textures",
    [DIP_SETTING_MIPLOD] = "mip detail %s",
    [DIP_SETTING_SCALE] = "scale %s",
    [DIP_SETTING_UPSCALE] = "upscaling %s",
    [DIP_SETTING_POST] = "post %s",
    [DIP_SETTING_SHARPEN] = "sharpening %s",
    [DIP_SETTING_SHADOWS] = "shadows %s",
    [DIP_SETTING_GI] = "instancing",
    [DIP_SETTING_MIPDEBUG] = "mip colours",
};

// Writes a setting in its short form: "AA 4x", "no instancing".
static void describe_briefly(DipSetting setting, const char *step, char *text, size_t size_bytes) {
    const char *form = brief_forms[setting];
    const char *mark = strstr(form, "%s");
    if (mark) {
        snprintf(text, size_bytes, "%.*s%s%s", (int)(mark - form), form, step, mark + 2);
    } else {
        const bool off = strcmp(step, "off") == 0, named = !off && strcmp(step, "on") != 0;
        snprintf(text, size_bytes, "%s%s%s%s", off ? "no " : "", form, named ? " " : "",
                 named ? step : "");
    }
}

// Writes a setting in full: "Antialiasing 4x", "Geometry instancing off", "Adaptive AA".
static void describe_fully(DipSetting setting, const char *step, char *text, size_t size_bytes) {
    const bool on = strcmp(step, "on") == 0;
    const bool times = setting == DIP_SETTING_AA || setting == DIP_SETTING_AF;
    const bool number = isdigit((unsigned char)step[0]) != 0;
    snprintf(text, size_bytes, "%s%s%s%s", dip_setting_info(setting)->title, on ? "" : " ",
             on ? "" : step, times && number ? "x" : "");
}

void dip_preview_how_to(const DipPreviewState *state, DipHowTo lines) {
    const size_t size_bytes = sizeof lines[0];
    snprintf(lines[0], size_bytes, "There is no cost report yet. This makes one in some minutes:");
    snprintf(lines[1], size_bytes, "    diptych cost%s --out DIR", state->scene_words);
    snprintf(lines[2], size_bytes, "Then start the preview with it:");
    snprintf(lines[3], size_bytes, "    diptych%s --cost DIR/cost.json", state->scene_words);
}

void dip_preview_describe(const DipQuality *quality, bool brief, char *text, size_t size_bytes) {
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (quality->step[s] == info->default_step) {
            continue;
        }
        char one[64];
        (brief ? describe_briefly : describe_fully)((DipSetting)s, info->steps[quality->step[s]],
                                                    one, sizeof one);
        dip_put_append(text, size_bytes, "%s%s", text[0] ? ", " : "", one);
    }
    if (!text[0]) {
        snprintf(text, size_bytes, "Default settings");
    }
}
