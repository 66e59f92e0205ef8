// Meshes of one's own for objects that share one.
#include "renderer/scene/resources/instancing.h"

#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/scene/resources/scene_layout.h"

#include <stdlib.h>

struct DipExpanded {
    const DipScene *scene;
    int count;        // of objects
    DipMesh **copies; // per object; NULL: the scene's mesh is its own
    uint64_t bytes;   // of all meshes that are drawn, the scene's own included
};

static void copy_mesh(void *context, int index, int worker) {
    (void)worker;
    const DipExpanded *expanded = context;
    const DipSceneObject *object = &expanded->scene->objects[index];
    if (!object->first_of_mesh) {
        expanded->copies[index] = dip_mesh_copy(expanded->scene->meshes[object->mesh].mesh);
    }
}

static bool is_complete(const DipExpanded *expanded) {
    for (int i = 0; i < expanded->count; i++) {
        if (!expanded->scene->objects[i].first_of_mesh && !expanded->copies[i]) {
            return false;
        }
    }
    return true;
}

DipExpanded *dip_expanded_create(const DipScene *scene, DipPool *pool, DipError *err) {
    DipExpanded *expanded = calloc(1, sizeof *expanded);
    if (expanded) {
        expanded->scene = scene;
        expanded->count = scene->object_count;
        expanded->copies = calloc((size_t)scene->object_count + 1, sizeof *expanded->copies);
    }
    if (expanded && expanded->copies) {
        dip_pool_run(pool, scene->object_count, copy_mesh, expanded);
    }
    if (!expanded || !expanded->copies || !is_complete(expanded)) {
        dip_expanded_destroy(&expanded);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "gi",
                      "no memory for a mesh of its own for each of %d objects",
                      scene->object_count);
        return NULL;
    }
    for (int i = 0; i < scene->object_count; i++) {
        expanded->bytes += dip_mesh_bytes(dip_expanded_mesh(expanded, i));
    }
    return expanded;
}

void dip_expanded_destroy(DipExpanded **expanded) {
    if (!*expanded) {
        return;
    }
    for (int i = 0; (*expanded)->copies && i < (*expanded)->count; i++) {
        dip_mesh_destroy(&(*expanded)->copies[i]);
    }
    free((*expanded)->copies);
    free(*expanded);
    *expanded = NULL;
}

const DipMesh *dip_expanded_mesh(const DipExpanded *expanded, int object) {
    const DipScene *scene = expanded->scene;
    return expanded->copies[object] ? expanded->copies[object]
                                    : scene->meshes[scene->objects[object].mesh].mesh;
}

void dip_count_geometry(const DipScene *scene, const DipExpanded *expanded, DipCounters *counters) {
    counters->meshes = (uint64_t)(expanded ? scene->object_count : scene->drawn_mesh_count);
    counters->geometry_bytes = expanded ? expanded->bytes : scene->geometry_bytes;
}
