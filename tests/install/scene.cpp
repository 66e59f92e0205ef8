// Draws a scene of one triangle from C++ with the installed libraries, with two settings.
#include <diptych/renderer/scene/renderer.h>
#include <diptych/renderer/scene/scene.h>

#include <cstdio>

static const float positions[] = {-1.0f, -1.0f, 0.0f, 1.0f, -1.0f, 0.0f, 0.0f, 1.0f, 0.0f};
static const uint32_t indices[] = {0, 1, 2};

static DipScene *make_scene(DipPool *pool, DipError *err) {
    DipMaterialDef material = {};
    material.colour_texture = material.light_map = material.normal_map = DIP_NO_TEXTURE;
    material.base_colour_lin[0] = 1.0f;
    DipMeshDef mesh = {};
    mesh.vertex_count = 3;
    mesh.positions = positions;
    mesh.index_count = 3;
    mesh.indices = indices;
    const DipObjectDef object = {"triangle", 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    DipSceneDef scene = {};
    scene.materials = &material;
    scene.material_count = 1;
    scene.meshes = &mesh;
    scene.mesh_count = 1;
    scene.objects = &object;
    scene.object_count = 1;
    scene.near_m = 0.1f;
    scene.sky = dip_sky_default();
    return dip_scene_create(&scene, pool, err);
}

int main() {
    DipError err = {};
    DipPool *pool = dip_pool_create(2, &err);
    DipScene *scene = make_scene(pool, &err);
    const DipPose pose = {{0.0, 0.0, 3.0}, {0.0, 0.0, 0.0, 1.0}, 60.0};
    uint64_t samples[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = pool;
        DipFrame frame = {};
        DipRenderer *renderer = nullptr;
        const char *settings[2] = {"aa=none", "aa=4"};
        if (!scene || !dip_quality_parse(settings[i], &def.quality, &err) ||
            !(renderer = dip_renderer_create(&def, &err)) ||
            !dip_renderer_draw(renderer, scene, &pose, 0, &frame, &err)) {
            std::fprintf(stderr, "scene: %s\n", err.message);
            return 1;
        }
        samples[i] = frame.counters.samples_shown;
        dip_renderer_destroy(&renderer);
    }
    dip_scene_destroy(&scene);
    dip_pool_destroy(&pool);
    std::printf("%llu and %llu samples shown\n", (unsigned long long)samples[0],
                (unsigned long long)samples[1]);
    return samples[0] > 10000 && samples[1] > 3 * samples[0] ? 0 : 1;
}
