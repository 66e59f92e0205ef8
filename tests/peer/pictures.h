// Writes the pictures of our renderer and of the peer to files for visual comparison.
#ifndef DIP_TESTS_PEER_PICTURES_H
#define DIP_TESTS_PEER_PICTURES_H

#include "renderer/scene/frame.h"

#include <stdbool.h>
#include <stdint.h>

#include "renderer/base/error.h"

// Writes FOLDER/ROW_0000_ours.ppm and, if peer_rgba8 is not NULL, FOLDER/ROW_0000_peer.ppm, where
// 0000 stands for the frame's index. peer_rgba8 has the size of the frame, and its rows have no
// padding. The folder must exist.
bool dip_pictures_write(const char *folder, const char *row, int index, const DipFrame *ours,
                        const uint8_t *peer_rgba8, DipError *err);

#endif
