// Draws one scene with two settings, side by side: what a settings panel needs of Diptych when it
// does not use the program. Only the libraries `scene` and `pipeline` are linked.
//
// Usage: compare SETTINGS SETTINGS FILE.ppm    for example: compare aa=none aa=4,af=16 out.ppm
#include "renderer/scene/renderer.h"
#include "renderer/scene/scene.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240, TEXELS = 64, PANES = 2 };

// A floor of 40x40 m and a thin board on it, which leans. Each row is x, y, z and u, v.
static const float vertices[8][5] = {
    {-20.0f, 0.0f, 5.0f, 0.0f, 0.0f},    {20.0f, 0.0f, 5.0f, 20.0f, 0.0f},
    {20.0f, 0.0f, -35.0f, 20.0f, 20.0f}, {-20.0f, 0.0f, -35.0f, 0.0f, 20.0f},
    {-1.2f, 0.0f, -4.0f, 0.0f, 1.0f},    {-0.9f, 0.0f, -4.0f, 1.0f, 1.0f},
    {0.9f, 2.4f, -4.5f, 1.0f, 0.0f},     {0.6f, 2.4f, -4.5f, 0.0f, 0.0f},
};
static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};

static void make_chequers(uint8_t rgba8[TEXELS][TEXELS][4]) {
    for (int y = 0; y < TEXELS; y++) {
        for (int x = 0; x < TEXELS; x++) {
            const uint8_t light = (x / 16 + y / 16) % 2 ? 230 : 60;
            memset(rgba8[y][x], light, 3);
            rgba8[y][x][3] = 255;
        }
    }
}

// Describes the scene and creates it. The scene keeps no pointer to the description.
static DipScene *make_scene(DipPool *pool, DipError *err) {
    static uint8_t rgba8[TEXELS][TEXELS][4];
    float positions[8][3], uv[8][2];
    make_chequers(rgba8);
    for (int v = 0; v < 8; v++) {
        memcpy(positions[v], vertices[v], sizeof positions[v]);
        memcpy(uv[v], vertices[v] + 3, sizeof uv[v]);
    }
    const DipTextureDef texture = {
        .name = "chequers", .width = TEXELS, .height = TEXELS, .rgba8 = &rgba8[0][0][0]};
    const DipMaterialDef materials[2] = {
        {.name = "stone",
         .base_colour_lin = {0.6f, 0.65f, 0.7f},
         .light_map = DIP_NO_TEXTURE,
         .normal_map = DIP_NO_TEXTURE},
        {.name = "paint",
         .base_colour_lin = {0.9f, 0.2f, 0.1f},
         .colour_texture = DIP_NO_TEXTURE,
         .light_map = DIP_NO_TEXTURE,
         .normal_map = DIP_NO_TEXTURE,
         .double_sided = true},
    };
    DipMeshDef meshes[2] = {{.name = "floor"}, {.name = "board"}};
    DipObjectDef objects[2] = {{.name = "floor"}, {.name = "board"}};
    for (int m = 0; m < 2; m++) {
        meshes[m].vertex_count = 4;
        meshes[m].positions = positions[4 * m];
        meshes[m].uv0 = uv[4 * m];
        meshes[m].index_count = 6;
        meshes[m].indices = indices;
        meshes[m].material = objects[m].mesh = m;
        objects[m].transform[0] = objects[m].transform[5] = objects[m].transform[10] = 1.0f;
    }
    const DipSceneDef def = {
        .textures = &texture,
        .materials = materials,
        .meshes = meshes,
        .objects = objects,
        .texture_count = 1,
        .material_count = 2,
        .mesh_count = 2,
        .object_count = 2,
        .background_lin = {0.35f, 0.5f, 0.75f},
        .near_m = 0.1f,
        .sky = dip_sky_default(),
    };
    return dip_scene_create(&def, pool, err);
}

// Draws both panes together, which shares the geometry stage.
static bool draw(DipRenderer *const *renderers, const DipScene *scene, DipFrame frames[PANES],
                 DipError *err) {
    // The camera stands 1.7 m above the floor and looks along -z, a little down.
    const DipPose pose = {{0.0, 1.7, 0.0}, {-0.1, 0.0, 0.0, 1.0}, 50.0};
    DipFrame *const both[PANES] = {&frames[0], &frames[1]};
    return dip_renderer_draw_frames(renderers, PANES, scene, &pose, 0, both, err);
}

static bool write_ppm(const char *file, const DipFrame frames[PANES]) {
    FILE *out = fopen(file, "wb");
    if (!out) {
        return false;
    }
    fprintf(out, "P6\n%d %d\n255\n", PANES * WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; y++) {
        for (int p = 0; p < PANES; p++) {
            for (int x = 0; x < WIDTH; x++) {
                fwrite(frames[p].rgba8 + (size_t)y * frames[p].stride_bytes + 4 * (size_t)x, 1, 3,
                       out);
            }
        }
    }
    return fclose(out) == 0;
}

int main(int argc, char **argv) {
    DipRenderer *renderers[PANES] = {NULL, NULL};
    DipFrame frames[PANES];
    DipError err = {0};
    if (argc != 4) {
        fprintf(stderr, "Usage: compare SETTINGS SETTINGS FILE.ppm\n");
        return 2;
    }
    DipPool *pool = dip_pool_create(0, &err); // 0: as many threads as there are processors
    DipScene *scene = pool ? make_scene(pool, &err) : NULL;
    bool done = scene != NULL;
    for (int p = 0; p < PANES && done; p++) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = pool;
        def.width = WIDTH;
        def.height = HEIGHT;
        done = dip_quality_parse(argv[1 + p], &def.quality, &err) &&
               (renderers[p] = dip_renderer_create(&def, &err));
    }
    done = done && draw(renderers, scene, frames, &err);
    if (!done) {
        fprintf(stderr, "compare: [%s] %s\n", err.key, err.message);
    } else if (!write_ppm(argv[3], frames)) {
        perror(argv[3]);
        done = false;
    } else {
        printf("%llu and %llu samples shown\n",
               (unsigned long long)frames[0].counters.samples_shown,
               (unsigned long long)frames[1].counters.samples_shown);
    }
    for (int p = 0; p < PANES; p++) {
        dip_renderer_destroy(&renderers[p]);
    }
    dip_scene_destroy(&scene);
    dip_pool_destroy(&pool);
    return done ? 0 : 1;
}
