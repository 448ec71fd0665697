// Whatever stands in the tables of a run: they are read or refused as BadInput. The first byte
// chooses the file.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim/core/error.hpp"
#include "tests/fuzz/written.hpp"
#include "tools/run/coverage_csv.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/trajectory_tum.hpp"
#include "tools/run/user_views.hpp"

namespace gnbv {
namespace {

/// What was read is written and read again as the same.
void check_views(const std::filesystem::path& csv) {
  const std::vector<ViewRecord> views = read_view_records(csv);
  if (views.empty()) return;
  const auto again = read_view_records(written(iterations_csv(views), "again.csv"));
  GNBV_CHECK(again.size() == views.size(), "{} views, then {}", views.size(), again.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto difference = first_difference(views[i], again[i]);
    GNBV_CHECK(!difference, "view {}: {} {}, then {}", i, difference->column, difference->now,
               difference->recorded);
  }
}

void check_candidates(const std::filesystem::path& file) {
  for (const std::size_t iteration : {1U, 2U}) {
    const auto plan = read_candidates(file.parent_path(), iteration);
    if (!plan) continue;
    for (const std::size_t chosen : plan->chosen) {
      GNBV_CHECK(chosen < plan->candidates.size(), "chosen {}", chosen);
    }
  }
}

void check_beliefs(const std::filesystem::path& file) {
  constexpr std::size_t kVoxels = 1'000'000;
  for (const BelievedVoxels& view : read_beliefs(file.parent_path(), 3, kVoxels)) {
    for (const VoxelRuns* runs : {&view.unknown, &view.predicted, &view.frontier}) {
      GNBV_CHECK(voxel_count(*runs) <= kVoxels, "{} voxels", voxel_count(*runs));
    }
  }
}

void check_trajectory(const std::filesystem::path& file) {
  const Box3 workspace_m(Vec3(-10, -10, 0), Vec3(10, 10, 10));
  double before_s = -1e300;
  for (const TrajectorySample& sample : read_trajectory_tum(file, workspace_m)) {
    GNBV_CHECK(sample.time_s >= before_s, "{} s after {} s", sample.time_s, before_s);
    GNBV_CHECK(sample.T_world_body.matrix().allFinite(), "a pose that is none");
    before_s = sample.time_s;
  }
}

void check_coverage(const std::filesystem::path& file) {
  const CoverageFile read = read_coverage_csv(file);
  GNBV_CHECK(read.curve.metres.size() == read.curve.coverage.size() &&
                 read.curve.seconds.size() == read.curve.coverage.size() &&
                 read.more_names.size() == read.more_curves.size(),
             "columns of two lengths");
}

void check_user_views(std::string_view content) {
  ViewLines lines("views");
  while (!content.empty()) {
    const std::size_t end = std::min(content.find('\n'), content.size());
    const auto view = lines.read(content.substr(0, end));
    GNBV_CHECK(!view || view->p_world_m.allFinite(), "a view that is nowhere");
    content.remove_prefix(std::min(end + 1, content.size()));
  }
}

void check_record(char kind, std::string_view content) {
  switch (kind) {
    case 'i':
      return check_views(written(content, "iterations.csv"));
    case 'j':
      return check_views(written(content, "iterations.csv.part"));
    case 'c':
      return check_candidates(written(content, kCandidatesFile));
    case 'b':
      return check_beliefs(written(content, kBeliefsFile));
    case 't':
      return check_trajectory(written(content, "trajectory.tum"));
    case 'k':
      return check_coverage(written(content, "coverage.csv"));
    default:
      return check_user_views(content);
  }
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    gnbv::check_record(static_cast<char>(data[0]),
                       {reinterpret_cast<const char*>(data) + 1, size - 1});
  } catch (const gnbv::BadInput&) {
    // said, and that is all
  }
  return 0;
}
