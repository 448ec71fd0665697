#!/usr/bin/env bash
# Bundles the page into FOLDER: bundle.js, bundle.css. Needs npm and the network only when
# package-lock.json has changed since the last time. Without them the bundle is empty, missing.txt
# says why, and bundle.d, which names what the bundle depends on, has the next build try again.
# usage: bundle.sh FOLDER
# exit: 0 bundled, or empty and missing.txt says why; 1 the sources are wrong
set -euo pipefail
source=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
cd "$1"

without() {  # without REASON: of one line
  echo "tools/web/bundle.sh: gnbv is built without the page of gnbv report: $1" >&2
  # untouched when it is so already, so that nothing is compiled again
  cmp -s - missing.txt <<<"$1" || echo "$1" >missing.txt
  for part in bundle.js bundle.css; do
    [[ -e $part && ! -s $part ]] || : >"$part"
  done
  # never there: the next build asks again
  echo "$PWD/missing.txt: $PWD/npm" >bundle.d
  exit 0
}

rm -rf src
cp -R "$source"/{package.json,package-lock.json,tsconfig.json,src} .
if ! cmp -s package-lock.json node_modules/installed-package-lock.json; then
  command -v npm >/dev/null || without "npm is missing (tools/setup installs it)"
  retries=2
  [[ ! -s missing.txt ]] || retries=0  # where there is no network, builds do not wait for one
  npm ci --no-audit --no-fund --prefer-offline --loglevel=error --fetch-retries=$retries \
    --fetch-timeout=30000 >npm.log 2>&1 ||
    without "npm could not fetch three.js and esbuild into $PWD/node_modules: $(
      grep -m 1 -o 'request to .*reason:.*' npm.log || head -n 1 npm.log)"
  cp package-lock.json node_modules/installed-package-lock.json
fi

node "$source/types.mjs" "$source/../page/page_data.hpp" >src/data.ts
node_modules/.bin/esbuild src/main.ts --bundle --minify --format=iife --target=es2022 \
  --charset=ascii --legal-comments=inline --log-level=warning --outfile=bundle.js
node_modules/.bin/esbuild src/report.css --bundle --minify --log-level=warning \
  --outfile=bundle.css
: >missing.txt
echo "$PWD/missing.txt: $source/bundle.sh" >bundle.d  # Ninja takes an empty one for a missing one
