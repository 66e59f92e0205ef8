// The commands. Each returns false with *err filled when it failed while running.
#ifndef DIP_APP_COMMANDS_H
#define DIP_APP_COMMANDS_H

#include "app/options.h"
#include "app/session.h"

// Draws frames and writes what the options ask for. Standard output: the hash lines alone.
bool dip_dump_run(DipSession *session, const DipOptions *options, DipError *err);

// Measures frames and prints the tables; see bench/.
bool dip_bench_run(DipSession *session, const DipOptions *options, DipError *err);

// Measures what settings cost and writes the report; see cost/.
bool dip_cost_run(DipSession *session, const DipOptions *options, DipError *err);

// Joins parts of a report; errors of their files are bad input.
bool dip_cost_merge_run(const DipOptions *options, DipError *err);

// Prints what forms of the assets weigh, and how long they take to load. Closes the session.
bool dip_cost_assets_run(DipSession *session, const DipOptions *options, DipError *err);

// path info, path convert. Errors of the files are bad input.
bool dip_path_info_run(const DipOptions *options, DipError *err);
bool dip_path_convert_run(const DipOptions *options, DipError *err);

#endif
