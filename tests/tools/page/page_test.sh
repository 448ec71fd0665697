#!/usr/bin/env bash
# Short missions, one of a tour, some with hostile names, their reports, and a browser.
# usage: in_browser.sh page_test.sh GNBV
set -euo pipefail
gnbv=$1
here=$(cd "$(dirname "$0")" && pwd)

evil='<img src=x onerror=window.hacked=1>'
for utility in proposed tour; do
  "$gnbv" run smoke --quiet --frames --candidates --utility "$utility" --out "$evil$utility" \
    --set planner.termination.max_iterations=4 >/dev/null
done
for seed in 1 2; do  # long enough for frontiers
  "$gnbv" run smoke --quiet --frames --candidates --seed "$seed" --out "seed$seed" \
    --set planner.termination.max_iterations=6 >/dev/null
done
"$gnbv" surface "${evil}proposed" --quiet >/dev/null
# names that only files can hold
node -e '
  const fs = require("fs");
  const evil = "</script><script>window.hacked=1</script><svg onload=window.hacked=1>"
    + "x".repeat(150);
  for (const run of process.argv.slice(1)) {
    const summary = JSON.parse(fs.readFileSync(run + "/summary.json"));
    Object.assign(summary, { scenario: evil, structure: evil, utility: evil, version: evil });
    fs.writeFileSync(run + "/summary.json", JSON.stringify(summary));
    fs.appendFileSync(run + "/scenario.yaml", "# " + evil + "\n");
  }' "${evil}proposed" "${evil}tour"
"$gnbv" report "${evil}proposed" --quiet -o one.html >/dev/null
"$gnbv" report "${evil}proposed" "${evil}tour" --quiet -o two.html >/dev/null
"$gnbv" report seed1 seed2 --quiet -o seeds.html >/dev/null
cp -R seed1 again
"$gnbv" report seed1 again --quiet -o equal.html >/dev/null
# some of its views were chosen after others had been sampled in vain
"$gnbv" run lab_model --quiet --frames --candidates --out lab \
  --set planner.termination.max_iterations=7 >/dev/null
"$gnbv" report lab --quiet -o lab.html >/dev/null
layers() { node "$here/page_layers_test.mjs" "$CHROMIUM" "$@"; }
# each is of a kind that the last two lines have not
layers equal.html seed1 again --only foundIsCoverage plotsTellRunsApart
layers lab.html lab --only decisionsAreTold
"$gnbv" run smoke --quiet --frames --candidates --out bursts \
  --set planner.fvs.entropy_threshold_nat=1 --set planner.termination.max_iterations=8 \
  --set "obstacles=[{box_m: {min: [-3.9, 3.7, 0], max: [-3.7, 3.9, 0.3]}, motion: {waypoints: [{offset_m: [2, 0, 0]}], speed_m_s: 0.37}}]" >/dev/null
"$gnbv" report bursts --quiet -o bursts.html >/dev/null
layers bursts.html bursts --only decisionsAreTold bodiesMove
layers seeds.html seed1 seed2 --only foundIsCoverage decisionsAreTold plotsTellRunsApart
for test in page_test page_layers_test; do
  node "$here/$test.mjs" "$CHROMIUM" one.html "${evil}proposed"
  node "$here/$test.mjs" "$CHROMIUM" two.html "${evil}proposed" "${evil}tour"
done
