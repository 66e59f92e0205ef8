// The labels over the panes, and notices.
#include "app/preview/tabs/labels.h"

#include "app/preview/tabs/pane_time.h"
#include "app/preview/tools/compare.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <string.h>

enum { LABEL_SIZE = 13, LABEL_HEIGHT = 24, LABEL_MARGIN = 8, LABEL_PAD = 8 };

// Writes the time of a pane: "4.6 ms  60 fps", or "one frame: 44.0 ms", or that the pane is a copy.
// If frames come too slowly for temporal antialiasing, says so instead.
static void format_time(const DipWindow *window, int pane, char *text, size_t size_bytes) {
    const DipPaneFigures *figures = &window->figures[pane];
    const DipPaneTime time = dip_pane_time(window, pane);
    char ms[DIP_PANE_TIME_BYTES];
    dip_pane_time_text(&time, ms);
    if (figures->taa_speed.too_slow) {
        snprintf(text, size_bytes, "too slow for temporal AA: %d of %d frames a second",
                 figures->taa_speed.shown, figures->taa_speed.wanted);
    } else if (figures->copied) {
        snprintf(text, size_bytes, "same as current");
    } else if (figures->fps > 0) {
        snprintf(text, size_bytes, "%s  %d fps", ms, figures->fps);
    } else {
        snprintf(text, size_bytes, "%s", ms);
    }
}

// Returns the width that a time takes: that of the longest usual text, so that the settings beside
// it stay where they are when the preview pauses or a time has a digit more. If there is no room
// for that, returns the width of the text itself.
static int reserve_time(const DipUi *ui, const char *time, int most) {
    const int width = dip_ui_text_width(ui, LABEL_SIZE, time);
    const int usual = dip_ui_text_width(ui, LABEL_SIZE, "one frame: 88.8 ms");
    return width < usual && usual <= most ? usual : width;
}

// Writes the settings with the words that fit: in full, briefly, or not at all.
static void format_settings(const DipUi *ui, const DipQuality *quality, int room, char *text,
                            size_t size_bytes) {
    dip_preview_describe(quality, false, text, size_bytes);
    if (dip_ui_text_width(ui, LABEL_SIZE, text) > room) {
        dip_preview_describe(quality, true, text, size_bytes);
    }
    if (dip_ui_text_width(ui, LABEL_SIZE, text) > room) {
        text[0] = '\0';
    }
}

static void draw_label(DipUi *ui, const DipWindow *window, int pane) {
    static const char *const long_titles[DIP_PANE_COUNT] = {"Current", "Requested"};
    static const char *const short_titles[DIP_PANE_COUNT] = {"Cur.", "Req."};
    const DipRect rect = dip_compare_visible(window, pane);
    const bool edited = window->state->edited[pane];
    const int margin = dip_ui_px(ui, LABEL_MARGIN), pad = dip_ui_px(ui, LABEL_PAD);
    const int height = dip_ui_px(ui, LABEL_HEIGHT);
    const int title_room = rect.width - 2 * margin - 2 * pad;
    const bool narrow = dip_ui_text_width(ui, LABEL_SIZE, long_titles[pane]) > title_room;
    const char *const title = narrow ? short_titles[pane] : long_titles[pane];
    const int title_width = dip_ui_text_width(ui, LABEL_SIZE, title);
    char time[64], settings[400];
    const int most = rect.width - 2 * margin - title_width - 3 * pad;
    format_time(window, pane, time, sizeof time);
    const int time_width = reserve_time(ui, time, most);
    const int used = title_width + time_width + 3 * pad;
    const int room = rect.width - 2 * margin - used - pad;
    format_settings(ui, &window->state->quality[pane], room, settings, sizeof settings);
    const int settings_width = settings[0] ? dip_ui_text_width(ui, LABEL_SIZE, settings) + pad : 0;
    const DipRect strip = {rect.x + margin, rect.y + margin,
                           dip_style_min(used + settings_width, rect.width - 2 * margin), height};
    const int y = strip.y + (height - dip_ui_line_height(ui, LABEL_SIZE)) / 2;
    dip_ui_fill_round(ui, strip, dip_ui_px(ui, 4), dip_style_glass);
    dip_ui_text(ui, LABEL_SIZE, edited ? dip_style_accent : dip_style_white, DIP_ALIGN_LEFT,
                strip.x + pad, y, strip.width - 2 * pad, title);
    dip_ui_text(ui, LABEL_SIZE, dip_style_white, DIP_ALIGN_LEFT, strip.x + 2 * pad + title_width, y,
                strip.width - 3 * pad - title_width, time);
    dip_ui_text(ui, LABEL_SIZE, dip_style_soft, DIP_ALIGN_LEFT, strip.x + used, y,
                strip.width - used, settings);
    if (edited && pane == DIP_PANE_REQUESTED &&
        !dip_compare_is_one_picture(window->state->tools.comparison)) {
        dip_ui_fill(ui, (DipRect){rect.x - DIP_PANE_GAP_PX, rect.y, DIP_PANE_GAP_PX, rect.height},
                    dip_style_accent);
    }
}

void dip_labels_draw(DipUi *ui, DipWindow *window) {
    for (int p = 0; dip_ui_is_drawing(ui) && p < DIP_PANE_COUNT; ++p) {
        if (dip_compare_has_label(window, p)) {
            draw_label(ui, window, p);
        }
    }
}

void dip_labels_draw_notice(DipUi *ui, DipWindow *window) {
    const char *notice = window->state->notice;
    if (!notice[0] || !dip_ui_is_drawing(ui)) {
        return;
    }
    const DipLayout *layout = window->layout;
    const int pad = dip_ui_px(ui, LABEL_PAD), margin = dip_ui_px(ui, LABEL_MARGIN);
    const int height = dip_ui_px(ui, LABEL_HEIGHT);
    const int room = layout->width - 2 * margin;
    const int width = dip_style_min(room, dip_ui_text_width(ui, LABEL_SIZE, notice) + 2 * pad);
    const DipRect strip = {(layout->width - width) / 2,
                           layout->panes[0].y + layout->panes[0].height - margin - height, width,
                           height};
    dip_ui_fill_round(ui, strip, dip_ui_px(ui, 4), dip_style_glass);
    dip_ui_text(ui, LABEL_SIZE, dip_style_accent, DIP_ALIGN_CENTRE, layout->width / 2,
                strip.y + (height - dip_ui_line_height(ui, LABEL_SIZE)) / 2, width - pad, notice);
}
