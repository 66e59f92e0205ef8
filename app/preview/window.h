// The window: two pictures side by side and what stands over them.
#ifndef DIP_APP_PREVIEW_WINDOW_H
#define DIP_APP_PREVIEW_WINDOW_H

#include "app/preview/overlay.h"
#include "app/session.h"
#include "renderer/scene/frame.h"

#include <SDL2/SDL.h>

typedef struct DipWindow DipWindow;

// pane_width, pane_height: wished for; made smaller when the screen is. Fails with RUNTIME when
// there is no display.
DipWindow *dip_window_create(int pane_width, int pane_height, DipError *err);
void dip_window_destroy(DipWindow **window);

// The size each pane has now, at least 1x1.
void dip_window_pane_size(const DipWindow *window, int *width, int *height);

// The pane at a place of the window.
int dip_window_pane_at(const DipWindow *window, int x);

// Takes a pane's picture over.
bool dip_window_set_picture(DipWindow *window, int pane, const DipFrame *frame, DipError *err);

// Shows pictures and overlay.
void dip_window_present(DipWindow *window, const DipPreviewState *state,
                        const DipPaneFigures figures[DIP_PANE_COUNT]);

// Draws as present does, and writes the window's pixels to the first free diptych-0001.png,
// diptych-0002.png, ... of the working folder, whose name it fills in.
bool dip_window_screenshot(DipWindow *window, const DipPreviewState *state,
                           const DipPaneFigures figures[DIP_PANE_COUNT], char *file,
                           size_t size_bytes, DipError *err);

void dip_window_full_screen(DipWindow *window, bool on);

// Nanoseconds between two pictures of the screen.
int64_t dip_window_refresh_ns(const DipWindow *window);

#endif
