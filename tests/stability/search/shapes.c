// Makes the shapes of adversarial scenes, in camera space.
#include "renderer/base/trig.h"
#include "tests/stability/search/maker.h"

#include <math.h>
#include <string.h>

static void add_vertex(SearchShape *shape, double x, double y, double z, double s, double t) {
    double *p = shape->positions[shape->vertex_count];
    p[0] = x;
    p[1] = y;
    p[2] = z;
    shape->st[shape->vertex_count][0] = s;
    shape->st[shape->vertex_count][1] = t;
    shape->vertex_count++;
}

static void add_triangle(SearchShape *shape, int a, int b, int c) {
    uint32_t *indices = shape->indices + shape->index_count;
    indices[0] = (uint32_t)a;
    indices[1] = (uint32_t)b;
    indices[2] = (uint32_t)c;
    shape->index_count += 3;
}

static double choose_depth(SearchMaker *maker) {
    return 2.0 * choices_power(maker->choices, -6, 8) *
           (1.0 + (double)choices_draw(maker->choices, 16) / 16.0);
}

// Adds a vertex at a distance along the view axis, in the view or a little outside.
static void add_in_view(SearchMaker *maker, double depth, double s, double t) {
    const double x = choices_real(maker->choices, 1.25) * maker->half_width * depth;
    const double y = choices_real(maker->choices, 1.25) * maker->half_height * depth;
    add_vertex(&maker->shape, x, y, -depth, s, t);
}

static void make_quad(SearchMaker *maker) {
    SearchShape *shape = &maker->shape;
    const double depth = choose_depth(maker);
    double sides[2][3];
    double centre[3] = {0.0, 0.0, -depth};
    for (int k = 0; k < 2; k++) {
        centre[k] = choices_real(maker->choices, 1.0) * maker->half_height * depth;
    }
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            sides[i][k] =
                ((i == k) + choices_real(maker->choices, 2.0)) * maker->half_height * depth;
        }
    }
    for (int v = 0; v < 4; v++) {
        const double s = v == 1 || v == 2;
        const double t = v >= 2;
        double p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = centre[k] + (s - 0.5) * sides[0][k] + (t - 0.5) * sides[1][k];
        }
        add_vertex(shape, p[0], p[1], p[2], s, t);
    }
    add_triangle(shape, 0, 1, 2);
    add_triangle(shape, 0, 2, 3);
}

// A triangle for each number drawn; all corners are independent.
static void make_soup(SearchMaker *maker) {
    const int count = 1 + (int)choices_draw(maker->choices, 20);
    const int length_index = maker->choices->cursor - 1;
    for (int t = 0; t < count; t++) {
        const int part = choices_begin_part(maker->choices, length_index);
        for (int i = 0; i < 3; i++) {
            add_in_view(maker, choose_depth(maker), i == 1, i == 2);
        }
        add_triangle(&maker->shape, 3 * t, 3 * t + 1, 3 * t + 2);
        choices_end_part(maker->choices, part);
    }
}

static void make_slivers(SearchMaker *maker) {
    SearchShape *shape = &maker->shape;
    const int count = 1 + (int)choices_draw(maker->choices, 20);
    const int length_index = maker->choices->cursor - 1;
    for (int t = 0; t < count; t++) {
        const int part = choices_begin_part(maker->choices, length_index);
        const double depth = choose_depth(maker);
        const double width = choices_power(maker->choices, -22, 0) / 8.0;
        const int first = shape->vertex_count;
        add_in_view(maker, depth, 0.0, 0.0);
        add_in_view(maker, depth * (1.0 + 0.25 * choices_real(maker->choices, 1.0)), 1.0, 0.0);
        const double *a = shape->positions[first];
        const double *b = shape->positions[first + 1];
        const double along = 0.5 + choices_real(maker->choices, 0.5);
        add_vertex(shape, a[0] + along * (b[0] - a[0]) - width * (b[1] - a[1]),
                   a[1] + along * (b[1] - a[1]) + width * (b[0] - a[0]),
                   a[2] + along * (b[2] - a[2]), along, width);
        add_triangle(shape, first, first + 1, first + 2);
        choices_end_part(maker->choices, part);
    }
}

static void make_fan(SearchMaker *maker) {
    const double depth = choose_depth(maker);
    const int count = 3 + (int)choices_draw(maker->choices, 30);
    add_in_view(maker, depth, 0.5, 0.5);
    const double radius = maker->half_height * depth * choices_power(maker->choices, -10, 3);
    for (int i = 0; i < count; i++) {
        const double angle = 2.0 * DIP_PI * i / count;
        const double c = dip_cos(angle);
        const double s = dip_sin(angle);
        const double *centre = maker->shape.positions[0];
        const double z = centre[2] + radius * choices_real(maker->choices, 0.5);
        add_vertex(&maker->shape, centre[0] + radius * c, centre[1] + radius * s, z, 0.5 + 0.5 * c,
                   0.5 + 0.5 * s);
        add_triangle(&maker->shape, 0, 1 + i, 1 + (i + 1) % count);
    }
}

// Adds the triangles of a grid of (columns + 1) x (rows + 1) vertices.
static void add_grid_triangles(SearchShape *shape, int columns, int rows) {
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < columns; c++) {
            const int a = r * (columns + 1) + c;
            const int b = a + columns + 1;
            add_triangle(shape, a, b, b + 1);
            add_triangle(shape, a, b + 1, a + 1);
        }
    }
}

static void make_sphere(SearchMaker *maker) {
    const int rows = 2 + (int)choices_draw(maker->choices, 7);
    const int columns = 3 + (int)choices_draw(maker->choices, 9);
    const double depth = choose_depth(maker);
    const double radius = maker->half_height * depth * choices_power(maker->choices, -3, 2);
    const double x = choices_real(maker->choices, 1.0) * maker->half_width * depth;
    const double y = choices_real(maker->choices, 1.0) * maker->half_height * depth;
    for (int r = 0; r <= rows; r++) {
        for (int c = 0; c <= columns; c++) {
            const double theta = DIP_PI * r / rows;
            const double phi = 2.0 * DIP_PI * c / columns;
            add_vertex(&maker->shape, x + radius * dip_sin(theta) * dip_sin(phi),
                       y + radius * dip_cos(theta), -depth + radius * dip_sin(theta) * dip_cos(phi),
                       (double)c / columns, (double)r / rows);
        }
    }
    add_grid_triangles(&maker->shape, columns, rows);
}

// A wavy grid, whose triangles form patches.
static void make_waves(SearchMaker *maker) {
    const int rows = 1 + (int)choices_draw(maker->choices, 8);
    const int columns = 1 + (int)choices_draw(maker->choices, 8);
    const double depth = choose_depth(maker);
    const double lean = choices_real(maker->choices, 2.0);
    const double height = choices_power(maker->choices, -12, 0) / 4.0;
    for (int r = 0; r <= rows; r++) {
        for (int c = 0; c <= columns; c++) {
            const double x = 2.0 * c / columns - 1.0;
            const double y = 1.0 - 2.0 * r / rows;
            const double wave = height * choices_real(maker->choices, 1.0) - lean * y;
            add_vertex(&maker->shape, x * maker->half_width * depth, y * maker->half_height * depth,
                       -depth * (1.0 + 0.25 * wave), 0.5 + 0.5 * x, 0.5 - 0.5 * y);
        }
    }
    add_grid_triangles(&maker->shape, columns, rows);
}

// A floor, a ceiling or a wall that reaches to the horizon and begins at or behind the eye.
static void make_floor(SearchMaker *maker) {
    static const double behinds[] = {0.0, 1.0, 0.5, -0x1p-10, 0x1p-20, 1000.0};
    SearchShape *shape = &maker->shape;
    const int kind = (int)choices_draw(maker->choices, 4);
    const double height =
        choices_power(maker->choices, -10, 10) * (1.0 + choices_real(maker->choices, 0.5));
    const double extent = 1024.0 * choices_power(maker->choices, -8, 14);
    const double behind = behinds[choices_draw(maker->choices, 6)];
    const double slope = choices_real(maker->choices, 0.25);
    const double repeats = 16.0 * choices_power(maker->choices, -4, 14);
    for (int v = 0; v < 4; v++) {
        const double s = v == 1 || v == 2;
        const double t = v >= 2;
        const double z = t > 0.0 ? -extent : behind;
        const double across = (s - 0.5) * extent;
        const double up = (kind & 1 ? height : -height) + slope * z;
        add_vertex(shape, kind & 2 ? up : across, kind & 2 ? across : up, z, s * repeats,
                   t * repeats);
    }
    add_triangle(shape, 0, 1, 2);
    add_triangle(shape, 0, 2, 3);
}

// Triangles whose coordinates have exponents that differ widely.
static void make_huge(SearchMaker *maker) {
    const int count = 1 + (int)choices_draw(maker->choices, 4);
    const int length_index = maker->choices->cursor - 1;
    for (int t = 0; t < count; t++) {
        const int part = choices_begin_part(maker->choices, length_index);
        for (int i = 0; i < 3; i++) {
            double p[3];
            for (int k = 0; k < 3; k++) {
                p[k] = choices_real(maker->choices, 4.0) * choices_power(maker->choices, -12, 24);
            }
            add_vertex(&maker->shape, p[0], p[1], p[2] - 4.0, i == 1, i == 2);
        }
        add_triangle(&maker->shape, 3 * t, 3 * t + 1, 3 * t + 2);
        choices_end_part(maker->choices, part);
    }
}

// Triangles with corners on the near plane, close to it, in the eye's plane or behind the eye.
static void make_near(SearchMaker *maker) {
    const int count = 1 + (int)choices_draw(maker->choices, 8);
    const double near_m = (double)maker->made->scene.def.near_m;
    const double depths[] = {2.0,
                             near_m,
                             near_m * (1.0 + 0x1p-23),
                             near_m * (1.0 - 0x1p-23),
                             2.0 * near_m,
                             0.0,
                             -near_m,
                             16.0,
                             0.5 * near_m,
                             -4.0};
    const int length_index = maker->choices->cursor - 1;
    for (int t = 0; t < count; t++) {
        const int part = choices_begin_part(maker->choices, length_index);
        for (int i = 0; i < 3; i++) {
            const double depth =
                depths[choices_draw(maker->choices, sizeof depths / sizeof *depths)];
            const double reach = fmax(fabs(depth), near_m) * maker->half_width * 2.0;
            const double x = choices_real(maker->choices, 2.0) * reach;
            const double y = choices_real(maker->choices, 2.0) * reach;
            add_vertex(&maker->shape, x, y, -depth, i == 1, i == 2);
        }
        add_triangle(&maker->shape, 3 * t, 3 * t + 1, 3 * t + 2);
        choices_end_part(maker->choices, part);
    }
}

// Triangles whose plane contains the eye or passes it closely.
static void make_through_eye(SearchMaker *maker) {
    SearchShape *shape = &maker->shape;
    const int count = 1 + (int)choices_draw(maker->choices, 4);
    const int length_index = maker->choices->cursor - 1;
    for (int t = 0; t < count; t++) {
        const int part = choices_begin_part(maker->choices, length_index);
        const int first = shape->vertex_count;
        add_in_view(maker, choose_depth(maker), 0.0, 0.0);
        add_in_view(maker, choose_depth(maker), 1.0, 0.0);
        const double beyond = choices_power(maker->choices, -4, 4);
        const double aside =
            choices_rarely(maker->choices, 2) ? choices_power(maker->choices, -30, 0) : 0.0;
        const double *a = shape->positions[first];
        const double *b = shape->positions[first + 1];
        add_vertex(shape, -beyond * (a[0] + b[0]), -beyond * (a[1] + b[1]) + aside,
                   -beyond * (a[2] + b[2]), 0.0, 1.0);
        add_triangle(shape, first, first + 1, first + 2);
        choices_end_part(maker->choices, part);
    }
}

// A decal: the triangles of the shape before, as they are or each split in two.
static void make_decal(SearchMaker *maker) {
    SearchShape *shape = &maker->shape;
    if (choices_draw(maker->choices, 2) == 0) {
        return;
    }
    const int count = shape->index_count / 3;
    for (int t = 0; t < count && shape->vertex_count < SHAPE_MAX_VERTICES &&
                    shape->index_count + 3 <= SHAPE_MAX_INDICES;
         t++) {
        const uint32_t *corner = shape->indices + 3 * (size_t)t;
        const double *a = shape->positions[corner[1]];
        const double *b = shape->positions[corner[2]];
        const double *s = shape->st[corner[1]];
        const double *u = shape->st[corner[2]];
        const int middle = shape->vertex_count;
        add_vertex(shape, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]),
                   0.5 * (s[0] + u[0]), 0.5 * (s[1] + u[1]));
        add_triangle(shape, (int)corner[0], middle, (int)corner[2]);
        shape->indices[3 * t + 2] = (uint32_t)middle;
    }
}

typedef struct ShapeKind {
    const char *name;
    void (*make)(SearchMaker *maker);
} ShapeKind;

static const ShapeKind kinds[] = {
    {"quad", make_quad},
    {"soup", make_soup},
    {"slivers", make_slivers},
    {"fan", make_fan},
    {"sphere", make_sphere},
    {"waves", make_waves},
    {"floor", make_floor},
    {"huge triangles", make_huge},
    {"triangles at the near plane", make_near},
    {"triangles through the eye", make_through_eye},
};

// Moves each vertex along its ray from the eye, which keeps the shape's outline on the screen.
static void spread_depths(SearchMaker *maker) {
    for (int v = 0; v < maker->shape.vertex_count; v++) {
        const double factor = choices_power(maker->choices, -10, 10);
        for (int k = 0; k < 3; k++) {
            maker->shape.positions[v][k] *= factor;
        }
    }
}

void search_make_shape(SearchMaker *maker) {
    if (maker->shape.vertex_count > 0 && choices_rarely(maker->choices, 5)) {
        maker->shape.name = "decal";
        make_decal(maker);
        return;
    }
    const ShapeKind *kind = &kinds[choices_draw(maker->choices, sizeof kinds / sizeof *kinds)];
    memset(&maker->shape, 0, sizeof maker->shape);
    maker->shape.name = kind->name;
    kind->make(maker);
    if (choices_rarely(maker->choices, 12)) {
        spread_depths(maker);
    }
}
