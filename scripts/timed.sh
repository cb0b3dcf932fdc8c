#!/usr/bin/env bash
# timed.sh NAME COMMAND...: runs the command and says how long it took.
name="$1"
shift
echo "== $name"
began=$SECONDS
"$@"
status=$?
echo "== $name: $((SECONDS - began)) s"
exit $status
