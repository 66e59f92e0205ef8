// Labels, status line and help, laid out for any window from 400x240 up.
#include "app/preview/overlay.h"

#include "app/preview/keys.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <string.h>

static const SDL_Color white = {255, 255, 255, 255};
static const SDL_Color soft = {196, 202, 210, 255};
static const SDL_Color accent = {255, 190, 92, 255};

enum { PANEL_GAP = 4 };

static void fill(SDL_Renderer *renderer, SDL_Rect rect, SDL_Color colour) {
    SDL_SetRenderDrawBlendMode(renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(renderer, colour.r, colour.g, colour.b, colour.a);
    SDL_RenderFillRect(renderer, &rect);
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

// Em size of labels: grows with the pane, within what reads well.
static int label_size(const SDL_Rect *pane) {
    return larger(10, smaller(15, smaller(pane->w / 32, pane->h / 16)));
}

// The figures with fewer words where there is little room.
static void format_figures(DipText *text, int size, int room, const DipPaneFigures *figures,
                           char *line, size_t size_bytes) {
    if (figures->copied) {
        snprintf(line, size_bytes, "copied");
        return;
    }
    snprintf(line, size_bytes, "%.1f ms", figures->ms);
    if (figures->fps > 0) {
        char longer[64];
        snprintf(longer, sizeof longer, "%.1f ms   %d fps", figures->ms, figures->fps);
        if (dip_text_width(text, size, longer) <= room) {
            snprintf(line, size_bytes, "%s", longer);
        }
    }
}

static void append(char *line, size_t size_bytes, const char *between, const char *text) {
    const size_t length = strlen(line);
    if (text) {
        snprintf(line + length, size_bytes - length, "%s%s", between, text);
    }
}

// The effects that ran, then those that did not, with the reasons or without.
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

static void format_effects(DipText *text, int size, int room, const DipEffects *effects, char *line,
                           size_t size_bytes) {
    list_effects(effects, true, line, size_bytes);
    if (dip_text_width(text, size, line) > room) {
        list_effects(effects, false, line, size_bytes);
    }
}

// Three lines in a dark strip: whose pane and how fast; which settings; which effects. Returns
// where the strip ends.
static int draw_label(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state, int pane,
                      const SDL_Rect *rect, const DipPaneFigures *figures) {
    static const char *const titles[DIP_PANE_COUNT] = {"Current", "Requested"};
    const int size = label_size(rect);
    const int line = dip_text_line_height(text, size);
    const int margin = larger(6, size * 2 / 3);
    const int pad = larger(3, size / 3);
    const bool edited = state->edited[pane];
    const SDL_Rect strip = {rect->x, rect->y, rect->w, 3 * line + 2 * pad};
    fill(renderer, strip, (SDL_Color){12, 14, 18, 168});
    if (edited) {
        fill(renderer, (SDL_Rect){rect->x, rect->y, 3, strip.h}, accent);
    }
    const int left = rect->x + margin + 3;
    const int right = rect->x + rect->w - margin;
    const int title_width = dip_text_width(text, size, titles[pane]);
    char line_text[DIP_NOTICE_SIZE];
    format_figures(text, size, right - left - title_width - 2 * margin, figures, line_text,
                   sizeof line_text);
    dip_text_draw(text, size, edited ? accent : white, DIP_ALIGN_LEFT, left, rect->y + pad,
                  right - left, titles[pane]);
    dip_text_draw(text, size, white, DIP_ALIGN_RIGHT, right, rect->y + pad,
                  right - left - title_width - margin, line_text);
    dip_preview_describe(&state->quality[pane], line_text, sizeof line_text);
    dip_text_draw(text, size, soft, DIP_ALIGN_LEFT, left, rect->y + pad + line, right - left,
                  line_text);
    char effects[512];
    format_effects(text, size, right - left, &figures->effects, effects, sizeof effects);
    dip_text_draw(text, size, soft, DIP_ALIGN_LEFT, left, rect->y + pad + 2 * line, right - left,
                  effects);
    return strip.y + strip.h;
}

// The panel's lines that fit between the strips, in the largest letters that leave out the least.
static void draw_panel(SDL_Renderer *renderer, DipText *text, const DipPanelLine *lines, int count,
                       const SDL_Rect *room) {
    int size = larger(10, smaller(14, room->w / 36));
    while (size > DIP_TEXT_MIN_SIZE && count * dip_text_line_height(text, size) + size > room->h) {
        size--;
    }
    const int line = dip_text_line_height(text, size);
    const int shown = smaller(count, (room->h - size) / line);
    int name_width = 0, value_width = 0;
    for (int i = 0; i < shown; ++i) {
        name_width = larger(name_width, dip_text_width(text, size, lines[i].name));
        value_width = larger(value_width, dip_text_width(text, size, lines[i].value));
    }
    const int width = smaller(room->w, name_width + value_width + 3 * size);
    if (shown < 1) {
        return;
    }
    fill(renderer, (SDL_Rect){room->x, room->y, width, shown * line + size},
         (SDL_Color){12, 14, 18, 190});
    for (int i = 0; i < shown; ++i) {
        const int y = room->y + size / 2 + i * line;
        const SDL_Color colour = lines[i].head ? accent : white;
        dip_text_draw(text, size, lines[i].head ? accent : soft, DIP_ALIGN_LEFT, room->x + size, y,
                      name_width, lines[i].name);
        dip_text_draw(text, size, colour, DIP_ALIGN_RIGHT, room->x + width - size, y,
                      width - name_width - 3 * size, lines[i].value);
    }
}

// One line along the window's lower edge: path and time, what just happened, how to get help.
// Returns where it begins.
static int draw_status(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state,
                       const SDL_Rect *window, int size) {
    const int line = dip_text_line_height(text, size);
    const int pad = larger(2, size / 4);
    const int margin = larger(6, size * 2 / 3);
    const SDL_Rect strip = {0, window->h - line - 2 * pad, window->w, line + 2 * pad};
    const int y = strip.y + pad;
    char where[96];
    fill(renderer, strip, (SDL_Color){12, 14, 18, 150});
    if (state->manual) {
        snprintf(where, sizeof where, "Free camera");
    } else {
        snprintf(where, sizeof where, "Path %s   %.1f s%s",
                 dip_preview_path_name(state->track->active),
                 1e-9 * (double)dip_camtrack_time(state->track, state->play_ns),
                 state->paused ? "   paused" : "");
    }
    static const char help[] = "F1 help";
    const int left_width = dip_text_width(text, size, where);
    const int right_width = dip_text_width(text, size, help);
    const int side = larger(left_width, right_width) + 2 * margin;
    dip_text_draw(text, size, soft, DIP_ALIGN_LEFT, margin, y, window->w / 2, where);
    dip_text_draw(text, size, soft, DIP_ALIGN_RIGHT, window->w - margin, y, window->w / 3, help);
    if (state->notice[0]) {
        dip_text_draw(text, size, accent, DIP_ALIGN_CENTRE, window->w / 2, y,
                      larger(0, window->w - 2 * side), state->notice);
    }
    return strip.y;
}

// A dark sheet in the middle of a darkened window.
static SDL_Rect draw_sheet(SDL_Renderer *renderer, const SDL_Rect *window, int width, int height) {
    const SDL_Rect sheet = {(window->w - width) / 2, (window->h - height) / 2, width, height};
    fill(renderer, (SDL_Rect){0, 0, window->w, window->h}, (SDL_Color){0, 0, 0, 90});
    fill(renderer, sheet, (SDL_Color){14, 16, 21, 236});
    fill(renderer, (SDL_Rect){sheet.x, sheet.y, sheet.w, 2}, accent);
    return sheet;
}

static const char help_title[] = "Keys";
static const char help_shift[] = "Shift goes backwards";
static const char help_note[] = "A setting's key moves to the path that shows it best";

enum { MAX_HELP_ROWS = 40, MAX_HELP_COLUMNS = 3 };

typedef struct HelpRow {
    const char *label;
    char text[64];
} HelpRow;

static int help_rows(HelpRow rows[MAX_HELP_ROWS]) {
    int count = 0;
    for (int i = 0; i < dip_key_row_count && count < MAX_HELP_ROWS; ++i) {
        const DipKeyRow *key = &dip_key_rows[i];
        if (!key->label) {
            continue;
        }
        if (key->action == DIP_ACTION_SETTING) {
            snprintf(rows[count].text, sizeof rows[count].text, "%s",
                     dip_setting_info((DipSetting)key->argument)->title);
        } else {
            snprintf(rows[count].text, sizeof rows[count].text, "%s", key->text);
        }
        rows[count++].label = key->label;
    }
    return count;
}

typedef struct HelpLayout {
    int size;
    int columns;
    int rows_per_column;
    int line;
    int label_width;
    int text_width;
    int gap;
    int width;
    int height;
} HelpLayout;

static HelpLayout measure_help(DipText *text, const HelpRow *rows, int count, int size,
                               int columns) {
    HelpLayout layout = {.size = size, .columns = columns};
    for (int i = 0; i < count; ++i) {
        layout.label_width = larger(layout.label_width, dip_text_width(text, size, rows[i].label));
        layout.text_width = larger(layout.text_width, dip_text_width(text, size, rows[i].text));
    }
    layout.gap = size;
    layout.line = dip_text_line_height(text, size) + larger(1, size / 6);
    layout.rows_per_column = (count + columns - 1) / columns;
    const int column = layout.label_width + layout.gap + layout.text_width;
    const int rows_width = columns * column + (columns - 1) * 2 * layout.gap;
    layout.width = larger(rows_width, dip_text_width(text, size, help_note)) + 2 * size;
    layout.height = (layout.rows_per_column + 3) * layout.line + 2 * size;
    return layout;
}

// The largest letters at which everything fits, with as few columns as that takes.
static HelpLayout choose_layout(DipText *text, const HelpRow *rows, int count,
                                const SDL_Rect *window) {
    HelpLayout layout = {0};
    for (int size = 17; size >= DIP_TEXT_MIN_SIZE; --size) {
        for (int columns = 1; columns <= MAX_HELP_COLUMNS; ++columns) {
            layout = measure_help(text, rows, count, size, columns);
            if (layout.width <= window->w - 8 && layout.height <= window->h - 8) {
                return layout;
            }
        }
    }
    return layout;
}

static void draw_help(SDL_Renderer *renderer, DipText *text, const SDL_Rect *window) {
    HelpRow rows[MAX_HELP_ROWS];
    const int count = help_rows(rows);
    const HelpLayout l = choose_layout(text, rows, count, window);
    const SDL_Rect panel = draw_sheet(renderer, window, l.width, l.height);
    const int x0 = panel.x + l.size;
    const int y0 = panel.y + l.size;
    const int room = panel.w - 2 * l.size;
    dip_text_draw(text, l.size, white, DIP_ALIGN_LEFT, x0, y0, room, help_title);
    dip_text_draw(text, l.size, soft, DIP_ALIGN_RIGHT, x0 + room, y0, room, help_shift);
    const int column = l.label_width + l.gap + l.text_width + 2 * l.gap;
    for (int i = 0; i < count; ++i) {
        const int x = x0 + i / l.rows_per_column * column;
        const int y = y0 + l.line + l.line / 2 + i % l.rows_per_column * l.line;
        dip_text_draw(text, l.size, accent, DIP_ALIGN_LEFT, x, y, l.label_width, rows[i].label);
        dip_text_draw(text, l.size, white, DIP_ALIGN_LEFT, x + l.label_width + l.gap, y,
                      l.text_width, rows[i].text);
    }
    dip_text_draw(text, l.size, soft, DIP_ALIGN_LEFT, x0, panel.y + panel.h - l.size - l.line, room,
                  help_note);
}

// --- what settings cost ------------------------------------------------------------------------

static const char costs_note[] =
    "Time as a ratio to the step at 1x; FLIP of that step, and how it changes with others";
static const char *const costs_missing[] = {
    "No cost report yet. Make one, which takes minutes:", "    diptych cost --out DIR",
    "and start with it:", "    diptych --cost DIR/cost.json"};

typedef struct CostsLayout {
    int size;
    int line;
    int title_width;
    int name_width[DIP_COST_MAX_SWEEP_ROWS]; // of a column
    int column_width[DIP_COST_MAX_SWEEP_ROWS];
    int width;
    int height;
} CostsLayout;

static CostsLayout measure_costs(DipText *text, const DipCosts *costs, int size) {
    CostsLayout l = {.size = size, .line = dip_text_line_height(text, size) + 1};
    const int gap = larger(4, size * 2 / 3);
    for (int r = 0; r < costs->row_count; ++r) {
        const DipCostsRow *row = &costs->rows[r];
        l.title_width = larger(l.title_width, dip_text_width(text, size, row->title) + gap);
        for (int s = 0; s < row->step_count; ++s) {
            l.name_width[s] =
                larger(l.name_width[s], dip_text_width(text, size, row->steps[s].name) + gap / 2);
        }
    }
    l.width = l.title_width;
    for (int s = 0; s < DIP_COST_MAX_SWEEP_ROWS; ++s) {
        for (int r = 0; r < costs->row_count; ++r) {
            const DipCostsRow *row = &costs->rows[r];
            const int width =
                s < row->step_count
                    ? l.name_width[s] + dip_text_width(text, size, row->steps[s].figures) + gap
                    : 0;
            l.column_width[s] = larger(l.column_width[s], width);
        }
        l.width += l.column_width[s];
    }
    l.width = larger(l.width, dip_text_width(text, size, costs_note)) + 2 * size;
    l.height = (costs->row_count + 3) * l.line + 2 * size;
    return l;
}

static void draw_costs_row(DipText *text, const CostsLayout *l, const DipCostsRow *row,
                           const DipQuality *quality, int x, int y) {
    dip_text_draw(text, l->size, white, DIP_ALIGN_LEFT, x, y, l->title_width, row->title);
    x += l->title_width;
    for (int s = 0; s < row->step_count; ++s) {
        const bool at = dip_costs_is_at(row, s, quality);
        dip_text_draw(text, l->size, at ? accent : white, DIP_ALIGN_LEFT, x, y, l->name_width[s],
                      row->steps[s].name);
        dip_text_draw(text, l->size, at ? accent : soft, DIP_ALIGN_LEFT, x + l->name_width[s], y,
                      l->column_width[s] - l->name_width[s], row->steps[s].figures);
        x += l->column_width[s];
    }
}

static void draw_no_costs(SDL_Renderer *renderer, DipText *text, const SDL_Rect *window) {
    const int size = larger(10, smaller(15, window->w / 60));
    const int line = dip_text_line_height(text, size) + 2;
    const int count = (int)DIP_ARRAY_COUNT(costs_missing);
    int width = 0;
    for (int i = 0; i < count; ++i) {
        width = larger(width, dip_text_width(text, size, costs_missing[i]));
    }
    const SDL_Rect sheet = draw_sheet(renderer, window, width + 2 * size, count * line + 2 * size);
    for (int i = 0; i < count; ++i) {
        dip_text_draw(text, size, i % 2 ? accent : white, DIP_ALIGN_LEFT, sheet.x + size,
                      sheet.y + size + i * line, width, costs_missing[i]);
    }
}

// The requested pane's steps stand out.
static void draw_costs(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state,
                       const SDL_Rect *window) {
    const DipCosts *costs = state->costs;
    if (!costs) {
        draw_no_costs(renderer, text, window);
        return;
    }
    CostsLayout l;
    int size = 15;
    do {
        l = measure_costs(text, costs, size);
    } while ((l.width > window->w || l.height > window->h) && size-- > DIP_TEXT_MIN_SIZE);
    const SDL_Rect sheet = draw_sheet(renderer, window, l.width, l.height);
    const int x = sheet.x + l.size, y = sheet.y + l.size, room = sheet.w - 2 * l.size;
    dip_text_draw(text, l.size, white, DIP_ALIGN_LEFT, x, y, room, costs->heading);
    for (int r = 0; r < costs->row_count; ++r) {
        draw_costs_row(text, &l, &costs->rows[r], &state->quality[DIP_PANE_REQUESTED], x,
                       y + (r + 1) * l.line + l.line / 2);
    }
    dip_text_draw(text, l.size, soft, DIP_ALIGN_LEFT, x, y + (costs->row_count + 2) * l.line, room,
                  costs_note);
}

void dip_overlay_draw(SDL_Renderer *renderer, DipText *text, const DipPreviewState *state,
                      const SDL_Rect panes[DIP_PANE_COUNT],
                      const DipPaneFigures figures[DIP_PANE_COUNT]) {
    SDL_Rect window = {0};
    SDL_GetRendererOutputSize(renderer, &window.w, &window.h);
    const int status_y =
        draw_status(renderer, text, state, &window, larger(10, label_size(&panes[0]) - 1));
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const int label_y = draw_label(renderer, text, state, p, &panes[p], &figures[p]);
        if (state->panel) {
            DipPanelLine lines[DIP_PANEL_MAX_LINES];
            const int count = dip_panel_lines(&figures[p], p, lines);
            draw_panel(renderer, text, lines, count,
                       &(SDL_Rect){panes[p].x + PANEL_GAP, label_y + PANEL_GAP,
                                   panes[p].w - 2 * PANEL_GAP, status_y - label_y - 2 * PANEL_GAP});
        }
    }
    if (state->help) {
        draw_help(renderer, text, &window);
    } else if (state->show_costs) {
        draw_costs(renderer, text, state, &window);
    }
}
