#!/usr/bin/env bash
# What `cmake --install` lays down works wherever it is moved to, finds its modules there, and says
# in one line when one of them is of another version.
# usage: install_test.sh CMAKE BUILD_FOLDER VERSION
set -euo pipefail
cmake=$1 build=$2 version=$3
work=$(mktemp -d "${TMPDIR:-/tmp}/gnbv-install.XXXXXX")
trap 'rm -rf "$work"' EXIT
fail() { echo "install_test: $*" >&2; exit 1; }

"$cmake" --install "$build" --component program --prefix "$work/first" >/dev/null
mv "$work/first" "$work/moved here"
gnbv="$work/moved here/bin/gnbv"
cd "$work"
for file in man/man1/gnbv-run.1 bash-completion/completions/gnbv zsh/vendor-completions/_gnbv \
  fish/vendor_completions.d/gnbv.fish doc/gnbv/docs/start.md; do
  [[ -s "moved here/share/$file" ]] || fail "no share/$file"
done
if command -v dpkg-query >/dev/null; then
  zcat "moved here/share/doc/gnbv/third-party.txt.gz" >third-party.txt
  others=$(sed '/^====/Q' third-party.txt)
  for name in embree bullet eigen3 nlohmann-json3 pcl; do  # linked, compiled in, loaded
    grep -q "^  $name " <<<"$others" || fail "third-party.txt does not list $name"
  done
  ! grep -q '^  googletest ' <<<"$others" || fail "third-party.txt lists what only tests use"
fi
[[ $("$gnbv" --version) == "$version" ]] || fail "gnbv --version is not $version"

LD_DEBUG=files LD_DEBUG_OUTPUT=$work/loaded "$gnbv" run smoke --quiet --frames --out run >/dev/null
LD_DEBUG=files LD_DEBUG_OUTPUT=$work/loaded "$gnbv" surface --quiet run >/dev/null
for module in symmetry poisson; do
  grep -q "calling init: .*/moved here/.*/libgnbv_$module.so" "$work"/loaded.* ||
    fail "libgnbv_$module.so was not loaded from the installed folder"
done
"$gnbv" report run -o page.html >/dev/null 2>&1
[[ -s page.html ]] || fail "no page"

module="$work/moved here/lib/gnbv/libgnbv_poisson.so"
sed "s/${version//./\\.}/9.9.9/" "$module" >"$work/other" && cp "$work/other" "$module"
status=0
"$gnbv" surface --quiet run -o again >/dev/null 2>"$work/said" || status=$?
[[ $status == 2 && $(wc -l <"$work/said") == 1 ]] ||
  fail "a module of another version: exit $status, said: $(cat "$work/said")"
grep -q "libgnbv_poisson.so is of version 9.9.9, the program of $version" "$work/said" ||
  fail "a module of another version: said: $(cat "$work/said")"
