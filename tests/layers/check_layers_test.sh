#!/usr/bin/env bash
# The law: tools/check_layers refuses every kind of forbidden include, naming file, line and
# include, and nothing that is allowed. The cases below fill two trees laid out like the repository,
# one line of a file each; the check reads each tree once.
#
# usage: tests/layers/check_layers_test.sh PATH_OF_CHECK_LAYERS
set -euo pipefail

check=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root"/{allowed,forbidden,empty,roomless/tools/attic,circle/planner/{core,map,view}}
declare -A lines=()     # how many a file of the forbidden tree has
declare -A expected=()  # "file:line" -> the include to be named there

allowed() {  # allowed FILE LINE
  mkdir -p "$root/allowed/$(dirname "$1")"
  echo "$2" >>"$root/allowed/$1"
}

forbidden() {  # forbidden FILE LINE
  mkdir -p "$root/forbidden/$(dirname "$1")"
  echo "$2" >>"$root/forbidden/$1"
  lines[$1]=$((${lines[$1]:-0} + 1))
  local include=${2#*include}
  include=${include// /}
  expected[$1:${lines[$1]}]=${include//[\"<>]/}
}

# ---- the planner cannot see the ground truth --------------------------------------------------
for truth in sim/mesh/world.hpp sim/mesh/triangle_mesh.hpp sim/mesh/mesh_file.hpp sim/flight/flight.hpp \
  sim/flight/vehicle_config.hpp sensors/ray_scene.hpp sensors/capture.hpp assets/catalog.hpp \
  scenarios/scenario.hpp bench/score/cloud_metrics.hpp tools/mission/mission.hpp; do
  forbidden planner/planners.cpp "#include \"$truth\""
  forbidden planner/map/occupancy_grid.hpp "#include \"$truth\""
done
for believed in planner/view/visibility.hpp sim/core/pose.hpp sensors/camera_model.hpp \
  sensors/lidar_model.hpp sensors/sights.hpp sensors/depth_noise.hpp sensors/frames.hpp; do
  allowed planner/planners.cpp "#include \"$believed\""
done
# nor by way of the sensor types it reads
for type in camera_model lidar_model sights depth_noise frames; do
  forbidden "sensors/$type.hpp" '#include "sim/mesh/world.hpp"'
  forbidden "sensors/$type.hpp" '#include "sensors/ray_scene.hpp"'
  allowed "sensors/$type.hpp" '#include "sim/core/pose.hpp"'
done

# ---- the other rooms: the rows are the check's, a few of every kind say that it reads them --------
forbidden sim/core/pose.hpp '#include "sim/mesh/world.hpp"'
forbidden sim/flight/px4.cpp '#include "sim/mavlink/messages.hpp"'
forbidden planner/map/frontiers.cpp '#include "planner/core/planner.hpp"'
for room in core guided route tour; do  # no way back up, nor to another planner
  forbidden "planner/$room/any.cpp" '#include "planner/planners.hpp"'
  forbidden "planner/$room/any.cpp" '#include "planner/config.hpp"'
done
forbidden planner/guided/any.cpp '#include "planner/tour/config.hpp"'
forbidden planner/tour/any.cpp '#include "planner/guided/utility.hpp"'
forbidden bench/score/cloud_metrics.cpp '#include "bench/limits/ceiling.hpp"'
forbidden tools/terminal/progress.cpp '#include "scenarios/scenario.hpp"'
forbidden assets/catalog.cpp '#include "sensors/frames.hpp"'
forbidden scenarios/load.cpp '#include "sensors/ray_scene.hpp"'
forbidden bench/score/cloud_metrics.cpp '#include "tools/mission/mission.hpp"'
forbidden tools/mission/mission.cpp '#include "tests/support/made_run.hpp"'
allowed sim/mesh/triangle_mesh.cpp '#include "sim/core/pose.hpp"'
allowed scenarios/scenario.hpp '#include "planner/core/planner.hpp"'
allowed tools/mission/mission.cpp '#include "bench/score/cloud_metrics.hpp"'
allowed tests/end_to_end/smoke_test.cpp '#include "tools/mission/mission.hpp"'

# ---- libraries stop at their one file ---------------------------------------------------------
library() {  # library HEADER FILE_THAT_MAY FILE_THAT_MAY_NOT...
  allowed "$2" "#include <$1>"
  local file
  for file in "${@:3}" planner/planners.cpp tests/support/made_run.hpp; do
    forbidden "$file" "#include <$1>"
  done
}
library embree3/rtcore.h sensors/embree.hpp sensors/ray_scene.cpp bench/limits/ceiling.cpp
library bullet/btBulletCollisionCommon.h sim/flight/vehicle.cpp sim/flight/flight.hpp
library LinearMath/btTransform.h sim/flight/vehicle.cpp sim/flight/flight.hpp
library octomap/OcTree.h planner/map/octomap_io.cpp planner/map/occupancy_grid.cpp
library yaml-cpp/yaml.h scenarios/document.cpp tools/gnbv/main.cpp
allowed sensors/embree.hpp '#include <embree4/rtcore.h>'
forbidden bench/reference/bare_embree.cpp '#include <embree3/rtcore.h>'
forbidden tools/run/run_directory.cpp '#include <openssl/evp.h>'
forbidden sim/mesh/triangle_mesh.cpp '#include <gtest/gtest.h>'

# ---- spellings that would slip past -----------------------------------------------------------
forbidden planner/planners.cpp '  #  include <sim/mesh/world.hpp>'
forbidden planner/planners.cpp '#include"sim/mesh/world.hpp"'
forbidden planner/planners.cpp '#include "../sim/mesh/world.hpp"'
forbidden planner/planners.cpp '#include "sim/core/../mesh/world.hpp"'
forbidden planner/planners.cpp '#include "planner/../sim/mesh/world.hpp"'
forbidden planner/planners.cpp '#include "world.hpp"'
forbidden sensors/ray_scene.cpp '#include "embree3/rtcore.h"'
allowed planner/planners.cpp '#include <vector>'
allowed planner/planners.cpp '// as #include "sim/mesh/world.hpp" would'
forbidden planner/planners.cpp '#include GROUND_TRUTH'

# ---- what the check says ----------------------------------------------------------------------
failed=0
complain() { echo "FAILED: $*" >&2; failed=$((failed + 1)); }

run_check() {  # run_check TREE: sets status and output
  status=0
  output=$("$check" "$root/$1" 2>&1) || status=$?
}

run_check allowed
[[ $status == 0 ]] || complain "something allowed was refused (status $status): $output"

run_check forbidden
[[ $status == 1 ]] || complain "status $status, not 1, on a tree full of forbidden includes"
for place in "${!expected[@]}"; do
  grep -qE "^$place: #include [\"<]?${expected[$place]}[\">]?: ." <<<"$output" ||
    complain "$place: #include ${expected[$place]} was not named"
done

run_check empty
[[ $status == 2 ]] || complain "status $status, not 2, on a tree without sources"

# a folder nobody gave a row, without one include
echo >"$root/roomless/tools/attic/box.cpp"
run_check roomless
[[ $status == 1 && $output == *"tools/attic/: a room needs a row"* ]] ||
  complain "a room without a row passed: $output"

# two types that the linker takes for one; not so in namespaces of their own, or inside a class
mkdir -p "$root/twice/"{assets,planner/map}
printf 'namespace gnbv {\nstruct Extent {\n};\nstruct Grid::Extent {\n};\n}  // namespace gnbv\n' \
  >"$root/twice/planner/map/extent.hpp"
printf 'namespace gnbv::assets {\nstruct Extent {\n};\n}  // namespace gnbv::assets\n' \
  >"$root/twice/assets/solids.hpp"
run_check twice
[[ $status == 0 ]] || complain "types of two namespaces were refused (status $status): $output"
printf 'namespace gnbv {\nstruct Extent final {\n};\n}  // namespace gnbv\n' >"$root/twice/assets/blocks.hpp"
run_check twice
[[ $status == 1 && $output == *"planner/map/extent.hpp:2: Extent is defined in assets/blocks.hpp, too"* ]] ||
  complain "two types of one name passed (status $status): $output"

# the rows allow each of these, together they are a circle
echo '#include "planner/map/grid.hpp"' >"$root/circle/planner/core/model.hpp"
echo '#include "sim/core/pose.hpp"' >"$root/circle/planner/map/grid.hpp"
run_check circle
[[ $status == 0 ]] || complain "no circle was refused (status $status): $output"
sed 's#^planner/map/ .*#planner/map/ planner/ sim/core/#' "$check" >"$root/lax_check"
chmod +x "$root/lax_check"
echo '#include "planner/core/model.hpp"' >>"$root/circle/planner/map/grid.hpp"
status=0
output=$("$root/lax_check" "$root/circle" 2>&1) || status=$?
[[ $status == 1 && $output == *"in a circle"*$'\n'planner/core$'\n'* ]] ||
  complain "a circle passed (status $status): $output"

echo "${#expected[@]} forbidden includes, $failed failures"
((failed == 0))
