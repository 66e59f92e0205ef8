// What a pixel of a converged picture shows.
#ifndef DIP_RENDERER_REFERENCE_SEEN_H
#define DIP_RENDERER_REFERENCE_SEEN_H

// The classes of pixels. A pixel belongs to the first class whose condition is true.
// X(NAME, "name", "condition")
#define DIP_SEEN_LIST(X)                                                                           \
    X(WATER, "reflection", "a sample sees water")                                                  \
    X(CLIPPED, "clipped",                                                                          \
      "an alpha-clipped surface is nearest at a sample, even if alpha clips it away there")        \
    X(EDGE, "edges",                                                                               \
      "samples see two materials, or triangles whose planes do not meet within the pixel")         \
    X(TEXTURED, "interior", "one surface with a colour texture, not the sky")                      \
    X(PLAIN, "plain", "one surface without a texture, the sky, or nothing")

typedef enum DipSeen {
#define DIP_SEEN_ENUM(NAME, name, text) DIP_SEEN_##NAME,
    DIP_SEEN_LIST(DIP_SEEN_ENUM)
#undef DIP_SEEN_ENUM
        DIP_SEEN_COUNT
} DipSeen;

#endif
