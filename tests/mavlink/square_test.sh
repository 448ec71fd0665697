#!/usr/bin/env bash
# The square against a vehicle of its own, on a port that the system finds free.
# usage: square_test.sh GNBV FOLDER     FOLDER holds square.mjs and the node_modules (install.sh)
set -euo pipefail
gnbv=$1
cd "$2"

log=$(mktemp) summary=$(mktemp)
"$gnbv" fly smoke --mavlink udp://127.0.0.1:0 --speed 2 --duration 600 --json >"$summary" 2>"$log" &
vehicle=$!
trap 'kill "$vehicle" 2>/dev/null || true; rm -f "$log" "$summary"' EXIT

url=
for ((i = 0; i < 300 && ${#url} == 0; ++i)); do
  url=$(sed -n 's/^gnbv: listening on \(udp:[^,]*\),.*/\1/p' "$log")
  kill -0 "$vehicle" 2>/dev/null || break
  sleep 0.1
done
[[ -n $url ]] || { echo "gnbv fly did not come up:" >&2; cat "$log" >&2; exit 1; }

node square.mjs "$url" || { cat "$log" >&2; exit 1; }
kill -TERM "$vehicle"
wait "$vehicle" || { echo "gnbv fly ended with $?:" >&2; cat "$log" "$summary" >&2; exit 1; }
cat "$summary"
# a client on the loopback loses nothing and sends nothing bad
node -e 'const s = JSON.parse(require("fs").readFileSync(0));
  const dropped = Object.entries(s.dropped).filter(([, count]) => count > 0);
  if (dropped.length || s.refused_setpoints || s.ignored || !s.setpoints || s.commands < 3) {
    console.error("counters:", JSON.stringify(s)); process.exit(1);
  }' <"$summary"
