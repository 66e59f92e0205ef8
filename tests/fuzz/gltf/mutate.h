// Changes glTF files at random, so that most of them are still read to some depth.
#ifndef DIP_TESTS_FUZZ_GLTF_MUTATE_H
#define DIP_TESTS_FUZZ_GLTF_MUTATE_H

#include "renderer/catalogue/random.h"

#include <stddef.h>
#include <stdint.h>

// Changes a .gltf or .glb file of size_bytes in place, within its room of room_bytes. Changes
// texts, numbers and structure of the JSON, bytes of the binary part, and characters of "data:"
// addresses, or cuts the file's end off. Afterwards mostly mends the lengths in the header of a
// .glb file, since a reader refuses a file with other ones at once. Returns the new size.
size_t mutate_gltf(Random *random, uint8_t *bytes, size_t size_bytes, size_t room_bytes);

#endif
