#!/usr/bin/env bash
# Utilities and planners in Python files fly, are recorded so that the runs repeat from their
# records, are compared with others, and end the run in order when they fail.
# usage: user_utility_test.sh GNBV       exit: 77 where python3 has no NumPy
set -euo pipefail
gnbv=$1
"${GNBV_PYTHON:-python3}" -c 'import numpy' 2>/dev/null || { echo "skipped: python3 has no NumPy" >&2; exit 77; }
work=$(mktemp -d "${TMPDIR:-/tmp}/gnbv-utility.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "user_utility_test: $*" >&2; exit 1; }
short=(--quiet --set planner.termination.max_iterations=5)
hash_of() { grep -o '"result_sha256": "[0-9a-f]*"' "$1/summary.json"; }
# expect STATUS TEXT COMMAND...: its exit code, and what its stderr holds
expect() {
  local status=0
  "${@:3}" >/dev/null 2>said || status=$?
  [[ $status == "$1" ]] && grep -qF -- "$2" said || fail "${*:3}: exit $status (expected $1 and '$2'), said: $(cat said)"
}

cat >mine.py <<'END'
def other(views):
    return views["path_m"]

def mine(views):  # "quotes", a back\slash, Umläute
    return views["unknown_voxels"] / (1.0 + views["path_m"])
END
expect 2 "mine.py: defines several functions (other, mine): name one" "$gnbv" run smoke --utility mine.py --out none
"$gnbv" run smoke "${short[@]}" --utility mine.py:mine --out first >/dev/null
grep -q '"utility": "mine"' first/summary.json || fail "the function that was named is not the one that flew"
cmp mine.py first/utility.py
grep -q "\"utility_source_sha256\": \"$(sha256sum <mine.py | cut -d' ' -f1)\"" first/summary.json || fail "hash"
rm mine.py
"$gnbv" run first/scenario.yaml --quiet --threads 1 --out again >/dev/null
[[ $(hash_of first) == "$(hash_of again)" ]] || fail "the record does not repeat the run"

printf 'calls = []\ndef late(views):\n    calls.append(1)\n    return views["path_m"] * (1 if len(calls) < 3 else float("nan"))\n' >late.py
expect 1 "utility late: iteration 3, candidate" "$gnbv" run smoke "${short[@]}" --utility late.py:late --out late
grep -q '"termination": "utility_failed"' late/summary.json || fail "termination"
[[ $(wc -l <late/iterations.csv) == 4 ]] || fail "the record is not complete up to there"
expect 2 "defines no function 'none'" "$gnbv" run smoke --utility late.py:none --out none
expect 2 "GNBV_PYTHON names another" env GNBV_PYTHON=/nowhere "$gnbv" run smoke --utility late.py --out none
[[ ! -e none ]] || fail "something was written before the utility was known to run"

# a planner: asked view after view, flown again and resumed as any other, and a row like any other
cat >plan.py <<'END'
def plan(belief, history):
    views = belief.valid(belief.sample())
    return View(*views[len(history) * 7 % len(views)])
END
"$gnbv" run smoke "${short[@]}" --utility plan.py --out planned >/dev/null
"$gnbv" run planned/scenario.yaml --quiet --threads 1 --out planned-again >/dev/null
[[ $(hash_of planned) == "$(hash_of planned-again)" ]] || fail "the record does not repeat the planner's run"
expect 2 "--views views.csv: goes with --utility route" "$gnbv" run smoke --utility plan.py --views views.csv --out none
cp -r planned cut
rm cut/summary.json
head -n 4 cut/iterations.csv >cut/iterations.csv.part && rm cut/iterations.csv
"$gnbv" run smoke "${short[@]}" --utility plan.py --out cut --resume >/dev/null
[[ $(hash_of planned) == "$(hash_of cut)" ]] || fail "the resumed planner's run is another"
"$gnbv" compare smoke "${short[@]}" --utilities proposed,first/utility.py:other,walk=plan.py --seeds 2 --no-ceiling --out cells --format csv >compared.csv
for method in proposed other walk; do
  [[ $(grep -c "^smoke,coverage at 0.05 m (%),$method,2," compared.csv) == 1 ]] || fail "no row of two seeds of $method in $(cat compared.csv)"
done

# a function that never returns ends with the program that asks it, however that ends
printf 'def endless(views):\n    import os\n    with open("pid.part", "w") as file:\n        file.write(str(os.getpid()))\n    os.rename("pid.part", "pid")\n    while True:\n        pass\n' >endless.py
"$gnbv" run smoke "${short[@]}" --utility endless.py --out endless &
asking=$!
for _ in {1..600}; do [[ -e pid ]] && break; sleep 0.1; done
asked=$(cat pid || true)
kill -KILL "$asking"
[[ $asked ]] || fail "the endless function was not asked"
# who has ended may stay as a zombie until the first process, which need not care, waits for it
runs() { [[ $(sed 's/.*) \(.\).*/\1/' "/proc/$asked/stat" 2>/dev/null) == [^ZX] ]]; }
for _ in {1..100}; do runs || break; sleep 0.1; done
if runs; then kill -KILL "$asked"; fail "its Python goes on without it"; fi
