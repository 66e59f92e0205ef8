// The output of the peer bench: a heading that says what was measured, a line per row (combination
// of settings), and a CSV file with the times of all frames.
#ifndef DIP_TESTS_PEER_TABLE_H
#define DIP_TESTS_PEER_TABLE_H

#include "tests/peer/measure.h"
#include "tests/peer/options.h"

#include <stdbool.h>
#include <stdio.h>

// Prints the scene, the machine, the threads, the instruction set and the peer's name.
void dip_table_print_heading(FILE *out, const DipPeerOptions *options, const DipPeerScene *scene,
                             const DipPeer *peer);

// Prints a line per measurement. Rows in which llvmpipe has extremely slow frames come last.
bool dip_table_print(FILE *out, const DipPeerMeasurement *measurements, int count, DipError *err);

// Prints how many million triangles per second each row draws. This is meaningful only for scenes
// whose triangles are all in view.
bool dip_table_print_triangles(FILE *out, const DipPeerMeasurement *measurements, int count,
                               uint64_t triangle_count, DipError *err);

// Writes "row,frame,round,peer_ms,ours_ms" for every frame. peer_ms is empty in rows that the peer
// cannot draw.
bool dip_table_write_csv(const char *file, const DipPeerMeasurement *measurements, int count,
                         DipError *err);

// Appends a line per row that the peer can draw to the file, whose columns are separated by tabs:
// the label of --append, scene, triangles, size, row, median ms of the peer and of ours, ratio, the
// ends of its 95 % interval, PSNR, peer, commit, instruction set, threads, processor.
bool dip_table_append(const char *file, const DipPeerOptions *options, const DipPeerScene *scene,
                      const DipPeer *peer, const DipPeerMeasurement *measurements, int count,
                      DipError *err);

// Returns the lowest PSNR of the rows whose pictures should be alike.
double dip_table_lowest_psnr_db(const DipPeerMeasurement *measurements, int count);

#endif
