// The peer's GLSL sources and their compilation.
#include "tests/peer/gl_program.h"

#include <stdio.h>

static const char vertex_source[] =
    "in vec3 position;\n"
    "in vec2 uv0;\n"
    "in vec2 uv1;\n"
    "in vec3 normal;\n"
    "in vec3 colour_lin;\n"
    "uniform mat4 to_clip;\n"
    "uniform mat3 normal_to_world;\n"
    "out vec2 colour_uv;\n"
    "out vec2 light_uv;\n"
    "out vec3 vertex_light;\n"
    "void main() {\n"
    "    gl_Position = to_clip * vec4(position, 1.0);\n"
    "#ifdef TEXTURED\n"
    "    colour_uv = uv0;\n"
    "#endif\n"
    "#ifdef LIGHT_MAPPED\n"
    "    light_uv = uv1;\n"
    "#endif\n"
    "#if defined LIT || defined COLOURED\n"
    "    vertex_light = vec3(1.0);\n"
    "#endif\n"
    "#ifdef LIT\n"
    "    vec3 n = normalize(normal_to_world * normal);\n"
    "    vec3 sun = normalize(vec3(-0.42, 0.67, 0.61));\n"
    "    vertex_light *= 0.35 + 0.15 * n.y + 0.65 * max(0.0, dot(n, sun));\n"
    "#endif\n"
    "#ifdef COLOURED\n"
    "    vertex_light *= colour_lin;\n"
    "#endif\n"
    "}\n";

// The alpha test comes after the last texture read, since derivatives are undefined after a
// discard.
static const char fragment_source[] =
    "in vec2 colour_uv;\n"
    "in vec2 light_uv;\n"
    "in vec3 vertex_light;\n"
    "uniform sampler2D colour_texture;\n"
    "uniform sampler2D light_map;\n"
    "uniform vec3 base_colour;\n"
    "uniform float light_map_scale;\n"
    "uniform float alpha_cutoff;\n"
    "out vec4 pixel;\n"
    "void main() {\n"
    "    vec3 colour = base_colour;\n"
    "#ifdef TEXTURED\n"
    "    vec4 texel = texture(colour_texture, colour_uv);\n"
    "    colour *= texel.rgb;\n"
    "#endif\n"
    "#ifdef LIGHT_MAPPED\n"
    "    colour *= light_map_scale * texture(light_map, light_uv).rgb;\n"
    "#endif\n"
    "#if defined LIT || defined COLOURED\n"
    "    colour *= vertex_light;\n"
    "#endif\n"
    "#ifdef CLIPPED\n"
    "    if (texel.a < alpha_cutoff) {\n"
    "        discard;\n"
    "    }\n"
    "#endif\n"
    "    pixel = vec4(colour, 1.0);\n"
    "}\n";

static GLuint make_shader(const DipGl *gl, GLenum kind, const char *defines, const char *source) {
    const GLchar *parts[] = {"#version 330 core\n", defines, source};
    const GLuint shader = gl->CreateShader(kind);
    gl->ShaderSource(shader, 3, parts, NULL);
    gl->CompileShader(shader);
    return shader;
}

static void set_locations(const DipGl *gl, DipGlProgram *program) {
    program->to_clip = gl->GetUniformLocation(program->name, "to_clip");
    program->normal_to_world = gl->GetUniformLocation(program->name, "normal_to_world");
    program->base_colour = gl->GetUniformLocation(program->name, "base_colour");
    program->light_map_scale = gl->GetUniformLocation(program->name, "light_map_scale");
    program->alpha_cutoff = gl->GetUniformLocation(program->name, "alpha_cutoff");
    gl->UseProgram(program->name);
    gl->Uniform1i(gl->GetUniformLocation(program->name, "colour_texture"), DIP_GL_COLOUR_UNIT);
    gl->Uniform1i(gl->GetUniformLocation(program->name, "light_map"), DIP_GL_LIGHT_MAP_UNIT);
}

bool dip_gl_program_make(const DipGl *gl, int features, DipGlProgram *program, DipError *err) {
    char defines[160];
    snprintf(defines, sizeof defines, "%s%s%s%s%s",
             features & DIP_PEER_TEXTURED ? "#define TEXTURED\n" : "",
             features & DIP_PEER_LIGHT_MAPPED ? "#define LIGHT_MAPPED\n" : "",
             features & DIP_PEER_LIT ? "#define LIT\n" : "",
             features & DIP_PEER_COLOURED ? "#define COLOURED\n" : "",
             features & DIP_PEER_CLIPPED ? "#define CLIPPED\n" : "");
    const GLuint vertex = make_shader(gl, GL_VERTEX_SHADER, defines, vertex_source);
    const GLuint fragment = make_shader(gl, GL_FRAGMENT_SHADER, defines, fragment_source);
    program->name = gl->CreateProgram();
    gl->AttachShader(program->name, vertex);
    gl->AttachShader(program->name, fragment);
    gl->BindAttribLocation(program->name, DIP_PEER_POSITION, "position");
    gl->BindAttribLocation(program->name, DIP_PEER_UV0, "uv0");
    gl->BindAttribLocation(program->name, DIP_PEER_UV1, "uv1");
    gl->BindAttribLocation(program->name, DIP_PEER_NORMAL, "normal");
    gl->BindAttribLocation(program->name, DIP_PEER_COLOUR, "colour_lin");
    gl->LinkProgram(program->name);
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    GLint linked = GL_FALSE;
    gl->GetProgramiv(program->name, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[256] = "";
        gl->GetProgramInfoLog(program->name, sizeof log, NULL, log);
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "shader", "%s", log);
    }
    set_locations(gl, program);
    return dip_gl_check(gl, "shader", err);
}
