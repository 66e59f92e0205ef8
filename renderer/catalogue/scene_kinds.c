// Makes scenes in code. Each kind of scene has its own function.
#include "renderer/catalogue/random.h"
#include "renderer/base/trig.h"
#include "renderer/catalogue/scenes_private.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static void make_grazing_checker(DipTestScene *scene) {
    dip_test_scene_make_grazing(scene, DIP_TEST_CHECKER, 512, 0.0);
}

static void make_grazing_noise(DipTestScene *scene) {
    dip_test_scene_make_grazing(scene, DIP_TEST_NOISE, 1024, 22.5);
}

static void make_grazing_rolled(DipTestScene *scene) {
    dip_test_scene_make_grazing(scene, DIP_TEST_CHECKER, 256, 45.0);
}

// Adds a cube with sides of 1 m around a centre: six quads that face outwards.
static void add_cube(DipTestScene *scene, int material, const float centre[3]) {
    static const float axes[6][6] = {{0, 0, -1, 0, 1, 0}, {0, 0, 1, 0, 1, 0}, {1, 0, 0, 0, 0, -1},
                                     {1, 0, 0, 0, 0, 1},  {1, 0, 0, 0, 1, 0}, {-1, 0, 0, 0, 1, 0}};
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 24, 36, DIP_TEST_UV0 | DIP_TEST_NORMALS, material);
    for (int f = 0; f < 6; f++) {
        const float *a = axes[f];
        const float *b = axes[f] + 3;
        const float n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
        for (int i = 0; i < 4; i++) {
            const int v = 4 * f + i;
            const float s = i == 1 || i == 2 ? 0.5f : -0.5f;
            const float t = i >= 2 ? 0.5f : -0.5f;
            for (int k = 0; k < 3; k++) {
                mesh.positions[3 * v + k] = centre[k] + s * a[k] + t * b[k] + 0.5f * n[k];
                mesh.normals[3 * v + k] = n[k];
            }
            mesh.uv0[2 * v] = s + 0.5f;
            mesh.uv0[2 * v + 1] = t + 0.5f;
        }
        static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
        for (int i = 0; i < 6; i++) {
            mesh.indices[6 * f + i] = (uint32_t)(4 * f) + indices[i];
        }
    }
}

static void make_cube_on_plane(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int ground = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 256, 256));
    const int sides = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 64, 64));
    scene->materials[sides].lit = true;
    scene->materials[sides].base_colour_lin[2] = 0.5f;
    dip_test_scene_add_ground(scene, ground);
    // The decal has the same vertices as the ground. It is never visible: of coplanar surfaces, the
    // one that is drawn first stays visible.
    const int decal = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    dip_test_scene_add_ground(scene, decal);
    add_cube(scene, sides, (const float[]){0.3f, -0.5f, -3.0f});
    scene->pose.orientation[0] = dip_sin(-0.1);
    scene->pose.orientation[3] = dip_cos(-0.1);
}

static int add_bars(DipTestScene *scene) {
    const int bars = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 128, 128);
    uint8_t *texels = dip_test_scene_texels(scene, bars);
    for (int i = 0; i < 128 * 128; i++) {
        texels[4 * i + 3] = i % 128 % 32 < 4 || i / 128 % 32 < 4 ? 255 : 0;
    }
    const int fence = dip_test_scene_add_material(scene, bars);
    scene->materials[fence].surface = DIP_SURFACE_CLIPPED;
    scene->materials[fence].double_sided = true;
    return fence;
}

static void make_fence(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int ground = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 256, 256));
    const int fence = add_bars(scene);
    dip_test_scene_add_ground(scene, ground);
    dip_test_scene_add_quad(scene, fence, (const float[]){-2.5f, -1, -2}, (const float[]){7, 0, -6},
                            (const float[]){0, 2, 0}, 8, 2);
    dip_test_scene_add_quad(scene, fence, (const float[]){2.5f, -1, -1.5f},
                            (const float[]){-5, 0, -2}, (const float[]){0, 1.7f, 0}, 4, 1);
}

static void random_rgb(Random *random, float rgb[3]) {
    for (int c = 0; c < 3; c++) {
        rgb[c] = (float)random_real(random, 0.0, 1.0);
    }
}

static void make_soup(DipTestScene *scene) {
    enum { TRIANGLES = 400 };
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 32, 32));
    scene->materials[material].double_sided = true;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 3 * TRIANGLES, 3 * TRIANGLES,
                                                     DIP_TEST_UV0 | DIP_TEST_COLOURS, material);
    Random random = {7};
    for (int t = 0; t < TRIANGLES; t++) {
        const double depth = random_real(&random, -9.0, -1.0);
        double centre[3] = {0.0, 0.0, depth};
        centre[0] = random_real(&random, 0.8, -0.8) * depth;
        centre[1] = random_real(&random, 0.6, -0.6) * depth;
        for (int v = 3 * t; v < 3 * t + 3; v++) {
            for (int k = 0; k < 3; k++) {
                mesh.positions[3 * v + k] = (float)(centre[k] + random_real(&random, -0.6, 0.6));
            }
            mesh.uv0[2 * v] = (float)random_real(&random, -1.0, 2.0);
            mesh.uv0[2 * v + 1] = (float)random_real(&random, -1.0, 2.0);
            random_rgb(&random, mesh.colours_lin + 3 * v);
            mesh.indices[v] = (uint32_t)v;
        }
    }
}

static void make_slivers(DipTestScene *scene) {
    enum { TRIANGLES = 300 };
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64));
    scene->materials[material].double_sided = true;
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 3 * TRIANGLES, 3 * TRIANGLES, DIP_TEST_UV0, material);
    Random random = {11};
    for (int t = 0; t < TRIANGLES; t++) {
        const double z = random_real(&random, -6.0, -2.0);
        const double angle = random_real(&random, 0.0, 2.0 * pi);
        // Numbers are drawn one by one, since C leaves their order within an expression open.
        const int exponent = random_int(&random, -16, -3);
        const double width = ldexp(random_real(&random, 0.5, 1.0), exponent);
        const double along[2] = {dip_cos(angle) * 1.5, dip_sin(angle) * 1.5};
        double from[2];
        from[0] = random_real(&random, -2.0, 2.0);
        from[1] = random_real(&random, -1.5, 1.5);
        const double ends[3][2] = {{from[0], from[1]},
                                   {from[0] + along[0], from[1] + along[1]},
                                   {from[0] + along[0] * 0.4 - along[1] * width,
                                    from[1] + along[1] * 0.4 + along[0] * width}};
        for (int i = 0; i < 3; i++) {
            const int v = 3 * t + i;
            mesh.positions[3 * v] = (float)ends[i][0];
            mesh.positions[3 * v + 1] = (float)ends[i][1];
            mesh.positions[3 * v + 2] = (float)(z + 0.3 * i);
            mesh.uv0[2 * v] = (float)(ends[i][0] * 0.5);
            mesh.uv0[2 * v + 1] = (float)(ends[i][1] * 0.5);
            mesh.indices[v] = (uint32_t)v;
        }
    }
}

static void make_huge(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 256, 256);
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].double_sided = true;
    // A floor, a leaning wall and a ceiling. All three begin behind the eye.
    dip_test_scene_add_quad(scene, material, (const float[]){-3000, -0.7f, 900},
                            (const float[]){6000, 1, 0}, (const float[]){0, 0, -6000}, 600, 600);
    dip_test_scene_add_quad(scene, material, (const float[]){3, -900, 700},
                            (const float[]){-0.5f, 0, -1500}, (const float[]){40, 2500, 0}, 150,
                            250);
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 3, 3, DIP_TEST_UV0 | DIP_TEST_COLOURS, material);
    static const float positions[9] = {-800, 3, 2, 900, 5, 1.5f, 0, 1.5f, -2500};
    static const float uv[6] = {-8, 0, 9, 0, 0, 250};
    memcpy(mesh.positions, positions, sizeof positions);
    memcpy(mesh.uv0, uv, sizeof uv);
    Random random = {3};
    for (uint32_t v = 0; v < 3; v++) {
        random_rgb(&random, mesh.colours_lin + 3 * v);
        mesh.indices[v] = v;
    }
}

static void make_odd_textures(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    static const int sizes[4][2] = {{1, 1}, {7, 5}, {1, 9}, {7, 5}};
    for (int i = 0; i < 4; i++) {
        const int texture =
            dip_test_scene_add_texture(scene, DIP_TEST_NOISE, sizes[i][0], sizes[i][1]);
        scene->textures[texture].wrap_u = i == 3 ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
        scene->textures[texture].wrap_v = i == 2 ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
        const int material = dip_test_scene_add_material(scene, texture);
        const float x = i & 1 ? 0.05f : -2.05f;
        const float y = i & 2 ? 0.05f : -1.55f;
        dip_test_scene_add_quad(scene, material, (const float[]){x, y, -2.2f},
                                (const float[]){2, 0, i & 1 ? -1.5f : 0},
                                (const float[]){0, 1.5f, 0}, 2.5f, 1.75f);
        for (int v = 0; v < 4; v++) {
            float *uv = (float *)scene->meshes[i].uv0 + 2 * v;
            uv[0] -= 0.75f;
            uv[1] -= 0.375f;
        }
    }
}

static void make_vertex_colours(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_COLOURS, material);
    static const float positions[12] = {-1.5f, -1, -1.5f, 1.5f, -1, -1.5f, 6, 4, -9, -6, 4, -9};
    static const float colours[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.2f};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.positions, positions, sizeof positions);
    memcpy(mesh.colours_lin, colours, sizeof colours);
    memcpy(mesh.indices, indices, sizeof indices);
}

enum { RINGS = 12, SECTORS = 24 };

static void fill_sphere(const DipTestMesh *mesh) {
    for (int r = 0; r <= RINGS; r++) {
        for (int s = 0; s <= SECTORS; s++) {
            const int v = r * (SECTORS + 1) + s;
            const double theta = pi * r / RINGS;
            const double phi = 2.0 * pi * s / SECTORS;
            const double n[3] = {dip_sin(theta) * dip_sin(phi), dip_cos(theta),
                                 dip_sin(theta) * dip_cos(phi)};
            for (int k = 0; k < 3; k++) {
                mesh->positions[3 * v + k] = (float)n[k];
                mesh->normals[3 * v + k] = (float)n[k];
            }
        }
    }
    uint32_t *index = mesh->indices;
    for (uint32_t r = 0; r < RINGS; r++) {
        for (uint32_t s = 0; s < SECTORS; s++) {
            const uint32_t a = r * (SECTORS + 1) + s;
            const uint32_t b = a + SECTORS + 1;
            const uint32_t quad[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(index, quad, sizeof quad);
            index += 6;
        }
    }
}

static void make_lit_sphere(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[material].lit = true;
    scene->materials[material].base_colour_lin[0] = 0.9f;
    scene->materials[material].base_colour_lin[1] = 0.6f;
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        scene, (RINGS + 1) * (SECTORS + 1), 6 * RINGS * SECTORS, DIP_TEST_NORMALS, material);
    fill_sphere(&mesh);
    static const float transforms[4][12] = {
        {1, 0, 0, -1.3f, 0, 1, 0, 0.9f, 0, 0, 1, -4},
        {1.2f, 0.3f, 0, 1.4f, 0, 0.4f, 0, 0.9f, 0, 0, 0.8f, -4}, // scaled unevenly and sheared
        {-0.9f, 0, 0, -1.2f, 0, 0.9f, 0, -1.1f, 0, 0, 0.9f, -4}, // mirrored
        {4e-4f, 0, 0, 1.2e-3f, 0, 4e-4f, 0, -1e-3f, 0, 0, 4e-4f, -4e-3f}, // tiny, close to the eye
    };
    scene->def.object_count = 4;
    scene->def.near_m = 0.001f;
    for (int i = 0; i < 4; i++) {
        scene->objects[i] = scene->objects[0];
        memcpy(scene->objects[i].transform, transforms[i], sizeof transforms[i]);
    }
}

static void make_light_map(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 128, 128);
    const int light = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 16, 16);
    scene->textures[light].wrap_u = DIP_WRAP_CLAMP;
    scene->textures[light].wrap_v = DIP_WRAP_CLAMP;
    scene->textures[light].encoding = DIP_ENCODING_LINEAR;
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].light_map = light;
    scene->materials[material].light_map_scale = 2.0f;
    scene->materials[material].lit = true; // the light map takes precedence over the normals
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        scene, 4, 6, DIP_TEST_UV0 | DIP_TEST_UV1 | DIP_TEST_NORMALS, material);
    static const float positions[12] = {-3, -1, -1, 3, -1, -1, 3, -1, -12, -3, -1, -12};
    static const float uv0[8] = {0, 0, 6, 0, 6, 11, 0, 11};
    static const float uv1[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.positions, positions, sizeof positions);
    memcpy(mesh.uv0, uv0, sizeof uv0);
    memcpy(mesh.uv1, uv1, sizeof uv1);
    memcpy(mesh.indices, indices, sizeof indices);
    for (int v = 0; v < 4; v++) {
        mesh.normals[3 * v + 1] = 1.0f;
    }
}

// Adds a quad that has normals, colours and both sets of texture coordinates. Its normals point
// along +z, or along +y if the quad lies on the ground. Texture coordinates follow the order of the
// positions.
static void add_bumpy_quad(DipTestScene *scene, int material, const float positions[12],
                           const float uv0[8], bool lies) {
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        scene, 4, 6, DIP_TEST_UV0 | DIP_TEST_UV1 | DIP_TEST_NORMALS | DIP_TEST_COLOURS, material);
    static const float uv1[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const float colours[12] = {1, 0.8f, 0.6f, 1, 1, 1, 0.7f, 0.9f, 1, 1, 1, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.positions, positions, 12 * sizeof *positions);
    memcpy(mesh.uv0, uv0, 8 * sizeof *uv0);
    memcpy(mesh.uv1, uv1, sizeof uv1);
    memcpy(mesh.colours_lin, colours, sizeof colours);
    memcpy(mesh.indices, indices, sizeof indices);
    for (int v = 0; v < 4; v++) {
        mesh.normals[3 * v + (lies ? 1 : 2)] = 1.0f;
    }
}

// Sets u to the longitude and v to the latitude. At the poles, triangles have no area in texture
// space.
static void wrap_sphere(const DipTestMesh *mesh) {
    for (int r = 0; r <= RINGS; r++) {
        for (int s = 0; s <= SECTORS; s++) {
            const int v = r * (SECTORS + 1) + s;
            mesh->uv0[2 * v] = 3.0f * (float)s / SECTORS;
            mesh->uv0[2 * v + 1] = 2.0f * (float)r / RINGS;
        }
    }
}

static int add_bumpy_material(DipTestScene *scene, int colour, int bumps) {
    const int material = dip_test_scene_add_material(scene, colour);
    scene->materials[material].normal_map = bumps;
    scene->materials[material].roughness = 0.5f;
    scene->materials[material].lit = true;
    return material;
}

static void make_normal_map(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int colour = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64);
    const int light = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 8, 8);
    scene->textures[light].wrap_u = scene->textures[light].wrap_v = DIP_WRAP_CLAMP;
    const int bumps = dip_test_scene_add_bumps(scene, 128);
    const int floor = add_bumpy_material(scene, colour, bumps);
    scene->materials[floor].light_map = light;
    scene->materials[floor].light_map_scale = 2.0f;
    const int wall = add_bumpy_material(scene, colour, bumps);
    const int sheet = add_bumpy_material(scene, DIP_NO_TEXTURE, bumps);
    scene->materials[sheet].double_sided = true;
    scene->materials[sheet].base_colour_lin[0] = 0.4f;
    static const float floor_at[12] = {-3, -1, -1, 3, -1, -1, 3, -1, -12, -3, -1, -12};
    static const float wall_at[12] = {-3, -1, -8, 0, -1, -8, 0, 2, -8, -3, 2, -8};
    static const float flat_at[12] = {0, -1, -8, 1, -1, -8, 1, 2, -8, 0, 2, -8};
    static const float sheet_at[12] = {3, -1, -7, 1, -1, -7,
                                       1, 2,  -7, 3, 2,  -7}; // seen from behind
    static const float tiled[8] = {0, 5, 3, 5, 3, 0, 0, 0};
    static const float mirrored[8] = {2, 2, 0, 2, 0, 0, 2, 0};
    static const float nowhere[8] = {0.3f, 0.6f, 0.3f, 0.6f, 0.3f, 0.6f, 0.3f, 0.6f};
    add_bumpy_quad(scene, floor, floor_at, tiled, true);
    add_bumpy_quad(scene, wall, wall_at, mirrored, false);
    add_bumpy_quad(scene, wall, flat_at, nowhere, false);
    add_bumpy_quad(scene, sheet, sheet_at, tiled, false);
    const DipTestMesh sphere =
        dip_test_scene_add_mesh(scene, (RINGS + 1) * (SECTORS + 1), 6 * RINGS * SECTORS,
                                DIP_TEST_NORMALS | DIP_TEST_UV0, wall);
    fill_sphere(&sphere);
    wrap_sphere(&sphere);
    static const float placed[12] = {-0.6f, 0, 0, -0.4f, 0,    0.8f,
                                     0.1f,  0, 0, 0,     0.6f, -4}; // mirrored
    memcpy(scene->objects[scene->def.object_count - 1].transform, placed, sizeof placed);
}

static void add_light(DipTestScene *scene, const DipLightDef *light) {
    scene->lights[scene->lighting.light_count++] = *light;
}

// Adds a light of each kind, and a point light that reaches only a part of the scene.
static void add_lights(DipTestScene *scene, DipShading shading) {
    scene->lighting = (DipLightingDef){.ambient_lin = {0.06f, 0.07f, 0.1f},
                                       .sky_lin = {0.02f, 0.03f, 0.05f},
                                       .lights = scene->lights,
                                       .shading = shading};
    scene->def.lighting = &scene->lighting;
    add_light(scene, &(DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                    .colour_lin = {0.3f, 0.27f, 0.2f},
                                    .direction_world = {2.0f, -3.0f, -1.0f}});
    add_light(scene, &(DipLightDef){.kind = DIP_LIGHT_POINT,
                                    .colour_lin = {1.2f, 0.5f, 0.3f},
                                    .position_world = {-1.4f, 0.6f, -3.0f},
                                    .attenuation = {0.5f, 0.25f, 0.5f}});
    add_light(scene, &(DipLightDef){.kind = DIP_LIGHT_POINT,
                                    .colour_lin = {0.2f, 0.9f, 1.4f},
                                    .position_world = {1.6f, -0.2f, -5.5f},
                                    .attenuation = {0.0f, 0.0f, 1.0f},
                                    .range_m = 2.5f});
    add_light(scene, &(DipLightDef){.kind = DIP_LIGHT_SPOT,
                                    .colour_lin = {9.0f, 8.0f, 7.0f},
                                    .position_world = {0.5f, 2.5f, -2.0f},
                                    .direction_world = {-0.1f, -0.8f, -1.0f},
                                    .attenuation = {0.0f, 0.0f, 1.0f},
                                    .inner_deg = 8.0f,
                                    .outer_deg = 22.0f});
}

static int add_shiny_material(DipTestScene *scene, int colour_texture, float specular,
                              float shininess) {
    const int index = dip_test_scene_add_material(scene, colour_texture);
    DipMaterialDef *material = &scene->materials[index];
    material->lit = true;
    material->specular_lin[0] = material->specular_lin[1] = specular;
    material->specular_lin[2] = 0.5f * specular;
    material->shininess = shininess;
    return index;
}

// A floor and a wall with bumps, clipped bars, and a sphere that is mirrored and scaled unevenly.
static void make_lit_parts(DipTestScene *scene, DipShading shading) {
    dip_test_scene_begin(scene);
    add_lights(scene, shading);
    const int checker = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64);
    const int floor = add_shiny_material(scene, checker, 0.4f, 20.0f);
    const int wall = add_shiny_material(scene, checker, 0.3f, 9.0f);
    scene->materials[wall].normal_map = dip_test_scene_add_bumps(scene, 128);
    const int ball = add_shiny_material(scene, DIP_NO_TEXTURE, 0.8f, 60.4f);
    const int bars = add_bars(scene);
    scene->materials[bars].lit = true;
    static const float floor_at[12] = {-3, -1, -1, 3, -1, -1, 3, -1, -9, -3, -1, -9};
    static const float wall_at[12] = {-3, -1, -8, 1, -1, -8, 1, 3, -8, -3, 3, -8};
    static const float bars_at[12] = {1, -1, -8, 3, -1, -6, 3, 2, -6, 1, 2, -8};
    static const float tiled[8] = {0, 5, 3, 5, 3, 0, 0, 0};
    add_bumpy_quad(scene, floor, floor_at, tiled, true);
    add_bumpy_quad(scene, wall, wall_at, tiled, false);
    add_bumpy_quad(scene, bars, bars_at, tiled, false);
    const DipTestMesh sphere =
        dip_test_scene_add_mesh(scene, (RINGS + 1) * (SECTORS + 1), 6 * RINGS * SECTORS,
                                DIP_TEST_NORMALS | DIP_TEST_COLOURS, ball);
    fill_sphere(&sphere);
    for (int i = 0; i < 3 * (RINGS + 1) * (SECTORS + 1); i++) {
        sphere.colours_lin[i] = 0.3f + 0.02f * (float)(i % 30);
    }
    static const float placed[12] = {-0.6f, 0, 0, -0.3f, 0,    0.8f,
                                     0.1f,  0, 0, 0,     0.6f, -4}; // mirrored
    memcpy(scene->objects[scene->def.object_count - 1].transform, placed, sizeof placed);
}

static void make_lights(DipTestScene *scene) {
    make_lit_parts(scene, DIP_SHADING_PHONG);
}

static void make_gouraud_lights(DipTestScene *scene) {
    make_lit_parts(scene, DIP_SHADING_GOURAUD);
}

static void add_clouds(DipTestScene *scene, const float corner[3]) {
    const int material = dip_test_scene_add_material(scene, dip_test_scene_add_clouds(scene, 128));
    scene->materials[material].surface = DIP_SURFACE_SKY;
    dip_test_scene_add_quad(scene, material, corner, (const float[]){800, 0, 0},
                            (const float[]){0, 0, 1080}, 4, 6);
    scene->def.sky = dip_sky_default();
    scene->def.sky.clear = 0.2f;
    scene->def.sky.dense = 0.8f;
}

static void make_sky(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    add_clouds(scene, (const float[]){-400, 60, 120});
    // The camera is turned around and looks up by 35 degrees, so that the sun is to the right.
    const double up = 35.0 * pi / 360.0;
    scene->pose.orientation[0] = 0.0;
    scene->pose.orientation[1] = dip_cos(up);
    scene->pose.orientation[2] = -dip_sin(up);
    scene->pose.orientation[3] = 0.0;
}

static int add_pool(DipTestScene *scene, int texture, const float corner[3], float size) {
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].surface = DIP_SURFACE_WATER;
    scene->materials[material].base_colour_lin[0] = 0.1f;
    scene->materials[material].base_colour_lin[1] = 0.3f;
    dip_test_scene_add_quad(scene, material, corner, (const float[]){size, 0, 0},
                            (const float[]){0, 0, -size}, 2, 2);
    return material;
}

static void make_water(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int ground = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 256, 256);
    dip_test_scene_add_ground(scene, dip_test_scene_add_material(scene, ground));
    const int wall = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64));
    dip_test_scene_add_quad(scene, wall, (const float[]){-6, -1, -9}, (const float[]){12, 0, 0},
                            (const float[]){0, 3.5f, 0}, 6, 2);
    const int sides = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 64, 64));
    scene->materials[sides].lit = true;
    add_cube(scene, sides, (const float[]){0.3f, -0.6f, -3.4f});
    add_pool(scene, DIP_NO_TEXTURE, (const float[]){-2.2f, -0.8f, -1.2f}, 4.5f);
    const int high = add_pool(scene, ground, (const float[]){-1.6f, -0.35f, -3.1f}, 0.9f);
    scene->materials[high].double_sided = true;
    scene->reflection = (DipReflectionDef){.width = 96, .height = 72, .level_m = -0.8};
    scene->pose.position_world[1] = 0.5;
    scene->pose.orientation[0] = dip_sin(-0.22);
    scene->pose.orientation[3] = dip_cos(-0.22);
}

static void make_clear_water(DipTestScene *scene) {
    make_water(scene);
    for (int i = 0; i < scene->def.material_count; i++) {
        if (scene->materials[i].surface == DIP_SURFACE_WATER) {
            scene->materials[i].transmission = scene->materials[i].double_sided ? 1.0f : 0.7f;
        }
    }
}

static void make_water_effects(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int colour = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64);
    const int wall = add_bumpy_material(scene, colour, dip_test_scene_add_bumps(scene, 128));
    static const float wall_at[12] = {-3, -1, -9, 1, -1, -9, 1, 2, -9, -3, 2, -9};
    static const float mirrored[8] = {2, 2, 0, 2, 0, 0, 2, 0};
    add_bumpy_quad(scene, wall, wall_at, mirrored, false);
    dip_test_scene_add_quad(scene, add_bars(scene), (const float[]){0.3f, -1, -2.6f},
                            (const float[]){1.8f, 0, -0.6f}, (const float[]){0, 1.1f, 0}, 1, 1);
    add_clouds(scene, (const float[]){-400, 60, -1200});
    add_pool(scene, DIP_NO_TEXTURE, (const float[]){-4.0f, -0.8f, -1.2f}, 12.0f);
    scene->reflection = (DipReflectionDef){.width = 120, .height = 90, .level_m = -0.8};
    scene->pose.position_world[1] = 0.4;
    scene->pose.orientation[0] = dip_sin(-0.1);
    scene->pose.orientation[3] = dip_cos(-0.1);
}

// Adds a sphere of radius 1 with normals and texture coordinates, placed by a transform.
static void add_ball(DipTestScene *scene, int material, const float placed[12]) {
    const DipTestMesh sphere =
        dip_test_scene_add_mesh(scene, (RINGS + 1) * (SECTORS + 1), 6 * RINGS * SECTORS,
                                DIP_TEST_NORMALS | DIP_TEST_UV0, material);
    fill_sphere(&sphere);
    wrap_sphere(&sphere);
    memcpy(scene->objects[scene->def.object_count - 1].transform, placed, 12 * sizeof *placed);
}

static void make_metal_gloss(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int colour = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64);
    const int data = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 16, 16);
    scene->textures[data].encoding = DIP_ENCODING_LINEAR;
    const int glow = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 8, 8);
    const int bumps = dip_test_scene_add_bumps(scene, 128);
    const int floor = dip_test_scene_add_material(scene, colour);
    DipPbrDef *pbr = dip_test_scene_add_pbr(scene, floor, 1.0f, 1.0f);
    pbr->metal_rough_map = pbr->occlusion_map = data;
    pbr->occlusion_strength = 0.7f;
    const int wall = add_bumpy_material(scene, colour, bumps);
    pbr = dip_test_scene_add_pbr(scene, wall, 0.4f, 0.3f);
    pbr->normal_scale = 0.6f;
    pbr->coat = 0.8f;
    pbr->coat_roughness = 0.2f;
    const int sheet = add_bumpy_material(scene, DIP_NO_TEXTURE, bumps);
    scene->materials[sheet].double_sided = true;
    pbr = dip_test_scene_add_pbr(scene, sheet, 0.0f, 0.6f);
    pbr->occlusion_map = data;
    pbr->occlusion_at_uv1 = true;
    pbr->emission_map = glow;
    pbr->emission_lin[0] = pbr->emission_lin[2] = 0.4f;
    const int gold = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[gold].base_colour_lin[1] = 0.71f;
    scene->materials[gold].base_colour_lin[2] = 0.29f;
    dip_test_scene_add_pbr(scene, gold, 1.0f, 0.25f);
    static const float floor_at[12] = {-3, -1, -1, 3, -1, -1, 3, -1, -12, -3, -1, -12};
    static const float wall_at[12] = {-3, -1, -8, 0, -1, -8, 0, 2, -8, -3, 2, -8};
    static const float sheet_at[12] = {3, -1, -7, 1, -1, -7, 1, 2, -7, 3, 2, -7}; // from behind
    static const float tiled[8] = {0, 5, 3, 5, 3, 0, 0, 0};
    static const float mirrored[8] = {2, 2, 0, 2, 0, 0, 2, 0};
    add_bumpy_quad(scene, floor, floor_at, tiled, true);
    add_bumpy_quad(scene, wall, wall_at, mirrored, false);
    add_bumpy_quad(scene, sheet, sheet_at, tiled, false);
    add_ball(scene, gold,
             (const float[]){-0.6f, 0, 0, -0.4f, 0, 0.8f, 0.1f, 0, 0, 0, 0.6f, -4}); // mirrored
}

// Adds a pane with one corner at p, 1.6 m wide and high.
static int add_pane(DipTestScene *scene, int texture, const float p[3], const float colour[3]) {
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].surface = DIP_SURFACE_BLENDED;
    scene->materials[material].opacity = 0.6f;
    memcpy(scene->materials[material].base_colour_lin, colour, 3 * sizeof *colour);
    dip_test_scene_add_quad(scene, material, p, (const float[]){1.6f, 0, 0},
                            (const float[]){0, 1.6f, 0}, 2, 2);
    return material;
}

static void make_blending(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    const int spots = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 32, 32);
    uint8_t *texels = dip_test_scene_texels(scene, spots);
    for (int i = 0; i < 32 * 32; i++) {
        texels[4 * i + 3] = (uint8_t)(255 - texels[4 * i]);
    }
    // The nearest pane comes first, and what is not blended last.
    const int glass = add_pane(scene, DIP_NO_TEXTURE, (const float[]){-1.4f, -0.7f, -2.6f},
                               (const float[]){0.9f, 0.2f, 0.1f});
    dip_test_scene_add_pbr(scene, glass, 0.0f, 0.2f);
    const int ball = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[ball].surface = DIP_SURFACE_BLENDED;
    scene->materials[ball].opacity = 0.5f;
    scene->materials[ball].double_sided = true;
    scene->materials[ball].base_colour_lin[0] = 0.2f;
    dip_test_scene_add_pbr(scene, ball, 0.0f, 0.3f);
    add_ball(scene, ball, (const float[]){0.7f, 0, 0, 0.3f, 0, 0.7f, 0, 0.1f, 0, 0, 0.7f, -3.8f});
    add_pane(scene, spots, (const float[]){-0.6f, -0.8f, -5.0f}, (const float[]){1, 1, 1});
    add_pane(scene, DIP_NO_TEXTURE, (const float[]){0.2f, -0.6f, -6.0f},
             (const float[]){0.1f, 0.7f, 0.3f});
    const int wall = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64));
    dip_test_scene_add_quad(scene, wall, (const float[]){-6, -1, -9}, (const float[]){8, 0, 0},
                            (const float[]){0, 3.5f, 0}, 6, 2);
    add_pool(scene, DIP_NO_TEXTURE, (const float[]){-4.0f, -0.8f, -1.2f}, 12.0f);
    scene->reflection = (DipReflectionDef){.width = 120, .height = 90, .level_m = -0.8};
    scene->pose.position_world[1] = 0.4;
    scene->pose.orientation[0] = dip_sin(-0.1);
    scene->pose.orientation[3] = dip_cos(-0.1);
}

void dip_test_scene_make(DipTestScene *scene, DipTestSceneKind kind) {
    static void (*const makers[])(DipTestScene *) = {
#define DIP_TEST_SCENE_MAKER(name, text) make_##name,
        DIP_TEST_SCENE_LIST(DIP_TEST_SCENE_MAKER)
#undef DIP_TEST_SCENE_MAKER
    };
    makers[kind](scene);
}
