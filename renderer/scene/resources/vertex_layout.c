// Decides which attributes the vertices of a mesh keep and which varyings its shaders get.
#include "renderer/scene/resources/vertex_layout.h"

#include <string.h>

// Appends an array and returns the index of its first attribute.
static int add_source(DipVertexLayout *layout, const float *source, int size) {
    const int first = layout->attribute_count;
    layout->source[layout->count] = source;
    layout->size[layout->count++] = size;
    layout->attribute_count += size;
    return first;
}

bool dip_material_draws_normal_map(const DipMaterialDef *material) {
    return dip_surface_is_solid(material->surface) && material->normal_map != DIP_NO_TEXTURE &&
           (material->lit || material->light_map != DIP_NO_TEXTURE);
}

// Lays out the varyings of a mesh whose fragments are lit: texture coordinates, normal, depth and,
// if the mesh has them, vertex colours. Returns the number of varyings.
static int lay_out_lit_fragments(DipSurfaceUniforms *uniforms, int normal_attribute) {
    uniforms->normal_attribute = normal_attribute;
    uniforms->normal_varying = uniforms->copied_varying_count;
    uniforms->depth_varying = uniforms->copied_varying_count + 3;
    uniforms->light_varying = DIP_ABSENT;
    uniforms->highlight_varying = DIP_ABSENT;
    if (uniforms->colour_attribute == DIP_ABSENT) {
        return uniforms->copied_varying_count + 4;
    }
    uniforms->light_varying = uniforms->copied_varying_count + 4;
    return uniforms->copied_varying_count + 7;
}

// Lays out the varyings of a mesh that is lit at its vertices, or not at all: texture coordinates,
// light and highlight. Returns the number of varyings.
static int lay_out_lit_vertices(DipSurfaceUniforms *uniforms, bool highlight) {
    int count = uniforms->copied_varying_count;
    if (uniforms->normal_attribute != DIP_ABSENT || uniforms->colour_attribute != DIP_ABSENT) {
        uniforms->light_varying = count;
        count += 3;
    }
    if (highlight) {
        uniforms->highlight_varying = count;
        count += 3;
    }
    return count;
}

// Whether the scene's lights light a mesh. Water and sky have the fixed light.
static bool is_lit_by_lights(const DipSceneDef *def, const DipMeshDef *mesh,
                             const DipMaterialDef *material) {
    const bool light_mapped = material->light_map != DIP_NO_TEXTURE && mesh->uv1;
    return def->lighting && dip_surface_is_solid(material->surface) && material->lit &&
           mesh->normals && !light_mapped;
}

// Returns the opacity of a surface that is drawn without its metallic-roughness description.
static float opacity_of(const DipMaterialDef *material) {
    return material->opacity * (1.0f - dip_pbr_transmission(material));
}

// Returns the uniforms that depend on the material alone. The mesh has no attributes and varyings
// yet.
static DipSurfaceUniforms uniforms_of(const DipMaterialDef *material) {
    DipSurfaceUniforms uniforms = {
        .normal_attribute = DIP_ABSENT,
        .colour_attribute = DIP_ABSENT,
        .light_varying = DIP_ABSENT,
        .colour_varying = DIP_ABSENT,
        .light_map_varying = DIP_ABSENT,
        .alpha_varying = DIP_ABSENT,
        .normal_map_varying = DIP_ABSENT,
        .normal_varying = DIP_ABSENT,
        .depth_varying = DIP_ABSENT,
        .highlight_varying = DIP_ABSENT,
        .direct_varying = DIP_ABSENT,
        .shininess = (unsigned)(material->shininess + 0.5f),
        .roughness = material->roughness,
        .light_map_scale = material->light_map_scale,
        .alpha_cutoff = material->alpha_cutoff,
        .opacity = material->surface == DIP_SURFACE_WATER ? 1.0f - material->transmission
                                                          : opacity_of(material),
        .has_alpha = material->surface != DIP_SURFACE_WATER,
    };
    memcpy(uniforms.base_colour_lin, material->base_colour_lin, sizeof uniforms.base_colour_lin);
    memcpy(uniforms.specular_lin, material->specular_lin, sizeof uniforms.specular_lin);
    return uniforms;
}

// Whether the alpha of the vertices changes the surface of a mesh.
static bool has_alphas(const DipMeshDef *mesh, const DipMaterialDef *material) {
    return mesh->alphas &&
           (material->surface == DIP_SURFACE_CLIPPED || material->surface == DIP_SURFACE_BLENDED);
}

// Adds the texture coordinates that the maps of a mesh use, and the alpha of its vertices.
static void add_copied(const DipMeshDef *mesh, const DipMaterialDef *material,
                       DipVertexLayout *layout, DipSceneMesh *out) {
    DipSurfaceUniforms *uniforms = &out->layout;
    const bool textured = material->colour_texture != DIP_NO_TEXTURE && mesh->uv0;
    const bool light_mapped = material->light_map != DIP_NO_TEXTURE && mesh->uv1;
    const bool pbr0 = out->pbr && mesh->uv0 && dip_pbr_uses_set(material, 0);
    const bool pbr1 = out->pbr && mesh->uv1 && dip_pbr_uses_set(material, 1);
    out->uv_varyings[0] = out->uv_varyings[1] = DIP_ABSENT;
    if (textured || out->normal_mapped || pbr0) {
        out->uv_varyings[0] = add_source(layout, mesh->uv0, 2) - 3;
        uniforms->colour_varying = textured ? out->uv_varyings[0] : DIP_ABSENT;
    }
    if (light_mapped || pbr1) {
        out->uv_varyings[1] = add_source(layout, mesh->uv1, 2) - 3;
        uniforms->light_map_varying = light_mapped ? out->uv_varyings[1] : DIP_ABSENT;
    }
    if (has_alphas(mesh, material)) {
        uniforms->alpha_varying = add_source(layout, mesh->alphas, 1) - 3;
    }
    uniforms->copied_varying_count = layout->attribute_count - 3;
}

DipVertexLayout dip_mesh_lay_out(const DipSceneDef *def, const DipMeshDef *mesh,
                                 DipSceneMesh *out) {
    const DipMaterialDef *material = &def->materials[mesh->material];
    const bool light_mapped = material->light_map != DIP_NO_TEXTURE && mesh->uv1;
    DipVertexLayout layout = {.count = 0};
    DipSurfaceUniforms *uniforms = &out->layout;
    *uniforms = uniforms_of(material);
    add_source(&layout, mesh->positions, 3);
    out->normal_mapped = dip_material_draws_normal_map(material) && mesh->uv0 && mesh->normals &&
                         (light_mapped || material->lit);
    out->pbr = dip_mesh_has_pbr(def, mesh);
    add_copied(mesh, material, &layout, out);
    out->sky = material->surface == DIP_SURFACE_SKY && uniforms->colour_varying != DIP_ABSENT;
    out->lit_by_lights = is_lit_by_lights(def, mesh, material);
    // Light at the vertices needs so many varyings that no room is left for their alpha.
    const bool phong = def->lighting && def->lighting->shading == DIP_SHADING_PHONG;
    out->fragments_lit = out->lit_by_lights && (phong || has_alphas(mesh, material));
    const bool lit = !light_mapped && material->lit && mesh->normals;
    int normal_attribute = DIP_ABSENT;
    if (lit || out->normal_mapped) {
        normal_attribute = add_source(&layout, mesh->normals, 3);
        uniforms->normal_attribute = lit ? normal_attribute : DIP_ABSENT;
    }
    out->normal_attribute = normal_attribute;
    if (mesh->colours_lin) {
        uniforms->colour_attribute = add_source(&layout, mesh->colours_lin, 3);
    }
    if (out->normal_mapped || out->pbr) {
        out->full_layout = out->layout;
        out->full_layout.opacity = out->pbr ? material->opacity : out->layout.opacity;
        out->full_layout.normal_map_varying = out->normal_mapped ? 0 : DIP_ABSENT;
        out->full_varying_count = lay_out_lit_fragments(&out->full_layout, normal_attribute);
    }
    out->varying_count = out->fragments_lit ? lay_out_lit_fragments(uniforms, normal_attribute)
                                            : lay_out_lit_vertices(uniforms, out->lit_by_lights);
    return layout;
}
