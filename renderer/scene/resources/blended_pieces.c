// Cuts blended meshes into connected pieces. Vertices at equal positions are joined first, then the
// corners of each triangle; what is joined then is a piece.
#include "renderer/scene/resources/blended_pieces.h"

#include "renderer/scene/motion.h"
#include "renderer/scene/resources/posed.h"
#include "renderer/scene/resources/scene_layout.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NO_PIECE = UINT32_MAX;

// The pieces of a mesh, whose vertices and indices follow each other in shared memory.
typedef struct Pieces {
    int count; // 0: the mesh is not cut
    DipMeshDef *meshes;
    float *floats;
    uint32_t *indices;
} Pieces;

struct DipCutScene {
    DipSceneDef def;
    DipMotionDef motion;
    int mesh_count;     // of the description that was cut
    Pieces *pieces;     // one per mesh of that description
    int *first_added;   // for each of these meshes, the index of its second piece
    DipMeshDef *meshes; // of the new description
    DipObjectDef *objects;
    DipMovingObject *moving;
};

// --- connected vertices --------------------------------------------------------------------------

// Returns the least vertex that is joined to this one, and shortens the way to it.
static uint32_t find_root(uint32_t *parent, uint32_t vertex) {
    while (parent[vertex] != vertex) {
        parent[vertex] = parent[parent[vertex]];
        vertex = parent[vertex];
    }
    return vertex;
}

static void join(uint32_t *parent, uint32_t a, uint32_t b) {
    const uint32_t p = find_root(parent, a);
    const uint32_t q = find_root(parent, b);
    parent[p < q ? q : p] = p < q ? p : q;
}

typedef struct Place {
    float at[3];
    uint32_t vertex;
} Place;

static int compare_places(const void *a, const void *b) {
    const Place *p = a;
    const Place *q = b;
    for (int i = 0; i < 3; i++) {
        if (p->at[i] != q->at[i]) {
            return p->at[i] < q->at[i] ? -1 : 1;
        }
    }
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static bool is_same_place(const Place *a, const Place *b) {
    return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

// Joins all vertices of a mesh that are connected. Returns for each vertex its way to the least
// vertex that is joined to it, or NULL if memory runs out.
static uint32_t *join_vertices(const DipMeshDef *mesh) {
    uint32_t *parent = malloc(mesh->vertex_count * sizeof *parent);
    Place *places = malloc(mesh->vertex_count * sizeof *places);
    if (!parent || !places) {
        free(parent);
        free(places);
        return NULL;
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        parent[v] = v;
        places[v].vertex = v;
        memcpy(places[v].at, mesh->positions + 3 * (size_t)v, sizeof places[v].at);
    }
    qsort(places, mesh->vertex_count, sizeof *places, compare_places);
    for (uint32_t i = 1; i < mesh->vertex_count; i++) {
        if (is_same_place(&places[i - 1], &places[i])) {
            join(parent, places[i - 1].vertex, places[i].vertex);
        }
    }
    free(places);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        join(parent, mesh->indices[i], mesh->indices[i + 1]);
        join(parent, mesh->indices[i], mesh->indices[i + 2]);
    }
    return parent;
}

// Numbers the pieces in the order of their first triangles. Returns for each vertex its piece, or
// NO_PIECE if no triangle is connected to it; NULL if memory runs out. The mesh gets at most `most`
// pieces.
static uint32_t *number_pieces(const DipMeshDef *mesh, int most, int *count) {
    uint32_t *parent = join_vertices(mesh);
    uint32_t *piece = malloc(mesh->vertex_count * sizeof *piece);
    if (!parent || !piece) {
        free(parent);
        free(piece);
        return NULL;
    }
    memset(piece, 0xff, mesh->vertex_count * sizeof *piece);
    uint32_t found = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const uint32_t root = find_root(parent, mesh->indices[i]);
        if (piece[root] == NO_PIECE) {
            piece[root] = found++;
        }
    }
    *count = found < (uint32_t)most ? (int)found : most;
    // A root comes before all vertices that are joined to it, so its own number is replaced last.
    for (uint32_t v = mesh->vertex_count; v-- > 0;) {
        const uint32_t own = piece[find_root(parent, v)];
        const uint64_t share = (uint64_t)own * (uint64_t)*count;
        piece[v] = own == NO_PIECE ? NO_PIECE : (uint32_t)(share / found);
    }
    free(parent);
    return piece;
}

// --- meshes --------------------------------------------------------------------------------------

// Moves an attribute of every vertex to its place. `place` says where a vertex goes.
static const float *move_attribute(const float *from, uint32_t width, const DipMeshDef *mesh,
                                   const uint32_t *place, float **free_memory) {
    if (!from) {
        return NULL;
    }
    float *to = *free_memory;
    *free_memory += (size_t)width * mesh->vertex_count;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (place[v] != NO_PIECE) {
            memcpy(to + (size_t)width * place[v], from + (size_t)width * v, width * sizeof *to);
        }
    }
    return to;
}

static const float *move_on(const float *array, size_t floats) {
    return array ? array + floats : NULL;
}

// Counts the vertices and indices of each piece, and gives each vertex its place: those of a piece
// follow each other in their old order.
static void place_vertices(const DipMeshDef *mesh, const uint32_t *piece, Pieces *pieces,
                           uint32_t *place) {
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        place[v] = piece[v] == NO_PIECE ? NO_PIECE : pieces->meshes[piece[v]].vertex_count++;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        pieces->meshes[piece[mesh->indices[i]]].index_count++;
    }
}

// Fills the pieces, of which only the counts are set.
static void fill_pieces(const DipMeshDef *mesh, const uint32_t *piece, Pieces *pieces,
                        uint32_t *place) {
    uint32_t *indices = pieces->indices;
    for (int p = 0; p < pieces->count; p++) {
        pieces->meshes[p].indices = indices;
        indices += pieces->meshes[p].index_count;
        pieces->meshes[p].index_count = 0;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        DipMeshDef *out = &pieces->meshes[piece[mesh->indices[i]]];
        pieces->indices[(size_t)(out->indices - pieces->indices) + out->index_count++] =
            place[mesh->indices[i]];
    }
    uint32_t first[DIP_MOST_BLENDED_PIECES];
    uint32_t vertices = 0;
    for (int p = 0; p < pieces->count; p++) {
        first[p] = vertices;
        vertices += pieces->meshes[p].vertex_count;
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        place[v] = place[v] == NO_PIECE ? NO_PIECE : place[v] + first[piece[v]];
    }
    float *memory = pieces->floats;
    const float *positions = move_attribute(mesh->positions, 3, mesh, place, &memory);
    const float *normals = move_attribute(mesh->normals, 3, mesh, place, &memory);
    const float *uv0 = move_attribute(mesh->uv0, 2, mesh, place, &memory);
    const float *uv1 = move_attribute(mesh->uv1, 2, mesh, place, &memory);
    const float *colours = move_attribute(mesh->colours_lin, 3, mesh, place, &memory);
    const float *alphas = move_attribute(mesh->alphas, 1, mesh, place, &memory);
    for (int p = 0; p < pieces->count; p++) {
        DipMeshDef *out = &pieces->meshes[p];
        const size_t at = first[p];
        out->name = mesh->name;
        out->material = mesh->material;
        out->positions = positions + 3 * at;
        out->normals = move_on(normals, 3 * at);
        out->uv0 = move_on(uv0, 2 * at);
        out->uv1 = move_on(uv1, 2 * at);
        out->colours_lin = move_on(colours, 3 * at);
        out->alphas = move_on(alphas, at);
    }
}

static size_t floats_of_vertex(const DipMeshDef *mesh) {
    return 3 + (mesh->normals ? 3 : 0) + (mesh->uv0 ? 2 : 0) + (mesh->uv1 ? 2 : 0) +
           (mesh->colours_lin ? 3 : 0) + (mesh->alphas ? 1 : 0);
}

// Cuts a mesh into at most `most` pieces. A mesh in one piece stays as it is.
static bool cut_mesh(const DipMeshDef *mesh, int most, Pieces *pieces) {
    int count = 0;
    uint32_t *piece = number_pieces(mesh, most, &count);
    if (!piece || count <= 1) {
        free(piece);
        return piece != NULL;
    }
    uint32_t *place = malloc(mesh->vertex_count * sizeof *place);
    pieces->meshes = calloc((size_t)count, sizeof *pieces->meshes);
    pieces->floats = malloc(floats_of_vertex(mesh) * mesh->vertex_count * sizeof(float));
    pieces->indices = malloc(mesh->index_count * sizeof *pieces->indices);
    const bool made = place && pieces->meshes && pieces->floats && pieces->indices;
    if (made) {
        pieces->count = count;
        place_vertices(mesh, piece, pieces, place);
        fill_pieces(mesh, piece, pieces, place);
    }
    free(place);
    free(piece);
    return made;
}

// --- the scene -----------------------------------------------------------------------------------

// Whether the mesh can be made. One that cannot is not cut, so that its own fault is reported.
static bool is_sound(const DipMeshDef *mesh) {
    bool sound = mesh->positions && mesh->indices && mesh->index_count % 3 == 0;
    for (size_t i = 0; sound && i < 3 * (size_t)mesh->vertex_count; i++) {
        sound = isfinite(mesh->positions[i]);
    }
    for (uint32_t i = 0; sound && i < mesh->index_count; i++) {
        sound = mesh->indices[i] < mesh->vertex_count;
    }
    return sound;
}

static bool may_be_cut(const DipSceneDef *def, int mesh) {
    const DipMeshDef *cut = &def->meshes[mesh];
    return dip_material_is_blended(&def->materials[cut->material]) && cut->index_count > 3 &&
           dip_moving_mesh(def->motion, mesh) < 0 && is_sound(cut);
}

static int count_objects(const DipSceneDef *def, int mesh) {
    int count = 0;
    for (int i = 0; i < def->object_count; i++) {
        count += def->objects[i].mesh == mesh;
    }
    return count;
}

// Cuts the meshes. The description's counts become those of the new one.
static bool cut_meshes(const DipSceneDef *def, DipCutScene *cut) {
    int left = DIP_MOST_BLENDED_PIECE_OBJECTS;
    for (int m = 0; m < def->mesh_count; m++) {
        const int objects = may_be_cut(def, m) ? count_objects(def, m) : 0;
        const int affordable = objects ? left / objects + 1 : 1;
        const int most =
            affordable < DIP_MOST_BLENDED_PIECES ? affordable : DIP_MOST_BLENDED_PIECES;
        if (most > 1 && !cut_mesh(&def->meshes[m], most, &cut->pieces[m])) {
            return false;
        }
        const int added = cut->pieces[m].count ? cut->pieces[m].count - 1 : 0;
        cut->first_added[m] = cut->def.mesh_count;
        cut->def.mesh_count += added;
        cut->def.object_count += added * objects;
        left -= added * objects;
    }
    return true;
}

static void add_meshes(const DipSceneDef *def, DipCutScene *cut) {
    memcpy(cut->meshes, def->meshes, (size_t)def->mesh_count * sizeof *cut->meshes);
    for (int m = 0; m < def->mesh_count; m++) {
        const Pieces *pieces = &cut->pieces[m];
        for (int p = 0; p < pieces->count; p++) {
            cut->meshes[p ? cut->first_added[m] + p - 1 : m] = pieces->meshes[p];
        }
    }
}

// Adds the objects of the pieces. They move as the objects do that are cut.
static void add_objects(const DipSceneDef *def, DipCutScene *cut) {
    memcpy(cut->objects, def->objects, (size_t)def->object_count * sizeof *cut->objects);
    const int moving_count = def->motion ? def->motion->object_count : 0;
    if (moving_count) {
        memcpy(cut->moving, def->motion->objects, (size_t)moving_count * sizeof *cut->moving);
    }
    int added = def->object_count;
    int added_moving = moving_count;
    int next = 0;
    for (int i = 0; i < def->object_count; i++) {
        const DipObjectDef *object = &def->objects[i];
        while (next < moving_count && cut->moving[next].object < i) {
            next++;
        }
        const bool moves = next < moving_count && cut->moving[next].object == i;
        for (int p = 1; p < cut->pieces[object->mesh].count; p++) {
            cut->objects[added] = *object;
            cut->objects[added].mesh = cut->first_added[object->mesh] + p - 1;
            if (moves) {
                cut->moving[added_moving] = cut->moving[next];
                cut->moving[added_moving++].object = added;
            }
            added++;
        }
    }
    cut->motion.object_count = added_moving;
}

// Makes the new description, unless no mesh is cut.
static bool make_def(const DipSceneDef *def, DipCutScene *cut) {
    const size_t meshes = (size_t)cut->def.mesh_count;
    const size_t objects = (size_t)cut->def.object_count;
    cut->meshes = calloc(meshes + 1, sizeof *cut->meshes);
    cut->objects = calloc(objects + 1, sizeof *cut->objects);
    cut->moving = calloc(objects + 1, sizeof *cut->moving);
    if (!cut->meshes || !cut->objects || !cut->moving) {
        return false;
    }
    add_meshes(def, cut);
    add_objects(def, cut);
    cut->def.meshes = cut->meshes;
    cut->def.objects = cut->objects;
    if (def->motion) {
        cut->motion.rigs = def->motion->rigs;
        cut->motion.rig_count = def->motion->rig_count;
        cut->motion.meshes = def->motion->meshes;
        cut->motion.mesh_count = def->motion->mesh_count;
        cut->motion.objects = cut->moving;
        cut->def.motion = &cut->motion;
    }
    return true;
}

static bool has_blended(const DipSceneDef *def) {
    for (int m = 0; m < def->mesh_count; m++) {
        if (may_be_cut(def, m)) {
            return true;
        }
    }
    return false;
}

bool dip_blended_cut(const DipSceneDef *def, DipCutScene **out, DipError *err) {
    *out = NULL;
    if (!has_blended(def)) {
        return true;
    }
    DipCutScene *cut = calloc(1, sizeof *cut);
    if (cut) {
        cut->def = *def;
        cut->mesh_count = def->mesh_count;
        cut->pieces = calloc((size_t)def->mesh_count, sizeof *cut->pieces);
        cut->first_added = calloc((size_t)def->mesh_count, sizeof *cut->first_added);
    }
    if (!cut || !cut->pieces || !cut->first_added || !cut_meshes(def, cut) || !make_def(def, cut)) {
        dip_cut_scene_destroy(&cut);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "out of memory");
    }
    if (cut->def.mesh_count == def->mesh_count) {
        dip_cut_scene_destroy(&cut);
    }
    *out = cut;
    return true;
}

const DipSceneDef *dip_cut_scene_def(const DipCutScene *cut) {
    return &cut->def;
}

void dip_cut_scene_destroy(DipCutScene **cut_pointer) {
    DipCutScene *cut = *cut_pointer;
    if (!cut) {
        return;
    }
    for (int m = 0; cut->pieces && m < cut->mesh_count; m++) {
        free(cut->pieces[m].meshes);
        free(cut->pieces[m].floats);
        free(cut->pieces[m].indices);
    }
    free(cut->pieces);
    free(cut->first_added);
    free(cut->meshes);
    free(cut->objects);
    free(cut->moving);
    free(cut);
    *cut_pointer = NULL;
}
