// Makes normals for meshes that have none.
//
// assimp's own step writes a face's normal to the face's vertices and then averages vertices at the
// same position. That works only if no two faces share a vertex, but in glTF and PLY files faces
// share vertices.
#include "assets/model_parts.h"

#include <assimp/mesh.h>

#include <stdlib.h>
#include <string.h>

// If more faces than this meet at a point, they stay flat there: comparing all pairs would take too
// long.
enum { MAX_FACES_AT_A_POINT = 1024 };

static const double smoothing_cosine = 0.5; // cos 60 degrees; at greater angles the edge stays hard
static const uint32_t free_slot = UINT32_MAX;

// The corners of all faces, three per face. Corners at the same position form a linked list.
typedef struct Corners {
    const struct aiMesh *mesh;
    uint32_t count;
    double (*face_normal)[3]; // per face; its length is twice the face's area
    uint32_t *next;           // per corner: the next corner of its list
    uint32_t *length;         // per corner: length of the list that begins with this corner
    uint32_t *table;          // hash table by position, open addressing: first corner of a list
    size_t slots;             // size of the hash table, a power of two
} Corners;

static struct aiVector3D position_of(const Corners *corners, uint32_t corner) {
    return corners->mesh->mVertices[corners->mesh->mFaces[corner / 3].mIndices[corner % 3]];
}

static bool same_position(const Corners *corners, uint32_t one, uint32_t other) {
    const struct aiVector3D a = position_of(corners, one);
    const struct aiVector3D b = position_of(corners, other);
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

// FNV-1a over the bits of the position; -0 hashes as 0.
static uint32_t hash_position(struct aiVector3D p) {
    const float values[3] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    uint32_t bits[3];
    uint32_t hash = 2166136261u;
    memcpy(bits, values, sizeof bits);
    for (int i = 0; i < 3; ++i) {
        hash = (hash ^ bits[i]) * 16777619u;
        hash ^= hash >> 15;
    }
    return hash;
}

static void list_corners(Corners *corners) {
    memset(corners->table, 0xff, corners->slots * sizeof *corners->table);
    for (uint32_t corner = 0; corner < corners->count; ++corner) {
        size_t slot = hash_position(position_of(corners, corner)) & (corners->slots - 1);
        while (corners->table[slot] != free_slot &&
               !same_position(corners, corners->table[slot], corner)) {
            slot = (slot + 1) & (corners->slots - 1);
        }
        const uint32_t first = corners->table[slot];
        corners->next[corner] = first;
        corners->length[corner] = first == free_slot ? 1 : corners->length[first] + 1;
        corners->table[slot] = corner;
    }
}

static void set_face_normals(Corners *corners) {
    for (uint32_t face = 0; face < corners->count / 3; ++face) {
        const struct aiVector3D a = position_of(corners, 3 * face);
        const struct aiVector3D b = position_of(corners, 3 * face + 1);
        const struct aiVector3D c = position_of(corners, 3 * face + 2);
        const double u[3] = {(double)b.x - a.x, (double)b.y - a.y, (double)b.z - a.z};
        const double v[3] = {(double)c.x - a.x, (double)c.y - a.y, (double)c.z - a.z};
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            corners->face_normal[face][i] = u[j] * v[k] - u[k] * v[j];
        }
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Sums the normals of the faces that meet this corner's face smoothly at this position. Each normal
// is weighted by its face's area, so that the way in which polygons were triangulated does not
// matter.
static void smooth(const Corners *corners, uint32_t first, uint32_t corner, float to[3]) {
    const double *own = corners->face_normal[corner / 3];
    double sum[3] = {own[0], own[1], own[2]};
    const bool few = corners->length[first] <= MAX_FACES_AT_A_POINT;
    for (uint32_t other = first; few && other != free_slot; other = corners->next[other]) {
        const double *normal = corners->face_normal[other / 3];
        const double along = dot(own, normal);
        const double limit2 =
            smoothing_cosine * smoothing_cosine * dot(own, own) * dot(normal, normal);
        if (other / 3 != corner / 3 && along > 0.0 && along * along > limit2) {
            for (int i = 0; i < 3; ++i) {
                sum[i] += normal[i];
            }
        }
    }
    dip_model_unit_normal(sum, to);
}

static bool allocate(Corners *corners) {
    corners->slots = 16;
    while (corners->slots < 2 * (size_t)corners->count) {
        corners->slots *= 2;
    }
    corners->face_normal = malloc((corners->count / 3 + 1) * sizeof *corners->face_normal);
    corners->next = malloc(((size_t)corners->count + 1) * sizeof *corners->next);
    corners->length = malloc(((size_t)corners->count + 1) * sizeof *corners->length);
    corners->table = malloc(corners->slots * sizeof *corners->table);
    return corners->face_normal && corners->next && corners->length && corners->table;
}

float *dip_model_make_normals(DipModel *model, const struct aiMesh *mesh) {
    Corners corners = {.mesh = mesh, .count = 3 * mesh->mNumFaces};
    float *normals = dip_model_alloc(model, corners.count, 3 * sizeof *normals);
    if (!allocate(&corners)) {
        normals = NULL;
    }
    if (normals) {
        set_face_normals(&corners);
        list_corners(&corners);
        for (size_t slot = 0; slot < corners.slots; ++slot) {
            const uint32_t first = corners.table[slot];
            for (uint32_t c = first; c != free_slot; c = corners.next[c]) {
                smooth(&corners, first, c, normals + 3 * (size_t)c);
            }
        }
    }
    free(corners.face_normal);
    free(corners.next);
    free(corners.length);
    free(corners.table);
    return normals;
}
