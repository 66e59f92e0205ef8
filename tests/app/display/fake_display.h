// A display for tests: events come from a queue, and the test can read the shown picture.
//
// The test controls the time. The display's clock advances when the test advances the clock, and
// when the display waits for an event and none comes. The display copies only the damage rectangles
// of a presented picture, as a window does; a test therefore notices if the preview forgets to
// report damage.
#ifndef DIP_TESTS_APP_DISPLAY_FAKE_DISPLAY_H
#define DIP_TESTS_APP_DISPLAY_FAKE_DISPLAY_H

#include "app/display/display.h"

typedef struct DipFakeDisplay DipFakeDisplay;

enum { DIP_FAKE_MAX_EVENTS = 256 };

// Fills in a display of the given size in pixels. Returns NULL if memory runs out. The display's
// close function frees it.
DipFakeDisplay *dip_fake_display_open(DipDisplay *display, int width, int height);

// Appends an event to the queue. The queue must not hold more than DIP_FAKE_MAX_EVENTS events.
void dip_fake_display_push(DipFakeDisplay *fake, const DipEvent *event);

// Appends a press and a release of a key.
void dip_fake_display_press(DipFakeDisplay *fake, DipKeycode key, unsigned modifiers);

// Appends a press and a release of a mouse button.
void dip_fake_display_click(DipFakeDisplay *fake, DipMouseButton button, int x, int y, int clicks);

// Changes the size and appends a RESIZE event. Returns false if memory runs out.
bool dip_fake_display_resize(DipFakeDisplay *fake, int width, int height);

// Changes the scale, which is 1 at first, and appends a RESIZE event.
void dip_fake_display_rescale(DipFakeDisplay *fake, double scale);

// Hides the display, or shows it and appends an EXPOSE event.
void dip_fake_display_hide(DipFakeDisplay *fake, bool hidden);

// Advances the clock.
void dip_fake_display_advance(DipFakeDisplay *fake, int64_t elapsed_ns);

// Returns the shown picture, which is valid until the display's size changes.
DipPixels dip_fake_display_picture(const DipFakeDisplay *fake);

// Return the number of pictures presented so far, and the number of pixels in the damage rectangles
// of the last one.
int dip_fake_display_present_count(const DipFakeDisplay *fake);
int64_t dip_fake_display_damaged_pixels(const DipFakeDisplay *fake);

// Returns the text of the display's clipboard, "" at first.
const char *dip_fake_display_clipboard(const DipFakeDisplay *fake);

bool dip_fake_display_is_full_screen(const DipFakeDisplay *fake);

#endif
