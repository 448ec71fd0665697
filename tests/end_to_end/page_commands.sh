#!/usr/bin/env bash
# Does what a page shows, as a reader would, in an empty folder where build/release is that of the
# program under test and `gnbv` is on the path. A code block with title="NAME" becomes that file;
# one without a language or of language sh is run. All in the order of the page.
# A page says in its first lines what it needs: <!-- needs: gnbv, mavsdk --> (Python modules), or
# <!-- needs: onboard --> (the program's build folder, for the C++ library).
#
# usage: page_commands.sh PAGE.md PROGRAM
# exit: 0 all commands succeeded, 1 one did not, or the page shows none, 77 something is not here
set -euo pipefail
page=$(realpath "$1")
program=$(realpath "$2")
root=$(realpath "$(dirname "$0")/../..")
build=$(dirname "$program")

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/page/build"
ln -s "$build" "$folder/page/build/release"
ln -s "$root/examples" "$folder/page/examples"
ln -s "$root/bench" "$folder/page/bench"
export PATH=$build:$PATH PYTHONDONTWRITEBYTECODE=1 GNBV_CACHE=$folder/cache
GNBV_PYTHON=${GNBV_PYTHON:-python3}
skip() { echo "page_commands: skipped: $page needs $*" >&2; exit 77; }

for need in $(sed -n 's/^<!-- needs: \(.*\) -->$/\1/p' "$page" | tr -d ,); do
  if [[ $need == onboard ]]; then
    [[ -f $build/cmake_install.cmake ]] || skip "the folder where the program was built"
    continue
  fi
  python=${GNBV_EXTRAS_PYTHON:-$root/build/extras/bin/python}
  [[ ! -x $python ]] || PATH=$(dirname "$python"):$PATH GNBV_PYTHON=$python
  export GNBV_PYTHON
  if [[ $need == gnbv* ]] && ! python3 -c 'import gnbv' 2>/dev/null; then
    compgen -G "$build/tools/python/_core*.so" >/dev/null || skip "the Python package"
    cmake --install "$build" --component python --prefix "$folder/stage" >/dev/null
    export PYTHONPATH=$folder/stage
  fi
  python3 -c "import $need" 2>/dev/null || skip "Python's $need: tools/setup --all"
done

cd "$folder/page"
awk -v end="END_OF_FILE_OF_THE_PAGE" '
  /^```/ {
    if (open) { if (file) print end; open = file = shell = 0; next }
    open = 1
    shell = $0 == "```" || $0 == "```sh"
    if (match($0, /title="[^"]+"/)) {
      file = 1
      name = substr($0, RSTART + 7, RLENGTH - 8)
      print "mkdir -p \"$(dirname " name ")\" && cat > " name " <<\047" end "\047"
    }
    next
  }
  file || shell { print }' "$page" >"$folder/commands.sh"
grep -q . "$folder/commands.sh" || { echo "$page shows no command" >&2; exit 1; }
bash -euxo pipefail "$folder/commands.sh" || exit 1
