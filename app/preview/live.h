// A thread that judges the panes' pictures while the camera rests. It runs when nothing else wants
// the processor, and drops what it does between steps of a few milliseconds.
#ifndef DIP_APP_PREVIEW_LIVE_H
#define DIP_APP_PREVIEW_LIVE_H

#include "app/preview/judge.h"

typedef struct DipLive DipLive;

// The scene is borrowed. The thread starts, and takes memory, with the first shot.
DipLive *dip_live_create(const DipSceneDef *scene, const DipReflectionDef *reflection,
                         DipError *err);

// Ends the thread; waits for no more than the step it is in.
void dip_live_destroy(DipLive **live);

// Judges a shot from now on; its pictures are copied. Does nothing when the pictures are those of
// the last one, by the caller's count.
void dip_live_show(DipLive *live, const DipJudgeShot *shot, unsigned picture_number);

// The camera moves: what is known is forgotten, and nothing is done.
void dip_live_rest(DipLive *live);

typedef enum DipLiveStatus {
    DIP_LIVE_RESTING,
    DIP_LIVE_WORKING,
    DIP_LIVE_DONE,  // the result gets no better
    DIP_LIVE_FAILED // for want of memory, or of a thread
} DipLiveStatus;

typedef struct DipLiveReading {
    DipLiveStatus status;
    DipJudgeResult result;
} DipLiveReading;

// What is known of the last shot. Returns whether it is something new since the last reading.
bool dip_live_read(DipLive *live, DipLiveReading *reading);

#endif
