// Draws the scenes of draw states by llvmpipe. The shaders compute what those of states_ours.c do.
#include "tests/peer/states_theirs.h"

#include <stdint.h>

static const char *const vertex_source = "#version 330 core\n"
                                         "in vec3 position;\n"
                                         "in vec3 normal;\n"
                                         "uniform mat4 to_clip;\n"
                                         "uniform mat4 to_light;\n"
                                         "uniform vec3 place;\n"
                                         "out vec3 turned;\n"
                                         "out vec3 in_light;\n"
                                         "void main() {\n"
                                         "    vec4 p = vec4(position + place, 1.0);\n"
                                         "    gl_Position = to_clip * p;\n"
                                         "    turned = normal;\n"
                                         "    in_light = (to_light * p).xyz;\n"
                                         "}\n";

static const char *const flat_source = "#version 330 core\n"
                                       "uniform vec4 colour;\n"
                                       "out vec4 pixel;\n"
                                       "void main() {\n"
                                       "    pixel = colour;\n"
                                       "}\n";

static const char *const lit_source =
    "#version 330 core\n"
    "uniform vec4 colour;\n"
    "uniform vec3 light;\n"
    "in vec3 turned;\n"
    "out vec4 pixel;\n"
    "void main() {\n"
    "    pixel = vec4(colour.rgb * (0.15 + 0.85 * max(dot(turned, light), 0.0)), 1.0);\n"
    "}\n";

static const char *const shadow_source =
    "#version 330 core\n"
    "uniform vec4 colour;\n"
    "uniform vec3 light;\n"
    "uniform sampler2DShadow map;\n"
    "in vec3 turned;\n"
    "in vec3 in_light;\n"
    "out vec4 pixel;\n"
    "void main() {\n"
    "    vec3 at = vec3(0.5 + 0.5 * in_light.x, 0.5 - 0.5 * in_light.y, in_light.z);\n"
    "    float amount = max(dot(turned, light), 0.0) * texture(map, at);\n"
    "    pixel = vec4(colour.rgb * (0.15 + 0.85 * amount), 1.0);\n"
    "}\n";

static GLuint make_shader(const DipGl *gl, GLenum kind, const char *source) {
    const GLuint shader = gl->CreateShader(kind);
    gl->ShaderSource(shader, 1, &source, NULL);
    gl->CompileShader(shader);
    return shader;
}

static GLuint make_program(const DipGl *gl, const char *fragment_source) {
    const GLuint program = gl->CreateProgram();
    gl->AttachShader(program, make_shader(gl, GL_VERTEX_SHADER, vertex_source));
    gl->AttachShader(program, make_shader(gl, GL_FRAGMENT_SHADER, fragment_source));
    gl->BindAttribLocation(program, 0, "position");
    gl->BindAttribLocation(program, 1, "normal");
    gl->LinkProgram(program);
    return program;
}

static void make_meshes(DipStatesTheirs *theirs) {
    const DipGl *gl = theirs->gl;
    for (int i = 0; i < theirs->data->shape_count; i++) {
        const DipShape *shape = &theirs->data->shapes[i];
        const GLsizei stride = (GLsizei)sizeof(float) * shape->attribute_count;
        GLuint buffers[2];
        gl->GenVertexArrays(1, &theirs->arrays[i]);
        gl->BindVertexArray(theirs->arrays[i]);
        gl->GenBuffers(2, buffers);
        gl->BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)stride * (GLsizeiptr)shape->vertex_count,
                       shape->attributes, GL_STATIC_DRAW);
        gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        gl->BufferData(GL_ELEMENT_ARRAY_BUFFER,
                       (GLsizeiptr)(shape->index_count * sizeof *shape->indices), shape->indices,
                       GL_STATIC_DRAW);
        for (GLuint a = 0; a < 2; a++) {
            gl->EnableVertexAttribArray(a);
            gl->VertexAttribPointer(a, 3, GL_FLOAT, GL_FALSE, stride,
                                    (const void *)(uintptr_t)(3 * a * sizeof(float)));
        }
    }
}

static void make_map(DipStatesTheirs *theirs) {
    const DipGl *gl = theirs->gl;
    gl->GenTextures(1, &theirs->map_texture);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, theirs->map_texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, DIP_STATES_MAP, DIP_STATES_MAP, 0,
                   GL_DEPTH_COMPONENT, GL_FLOAT, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    gl->GenFramebuffers(1, &theirs->map_framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, theirs->map_framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                             theirs->map_texture, 0);
    gl->DrawBuffer(GL_NONE);
}

bool dip_states_theirs_open(DipStatesTheirs *theirs, const DipGl *gl, const DipStatesData *data,
                            int width, int height, int sample_count, DipError *err) {
    *theirs = (DipStatesTheirs){.gl = gl, .data = data};
    theirs->program = make_program(gl, data->kind == DIP_STATES_BLEND    ? flat_source
                                       : data->kind == DIP_STATES_SHADOW ? shadow_source
                                                                         : lit_source);
    theirs->map_program = make_program(gl, flat_source);
    make_meshes(theirs);
    if (data->kind == DIP_STATES_SHADOW) {
        make_map(theirs);
    }
    return dip_gl_target_make(gl, width, height, sample_count, &theirs->target, err) &&
           dip_gl_check(gl, "states", err);
}

static void draw_parts(const DipStatesTheirs *theirs, GLuint program, const float *to_clip) {
    const DipGl *gl = theirs->gl;
    const DipStatesData *data = theirs->data;
    gl->UseProgram(program);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "to_clip"), 1, GL_TRUE, to_clip);
    gl->UniformMatrix4fv(gl->GetUniformLocation(program, "to_light"), 1, GL_TRUE, data->to_light);
    gl->Uniform3fv(gl->GetUniformLocation(program, "light"), 1, data->light);
    const GLint place = gl->GetUniformLocation(program, "place");
    const GLint colour = gl->GetUniformLocation(program, "colour");
    for (int i = 0; i < data->part_count; i++) {
        static const GLenum factors[4][2] = {{GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA},
                                             {GL_SRC_ALPHA, GL_ONE},
                                             {GL_ZERO, GL_SRC_COLOR},
                                             {GL_DST_COLOR, GL_SRC_COLOR}};
        const DipStatesPart *part = &data->parts[i];
        if (data->kind == DIP_STATES_BLEND) {
            gl->Enable(GL_BLEND);
            gl->BlendFuncSeparate(factors[part->mode][0], factors[part->mode][1], GL_ONE, GL_ZERO);
        }
        gl->BindVertexArray(theirs->arrays[part->shape]);
        gl->Uniform3fv(place, 1, part->place);
        gl->Uniform4fv(colour, 1, part->colour);
        gl->DrawElements(GL_TRIANGLES, (GLsizei)data->shapes[part->shape].index_count,
                         GL_UNSIGNED_INT, NULL);
    }
    gl->Disable(GL_BLEND);
}

void dip_states_theirs_draw(const DipStatesTheirs *theirs) {
    const DipGl *gl = theirs->gl;
    static const float clear[3] = {0.25f, 0.25f, 0.25f};
    gl->Enable(GL_CULL_FACE);
    if (theirs->map_framebuffer) {
        gl->BindFramebuffer(GL_FRAMEBUFFER, theirs->map_framebuffer);
        gl->Viewport(0, 0, DIP_STATES_MAP, DIP_STATES_MAP);
        gl->ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        gl->Enable(GL_DEPTH_TEST);
        gl->DepthFunc(GL_GREATER);
        gl->ClearDepth(0.0);
        gl->Clear(GL_DEPTH_BUFFER_BIT);
        gl->CullFace(GL_FRONT);
        draw_parts(theirs, theirs->map_program, theirs->data->to_light);
    }
    gl->CullFace(GL_BACK);
    dip_gl_target_begin(gl, &theirs->target, clear);
    draw_parts(theirs, theirs->program, theirs->data->to_clip);
    dip_gl_target_finish(gl, &theirs->target);
}
