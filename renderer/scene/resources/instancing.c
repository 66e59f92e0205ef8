// Copies meshes that several objects share, so that each object has a mesh of its own.
#include "renderer/scene/resources/instancing.h"

#include "renderer/scene/resources/posed.h"
#include "renderer/scene/resources/scene_layout.h"

#include <stdlib.h>

struct DipUnsharedMeshes {
    const DipScene *scene;
    int count;        // number of objects
    DipMesh **copies; // one per object; NULL: the object keeps the scene's mesh
    uint64_t bytes;   // memory of all meshes that are drawn, including the scene's
};

// Whether an object gets a copy of its mesh. A mesh that moves is not copied.
static bool is_copied(const DipScene *scene, int object) {
    const DipSceneObject *placed = &scene->objects[object];
    return !placed->first_of_mesh && dip_moving_mesh(scene->motion, placed->mesh) < 0;
}

static void copy_mesh(void *context, int index, int worker) {
    (void)worker;
    const DipUnsharedMeshes *unshared = context;
    const DipSceneObject *object = &unshared->scene->objects[index];
    if (is_copied(unshared->scene, index)) {
        unshared->copies[index] = dip_mesh_copy(unshared->scene->meshes[object->mesh].mesh);
    }
}

static bool is_complete(const DipUnsharedMeshes *unshared) {
    for (int i = 0; i < unshared->count; i++) {
        if (is_copied(unshared->scene, i) && !unshared->copies[i]) {
            return false;
        }
    }
    return true;
}

DipUnsharedMeshes *dip_unshared_meshes_create(const DipScene *scene, DipPool *pool, DipError *err) {
    DipUnsharedMeshes *unshared = calloc(1, sizeof *unshared);
    if (unshared) {
        unshared->scene = scene;
        unshared->count = scene->object_count;
        unshared->copies = calloc((size_t)scene->object_count + 1, sizeof *unshared->copies);
    }
    if (unshared && unshared->copies) {
        dip_pool_run(pool, scene->object_count, copy_mesh, unshared);
    }
    if (!unshared || !unshared->copies || !is_complete(unshared)) {
        dip_unshared_meshes_destroy(&unshared);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "gi",
                      "no memory for %d objects with a mesh each; gi=on takes less",
                      scene->object_count);
        return NULL;
    }
    for (int i = 0; i < scene->object_count; i++) {
        unshared->bytes += dip_mesh_bytes(dip_unshared_mesh(unshared, scene, i));
    }
    return unshared;
}

void dip_unshared_meshes_destroy(DipUnsharedMeshes **unshared) {
    if (!*unshared) {
        return;
    }
    for (int i = 0; (*unshared)->copies && i < (*unshared)->count; i++) {
        dip_mesh_destroy(&(*unshared)->copies[i]);
    }
    free((*unshared)->copies);
    free(*unshared);
    *unshared = NULL;
}

const DipMesh *dip_unshared_mesh(const DipUnsharedMeshes *unshared, const DipScene *scene,
                                 int object) {
    return unshared->copies[object] ? unshared->copies[object]
                                    : scene->meshes[scene->objects[object].mesh].mesh;
}

void dip_count_geometry(const DipScene *scene, const DipUnsharedMeshes *unshared,
                        DipCounters *counters) {
    counters->meshes = (uint64_t)(unshared ? scene->object_count : scene->drawn_mesh_count);
    counters->geometry_bytes = unshared ? unshared->bytes : scene->geometry_bytes;
}
