// What the parts of the generator of scenes share: the scene that is being made, and a shape, which
// is a mesh in camera space.
#ifndef DIP_TESTS_STABILITY_SEARCH_MAKER_H
#define DIP_TESTS_STABILITY_SEARCH_MAKER_H

#include "tests/stability/search/scene_from_choices.h"

enum { SHAPE_MAX_VERTICES = 160, SHAPE_MAX_INDICES = 600 };

// A mesh in camera space, in metres. The camera looks along -Z.
typedef struct SearchShape {
    const char *name;
    int vertex_count;
    int index_count;
    double positions[SHAPE_MAX_VERTICES][3];
    double st[SHAPE_MAX_VERTICES][2]; // natural texture coordinates, mostly 0..1
    uint32_t indices[SHAPE_MAX_INDICES];
} SearchShape;

typedef struct SearchMaker {
    Choices *choices;
    SearchScene *made;
    double rotation[3][3]; // camera space to world space
    double half_height;    // half the height of the view at a distance of 1 m
    double half_width;
    SearchShape shape; // the shape of the newest mesh; vertex_count is 0 before the first
} SearchMaker;

// Replaces the shape. A decal lies on the shape before it.
void search_make_shape(SearchMaker *maker);

// Makes a material and its textures. Returns its index.
int search_make_material(SearchMaker *maker);

// Draws the choices that come after all others of a scene: metal and gloss, blending, alphas of
// vertices, and lights (finish.c).
void search_finish_materials(SearchMaker *maker);

// Adds the shape to the scene as a mesh and an object with a transform.
void search_add_mesh(SearchMaker *maker, int material);

// Adds another object with the newest mesh.
void search_add_instance(SearchMaker *maker);

#endif
