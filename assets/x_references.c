// Makes a text of an X file in which no mesh names its materials by reference, and finds the
// materials that are meant in the scene that assimp imports from this text.
//
// In the text, "{ Name }" becomes "Material \1N { grey }", where N counts the references. The
// control character keeps these placeholders apart from the file's own materials. Materials that
// meshes name and that assimp does not read where they stand are moved to the end of the text. Line
// breaks stay, so that assimp's messages name the right line.
#include "assets/x_references.h"
#include "renderer/base/file.h"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_FILE_BYTES = 1 << 30,
    MAX_TEXT_BYTES = INT_MAX,
    MAX_MISSING = 8, // most missing materials that are named in warnings
    MATERIAL_FLOATS = 11,
};

static const char placeholder = '\1';

// --- names ---------------------------------------------------------------------------------------

static int compare_spans(DipXSpan a, DipXSpan b) {
    const size_t length_a = (size_t)(a.end - a.begin);
    const size_t length_b = (size_t)(b.end - b.begin);
    const size_t shared = length_a < length_b ? length_a : length_b;
    const int order = shared > 0 ? memcmp(a.begin, b.begin, shared) : 0;
    return order ? order : (length_a > length_b) - (length_a < length_b);
}

// --- the text that assimp reads ------------------------------------------------------------------

// Collects bytes, or only counts them where `to` is NULL.
typedef struct Writer {
    unsigned char *to;
    size_t count;
} Writer;

static void put(Writer *writer, const void *bytes, size_t size_bytes) {
    if (writer->to) {
        memcpy(writer->to + writer->count, bytes, size_bytes);
    }
    writer->count += size_bytes;
}

static void put_span(Writer *writer, const unsigned char *begin, const unsigned char *end) {
    put(writer, begin, (size_t)(end - begin));
}

static void put_number(Writer *writer, uint32_t number, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i) {
        const unsigned char byte = (unsigned char)(number >> (8 * i));
        put(writer, &byte, 1);
    }
}

static void put_name(Writer *writer, bool binary, const char *name) {
    if (binary) {
        put_number(writer, 1, 2);
        put_number(writer, (uint32_t)strlen(name), 4);
    }
    put(writer, name, strlen(name));
    put(writer, " ", binary ? 0 : 1);
}

// Writes the content of a grey material: colour with alpha, exponent, highlight and emission.
static void put_grey(Writer *writer, const DipXReferences *references) {
    static const char text[] = "0.6;0.6;0.6;1.0;;0.0;0.0;0.0;0.0;;0.0;0.0;0.0;;";
    static const float values[MATERIAL_FLOATS] = {0.6f, 0.6f, 0.6f, 1.0f};
    if (!references->binary) {
        put(writer, text, sizeof text - 1);
        return;
    }
    put_number(writer, 7, 2);
    put_number(writer, MATERIAL_FLOATS, 4);
    for (int i = 0; i < MATERIAL_FLOATS; ++i) {
        const double wide = (double)values[i];
        put(writer, references->float_bytes == 8 ? (const void *)&wide : &values[i],
            references->float_bytes);
    }
}

// Writes the placeholder of a reference up to its name, and returns where the file goes on.
static const unsigned char *put_placeholder(Writer *writer, const DipXReferences *references,
                                            int index, const unsigned char *from) {
    const DipXReference *reference = &references->items[index];
    // In a binary file, the token of the name begins with its number and its length.
    const size_t head = references->binary ? 6 : 0;
    char name[24];
    snprintf(name, sizeof name, "%c%d", placeholder, index);
    put_span(writer, from, reference->brace);
    put_name(writer, references->binary, "Material");
    put_name(writer, references->binary, name);
    put_span(writer, reference->brace, reference->name.begin - head);
    put_grey(writer, references);
    return reference->name.end;
}

static void put_line_breaks(Writer *writer, DipXSpan span) {
    for (const unsigned char *at = span.begin; at < span.end; ++at) {
        put(writer, at, *at == '\n' || *at == '\r' ? 1 : 0);
    }
}

static void write_text(Writer *writer, const DipXReferences *references) {
    const DipXBlock *moved = references->blocks;
    const int moved_count = references->block_count;
    const unsigned char *from = references->bytes;
    int block = 0;
    for (int i = 0; i <= references->count; ++i) {
        const bool last = i == references->count;
        while (block < moved_count &&
               (last || moved[block].whole.begin < references->items[i].brace)) {
            put_span(writer, from, moved[block].whole.begin);
            from = moved[block].whole.end;
            if (!references->binary) {
                put_line_breaks(writer, moved[block].whole);
            }
            block++;
        }
        if (!last) {
            from = put_placeholder(writer, references, i, from);
        }
    }
    put_span(writer, from, references->bytes + references->size_bytes);
    for (int i = 0; i < moved_count; ++i) {
        put(writer, "\n", references->binary ? 0 : 1);
        put_span(writer, moved[i].whole.begin, moved[i].whole.end);
    }
}

// A name that meshes refer to.
typedef struct Wanted {
    DipXSpan name;
    bool taken; // its material is found
} Wanted;

static int compare_wanted(const void *a, const void *b) {
    return compare_spans(((const Wanted *)a)->name, ((const Wanted *)b)->name);
}

// Lists the names that meshes refer to, sorted, each once. Returns NULL when memory runs out.
static Wanted *list_wanted(const DipXReferences *references, size_t *count) {
    Wanted *wanted = calloc((size_t)references->count, sizeof *wanted);
    *count = 0;
    if (!wanted) {
        return NULL;
    }
    for (int i = 0; i < references->count; ++i) {
        wanted[i].name = references->items[i].name;
    }
    qsort(wanted, (size_t)references->count, sizeof *wanted, compare_wanted);
    for (int i = 0; i < references->count; ++i) {
        if (*count == 0 || compare_wanted(&wanted[*count - 1], &wanted[i]) != 0) {
            wanted[(*count)++] = wanted[i];
        }
    }
    return wanted;
}

// Returns true if a mesh refers to this name and no material has been found for it before.
static bool take(Wanted *wanted, size_t count, DipXSpan name) {
    const Wanted key = {.name = name};
    Wanted *found = bsearch(&key, wanted, count, sizeof *wanted, compare_wanted);
    const bool first = found && !found->taken;
    if (found) {
        found->taken = true;
    }
    return first;
}

// Keeps only those blocks that must move, because a mesh names them and assimp reads no material of
// this name. Of blocks with the same name the first is kept. Returns false when memory runs out.
static bool choose_moved(DipXReferences *references) {
    size_t count;
    Wanted *wanted = list_wanted(references, &count);
    if (!wanted) {
        return false;
    }
    for (int i = 0; i < references->readable_count; ++i) {
        take(wanted, count, references->readable[i]);
    }
    int kept = 0;
    for (int i = 0; i < references->block_count; ++i) {
        if (take(wanted, count, references->blocks[i].name)) {
            references->blocks[kept++] = references->blocks[i];
        }
    }
    references->block_count = kept;
    free(wanted);
    return true;
}

static bool make_text(const char *path, DipXReferences *references, DipError *err) {
    Writer writer = {.to = NULL};
    if (!choose_moved(references)) {
        return dip_model_out_of_memory(err, path);
    }
    write_text(&writer, references);
    if (writer.count > MAX_TEXT_BYTES) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, path, 0, NULL,
                             "the meshes of the file name materials %d times, which is too often",
                             references->count);
    }
    references->text_bytes = writer.count;
    references->text = malloc(writer.count);
    if (!references->text) {
        return dip_model_out_of_memory(err, path);
    }
    writer = (Writer){.to = references->text};
    write_text(&writer, references);
    return true;
}

// Reads the header, for example "xof 0303txt 0032". Returns false if the file is no X file, or one
// that assimp refuses.
static bool read_header(DipXReferences *references) {
    const char *header = (const char *)references->bytes;
    if (references->size_bytes < DIP_X_HEADER_BYTES || memcmp(header, "xof ", 4) != 0) {
        return false;
    }
    const char *kind = header + 8;
    references->compressed = memcmp(kind, "tzip", 4) == 0 || memcmp(kind, "bzip", 4) == 0;
    references->binary = memcmp(kind, "bin ", 4) == 0;
    references->float_bytes = memcmp(header + 12, "0064", 4) == 0 ? 8 : 4;
    return references->compressed || references->binary || memcmp(kind, "txt ", 4) == 0;
}

bool dip_x_references_read(const char *path, DipXReferences *references, DipError *err) {
    *references = (DipXReferences){0};
    if (!dip_file_read(path, "model", MAX_FILE_BYTES, &references->bytes, &references->size_bytes,
                       err)) {
        return false;
    }
    const bool searched = read_header(references) && !references->compressed;
    if (searched && !dip_x_scan(references)) {
        return dip_model_out_of_memory(err, path);
    }
    if (references->count == 0) {
        free(references->bytes); // assimp reads the file itself.
        references->bytes = NULL;
    }
    return references->count == 0 || make_text(path, references, err);
}

void dip_x_references_free(DipXReferences *references) {
    free(references->bytes);
    free(references->items);
    free(references->readable);
    free(references->blocks);
    free(references->text);
    *references = (DipXReferences){0};
}

// --- the imported scene --------------------------------------------------------------------------

// A material of the imported scene.
typedef struct SceneName {
    DipXSpan name;
    unsigned material;
} SceneName;

static int compare_scene_names(const void *a, const void *b) {
    const SceneName *x = a;
    const SceneName *y = b;
    const int order = compare_spans(x->name, y->name);
    return order ? order : (x->material > y->material) - (x->material < y->material);
}

static struct aiMaterialProperty *name_property(const struct aiMaterial *material) {
    const struct aiMaterialProperty *property = NULL;
    aiGetMaterialProperty(material, AI_MATKEY_NAME, &property);
    // A text is 4 bytes with its length, the characters and a zero.
    return property && property->mType == aiPTI_String && property->mDataLength >= 5
               ? (struct aiMaterialProperty *)property // assimp allocated it writable.
               : NULL;
}

static DipXSpan name_of(const struct aiMaterial *material) {
    const struct aiMaterialProperty *property = name_property(material);
    const unsigned char *data = property ? (const unsigned char *)property->mData : NULL;
    return property ? (DipXSpan){data + 4, data + property->mDataLength - 1}
                    : (DipXSpan){NULL, NULL};
}

// Returns the reference that a name of a material stands for, or NULL.
static DipXReference *placeholder_of(const DipXReferences *references, DipXSpan name) {
    if (name.begin == name.end || *name.begin != (unsigned char)placeholder) {
        return NULL;
    }
    const unsigned long index = strtoul((const char *)name.begin + 1, NULL, 10);
    return index < (unsigned long)references->count ? &references->items[index] : NULL;
}

// Lists the scene's materials by name, without the placeholders. Returns NULL when memory runs out.
static SceneName *list_scene(const DipXReferences *references, const struct aiScene *scene,
                             size_t *count) {
    SceneName *names = calloc((size_t)scene->mNumMaterials + 1, sizeof *names);
    *count = 0;
    for (unsigned i = 0; names && i < scene->mNumMaterials; ++i) {
        const DipXSpan name = name_of(scene->mMaterials[i]);
        if (name.begin != name.end && !placeholder_of(references, name)) {
            names[(*count)++] = (SceneName){.name = name, .material = i};
        }
    }
    if (names) {
        qsort(names, *count, sizeof *names, compare_scene_names);
    }
    return names;
}

// Returns the first material of this name, or NULL.
static const SceneName *find_name(const SceneName *names, size_t count, DipXSpan name) {
    size_t low = 0;
    size_t high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (compare_spans(names[middle].name, name) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < count && compare_spans(names[low].name, name) == 0 ? &names[low] : NULL;
}

// Takes the names away from the placeholders. Those that stay in use are grey materials without a
// name.
static void clear_names(const DipXReferences *references, const struct aiScene *scene) {
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
        if (placeholder_of(references, name_of(scene->mMaterials[i]))) {
            struct aiMaterialProperty *property = name_property(scene->mMaterials[i]);
            property->mDataLength = 5;
            memset(property->mData, 0, 5);
        }
    }
}

// Warns of the names that no material has, each once.
static void warn_of_missing(DipModel *model, const char *path, const DipXReferences *references) {
    DipXSpan named[MAX_MISSING];
    int count = 0;
    int left_out = 0;
    for (int i = 0; i < references->count; ++i) {
        const DipXReference *reference = &references->items[i];
        bool seen = !reference->missing;
        for (int k = 0; !seen && k < count; ++k) {
            seen = compare_spans(named[k], reference->name) == 0;
        }
        if (!seen && count == MAX_MISSING) {
            left_out++;
        } else if (!seen) {
            named[count++] = reference->name;
            const size_t length = (size_t)(reference->name.end - reference->name.begin);
            dip_model_warn(model, path, NULL,
                           "a mesh names the material \"%.*s\", which the file does not have, so "
                           "its surface is grey",
                           (int)(length < 80 ? length : 80), (const char *)reference->name.begin);
        }
    }
    if (left_out > 0) {
        dip_model_warn(model, path, NULL, "%d more references to missing materials are grey",
                       left_out);
    }
}

bool dip_x_references_resolve(DipModel *model, const char *path, DipXReferences *references,
                              const struct aiScene *scene, DipError *err) {
    const bool resolves_names = // assimp does it right from version 5.3 on
        aiGetVersionMajor() > 5 || (aiGetVersionMajor() == 5 && aiGetVersionMinor() >= 3);
    if (references->compressed && !resolves_names && scene->mNumMaterials > 1) {
        dip_model_warn(
            model, path, NULL,
            "the file is compressed: if its meshes name materials by reference, they may be "
            "drawn with the wrong ones; save the file as text");
    }
    if (references->count == 0) {
        return true;
    }
    size_t count;
    SceneName *names = list_scene(references, scene, &count);
    if (!names) {
        return dip_model_out_of_memory(err, path);
    }
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        struct aiMesh *mesh = scene->mMeshes[i];
        DipXReference *reference =
            placeholder_of(references, name_of(scene->mMaterials[mesh->mMaterialIndex]));
        const SceneName *found = reference ? find_name(names, count, reference->name) : NULL;
        if (found) {
            mesh->mMaterialIndex = found->material;
        } else if (reference) {
            reference->missing = true;
        }
    }
    free(names);
    clear_names(references, scene);
    warn_of_missing(model, path, references);
    return true;
}
