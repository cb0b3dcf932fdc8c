#!/usr/bin/env bash
# Pictures of the built page in target/screenshots, without compiling anything that is already there.
#
#   scripts/screenshots.sh                      the newest of `make dev` and `make build`, in the usual sizes
#   scripts/screenshots.sh state.json           loads a scenario first
#   NAME=sweep CLICK=Sweep scripts/screenshots.sh          clicks what is labelled so first (a,b,c: in turn)
#   DROP=measured.csv scripts/screenshots.sh    drops a file on the page first
#   SIZES="1440x900-dark 360x760-light" SETTLE_MS=2000 scripts/screenshots.sh
#   DIST=dist scripts/screenshots.sh            that build and no other
set -euo pipefail
cd "$(dirname "$0")/.."

tool=target/browser-test
newest="$(find tests/browser -name '*.rs' -newer "$tool" -print -quit 2>/dev/null || true)"
if [ ! -x "$tool" ] || [ -n "$newest" ]; then
  built="$(cargo test --quiet --test browser --no-run --message-format=json |
    sed -n 's/.*"name":"browser".*"executable":"\([^"]*\)".*/\1/p' | tail -n 1)"
  # Another run may still be using the old one.
  cp "$built" "$tool.new"
  mv "$tool.new" "$tool"
fi

dist="${DIST:-}"
if [ -z "$dist" ]; then
  dist="$(ls -td target/page-dev-dist/index.html dist/index.html 2>/dev/null | head -n 1 || true)"
  dist="${dist%/index.html}"
fi
[ -n "$dist" ] || { echo "no page yet: make dev, or make build" >&2; exit 1; }
echo "page: $dist"

[ -z "${1:-}" ] || export HARVESTER_LOAD="$1"
[ -z "${DROP:-}" ] || export HARVESTER_DROP="$DROP"
[ -z "${CLICK:-}" ] || export HARVESTER_CLICK="$CLICK"
[ -z "${NAME:-}" ] || export HARVESTER_NAME="$NAME"
[ -z "${SIZES:-}" ] || export HARVESTER_SIZES="$SIZES"
[ -z "${SETTLE_MS:-}" ] || export HARVESTER_SETTLE_MS="$SETTLE_MS"
HARVESTER_DIST="$dist" "$tool" --ignored --exact screenshots --nocapture
