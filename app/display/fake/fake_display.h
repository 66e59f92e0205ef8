// A display for tests: events come from a queue, and the picture it shows can be looked at.
//
// Its clock stands still except while it waits for an event that does not come, so that a test
// decides what time it is. Of a presented picture it takes over the damage rectangles alone, as a
// window does: a caller that forgets damage is found out.
#ifndef DIP_APP_DISPLAY_FAKE_FAKE_DISPLAY_H
#define DIP_APP_DISPLAY_FAKE_FAKE_DISPLAY_H

#include "app/display/display.h"

typedef struct DipFakeDisplay DipFakeDisplay;

enum { DIP_FAKE_MAX_EVENTS = 256 };

// Fills in a display of the given size in pixels. Returns NULL if memory runs out. The display's
// close function frees it.
DipFakeDisplay *dip_fake_display_open(DipDisplay *display, int width, int height);

// Appends an event. A test that appends more than DIP_FAKE_MAX_EVENTS at once is wrong.
void dip_fake_display_push(DipFakeDisplay *fake, const DipEvent *event);

// Appends a press and a release of a key.
void dip_fake_display_press(DipFakeDisplay *fake, DipKeycode key, unsigned modifiers);

// Appends a press and a release of a mouse button.
void dip_fake_display_click(DipFakeDisplay *fake, DipMouseButton button, int x, int y, int clicks);

// Changes the size and appends a RESIZE event. Returns false if memory runs out.
bool dip_fake_display_resize(DipFakeDisplay *fake, int width, int height);

// Changes the scale, which is 1 at first, and appends a RESIZE event.
void dip_fake_display_rescale(DipFakeDisplay *fake, double scale);

// Lets time go by.
void dip_fake_display_advance(DipFakeDisplay *fake, int64_t elapsed_ns);

// What the display shows. Valid until the next change of its size.
DipPixels dip_fake_display_picture(const DipFakeDisplay *fake);

// Number of pictures presented so far, and the pixels in the last one's damage rectangles.
int dip_fake_display_present_count(const DipFakeDisplay *fake);
int64_t dip_fake_display_damaged_pixels(const DipFakeDisplay *fake);

bool dip_fake_display_is_full_screen(const DipFakeDisplay *fake);

#endif
