#!/usr/bin/env bash
# The law: tools/results prints each step's tables with the command and the commit that made them,
# flies nothing twice, leaves out what has no mesh, and refuses what it does not know.
#
# usage: results_test.sh PATH_OF_RESULTS PROGRAM
set -euo pipefail
results=$1
export GNBV=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export GNBV_CACHE=$folder/cache GNBV_SHARED_MESHES=$folder/no-meshes

failed=0
complain() { echo "FAILED: $*" >&2; failed=$((failed + 1)); }
tiny() {
  "$results" --seeds 1 --jobs 1 --threads 1 --set planner.termination.max_iterations=2 \
    --out "$folder/out" --to "$folder/to" "$@" 2>/dev/null
}
made() { find "$folder/out" -name summary.json -printf '%p %T@\n' | sort; }

printed=$(tiny --only lab_model --only a340 --only compare-powerplant-dae --only ledger-a340) ||
  complain "exit code $?"
for line in "a340: left out: no $folder/no-meshes/a340.obj" "ledger-a340: left out: no " \
  "compare-powerplant-dae: left out: no $folder/no-meshes/powerplant.dae" "in all "; do
  [[ $printed == *"$line"* ]] || complain "'$line' is not in: $printed"
done
head='gnbv table lab_model --set planner.termination.max_iterations=2 --seeds 1, commit [0-9a-f]+'
grep -qE "^<!-- $head" <(head -1 "$folder/to/lab_model.md") ||
  complain "head of lab_model.md: $(head -1 "$folder/to/lab_model.md")"
[[ $(head -1 "$folder/to/lab_model.csv") == utility,row,runs,* ]] || complain "keys do not come first"
grep -qE "^\"note: $head" "$folder/to/lab_model.csv" || complain "lab_model.csv names no command"
widths=$(sed 's/"[^"]*"//g' "$folder/to/lab_model.csv" | awk -F, '{ print NF }' | sort -u)
[[ $(wc -l <<<"$widths") == 1 ]] || complain "records of lab_model.csv have" $widths "fields"
[[ $(find "$folder/to" -type f | wc -l) == 2 ]] || complain "more than two files: $(ls -A "$folder/to")"

before=$(made)
[[ -n $before ]] || complain "nothing was flown"
cp -r "$folder/to" "$folder/first"
tiny --only lab_model >/dev/null || complain "the second call failed"
[[ $(made) == "$before" ]] || complain "the second call flew again"
diff -r "$folder/first" "$folder/to" >/dev/null || complain "the second call printed other tables"

for bad in "--only moon" "--seeds none" "--seeds" "--sedes 3"; do
  status=0
  "$results" $bad >/dev/null 2>&1 || status=$?
  [[ $status == 2 ]] || complain "$bad: exit code $status, not 2"
done
[[ $("$results" --list) == *compare-built-in* ]] || complain "--list lacks a step"
echo "$failed failures"
((failed == 0))
