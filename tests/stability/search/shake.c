// Changes scenes by as little as rounding may change them.
#include "tests/stability/search/shake.h"

#include "renderer/reference/internal/differences.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t size_of_positions(const DipMeshDef *mesh) {
    return 3 * (size_t)mesh->vertex_count * sizeof(float);
}

void search_keep_original(const SearchScene *made, SearchOriginal *original) {
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &made->scene.meshes[m];
        original->positions[m] = malloc(size_of_positions(mesh));
        if (original->positions[m]) {
            memcpy(original->positions[m], mesh->positions, size_of_positions(mesh));
        }
    }
    for (int m = 0; m < made->scene.def.material_count; m++) {
        original->cutoffs[m] = made->scene.materials[m].alpha_cutoff;
    }
    for (int i = 0; i < made->scene.def.object_count; i++) {
        memcpy(original->transforms[i], made->scene.objects[i].transform,
               sizeof original->transforms[i]);
    }
    original->pose = made->scene.pose;
}

void search_restore_original(SearchScene *made, const SearchOriginal *original) {
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &made->scene.meshes[m];
        if (original->positions[m]) {
            memcpy((float *)(uintptr_t)mesh->positions, original->positions[m],
                   size_of_positions(mesh));
        }
    }
    for (int m = 0; m < made->scene.def.material_count; m++) {
        made->scene.materials[m].alpha_cutoff = original->cutoffs[m];
    }
    for (int i = 0; i < made->scene.def.object_count; i++) {
        memcpy(made->scene.objects[i].transform, original->transforms[i],
               sizeof original->transforms[i]);
    }
    made->scene.pose = original->pose;
    memset(made->shift, 0, sizeof made->shift);
    made->in_floats = false;
}

void search_free_original(SearchOriginal *original) {
    for (int m = 0; m < DIP_TEST_SCENE_PARTS; m++) {
        free(original->positions[m]);
    }
}

// Returns a random generator that depends only on a position, so that equal vertices move alike.
static Random random_of_vertex(const float *position, uint64_t seed) {
    Random random = {seed};
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &position[i], sizeof bits);
        random.state = random_u64(&random) ^ bits;
    }
    return random;
}

static double column_length(const float *m, int column) {
    const double x = (double)m[column], y = (double)m[4 + column], z = (double)m[8 + column];
    return sqrt(x * x + y * y + z * z);
}

// Returns true if the object keeps the origin (0, 0, 0), because its transform is nearly singular:
// a column lies within about 15 degrees of the plane of the other two.
static bool keeps_origin(const float *m) {
    double cross[3]; // of columns c + 1 and c + 2
    for (int c = 0; c < 3; c++) {
        double cross2 = 0.0;
        double volume = 0.0;
        for (int r = 0; r < 3; r++) {
            const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            const int r1 = 4 * ((r + 1) % 3), r2 = 4 * ((r + 2) % 3);
            cross[r] =
                (double)m[r1 + c1] * (double)m[r2 + c2] - (double)m[r2 + c1] * (double)m[r1 + c2];
            cross2 += cross[r] * cross[r];
            volume += cross[r] * (double)m[4 * r + c];
        }
        if (!(sqrt(cross2) * column_length(m, c) <= 3.99 * fabs(volume))) {
            return true;
        }
    }
    return false;
}

// Returns a bound, in metres, for the distance between the eye and the origin from which the fast
// renderer transforms an object's vertices. It chooses origins 1024 units of the mesh apart, except
// for transforms that are nearly singular.
static double distance_from_origin(const SearchScene *made, const DipObjectDef *object) {
    const float *m = object->transform;
    double reach = 0.0;
    double eye = 0.0;
    for (int i = 0; i < 3; i++) {
        reach = fmax(reach, 1024.0 * column_length(m, i));
        eye = fmax(eye, fabs(made->scene.pose.position_world[i] - (double)m[4 * i + 3]));
    }
    return keeps_origin(m) ? 4.0 * eye : fmin(eye, reach);
}

// Returns the vertex of an object that is nearest to the eye.
static uint32_t nearest_vertex(const SearchScene *made, const DipObjectDef *object) {
    uint32_t nearest = 0;
    double least = INFINITY;
    for (uint32_t v = 0; v < made->scene.meshes[object->mesh].vertex_count; v++) {
        double offset[3];
        search_vertex_from_eye(made, object, v, offset);
        const double distance = fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]);
        nearest = distance < least ? v : nearest;
        least = fmin(distance, least);
    }
    return nearest;
}

// Makes a point of a mesh its origin. Returns false, and changes nothing, if floats cannot hold the
// new positions or the new transforms of the mesh's objects.
static bool move_origin(SearchScene *made, int mesh, const float to[3]) {
    float *positions = (float *)(uintptr_t)made->scene.meshes[mesh].positions;
    const uint32_t count = 3 * made->scene.meshes[mesh].vertex_count;
    const double origin[3] = {(double)to[0], (double)to[1], (double)to[2]};
    bool exact = true;
    for (uint32_t i = 0; i < count; i++) {
        const float moved = (float)((double)positions[i] - origin[i % 3]);
        exact = exact && (double)moved + origin[i % 3] == (double)positions[i];
    }
    for (int pass = 0; pass < 2 && exact; pass++) {
        for (int k = 0; k < 3 * made->scene.def.object_count; k++) {
            float *row = made->scene.objects[k / 3].transform + 4 * (k % 3);
            const double place = (double)row[0] * origin[0] + (double)row[1] * origin[1] +
                                 (double)row[2] * origin[2] + (double)row[3];
            if (made->scene.objects[k / 3].mesh != mesh) {
                continue;
            }
            exact = exact && (double)(float)place == place;
            row[3] = pass ? (float)place : row[3];
        }
    }
    for (uint32_t i = 0; i < count && exact; i++) {
        positions[i] = (float)((double)positions[i] - origin[i % 3]);
    }
    return exact;
}

// Moves the origin of an object's mesh to its vertex nearest to the eye, along the axes along which
// floats are too coarse to move that vertex by `most` metres. Returns true if it did.
static bool make_movable(SearchScene *made, const DipObjectDef *object, double most) {
    const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
    const uint32_t nearest = nearest_vertex(made, object);
    float to[3] = {0.0f, 0.0f, 0.0f};
    bool coarse = false;
    for (int i = 0; i < 3; i++) {
        const float at = mesh->positions[3 * nearest + (uint32_t)i];
        const double step = 0x1p-23 * fabs((double)at) * column_length(object->transform, i);
        to[i] = step > 0.25 * most ? at : 0.0f;
        coarse = coarse || step > 0.25 * most;
    }
    return coarse && move_origin(made, object->mesh, to);
}

// Moves the vertices of an object's mesh by as much as docs/picture.md allows floats to move them:
// in proportion to the distance from the eye, and to the eye's distance from the object's origin.
// share: the part of these moves that is wanted. apart: where floats are too coarse for that, the
// mesh gets another origin. Returns true if it did.
static bool shake_mesh(SearchScene *made, const DipObjectDef *object, double share, bool apart,
                       uint64_t seed) {
    const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
    const float *m = object->transform;
    double scales[3];
    for (int i = 0; i < 3; i++) {
        scales[i] = column_length(m, i);
    }
    const double from_origin = distance_from_origin(made, object);
    const bool moved = apart && make_movable(made, object, 0x1p-21 * from_origin);
    float *positions = (float *)(uintptr_t)mesh->positions;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        double offset[3];
        search_vertex_from_eye(made, object, v, offset);
        const double distance =
            sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
        const double most = share * 0x1p-22 * (distance + 2.0 * from_origin);
        Random random = random_of_vertex(positions + 3 * (size_t)v, seed);
        for (int i = 0; i < 3; i++) {
            const double move = scales[i] > 0.0 ? most / scales[i] : 0.0;
            positions[3 * v + (uint32_t)i] =
                (float)((double)positions[3 * v + (uint32_t)i] + random_real(&random, -move, move));
        }
    }
    return moved;
}

static bool is_sky(const SearchScene *made, const DipMeshDef *mesh) {
    return made->scene.materials[mesh->material].surface == DIP_SURFACE_SKY;
}

// Returns true if an object has the same vertices as the object before it, and the renderer
// computes them alike: a sky has to reach farther than other surfaces before it is cut in doubles.
static bool has_same_vertices(const SearchScene *made, int index) {
    const DipObjectDef *object = &made->scene.objects[index];
    const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
    const DipMeshDef *other = &made->scene.meshes[object[-1].mesh];
    return is_sky(made, mesh) == is_sky(made, other) &&
           memcmp(object->transform, object[-1].transform, sizeof object->transform) == 0 &&
           mesh->vertex_count == other->vertex_count && mesh->index_count == other->index_count &&
           memcmp(mesh->positions, other->positions, size_of_positions(mesh)) == 0;
}

// Moves an object a little towards the eye or away from it, without changing its outline. Two
// objects may lie in one plane and have different vertices. No order is promised for them, because
// rounding the vertices to 1/256 pixel moves the two planes differently.
static void lift(SearchScene *made, int index, Random *random) {
    float *m = made->scene.objects[index].transform;
    const double step = ldexp(1.0, -random_int(random, 10, 22));
    const double factor = 1.0 + (random_int(random, 0, 1) ? step : -step);
    for (int i = 0; i < 3; i++) {
        const double eye = made->scene.pose.position_world[i];
        for (int k = 0; k < 3; k++) {
            m[4 * i + k] = (float)(factor * (double)m[4 * i + k]);
        }
        m[4 * i + 3] = (float)(eye + factor * ((double)m[4 * i + 3] - eye));
    }
}

// Turns the camera and changes its field of view by at most 1/512 pixel, mostly by less.
static void shake_camera(SearchScene *made, Random *random) {
    DipPose *pose = &made->scene.pose;
    const double pixel_rad = 2.0 * tan(pose->fov_y_deg * 3.14159265358979 / 360.0) / made->height;
    const double most = fmin(pixel_rad, 0.1) / 512.0 * ldexp(1.0, -random_int(random, 0, 12));
    const double *q = pose->orientation;
    const double r[3] = {random_real(random, -most, most) / 2.0,
                         random_real(random, -most, most) / 2.0,
                         random_real(random, -most, most) / 2.0};
    const double turned[4] = {q[0] + q[3] * r[0] + q[1] * r[2] - q[2] * r[1],
                              q[1] + q[3] * r[1] + q[2] * r[0] - q[0] * r[2],
                              q[2] + q[3] * r[2] + q[0] * r[1] - q[1] * r[0],
                              q[3] - q[0] * r[0] - q[1] * r[1] - q[2] * r[2]};
    memcpy(pose->orientation, turned, sizeof turned);
    pose->fov_y_deg *= 1.0 + random_real(random, -most, most);
    pose->fov_y_deg = fmin(fmax(pose->fov_y_deg, 1.0), 170.0); // what pictures are drawn with
}

// Moves the camera by as much as the vertices of some object may move. Where floats are far from 0,
// this replaces the movement of vertices, which would need finer floats.
static void shift_camera(SearchScene *made, Random *random) {
    double most = 0.0;
    for (int i = 0; i < made->scene.def.object_count; i++) {
        most = fmax(most, 0x1p-21 * distance_from_origin(made, &made->scene.objects[i]));
    }
    most *= ldexp(1.0, -random_int(random, 0, 8));
    for (int i = 0; i < 3; i++) {
        made->scene.pose.position_world[i] += random_real(random, -most, most);
    }
}

void search_shake(SearchScene *made, uint64_t seed) {
    Random random = {seed};
    // Floats mostly move vertices by much less than they may, which leaves slivers thin.
    Random shares = {~seed};
    const double share = random_int(&shares, 0, 1) ? 1.0 : ldexp(1.0, -random_int(&shares, 1, 10));
    bool shaken[DIP_TEST_SCENE_PARTS] = {false};
    bool lifted[DIP_TEST_SCENE_PARTS] = {false};
    bool moved[DIP_TEST_SCENE_PARTS] = {false}; // the origin of the mesh, where no object is lifted
    for (int i = 1; i < made->scene.def.object_count; i++) {
        lifted[i] = !has_same_vertices(made, i);
    }
    for (int i = 0; i < made->scene.def.object_count; i++) {
        const DipObjectDef *object = &made->scene.objects[i];
        if (!shaken[object->mesh]) {
            shaken[object->mesh] = true;
            moved[object->mesh] = shake_mesh(made, object, share, seed & 1, seed);
        }
    }
    for (int i = 1; i < made->scene.def.object_count; i++) {
        if (lifted[i] && !moved[made->scene.objects[i].mesh] && random_int(&random, 0, 1)) {
            lift(made, i, &random);
        }
    }
    for (int i = 0; i < made->scene.def.material_count; i++) {
        float *cutoff = &made->scene.materials[i].alpha_cutoff;
        *cutoff += *cutoff > 0.0f ? (float)random_real(&random, -0x1p-7, 0x1p-7) : 0.0f;
    }
    shake_camera(made, &random);
    shift_camera(made, &random);
    for (int c = 0; c < 3; c++) {
        made->shift[c] = random_real(&random, -DIP_REF_MOST_SHIFT, DIP_REF_MOST_SHIFT);
    }
    made->in_floats = random_int(&random, 0, 1);
}

bool search_is_beyond_precision(const SearchScene *made) {
    for (int i = 0; i < made->scene.def.object_count; i++) {
        const DipObjectDef *object = &made->scene.objects[i];
        const double error = 0x1p-21 * distance_from_origin(made, object);
        for (uint32_t v = 0; v < made->scene.meshes[object->mesh].vertex_count; v++) {
            double offset[3];
            search_vertex_from_eye(made, object, v, offset);
            if (fabs(offset[0]) + fabs(offset[1]) + fabs(offset[2]) < 16.0 * error) {
                return true;
            }
        }
    }
    return false;
}
