// Declares the interface between the preview and the display that shows it: pixels go out, events
// come in.
//
// A display is a struct of functions and a context. A back end (a folder beside this file) fills
// in the struct, and the preview's loop uses nothing else of a back end. All functions of one
// display must be called on one thread. Their first argument is the context:
//
//     display.present(display.context, &picture, rects, 1, err);
#ifndef DIP_APP_DISPLAY_DISPLAY_H
#define DIP_APP_DISPLAY_DISPLAY_H

#include "app/ui/event.h"
#include "app/ui/pixels.h"
#include "renderer/base/error.h"

// A character cell of a display that shows characters, such as a terminal. A cell covers one pixel
// of the picture and the pixel below that one.
typedef struct DipTextCell {
    uint32_t code;   // Code point of a character one cell wide; 0 if the cell shows the picture.
    DipColour ink;   // Colour of the character. Alpha is ignored.
    DipColour paper; // Colour behind the character. Alpha is ignored.
} DipTextCell;

typedef struct DipDisplay {
    void *context;

    // Shows a picture. Only the pixels inside the damage rectangles differ from the picture shown
    // before; after a RESIZE or EXPOSE event the damage must cover the whole picture. The picture
    // should have the display's size; if the sizes differ, only the part that lies within both is
    // shown. The display keeps no pointer to the picture. Fails with RUNTIME.
    bool (*present)(void *context, const DipPixels *picture, const DipRect *damage, int count,
                    DipError *err);

    // Fills in the next event. Waits at most timeout_ms milliseconds for one; 0 does not wait.
    // Returns false if there is no event.
    bool (*next_event)(void *context, int timeout_ms, DipEvent *event);

    // Gets the size of the picture to present, in pixels, at least 1x1.
    void (*size)(void *context, int *width, int *height);

    // Returns the factor by which text and controls are enlarged: 1 on a plain screen, 2 on a
    // screen with pixels half as large.
    double (*scale)(void *context);

    // Returns the number of pictures per second that the display can show.
    double (*refresh_hz)(void *context);

    // Returns the time in nanoseconds since an arbitrary moment. The clock advances while
    // next_event waits. NULL: the display has the time of dip_clock_ns (renderer/base/clock.h).
    int64_t (*now_ns)(void *context);

    // Returns whether nobody can see the picture, because the display is minimised or hidden. When
    // the display shows again, an EXPOSE event comes. NULL if the display cannot tell.
    bool (*is_hidden)(void *context);

    // Turns full-screen mode on or off. NULL if the display has no such mode.
    void (*set_full_screen)(void *context, bool on);

    // Gives the window a title. NULL if the display has no title.
    void (*set_title)(void *context, const char *title);

    // Puts a text into the clipboard. Returns false if that failed. NULL if the display has no
    // clipboard.
    bool (*set_clipboard)(void *context, const char *text);

    // Asks for another size of the picture, in pixels. The display may take another size than the
    // one asked for. NULL if another program decides the size.
    void (*set_size)(void *context, int width, int height);

    // Sets the characters that the next present shows over the picture: `rows` rows of `columns`
    // cells, the top row first. The picture to present has `columns` x 2 `rows` pixels. The display
    // copies the cells. NULL if the display shows pixels only.
    void (*set_text)(void *context, const DipTextCell *cells, int columns, int rows);

    // Closes the display and frees the context.
    void (*close)(void *context);

    // Copies the text of the clipboard, cut to the buffer. Returns false if the clipboard holds no
    // text. NULL if the display has no clipboard.
    bool (*get_clipboard)(void *context, char *text, size_t size_bytes);
} DipDisplay;

#endif
