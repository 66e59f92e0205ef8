// Uploads and draws a scene description.
#include "tests/peer/gl_scene.h"

#include "tests/peer/gl_texture.h"
#include "tests/peer/matrices.h"
#include "tests/peer/surfaces.h"

#include <stdlib.h>

// --- meshes ------------------------------------------------------------------------------------

static bool upload_mesh(const DipGl *gl, const DipMeshDef *def, DipGlMesh *mesh, DipError *err) {
    const DipPeerLayout layout = dip_peer_layout(def, mesh->features);
    const size_t stride_bytes = (size_t)layout.stride * sizeof(float);
    float *rows = dip_peer_interleave(def, &layout, err);
    if (!rows) {
        return false;
    }
    GLuint buffers[2];
    gl->GenBuffers(2, buffers);
    gl->GenVertexArrays(1, &mesh->vertex_array);
    gl->BindVertexArray(mesh->vertex_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(stride_bytes * def->vertex_count), rows,
                   GL_STATIC_DRAW);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(def->index_count * sizeof(uint32_t)),
                   def->indices, GL_STATIC_DRAW);
    const char *offset = NULL;
    for (int i = 0; i < layout.count; i++) {
        const DipPeerAttribute *attribute = &layout.attributes[i];
        gl->EnableVertexAttribArray(attribute->location);
        gl->VertexAttribPointer(attribute->location, attribute->size, GL_FLOAT, GL_FALSE,
                                (GLsizei)stride_bytes, offset);
        offset += (size_t)attribute->size * sizeof *rows;
    }
    free(rows);
    return dip_gl_check(gl, def->name, err);
}

static bool make_mesh(const DipGl *gl, DipGlScene *scene, int index, DipError *err) {
    const DipMeshDef *def = &scene->def->meshes[index];
    DipGlMesh *mesh = &scene->meshes[index];
    mesh->features = dip_peer_features(def, &scene->def->materials[def->material]);
    mesh->material = def->material;
    mesh->index_count = (GLsizei)def->index_count;
    dip_peer_bounds(def, mesh->min, mesh->max);
    DipGlProgram *program = &scene->programs[mesh->features];
    return (program->name || dip_gl_program_make(gl, mesh->features, program, err)) &&
           upload_mesh(gl, def, mesh, err);
}

// --- textures ----------------------------------------------------------------------------------

static bool make_texture(const DipGl *gl, DipGlScene *scene, int index, DipError *err) {
    return index == DIP_NO_TEXTURE || scene->textures[index] ||
           dip_gl_texture_make(gl, &scene->def->textures[index], &scene->textures[index], err);
}

static bool make_textures(const DipGl *gl, DipGlScene *scene, DipError *err) {
    for (int i = 0; i < scene->def->material_count; i++) {
        const DipMaterialDef *material = &scene->def->materials[i];
        if (!make_texture(gl, scene, material->colour_texture, err) ||
            !make_texture(gl, scene, material->light_map, err)) {
            return false;
        }
    }
    return true;
}

static void make_samplers(const DipGl *gl, DipGlSamplers *samplers) {
    static const GLint modes[] = {
        [DIP_WRAP_REPEAT] = GL_REPEAT, [DIP_WRAP_CLAMP] = GL_CLAMP_TO_EDGE};
    for (int u = 0; u < 2; u++) {
        for (int v = 0; v < 2; v++) {
            const GLuint *name = &samplers->name[u][v];
            gl->GenSamplers(1, &samplers->name[u][v]);
            gl->SamplerParameteri(*name, GL_TEXTURE_WRAP_S, modes[u]);
            gl->SamplerParameteri(*name, GL_TEXTURE_WRAP_T, modes[v]);
            gl->SamplerParameteri(*name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
            gl->SamplerParameteri(*name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        }
    }
}

void dip_gl_scene_set_anisotropy(const DipGl *gl, const DipGlScene *scene, int max_anisotropy) {
    for (int i = 0; i < 4; i++) {
        gl->SamplerParameterf(scene->colour.name[i / 2][i % 2], DIP_GL_TEXTURE_MAX_ANISOTROPY,
                              (float)max_anisotropy);
    }
}

// --- the scene ---------------------------------------------------------------------------------

bool dip_gl_scene_make(const DipGl *gl, const DipSceneDef *def, DipGlScene *scene, DipError *err) {
    *scene = (DipGlScene){.def = def};
    scene->meshes = calloc((size_t)def->mesh_count + 1, sizeof *scene->meshes);
    scene->textures = calloc((size_t)def->texture_count + 1, sizeof *scene->textures);
    bool made = scene->meshes && scene->textures;
    if (!made) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "out of memory");
    }
    make_samplers(gl, &scene->colour);
    make_samplers(gl, &scene->light_map);
    made = made && make_textures(gl, scene, err);
    for (int i = 0; made && i < def->mesh_count; i++) {
        made = make_mesh(gl, scene, i, err);
    }
    if (!made) {
        dip_gl_scene_free(scene);
    }
    return made;
}

void dip_gl_scene_free(DipGlScene *scene) {
    free(scene->meshes);
    free(scene->textures);
    *scene = (DipGlScene){.def = NULL};
}

// --- a frame -----------------------------------------------------------------------------------

static void bind_texture(const DipGl *gl, const DipGlScene *scene, GLuint unit, int texture,
                         const DipGlSamplers *samplers) {
    const DipTextureDef *def = &scene->def->textures[texture];
    gl->ActiveTexture(GL_TEXTURE0 + unit);
    gl->BindTexture(GL_TEXTURE_2D, scene->textures[texture]);
    gl->BindSampler(unit, samplers->name[def->wrap_u][def->wrap_v]);
}

static void bind_material(const DipGl *gl, const DipGlScene *scene, const DipGlMesh *mesh) {
    const DipMaterialDef *material = &scene->def->materials[mesh->material];
    const DipGlProgram *program = &scene->programs[mesh->features];
    gl->UseProgram(program->name);
    gl->Uniform3fv(program->base_colour, 1, material->base_colour_lin);
    gl->Uniform1f(program->light_map_scale, material->light_map_scale);
    gl->Uniform1f(program->alpha_cutoff, material->alpha_cutoff);
    if (mesh->features & DIP_PEER_TEXTURED) {
        bind_texture(gl, scene, DIP_GL_COLOUR_UNIT, material->colour_texture, &scene->colour);
    }
    if (mesh->features & DIP_PEER_LIGHT_MAPPED) {
        bind_texture(gl, scene, DIP_GL_LIGHT_MAP_UNIT, material->light_map, &scene->light_map);
    }
    if (material->double_sided) {
        gl->Disable(GL_CULL_FACE);
    } else {
        gl->Enable(GL_CULL_FACE);
    }
}

static void draw_object(const DipGl *gl, const DipGlScene *scene, const DipObjectDef *object,
                        const double world_to_clip[16]) {
    const DipGlMesh *mesh = &scene->meshes[object->mesh];
    float to_clip[16];
    dip_peer_place(world_to_clip, object->transform, to_clip);
    if (!mesh->index_count || !dip_peer_box_visible(to_clip, mesh->min, mesh->max)) {
        return;
    }
    float normal_to_world[9];
    const bool mirrors = dip_peer_normal_matrix(object->transform, normal_to_world);
    const DipGlProgram *program = &scene->programs[mesh->features];
    bind_material(gl, scene, mesh);
    gl->FrontFace(mirrors ? GL_CW : GL_CCW);
    gl->UniformMatrix4fv(program->to_clip, 1, GL_TRUE, to_clip);
    gl->UniformMatrix3fv(program->normal_to_world, 1, GL_TRUE, normal_to_world);
    gl->BindVertexArray(mesh->vertex_array);
    gl->DrawElements(GL_TRIANGLES, mesh->index_count, GL_UNSIGNED_INT, NULL);
}

void dip_gl_scene_draw(const DipGl *gl, const DipGlScene *scene, const DipPose *pose,
                       double aspect) {
    double world_to_clip[16];
    dip_peer_world_to_clip(pose, aspect, (double)scene->def->near_m, world_to_clip);
    for (int i = 0; i < scene->def->object_count; i++) {
        draw_object(gl, scene, &scene->def->objects[i], world_to_clip);
    }
}
