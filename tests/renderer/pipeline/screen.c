// Creates scenes whose vertices fall on chosen screen positions, for tests of the reference.
#include "tests/renderer/pipeline/screen.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

DipScreenPoint dip_screen_snap(double x, double y, double w) {
    return (DipScreenPoint){rint(x * 256.0) / 256.0, rint(y * 256.0) / 256.0, w};
}

void dip_screen_begin(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    scene->def.near_m = 1.0f / 16.0f;
    scene->pose.fov_y_deg = 90.0;
}

int dip_screen_add_white(DipTestScene *scene) {
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[material].double_sided = true;
    return material;
}

DipTestMesh dip_screen_add_polygon(DipTestScene *scene, int material, const DipScreenPoint *points,
                                   int count, int arrays) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const uint32_t index_count = count == 3 ? 3 : 6;
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, (uint32_t)count, index_count, arrays, material);
    memcpy(mesh.indices, indices, index_count * sizeof *indices);
    for (int i = 0; i < count; i++) {
        mesh.positions[3 * i] = (float)((points[i].x / 32.0 - 1.0) * points[i].w);
        mesh.positions[3 * i + 1] = (float)((1.0 - points[i].y / 32.0) * points[i].w);
        mesh.positions[3 * i + 2] = (float)-points[i].w;
    }
    return mesh;
}

void dip_screen_add_cover(DipTestScene *scene, int material, float u, float v) {
    const double end = DIP_SCREEN + 1;
    const DipScreenPoint points[4] = {{-1, -1, 1}, {-1, end, 1}, {end, end, 1}, {end, -1, 1}};
    const DipTestMesh mesh = dip_screen_add_polygon(scene, material, points, 4, DIP_TEST_UV0);
    for (int i = 0; i < 4; i++) {
        mesh.uv0[2 * i] = u * (float)(points[i].x / DIP_SCREEN);
        mesh.uv0[2 * i + 1] = v * (float)(points[i].y / DIP_SCREEN);
    }
}

static void require(bool done, const DipError *err) {
    if (!done) {
        char text[640];
        dip_error_format(err, text, sizeof text);
        fail_msg("%s", text);
    }
}

void dip_screen_draw(const DipTestScene *scene, const char *settings, DipScreenPicture picture) {
    DipError err = {0};
    DipQuality quality;
    require(dip_quality_parse(settings, &quality, &err), &err);
    DipReference *reference = dip_reference_create(&scene->def, &err);
    require(reference != NULL, &err);
    require(dip_reference_draw(reference, &quality, &scene->pose, DIP_SCREEN, DIP_SCREEN,
                               &picture[0][0][0], &err),
            &err);
    dip_reference_destroy(&reference);
}

void dip_screen_converge(const DipTestScene *scene, int sample_count, uint32_t seed,
                         DipScreenPicture picture) {
    DipError err = {0};
    DipReference *reference = dip_reference_create(&scene->def, &err);
    require(reference != NULL, &err);
    require(dip_reference_converge(reference, &scene->pose, DIP_SCREEN, DIP_SCREEN, sample_count,
                                   seed, &picture[0][0][0], &err),
            &err);
    dip_reference_destroy(&reference);
}
