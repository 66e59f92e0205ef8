// Draws the panes, the controls and the texts into one picture.
#include "app/preview/loop/view.h"

#include "app/preview/tools/maps.h"
#include "app/ui/style.h"

#include <stdlib.h>
#include <string.h>

struct DipView {
    DipFont *font; // NULL if the texts are character cells.
    DipUi *ui;
    DipDrawList *list;
    DipCanvas canvas;
    DipDamage damage; // What has changed since dip_view_take_damage was last called.
    DipPixels frames[DIP_PANE_COUNT];
    uint64_t frame_count; // Number of frames set so far; also the newest frame's version.
    uint64_t versions[DIP_PANE_COUNT];
};

DipView *dip_view_create(DipTextView *text, DipError *err) {
    DipView *view = calloc(1, sizeof *view);
    if (!view) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    view->font = text ? NULL : dip_font_create(err);
    view->list = text || view->font ? dip_draw_list_create(view->font, err) : NULL;
    view->ui = view->list ? dip_ui_create(err) : NULL;
    if (!view->ui) {
        dip_view_destroy(&view);
    }
    return view;
}

void dip_view_destroy(DipView **view_pointer) {
    DipView *view = *view_pointer;
    if (!view) {
        return;
    }
    *view_pointer = NULL;
    dip_ui_destroy(&view->ui);
    dip_draw_list_destroy(&view->list);
    dip_font_destroy(&view->font);
    dip_canvas_free(&view->canvas);
    free(view);
}

void dip_view_set_frame(DipView *view, int pane, const DipFrame *frame) {
    view->frames[pane] = dip_frame_pixels(frame);
    view->versions[pane] = ++view->frame_count;
}

uint64_t dip_view_version(const DipView *view, int pane) {
    return view->versions[pane];
}

DipLayout dip_view_layout(const DipViewInput *input) {
    if (input->text) { // The dock is drawn as characters, so only the panes have rectangles.
        DipLayout layout = {
            .width = input->width, .height = input->height, .scale = 1.0, .side = DIP_DOCK_DRAWER};
        dip_text_view_panes(input->text, input->window.state, input->width, input->height,
                            layout.panes);
        return layout;
    }
    return dip_layout_make(input->width, input->height, input->scale, &input->window.state->tools);
}

// Runs one pass (ui.h) over all controls: draws them into `list`, hands them `event`, or only lays
// them out if both are NULL. Returns what dip_ui_end returns.
static bool pass_over(DipView *view, const DipViewInput *input, DipDrawList *list,
                      const DipEvent *event) {
    const DipLayout layout = dip_view_layout(input);
    DipWindow window = input->window;
    window.layout = &layout;
    memcpy(window.frames, view->frames, sizeof window.frames);
    memcpy(window.versions, view->versions, sizeof window.versions);
    window.truth = dip_maps_truth(&window.tools->maps, &window.truth_version);
    const DipUiPass pass = {view->font, layout.scale, window.now_ns, list, event};
    dip_ui_begin(view->ui, &pass);
    dip_window_declare(view->ui, &window);
    return dip_ui_end(view->ui);
}

// Hands an event to the settings that are drawn as characters. A click on a pane chooses the pane.
static bool handle_in_text(const DipViewInput *input, const DipEvent *event) {
    DipPreviewState *state = input->window.state;
    if (dip_text_view_event(input->text, state, event, input->window.now_ns)) {
        return true;
    }
    const DipLayout layout = dip_view_layout(input);
    for (int p = 0; p < DIP_PANE_COUNT && event->kind == DIP_EVENT_MOUSE_DOWN; ++p) {
        if (dip_rect_holds(layout.panes[p], event->x, event->y)) {
            dip_preview_edit_only(state, p);
            return true;
        }
    }
    return false;
}

bool dip_view_handle(DipView *view, const DipViewInput *input, const DipEvent *event) {
    if (input->text) {
        return handle_in_text(input, event);
    }
    pass_over(view, input, NULL, NULL); // Lays the controls out anew.
    return pass_over(view, input, NULL, event);
}

// Draws the panes into the draw list, and the texts into character cells.
static bool draw_text(DipView *view, const DipViewInput *input, DipError *err) {
    const DipLayout layout = dip_view_layout(input);
    dip_draw_list_fill(view->list, (DipRect){0, 0, input->width, input->height},
                       dip_style_background);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_draw_list_picture(view->list, layout.panes[p], &view->frames[p], view->versions[p]);
    }
    return dip_text_view_draw(input->text, input->window.state, input->width, input->height,
                              input->window.figures, err);
}

bool dip_view_draw(DipView *view, const DipViewInput *input, DipError *err) {
    DipDamage changed;
    if (!input->text) {
        pass_over(view, input, NULL, NULL);
    }
    dip_draw_list_begin(view->list, input->width, input->height);
    if (!input->text) {
        pass_over(view, input, view->list, NULL);
    } else if (!draw_text(view, input, err)) {
        return false;
    }
    if (!dip_draw_list_paint(view->list, &view->canvas, &changed, err)) {
        return false;
    }
    for (int i = 0; i < changed.count; ++i) {
        dip_damage_add(&view->damage, changed.rects[i]);
    }
    return true;
}

DipUi *dip_view_ui(DipView *view) {
    return view->ui;
}

DipPixels dip_view_picture(const DipView *view) {
    return dip_canvas_pixels(&view->canvas);
}

DipDamage dip_view_take_damage(DipView *view, bool all) {
    if (all) {
        dip_damage_add(&view->damage, (DipRect){0, 0, view->canvas.width, view->canvas.height});
    }
    const DipDamage damage = view->damage;
    view->damage.count = 0;
    return damage;
}
