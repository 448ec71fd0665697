#include "tools/report/run_pack.hpp"

#include <algorithm>
#include <cmath>

#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/report/frame_cloud.hpp"
#include "tools/report/structures.hpp"
#include "tools/report/thinning.hpp"
#include "tools/report/voxel_growth.hpp"
#include "tools/run/plan_jsonl.hpp"
#include "tools/run/run_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

// What the page needs of each, see PackedCloud and PackedPath.
constexpr std::size_t kPointBytes = 7;
constexpr std::size_t kColourBytes = 3;
constexpr std::size_t kSampleBytes = 18;
constexpr std::size_t kPlannedBytes = 28;
constexpr const char* kSurfaceFile = "surface.glb";
constexpr std::size_t kLeast = 16;        // elements, whatever the budget is
constexpr std::size_t kPaddingBytes = 3;  // at most, before each array

std::uint32_t as_count(std::size_t count) { return static_cast<std::uint32_t>(count); }

/// How many of `first_views` (the view that brought each, -1 the profile; ascending) there are
/// after each number of views. What came after the last view counts to it.
std::vector<std::uint32_t> counts_after(const std::vector<int>& first_views, std::size_t views) {
  std::vector<std::uint32_t> after;
  for (int n = 0; n <= static_cast<int>(views); ++n) {
    const auto end = std::lower_bound(first_views.begin(), first_views.end(), n);
    after.push_back(as_count(static_cast<std::size_t>(end - first_views.begin())));
  }
  after.back() = as_count(first_views.size());
  return after;
}

PackedCloud pack_cloud(const RunCloud& cloud, const ThinnedPoints& thin, std::size_t views,
                       const KnownStructure* structure, int threads, BytePack& bytes) {
  std::vector<Vec3f> points;
  std::vector<int> first_views;
  for (const std::size_t i : thin.kept) {
    points.push_back(cloud.points_world_m[i]);
    first_views.push_back(cloud.view_of(i));
  }
  PackedCloud out{.all_points = cloud.points_world_m.size(), .cell_m = thin.cell_m};
  out.points = pack_points(points, bytes);
  out.after = bytes.add(counts_after(first_views, views));
  if (structure != nullptr) {
    out.error = bytes.add(point_errors(structure->scene, points, threads));
  }
  return out;
}

PackedVoxels pack_voxels(const RunCloud& cloud, double size_m, std::size_t max_bytes,
                         BytePack& bytes) {
  VoxelGrowth growth = voxel_growth(cloud, size_m);
  while (growth.bytes() > max_bytes && growth.after.back() > kLeast) {
    size_m *= 2.0;
    growth = voxel_growth(cloud, size_m);
  }
  return {.size_m = size_m,
          .index = bytes.add(growth.index),
          .after = bytes.add(growth.after),
          .gain_step = bytes.add(growth.gain_step),
          .gain_points = bytes.add(growth.gain_points),
          .gains_after = bytes.add(growth.gains_after)};
}

/// Every n-th sample and the last one, with the least n that fits.
PackedPath pack_path(const std::vector<TrajectorySample>& path, std::size_t max_bytes,
                     BytePack& bytes) {
  std::vector<Vec3f> points;
  std::vector<float> time_s;
  std::vector<std::int16_t> quaternion;
  const std::size_t room = std::max(kLeast, max_bytes / kSampleBytes);
  const std::size_t every = (path.size() + room - 2) / (room - 1);
  for (std::size_t i = 0; i < path.size();) {
    const TrajectorySample& sample = path[i];
    points.push_back(sample.T_world_body.translation().cast<float>());
    time_s.push_back(static_cast<float>(sample.time_s));
    const Eigen::Quaterniond q(sample.T_world_body.linear());
    for (const double c : {q.x(), q.y(), q.z(), q.w()}) {
      quaternion.push_back(static_cast<std::int16_t>(std::lround(32767.0 * c)));
    }
    i = i + 1 == path.size() ? path.size() : std::min(i + every, path.size() - 1);
  }
  return {.points = pack_points(points, bytes),
          .time_s = bytes.add(time_s),
          .quaternion = bytes.add(quaternion)};
}

/// Of each plan as many views from its beginning as all of them have room for.
PackedPlan pack_plan(const RunRecord& record, std::size_t max_bytes, BytePack& bytes) {
  const std::vector<MadePlan> plans = read_plans(record);
  const std::size_t room =
      std::max(kLeast, max_bytes / kPlannedBytes / std::max<std::size_t>(1, plans.size()));
  const CameraModel camera = make_camera_model(record.scenario.cameras.at(0));
  std::vector<float> poses;
  std::vector<std::uint32_t> begins;  // of each plan
  for (const MadePlan& made : plans) {
    begins.push_back(as_count(poses.size() / 7));
    for (std::size_t i = 0; i < std::min(room, made.plan.views.size()); ++i) {
      const ViewPose& view = made.plan.views[i];
      const Isometry T_world_camera =
          T_world_body(view) * turned(camera, view.gimbal_pitch_rad).T_body_camera;
      const Eigen::Quaterniond q(T_world_camera.linear());
      for (const double number : {view.p_world_m.x(), view.p_world_m.y(), view.p_world_m.z(), q.x(),
                                  q.y(), q.z(), q.w()}) {
        poses.push_back(static_cast<float>(number));
      }
    }
  }
  begins.push_back(as_count(poses.size() / 7));
  std::vector<std::uint32_t> ranges;
  for (std::size_t view = 0; view < record.views.size(); ++view) {
    const auto standing = standing_plan(plans, record, view);
    if (!standing) {
      ranges.insert(ranges.end(), {0, 0});
      continue;
    }
    const auto plan = static_cast<std::size_t>(standing->made - plans.data());
    const std::uint32_t end = begins[plan + 1];
    ranges.insert(ranges.end(), {std::min(begins[plan] + as_count(standing->next), end), end});
  }
  return {.poses = bytes.add(poses), .ranges = bytes.add(ranges)};
}

/// How many points of a cloud there is room for, when so many bytes are left.
std::size_t point_count(const RunBudget& budget, std::size_t left, bool has_colours) {
  const std::size_t room =
      has_colours ? left / 10 * 6 / (kPointBytes + kColourBytes) : left / kPointBytes;
  return std::clamp(room, kLeast, std::max(kLeast, budget.points));
}

/// What `gnbv surface` made of the run, where it has.
std::optional<ByteSlice> pack_surface(const fs::path& run, std::size_t max_bytes, BytePack& bytes) {
  const fs::path path = run / kSurfaceFolder / kSurfaceFile;
  if (!fs::exists(path)) return std::nullopt;
  const std::string glb = read_file(path);
  if (glb.size() > max_bytes) {
    throw BadInput(
        fmt::format("{}: {:.1f} MB are too many for the page, {:.1f} MB are left; `gnbv surface {} "
                    "--texture-px "
                    "2048 --simplify-m 0.05` makes a smaller one",
                    path.string(), 1e-6 * static_cast<double>(glb.size()),
                    1e-6 * static_cast<double>(max_bytes), run.string()));
  }
  return bytes.add(std::vector<std::uint8_t>(glb.begin(), glb.end()));
}

/// Of a run that still flies what its frames show; nothing where it keeps none.
RunCloud seen_so_far(const RunRecord& record, int threads, std::vector<std::string>& missing) {
  if (RunFiles(record.folder).find(kCloudFile) || !has_frames(record.folder)) return {};
  try {
    RunCloud cloud = cloud_of_frames(record, read_frames(record.folder), threads);
    missing.emplace_back(
        "Points are those of the depth images until then, without the profile's; what of the "
        "surface was found is told when the mission has ended");
    return cloud;
  } catch (const BadInput&) {
    return {};  // what is wrong with the frames is told with them
  }
}

void pack_frames(const RunRecord& record, const RunCloud& cloud, const ThinnedPoints& thin,
                 std::size_t max_bytes, int threads, const ReportProgress& progress,
                 PackedRun& out) {
  if (!has_frames(record.folder)) {
    out.missing.push_back(fmt::format("{}: colour images were not kept; {} keeps them",
                                      (record.folder / kFramesFolder).string(),
                                      command_to_fly_again(record.folder, "--frames")));
    return;
  }
  const FrameRecord frames = read_frames(record.folder);
  const std::size_t colours = kColourBytes * thin.kept.size() + kPaddingBytes;
  const CameraFrames seen =
      read_camera_frames(record, frames, cloud, thin.kept, max_bytes - std::min(max_bytes, colours),
                         threads, progress);
  for (const FrameCamera& camera : frames.cameras) out.cameras.push_back(camera.name);
  for (const Thumbnail& t : seen.thumbnails) {
    const RecordedFrame& frame = frames.frames[t.frame];
    out.thumbnails.push_back({.view = frame.iteration,
                              .camera = frame.camera,
                              .width_px = t.width_px,
                              .height_px = t.height_px,
                              .jpeg = out.bytes.add(t.jpeg),
                              .depth_jpeg = out.bytes.add(t.depth_jpeg)});
  }
  if (!out.cloud) return;
  std::vector<std::uint8_t> colour;
  for (const auto& rgb : seen.colour) colour.insert(colour.end(), rgb.begin(), rgb.end());
  out.cloud->colour = out.bytes.add(colour);
}

}  // namespace

PackedRun pack_run(const RunRecord& record, const KnownStructure* structure,
                   const RunBudget& budget, int threads, const ReportProgress& progress) {
  PackedRun out;
  RunCloud cloud;
  ThinnedPoints thin;
  const std::size_t views = record.views.size();
  const auto left = [&] {  // after counts and padding
    const std::size_t used = out.bytes.bytes().size() + 8 * (views + 1) + 16 * kPaddingBytes;
    return budget.bytes - std::min(budget.bytes, used);
  };
  if (!record.path.empty()) out.path = pack_path(record.path, budget.bytes / 8, out.bytes);
  try {
    if (traits_of(record.scenario.planner).makes_tours) {
      out.plan = pack_plan(record, budget.bytes / 8, out.bytes);
    }
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());  // the page does without plans
  }
  try {
    out.candidates = pack_candidates(record, budget.bytes / 3, out.bytes);
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());  // and without candidates
  }
  try {
    out.beliefs = pack_beliefs(record, budget.bytes / 8, out.bytes);
    if (auto why = why_no_beliefs(record); !why.empty()) out.missing.push_back(std::move(why));
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());  // and without them
  }
  try {
    out.surface = pack_surface(record.folder, budget.bytes / 3, out.bytes);
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());  // and without a surface
  }
  try {
    cloud = read_run_cloud(record);
    if (structure != nullptr && !structure->to_find.codes.empty() && views < kNeverFound) {
      out.found = out.bytes.add(views_until_found(structure->to_find, cloud));
    }
    out.voxels =
        pack_voxels(cloud, record.scenario.planner.map.resolution_m, budget.bytes / 4, out.bytes);
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());
    cloud = seen_so_far(record, threads, out.missing);
  }
  if (!cloud.points_world_m.empty()) {
    thin = thinned(cloud.points_world_m, point_count(budget, left(), has_frames(record.folder)),
                   std::max(record.scenario.planner.cloud.leaf_m, 1e-3));
    out.cloud = pack_cloud(cloud, thin, views, structure, threads, out.bytes);
  }
  try {
    pack_frames(record, cloud, thin, left(), threads, progress, out);
  } catch (const BadInput& error) {
    out.missing.emplace_back(error.what());  // and without frames
  }
  return out;
}

}  // namespace gnbv
