#!/bin/sh
# Fails when a source of the app adds the counters of frames by itself and not with
# dip_counters_add (app/measure/timing/sample.h), so that a new counter is added everywhere.
#
# Usage: check_counters.sh ROOT
set -eu
cd "$1"
if ! grep -q 'dip_counters_add' app/measure/timing/sample.h; then
    echo "dip_counters_add is not in app/measure/timing/sample.h; has it moved?"
    exit 1
fi
! grep -rnE '\+= \(double\)[a-z.>-]+(->|\.)name\b' app --include='*.c' --include='*.h' |
    grep -v '^app/measure/timing/sample.h:'
