// Reads glTF scenes: walks the nodes and turns them into objects and lights.
//
// The meshes, nodes and skins are read as for an animated model; a pose of this model at rest gives
// the shapes of meshes with skins and morph targets.
#include "assets/gltf/scene.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Most memory of the meshes while a scene is read.
static const size_t max_scene_bytes = (size_t)8 << 30;

// The walk over the nodes: depth first, in the order of the file.
typedef struct Walk {
    DipGltfScene *scene;
    DipGltfNodeState *states; // One for each node of the file.
    bool *is_visited;
    int *stack; // Nodes to visit.
    int stack_count;
} Walk;

bool dip_gltf_warns_of(DipGltfScene *scene, DipGltfLoss loss) {
    const bool is_new = !(scene->warned >> loss & 1u);
    scene->warned |= 1u << loss;
    return is_new;
}

// --- objects -------------------------------------------------------------------------------------

// True if the shape of an object at rest differs from that of its mesh.
static bool is_posed(const DipGltfScene *scene, int object) {
    const DipAnimatedModel *from = scene->reader.model;
    const DipObjectPose *pose = dip_animated_pose_object(scene->pose, object);
    const int shapes = from->meshes[from->objects[object].mesh].shape_count;
    bool moves = pose->joint_transforms != NULL;
    for (int s = 1; s < shapes; ++s) {
        moves = moves || pose->weights[s] != 0.0f;
    }
    return moves;
}

static bool has_skin(const DipGltfScene *scene, int object) {
    return dip_animated_pose_object(scene->pose, object)->joint_transforms != NULL;
}

// How a mesh of a node is placed.
typedef struct Placement {
    double world[12];
    double offset[12]; // its transform relative to the node
} Placement;

// Adds one object of the node. A skin places its mesh itself.
static bool add_object(DipGltfScene *scene, int object, const DipGltfNodeState *state,
                       const Placement *placement) {
    const DipAnimatedModel *from = scene->reader.model;
    const int part = from->objects[object].mesh;
    const int material = dip_gltf_scene_material(scene, part, state);
    if (material < 0) {
        return false;
    }
    if (scene->model->plans[material].invisible) {
        return true;
    }
    const bool own_shape = is_posed(scene, object) || dip_gltf_scene_deforms(scene, object);
    const int mesh = dip_gltf_scene_mesh(scene, part, own_shape ? object : DIP_NOT_FOUND, material);
    const double *world = has_skin(scene, object) ? scene->root : placement->world;
    return mesh >= 0 &&
           dip_model_add_object(scene->model, scene->file, mesh, world, from->objects[object].name,
                                scene->reader.gltf.err) &&
           dip_gltf_scene_move_object(scene, object, placement->offset);
}

// Adds an object for each part of the node's mesh.
static bool add_parts(DipGltfScene *scene, int node, int mesh, const DipGltfNodeState *state,
                      const Placement *placement) {
    const int first = scene->reader.first_object[node];
    for (int i = first; i < first + scene->reader.meshes[mesh].count; ++i) {
        if (!add_object(scene, i, state, placement)) {
            return false;
        }
    }
    return true;
}

// --- instances -----------------------------------------------------------------------------------

// The transforms of the copies of a node's mesh (EXT_mesh_gpu_instancing).
typedef struct Instances {
    uint32_t count;
    DipGltfAccessor
        accessors[3]; // Translation, rotation and scale; without bytes if it is left out.
    bool has[3];
} Instances;

static bool read_instances(DipGltf *gltf, const cJSON *extension, Instances *instances) {
    static const char *const names[3] = {"TRANSLATION", "ROTATION", "SCALE"};
    static const int widths[3] = {3, 4, 3};
    const cJSON *attributes = cJSON_GetObjectItemCaseSensitive(extension, "attributes");
    *instances = (Instances){.count = 0};
    for (int i = 0; i < 3; ++i) {
        int index;
        if (!dip_gltf_integer(gltf, attributes, names[i], -1, &index) ||
            (index >= 0 &&
             !dip_gltf_accessor(gltf, index, widths[i], names[i], &instances->accessors[i]))) {
            return false;
        }
        instances->has[i] = index >= 0;
        const uint32_t count = instances->accessors[i].count;
        if (index >= 0 && instances->count > 0 && count != instances->count) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "EXT_mesh_gpu_instancing",
                                   "a node has %u and %u instances", instances->count, count);
        }
        instances->count = index >= 0 ? count : instances->count;
    }
    return true;
}

static void place_instance(const Instances *instances, uint32_t index, const double above[12],
                           Placement *placement) {
    DipRigNode node = {.rotation = {0.0, 0.0, 0.0, 1.0}, .scale = {1.0, 1.0, 1.0}};
    double *const values[3] = {node.translation, node.rotation, node.scale};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; instances->has[i] && k < instances->accessors[i].width; ++k) {
            values[i][k] = dip_gltf_number(&instances->accessors[i], index, k);
        }
    }
    dip_rig_local(&node, placement->offset);
    dip_rig_multiply(above, placement->offset, placement->world);
}

static bool is_finite(const double world[12]) {
    for (int i = 0; i < 12; ++i) {
        if (!isfinite((float)world[i])) {
            return false;
        }
    }
    return true;
}

static bool refuse_transform(const DipGltf *gltf, const char *name) {
    return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name, "the node's transform is not finite");
}

static bool add_instances(DipGltfScene *scene, const cJSON *extension, int node, int mesh,
                          const DipGltfNodeState *state) {
    Instances instances;
    if (!read_instances(&scene->reader.gltf, extension, &instances)) {
        return false;
    }
    for (uint32_t i = 0; i < instances.count; ++i) {
        Placement placement;
        place_instance(&instances, i, state->world, &placement);
        if (!is_finite(placement.world)) {
            return refuse_transform(&scene->reader.gltf, "EXT_mesh_gpu_instancing");
        }
        if (!add_parts(scene, node, mesh, state, &placement)) {
            return false;
        }
    }
    return true;
}

// --- nodes ---------------------------------------------------------------------------------------

static void read_tags(DipGltfScene *scene, const cJSON *node, const char *name,
                      DipGltfNodeState *state) {
    const cJSON *extras = cJSON_GetObjectItemCaseSensitive(node, "extras");
    const cJSON *light_mapped = cJSON_GetObjectItemCaseSensitive(extras, "lightmapped");
    const cJSON *surface = cJSON_GetObjectItemCaseSensitive(extras, "surface");
    if (light_mapped) {
        state->light_mapped = cJSON_IsTrue(light_mapped) ||
                              (cJSON_IsNumber(light_mapped) && light_mapped->valuedouble != 0.0);
    }
    state->plain = state->plain || light_mapped || surface;
    if (cJSON_IsString(surface)) {
        dip_model_read_tag(scene->model, scene->reader.gltf.path, name, surface->valuestring,
                           &state->tag);
    }
}

static bool is_hidden(const cJSON *node) {
    const cJSON *extension = dip_gltf_extension(node, "KHR_node_visibility");
    return cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(extension, "visible"));
}

// Adds the objects and the light of a node.
static bool add_node(DipGltfScene *scene, const cJSON *json, int node,
                     const DipGltfNodeState *state) {
    const cJSON *instancing = dip_gltf_extension(json, "EXT_mesh_gpu_instancing");
    Placement placement = {.offset = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    int mesh;
    if (!dip_gltf_integer(&scene->reader.gltf, json, "mesh", -1, &mesh)) {
        return false;
    }
    memcpy(placement.world, state->world, sizeof placement.world);
    if (mesh >= 0 && scene->reader.meshes[mesh].count > 0) {
        const bool skinned = has_skin(scene, scene->reader.first_object[node]);
        if (instancing && skinned && dip_gltf_warns_of(scene, DIP_GLTF_LOSS_SKINNED_COPIES)) {
            dip_model_warn(scene->model, scene->reader.gltf.path, "EXT_mesh_gpu_instancing",
                           "a mesh with a skin is drawn once, without its other copies");
        }
        const bool ok = instancing && !skinned ? add_instances(scene, instancing, node, mesh, state)
                                               : add_parts(scene, node, mesh, state, &placement);
        if (!ok) {
            return false;
        }
    }
    return dip_gltf_scene_light(scene, json, node, state->world);
}

// Puts the nodes of a list on the stack, the first one on top. Their numbers have been checked.
static void push(Walk *walk, const cJSON *list) {
    const int begin = walk->stack_count;
    for (const cJSON *item = list ? list->child : NULL; item; item = item->next) {
        const int node = (int)item->valuedouble;
        if (!walk->is_visited[node]) {
            walk->is_visited[node] = true;
            walk->stack[walk->stack_count++] = node;
        }
    }
    for (int low = begin, high = walk->stack_count - 1; low < high; ++low, --high) {
        const int node = walk->stack[low];
        walk->stack[low] = walk->stack[high];
        walk->stack[high] = node;
    }
}

static bool visit(Walk *walk, int node) {
    DipGltfScene *scene = walk->scene;
    const DipRigNode *placed = &scene->reader.model->nodes[scene->reader.node_of[node]];
    const cJSON *json = dip_gltf_item(&scene->reader.gltf, DIP_GLTF_nodes, node);
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(json, "name");
    const char *key = cJSON_IsString(name) ? name->valuestring : NULL;
    DipGltfNodeState *state = &walk->states[node];
    double above[12];
    double local[12];
    if (!json || is_hidden(json)) {
        return json != NULL;
    }
    memcpy(above, state->world, sizeof above);
    dip_rig_local(placed, local);
    dip_rig_multiply(above, local, state->world);
    if (!is_finite(state->world)) {
        return refuse_transform(&scene->reader.gltf, key);
    }
    read_tags(scene, json, key, state);
    const cJSON *children = cJSON_GetObjectItemCaseSensitive(json, "children");
    push(walk, children);
    for (const cJSON *item = children ? children->child : NULL; item; item = item->next) {
        walk->states[(int)item->valuedouble] = *state;
    }
    return add_node(scene, json, node, state);
}

// Puts the roots of the scene on the stack. A file without scenes shows all nodes.
static void push_roots(Walk *walk) {
    const DipGltf *gltf = &walk->scene->reader.gltf;
    const int count = gltf->tables[DIP_GLTF_nodes].count;
    if (gltf->tables[DIP_GLTF_scenes].count > 0) {
        int scene;
        dip_gltf_integer(gltf, gltf->json, "scene", 0, &scene); // It has been checked.
        const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_scenes, scene);
        push(walk, cJSON_GetObjectItemCaseSensitive(json, "nodes"));
        return;
    }
    const DipGltfReader *reader = &walk->scene->reader;
    for (int node = count; node-- > 0;) {
        if (reader->model->nodes[reader->node_of[node]].parent == DIP_NO_NODE) {
            walk->is_visited[node] = true;
            walk->stack[walk->stack_count++] = node;
        }
    }
}

static bool walk_nodes(DipGltfScene *scene) {
    const size_t count = (size_t)scene->reader.gltf.tables[DIP_GLTF_nodes].count;
    Walk walk = {.scene = scene,
                 .states = dip_gltf_alloc(&scene->reader, count, sizeof *walk.states),
                 .is_visited = dip_gltf_alloc(&scene->reader, count, sizeof *walk.is_visited),
                 .stack = dip_gltf_alloc(&scene->reader, count, sizeof *walk.stack)};
    if (!walk.states || !walk.is_visited || !walk.stack) {
        return dip_gltf_no_room(&scene->reader);
    }
    for (size_t i = 0; i < count; ++i) {
        walk.states[i].tag = DIP_TAG_SOLID;
        memcpy(walk.states[i].world, scene->root, sizeof walk.states[i].world);
    }
    push_roots(&walk);
    while (walk.stack_count > 0) {
        if (!visit(&walk, walk.stack[--walk.stack_count])) {
            return false;
        }
    }
    return true;
}

// --- the file ------------------------------------------------------------------------------------

// Keeps the names of the materials, and that of the material of parts without one.
static bool list_materials(DipGltfScene *scene) {
    const DipGltfItems *materials = &scene->reader.gltf.tables[DIP_GLTF_materials];
    const size_t count = (size_t)materials->count + 1;
    DipModelFile *file = &scene->model->files[scene->file];
    const char **names = dip_model_alloc(scene->model, count, sizeof *names);
    file->material_names = names;
    file->material_count = (int)count;
    for (size_t i = 0; names && i < count; ++i) {
        const cJSON *name =
            i + 1 < count ? cJSON_GetObjectItemCaseSensitive(materials->items[i], "name") : NULL;
        names[i] = dip_model_copy_text(scene->model, cJSON_IsString(name) ? name->valuestring : "");
        if (!names[i]) {
            names = NULL;
        }
    }
    return names || dip_model_out_of_memory(scene->reader.gltf.err, file->path);
}

static bool read_parts(DipGltfScene *scene) {
    DipGltfReader *reader = &scene->reader;
    DipAnimatedModel *from = reader->model;
    const cJSON *lights = dip_gltf_extension(reader->gltf.json, "KHR_lights_punctual");
    if (!dip_gltf_check_extensions(&reader->gltf, scene->model) || !list_materials(scene) ||
        !dip_gltf_list(&reader->gltf, lights, "lights", &scene->lights) ||
        !dip_gltf_read_meshes(reader) || !dip_gltf_read_nodes(reader)) {
        return false;
    }
    from->def.meshes = from->meshes;
    from->def.objects = from->objects;
    scene->pose = dip_animated_pose_create(from, reader->gltf.err);
    return scene->pose && dip_gltf_scene_choose_clip(scene) && walk_nodes(scene) &&
           dip_gltf_scene_keep_clip(scene);
}

// Reads the open file.
static bool read_file(DipGltfScene *scene) {
    DipModel *model = scene->model;
    DipGltfReader *reader = &scene->reader;
    reader->model = dip_animated_model_make(reader->gltf.path);
    if (!reader->model) {
        return dip_model_out_of_memory(reader->gltf.err, reader->gltf.path);
    }
    reader->model->most_bytes = max_scene_bytes;
    reader->model->store->warnings = model->warnings;
    const int left_out_before = model->lights_left_out;
    const bool ok = read_parts(scene);
    if (ok) {
        dip_model_warn_of_lights(model, reader->gltf.path, left_out_before);
    }
    dip_animated_pose_destroy(&scene->pose);
    dip_gltf_free_list(&scene->lights);
    dip_animated_model_destroy(&reader->model);
    return ok;
}

bool dip_gltf_read_scene(DipModel *model, int file, const double root[12], bool *is_version_1,
                         DipError *err) {
    DipGltfScene scene = {.reader = {.for_scene = true, .unpacks_draco = true},
                          .model = model,
                          .file = file,
                          .root = root};
    DipGltf *gltf = &scene.reader.gltf;
    DipModelFile *to = &model->files[file];
    DipError failure = {0};
    const bool opened = dip_gltf_open(gltf, to->path, &failure);
    gltf->err = err;
    *is_version_1 = !opened && dip_gltf_is_version_1(gltf);
    bool ok = *is_version_1;
    if (!opened && !*is_version_1 && err) {
        *err = failure;
    }
    if (opened) {
        ok = read_file(&scene);
        to->gltf = ok ? malloc(sizeof *to->gltf) : NULL;
        ok = ok && (to->gltf || dip_model_out_of_memory(err, to->path));
    }
    if (ok && opened) {
        *to->gltf = *gltf; // The pictures in the file are needed until they are decoded.
        to->gltf->err = NULL;
    } else {
        dip_gltf_close(gltf);
    }
    return ok;
}
