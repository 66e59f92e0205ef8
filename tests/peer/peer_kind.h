// What a kind of peer provides. Each API has its own kind.
#ifndef DIP_TESTS_PEER_PEER_KIND_H
#define DIP_TESTS_PEER_PEER_KIND_H

#include "tests/peer/peer.h"

// The functions behind those of peer.h with the same names.
typedef struct DipPeerKind {
    DipPeer *(*create)(const DipPeerDef *def, DipError *err);
    void (*destroy)(DipPeer *peer);
    const char *(*renderer)(const DipPeer *peer);
    const char *(*version)(const DipPeer *peer);
    bool (*set)(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err);
    void (*draw)(DipPeer *peer, const DipPose *pose);
    bool (*read)(DipPeer *peer, uint8_t *rgba8, DipError *err);
} DipPeerKind;

// The first member of every kind's peer.
struct DipPeer {
    const DipPeerKind *kind;
};

extern const DipPeerKind dip_peer_kind_gl;
extern const DipPeerKind dip_peer_kind_vulkan;

#endif
