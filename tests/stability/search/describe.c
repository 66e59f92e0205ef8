// Describes a scene of the random search in words.
#include "tests/stability/search/scene_from_choices.h"

#include <inttypes.h>

static void describe_view(const SearchScene *made, FILE *out) {
    const DipPose *pose = &made->scene.pose;
    const double *p = pose->position_world;
    const double *q = pose->orientation;
    fprintf(out, "picture: %dx%d pixels, time %" PRId64 " ns, frame %" PRIu64 "\n", made->width,
            made->height, made->time_ns, made->frame_index);
    fprintf(out, "settings:");
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        const int step = made->quality.step[s];
        if (step != info->default_step) {
            fprintf(out, " %s=%s", info->key, info->steps[step]);
        }
    }
    fprintf(out, "\n");
    fprintf(out,
            "camera: at (%.9g, %.9g, %.9g), orientation (%.6g, %.6g, %.6g, %.6g), "
            "field of view %g degrees, near plane at %g m\n",
            p[0], p[1], p[2], q[0], q[1], q[2], q[3], pose->fov_y_deg,
            (double)made->scene.def.near_m);
}

static void describe_texture(const SearchScene *made, const char *use, int index, FILE *out) {
    if (index != DIP_NO_TEXTURE) {
        const DipTextureDef *texture = &made->scene.textures[index];
        static const char *const wraps[] = {
            [DIP_WRAP_CLAMP] = "clamped", [DIP_WRAP_MIRROR] = "mirrored", [DIP_WRAP_BORDER] = NULL};
        const char *u = wraps[texture->wrap_u];
        const char *v = wraps[texture->wrap_v];
        fprintf(out, ", %s of %dx%d texels%s%s%s%s%s", use, texture->width, texture->height,
                u ? ", u " : "", u ? u : "", v ? ", v " : "", v ? v : "",
                texture->encoding == DIP_ENCODING_LINEAR ? ", linear" : "");
    }
}

static void describe_pbr(const SearchScene *made, const DipPbrDef *pbr, FILE *out) {
    const float *f0 = pbr->f0_lin;
    fprintf(out, "  metal %g, roughness %g, f0 (%g, %g, %g), f90 %g, normal scale %g",
            (double)pbr->metallic, (double)pbr->roughness, (double)f0[0], (double)f0[1],
            (double)f0[2], (double)pbr->f90, (double)pbr->normal_scale);
    describe_texture(made, "metal-rough map", pbr->metal_rough_map, out);
    describe_texture(made, "occlusion map", pbr->occlusion_map, out);
    describe_texture(made, "emission map", pbr->emission_map, out);
    fprintf(out,
            "\n  occlusion %g, emission (%g, %g, %g), coat %g of roughness %g, "
            "sheen (%g, %g, %g) of roughness %g, transmission %g, scattering %g\n",
            (double)pbr->occlusion_strength, (double)pbr->emission_lin[0],
            (double)pbr->emission_lin[1], (double)pbr->emission_lin[2], (double)pbr->coat,
            (double)pbr->coat_roughness, (double)pbr->sheen_lin[0], (double)pbr->sheen_lin[1],
            (double)pbr->sheen_lin[2], (double)pbr->sheen_roughness, (double)pbr->transmission,
            (double)pbr->scattering);
}

static void describe_lights(const DipLightingDef *lighting, FILE *out) {
    fprintf(out, "lights: ambient %g, %s\n", (double)lighting->ambient_lin[0],
            lighting->shading == DIP_SHADING_PHONG ? "Phong" : "Gouraud");
    for (int i = 0; i < lighting->light_count; i++) {
        const DipLightDef *light = &lighting->lights[i];
        const bool far = light->kind == DIP_LIGHT_DIRECTIONAL;
        const float *at = far ? light->direction_world : light->position_world;
        fprintf(out, "  %s (%.9g, %.9g, %.9g), colour (%g, %g, %g)\n", far ? "towards" : "at",
                (double)at[0], (double)at[1], (double)at[2], (double)light->colour_lin[0],
                (double)light->colour_lin[1], (double)light->colour_lin[2]);
    }
}

static void describe_material(const SearchScene *made, const DipMaterialDef *material, FILE *out) {
    static const char *const surfaces[] = {"opaque", "clipped", "blended", "water", "sky"};
    fprintf(out, "  material: %s", surfaces[material->surface]);
    if (material->surface == DIP_SURFACE_CLIPPED) {
        fprintf(out, " at %g", (double)material->alpha_cutoff);
    }
    if (material->surface == DIP_SURFACE_BLENDED) {
        fprintf(out, " with opacity %g", (double)material->opacity);
    }
    if (material->surface == DIP_SURFACE_WATER) {
        fprintf(out, " with transmission %g", (double)material->transmission);
    }
    fprintf(out, "%s%s, base colour (%g, %g, %g)", material->double_sided ? ", double-sided" : "",
            material->lit ? ", lit" : "", (double)material->base_colour_lin[0],
            (double)material->base_colour_lin[1], (double)material->base_colour_lin[2]);
    describe_texture(made, "colour texture", material->colour_texture, out);
    describe_texture(made, "light map", material->light_map, out);
    describe_texture(made, "normal map", material->normal_map, out);
    fprintf(out, "\n");
    if (material->pbr) {
        describe_pbr(made, material->pbr, out);
    }
}

static void describe_vertices(const DipMeshDef *mesh, FILE *out) {
    enum { MOST = 12 };
    for (uint32_t v = 0; v < mesh->vertex_count && v < MOST; v++) {
        const float *p = mesh->positions + 3 * (size_t)v;
        fprintf(out, "  vertex %u: (%.9g, %.9g, %.9g)", v, (double)p[0], (double)p[1],
                (double)p[2]);
        if (mesh->uv0) {
            fprintf(out, ", uv0 (%.9g, %.9g)", (double)mesh->uv0[2 * v],
                    (double)mesh->uv0[2 * v + 1]);
        }
        if (mesh->uv1) {
            fprintf(out, ", uv1 (%.9g, %.9g)", (double)mesh->uv1[2 * v],
                    (double)mesh->uv1[2 * v + 1]);
        }
        if (mesh->alphas) {
            fprintf(out, ", alpha %g", (double)mesh->alphas[v]);
        }
        fprintf(out, "\n");
    }
}

static void describe_object(const SearchScene *made, int index, FILE *out) {
    const DipObjectDef *object = &made->scene.objects[index];
    const DipMeshDef *mesh = &made->scene.meshes[object->mesh];
    fprintf(out, "object %d: %s, mesh %d with %u vertices and %u triangles\n", index,
            made->shape_names[object->mesh], object->mesh, mesh->vertex_count,
            mesh->index_count / 3);
    fprintf(out, "  transform:");
    for (int i = 0; i < 12; i++) {
        fprintf(out, " %.9g%s", (double)object->transform[i], i % 4 == 3 && i < 11 ? "," : "");
    }
    fprintf(out, "\n");
    describe_material(made, &made->scene.materials[mesh->material], out);
    describe_vertices(mesh, out);
}

void search_scene_describe(const SearchScene *made, FILE *out) {
    describe_view(made, out);
    const DipReflectionDef *reflection = &made->scene.reflection;
    if (reflection->width) {
        fprintf(out, "reflection: %dx%d pixels, level %.9g m%s\n", reflection->width,
                reflection->height, reflection->level_m, reflection->schlick ? ", Schlick" : "");
    }
    if (made->scene.def.lighting) {
        describe_lights(made->scene.def.lighting, out);
    }
    for (int i = 0; i < made->scene.def.object_count; i++) {
        describe_object(made, i, out);
    }
}
