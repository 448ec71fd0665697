#!/usr/bin/env bash
# Runs a test that drives a Chromium ($CHROMIUM), in an empty folder.
# usage: in_browser.sh COMMAND...    exit: as the command's, 77 no Chromium or no npm, hence no page
set -euo pipefail
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) &&
  command -v npm >/dev/null || {
  echo "in_browser.sh: no Chromium or no npm: skipped" >&2
  exit 77
}
export CHROMIUM
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export GNBV_CACHE=$folder/cache
"$@"
