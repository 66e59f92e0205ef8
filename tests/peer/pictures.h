// Writing both sides' pictures, to be looked at side by side.
#ifndef DIP_TESTS_PEER_PICTURES_H
#define DIP_TESTS_PEER_PICTURES_H

#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stdint.h>

#include "renderer/base/error.h"

// Writes FOLDER/ROW_0000_ours.ppm and, where peer_rgba8 (packed, the frame's size) is not NULL,
// ROW_0000_peer.ppm. The folder must exist.
bool dip_pictures_write(const char *folder, const char *row, int index, const DipFrame *ours,
                        const uint8_t *peer_rgba8, DipError *err);

#endif
