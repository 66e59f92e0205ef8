// Writes the pictures of both sides to files, so that they can be compared side by side.
#ifndef DIP_TESTS_PEER_PICTURES_H
#define DIP_TESTS_PEER_PICTURES_H

#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stdint.h>

#include "renderer/base/error.h"

// Writes FOLDER/ROW_0000_ours.ppm and, if peer_rgba8 is not NULL, FOLDER/ROW_0000_peer.ppm, where
// 0000 is the index. peer_rgba8 has the size of the frame, without padding. The folder must exist.
bool dip_pictures_write(const char *folder, const char *row, int index, const DipFrame *ours,
                        const uint8_t *peer_rgba8, DipError *err);

#endif
