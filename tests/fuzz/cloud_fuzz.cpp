// Whatever stands in a cloud or a map: it is read or refused as BadInput, and what was read keeps
// its promises. The first byte chooses the format.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "planner/core/belief.hpp"
#include "planner/map/octomap_io.hpp"
#include "sim/core/error.hpp"
#include "sim/core/sha256.hpp"
#include "tests/fuzz/written.hpp"
#include "tools/run/cloud_file.hpp"

namespace gnbv {
namespace {

/// A map of a few voxels: a belief of it is as short as the fuzzer's inputs.
const PlannerModel& small_model() {
  static const PlannerModel model = [] {
    CameraConfig camera;
    camera.width_px = 4;
    camera.height_px = 3;
    BeliefConfig config;
    config.map.resolution_m = 1.0;
    return PlannerModel(config, {}, Box3(Vec3(-4, -4, 0), Vec3(4, 4, 4)), {&camera, 1}, {});
  }();
  return model;
}

/// With a digest that fits: mutations would never find it.
void check_belief(std::string_view body) {
  Sha256 sha;
  sha.add(body);
  const auto file = written(std::string(body) + sha.hex(), "profile.map");
  const Belief belief = read_belief(file, small_model());
  const auto again = file.parent_path() / "again.map";
  write_belief(belief, again);
  const Belief same = read_belief(again, small_model());
  GNBV_CHECK(same.cloud.points_world_m().size() == belief.cloud.points_world_m().size(),
             "another cloud");
}

void check_cloud(const std::filesystem::path& file) {
  const std::vector<Vec3f> points = read_cloud(file);
  const auto again = file.parent_path() / "again.ply";
  write_cloud_ply(points, again);
  GNBV_CHECK(read_cloud(again).size() == points.size(), "another number of points");
}

void check(char kind, std::string_view content) {
  switch (kind) {
    case 'p':
      return check_cloud(written(content, "cloud.ply"));
    case 'x':
      return check_cloud(written(content, "cloud.xyz"));
    case 'c':
      return check_cloud(written(content, "cloud.pcd"));
    case 'l':
      return check_cloud(written(content, "cloud.las"));
    case 'o':
      read_octomap(written(content, "map.ot"));
      return;
    default:
      return check_belief(content);
  }
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    gnbv::check(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  } catch (const gnbv::BadInput&) {
    // said, and that is all
  }
  return 0;
}
