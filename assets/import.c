// Imports model files with assimp and checks the result before and after assimp's processing.
//
// assimp's processing steps trust indices and counts, so a file is imported without processing,
// checked, and only then processed. assimp's readers recurse as deep as the file nests, so they run
// on a thread with a large stack. precheck.c limits the depth.
#include "assets/model_parts.h"
#include "assets/x_references.h"
#include "renderer/base/assert.h"
#include "renderer/base/file.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

// aiProcess_JoinIdenticalVertices is left out. It merges vertices that differ only in their second
// texture coordinates, which would tear light maps. mesh.c compares all attributes instead.
static const unsigned process_flags =
    aiProcess_Triangulate | aiProcess_GenUVCoords | aiProcess_FlipUVs | aiProcess_SortByPType;

// The stack reserves address space; memory is used only as needed.
static const size_t import_stack_bytes = (size_t)256 << 20;

enum {
    MAX_NODE_DEPTH = 512, // most levels of child nodes
    MAX_LOG_WARNINGS = 8, // most warnings of assimp that are passed on per file
};

static bool has_ending(const char *path, const char *ending) {
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

// True for a file that may be a texture of a model.
static bool is_picture(const char *path) {
    static const char *const endings[] = {".png", ".jpg", ".jpeg", ".bmp", ".tga",  ".dds", ".webp",
                                          ".pcx", ".ppm", ".pgm",  ".hdr", ".ktx2", ".tif", ".gif"};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(endings); ++i) {
        if (has_ending(path, endings[i])) {
            return true;
        }
    }
    return false;
}

static bool check_extension(const char *path, DipError *err) {
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    if (is_picture(path)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, NULL,
                             "the file is a picture and no model; open the model, and its pictures "
                             "are found beside it");
    }
    return (dot && aiIsExtensionSupported(dot)) ||
           dip_error_set(
               err, DIP_ERROR_FORMAT, path, 0, NULL,
               "%s%s%s is not a supported model format, accepted .gltf, .glb, .obj, .ply, "
               ".stl, .x and others (docs/models.md)",
               dot ? "\"" : "", dot ? dot : "a name without an extension", dot ? "\"" : "");
}

bool dip_model_check_file(const char *path, DipError *err) {
    struct stat info = {0};
    // To open a named pipe would wait until another program writes to it.
    const bool is_pipe = stat(path, &info) == 0 && S_ISFIFO(info.st_mode);
    FILE *file = is_pipe ? NULL : fopen(path, "rb");
    if (!file && !is_pipe) {
        return dip_error_set(err, dip_file_open_code(errno), path, 0, NULL,
                             "cannot open the model: %s", strerror(errno));
    }
    const bool known = is_pipe || fstat(fileno(file), &info) == 0;
    if (file) {
        fclose(file);
    }
    if (known && S_ISDIR(info.st_mode)) {
        return dip_error_set(err, DIP_ERROR_IO, path, 0, NULL,
                             "the model is not a regular file but a folder; give the model file "
                             "inside the folder");
    }
    if (!known || !S_ISREG(info.st_mode)) {
        return dip_error_set(err, DIP_ERROR_IO, path, 0, NULL, "the model is not a regular file");
    }
    if (info.st_size == 0) {
        return dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL, "the model file is empty");
    }
    return check_extension(path, err);
}

static bool check_mesh(const char *path, const struct aiMesh *mesh, bool processed, DipError *err) {
    const char *name = mesh->mName.data;
    const bool triangles = processed && dip_mesh_is_triangles(mesh);
    if ((mesh->mNumVertices > 0 && !mesh->mVertices) || (mesh->mNumFaces > 0 && !mesh->mFaces)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, name, "the mesh lacks its vertices");
    }
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
        const struct aiVector3D v = mesh->mVertices[i];
        if (!isfinite(v.x) || !isfinite(v.y) || !isfinite(v.z)) {
            return dip_error_set(err, DIP_ERROR_RANGE, path, 0, name,
                                 "position of vertex %u is not finite", i);
        }
    }
    unsigned polygons = 0;
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
        const struct aiFace *face = &mesh->mFaces[f];
        polygons += face->mNumIndices > 3;
        if (face->mNumIndices == 0) {
            return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, name, "face %u has no vertices",
                                 f);
        }
        if (triangles && face->mNumIndices != 3) {
            return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, name, "face %u is not a triangle",
                                 f);
        }
        for (unsigned k = 0; k < face->mNumIndices; ++k) {
            if (face->mIndices[k] >= mesh->mNumVertices) {
                return dip_error_set(err, DIP_ERROR_RANGE, path, 0, name,
                                     "face %u uses vertex %u of %u", f, face->mIndices[k],
                                     mesh->mNumVertices);
            }
        }
    }
    // assimp ends the whole program if a mesh claims to have polygons but has none.
    if ((mesh->mPrimitiveTypes & aiPrimitiveType_POLYGON) && polygons == 0) {
        return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, name, "the mesh lacks its polygons");
    }
    return true;
}

static bool check_node(const char *path, const struct aiScene *scene, const struct aiNode *node,
                       int depth, DipError *err) {
    const char *name = node->mName.data;
    if (depth > MAX_NODE_DEPTH) {
        return dip_error_set(err, DIP_ERROR_RANGE, path, 0, name,
                             "nodes are nested more than %d deep", MAX_NODE_DEPTH);
    }
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] >= scene->mNumMeshes) {
            return dip_error_set(err, DIP_ERROR_RANGE, path, 0, name, "the node uses mesh %u of %u",
                                 node->mMeshes[i], scene->mNumMeshes);
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
        const struct aiNode *child = node->mChildren[i]; // May be NULL; see close_gaps.
        if (child && !check_node(path, scene, child, depth + 1, err)) {
            return false;
        }
    }
    return true;
}

static bool check_scene(const char *path, const struct aiScene *scene, bool processed,
                        DipError *err) {
    if (scene->mNumMeshes == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, path, 0, NULL, "the model has no triangles");
    }
    if (!scene->mRootNode || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE)) {
        return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, NULL, "the file has no scene");
    }
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        if (!check_mesh(path, scene->mMeshes[i], processed, err)) {
            return false;
        }
        if (scene->mMeshes[i]->mMaterialIndex >= scene->mNumMaterials) {
            return dip_error_set(err, DIP_ERROR_RANGE, path, 0, scene->mMeshes[i]->mName.data,
                                 "the mesh uses material %u of %u",
                                 scene->mMeshes[i]->mMaterialIndex, scene->mNumMaterials);
        }
    }
    return check_node(path, scene, scene->mRootNode, 0, err);
}

// Removes NULLs among a node's children. Some of assimp's readers (RAW) leave NULLs there, and
// assimp's processing would follow them.
static void close_gaps(struct aiNode *node) {
    unsigned kept = 0;
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
        if (node->mChildren[i]) {
            close_gaps(node->mChildren[i]);
            node->mChildren[kept++] = node->mChildren[i];
        }
    }
    node->mNumChildren = kept;
}

// Changes a checked scene so that no processing step throws an exception. After an exception
// aiApplyPostProcessing frees the scene twice, which ends the program. Steps throw for two kinds of
// scenes:
// - Scenes with a mesh without a primitive type, which has no faces (an empty solid in an STL
//   file). Such meshes are marked as points, so that the steps skip them.
// - Scenes flagged as sharing vertices between faces (files that assimp wrote). The flag is
//   removed; scenes of other formats share vertices without the flag and are processed.
static void mend_scene(const struct aiScene *checked) {
    struct aiScene *scene = (struct aiScene *)checked; // assimp allocated it writable.
    scene->mFlags &= ~(unsigned)AI_SCENE_FLAGS_NON_VERBOSE_FORMAT;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        if (scene->mMeshes[i]->mPrimitiveTypes == 0) {
            scene->mMeshes[i]->mPrimitiveTypes = aiPrimitiveType_POINT;
        }
    }
    close_gaps(scene->mRootNode);
}

static bool is_gltf(const struct aiScene *scene) {
    const struct aiMetadata *meta = scene->mMetaData;
    for (unsigned i = 0; meta && i < meta->mNumProperties; ++i) {
        if (strcmp(meta->mKeys[i].data, "SourceAsset_Format") == 0 &&
            meta->mValues[i].mType == AI_AISTRING) {
            const struct aiString *format = meta->mValues[i].mData;
            return strncmp(format->data, "glTF", 4) == 0;
        }
    }
    return false;
}

// Makes a text of assimp fit for a message.
static void tidy(char *text) {
    dip_make_one_line(text);
    for (size_t end = strlen(text); end > 0 && text[end - 1] == ' '; --end) {
        text[end - 1] = '\0';
    }
}

static bool import_error(const char *path, DipError *err) {
    char reason[200] = "";
    snprintf(reason, sizeof reason, "%s", aiGetErrorString());
    tidy(reason);
    if (strstr(reason, "bad_alloc")) {
        return dip_model_out_of_memory(err, path);
    }
    return dip_error_set(err, DIP_ERROR_FORMAT, path, 0, NULL, "the model cannot be read: %s%s",
                         reason[0] ? reason : "assimp gives no reason",
                         has_ending(path, ".blend") ? "; export glTF from Blender" : "");
}

static void count_left_out(DipModel *model, const char *path, const struct aiScene *scene) {
    unsigned left_out = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        const struct aiMesh *mesh = scene->mMeshes[i];
        left_out += dip_mesh_is_triangles(mesh) ? 0 : mesh->mNumFaces;
    }
    if (left_out > 0) {
        dip_model_warn(model, path, NULL, "%u points and lines are not drawn", left_out);
    }
}

// Collects what assimp logs while it reads a file.
typedef struct ImportLog {
    DipModel *model;
    const char *path;
    int warning_count;
    bool indices_dropped; // assimp has dropped faces whose indices are out of range
    int obj_lines;        // lines about materials that an OBJ file lacks
    bool names_no_mtl;    // it names materials, but no .mtl file
    int blend_lines;      // lines about a BLEND file
} ImportLog;

// True if an OBJ file names a .mtl file.
static bool names_mtl(const char *path) {
    FILE *file = fopen(path, "rb");
    char part[256]; // A longer line is read in parts.
    bool found = false;
    bool line_begins = true;
    while (file && !found && fgets(part, sizeof part, file)) {
        found = line_begins && strncmp(part + strspn(part, " \t"), "mtllib", 6) == 0;
        line_begins = strchr(part, '\n') != NULL;
    }
    if (file) {
        fclose(file);
    }
    return found;
}

// True for a line about a material of an OBJ file that names no .mtl file.
static bool is_about_mtl(ImportLog *log, const char *text) {
    if (!strstr(text, "OBJ: failed to locate material ")) {
        return false;
    }
    log->names_no_mtl = log->names_no_mtl || (log->obj_lines++ == 0 && !names_mtl(log->path));
    return log->names_no_mtl;
}

// The callback of aiLogStream. Lines look like "Warn,  T0: text". Only the log tells that assimp
// has dropped faces because of their indices.
static void add_log_line(const char *line, char *user) {
    ImportLog *log = (ImportLog *)(void *)user;
    const bool matters = strncmp(line, "Warn", 4) == 0 || strncmp(line, "Error", 5) == 0;
    const char *text = strstr(line, ": ");
    if (!matters || !text) {
        return;
    }
    log->indices_dropped = log->indices_dropped || strstr(text, "out-of-range indices");
    if (has_ending(log->path, ".blend")) {
        log->blend_lines++;
        return;
    }
    if (is_about_mtl(log, text)) {
        return;
    }
    char copy[200] = "";
    snprintf(copy, sizeof copy, "%s", text + 2);
    tidy(copy);
    if (log->warning_count++ < MAX_LOG_WARNINGS) {
        dip_model_warn(log->model, log->path, NULL, "%s", copy);
    }
}

// references: those of an X file. For all other files, it is empty.
static bool import_bare(DipModel *model, DipModelFile *file, const DipXReferences *references,
                        DipError *err) {
    ImportLog log = {.model = model, .path = file->path};
    const size_t warnings_before = model->warnings ? model->warnings->count : 0;
    const struct aiLogStream stream = {add_log_line, (char *)(void *)&log};
    aiAttachLogStream(&stream);
    file->scene = references->text
                      ? aiImportFileFromMemory((const char *)references->text,
                                               (unsigned)references->text_bytes, 0, "x")
                      : aiImportFile(file->path, 0);
    aiDetachLogStream(&stream);
    if (log.warning_count > MAX_LOG_WARNINGS) {
        dip_model_warn(model, file->path, NULL, "assimp gives %d more warnings, which are left out",
                       log.warning_count - MAX_LOG_WARNINGS);
    }
    if (log.names_no_mtl) {
        dip_model_warn(model, file->path, NULL,
                       "the file names no .mtl file with its materials, so its surfaces are grey");
    }
    if (log.blend_lines > 0) {
        dip_model_warn(model, file->path, NULL,
                       "only files of some old versions of Blender are read well, so parts may be "
                       "missing; export glTF from Blender");
    }
    if ((!file->scene || log.indices_dropped) && model->warnings) {
        model->warnings->count = warnings_before; // The error replaces the warnings.
    }
    if (!file->scene) {
        return import_error(file->path, err);
    }
    return !log.indices_dropped || dip_error_set(err, DIP_ERROR_RANGE, file->path, 0, NULL,
                                                 "a face uses a vertex that does not exist");
}

// Imports a file without assimp's processing.
static bool import_checked(DipModel *model, DipModelFile *file, DipError *err) {
    DipXReferences references = {0};
    const bool ok =
        (!has_ending(file->path, ".x") || dip_x_references_read(file->path, &references, err)) &&
        import_bare(model, file, &references, err) &&
        check_scene(file->path, file->scene, false, err) &&
        dip_x_references_resolve(model, file->path, &references, file->scene, err);
    dip_x_references_free(&references);
    return ok;
}

static bool import_and_check(DipModel *model, DipModelFile *file, DipError *err) {
    if (!import_checked(model, file, err)) {
        return false;
    }
    mend_scene(file->scene);
    const struct aiScene *processed = aiApplyPostProcessing(file->scene, process_flags);
    if (!processed) {
        file->scene = NULL; // assimp has freed it.
        return import_error(file->path, err);
    }
    file->scene = processed;
    file->linear_colours = is_gltf(processed);
    count_left_out(model, file->path, processed);
    return check_scene(file->path, processed, true, err);
}

typedef struct ImportTask {
    DipModel *model;
    DipModelFile *file;
    DipError *err;
    bool ok;
} ImportTask;

// Imports run one at a time, because assimp's last error and its log belong to the whole process.
static void *import_thread(void *context) {
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    ImportTask *task = context;
    pthread_mutex_lock(&mutex);
    task->ok = import_and_check(task->model, task->file, task->err);
    if (!task->ok && task->file->scene) {
        aiReleaseImport(task->file->scene);
        task->file->scene = NULL;
    }
    pthread_mutex_unlock(&mutex);
    return NULL;
}

bool dip_model_import(DipModel *model, DipModelFile *file, DipError *err) {
    if (!dip_model_check_file(file->path, err) || !dip_model_precheck(file->path, err)) {
        return false;
    }
    ImportTask task = {.model = model, .file = file, .err = err};
    pthread_attr_t attributes;
    pthread_t thread;
    if (pthread_attr_init(&attributes) != 0) {
        return dip_model_out_of_memory(err, file->path);
    }
    const bool started = pthread_attr_setstacksize(&attributes, import_stack_bytes) == 0 &&
                         pthread_create(&thread, &attributes, import_thread, &task) == 0;
    pthread_attr_destroy(&attributes);
    if (!started) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, file->path, 0, NULL,
                             "cannot start a thread to read the model");
    }
    pthread_join(thread, NULL);
    return task.ok;
}
