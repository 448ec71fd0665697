#!/usr/bin/env bash
# Installs the client's packages into FOLDER, where its sources are copied to; needs the network
# only when package-lock.json has changed since.
# usage: install.sh FOLDER
set -euo pipefail
cd "$1"
cmp -s package-lock.json node_modules/installed-package-lock.json && exit 0
npm ci --no-audit --no-fund
cp package-lock.json node_modules/installed-package-lock.json
