// The bench's output: a heading that names everything, a line per row, a file of all frames.
#ifndef DIP_TESTS_PEER_TABLE_H
#define DIP_TESTS_PEER_TABLE_H

#include "tests/peer/measure.h"
#include "tests/peer/options.h"

#include <stdbool.h>
#include <stdio.h>

// Scene, machine, threads, instruction set, the peer's name.
void dip_table_print_heading(FILE *out, const DipPeerOptions *options, const DipPeerScene *scene,
                             const DipPeer *peer);

// A line per measurement; what llvmpipe is no fair measure of stands apart below.
bool dip_table_print(FILE *out, const DipPeerMeasurement *measurements, int count, DipError *err);

// Millions of triangles a second of each, for scenes that are wholly in view.
bool dip_table_print_triangles(FILE *out, const DipPeerMeasurement *measurements, int count,
                               uint64_t triangle_count, DipError *err);

// "row,frame,round,peer_ms,ours_ms" for every frame; peer_ms is empty without a peer.
bool dip_table_write_csv(const char *file, const DipPeerMeasurement *measurements, int count,
                         DipError *err);

// The lowest PSNR among the rows whose pictures should be alike.
double dip_table_lowest_psnr_db(const DipPeerMeasurement *measurements, int count);

#endif
