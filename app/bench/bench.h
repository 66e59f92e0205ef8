// `diptych bench`.
#ifndef DIP_APP_BENCH_BENCH_H
#define DIP_APP_BENCH_BENCH_H

#include "app/cli/command.h"

extern const DipCommand dip_bench_command;

#endif
