// Reads the nodes and skins of glTF files, and makes the objects.
//
// Nodes are put in an order in which each comes after its parent, so that a pose computes all
// transforms in one pass.
#include "assets/gltf/reader.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_OBJECTS = 1 << 20, MAX_WEIGHTS = 1 << 24 };

// --- order ---------------------------------------------------------------------------------------

// Sets parents[child] for every child of a node.
static bool read_children(DipGltfReader *reader, int node, int *parents) {
    const DipGltf *gltf = &reader->gltf;
    const int count = gltf->tables[DIP_GLTF_nodes].count;
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_nodes, node);
    const cJSON *children = cJSON_GetObjectItemCaseSensitive(json, "children");
    if (!json) {
        return false;
    }
    for (const cJSON *item = children ? children->child : NULL; item; item = item->next) {
        const double child = cJSON_IsNumber(item) ? item->valuedouble : -1.0;
        if (!(child >= 0.0 && child < count) || child != floor(child)) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "children",
                                   "node %d has a child that is not a node", node);
        }
        if (parents[(int)child] != DIP_NO_NODE) {
            return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "children", "node %d has two parents",
                                   (int)child);
        }
        parents[(int)child] = node;
    }
    return true;
}

// Numbers node, after its ancestors, if it has no number yet. `path` has room for all nodes.
// Returns false if the node is its own ancestor.
static bool number_node(int node, const int *parents, int *numbers, int *next, int *path,
                        int count) {
    int length = 0;
    for (; node != DIP_NO_NODE && numbers[node] == DIP_NO_NODE; node = parents[node]) {
        if (length == count) {
            return false;
        }
        path[length++] = node;
    }
    while (length > 0) {
        numbers[path[--length]] = (*next)++;
    }
    return true;
}

static bool order_nodes(DipGltfReader *reader, int *parents, int *path) {
    const int count = reader->gltf.tables[DIP_GLTF_nodes].count;
    for (int i = 0; i < count; ++i) {
        parents[i] = DIP_NO_NODE;
        reader->node_of[i] = DIP_NO_NODE;
    }
    for (int i = 0; i < count; ++i) {
        if (!read_children(reader, i, parents)) {
            return false;
        }
    }
    int next = 0;
    for (int i = 0; i < count; ++i) {
        if (!number_node(i, parents, reader->node_of, &next, path, count)) {
            return dip_gltf_refuse(&reader->gltf, DIP_ERROR_FORMAT, "children",
                                   "node %d is its own ancestor", i);
        }
    }
    for (int i = 0; i < count; ++i) {
        DipRigNode *node = &reader->model->nodes[reader->node_of[i]];
        node->parent = parents[i] == DIP_NO_NODE ? DIP_NO_NODE : reader->node_of[parents[i]];
    }
    return true;
}

// --- nodes at rest -------------------------------------------------------------------------------

static bool read_transform(DipGltfReader *reader, const cJSON *json, DipRigNode *node) {
    const DipGltf *gltf = &reader->gltf;
    double columns[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    node->rotation[3] = 1.0;
    node->scale[0] = node->scale[1] = node->scale[2] = 1.0;
    node->has_matrix = cJSON_GetObjectItemCaseSensitive(json, "matrix") != NULL;
    if (!dip_gltf_numbers(gltf, json, "matrix", 16, columns) ||
        !dip_gltf_numbers(gltf, json, "translation", 3, node->translation) ||
        !dip_gltf_numbers(gltf, json, "rotation", 4, node->rotation) ||
        !dip_gltf_numbers(gltf, json, "scale", 3, node->scale)) {
        return false;
    }
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            node->matrix[4 * row + column] = columns[4 * column + row];
        }
    }
    return true;
}

// Reads the weights of a node's morph targets: its own, those of its mesh, or zeros.
static bool read_weights(DipGltfReader *reader, const cJSON *json, DipRigNode *node) {
    const DipGltf *gltf = &reader->gltf;
    int mesh;
    if (!dip_gltf_integer(gltf, json, "mesh", -1, &mesh)) {
        return false;
    }
    if (mesh < 0) {
        return true;
    }
    const cJSON *mesh_json = dip_gltf_item(gltf, DIP_GLTF_meshes, mesh);
    const int count = mesh_json ? reader->meshes[mesh].target_count : 0;
    double *weights = calloc((size_t)count + 1, sizeof *weights);
    if (!weights) {
        return dip_model_out_of_memory(gltf->err, gltf->path);
    }
    const bool ok = mesh_json && dip_gltf_numbers(gltf, mesh_json, "weights", count, weights) &&
                    dip_gltf_numbers(gltf, json, "weights", count, weights);
    for (int i = 0; ok && i < count; ++i) {
        reader->model->rest_weights[node->first_weight + i] = (float)weights[i];
    }
    free(weights);
    return ok;
}

// Gives each node its part of the weights of all nodes.
static bool place_weights(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    size_t all = 0;
    for (int i = 0; i < model->node_count; ++i) {
        const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, i);
        DipRigNode *node = &model->nodes[reader->node_of[i]];
        int mesh;
        if (!dip_gltf_integer(&reader->gltf, json, "mesh", -1, &mesh) ||
            (mesh >= 0 && !dip_gltf_item(&reader->gltf, DIP_GLTF_meshes, mesh))) {
            return false;
        }
        node->first_weight = (int)all;
        node->weight_count = mesh >= 0 ? reader->meshes[mesh].target_count : 0;
        all += (size_t)node->weight_count;
        if (all > MAX_WEIGHTS) {
            return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "weights",
                                   "the nodes have more than %d morph targets", MAX_WEIGHTS);
        }
    }
    model->weight_count = (int)all;
    model->rest_weights = dip_gltf_alloc(reader, all, sizeof *model->rest_weights);
    return model->rest_weights || dip_gltf_no_room(reader);
}

static bool read_all_nodes(DipGltfReader *reader) {
    const int count = reader->gltf.tables[DIP_GLTF_nodes].count;
    for (int i = 0; i < count; ++i) {
        const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, i);
        DipRigNode *node = &reader->model->nodes[reader->node_of[i]];
        if (!json || !read_transform(reader, json, node) || !read_weights(reader, json, node)) {
            return false;
        }
    }
    return true;
}

// --- skins ---------------------------------------------------------------------------------------

static bool read_inverse_binds(DipGltfReader *reader, const cJSON *json, int count,
                               double *matrices) {
    DipGltfAccessor accessor = {0};
    int index;
    if (!dip_gltf_integer(&reader->gltf, json, "inverseBindMatrices", -1, &index) ||
        (index >= 0 &&
         !dip_gltf_accessor(&reader->gltf, index, 16, "inverseBindMatrices", &accessor))) {
        return false;
    }
    if (index >= 0 && accessor.count < (uint32_t)count) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "inverseBindMatrices",
                               "there are %u matrices for %d joints", accessor.count, count);
    }
    for (int i = 0; i < 12 * count; ++i) {
        const int row = i % 12 / 4;
        const int column = i % 4;
        matrices[i] = index >= 0 ? dip_gltf_number(&accessor, (uint32_t)(i / 12), 4 * column + row)
                                 : row == column;
        if (!isfinite(matrices[i])) {
            return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "inverseBindMatrices",
                                   "matrix %d is not finite", i / 12);
        }
    }
    return true;
}

static bool read_skin(DipGltfReader *reader, int index) {
    DipGltf *gltf = &reader->gltf;
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_skins, index);
    DipGltfItems list = {0};
    if (!json || !dip_gltf_list(gltf, json, "joints", &list)) {
        return false;
    }
    int *nodes = dip_gltf_alloc(reader, (size_t)list.count, sizeof *nodes);
    double *matrices = dip_gltf_alloc(reader, (size_t)list.count, 12 * sizeof *matrices);
    bool ok = nodes && matrices ? read_inverse_binds(reader, json, list.count, matrices)
                                : dip_gltf_no_room(reader);
    for (int i = 0; ok && i < list.count; ++i) {
        const double node = cJSON_IsNumber(list.items[i]) ? list.items[i]->valuedouble : -1.0;
        ok = (node >= 0.0 && node < gltf->tables[DIP_GLTF_nodes].count && node == floor(node)) ||
             dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "joints", "joint %d is not a node", i);
        nodes[i] = ok ? reader->node_of[(int)node] : 0;
    }
    reader->model->skins[index] = (DipRigSkin){list.count, nodes, matrices};
    dip_gltf_free_list(&list);
    return ok;
}

static bool read_skins(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    model->skin_count = reader->gltf.tables[DIP_GLTF_skins].count;
    model->skins = dip_gltf_alloc(reader, (size_t)model->skin_count, sizeof *model->skins);
    if (!model->skins) {
        return dip_gltf_no_room(reader);
    }
    for (int i = 0; i < model->skin_count; ++i) {
        if (!read_skin(reader, i)) {
            return false;
        }
    }
    return true;
}

// --- objects -------------------------------------------------------------------------------------

// Marks the nodes of the scene: its roots, and all nodes below them. A file without scenes shows
// all its nodes.
static bool mark_drawn(DipGltfReader *reader) {
    const DipGltf *gltf = &reader->gltf;
    DipAnimatedModel *model = reader->model;
    int scene;
    if (!dip_gltf_integer(gltf, gltf->json, "scene", 0, &scene)) {
        return false;
    }
    const bool all = gltf->tables[DIP_GLTF_scenes].count == 0;
    const cJSON *json = all ? NULL : dip_gltf_item(gltf, DIP_GLTF_scenes, scene);
    const cJSON *roots = cJSON_GetObjectItemCaseSensitive(json, "nodes");
    if (!all && !json) {
        return false;
    }
    for (const cJSON *item = roots ? roots->child : NULL; item; item = item->next) {
        const double root = cJSON_IsNumber(item) ? item->valuedouble : -1.0;
        if (!(root >= 0.0 && root < model->node_count) || root != floor(root)) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "scenes",
                                   "scene %d has a node that does not exist", scene);
        }
        reader->is_drawn[reader->node_of[(int)root]] = true;
    }
    for (int i = 0; i < model->node_count; ++i) {
        const int parent = model->nodes[i].parent;
        reader->is_drawn[i] =
            reader->is_drawn[i] || all || (parent != DIP_NO_NODE && reader->is_drawn[parent]);
    }
    return true;
}

// Adds an object for each part of the node's mesh. If the mesh has no joints, or the node no skin,
// the object has no skin.
static bool add_objects(DipGltfReader *reader, const cJSON *json, int node, int mesh, int skin) {
    DipAnimatedModel *model = reader->model;
    const DipGltfMesh *parts = &reader->meshes[mesh];
    const char *name = dip_gltf_name(reader, json, "node", node);
    if (!name) {
        return dip_gltf_no_room(reader);
    }
    reader->first_object[node] = model->def.object_count;
    for (int i = parts->first; i < parts->first + parts->count; ++i) {
        const int max_joint = reader->parts[i].max_joint;
        const bool skinned = skin >= 0 && model->meshes[i].joints;
        if (skinned && max_joint >= model->skins[skin].joint_count) {
            return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "JOINTS_0",
                                   "a vertex uses joint %d of %d", max_joint,
                                   model->skins[skin].joint_count);
        }
        const int index = model->def.object_count++;
        model->objects[index] = (DipAnimatedObject){
            .name = name, .mesh = i, .joint_count = skinned ? model->skins[skin].joint_count : 0};
        model->plans[index] = (DipObjectPlan){reader->node_of[node], skinned ? skin : DIP_NO_SKIN};
    }
    return true;
}

static bool read_object(DipGltfReader *reader, int node) {
    const DipGltf *gltf = &reader->gltf;
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_nodes, node);
    int mesh = -1;
    int skin = -1;
    if (!dip_gltf_integer(gltf, json, "mesh", -1, &mesh) ||
        !dip_gltf_integer(gltf, json, "skin", -1, &skin)) {
        return false;
    }
    if (mesh < 0 || !reader->is_drawn[reader->node_of[node]]) {
        return true;
    }
    if (skin >= reader->model->skin_count) {
        return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "skin", "the node uses skin %d of %d", skin,
                               reader->model->skin_count);
    }
    return add_objects(reader, json, node, mesh, skin);
}

static bool make_objects(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    size_t count = 0;
    for (int i = 0; i < model->node_count; ++i) {
        int mesh;
        const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, i);
        if (!dip_gltf_integer(&reader->gltf, json, "mesh", -1, &mesh)) {
            return false;
        }
        count += mesh >= 0 ? (size_t)reader->meshes[mesh].count : 0;
    }
    if (count > MAX_OBJECTS) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "nodes",
                               "the model has more than %d objects", MAX_OBJECTS);
    }
    model->objects = dip_gltf_alloc(reader, count, sizeof *model->objects);
    model->plans = dip_gltf_alloc(reader, count, sizeof *model->plans);
    if (!model->objects || !model->plans) {
        return dip_gltf_no_room(reader);
    }
    for (int i = 0; i < model->node_count; ++i) {
        if (!read_object(reader, i)) {
            return false;
        }
    }
    return true;
}

// Allocates the nodes and puts them in order.
static bool begin_nodes(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    const size_t count = (size_t)reader->gltf.tables[DIP_GLTF_nodes].count;
    int *parents = dip_gltf_alloc(reader, count, sizeof *parents);
    int *path = dip_gltf_alloc(reader, count, sizeof *path);
    reader->node_of = dip_gltf_alloc(reader, count, sizeof *reader->node_of);
    reader->is_drawn = dip_gltf_alloc(reader, count, sizeof *reader->is_drawn);
    reader->first_object = dip_gltf_alloc(reader, count, sizeof *reader->first_object);
    model->nodes = dip_gltf_alloc(reader, count, sizeof *model->nodes);
    if (!parents || !path || !reader->node_of || !reader->is_drawn || !reader->first_object ||
        !model->nodes) {
        return dip_gltf_no_room(reader);
    }
    model->node_count = (int)count;
    return order_nodes(reader, parents, path);
}

bool dip_gltf_read_transforms(DipGltfReader *reader) {
    bool ok = begin_nodes(reader);
    for (int i = 0; ok && i < reader->model->node_count; ++i) {
        const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, i);
        ok = json && read_transform(reader, json, &reader->model->nodes[reader->node_of[i]]);
    }
    return ok;
}

bool dip_gltf_read_nodes(DipGltfReader *reader) {
    return begin_nodes(reader) && place_weights(reader) && read_all_nodes(reader) &&
           read_skins(reader) && mark_drawn(reader) && make_objects(reader);
}
