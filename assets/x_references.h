// References to materials in X files (DirectX). Private to assets/.
//
// A mesh of an X file lists its materials. Each entry of this list is either a material or the name
// of one that stands elsewhere in the file. assimp 5.2 and older take the wrong material for such a
// name, and no version of assimp reads materials that stand inside a frame. So assimp is given a
// text in which a material of its own stands for each name, and these materials are replaced in the
// imported scene by those that are meant.
#ifndef DIP_ASSETS_X_REFERENCES_H
#define DIP_ASSETS_X_REFERENCES_H

#include "assets/model_parts.h"

#include <stdbool.h>
#include <stddef.h>

enum { DIP_X_HEADER_BYTES = 16 };

// A part of the file's bytes.
typedef struct DipXSpan {
    const unsigned char *begin;
    const unsigned char *end;
} DipXSpan;

// A named material that stands neither at the top of the file nor in a mesh's list of materials.
typedef struct DipXBlock {
    DipXSpan name;
    DipXSpan whole; // from the word "Material" to the closing brace
} DipXBlock;

// An entry in a mesh's list of materials that only names a material.
typedef struct DipXReference {
    DipXSpan name;
    const unsigned char *brace; // the opening brace before the name
    bool missing;               // the imported scene has no material of this name
} DipXReference;

typedef struct DipXReferences {
    unsigned char *bytes; // the whole file
    size_t size_bytes;
    bool compressed; // the file is compressed, so it was not searched
    bool binary;
    unsigned float_bytes; // size of a number in a binary file
    DipXReference *items; // in the order of the file
    int count;
    DipXSpan *readable; // names of the materials that assimp reads
    int readable_count;
    DipXBlock *blocks; // other named materials, in the order of the file
    int block_count;
    unsigned char *text; // what assimp reads instead of the file, or NULL if it reads the file
    size_t text_bytes;
} DipXReferences;

// x_scan.c: finds references and materials in references->bytes. A file that ends too early has
// none. Returns false when memory runs out.
bool dip_x_scan(DipXReferences *references);

// x_references.c: reads a file, and makes the text that assimp reads instead of it if it has
// references. Afterwards, dip_x_references_free must be called, even after a failure.
bool dip_x_references_read(const char *path, DipXReferences *references, DipError *err);

// x_references.c: gives the meshes of a scene imported from this text the materials that they name.
// Warns of names that no material has. Fails when memory runs out.
bool dip_x_references_resolve(DipModel *model, const char *path, DipXReferences *references,
                              const struct aiScene *scene, DipError *err);

void dip_x_references_free(DipXReferences *references);

#endif
