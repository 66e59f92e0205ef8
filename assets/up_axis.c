// Decides which way is up in a model file, and turns the scene so that +Y is up.
//
// assimp turns 3DS, ASE, COLLADA, DXF, IFC, IQM, MD2, MD3, MD5 and MDL files itself. The rules here
// are about the files that it leaves as they are.
#include "assets/model_parts.h"

#include <assimp/camera.h>
#include <assimp/scene.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

const char *const dip_up_axis_names[DIP_UP_COUNT] = {
#define DIP_UP_NAME(name, text) #name,
    DIP_UP_AXIS_LIST(DIP_UP_NAME)
#undef DIP_UP_NAME
};

typedef DipUpAxis UpRule(const struct aiScene *scene, const char *path);

static DipUpAxis up_is_z(const struct aiScene *scene, const char *path) {
    (void)scene;
    (void)path;
    return DIP_UP_z;
}

// FBX: the global settings name the axis by its number.
static DipUpAxis up_of_fbx(const struct aiScene *scene, const char *path) {
    (void)path;
    const struct aiMetadataEntry *axis = dip_model_metadata(scene->mMetaData, "UpAxis");
    const bool is_z = axis && axis->mType == AI_INT32 && *(const int32_t *)axis->mData == 2;
    return is_z ? DIP_UP_z : DIP_UP_y;
}

// NFF: the file's viewpoint has an up vector. Without a viewpoint, z is up by custom.
static DipUpAxis up_of_nff(const struct aiScene *scene, const char *path) {
    (void)path;
    if (scene->mNumCameras == 0) {
        return DIP_UP_z;
    }
    const struct aiVector3D up = scene->mCameras[0]->mUp;
    return fabsf(up.y) > fabsf(up.z) ? DIP_UP_y : DIP_UP_z;
}

// OpenGEX: the text says `Metric (key = "up") {string {"y"}}`; the default is z.
static DipUpAxis up_of_opengex(const struct aiScene *scene, const char *path) {
    (void)scene;
    char text[4096]; // Metrics stand at the file's beginning.
    FILE *file = fopen(path, "rb");
    if (!file) {
        return DIP_UP_z;
    }
    const size_t count = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[count] = '\0';
    const char *key = strstr(text, "\"up\"");
    const char *value = key ? strchr(key + strlen("\"up\""), '"') : NULL;
    return value && tolower((unsigned char)value[1]) == 'y' ? DIP_UP_y : DIP_UP_z;
}

// The formats whose files are not y-up, or say themselves which way is up.
static const struct {
    const char *ending;
    UpRule *rule;
} rules[] = {
    {".3mf", up_is_z},        {".amf", up_is_z},   {".blend", up_is_z}, {".cob", up_is_z},
    {".enff", up_of_nff},     {".fbx", up_of_fbx}, {".hmp", up_is_z},   {".nff", up_of_nff},
    {".ogex", up_of_opengex}, {".scn", up_is_z},   {".smd", up_is_z},   {".stl", up_is_z},
};

static DipUpAxis up_of(const struct aiScene *scene, const char *path) {
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof rules / sizeof rules[0]; ++i) {
        if (strcasecmp(dot, rules[i].ending) == 0) {
            return rules[i].rule(scene, path);
        }
    }
    return DIP_UP_y;
}

void dip_model_up_transform(const DipModel *model, const DipModelFile *file, double world[12]) {
    static const double as_read[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    static const double z_to_y[12] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};
    const DipUpAxis up = model->up == DIP_UP_auto ? up_of(file->scene, file->path) : model->up;
    memcpy(world, up == DIP_UP_z ? z_to_y : as_read, sizeof as_read);
}
