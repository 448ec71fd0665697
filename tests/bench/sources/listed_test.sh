#!/usr/bin/env bash
# The list of sources behind a source id is what the compiler read: no more, no less.
#
# usage: listed_test.sh NINJA ROOT BUILD LIST FOLDER...
#   LIST     a path a line, relative to ROOT
#   FOLDER   of the libraries that the id is of, relative to ROOT
# Everything in ROOT that an object of these folders depends on has to be listed: by the compiler's
# own account, by the files that it embeds, or by the rule that generates its source. Every source in
# the list (headers apart) has to be such a dependency. Recipes (CMakeLists.txt of each folder and
# those above) have to be listed, too.
set -euo pipefail
ninja=$1 root=$2 build=$3 list=$4
shift 4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$build"

"$ninja" -t deps | FOLDERS="$*" awk -v OBJECTS="$work/objects" '
BEGIN { count = split(ENVIRON["FOLDERS"], folder, " ") }
/^[^ ]/ {
  is_ours = 0
  for (i = 1; i <= count; i++)
    if (index($0, folder[i] "/CMakeFiles/") == 1) { is_ours = 1; built[folder[i]] = 1 }
  if (is_ours) { sub(/: #deps.*/, ""); print >OBJECTS }
}
/^    / && is_ours { print substr($0, 5) }
END {
  for (i = 1; i <= count; i++)
    if (!(folder[i] in built)) { print folder[i] ": nothing of it is built" >"/dev/stderr"; exit 1 }
}' | sort -u >"$work/read"
# what is embedded
xargs -d '\n' "$ninja" -t query <"$work/objects" | sed -n 's/^    | //p' >>"$work/read"
# what a generated source is made of, but for the ids, which are made of the lists themselves
xargs -d '\n' realpath -m -- <"$work/read" >"$work/paths"
{ grep "^$build/.*\.cpp$" "$work/paths" | grep -v '_source_id\.cpp$' || true; } | while read -r generated; do
  "$ninja" -t inputs "${generated#"$build/"}"
done | { xargs -r -d '\n' realpath -m --; } >>"$work/paths"
sed -n "s|^$root/||p" "$work/paths" | grep -v "^${build#"$root/"}/" >"$work/needed"
cp "$work/needed" "$work/made_of"
for folder; do
  while [[ $folder != . ]]; do
    echo "$folder/CMakeLists.txt"
    folder=$(dirname "$folder")
  done
done >>"$work/needed"
echo CMakeLists.txt >>"$work/needed"

status=0
missing=$(LC_ALL=C comm -23 <(LC_ALL=C sort -u "$work/needed") <(LC_ALL=C sort -u "$list"))
if [[ $missing ]]; then
  echo "$list lacks what results are made by:"$'\n'"$missing"
  status=1
fi
surplus=$(LC_ALL=C comm -13 <(LC_ALL=C sort -u "$work/made_of") \
  <(grep -E '\.(cpp|yaml|py|obj|mtl)$' "$list" | LC_ALL=C sort -u))
if [[ $surplus ]]; then
  echo "$list holds what no result is made by (or what is not built yet):"$'\n'"$surplus"
  status=1
fi
exit $status
