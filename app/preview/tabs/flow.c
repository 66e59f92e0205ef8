// Lays controls out in rows that are filled from the left.
#include "app/preview/tabs/tabs.h"
#include "app/ui/layout.h"

enum { LETTERS = 12, ROW = 26, GAP = 6, PAD = 20, LOW_ROW = 21, LOW_GAP = 3, LOW_PAD = 12 };

DipFlow dip_flow_make(DipUi *ui, DipWindow *window, DipUiGroup group, DipRect body, int note_size,
                      bool narrow) {
    const int margin = dip_ui_px(ui, 8);
    const DipRect inside = {body.x + margin, body.y + dip_ui_px(ui, 6), body.width - 2 * margin,
                            body.height - margin};
    return (DipFlow){.ui = ui,
                     .window = window,
                     .group = group,
                     .note_size = note_size,
                     .body = inside,
                     .x = inside.x,
                     .y = inside.y,
                     .row = dip_ui_px(ui, narrow ? LOW_ROW : ROW),
                     .gap = dip_ui_px(ui, narrow ? LOW_GAP : GAP),
                     .pad = dip_ui_px(ui, narrow ? LOW_PAD : PAD),
                     .narrow = narrow};
}

void dip_flow_next_row(DipFlow *flow) {
    if (flow->x > flow->body.x) {
        flow->x = flow->body.x;
        flow->y += flow->row + flow->gap;
    }
}

void dip_flow_next_group(DipFlow *flow) {
    if (!flow->narrow) {
        dip_flow_next_row(flow);
    }
}

DipRect dip_flow_next(DipFlow *flow, int width) {
    if (flow->x + width > dip_rect_right(flow->body)) {
        dip_flow_next_row(flow);
    }
    if (flow->y + flow->row > dip_rect_bottom(flow->body) || width > flow->body.width) {
        return (DipRect){flow->x, flow->y, 0, 0};
    }
    const DipRect rect = {flow->x, flow->y, width, flow->row};
    flow->x += width + flow->gap;
    return rect;
}

int dip_flow_button_width(const DipFlow *flow, const char *text) {
    return dip_ui_text_width(flow->ui, LETTERS, text) + flow->pad;
}

bool dip_flow_button(DipFlow *flow, unsigned id, const char *text, DipUiLook look,
                     const char *tip) {
    const DipRect rect = dip_flow_next(flow, dip_flow_button_width(flow, text));
    return !dip_rect_is_empty(rect) &&
           dip_ui_button(flow->ui, DIP_UI_ID(flow->group, id), rect, text, look, tip);
}

bool dip_flow_choice(DipFlow *flow, unsigned id, const char *text, bool chosen, const char *tip) {
    return dip_flow_button(flow, id, text, chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, tip);
}

void dip_flow_text(DipFlow *flow, DipColour colour, const char *text) {
    const int width = dip_ui_text_width(flow->ui, flow->note_size, text) + dip_ui_px(flow->ui, 4);
    if (flow->narrow) {
        return;
    }
    if (width > flow->body.width) {
        dip_flow_next_row(flow);
        const DipRect room = {flow->x, flow->y, flow->body.width,
                              dip_rect_bottom(flow->body) - flow->y};
        flow->y += dip_ui_text_block(flow->ui, flow->note_size, colour, room, text) + flow->gap;
        return;
    }
    const DipRect rect = dip_flow_next(flow, width);
    if (!dip_rect_is_empty(rect)) {
        dip_ui_label(flow->ui, flow->note_size, colour, DIP_ALIGN_LEFT, rect, text);
    }
}
