// Fuzzes the readers of animated models, and evaluates what they accept. The first line of an input
// is the ending of the model's file name, the rest its content.
#include "assets/animation.h"
#include "assets/cameras.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// More vertices than this make each run slow, but reach no other code.
static const uint64_t max_values = 1 << 20;

static void check_finite(const float *values, uint64_t count) {
    for (uint64_t i = 0; i < count; i++) {
        FUZZ_CHECK(isfinite(values[i]));
    }
}

static void check_mesh(const DipAnimatedDef *def, const DipAnimatedMesh *mesh) {
    const uint64_t rows = (uint64_t)mesh->shape_count * mesh->vertex_count;
    FUZZ_CHECK(mesh->shape_count >= 1 && mesh->vertex_count >= 1 && mesh->index_count % 3 == 0);
    FUZZ_CHECK(mesh->material >= 0 && mesh->material < def->material_count);
    check_finite(mesh->positions, 3 * rows);
    check_finite(mesh->normals, 3 * rows);
    check_finite(mesh->uv0, mesh->uv0 ? 2 * (uint64_t)mesh->vertex_count : 0);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        FUZZ_CHECK(mesh->indices[i] < mesh->vertex_count);
    }
}

static uint64_t value_count(const DipAnimatedDef *def) {
    uint64_t count = 0;
    for (int i = 0; i < def->object_count; i++) {
        const DipAnimatedMesh *mesh = &def->meshes[def->objects[i].mesh];
        count += (uint64_t)mesh->shape_count * mesh->vertex_count;
    }
    return count;
}

static void check_poses(const DipAnimatedModel *model, const DipAnimatedDef *def) {
    static const double times_s[] = {0.0, 0.05, 0.7, 1e9, -3.0, INFINITY};
    DipAnimatedPose *pose = dip_animated_pose_create(model, NULL);
    FUZZ_CHECK(pose);
    for (int t = 0; t < 6; t++) {
        dip_animated_pose_set(pose, def->animation_count > 0 ? t % def->animation_count : 0,
                              times_s[t]);
        for (int i = 0; i < def->object_count; i++) {
            const uint32_t vertices = def->meshes[def->objects[i].mesh].vertex_count;
            float *positions = malloc(3 * sizeof(float) * vertices);
            float *normals = malloc(3 * sizeof(float) * vertices);
            dip_animated_pose_vertices(pose, i, positions, normals);
            check_finite(normals, 3 * (uint64_t)vertices); // Positions may overflow.
            free(positions);
            free(normals);
        }
    }
    dip_animated_pose_destroy(&pose);
}

// Every pose is finite, and its quaternion has unit length.
static void check_cameras(const char *file) {
    DipError err = {0};
    DipModelCameras *cameras = dip_model_cameras_load(file, DIP_UP_auto, NULL, &err);
    if (!cameras) {
        FUZZ_CHECK(err.code != DIP_ERROR_NONE && err.message[0] && !strchr(err.message, '\n'));
        return;
    }
    int count;
    const DipModelCamera *list = dip_model_cameras_list(cameras, &count);
    for (int i = 0; i < count; i++) {
        FUZZ_CHECK(list[i].key_count >= 1 && list[i].key_count <= 1000000);
        FUZZ_CHECK(list[i].period_ns >= 1000 && list[i].period_ns <= INT64_C(3600000000000));
        FUZZ_CHECK(list[i].fov_y_deg >= 1.0 && list[i].fov_y_deg <= 170.0);
        for (size_t k = 0; k < list[i].key_count; k++) {
            const double *key = list[i].keys[k];
            const double square =
                key[3] * key[3] + key[4] * key[4] + key[5] * key[5] + key[6] * key[6];
            FUZZ_CHECK(fabs(key[0]) <= 1e9 && fabs(key[1]) <= 1e9 && fabs(key[2]) <= 1e9);
            FUZZ_CHECK(fabs(square - 1.0) < 1e-9);
        }
    }
    dip_model_cameras_destroy(&cameras);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    static const char *const endings[] = {"md2", "gltf", "glb"};
    const uint8_t *newline =
        size_bytes > 0 ? memchr(bytes, '\n', size_bytes < 6 ? size_bytes : 6) : NULL;
    const size_t length = newline ? (size_t)(newline - bytes) : 0;
    const char *ending = NULL;
    for (size_t i = 0; i < 3; i++) {
        const bool same = length == strlen(endings[i]) && memcmp(bytes, endings[i], length) == 0;
        ending = same ? endings[i] : ending;
    }
    if (!ending) {
        return -1;
    }
    char name[32];
    snprintf(name, sizeof name, "model.%s", ending);
    const char *file = fuzz_write(name, newline + 1, size_bytes - length - 1);
    DipError err = {0};
    DipAnimatedModel *model = dip_animated_model_load(file, NULL, NULL, &err);
    if (model) {
        const DipAnimatedDef *def = dip_animated_model_def(model);
        for (int i = 0; i < def->mesh_count; i++) {
            check_mesh(def, &def->meshes[i]);
        }
        if (value_count(def) < max_values) {
            check_poses(model, def);
        }
    } else {
        FUZZ_CHECK(err.code != DIP_ERROR_NONE && err.message[0] && !strchr(err.message, '\n'));
    }
    dip_animated_model_destroy(&model);
    check_cameras(file);
    remove(file);
    return 0;
}
