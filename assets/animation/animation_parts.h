// The animated model while it is loaded and posed. Private to assets/.
//
// The readers of MD2 (animation_md2.c) and glTF (gltf/animated_model.c) fill the model,
// animation_pose.c evaluates it.
#ifndef DIP_ASSETS_ANIMATION_ANIMATION_PARTS_H
#define DIP_ASSETS_ANIMATION_ANIMATION_PARTS_H

#include "assets/animation.h"
#include "assets/model_parts.h"
#include "renderer/scene/rig.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// What an object needs for its pose.
typedef struct DipObjectPlan {
    int node;
    int skin; // Index of a skin, or DIP_NO_SKIN.
} DipObjectPlan;

// What an animation needs for its evaluation: frames (MD2) or tracks (glTF).
typedef struct DipAnimationPlan {
    int first_frame;
    int frame_count;
    const DipTrack *tracks;
    int track_count;
} DipAnimationPlan;

struct DipAnimatedModel {
    DipModel *store; // Owns all memory and collects the warnings.
    const char *path;
    const struct DipImporter *importer; // Used only during the load.
    bool shapes_only;                   // Pictures are not read.
    size_t allocated_bytes;
    size_t most_bytes; // The limit of allocated_bytes.
    bool too_large;    // An allocation would have exceeded the limit.
    DipAnimatedDef def;
    DipPicture *pictures; // One for each texture.
    DipTextureDef *textures;
    DipMaterialDef *materials;
    DipAnimatedMesh *meshes;
    DipAnimatedObject *objects;
    DipObjectPlan *plans; // One for each object.
    DipAnimation *animations;
    DipAnimationPlan *animation_plans;
    DipKeyFrame *key_frames;
    DipRigNode *nodes; // A node comes after its parent.
    int node_count;
    float *rest_weights; // The morph weights of all nodes at rest.
    int weight_count;
    DipRigSkin *skins;
    int skin_count;
};

// animation.c: makes an empty model, which dip_animated_model_destroy destroys. Returns NULL if
// memory runs out.
DipAnimatedModel *dip_animated_model_make(const char *path);

// animation.c: the rig of the model's nodes.
DipRig dip_animated_rig(const DipAnimatedModel *model);

// animation.c: allocates zeroed memory that lives as long as the model. Returns NULL if memory runs
// out or the model becomes too large; dip_animated_no_room then fills *err and returns false.
void *dip_animated_alloc(DipAnimatedModel *model, size_t count, size_t item_bytes);
bool dip_animated_no_room(const DipAnimatedModel *model, DipError *err);

// animation.c: copies a text of at most `length` bytes and replaces control characters.
const char *dip_animated_text(DipAnimatedModel *model, const char *text, size_t length);

// animation.c: reads a picture file that the model names, or decodes the bytes of a picture inside
// the model, and adds it as a texture. *texture becomes its index, or DIP_NO_TEXTURE after a
// warning. model->textures and model->pictures have room. Returns false if memory runs out.
bool dip_animated_add_picture_file(DipAnimatedModel *model, const char *picture_path, int *texture,
                                   DipError *err);
bool dip_animated_add_picture(DipAnimatedModel *model, const uint8_t *bytes, size_t size_bytes,
                              const char *name, int *texture, DipError *err);

// animation.c: a white, opaque, double-sided material without textures.
DipMaterialDef dip_animated_material(const char *name);

// animation_md2.c: fills the model's arrays and counts, and leaves a part of them if it fails.
bool dip_animated_read_md2(DipAnimatedModel *model, DipError *err);

// animation_md2.c: reads everything but the material, so no picture. *skin becomes the name of the
// picture, or an empty text.
bool dip_md2_read(DipAnimatedModel *model, const char **skin, DipError *err);

// md2_normals.c: writes the unit vector that an MD2 file calls by this number, with z up. index:
// 0..DIP_MD2_NORMAL_COUNT - 1.
enum { DIP_MD2_NORMAL_COUNT = 162 };
void dip_md2_normal(int index, double normal[3]);

#endif
