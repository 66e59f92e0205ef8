// Tests the shadows of a directional light. Rays that this file casts through the triangles of a
// scene say which pixels are lit and which are in shadow. Where the shadow's edge is farther away
// than the filter and the bias reach, each pixel must be exactly one or the other.
#include "renderer/scene/lights.h"

#include "renderer/base/trig.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/draw/shadow_fit.h"
#include "tests/renderer/scene/stage.h"
#include "tests/renderer/scene/vec.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 72, RINGS = 9, MOST_TRIANGLES = 1024, SUN = 0, LAMP = 1 };

static DipTestScene scene;

// --- a yard: a ground, boxes, a ball and a fence -------------------------------------------------

// What the surfaces of the yard are.
typedef enum Surfaces { PHONG, GOURAUD, METALLIC, SURFACES } Surfaces;

static const float turn = -0.4f; // the camera looks down, in radians

static void add_box(int material, const float middle[3], const float size[3]) {
    static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
    const DipTestMesh mesh = dip_test_scene_add_mesh(&scene, 24, 36, DIP_TEST_NORMALS, material);
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, up = (axis + 1) % 3, right = (axis + 2) % 3;
        const float side = face % 2 ? 1.0f : -1.0f;
        for (int corner = 0; corner < 4; corner++) {
            const int v = 4 * face + corner;
            float at[3];
            at[axis] = side;
            at[up] = corner == 1 || corner == 2 ? 1.0f : -1.0f;
            at[right] = (corner >= 2 ? 1.0f : -1.0f) * side;
            for (int i = 0; i < 3; i++) {
                mesh.positions[3 * v + i] = middle[i] + 0.5f * size[i] * at[i];
            }
            mesh.normals[3 * v + axis] = side;
        }
        for (int i = 0; i < 6; i++) {
            mesh.indices[6 * face + i] = quad[i] + 4 * (uint32_t)face;
        }
    }
}

static void add_ball(int material, const float middle[3], float radius) {
    enum { ACROSS = 2 * RINGS };
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        &scene, (RINGS + 1) * (ACROSS + 1), 6 * RINGS * ACROSS, DIP_TEST_NORMALS, material);
    for (int v = 0; v < (RINGS + 1) * (ACROSS + 1); v++) {
        const double polar = acos(-1.0) * (v / (ACROSS + 1)) / RINGS;
        const double around = 2.0 * acos(-1.0) * (v % (ACROSS + 1)) / ACROSS;
        const double n[3] = {dip_sin(polar) * dip_cos(around), dip_cos(polar),
                             dip_sin(polar) * dip_sin(around)};
        for (int i = 0; i < 3; i++) {
            mesh.normals[3 * v + i] = (float)n[i];
            mesh.positions[3 * v + i] = middle[i] + radius * (float)n[i];
        }
    }
    for (int q = 0; q < RINGS * ACROSS; q++) {
        const uint32_t a = (uint32_t)(q / ACROSS * (ACROSS + 1) + q % ACROSS);
        const uint32_t b = a + ACROSS + 1;
        const uint32_t quad[6] = {a, a + 1, b, a + 1, b + 1, b};
        memcpy(mesh.indices + 6 * q, quad, sizeof quad);
    }
}

// Makes the yard. The sun is its strongest light; a lamp casts no shadow.
static void make_yard(Surfaces surfaces) {
    dip_test_scene_begin(&scene);
    scene.lighting = (DipLightingDef){
        .ambient_lin = {0.1f, 0.1f, 0.1f},
        .lights = scene.lights,
        .light_count = 3,
        .shading = surfaces == GOURAUD ? DIP_SHADING_GOURAUD : DIP_SHADING_PHONG,
    };
    scene.def.lighting = &scene.lighting;
    scene.lights[SUN] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                      .colour_lin = {0.6f, 0.55f, 0.5f},
                                      .direction_world = {1.1f, -1.5f, -0.8f}};
    scene.lights[LAMP] = (DipLightDef){.kind = DIP_LIGHT_POINT,
                                       .colour_lin = {0.5f, 0.5f, 1.0f},
                                       .position_world = {-2.0f, 3.0f, 1.0f},
                                       .attenuation = {1.0f, 0.0f, 1.0f}};
    scene.lights[2] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                    .colour_lin = {0.05f, 0.05f, 0.1f},
                                    .direction_world = {-1.0f, -0.2f, 0.3f}};
    const int paint = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    scene.materials[paint].lit = true;
    for (int c = 0; c < 3; c++) {
        scene.materials[paint].base_colour_lin[c] = 0.7f;
    }
    if (surfaces == METALLIC) {
        dip_test_scene_add_pbr(&scene, paint, 0.3f, 0.5f)->coat = 0.5f;
    }
    add_box(paint, (const float[]){0.0f, -0.2f, -2.0f}, (const float[]){9.0f, 0.4f, 9.0f});
    add_box(paint, (const float[]){-1.2f, 0.6f, -2.0f}, (const float[]){1.1f, 1.2f, 1.4f});
    add_box(paint, (const float[]){1.6f, 1.5f, -3.0f}, (const float[]){1.5f, 0.4f, 1.5f});
    add_ball(paint, (const float[]){0.6f, 0.7f, -0.6f}, 0.7f);
    scene.pose.position_world[1] = 2.6;
    scene.pose.position_world[2] = 3.2;
    scene.pose.orientation[0] = dip_sin(0.5 * (double)turn);
    scene.pose.orientation[3] = dip_cos(0.5 * (double)turn);
}

// --- drawing -------------------------------------------------------------------------------------

static DipRendererDef renderer_def(const char *settings) {
    DipRendererDef def = stage_def(SIZE, SIZE, settings);
    def.reflection = scene.reflection;
    return def;
}

typedef uint8_t Picture[SIZE][SIZE][4];

static void draw_picture(const char *settings, Picture picture) {
    Stage stage = stage_open(&scene.def, renderer_def(settings), 1);
    const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
    dip_image_copy(&frame, picture);
    stage_close(&stage);
}

// Draws the yard without shadows: once with the sun, and once without its light.
static void draw_bright_and_dark(Picture bright, Picture dark) {
    float *sun = scene.lights[SUN].colour_lin;
    float kept[3];
    draw_picture("", bright);
    memcpy(kept, sun, sizeof kept);
    sun[0] = sun[1] = sun[2] = 0.0f;
    draw_picture("", dark);
    memcpy(sun, kept, sizeof kept);
}

// --- rays ----------------------------------------------------------------------------------------

// A triangle of the scene. `light` has its corners in the coordinates of the light: to the right
// and up as the light sees them, and towards the light.
typedef struct Triangle {
    Vec world[3];
    Vec light[3];
    Vec normals[3];
    double slope[2]; // change of the third coordinate of the light per metre along the others
} Triangle;

static struct {
    Triangle triangles[MOST_TRIANGLES];
    int count;
    Vec axis[3];
    Vec low, high; // extent in the light's coordinates
} world;

static void to_light(const Vec point, Vec at) {
    for (int i = 0; i < 3; i++) {
        at[i] = dot(world.axis[i], point);
    }
}

static void collect_triangles(void) {
    const Vec up = {0.0, 1.0, 0.0};
    for (int i = 0; i < 3; i++) {
        world.axis[2][i] = -(double)scene.lights[SUN].direction_world[i];
        world.low[i] = INFINITY;
        world.high[i] = -INFINITY;
    }
    unit(world.axis[2]);
    cross(up, world.axis[2], world.axis[0]);
    unit(world.axis[0]);
    cross(world.axis[2], world.axis[0], world.axis[1]);
    world.count = 0;
    for (int m = 0; m < scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &scene.meshes[m];
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            Triangle *triangle = &world.triangles[world.count];
            const int corner = (int)(i % 3);
            for (int k = 0; k < 3; k++) {
                const size_t at = 3 * (size_t)mesh->indices[i] + (size_t)k;
                triangle->world[corner][k] = (double)mesh->positions[at];
                triangle->normals[corner][k] = (double)mesh->normals[at];
            }
            to_light(triangle->world[corner], triangle->light[corner]);
            for (int k = 0; k < 3; k++) {
                world.low[k] = fmin(world.low[k], triangle->light[corner][k]);
                world.high[k] = fmax(world.high[k], triangle->light[corner][k]);
            }
            if (corner == 2) {
                Vec a, b, n;
                for (int k = 0; k < 3; k++) {
                    a[k] = triangle->light[1][k] - triangle->light[0][k];
                    b[k] = triangle->light[2][k] - triangle->light[0][k];
                }
                cross(a, b, n);
                triangle->slope[0] = -n[0] / n[2];
                triangle->slope[1] = -n[1] / n[2];
                assert_true(++world.count < MOST_TRIANGLES);
            }
        }
    }
}

// Returns whether the light sees a triangle at a place, and finds how near to the light it is.
static bool covers(const Triangle *triangle, double x, double y, double *near) {
    const Vec *p = triangle->light;
    double weights[3];
    for (int i = 0; i < 3; i++) {
        const double *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        weights[i] = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
    }
    const double area = weights[0] + weights[1] + weights[2];
    if (area == 0.0 || weights[0] / area < 0.0 || weights[1] / area < 0.0 ||
        weights[2] / area < 0.0) {
        return false;
    }
    *near = (weights[0] * p[0][2] + weights[1] * p[1][2] + weights[2] * p[2][2]) / area;
    return true;
}

// What a pixel shows.
typedef struct Seen {
    const Triangle *triangle; // NULL: nothing
    Vec place;                // in the world
    Vec normal;
} Seen;

// Follows the ray through a place of the picture, in pixels, to the nearest triangle.
static Seen look(double x, double y) {
    const double focal = 1.0 / tan(scene.pose.fov_y_deg * acos(-1.0) / 360.0);
    const double right = (2.0 * x / SIZE - 1.0) / focal, up = (1.0 - 2.0 * y / SIZE) / focal;
    const double c = cos((double)turn), s = sin((double)turn);
    const Vec ray = {right, up * c + s, up * s - c};
    Seen seen = {.triangle = NULL};
    double nearest = INFINITY;
    for (int t = 0; t < world.count; t++) {
        const Triangle *triangle = &world.triangles[t];
        Vec a, b, from, p, q;
        for (int i = 0; i < 3; i++) {
            a[i] = triangle->world[1][i] - triangle->world[0][i];
            b[i] = triangle->world[2][i] - triangle->world[0][i];
            from[i] = scene.pose.position_world[i] - triangle->world[0][i];
        }
        cross(ray, b, p); // Moeller and Trumbore 1997
        cross(from, a, q);
        const double det = dot(a, p);
        const double second = dot(from, p) / det, third = dot(ray, q) / det;
        const double distance = dot(b, q) / det;
        if (det > 0.0 && second >= 0.0 && third >= 0.0 && second + third <= 1.0 && distance > 0.0 &&
            distance < nearest) {
            nearest = distance;
            seen.triangle = triangle;
            for (int i = 0; i < 3; i++) {
                seen.place[i] = scene.pose.position_world[i] + distance * ray[i];
                seen.normal[i] = (1.0 - second - third) * triangle->normals[0][i] +
                                 second * triangle->normals[1][i] + third * triangle->normals[2][i];
            }
        }
    }
    return seen;
}

// Lists the triangles that the light sees within a distance of a place, without the place's own.
static int triangles_near(const Seen *seen, const Vec at, const double reach[2],
                          const Triangle *near[MOST_TRIANGLES]) {
    int count = 0;
    for (int t = 0; t < world.count; t++) {
        const Triangle *triangle = &world.triangles[t];
        const Vec *p = triangle->light;
        bool reaches = triangle != seen->triangle;
        for (int i = 0; i < 2; i++) {
            reaches = reaches && fmin(p[0][i], fmin(p[1][i], p[2][i])) <= at[i] + reach[i] &&
                      fmax(p[0][i], fmax(p[1][i], p[2][i])) >= at[i] - reach[i];
        }
        if (reaches) {
            near[count++] = triangle;
        }
    }
    return count;
}

typedef enum Verdict { LIT, SHADED, EDGE } Verdict;

// Decides whether all that a read of the map can meet is lit, or all of it in shadow. size: of the
// map.
static Verdict judge(const Seen *seen, int size) {
    enum { REACH = 4 }; // half texels
    const double *slope = seen->triangle->slope;
    Vec at, normal;
    double texel[2]; // greatest size: the fit rounds up by at most a quarter
    to_light(seen->place, at);
    for (int i = 0; i < 3; i++) {
        normal[i] = dot(world.axis[i], seen->normal);
    }
    for (int i = 0; i < 2; i++) {
        texel[i] = 1.25 * (world.high[i] - world.low[i]) / (size - 5);
    }
    const double moved = (fabs(normal[0]) * texel[0] + fabs(normal[1]) * texel[1]) * 1.5;
    const double rise = moved / fmax(fabs(normal[2]), 0.125);
    bool all_lit = fabs(normal[2]) > 0.13 && fabs(slope[0]) < 7.0;
    bool all_shaded = true;
    const Triangle *casters[MOST_TRIANGLES];
    const double reach[2] = {0.5 * REACH * texel[0], 0.5 * REACH * texel[1]};
    const int count = triangles_near(seen, at, reach, casters);
    for (int i = 0; i < (2 * REACH + 1) * (2 * REACH + 1) && (all_lit || all_shaded); i++) {
        const double dx = 0.5 * (i % (2 * REACH + 1) - REACH) * texel[0];
        const double dy = 0.5 * (i / (2 * REACH + 1) - REACH) * texel[1];
        const double plane = at[2] + slope[0] * dx + slope[1] * dy;
        bool shaded = false;
        for (int t = 0; t < count; t++) {
            double near;
            if (covers(casters[t], at[0] + dx, at[1] + dy, &near)) {
                const double bias = 3.0 * fmax(fabs(casters[t]->slope[0]) * texel[0],
                                               fabs(casters[t]->slope[1]) * texel[1]);
                all_lit = all_lit && near <= plane + 1e-6;
                shaded = shaded || near - bias - 1e-4 > fmax(plane, at[2]) + rise;
            }
        }
        all_shaded = all_shaded && shaded;
    }
    return all_lit ? LIT : all_shaded ? SHADED : EDGE;
}

// --- tests ---------------------------------------------------------------------------------------

// Whether a pixel shows nothing but the level ground.
static bool shows_ground(int x, int y) {
    for (int corner = 0; corner < 4; corner++) {
        const Seen seen = look(x + corner % 2, y + corner / 2);
        if (!seen.triangle || seen.place[1] > 1e-3 || seen.normal[1] < 1.0) {
            return false;
        }
    }
    return true;
}

static bool near_colour(const uint8_t a[4], const uint8_t b[4], int allowed) {
    return abs(a[0] - b[0]) <= allowed && abs(a[1] - b[1]) <= allowed &&
           abs(a[2] - b[2]) <= allowed;
}

// The light of vertices is a sum of two interpolated parts, which rounds differently.
static void check_yard(Surfaces surfaces, int size) {
    static Picture bright, dark, drawn;
    const int allowed = surfaces == GOURAUD ? 1 : 0;
    char settings[32];
    int counts[3] = {0, 0, 0}, wrong = 0;
    make_yard(surfaces);
    collect_triangles();
    draw_bright_and_dark(bright, dark);
    snprintf(settings, sizeof settings, "shadows=%d", size);
    draw_picture(settings, drawn);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const Seen seen = look(x + 0.5, y + 0.5);
            if (!seen.triangle || near_colour(bright[y][x], dark[y][x], 3)) {
                continue; // The sun does not shine there anyway.
            }
            const Verdict verdict = judge(&seen, size);
            counts[verdict]++;
            wrong += verdict == LIT && !near_colour(drawn[y][x], bright[y][x], allowed);
            wrong += verdict == SHADED && !near_colour(drawn[y][x], dark[y][x], allowed);
        }
    }
    dip_test_scene_free(&scene);
    if (wrong || counts[LIT] < 1000 || counts[SHADED] < 60 || counts[EDGE] > 1200) {
        fail_msg(
            "surfaces %d, shadows=%d: %d pixels are lit, %d in shadow, %d near an edge; %d are "
            "wrong",
            surfaces, size, counts[LIT], counts[SHADED], counts[EDGE], wrong);
    }
}

static void pixels_away_from_edges_are_lit_or_in_shadow_as_rays_say(void **state) {
    (void)state;
    for (int surfaces = 0; surfaces < SURFACES; surfaces++) {
        for (int size = 512; size <= 2048; size *= 2) {
            check_yard((Surfaces)surfaces, size);
        }
    }
}

// The reference casts rays of its own. Where a ray through a slightly moved place agrees, it draws
// the pixel lit or in shadow; so does the converged picture, whose samples lie all over a pixel.
static void reference_asks_rays_to_the_light(void **state) {
    (void)state;
    static double bright[SIZE * SIZE * 3], drawn[SIZE * SIZE * 3], converged[SIZE * SIZE * 3];
    DipQuality with, without = dip_quality_default();
    int counts[3] = {0, 0, 0}, wrong = 0;
    assert_true(dip_quality_parse("shadows=512", &with, NULL));
    make_yard(PHONG);
    scene.lighting.light_count = 1; // the sun alone
    collect_triangles();
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    const DipPose *pose = &scene.pose;
    assert_true(dip_reference_draw(reference, &without, pose, SIZE, SIZE, bright, NULL));
    assert_true(dip_reference_draw(reference, &with, pose, SIZE, SIZE, drawn, NULL));
    assert_true(dip_reference_converge(reference, pose, SIZE, SIZE, 4, 1, converged, NULL));
    for (int i = 0; i < SIZE * SIZE; i++) {
        const Seen seen = look(i % SIZE + 0.5, i / SIZE + 0.5);
        if (!seen.triangle || dot(seen.normal, world.axis[2]) < 0.2) {
            continue;
        }
        // A map of 2^20 texels: rays that are 10 micrometres apart.
        const Verdict verdict = judge(&seen, 1 << 20);
        const double expected = verdict == LIT ? bright[3 * i] : (double)0.7f * (double)0.1f;
        counts[verdict]++;
        wrong += verdict != EDGE && fabs(drawn[3 * i] - expected) > 1e-9;
        // Ground far from any edge has one colour.
        if (shows_ground(i % SIZE, i / SIZE) && judge(&seen, 100) == verdict) {
            wrong += verdict != EDGE && fabs(converged[3 * i] - expected) > 1e-6;
        }
    }
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
    if (wrong || counts[LIT] < 1500 || counts[SHADED] < 100 || counts[EDGE] > 20) {
        fail_msg("%d pixels are lit, %d in shadow, %d near an edge; %d are wrong", counts[LIT],
                 counts[SHADED], counts[EDGE], wrong);
    }
}

// --- plan ----------------------------------------------------------------------------------------

static DipFrame draw_hash(const char *settings, bool force_all, DipIsa isa, int threads,
                          char hash[33]) {
    DipRendererDef def = renderer_def(settings);
    def.force_all_effects = force_all;
    def.isa = isa;
    Stage stage = stage_open(&scene.def, def, threads);
    const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
    dip_frame_hash(&frame, hash);
    stage_close(&stage);
    return frame; // Only its counters and effects stay valid.
}

// Lets a sun shine on all scenes, also on the mirrored ones, unless they have lights.
static void add_sun(void) {
    if (!scene.def.lighting) {
        scene.lighting = (DipLightingDef){
            .ambient_lin = {0.3f, 0.3f, 0.3f}, .lights = scene.lights, .light_count = 1};
        scene.lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                        .colour_lin = {0.7f, 0.7f, 0.7f},
                                        .direction_world = {0.4f, -1.0f, 0.2f}};
        scene.def.lighting = &scene.lighting;
    }
}

static void plan_threads_and_instructions_change_no_bit(void **state) {
    (void)state;
    int shadowed = 0;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (int size = 512; size <= 2048; size *= 4) {
            char settings[48], first[33], other[33];
            dip_test_scene_make(&scene, (DipTestSceneKind)kind);
            add_sun();
            snprintf(settings, sizeof settings, "aa=4,aaa=on,shadows=%d", size);
            const DipFrame planned = draw_hash(settings, false, DIP_ISA_SCALAR, 1, first);
            draw_hash(settings, true, DIP_ISA_SCALAR, 3, other);
            assert_string_equal(first, other);
            for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
                if (dip_isa_available((DipIsa)isa)) {
                    draw_hash(settings, false, (DipIsa)isa, 2, other);
                    assert_string_equal(first, other);
                }
            }
            shadowed += planned.counters.fragments_shadowed > 0;
            dip_test_scene_free(&scene);
        }
    }
    assert_true(shadowed >= 10);
}

static void scenes_without_a_sun_take_nothing(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        char before[33], after[33];
        dip_test_scene_make(&scene, (DipTestSceneKind)kind);
        for (int l = 0; scene.def.lighting && l < scene.lighting.light_count; l++) {
            scene.lights[l].kind = DIP_LIGHT_POINT;
            scene.lights[l].attenuation[0] = 1.0f;
        }
        const DipIsa isa = dip_isa_best();
        const DipFrame off = draw_hash("shadows=off", false, isa, 1, before);
        const DipFrame on = draw_hash("shadows=2048", false, isa, 1, after);
        assert_string_equal(before, after);
        assert_memory_equal(&off.counters, &on.counters, sizeof off.counters);
        assert_int_equal(on.counters.shadow_bytes, 0);
        assert_string_equal(off.effects.shadows.why, "shadows is off");
        assert_string_equal(on.effects.shadows.why, "the scene has no directional light");
        dip_test_scene_free(&scene);
    }
}

static DipFrame draw_yard(const char *settings) {
    char hash[33];
    return draw_hash(settings, false, dip_isa_best(), 1, hash);
}

static void plan_says_why_there_are_no_shadows(void **state) {
    (void)state;
    make_yard(PHONG);
    DipFrame frame = draw_yard("shadows=512");
    assert_true(frame.effects.shadows.run);
    assert_int_equal(frame.counters.shadow_texels, 512 * 512);
    assert_int_equal(frame.counters.shadow_bytes, 512 * 512 * 5);
    assert_int_equal(frame.counters.fragments_shadowed, frame.counters.fragments_lit);
    scene.pose.orientation[0] = 0.0; // turned around, to the empty side
    scene.pose.orientation[1] = 1.0;
    scene.pose.orientation[3] = 0.0;
    frame = draw_yard("shadows=512");
    assert_string_equal(frame.effects.shadows.why,
                        "no surface that the directional light lights is in view");
    assert_int_equal(frame.counters.shadow_texels, 0);
    assert_int_equal(frame.counters.triangles_in, 0);
    scene.materials[0].surface = DIP_SURFACE_BLENDED;
    scene.materials[0].opacity = 0.5f;
    frame = draw_yard("shadows=512");
    assert_string_equal(frame.effects.shadows.why, "no surface of the scene casts a shadow");
    assert_int_equal(frame.counters.shadow_bytes, 0);
    scene.materials[0].lit = false;
    frame = draw_yard("shadows=512");
    assert_string_equal(frame.effects.shadows.why, "the scene's lights light no surface");
    dip_test_scene_free(&scene);
}

// A backdrop, or the ground that the program adds below a model, has its own shade.
static void unlit_surfaces_neither_cast_nor_receive(void **state) {
    (void)state;
    static Picture alone, below, plain;
    make_yard(PHONG);
    draw_picture("shadows=1024", alone);
    const int backdrop = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
    scene.materials[backdrop].double_sided = true;
    // A roof above the camera, between the sun and the yard.
    dip_test_scene_add_quad(&scene, backdrop, (const float[]){-9, 5, -9}, (const float[]){18, 0, 0},
                            (const float[]){0, 0, 18}, 1, 1);
    draw_picture("shadows=1024", below);
    assert_memory_equal(alone, below, sizeof alone);
    // A sheet on the ground, where shadows fall.
    dip_test_scene_add_quad(&scene, backdrop, (const float[]){-4, 0.01f, -5},
                            (const float[]){8, 0, 0}, (const float[]){0, 0, 7}, 1, 1);
    draw_picture("shadows=1024", below);
    draw_picture("", plain);
    const Seen before_box = look(SIZE / 2.0, SIZE - 8.0);
    assert_non_null(before_box.triangle);
    for (int x = 0; x < SIZE; x++) {
        assert_memory_equal(below[SIZE - 8][x], plain[SIZE - 8][x], 4);
    }
    dip_test_scene_free(&scene);
}

// --- fit -----------------------------------------------------------------------------------------

static bool is_whole(double value) {
    return fabs(value - rint(value)) < 1e-6;
}

// While the camera moves, the map moves by whole texels, the size of a texel seldom changes, and
// all that is in view stays inside, as far from the edges as a read reaches.
static void map_moves_by_whole_texels(void **state) {
    (void)state;
    enum { STEPS = 120, MAP = 1024 };
    int changes = 0;
    make_yard(PHONG);
    collect_triangles();
    Stage stage = stage_open(&scene.def, renderer_def(""), 1);
    DipShadowFit before;
    for (int step = 0; step < STEPS; step++) {
        scene.pose.position_world[0] = 0.01 * step - 0.6;
        const DipView view = dip_view_make(&scene.pose, (double)scene.def.near_m, 1.0);
        const DipPass pass = {.target = {.width = SIZE, .height = SIZE}};
        const DipCullPlanes planes = dip_cull_pass_planes(&pass, view.world_to_clip);
        const DipShadowFit fit =
            dip_shadow_fit(stage.scene, &(DipShadowView){&view, &planes}, 1, MAP);
        for (int i = 0; i < 2; i++) {
            assert_true(is_whole(fit.low[i] / fit.texel[i]));
            changes += step > 0 && fit.texel[i] != before.texel[i];
        }
        for (int i = 0; i < 16; i++) {
            const Seen seen = look(SIZE * (i % 4) / 3.0, SIZE * (0.5 + i / 4 / 6.0));
            for (int k = 0; seen.triangle && k < 2; k++) {
                const double at = (dot(fit.axis[k], seen.place) - fit.low[k]) / fit.texel[k];
                assert_true(at >= 2.0 && at <= MAP - 2.0);
            }
        }
        before = fit;
    }
    stage_close(&stage);
    dip_test_scene_free(&scene);
    assert_true(changes <= 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_away_from_edges_are_lit_or_in_shadow_as_rays_say),
        cmocka_unit_test(reference_asks_rays_to_the_light),
        cmocka_unit_test(plan_threads_and_instructions_change_no_bit),
        cmocka_unit_test(scenes_without_a_sun_take_nothing),
        cmocka_unit_test(plan_says_why_there_are_no_shadows),
        cmocka_unit_test(unlit_surfaces_neither_cast_nor_receive),
        cmocka_unit_test(map_moves_by_whole_texels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
