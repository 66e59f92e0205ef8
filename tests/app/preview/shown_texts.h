// Keeps the texts that a window draws, for tests. A test that uses it is linked with
// --wrap=dip_draw_list_text.
#ifndef DIP_TESTS_APP_PREVIEW_SHOWN_TEXTS_H
#define DIP_TESTS_APP_PREVIEW_SHOWN_TEXTS_H

#include <stdbool.h>

// Forgets all texts.
void dip_shown_texts_forget(void);

// Returns the first line drawn since then that contains a part, or NULL. Sets *whole to whether the
// line was drawn without being shortened; whole may be NULL.
const char *dip_shown_text(const char *part, bool *whole);

#endif
