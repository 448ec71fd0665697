#!/usr/bin/env bash
# A mission with hostile browsers beside it, a page that grows, and what its server refuses.
# usage: live_test.sh GNBV      exit: 0 as it should be, 1 not, 77 no Chromium or no npm
set -euo pipefail
gnbv=$1
here=$(cd "$(dirname "$0")" && pwd)
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "live_test.sh: no Chromium: skipped" >&2
  exit 77
}
command -v npm >/dev/null || {
  echo "live_test.sh: no npm, hence no page: skipped" >&2
  exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
node "$here/live_test.mjs" "$gnbv" "$chromium"
