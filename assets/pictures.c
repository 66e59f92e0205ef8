// Finds the pictures of a model and decodes each of them once, in parallel.
#include "assets/model_parts.h"
#include "renderer/base/assert.h"

#include <assimp/scene.h>
#include <assimp/texture.h>

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// Finds an embedded picture. The path "*3" names the fourth picture. For any other path, the last
// parts of the file names are compared.
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *path) {
    if (path[0] == '*') {
        char *end = NULL;
        const unsigned long index = strtoul(path + 1, &end, 10);
        const bool usable = end != path + 1 && *end == '\0' && index < scene->mNumTextures;
        return usable ? scene->mTextures[index] : NULL;
    }
    for (unsigned i = 0; i < scene->mNumTextures; ++i) {
        const char *name = scene->mTextures[i]->mFilename.data;
        if (name[0] && strcmp(base_name(name), base_name(path)) == 0) {
            return scene->mTextures[i];
        }
    }
    return NULL;
}

static bool exists(const char *path) {
    return access(path, R_OK) == 0;
}

static void use_forward_slashes(char *path) {
    for (; *path; ++path) {
        *path = *path == '\\' ? '/' : *path;
    }
}

// Decodes the percent-encoding of glTF's addresses, such as "%20" for a space.
static void decode_percent(char *path) {
    char *to = path;
    for (const char *from = path; *from; ++to) {
        if (from[0] == '%' && isxdigit((unsigned char)from[1]) &&
            isxdigit((unsigned char)from[2])) {
            const char digits[3] = {from[1], from[2], '\0'};
            const int value = (int)strtol(digits, NULL, 16);
            *to = value ? (char)value : '%';
            from += 3;
        } else {
            *to = *from++;
        }
    }
    *to = '\0';
}

// True for a path that does not begin in the model's folder, on any system.
static bool is_absolute(const char *path) {
    return path[0] == '/' || (isalpha((unsigned char)path[0]) && path[1] == ':');
}

// The path that the model gives is tried in the model's folder. Some models contain absolute paths
// of another machine, or were moved without the folders of their pictures. So the last part of the
// path is tried, too, in the model's folder and where pictures usually lie. In BLEND files, "//" at
// the beginning stands for the model's folder. Each name is tried as written and then with
// percent-encoding decoded.
char *dip_model_find_file(const char *model_path, const char *picture_path) {
    static const char *const folders[] = {"", "textures/", "Textures/", "../textures/",
                                          "../Textures/"};
    enum { LONGEST_FOLDER = 12, FOLDERS = (int)DIP_ARRAY_COUNT(folders) };
    const int folder_length = (int)(base_name(model_path) - model_path);
    const size_t size_bytes = (size_t)folder_length + LONGEST_FOLDER + strlen(picture_path) + 1;
    char *name = strdup(picture_path);
    char *path = malloc(size_bytes);
    char *first = NULL;
    for (int attempt = 0; name && path && attempt < 2 * (1 + FOLDERS); ++attempt) {
        const int folder = attempt % (1 + FOLDERS) - 1; // -1 for the path as the model gives it
        if (attempt == 1 + FOLDERS) {
            decode_percent(name);
        } else if (attempt == 0) {
            use_forward_slashes(name);
        }
        const char *written = strncmp(name, "//", 2) == 0 ? name + 2 : name;
        const bool absolute = folder < 0 && is_absolute(written);
        snprintf(path, size_bytes, "%.*s%s%s", absolute ? 0 : folder_length, model_path,
                 folder < 0 ? "" : folders[folder], folder < 0 ? written : base_name(name));
        if (exists(path)) {
            free(name);
            free(first);
            return path;
        }
        first = first || absolute ? first : strdup(path);
    }
    free(name);
    free(path);
    return first;
}

// Finds a picture that is called like the model. Returns its path, or the last path tried if there
// is none, or NULL when memory runs out.
static char *find_like_model(const char *model_path) {
    static const char *const endings[] = {".pcx", ".png", ".bmp", ".jpg", ".tga"};
    const int stem_length = (int)(strrchr(model_path, '.') - model_path);
    char *path = malloc((size_t)stem_length + sizeof ".pcx");
    for (size_t i = 0; path && i < DIP_ARRAY_COUNT(endings); ++i) {
        snprintf(path, (size_t)stem_length + sizeof ".pcx", "%.*s%s", stem_length, model_path,
                 endings[i]);
        if (exists(path)) {
            break;
        }
    }
    return path;
}

static int find_picture(const DipModel *model, const char *name, const void *bytes) {
    for (int i = 0; i < model->picture_count; ++i) {
        const DipPictureEntry *entry = &model->pictures[i];
        const bool by_name = !bytes && !entry->bytes && name && entry->name;
        if (by_name ? strcmp(entry->name, name) == 0 : bytes && entry->bytes == bytes) {
            return i;
        }
    }
    return DIP_NOT_FOUND;
}

static int add_picture(DipModel *model, const DipPictureEntry *entry) {
    DipPictureEntry *pictures =
        dip_array_grow(model->pictures, model->picture_count, sizeof *model->pictures);
    if (!pictures) {
        return DIP_NO_TEXTURE;
    }
    model->pictures = pictures;
    pictures[model->picture_count] = *entry;
    return model->picture_count++;
}

static int embedded_picture(DipModel *model, int file, const char *path,
                            const struct aiTexture *texture) {
    const int known = find_picture(model, "", texture->pcData);
    if (known >= 0) {
        return known;
    }
    char name[sizeof(struct aiString) + 256]; // A longer path is cut.
    const char *own_name = texture->mFilename.data[0] ? texture->mFilename.data : path;
    snprintf(name, sizeof name, "%.250s:%s", model->files[file].path, own_name);
    const bool compressed = texture->mHeight == 0;
    const DipPictureEntry entry = {
        .name = dip_model_copy_text(model, name),
        .file = file,
        .bytes = (const uint8_t *)texture->pcData,
        .size_bytes = compressed ? texture->mWidth : 0,
        .raw_width = compressed ? 0 : texture->mWidth,
        .raw_height = texture->mHeight,
    };
    return entry.name ? add_picture(model, &entry) : DIP_NO_TEXTURE;
}

int dip_model_picture_bytes(DipModel *model, int file, const char *name, const uint8_t *bytes,
                            size_t size_bytes) {
    const int known = find_picture(model, "", bytes);
    if (known >= 0) {
        return known;
    }
    char text[512]; // A longer name is cut.
    snprintf(text, sizeof text, "%.250s:%.250s", model->files[file].path, name);
    dip_make_one_line(text);
    const DipPictureEntry entry = {.name = dip_model_copy_text(model, text),
                                   .file = file,
                                   .bytes = bytes,
                                   .size_bytes = size_bytes};
    const int index = entry.name ? add_picture(model, &entry) : DIP_NO_TEXTURE;
    model->lost_picture |= index < 0;
    return index;
}

static int register_file(DipModel *model, int file, const char *path) {
    const int known = find_picture(model, path, NULL);
    if (known >= 0) {
        return known;
    }
    const DipPictureEntry entry = {.name = dip_model_copy_text(model, path), .file = file};
    return entry.name ? add_picture(model, &entry) : DIP_NO_TEXTURE;
}

int dip_model_picture_beside(DipModel *model, int file, const char *path) {
    char *found = dip_model_find_file(model->files[file].path, path);
    const int index = found ? register_file(model, file, found) : DIP_NO_TEXTURE;
    free(found);
    model->lost_picture |= index < 0;
    return index;
}

// Registers the skin of an MD2 model. Skins are often named by a path in the folders of a game, or
// not at all, and lie beside the model under its name.
static int skin(DipModel *model, int file, const char *path) {
    static const char none[] = "$texture_dummy.bmp"; // assimp's name where the file has none
    const char *model_path = model->files[file].path;
    const char *model_name = base_name(model_path);
    char *found = dip_model_find_file(model_path, path);
    if (found && !exists(found)) {
        free(found);
        found = find_like_model(model_path);
    }
    int index = DIP_NO_TEXTURE;
    if (!found || exists(found)) {
        index = found ? register_file(model, file, found) : DIP_NO_TEXTURE;
        model->lost_picture |= index < 0;
    } else {
        const bool is_named = strcmp(path, none) != 0;
        dip_model_warn_of_picture(
            model, model_path,
            "%s%s%s, and there is no %.*s with the ending .pcx, .png, .bmp, .jpg or "
            ".tga, so its surfaces are drawn in their base colour",
            is_named ? "its skin " : "the file names no skin", is_named ? base_name(path) : "",
            is_named ? " is not beside the model" : "",
            (int)(strrchr(model_name, '.') - model_name), model_name);
    }
    free(found);
    return index;
}

static bool is_md2(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".md2") == 0;
}

int dip_model_picture(DipModel *model, int file, const char *path) {
    const struct aiTexture *texture = find_embedded(model->files[file].scene, path);
    if (!texture || !texture->pcData) {
        return is_md2(model->files[file].path) ? skin(model, file, path)
                                               : dip_model_picture_beside(model, file, path);
    }
    const int index = embedded_picture(model, file, path, texture);
    model->lost_picture |= index < 0;
    return index;
}

int dip_model_picture_file(DipModel *model, int file, const char *path) {
    const int index = register_file(model, file, path);
    model->lost_picture |= index < 0;
    return index;
}

static void decode(DipPictureEntry *entry) {
    if (!entry->bytes) {
        dip_picture_read_file(entry->name, &entry->picture, &entry->error);
    } else if (entry->raw_height > 0) {
        dip_picture_from_bgra(entry->bytes, entry->raw_width, entry->raw_height, entry->name,
                              &entry->picture, &entry->error);
    } else {
        dip_picture_decode(entry->bytes, entry->size_bytes, entry->name, &entry->picture,
                           &entry->error);
    }
}

// A picture to decode. Its size in bytes tells roughly how long decoding takes.
typedef struct DecodeJob {
    DipPictureEntry *entry;
    size_t size_bytes;
} DecodeJob;

static int larger_first(const void *a, const void *b) {
    const size_t x = ((const DecodeJob *)a)->size_bytes;
    const size_t y = ((const DecodeJob *)b)->size_bytes;
    return (x < y) - (x > y);
}

static size_t file_size(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && status.st_size > 0 ? (size_t)status.st_size : 0;
}

static void decode_task(void *context, int index, int worker) {
    (void)worker;
    decode(((const DecodeJob *)context)[index].entry);
}

// Decodes the largest pictures first, so that no thread starts a large picture at the end.
static bool decode_all(DipModel *model, DipPool *pool) {
    DecodeJob *jobs = malloc(((size_t)model->picture_count + 1) * sizeof *jobs);
    if (!jobs) {
        return false;
    }
    for (int i = 0; i < model->picture_count; ++i) {
        DipPictureEntry *entry = &model->pictures[i];
        jobs[i] = (DecodeJob){entry, entry->bytes ? entry->size_bytes : file_size(entry->name)};
    }
    qsort(jobs, (size_t)model->picture_count, sizeof *jobs, larger_first);
    if (pool) {
        dip_pool_run(pool, model->picture_count, decode_task, jobs);
    } else {
        for (int i = 0; i < model->picture_count; ++i) {
            decode_task(jobs, i, 0);
        }
    }
    free(jobs);
    return true;
}

// True if a file lies, or would lie, in the model's own folder.
static bool is_beside(const char *model_path, const char *path) {
    const size_t length = (size_t)(base_name(model_path) - model_path);
    return (size_t)(base_name(path) - path) == length && strncmp(path, model_path, length) == 0;
}

bool dip_model_decode_pictures(DipModel *model, DipPool *pool, DipError *err) {
    if (model->lost_picture || !decode_all(model, pool)) {
        return dip_model_out_of_memory(err, NULL);
    }
    if (!dip_model_check_light_maps(model, err)) {
        return false;
    }
    for (int i = 0; i < model->picture_count; ++i) {
        const DipPictureEntry *entry = &model->pictures[i];
        const char *path = model->files[entry->file].path;
        if (entry->error.code == DIP_ERROR_MISSING) {
            const bool beside = is_beside(path, entry->name);
            dip_model_warn_of_picture(model, path,
                                      "the picture %s is missing%s, so its surfaces are drawn in "
                                      "their base colour",
                                      beside ? base_name(entry->name) : entry->name,
                                      beside ? " beside the model" : "");
        } else if (entry->error.origin == DIP_ORIGIN_RUNTIME) {
            return dip_model_out_of_memory(err, entry->name);
        } else if (entry->error.code != DIP_ERROR_NONE) {
            dip_model_warn(model, entry->name, NULL,
                           "its surfaces are drawn in their base colour, because %s",
                           entry->error.message);
        }
    }
    return true;
}
