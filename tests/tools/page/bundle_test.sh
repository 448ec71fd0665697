#!/usr/bin/env bash
# The law: without npm, or with one that fetches nothing, the report's bundle is empty and says why,
# nothing is written anew as long as that stays so, and as soon as npm is there it is bundled.
# usage: bundle_test.sh BUNDLE.sh
set -euo pipefail
bundle=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
for program in bash cat chmod cmp cp dirname env grep head mkdir node rm; do
  ln -s "$(type -P $program)" "$folder/bin"
done
web=$folder/web

fail() { echo "FAILED: $*" >&2; exit 1; }
run_bundle() { PATH=$folder/bin "$bundle" "$web" 2>"$folder/said" || fail "$(<"$folder/said")"; }
npm_is() { cat >"$folder/bin/npm"; chmod +x "$folder/bin/npm"; }
needed() { sed 's/^.*: //' "$web/bundle.d"; }  # by the bundle, as the build knows it
times() { stat -c '%n %y' "$web"/{bundle.js,bundle.css,missing.txt}; }
expect_no_bundle() {  # expect_no_bundle REASON
  [[ ! -s $web/bundle.js && ! -s $web/bundle.css ]] || fail "the bundle is not empty"
  [[ $(<"$web/missing.txt") == *$1* ]] || fail "missing.txt does not say '$1': $(<"$web/missing.txt")"
  [[ $(wc -l <"$web/missing.txt") == 1 ]] || fail "missing.txt is no line"
  grep -qF "$1" "$folder/said" || fail "not told: $1"
  [[ -n $(needed) && ! -e $(needed) ]] || fail "the next build would not try again"
}

run_bundle
expect_no_bundle "tools/setup installs it"
before=$(times)
run_bundle
[[ $(times) == "$before" ]] || fail "written anew, though nothing has changed"

npm_is <<'END'
#!/bin/bash
printf 'npm error code E\nnpm error FetchError: request to you failed, reason: nobody is there\n'
exit 1
END
run_bundle
expect_no_bundle "nobody is there"

npm_is <<'END'
#!/bin/bash
mkdir -p node_modules/.bin
cat >node_modules/.bin/esbuild <<'ESBUILD'
#!/bin/bash
for word; do [[ $word != --outfile=* ]] || echo bundled >"${word#*=}"; done
ESBUILD
chmod +x node_modules/.bin/esbuild
END
run_bundle
[[ -s $web/bundle.js && -s $web/bundle.css ]] || fail "not bundled, though npm is there"
[[ ! -s $web/missing.txt ]] || fail "something is missing: $(<"$web/missing.txt")"
[[ -e $(needed) ]] || fail "every build would bundle again"

rm "$folder/bin/npm"
run_bundle  # what it fetched is still there
[[ -s $web/bundle.js && ! -s $web/missing.txt ]] || fail "a bundle was given up without need"
