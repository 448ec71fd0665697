#!/usr/bin/env bash
# Installs the library and builds on it, as somebody else would: examples/onboard and the project
# beside this script. The installed folder has been moved, as a package may be.
# usage: build.sh CMAKE BUILD_FOLDER OUT
set -euo pipefail
cmake=$1 build=$2 out=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$out"
for component in program dev; do
  "$cmake" --install "$build" --component $component --prefix "$out/first" >/dev/null
done
mv "$out/first" "$out/installed"
example=$out/installed/share/doc/gnbv/examples/onboard
build() {  # build SOURCE FOLDER OPTIONS...
  "$cmake" -S "$1" -B "$2" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$out/installed" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra" "${@:3}"
  "$cmake" --build "$2"
}
build "$example" "$out/example"
build "$here" "$out/own" -DEXAMPLE="$example"
