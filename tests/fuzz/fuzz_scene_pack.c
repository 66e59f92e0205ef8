// Fuzzes the reader of scene packs, the program's protection against an importer that was misled by
// a bad model file. Everything that an accepted pack points to lies inside of it; the scene is the
// same when it is written and read again; and the renderer accepts the scene or refuses it.
#define _GNU_SOURCE // memfd_create
#include "assets/pack/scene_pack.h"
#include "tests/assets/same_scene.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mutate_pack.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

// Writes a pack and returns its bytes. The caller frees them.
static uint8_t *write_pack(const DipScenePack *pack, size_t *size_bytes) {
    const int file = memfd_create("pack", MFD_CLOEXEC);
    FUZZ_CHECK(file >= 0);
    FUZZ_CHECK(dip_scene_pack_write(file, pack));
    const off_t end = lseek(file, 0, SEEK_END);
    FUZZ_CHECK(end > 0);
    uint8_t *bytes = malloc((size_t)end);
    FUZZ_CHECK(bytes && pread(file, bytes, (size_t)end, 0) == end);
    close(file);
    *size_bytes = (size_t)end;
    return bytes;
}

static void check_messages(const DipScenePack *pack, const DipScenePack *again) {
    FUZZ_CHECK(memcmp(&pack->failure, &again->failure, sizeof pack->failure) == 0);
    FUZZ_CHECK(pack->warnings.count == again->warnings.count);
    for (size_t i = 0; i < pack->warnings.count; i++) {
        const DipError *a = &pack->warnings.items[i];
        const DipError *b = &again->warnings.items[i];
        FUZZ_CHECK(a->code == b->code && a->line == b->line && a->origin == b->origin);
        FUZZ_CHECK(strcmp(a->message, b->message) == 0 && strcmp(a->key, b->key) == 0);
    }
}

static void check_accepted(const DipScenePack *pack) {
    read_whole_scene(&pack->scene);
    size_t size_bytes;
    uint8_t *bytes = write_pack(pack, &size_bytes);
    DipScenePack again;
    FUZZ_CHECK(dip_scene_pack_read(bytes, size_bytes, &again, NULL));
    if (pack->failure.code == DIP_ERROR_NONE) { // A failure is written without a scene.
        assert_same_scene(&pack->scene, &again.scene);
    }
    check_messages(pack, &again);
    dip_scene_pack_free(&again);
    free(bytes);
    DipError err = {0};
    DipScene *scene = dip_scene_create(&pack->scene, NULL, &err);
    FUZZ_CHECK(scene || (err.code != DIP_ERROR_NONE && err.message[0]));
    dip_scene_destroy(&scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    uint8_t *copy = fuzz_copy(bytes, size_bytes, false);
    DipScenePack pack;
    DipError err = {0};
    if (dip_scene_pack_read(copy, size_bytes, &pack, &err)) {
        check_accepted(&pack);
    } else {
        FUZZ_CHECK(err.code == DIP_ERROR_FORMAT || err.code == DIP_ERROR_MEMORY);
        FUZZ_CHECK(err.message[0] && !pack.scene.objects);
    }
    dip_scene_pack_free(&pack);
    free(copy);
    return 0;
}

#ifdef FUZZ_WITH_LIBFUZZER
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size_bytes, size_t most_bytes,
                               unsigned seed) {
    return mutate_pack(bytes, size_bytes, most_bytes, seed);
}
#endif
