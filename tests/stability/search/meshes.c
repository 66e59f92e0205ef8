// Turns shapes into meshes: moves them to world space and to the mesh's own space, and gives them
// texture coordinates, normals and colours.
#include "tests/stability/search/maker.h"

#include <math.h>
#include <string.h>

// A transform, in doubles that are floats.
typedef struct Placement {
    double matrix[3][3];
    double offset[3];
} Placement;

static void choose_matrix(SearchMaker *maker, double matrix[3][3]) {
    Choices *choices = maker->choices;
    switch (choices_draw(choices, 7)) {
    case 1: { // scaled evenly
        const double scale = choices_power(choices, -20, 20);
        for (int i = 0; i < 3; i++) {
            matrix[i][i] = scale;
        }
        break;
    }
    case 2: { // mirrored
        const int axis = (int)choices_draw(choices, 3);
        matrix[axis][axis] = -1.0;
        break;
    }
    case 3: // sheared
        matrix[0][1] = choices_real(choices, 4.0);
        matrix[2][0] = choices_real(choices, 4.0);
        break;
    case 4: // scaled unevenly
        for (int i = 0; i < 3; i++) {
            matrix[i][i] = choices_power(choices, -6, 6);
        }
        break;
    case 5: // any matrix
        for (int i = 0; i < 9; i++) {
            matrix[i / 3][i % 3] += choices_real(choices, 1.0);
        }
        break;
    case 6: // singular or nearly so
        matrix[1][1] = choices_draw(choices, 2) ? choices_power(choices, -40, 0) : 0.0;
        break;
    default:
        break;
    }
}

static void choose_placement(SearchMaker *maker, Placement *placement) {
    memset(placement, 0, sizeof *placement);
    for (int i = 0; i < 3; i++) {
        placement->matrix[i][i] = 1.0;
    }
    if (!choices_rarely(maker->choices, 3)) {
        return;
    }
    choose_matrix(maker, placement->matrix);
    const bool at_eye = choices_draw(maker->choices, 2);
    for (int i = 0; i < 3; i++) {
        placement->offset[i] = at_eye ? floor(maker->made->scene.pose.position_world[i]) : 0.0;
        placement->offset[i] =
            (double)(float)(placement->offset[i] + choices_real(maker->choices, 4.0));
        for (int k = 0; k < 3; k++) {
            placement->matrix[i][k] = (double)(float)placement->matrix[i][k];
        }
    }
}

// Solves matrix * x = y by Cramer's rule. Returns false if the matrix is nearly singular.
static bool solve(const double m[3][3], const double y[3], double x[3]) {
    double cofactor[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            cofactor[i][k] = m[i1][k1] * m[i2][k2] - m[i1][k2] * m[i2][k1];
        }
    }
    const double det =
        m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    for (int k = 0; k < 3; k++) {
        x[k] = (y[0] * cofactor[0][k] + y[1] * cofactor[1][k] + y[2] * cofactor[2][k]) / det;
    }
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && fabs(x[0]) < 1e30 &&
           fabs(x[1]) < 1e30 && fabs(x[2]) < 1e30;
}

static void fill_positions(const SearchMaker *maker, const Placement *placement, float *positions) {
    for (int v = 0; v < maker->shape.vertex_count; v++) {
        const double *p = maker->shape.positions[v];
        double relative[3];
        double own[3];
        for (int i = 0; i < 3; i++) {
            relative[i] = maker->made->scene.pose.position_world[i] - placement->offset[i];
            for (int k = 0; k < 3; k++) {
                relative[i] += maker->rotation[i][k] * p[k];
            }
        }
        const bool solved = solve(placement->matrix, relative, own);
        for (int i = 0; i < 3; i++) {
            positions[3 * v + i] = (float)(solved ? own[i] : relative[i]);
        }
    }
}

static bool is_clamped(const DipTestScene *scene, int texture) {
    return texture != DIP_NO_TEXTURE && (scene->textures[texture].wrap_u == DIP_WRAP_CLAMP ||
                                         scene->textures[texture].wrap_v == DIP_WRAP_CLAMP);
}

// Returns true if the fast renderer does not reduce all texture coordinates of a material's
// surfaces: clamped axes and skies keep large coordinates, which leave few digits for derivatives.
static bool keeps_large_coordinates(const DipTestScene *scene, int material) {
    const DipMaterialDef *def = &scene->materials[material];
    return def->surface == DIP_SURFACE_SKY || is_clamped(scene, def->colour_texture) ||
           is_clamped(scene, def->normal_map) || is_clamped(scene, def->light_map);
}

// Fills texture coordinates. most: greatest whole number that is added to them.
static void fill_coordinates(SearchMaker *maker, double most, float *uv) {
    static const double offsets[] = {0.5, -0.75, 64.0, -4096.0, 65536.0, 1e6, -1e-9, 0.25};
    Choices *choices = maker->choices;
    const int style = (int)choices_draw(choices, 9);
    const double scale = style == 1 || style == 2 ? choices_power(choices, -6, 6) : 1.0;
    const double drawn = style == 2 ? offsets[choices_draw(choices, 8)] : 0.0;
    const double offset = fmax(fmin(drawn, most), -most);
    for (int i = 0; i < maker->shape.vertex_count; i++) {
        const double s = maker->shape.st[i][0];
        const double t = maker->shape.st[i][1];
        double u = s * scale + offset;
        double v = t * scale + offset;
        switch (style) {
        case 3:
            v = 0.3;
            break;
        case 4:
            v = (double)(float)(0.7 * u);
            break;
        case 5:
            u = s * 0x1p-40;
            v = t * 0x1p-40;
            break;
        case 6:
            u = choices_real(choices, 4.0);
            v = choices_real(choices, 4.0);
            break;
        case 7:
            u = 3.0 * s + 5.0 * t;
            v = -2.0 * s + 1000.0 * t;
            break;
        case 8:
            u = v = 0.6;
            break;
        default:
            break;
        }
        uv[2 * i] = (float)u;
        uv[2 * i + 1] = (float)v;
    }
}

static void add_face_normal(const float *positions, const uint32_t corner[3], double sums[][3]) {
    double side[2][3];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            side[i][k] = (double)positions[3 * corner[i + 1] + (uint32_t)k] -
                         (double)positions[3 * corner[0] + (uint32_t)k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        const double n = side[0][k1] * side[1][k2] - side[0][k2] * side[1][k1];
        for (int i = 0; i < 3; i++) {
            sums[corner[i]][k] += n;
        }
    }
}

static void fill_normals(SearchMaker *maker, const float *positions, float *normals) {
    double sums[SHAPE_MAX_VERTICES][3] = {{0}};
    for (int t = 0; t < maker->shape.index_count / 3; t++) {
        add_face_normal(positions, maker->shape.indices + 3 * (size_t)t, sums);
    }
    const bool shake = choices_rarely(maker->choices, 3);
    for (int v = 0; v < maker->shape.vertex_count; v++) {
        double *n = sums[v];
        double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            n[k] = length > 0.0 && isfinite(length) ? n[k] / length : k == 1;
            n[k] += shake ? choices_real(maker->choices, 1.0) : 0.0;
        }
        length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            normals[3 * v + k] = (float)(length > 0.0625 ? n[k] / length : k == 1);
        }
    }
}

static void set_transform(DipObjectDef *object, const Placement *placement) {
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            object->transform[4 * i + k] = (float)placement->matrix[i][k];
        }
        object->transform[4 * i + 3] = (float)placement->offset[i];
    }
}

void search_add_mesh(SearchMaker *maker, int material) {
    SearchShape *shape = &maker->shape;
    DipTestScene *scene = &maker->made->scene;
    Placement placement;
    choose_placement(maker, &placement);
    const bool coloured = choices_rarely(maker->choices, 3);
    const bool bare = choices_rarely(maker->choices, 8);
    const int arrays =
        bare ? 0
             : DIP_TEST_NORMALS | DIP_TEST_UV0 | DIP_TEST_UV1 | (coloured ? DIP_TEST_COLOURS : 0);
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        scene, (uint32_t)shape->vertex_count, (uint32_t)shape->index_count, arrays, material);
    maker->made->shape_names[scene->def.mesh_count - 1] = shape->name;
    memcpy(mesh.indices, shape->indices, (size_t)shape->index_count * sizeof *shape->indices);
    fill_positions(maker, &placement, mesh.positions);
    const double most = keeps_large_coordinates(scene, material) ? 64.0 : 1e6;
    if (!bare) {
        fill_coordinates(maker, most, mesh.uv0);
        fill_coordinates(maker, most, mesh.uv1);
        fill_normals(maker, mesh.positions, mesh.normals);
    }
    for (int i = 0; !bare && coloured && i < 3 * shape->vertex_count; i++) {
        mesh.colours_lin[i] = 1.0f - (float)choices_draw(maker->choices, 9) / 8.0f;
    }
    set_transform(&scene->objects[scene->def.object_count - 1], &placement);
}

void search_add_instance(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    const int index = scene->def.object_count++;
    scene->objects[index] = scene->objects[index - 1];
    for (int i = 0; i < 12; i++) {
        const float step = (float)choices_real(maker->choices, 1.0);
        scene->objects[index].transform[i] += i % 4 == 3 ? step : 0.25f * step;
    }
}
