// Labels, panels and the status line, laid out for any window from 320x160 up.
#include "app/preview/overlay.h"

#include "app/preview/sheet.h"
#include "app/preview/style.h"

#include <stdio.h>
#include <string.h>

enum { PANEL_GAP = 4, EDITED_BAR_PX = 3 };

// Returns the em size of labels. It grows with the pane, within limits that keep it legible.
static int label_size(DipRect pane, double scale) {
    const int fitting = dip_style_min(pane.width / 32, pane.height / 16);
    return dip_style_max(dip_style_scaled(10, scale),
                         dip_style_min(dip_style_scaled(15, scale), fitting));
}

// --- labels ------------------------------------------------------------------------------------

// Replaces the line by a longer text if the longer text fits.
static void prefer(DipFont *font, int size, int room, const char *longer, char *line,
                   size_t size_bytes) {
    if (dip_font_width(font, size, longer) <= room) {
        snprintf(line, size_bytes, "%s", longer);
    }
}

// Formats the frame time and rate, with fewer words if there is little room.
static void format_figures(DipFont *font, int size, int room, const DipPaneFigures *figures,
                           char *line, size_t size_bytes) {
    char longer[64];
    if (figures->copied) {
        snprintf(line, size_bytes, "copied");
        prefer(font, size, room, "copied: same settings", line, size_bytes);
        return;
    }
    snprintf(line, size_bytes, "%.1f ms", figures->ms);
    if (figures->fps > 0) {
        snprintf(longer, sizeof longer, "%.1f ms   %d fps", figures->ms, figures->fps);
        prefer(font, size, room, longer, line, size_bytes);
    }
}

static void append(char *line, size_t size_bytes, const char *between, const char *text) {
    const size_t length = strlen(line);
    if (text) {
        snprintf(line + length, size_bytes - length, "%s%s", between, text);
    }
}

// Returns the reason for which no effect ran, if all have the same one, or NULL.
static const char *common_reason(const DipEffects *effects) {
    const char *reason = effects->reflection.why;
    bool common = reason != NULL;
#define COMPARE_REASON(name, text)                                                                 \
    common = common && !effects->name.run && effects->name.why &&                                  \
             strcmp(effects->name.why, reason) == 0;
    DIP_EFFECT_LIST(COMPARE_REASON)
#undef COMPARE_REASON
    return common ? reason : NULL;
}

// Names the effects that ran, then the effects that did not run. If `reasons` is set, says why each
// effect did not run.
static void list_effects(const DipEffects *effects, bool reasons, char *line, size_t size_bytes) {
    snprintf(line, size_bytes, "Effects");
    const char *between = ": ";
#define APPEND_RUN(name, text)                                                                     \
    if (effects->name.run) {                                                                       \
        append(line, size_bytes, between, text);                                                   \
        between = ", ";                                                                            \
    }
    DIP_EFFECT_LIST(APPEND_RUN)
#undef APPEND_RUN
    if (strcmp(between, ": ") == 0) {
        append(line, size_bytes, between, "none");
    }
    between = "; no ";
#define APPEND_SKIPPED(name, text)                                                                 \
    if (!effects->name.run && effects->name.why) {                                                 \
        append(line, size_bytes, between, text);                                                   \
        append(line, size_bytes, ": ", reasons ? effects->name.why : NULL);                        \
        between = reasons ? between : ", ";                                                        \
    }
    DIP_EFFECT_LIST(APPEND_SKIPPED)
#undef APPEND_SKIPPED
}

static void format_effects(DipFont *font, int size, int room, const DipEffects *effects, char *line,
                           size_t size_bytes) {
    const char *reason = common_reason(effects);
    if (reason) {
        snprintf(line, size_bytes, "Effects: none; %s", reason);
        return;
    }
    list_effects(effects, true, line, size_bytes);
    if (dip_font_width(font, size, line) > room) {
        list_effects(effects, false, line, size_bytes);
    }
}

static void format_settings(DipFont *font, int size, int room, const DipQuality *quality,
                            char *line, size_t size_bytes) {
    dip_preview_describe(quality, false, line, size_bytes);
    if (dip_font_width(font, size, line) > room) {
        dip_preview_describe(quality, true, line, size_bytes);
    }
}

// Draws the label's first line: the pane's name, its frame time and its frame rate.
static void draw_title(DipDrawList *list, int pane, bool edited, int size, DipRect line,
                       const DipPaneFigures *figures) {
    static const char *const titles[DIP_PANE_COUNT] = {"Current", "Requested"};
    DipFont *font = dip_draw_list_font(list);
    const int gap = dip_style_max(6, size * 2 / 3);
    const int room = line.width - dip_font_width(font, size, titles[pane]) - gap;
    char text[64];
    format_figures(font, size, room - gap, figures, text, sizeof text);
    dip_draw_list_text(list, size, edited ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                       line.x, line.y, line.width, titles[pane]);
    dip_draw_list_text(list, size, dip_style_white, DIP_ALIGN_RIGHT, line.x + line.width, line.y,
                       room, text);
}

// Draws three lines in a dark strip: title, settings, effects. Returns the y coordinate of the
// strip's lower end.
static int draw_label(DipDrawList *list, const DipPreviewState *state, int pane, DipRect rect,
                      const DipPaneFigures *figures, double scale) {
    DipFont *font = dip_draw_list_font(list);
    const int size = label_size(rect, scale);
    const int height = dip_font_line_height(font, size);
    const int margin = dip_style_max(6, size * 2 / 3);
    const int pad = dip_style_max(3, size / 3);
    const DipRect strip = {rect.x, rect.y, rect.width, 3 * height + 2 * pad};
    const DipRect line = {rect.x + margin + EDITED_BAR_PX, rect.y + pad,
                          rect.width - 2 * margin - EDITED_BAR_PX, height};
    char text[512];
    dip_draw_list_fill(list, strip, dip_style_strip);
    if (state->edited[pane]) {
        dip_draw_list_fill(list, (DipRect){rect.x, rect.y, EDITED_BAR_PX, strip.height},
                           dip_style_accent);
    }
    draw_title(list, pane, state->edited[pane], size, line, figures);
    format_settings(font, size, line.width, &state->quality[pane], text, sizeof text);
    dip_draw_list_text(list, size, dip_style_soft, DIP_ALIGN_LEFT, line.x, line.y + height,
                       line.width, text);
    format_effects(font, size, line.width, &figures->effects, text, sizeof text);
    dip_draw_list_text(list, size, dip_style_soft, DIP_ALIGN_LEFT, line.x, line.y + 2 * height,
                       line.width, text);
    return strip.y + strip.height;
}

// --- the panel ---------------------------------------------------------------------------------

static int panel_line_width(DipFont *font, int size, const DipPanelLine *line) {
    return dip_font_width(font, size, line->name) + dip_font_width(font, size, line->value) +
           3 * size;
}

static int panel_width(DipFont *font, int size, const DipPanelLine *lines, int count) {
    int width = 0, name_width = 0, value_width = 0;
    for (int i = 0; i < count; ++i) {
        width = dip_style_max(width, panel_line_width(font, size, &lines[i]));
        if (!lines[i].head) {
            name_width = dip_style_max(name_width, dip_font_width(font, size, lines[i].name));
            value_width = dip_style_max(value_width, dip_font_width(font, size, lines[i].value));
        }
    }
    return dip_style_max(width, name_width + value_width + 3 * size);
}

// Draws the panel's lines between the pane's label and the status line, in the largest letters at
// which all lines fit. If the smallest letters are still too large, leaves out the last lines.
static void draw_panel(DipDrawList *list, const DipPanelLine *lines, int count, DipRect room,
                       double scale) {
    DipFont *font = dip_draw_list_font(list);
    int size = dip_style_max(dip_style_scaled(10, scale),
                             dip_style_min(dip_style_scaled(14, scale), room.width / 36));
    while (size > DIP_FONT_MIN_SIZE &&
           (count * dip_font_line_height(font, size) + size > room.height ||
            panel_width(font, size, lines, count) > room.width)) {
        size--;
    }
    const int height = dip_font_line_height(font, size);
    const int shown = dip_style_min(count, (room.height - size) / height);
    if (shown < 1) {
        return;
    }
    const int width = dip_style_min(room.width, panel_width(font, size, lines, shown));
    dip_draw_list_fill(list, (DipRect){room.x, room.y, width, shown * height + size},
                       dip_style_panel);
    for (int i = 0; i < shown; ++i) {
        const DipPanelLine *line = &lines[i];
        const int y = room.y + size / 2 + i * height;
        const int name_width = dip_font_width(font, size, line->name);
        dip_draw_list_text(list, size, line->head ? dip_style_accent : dip_style_soft,
                           DIP_ALIGN_LEFT, room.x + size, y, width - 2 * size, line->name);
        dip_draw_list_text(list, size, line->head ? dip_style_accent : dip_style_white,
                           DIP_ALIGN_RIGHT, room.x + width - size, y, width - name_width - 3 * size,
                           line->value);
    }
}

// --- the status line ---------------------------------------------------------------------------

static void format_place(const DipPreviewState *state, char *text, size_t size_bytes) {
    if (state->manual) {
        snprintf(text, size_bytes, "Free camera");
        return;
    }
    if (state->scene_title) {
        snprintf(text, size_bytes, "%s: %s   %.1f s%s", state->scene_title, state->scene_look,
                 1e-9 * (double)state->play_ns, state->paused ? "   paused" : "");
        return;
    }
    snprintf(text, size_bytes, "Path: %s   %.1f s%s",
             dip_preview_category_title(state->track->active),
             1e-9 * (double)dip_camtrack_time(state->track, state->play_ns),
             state->paused ? "   paused" : "");
}

// Draws one line along the window's lower edge: the path and its time on the left, the notice in
// the middle, the key for help on the right. If the notice is too wide for the middle, it replaces
// the path. Returns the y coordinate of the line's upper edge.
static int draw_status(DipDrawList *list, const DipPreviewState *state, int size) {
    static const char help[] = "F1: help";
    DipFont *font = dip_draw_list_font(list);
    const int width = dip_draw_list_width(list);
    const int height = dip_font_line_height(font, size);
    const int pad = dip_style_max(2, size / 4);
    const int margin = dip_style_max(6, size * 2 / 3);
    const int strip_height = height + 2 * pad;
    const DipRect strip = {0, dip_draw_list_height(list) - strip_height, width, strip_height};
    const int y = strip.y + pad;
    char place[96];
    format_place(state, place, sizeof place);
    const int place_width = dip_font_width(font, size, place);
    const int help_width = dip_font_width(font, size, help);
    const int left_room = width - help_width - 4 * margin;
    const int middle_room = width - 2 * (dip_style_max(place_width, help_width) + 2 * margin);
    const bool notice_fits = dip_font_width(font, size, state->notice) <= middle_room;
    dip_draw_list_fill(list, strip, dip_style_status);
    dip_draw_list_text(list, size, dip_style_soft, DIP_ALIGN_RIGHT, width - margin, y, width / 3,
                       help);
    if (notice_fits) {
        dip_draw_list_text(list, size, dip_style_accent, DIP_ALIGN_CENTRE, width / 2, y,
                           middle_room, state->notice);
    }
    dip_draw_list_text(list, size, notice_fits ? dip_style_soft : dip_style_accent, DIP_ALIGN_LEFT,
                       margin, y, left_room, notice_fits ? place : state->notice);
    return strip.y;
}

void dip_overlay_draw(DipDrawList *list, const DipPreviewState *state,
                      const DipRect panes[DIP_PANE_COUNT],
                      const DipPaneFigures figures[DIP_PANE_COUNT], double scale) {
    const int least = dip_style_scaled(10, scale);
    const int status_y =
        draw_status(list, state, dip_style_max(least, label_size(panes[0], scale) - 1));
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const int label_y = draw_label(list, state, p, panes[p], &figures[p], scale);
        if (state->panel) {
            DipPanelLine lines[DIP_PANEL_MAX_LINES];
            const int count = dip_panel_lines(&figures[p], p, lines);
            const DipRect room = {panes[p].x + PANEL_GAP, label_y + PANEL_GAP,
                                  panes[p].width - 2 * PANEL_GAP,
                                  status_y - label_y - 2 * PANEL_GAP};
            draw_panel(list, lines, count, room, scale);
        }
    }
    if (state->help) {
        dip_sheet_draw_help(list, scale);
    } else if (state->show_costs) {
        dip_sheet_draw_costs(list, state, scale);
    }
}
