#!/bin/sh
# timed.sh FILE COMMAND...: runs the command, and writes the processor time of it and its children to the file.
file=$1
shift
"$@"
status=$?
times >"$file"
exit $status
