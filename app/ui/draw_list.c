// Records, compares and paints drawing commands.
#include "app/ui/draw_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LINE_BYTES = 512 };

typedef enum CommandKind { COMMAND_FILL, COMMAND_ROUND, COMMAND_PICTURE, COMMAND_TEXT } CommandKind;

typedef struct Command {
    CommandKind kind;
    DipRect box; // The command changes no pixel outside this rectangle.
    DipColour colour;
    uint64_t version;  // Version of the picture, for COMMAND_PICTURE.
    DipPixels picture; // Not compared: the version stands for the pixels.
    int size;          // Em size of the text; for COMMAND_ROUND, the radius.
    int x;             // Left end of the text; for COMMAND_ROUND, the width of the ring.
    int y;             // Top of the text.
    size_t text;       // Offset of the line in the frame's texts.
} Command;

typedef struct Frame {
    Command *commands;
    size_t count;
    size_t capacity;
    char *texts; // Lines, each with its terminating zero byte.
    size_t text_bytes;
    size_t text_capacity;
    int width;
    int height;
    // Of a recorded frame: false if memory ran out. Of the painted frame: false if the canvas may
    // show something else, so that the next frame is painted whole.
    bool complete;
} Frame;

struct DipDrawList {
    DipFont *font;
    Frame recorded;
    Frame painted;
};

// --- damage ------------------------------------------------------------------------------------

static int64_t area(DipRect rect) {
    return (int64_t)rect.width * rect.height;
}

// Returns the index of the rectangle whose area grows least when `rect` is united with it.
static int cheapest_to_unite(const DipDamage *damage, DipRect rect) {
    int best = 0;
    int64_t least = INT64_MAX;
    for (int i = 0; i < damage->count; ++i) {
        const int64_t growth =
            area(dip_rect_unite(damage->rects[i], rect)) - area(damage->rects[i]);
        if (growth < least) {
            least = growth;
            best = i;
        }
    }
    return best;
}

static int overlapping(const DipDamage *damage, DipRect rect) {
    for (int i = 0; i < damage->count; ++i) {
        if (!dip_rect_is_empty(dip_rect_intersect(damage->rects[i], rect))) {
            return i;
        }
    }
    return -1;
}

void dip_damage_add(DipDamage *damage, DipRect rect) {
    if (dip_rect_is_empty(rect)) {
        return;
    }
    int i;
    while ((i = overlapping(damage, rect)) >= 0 || damage->count == DIP_MAX_DAMAGE) {
        i = i >= 0 ? i : cheapest_to_unite(damage, rect);
        rect = dip_rect_unite(rect, damage->rects[i]);
        damage->rects[i] = damage->rects[--damage->count];
    }
    damage->rects[damage->count++] = rect;
}

// --- recording ---------------------------------------------------------------------------------

DipDrawList *dip_draw_list_create(DipFont *font, DipError *err) {
    DipDrawList *list = calloc(1, sizeof *list);
    if (!list) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "canvas", "out of memory");
        return NULL;
    }
    list->font = font;
    return list;
}

static void free_frame(Frame *frame) {
    free(frame->commands);
    free(frame->texts);
    *frame = (Frame){0};
}

void dip_draw_list_destroy(DipDrawList **list) {
    if (!*list) {
        return;
    }
    free_frame(&(*list)->recorded);
    free_frame(&(*list)->painted);
    free(*list);
    *list = NULL;
}

DipFont *dip_draw_list_font(const DipDrawList *list) {
    return list->font;
}

int dip_draw_list_width(const DipDrawList *list) {
    return list->recorded.width;
}

int dip_draw_list_height(const DipDrawList *list) {
    return list->recorded.height;
}

void dip_draw_list_begin(DipDrawList *list, int width, int height) {
    Frame *frame = &list->recorded;
    frame->count = frame->text_bytes = 0;
    frame->width = width;
    frame->height = height;
    frame->complete = true;
}

// Makes room for `more` items after the first `used` ones. If the array must grow, it at least
// doubles.
static bool reserve(void **items, size_t *capacity, size_t used, size_t more, size_t item_bytes) {
    if (used + more <= *capacity) {
        return true;
    }
    const size_t wanted = 2 * (used + more) + 64;
    void *grown = realloc(*items, wanted * item_bytes);
    if (!grown) {
        return false;
    }
    *items = grown;
    *capacity = wanted;
    return true;
}

static void add_command(DipDrawList *list, const Command *command) {
    if (!list) {
        return;
    }
    Frame *frame = &list->recorded;
    void *items = frame->commands;
    frame->complete &= reserve(&items, &frame->capacity, frame->count, 1, sizeof *frame->commands);
    frame->commands = items;
    if (frame->complete) {
        frame->commands[frame->count++] = *command;
    }
}

void dip_draw_list_fill(DipDrawList *list, DipRect rect, DipColour colour) {
    add_command(list, &(Command){COMMAND_FILL, .box = rect, .colour = colour});
}

void dip_draw_list_round(DipDrawList *list, DipRect rect, int radius, int ring, DipColour colour) {
    add_command(
        list, &(Command){COMMAND_ROUND, .box = rect, .colour = colour, .size = radius, .x = ring});
}

void dip_draw_list_picture(DipDrawList *list, DipRect rect, const DipPixels *picture,
                           uint64_t version) {
    add_command(list,
                &(Command){COMMAND_PICTURE, .box = rect, .picture = *picture, .version = version});
}

static bool add_text(Frame *frame, const char *line, size_t *offset) {
    const size_t bytes = strlen(line) + 1;
    void *texts = frame->texts;
    frame->complete &= reserve(&texts, &frame->text_capacity, frame->text_bytes, bytes, 1);
    frame->texts = texts;
    if (frame->complete) {
        memcpy(frame->texts + frame->text_bytes, line, bytes);
        *offset = frame->text_bytes;
        frame->text_bytes += bytes;
    }
    return frame->complete;
}

void dip_draw_list_text(DipDrawList *list, int size, DipColour colour, DipAlign align, int x, int y,
                        int max_width, const char *line) {
    if (!list) {
        return;
    }
    char fitting[MAX_LINE_BYTES];
    snprintf(fitting, sizeof fitting, "%s", line);
    dip_font_fit(list->font, size, max_width, fitting, sizeof fitting);
    const int width = dip_font_width(list->font, size, fitting);
    x -= align == DIP_ALIGN_RIGHT ? width : align == DIP_ALIGN_CENTRE ? width / 2 : 0;
    const int overhang = size / 4 + 1; // How far a letter may reach beyond its line's ends.
    Command command = {COMMAND_TEXT, .colour = colour, .size = size, .x = x, .y = y};
    command.box =
        (DipRect){x - overhang, y, width + 2 * overhang, dip_font_line_height(list->font, size)};
    if (fitting[0] && add_text(&list->recorded, fitting, &command.text)) {
        add_command(list, &command);
    }
}

// --- painting ----------------------------------------------------------------------------------

static bool same_command(const Frame *a, const Frame *b, size_t index) {
    const Command *p = &a->commands[index];
    const Command *q = &b->commands[index];
    return p->kind == q->kind && dip_rect_equals(p->box, q->box) &&
           memcmp(&p->colour, &q->colour, sizeof p->colour) == 0 && p->version == q->version &&
           p->size == q->size && p->x == q->x && p->y == q->y &&
           (p->kind != COMMAND_TEXT || strcmp(a->texts + p->text, b->texts + q->text) == 0);
}

// Finds the rectangles to repaint. They are the boxes of all commands that differ from the command
// with the same index in the other list. Outside these boxes, both lists draw the same commands in
// the same order. If the size has changed or `before` was not painted, everything is repainted.
static void find_damage(const Frame *before, const Frame *now, DipDamage *damage) {
    const DipRect whole = {0, 0, now->width, now->height};
    const size_t count = before->count > now->count ? before->count : now->count;
    damage->count = 0;
    if (before->width != now->width || before->height != now->height || !before->complete) {
        dip_damage_add(damage, whole);
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        if (i < before->count && i < now->count && same_command(before, now, i)) {
            continue;
        }
        if (i < before->count) {
            dip_damage_add(damage, dip_rect_intersect(before->commands[i].box, whole));
        }
        if (i < now->count) {
            dip_damage_add(damage, dip_rect_intersect(now->commands[i].box, whole));
        }
    }
}

static void paint_command(DipDrawList *list, const Command *command, DipCanvas *canvas,
                          DipRect clip) {
    const DipRect inside = dip_rect_intersect(command->box, clip);
    if (dip_rect_is_empty(inside)) {
        return;
    }
    dip_canvas_set_clip(canvas, inside);
    switch (command->kind) {
    case COMMAND_FILL:
        dip_canvas_fill(canvas, command->box, command->colour);
        break;
    case COMMAND_ROUND:
        dip_canvas_round(canvas, command->box, command->size, command->x, command->colour);
        break;
    case COMMAND_PICTURE:
        dip_canvas_copy(canvas, command->box, &command->picture);
        break;
    case COMMAND_TEXT:
        dip_font_draw(list->font, canvas, command->size, command->colour, command->x, command->y,
                      list->recorded.texts + command->text);
        break;
    }
}

bool dip_draw_list_paint(DipDrawList *list, DipCanvas *canvas, DipDamage *damage, DipError *err) {
    const Frame frame = list->recorded;
    if (!frame.complete) {
        list->painted.complete = false;
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "canvas", "out of memory");
    }
    if (!dip_canvas_resize(canvas, frame.width, frame.height, err)) {
        list->painted.complete = false;
        return false;
    }
    find_damage(&list->painted, &frame, damage);
    for (int d = 0; d < damage->count; ++d) {
        for (size_t i = 0; i < frame.count; ++i) {
            paint_command(list, &frame.commands[i], canvas, damage->rects[d]);
        }
    }
    list->recorded = list->painted;
    list->painted = frame;
    return true;
}
