// Makes scenes of metallic-roughness and blended surfaces.
#include "author_scenes.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPHERE_ACROSS = 96, SPHERE_DOWN = 48 };

const float author_gold_lin[3] = {1.0f, 0.71f, 0.29f};

static void *allocate(AuthorScene *scene, size_t count, size_t size) {
    assert(scene->block_count < AUTHOR_BLOCKS);
    void *block = calloc(count, size);
    assert(block);
    scene->blocks[scene->block_count++] = block;
    return block;
}

void author_begin(AuthorScene *scene) {
    memset(scene, 0, sizeof *scene);
    scene->def = (DipSceneDef){.textures = scene->textures,
                               .materials = scene->materials,
                               .meshes = scene->meshes,
                               .objects = scene->objects,
                               .near_m = 0.1f,
                               .sky = dip_sky_default()};
    scene->pose = (DipPose){
        .position_world = {0.0, 0.0, 8.0}, .orientation = {0.0, 0.0, 0.0, 1.0}, .fov_y_deg = 36.0};
    scene->lighting.lights = scene->lights;
}

void author_free(AuthorScene *scene) {
    for (int i = 0; i < scene->block_count; i++) {
        free(scene->blocks[i]);
    }
    scene->block_count = 0;
}

int author_add_pbr(AuthorScene *scene, float metallic, float roughness) {
    const int index = scene->def.material_count++;
    assert(index < AUTHOR_PARTS);
    scene->pbrs[index] = (DipPbrDef){.metallic = metallic,
                                     .roughness = roughness,
                                     .f0_lin = {0.04f, 0.04f, 0.04f},
                                     .f90 = 1.0f,
                                     .metal_rough_map = DIP_NO_TEXTURE,
                                     .occlusion_map = DIP_NO_TEXTURE,
                                     .occlusion_strength = 1.0f,
                                     .emission_map = DIP_NO_TEXTURE,
                                     .normal_scale = 1.0f};
    scene->materials[index] = (DipMaterialDef){.name = "paint",
                                               .surface = DIP_SURFACE_OPAQUE,
                                               .base_colour_lin = {1.0f, 1.0f, 1.0f},
                                               .colour_texture = DIP_NO_TEXTURE,
                                               .light_map = DIP_NO_TEXTURE,
                                               .normal_map = DIP_NO_TEXTURE,
                                               .light_map_scale = 1.0f,
                                               .roughness = 1.0f,
                                               .lit = true,
                                               .opacity = 1.0f,
                                               .pbr = &scene->pbrs[index]};
    return index;
}

int author_add_texture(AuthorScene *scene, int size, DipEncoding encoding) {
    const int index = scene->def.texture_count++;
    assert(index < AUTHOR_PARTS);
    uint8_t *texels = allocate(scene, (size_t)(size * size), 4);
    for (int i = 0; i < 4 * size * size; i++) {
        texels[i] = i % 4 == 3 ? 255 : 128;
    }
    scene->textures[index] = (DipTextureDef){.name = "texture",
                                             .width = size,
                                             .height = size,
                                             .rgba8 = texels,
                                             .encoding = encoding,
                                             .wrap_u = DIP_WRAP_REPEAT,
                                             .wrap_v = DIP_WRAP_REPEAT};
    return index;
}

uint8_t *author_texels(AuthorScene *scene, int texture) {
    return (uint8_t *)(uintptr_t)scene->textures[texture].rgba8;
}

// Adds a mesh with room for its arrays, and an object at `centre`.
static DipMeshDef *add_mesh(AuthorScene *scene, int material, uint32_t vertices, uint32_t indices,
                            const float centre[3], float scale) {
    const int index = scene->def.mesh_count++;
    assert(index < AUTHOR_PARTS);
    float *floats = allocate(scene, vertices, 10 * sizeof *floats);
    scene->meshes[index] = (DipMeshDef){.name = "mesh",
                                        .vertex_count = vertices,
                                        .positions = floats,
                                        .normals = floats + 3 * (size_t)vertices,
                                        .uv0 = floats + 6 * (size_t)vertices,
                                        .uv1 = floats + 8 * (size_t)vertices,
                                        .index_count = indices,
                                        .indices = allocate(scene, indices, sizeof(uint32_t)),
                                        .material = material};
    scene->objects[scene->def.object_count++] =
        (DipObjectDef){.name = "object",
                       .mesh = index,
                       .transform = {scale, 0.0f, 0.0f, centre[0], 0.0f, scale, 0.0f, centre[1],
                                     0.0f, 0.0f, scale, centre[2]}};
    return &scene->meshes[index];
}

static void set_vertex(const DipMeshDef *mesh, uint32_t vertex, const float position[3],
                       const float normal[3], float u, float v) {
    memcpy((float *)(uintptr_t)mesh->positions + 3 * (size_t)vertex, position, 3 * sizeof(float));
    memcpy((float *)(uintptr_t)mesh->normals + 3 * (size_t)vertex, normal, 3 * sizeof(float));
    const float uv[2] = {u, v};
    memcpy((float *)(uintptr_t)mesh->uv0 + 2 * (size_t)vertex, uv, sizeof uv);
    memcpy((float *)(uintptr_t)mesh->uv1 + 2 * (size_t)vertex, uv, sizeof uv);
}

int author_add_sphere(AuthorScene *scene, int material, const float centre[3], float radius) {
    enum { ROW = SPHERE_ACROSS + 1 };
    const double pi = acos(-1.0);
    const DipMeshDef *mesh = add_mesh(scene, material, ROW * (SPHERE_DOWN + 1),
                                      6 * SPHERE_ACROSS * SPHERE_DOWN, centre, radius);
    for (uint32_t i = 0; i < ROW * (SPHERE_DOWN + 1); i++) {
        const double u = (double)(i % ROW) / SPHERE_ACROSS;
        const double v = (double)(i / ROW) / SPHERE_DOWN;
        const float p[3] = {(float)(-cos(2.0 * pi * u) * sin(pi * v)), (float)cos(pi * v),
                            (float)(sin(2.0 * pi * u) * sin(pi * v))};
        set_vertex(mesh, i, p, p, (float)u, (float)v);
    }
    uint32_t *at = (uint32_t *)(uintptr_t)mesh->indices;
    for (uint32_t i = 0; i < SPHERE_ACROSS * SPHERE_DOWN; i++) {
        const uint32_t a = i / SPHERE_ACROSS * ROW + i % SPHERE_ACROSS;
        const uint32_t quad[6] = {a, a + ROW, a + ROW + 1, a, a + ROW + 1, a + 1};
        memcpy(at + 6 * (size_t)i, quad, sizeof quad);
    }
    return scene->def.object_count - 1;
}

int author_add_quad(AuthorScene *scene, int material, const float p[3], const float a[3],
                    const float b[3]) {
    static const uint32_t order[6] = {0, 1, 3, 0, 3, 2};
    const DipMeshDef *mesh = add_mesh(scene, material, 4, 6, p, 1.0f);
    float normal[3];
    float length2 = 0.0f;
    for (int i = 0; i < 3; i++) {
        normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        length2 += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++) {
        normal[i] /= sqrtf(length2);
    }
    for (uint32_t i = 0; i < 4; i++) {
        float position[3];
        for (int k = 0; k < 3; k++) {
            position[k] = (i & 1 ? a[k] : 0.0f) + (i & 2 ? b[k] : 0.0f);
        }
        set_vertex(mesh, i, position, normal, i & 1 ? 1.0f : 0.0f, i & 2 ? 0.0f : 1.0f);
    }
    memcpy((uint32_t *)(uintptr_t)mesh->indices, order, sizeof order);
    return scene->def.object_count - 1;
}

int author_add_water(AuthorScene *scene, int width, int height) {
    const int water = author_add_pbr(scene, 0.0f, 1.0f);
    scene->materials[water].surface = DIP_SURFACE_WATER;
    scene->materials[water].pbr = NULL;
    scene->materials[water].base_colour_lin[0] = 0.05f;
    author_add_quad(scene, water, (const float[]){-9.0f, -1.0f, 6.0f}, (const float[]){18, 0, 0},
                    (const float[]){0, 0, -8});
    scene->reflection = (DipReflectionDef){.width = width, .height = height, .level_m = -1.0};
    return water;
}

// Copies a mesh behind the vertices and indices that `out` has already.
static void append(const DipMeshDef *from, const float transform[12], DipMeshDef *out) {
    uint32_t *indices = (uint32_t *)(uintptr_t)out->indices + out->index_count;
    for (uint32_t v = 0; v < from->vertex_count; v++) {
        float position[3];
        for (int i = 0; i < 3; i++) {
            position[i] =
                transform[5 * i] * from->positions[3 * v + (uint32_t)i] + transform[4 * i + 3];
        }
        set_vertex(out, out->vertex_count + v, position, from->normals + 3 * (size_t)v,
                   from->uv0[2 * v], from->uv0[2 * v + 1]);
    }
    for (uint32_t i = 0; i < from->index_count; i++) {
        indices[i] = out->vertex_count + from->indices[i];
    }
    out->vertex_count += from->vertex_count;
    out->index_count += from->index_count;
}

int author_join(AuthorScene *scene, int first, int last, bool linked) {
    uint32_t vertices = 0;
    uint32_t indices = 0;
    for (int i = first; i <= last; i++) {
        vertices += scene->meshes[scene->objects[i].mesh].vertex_count;
        indices += scene->meshes[scene->objects[i].mesh].index_count + 3;
    }
    const int material = scene->meshes[scene->objects[first].mesh].material;
    DipMeshDef *out =
        add_mesh(scene, material, vertices, indices, (const float[]){0.0f, 0.0f, 0.0f}, 1.0f);
    out->vertex_count = out->index_count = 0;
    for (int i = first; i <= last; i++) {
        const uint32_t part = out->vertex_count;
        append(&scene->meshes[scene->objects[i].mesh], scene->objects[i].transform, out);
        if (linked && i < last) {
            const uint32_t link[3] = {part, out->vertex_count, out->vertex_count};
            memcpy((uint32_t *)(uintptr_t)out->indices + out->index_count, link, sizeof link);
            out->index_count += 3;
        }
    }
    scene->objects[first] = scene->objects[scene->def.object_count - 1];
    scene->def.object_count = first + 1;
    return first;
}

// --- whole scenes --------------------------------------------------------------------------------

void author_ball(int row, int column, double centre[3], float *metallic, float *roughness) {
    centre[0] = column - 2.5;
    centre[1] = 1.0 - row;
    centre[2] = 0.0;
    *metallic = 1.0f - (float)row / 2.0f;
    *roughness = (float)column / 5.0f;
}

void author_make_balls(AuthorScene *scene) {
    author_begin(scene);
    for (int i = 0; i < AUTHOR_BALL_ROWS * AUTHOR_BALL_COLUMNS; i++) {
        double at[3];
        float metallic, roughness;
        author_ball(i / AUTHOR_BALL_COLUMNS, i % AUTHOR_BALL_COLUMNS, at, &metallic, &roughness);
        const int material = author_add_pbr(scene, metallic, roughness);
        memcpy(scene->materials[material].base_colour_lin, author_gold_lin, sizeof author_gold_lin);
        const float centre[3] = {(float)at[0], (float)at[1], (float)at[2]};
        author_add_sphere(scene, material, centre, 0.45f);
    }
}

static void add_lights(AuthorScene *scene) {
    scene->lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                     .colour_lin = {0.4f, 0.35f, 0.3f},
                                     .direction_world = {0.5f, -1.0f, -0.7f}};
    scene->lights[1] = (DipLightDef){.kind = DIP_LIGHT_POINT,
                                     .colour_lin = {1.0f, 2.0f, 4.0f},
                                     .position_world = {-3.0f, 2.0f, 3.0f},
                                     .attenuation = {0.0f, 0.0f, 1.0f}};
    scene->lights[2] = (DipLightDef){.kind = DIP_LIGHT_SPOT,
                                     .colour_lin = {9.0f, 5.0f, 2.0f},
                                     .position_world = {3.0f, 1.0f, 4.0f},
                                     .direction_world = {-0.5f, -0.2f, -1.0f},
                                     .attenuation = {0.0f, 0.0f, 1.0f},
                                     .range_m = 9.0f,
                                     .inner_deg = 12.0f,
                                     .outer_deg = 25.0f};
    scene->lighting = (DipLightingDef){.ambient_lin = {0.2f, 0.25f, 0.3f},
                                       .sky_lin = {0.05f, 0.1f, 0.2f},
                                       .lights = scene->lights,
                                       .light_count = 3,
                                       .shading = DIP_SHADING_PHONG};
    scene->def.lighting = &scene->lighting;
}

// Fills a texture with soft waves. Channel c has the given mean and swing, in bytes.
static int add_waves(AuthorScene *scene, DipEncoding encoding, const int mean[3],
                     const int swing[3]) {
    enum { SIZE = 64 };
    const double turn = 2.0 * acos(-1.0) / SIZE;
    const int texture = author_add_texture(scene, SIZE, encoding);
    uint8_t *texels = author_texels(scene, texture);
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int c = 0; c < 3; c++) {
            const double wave = sin(turn * (c + 2) * (i % SIZE)) * cos(turn * (c + 1) * (i / SIZE));
            texels[4 * i + c] = (uint8_t)lround(mean[c] + swing[c] * wave);
        }
    }
    return texture;
}

void author_make_parts(AuthorScene *scene) {
    author_begin(scene);
    add_lights(scene);
    const int data =
        add_waves(scene, DIP_ENCODING_LINEAR, (int[]){140, 140, 128}, (int[]){100, 90, 120});
    const int bumps =
        add_waves(scene, DIP_ENCODING_LINEAR, (int[]){128, 128, 230}, (int[]){60, 60, 20});
    const int glow = add_waves(scene, DIP_ENCODING_SRGB, (int[]){60, 90, 120}, (int[]){50, 80, 99});
    for (int i = 0; i < 8; i++) {
        const float centre[3] = {(float)(i % 4) * 1.4f - 2.1f, i < 4 ? 0.9f : -0.9f, 0.0f};
        const int material = author_add_pbr(scene, 0.3f, 0.3f);
        DipPbrDef *pbr = &scene->pbrs[material];
        scene->materials[material].base_colour_lin[2] = 0.4f;
        author_add_sphere(scene, material, centre, 0.6f);
        if (i == 1 || i == 5) {
            pbr->metallic = pbr->roughness = 1.0f;
            pbr->metal_rough_map = pbr->occlusion_map = data;
            pbr->occlusion_strength = 0.8f;
        }
        if (i == 2 || i == 5) {
            scene->materials[material].normal_map = bumps;
            pbr->normal_scale = i == 2 ? 1.0f : 0.5f;
        }
        if (i == 3 || i == 5 || i == 6) {
            pbr->coat = i == 3 ? 1.0f : 0.6f;
            pbr->coat_roughness = i == 3 ? 0.05f : 0.4f;
        }
        if (i == 0 || i == 5) {
            pbr->sheen_lin[0] = 0.9f;
            pbr->sheen_lin[1] = pbr->sheen_lin[2] = 0.6f;
            pbr->sheen_roughness = i ? 0.3f : 0.7f;
        }
        if (i == 4 || i == 5) {
            pbr->emission_map = glow;
            pbr->emission_at_uv1 = true;
            pbr->emission_lin[0] = pbr->emission_lin[1] = pbr->emission_lin[2] = 0.7f;
        }
        if (i == 7) {
            pbr->occlusion_map = data;
            pbr->occlusion_at_uv1 = true;
        }
    }
    // A double-sided sheet, seen from behind.
    const int sheet = author_add_pbr(scene, 0.0f, 0.4f);
    scene->materials[sheet].double_sided = true;
    scene->materials[sheet].normal_map = bumps;
    author_add_quad(scene, sheet, (const float[]){4.0f, -3.0f, -2.0f}, (const float[]){-8, 0, 0},
                    (const float[]){0, 6, 0});
}

static int add_glass(AuthorScene *scene, float red, float green, float blue, float opacity) {
    const int material = author_add_pbr(scene, 0.0f, 0.2f);
    scene->materials[material].surface = DIP_SURFACE_BLENDED;
    scene->materials[material].opacity = opacity;
    scene->materials[material].base_colour_lin[0] = red;
    scene->materials[material].base_colour_lin[1] = green;
    scene->materials[material].base_colour_lin[2] = blue;
    return material;
}

void author_make_panes(AuthorScene *scene) {
    author_begin(scene);
    const int spots =
        add_waves(scene, DIP_ENCODING_SRGB, (int[]){150, 120, 100}, (int[]){90, 80, 70});
    uint8_t *texels = author_texels(scene, spots);
    for (int i = 0; i < 64 * 64; i++) {
        texels[4 * i + 3] = texels[4 * i];
    }
    const int red = add_glass(scene, 0.9f, 0.1f, 0.1f, 0.5f);
    const int green = add_glass(scene, 0.1f, 0.8f, 0.2f, 0.4f);
    const int both = add_glass(scene, 0.2f, 0.3f, 0.9f, 0.5f);
    scene->materials[both].double_sided = true;
    const int spotted = add_glass(scene, 1.0f, 1.0f, 1.0f, 0.9f);
    scene->materials[spotted].colour_texture = spots;
    scene->materials[spotted].pbr = NULL;
    const int wall = author_add_pbr(scene, 0.0f, 0.6f);
    // The nearest pane is submitted first, and the wall last.
    author_add_quad(scene, red, (const float[]){-2.0f, -1.5f, 2.0f}, (const float[]){2.2f, 0, 0},
                    (const float[]){0, 2.2f, 0});
    author_add_sphere(scene, both, (const float[]){0.2f, 0.2f, 0.5f}, 0.8f);
    author_add_quad(scene, green, (const float[]){-1.2f, -0.6f, -0.5f}, (const float[]){3.0f, 0, 0},
                    (const float[]){0, 1.6f, 0.3f});
    author_add_quad(scene, spotted, (const float[]){0.8f, -2.0f, 0.0f}, (const float[]){2.2f, 0, 0},
                    (const float[]){0, 2.4f, 0});
    author_add_quad(scene, red, (const float[]){-3.0f, 0.0f, -4.0f}, (const float[]){2.0f, 0, 0},
                    (const float[]){0, 2.0f, 0});
    author_add_quad(scene, wall, (const float[]){-5.0f, -4.0f, -2.5f}, (const float[]){7.0f, 0, 0},
                    (const float[]){0, 8.0f, 0});
}

void author_make_glass(AuthorScene *scene) {
    static const float transmissions[4] = {1.0f, 0.6f, 0.9f, 0.7f};
    author_make_panes(scene);
    for (int m = 0; m < 4; m++) {
        scene->materials[m].pbr = &scene->pbrs[m];
        scene->materials[m].opacity = m == 3 ? 0.9f : 1.0f;
        scene->pbrs[m].transmission = transmissions[m];
    }
    scene->pbrs[1].sheen_lin[0] = 0.5f;
    scene->pbrs[1].sheen_roughness = 0.4f;
    scene->pbrs[2].coat = 0.8f;
    scene->pbrs[3].metallic = 0.3f;
}
