#!/usr/bin/env bash
# Bundles the page into FOLDER: bundle.js, bundle.css, page.html. Needs the network only when
# package-lock.json has changed since the last time.
# usage: bundle.sh FOLDER
# exit: 0 bundled, 1 the sources are wrong, 2 npm, the network or a package is missing
set -euo pipefail
source=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
cd "$1"

fail() { echo "tools/report/web/bundle.sh: $*" >&2; exit 2; }

command -v npm >/dev/null || fail "npm is missing, which fetches three.js, uPlot and esbuild for" \
  "the page of gnbv report: tools/setup installs it"
rm -rf src
cp -R "$source"/{package.json,package-lock.json,tsconfig.json,src} .
if ! cmp -s package-lock.json node_modules/installed-package-lock.json; then
  npm ci --no-audit --no-fund --loglevel=error >npm.log 2>&1 || {
    cat npm.log >&2
    fail "npm ci failed: it needs the network once, for the packages of the page of gnbv report" \
      "(without it: copy node_modules from another build to $PWD)"
  }
  cp package-lock.json node_modules/installed-package-lock.json
fi

node_modules/.bin/esbuild src/main.ts --bundle --minify --format=iife --target=es2022 \
  --charset=ascii --legal-comments=inline --log-level=warning --outfile=bundle.js
node_modules/.bin/esbuild src/report.css --bundle --minify --log-level=warning \
  --outfile=bundle.css
cp "$source/page.html" .
