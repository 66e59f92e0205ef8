// Hashes every part of a scene in a fixed order.
#include "app/cost/plan.h"

#include "renderer/base/hash.h"
#include "renderer/base/assert.h"
#include "renderer/scene/motion.h"

static void hash_floats(DipHash *hash, const float *values, int count) {
    dip_hash_bytes(hash, values, (size_t)count * sizeof *values);
}

static void hash_integers(DipHash *hash, const int *values, int count) {
    dip_hash_bytes(hash, values, (size_t)count * sizeof *values);
}

static void hash_textures(const DipSceneDef *def, DipHash *hash) {
    for (int t = 0; t < def->texture_count; t++) {
        const DipTextureDef *texture = &def->textures[t];
        const int values[] = {texture->width, texture->height, (int)texture->encoding,
                              (int)texture->wrap_u, (int)texture->wrap_v};
        hash_integers(hash, values, DIP_ARRAY_COUNT(values));
        dip_hash_bytes(hash, texture->border_rgba8, sizeof texture->border_rgba8);
        dip_hash_bytes(hash, texture->rgba8, (size_t)texture->width * (size_t)texture->height * 4);
    }
}

static void hash_pbr(const DipPbrDef *pbr, DipHash *hash) {
    dip_hash_integer(hash, pbr != NULL);
    if (!pbr) {
        return;
    }
    const int indices[] = {pbr->metal_rough_map, pbr->occlusion_map, pbr->occlusion_at_uv1,
                           pbr->emission_map, pbr->emission_at_uv1};
    const float shares[] = {pbr->metallic,           pbr->roughness,       pbr->f90,
                            pbr->occlusion_strength, pbr->normal_scale,    pbr->coat,
                            pbr->coat_roughness,     pbr->sheen_roughness, pbr->transmission,
                            pbr->scattering};
    hash_integers(hash, indices, DIP_ARRAY_COUNT(indices));
    hash_floats(hash, shares, DIP_ARRAY_COUNT(shares));
    hash_floats(hash, pbr->f0_lin, 3);
    hash_floats(hash, pbr->emission_lin, 3);
    hash_floats(hash, pbr->sheen_lin, 3);
}

static void hash_materials(const DipSceneDef *def, DipHash *hash) {
    for (int m = 0; m < def->material_count; m++) {
        const DipMaterialDef *material = &def->materials[m];
        const int indices[] = {(int)material->surface, material->colour_texture,
                               material->light_map,    material->normal_map,
                               material->double_sided, material->lit};
        const float numbers[] = {material->light_map_scale, material->roughness,
                                 material->shininess,       material->alpha_cutoff,
                                 material->opacity,         material->transmission};
        hash_integers(hash, indices, DIP_ARRAY_COUNT(indices));
        hash_floats(hash, numbers, DIP_ARRAY_COUNT(numbers));
        hash_floats(hash, material->base_colour_lin, 3);
        hash_floats(hash, material->specular_lin, 3);
        hash_pbr(material->pbr, hash);
    }
}

// A scene whose `lighting` is NULL has the fixed light (scene.h), which adds only the number -1.
static void hash_lighting(const DipLightingDef *lighting, DipHash *hash) {
    dip_hash_integer(hash, lighting ? lighting->light_count : -1);
    for (int l = 0; lighting && l < lighting->light_count; l++) {
        const DipLightDef *light = &lighting->lights[l];
        const float numbers[] = {light->range_m, light->inner_deg, light->outer_deg};
        dip_hash_integer(hash, light->kind);
        hash_floats(hash, numbers, DIP_ARRAY_COUNT(numbers));
        hash_floats(hash, light->colour_lin, 3);
        hash_floats(hash, light->position_world, 3);
        hash_floats(hash, light->direction_world, 3);
        hash_floats(hash, light->attenuation, 3);
    }
    if (lighting) {
        dip_hash_integer(hash, lighting->shading);
        hash_floats(hash, lighting->ambient_lin, 3);
        hash_floats(hash, lighting->sky_lin, 3);
    }
}

static void hash_meshes(const DipSceneDef *def, DipHash *hash) {
    for (int m = 0; m < def->mesh_count; m++) {
        const DipMeshDef *mesh = &def->meshes[m];
        const struct {
            const float *values;
            size_t width;
        } arrays[] = {{mesh->positions, 3}, {mesh->normals, 3},     {mesh->uv0, 2},
                      {mesh->uv1, 2},       {mesh->colours_lin, 3}, {mesh->alphas, 1}};
        dip_hash_integer(hash, mesh->vertex_count);
        dip_hash_integer(hash, mesh->material);
        for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++) {
            dip_hash_integer(hash, arrays[a].values != NULL);
            if (arrays[a].values) {
                dip_hash_bytes(hash, arrays[a].values,
                               mesh->vertex_count * arrays[a].width * sizeof(float));
            }
        }
        dip_hash_integer(hash, mesh->index_count);
        dip_hash_bytes(hash, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    }
}

static void hash_objects(const DipSceneDef *def, DipHash *hash) {
    for (int o = 0; o < def->object_count; o++) {
        dip_hash_integer(hash, def->objects[o].mesh);
        dip_hash_bytes(hash, def->objects[o].transform, sizeof def->objects[o].transform);
    }
    dip_hash_bytes(hash, def->background_lin, sizeof def->background_lin);
    dip_hash_number(hash, (double)def->near_m);
}

static void hash_rig(const DipMotionRig *rig, DipHash *hash) {
    const double numbers[] = {rig->duration_s, rig->is_held ? rig->held_s : -1.0};
    dip_hash_bytes(hash, numbers, sizeof numbers);
    dip_hash_bytes(hash, rig->root, sizeof rig->root);
    for (int n = 0; n < rig->rig.node_count; n++) {
        const DipRigNode *node = &rig->rig.nodes[n];
        dip_hash_integer(hash, node->parent);
        dip_hash_integer(hash, node->has_matrix);
        dip_hash_bytes(hash, node->matrix, sizeof node->matrix);
        dip_hash_bytes(hash, node->translation, sizeof node->translation);
        dip_hash_bytes(hash, node->rotation, sizeof node->rotation);
        dip_hash_bytes(hash, node->scale, sizeof node->scale);
    }
    dip_hash_bytes(hash, rig->rig.rest_weights,
                   (size_t)rig->rig.weight_count * sizeof *rig->rig.rest_weights);
    for (int s = 0; s < rig->skin_count; s++) {
        const DipRigSkin *skin = &rig->skins[s];
        const size_t joints = (size_t)skin->joint_count;
        dip_hash_bytes(hash, skin->nodes, joints * sizeof *skin->nodes);
        dip_hash_bytes(hash, skin->inverse_binds, 12 * joints * sizeof *skin->inverse_binds);
    }
    for (int t = 0; t < rig->track_count; t++) {
        const DipTrack *track = &rig->tracks[t];
        const int values[] = {(int)track->target, (int)track->interpolation, track->node};
        dip_hash_bytes(hash, values, sizeof values);
        dip_hash_bytes(hash, track->times, track->key_count * sizeof *track->times);
        dip_hash_bytes(hash, track->values, dip_track_value_count(track) * sizeof *track->values);
    }
}

// Adds nothing for a scene without motion.
static void hash_motion(const DipMotionDef *motion, DipHash *hash) {
    for (int r = 0; motion && r < motion->rig_count; r++) {
        hash_rig(&motion->rigs[r], hash);
    }
    for (int o = 0; motion && o < motion->object_count; o++) {
        const DipMovingObject *object = &motion->objects[o];
        const int values[] = {object->object, object->rig, object->node};
        dip_hash_bytes(hash, values, sizeof values);
        dip_hash_bytes(hash, object->offset, sizeof object->offset);
    }
    for (int m = 0; motion && m < motion->mesh_count; m++) {
        const DipMovingMesh *mesh = &motion->meshes[m];
        const int values[] = {mesh->mesh, mesh->rig, mesh->node, mesh->skin, mesh->shape_count};
        const size_t vertices = mesh->vertex_count;
        const size_t floats = 3 * vertices * (size_t)mesh->shape_count;
        dip_hash_bytes(hash, values, sizeof values);
        dip_hash_bytes(hash, mesh->positions, floats * sizeof(float));
        dip_hash_bytes(hash, mesh->normals, mesh->normals ? floats * sizeof(float) : 0);
        if (mesh->skin != DIP_NO_SKIN) {
            dip_hash_bytes(hash, mesh->joints, 4 * vertices * sizeof *mesh->joints);
            dip_hash_bytes(hash, mesh->joint_weights, 4 * vertices * sizeof(float));
        }
    }
}

static void hash_sky(const DipSkyDef *sky, DipHash *hash) {
    for (int i = 0; i < 2; i++) {
        dip_hash_number(hash, (double)sky->layers[i].scale);
        dip_hash_number(hash, sky->layers[i].speed_per_min);
        dip_hash_number(hash, (double)sky->layers[i].perturbation_widths);
    }
    const float values[] = {sky->perturbation_scale, sky->blend, sky->clear, sky->dense,
                            sky->overcast};
    dip_hash_bytes(hash, values, sizeof values);
    dip_hash_bytes(hash, sky->zenith_lin, sizeof sky->zenith_lin);
    dip_hash_bytes(hash, sky->horizon_lin, sizeof sky->horizon_lin);
    dip_hash_bytes(hash, sky->cloud_lin, sizeof sky->cloud_lin);
    dip_hash_bytes(hash, sky->glare_lin, sizeof sky->glare_lin);
    dip_hash_bytes(hash, sky->tint_lin, sizeof sky->tint_lin);
}

static void hash_environment(const DipEnvironmentDef *environment, DipHash *hash) {
    dip_hash_integer(hash, environment != NULL);
    if (environment) {
        const size_t texels = (size_t)environment->width * (size_t)environment->height;
        dip_hash_integer(hash, environment->width);
        dip_hash_bytes(hash, environment->rgb_lin, 3 * texels * sizeof(float));
    }
}

static void hash_reflection(const DipReflectionDef *reflection, DipHash *hash) {
    dip_hash_integer(hash, reflection->width);
    dip_hash_integer(hash, reflection->height);
    dip_hash_number(hash, reflection->level_m);
    dip_hash_integer(hash, reflection->schlick);
}

void dip_cost_scene_hash(const DipSceneDef *def, const DipReflectionDef *reflection, char hex[33]) {
    DipHash hash = dip_hash_begin(0);
    hash_textures(def, &hash);
    hash_materials(def, &hash);
    hash_meshes(def, &hash);
    hash_objects(def, &hash);
    hash_motion(def->motion, &hash);
    hash_lighting(def->lighting, &hash);
    hash_sky(&def->sky, &hash);
    hash_environment(def->environment, &hash);
    hash_reflection(reflection, &hash);
    dip_hash_hex(&hash, hex);
}
