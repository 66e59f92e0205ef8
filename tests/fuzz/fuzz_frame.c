// Fuzzes drawing: the renderer must draw every scene that it accepts. An input is a pose, settings,
// and a scene pack. The picture has the same bits with the scalar kernels and with the machine's
// best.
#include "assets/pack/scene_pack.h"
#include "renderer/scene/renderer.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mutate_pack.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 24, HEIGHT = 16, MOST_TRIANGLES = 2000, MOST_TEXELS = 1 << 16 };

typedef struct Input {
    float position[3];
    float orientation[4];
    float fov_y_deg;
    float time_s;
    uint8_t step[DIP_SETTING_COUNT];
} Input;

static DipPool *pool;

// Drawing larger scenes is slow, but reaches no other code.
static bool is_small(const DipSceneDef *scene) {
    uint64_t triangles = 0;
    uint64_t texels = 0;
    for (int i = 0; i < scene->object_count; i++) {
        triangles += scene->meshes[scene->objects[i].mesh].index_count / 3;
    }
    for (int i = 0; i < scene->texture_count; i++) {
        texels += (uint64_t)scene->textures[i].width * (uint64_t)scene->textures[i].height;
    }
    return triangles <= MOST_TRIANGLES && texels <= MOST_TEXELS;
}

// Draws a frame into pixels. Returns false if the renderer refuses it.
static bool draw(const DipScene *scene, const Input *input, DipIsa isa,
                 uint8_t pixels[HEIGHT][WIDTH][4]) {
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.isa = isa;
    def.width = WIDTH;
    def.height = HEIGHT;
    memcpy(def.quality.step, input->step, sizeof input->step);
    DipError err = {0};
    DipRenderer *renderer = dip_renderer_create(&def, &err);
    if (!renderer) {
        return false;
    }
    DipPose pose = {.fov_y_deg = input->fov_y_deg};
    for (int i = 0; i < 4; i++) {
        pose.position_world[i % 3] = input->position[i % 3];
        pose.orientation[i] = input->orientation[i];
    }
    const int64_t time_ns = input->time_s > -1e9f && input->time_s < 1e9f
                                ? (int64_t)(1e9 * (double)input->time_s)
                                : INT64_MAX;
    DipFrame frame;
    const bool drawn = dip_renderer_draw(renderer, scene, &pose, time_ns, &frame, &err);
    FUZZ_CHECK(drawn || (err.code != DIP_ERROR_NONE && err.message[0]));
    for (int y = 0; drawn && y < HEIGHT; y++) {
        memcpy(pixels[y], frame.rgba8 + (size_t)y * frame.stride_bytes, sizeof pixels[y]);
    }
    dip_renderer_destroy(&renderer);
    return drawn;
}

// Returns false if the renderer refuses the scene or the frame.
static bool check_scene(const DipSceneDef *def, const Input *input) {
    static uint8_t scalar[HEIGHT][WIDTH][4];
    static uint8_t best[HEIGHT][WIDTH][4];
    DipScene *scene = is_small(def) ? dip_scene_create(def, NULL, NULL) : NULL;
    if (!scene) {
        return false;
    }
    const bool drawn = draw(scene, input, DIP_ISA_SCALAR, scalar);
    FUZZ_CHECK(drawn == draw(scene, input, dip_renderer_default_def().isa, best));
    FUZZ_CHECK(!drawn || memcmp(scalar, best, sizeof best) == 0);
    dip_scene_destroy(&scene);
    return drawn;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    Input input;
    if (size_bytes <= sizeof input) {
        return -1;
    }
    pool = pool ? pool : dip_pool_create(1, NULL);
    FUZZ_CHECK(pool != NULL);
    memcpy(&input, bytes, sizeof input);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        input.step[s] %= (uint8_t)dip_setting_info((DipSetting)s)->step_count;
    }
    uint8_t *copy = fuzz_copy(bytes + sizeof input, size_bytes - sizeof input, false);
    DipScenePack pack;
    const bool drawn = dip_scene_pack_read(copy, size_bytes - sizeof input, &pack, NULL) &&
                       check_scene(&pack.scene, &input);
    dip_scene_pack_free(&pack);
    free(copy);
    return drawn ? 0 : -1; // What is not drawn is left to fuzz_scene_pack.
}

#ifdef FUZZ_WITH_LIBFUZZER
// One time of four, mutates the pose and the settings, else the pack.
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size_bytes, size_t most_bytes,
                               unsigned seed) {
    if (size_bytes <= sizeof(Input)) {
        return LLVMFuzzerMutate(bytes, size_bytes, most_bytes);
    }
    if (seed % 4 == 0) {
        uint8_t input[sizeof(Input)];
        memcpy(input, bytes, sizeof input);
        LLVMFuzzerMutate(input, sizeof input, sizeof input);
        memcpy(bytes, input, sizeof input);
        return size_bytes;
    }
    return sizeof(Input) + mutate_pack(bytes + sizeof(Input), size_bytes - sizeof(Input),
                                       most_bytes - sizeof(Input), seed / 4);
}
#endif
