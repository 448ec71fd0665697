#include "bench/limits/ceiling_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <sstream>

#include "bench/score/content_cache.hpp"
#include "bench/score/packed_counts.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kSurveyKind = "view_survey";

/// Numbers one after the other, counts packed.
class Writer {
 public:
  std::string bytes;
  template <typename T>
  void put(T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_count(std::uint64_t count) { gnbv::put_count(count, bytes); }
};

/// Reads them back; is_good() turns false at the first that is not there.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  bool is_good() const { return good_; }
  bool is_at_end() const { return left_.empty(); }

  template <typename T>
  T get() {
    T value{};
    good_ = good_ && left_.size() >= sizeof value;
    if (!good_) return value;
    std::memcpy(&value, left_.data(), sizeof value);
    left_.remove_prefix(sizeof value);
    return value;
  }
  std::uint64_t get_count() {
    const auto count = good_ ? take_count(left_) : std::nullopt;
    good_ = count.has_value();
    return count.value_or(0);
  }

 private:
  std::string_view left_;
  bool good_ = true;
};

void add(Sha256& sha, const Vec3& v) {
  for (const double x : v) sha.add(x);
}

void add(Sha256& sha, const LidarConfig& c) {
  for (const double x :
       {c.fov_rad, c.range_min_m, c.range_max_m, c.roll_rad, c.pitch_rad, c.yaw_rad}) {
    sha.add(x);
  }
  add(sha, c.p_body_m);
}

void add(Sha256& sha, const CameraConfig& c) {
  sha.add(c.width_px);
  sha.add(c.height_px);
  for (const double x : {c.fov_x_rad, c.fov_y_rad, c.range_min_m, c.range_max_m, c.roll_rad,
                         c.pitch_rad, c.yaw_rad}) {
    sha.add(x);
  }
  add(sha, c.p_body_m);
  if (!c.gimbal) return;
  for (const double x : {c.gimbal->min_rad, c.gimbal->max_rad, c.gimbal->step_rad}) sha.add(x);
}

}  // namespace

std::string ceiling_key(const Scenario& scenario, const World& world,
                        const LegalViewpoints& legal) {
  Sha256 sha;
  for (const TriangleMesh* mesh : {&world.structure, &world.obstacles, &world.terrain}) {
    add_mesh(sha, *mesh);
  }
  sha.add(world.has_ground);
  add(sha, scenario.score.region_m.min());
  add(sha, scenario.score.region_m.max());
  const NoFly no_fly = no_fly_of(scenario);
  sha.add(std::uint64_t{no_fly.boxes_m.size()});
  for (const Box3& box_m : no_fly.boxes_m) {
    add(sha, box_m.min());
    add(sha, box_m.max());
  }
  sha.add(std::uint64_t{scenario.cameras.size()});
  for (const CameraConfig& camera : scenario.cameras) add(sha, camera);
  sha.add(std::uint64_t{scenario.lidars.size()});
  for (const LidarConfig& lidar : scenario.lidars) add(sha, lidar);
  const ProfilingConfig& profiling = scenario.planner.profiling;
  sha.add(static_cast<std::uint64_t>(profiling.method));
  sha.add(profiling.scan_in_transit);
  sha.add(std::uint64_t{static_cast<unsigned>(profiling.circle_stations)});
  sha.add(profiling.climb_step_m);
  if (profiling.method != ProfilingMethod::none) {
    add(sha, scenario.start.pose.p_world_m);
    sha.add(scenario.start.pose.yaw_rad);
  }
  add(sha, scenario.workspace_m.min());
  add(sha, scenario.workspace_m.max());
  sha.add(scenario.planner.map.resolution_m);
  sha.add(scenario.planner.floor_z_m);
  sha.add(scenario.planner.cloud.leaf_m);
  sha.add(scenario.planner.validity.collision_radius_m);
  sha.add(legal.step_m);
  sha.add(std::uint64_t{legal.size()});
  for (const Vec3& p : legal.p_world_m) add(sha, p);
  for (const auto& cell : legal.cell) sha.add(std::span<const std::int32_t>(cell));
  return sha.hex();
}

Scenario what_a_ceiling_depends_on(const Scenario& scenario) {
  Scenario out;
  out.seed = scenario.seed;  // moves the start
  out.workspace_m = scenario.workspace_m;
  out.structure = scenario.structure;
  out.terrain = scenario.terrain;
  out.obstacles = scenario.obstacles;
  out.no_fly = scenario.no_fly;
  out.score.region_m = scenario.score.region_m;
  out.start = scenario.start;
  out.lidars = scenario.lidars;
  out.cameras = scenario.cameras;
  for (CameraConfig& camera : out.cameras) {
    camera.preset = CameraConfig{}.preset;
    camera.name = CameraConfig{}.name;
    camera.rate_hz = CameraConfig{}.rate_hz;
    camera.drop_probability = CameraConfig{}.drop_probability;
    camera.noise = {};
  }
  const PlannerConfig& planner = scenario.planner;
  out.planner.map.resolution_m = planner.map.resolution_m;
  out.planner.cloud.leaf_m = planner.cloud.leaf_m;
  out.planner.floor_z_m = planner.floor_z_m;
  out.planner.profiling = planner.profiling;
  out.planner.validity.collision_radius_m = planner.validity.collision_radius_m;
  out.planner.validity.z_min_m = planner.validity.z_min_m;
  return out;
}

std::string text_of(const Ceiling& ceiling) {
  std::string text = fmt::format("{}", ceiling.positions);
  for (const auto* shares :
       {&ceiling.raw, &ceiling.outside, &ceiling.leaf_raw, &ceiling.leaf_outside}) {
    for (const double share : *shares) text += fmt::format(" {}", share);
  }
  return text + "\n";
}

std::optional<Ceiling> ceiling_from(std::string_view text) {
  std::istringstream in{std::string(text)};
  Ceiling ceiling;
  in >> ceiling.positions;
  for (auto* shares : {&ceiling.raw, &ceiling.outside, &ceiling.leaf_raw, &ceiling.leaf_outside}) {
    for (double& share : *shares) in >> share;
  }
  if (!in) return std::nullopt;
  return ceiling;
}

std::string bytes_of(const ViewSurvey& survey) {
  Writer out;
  for (const auto* shares : {&survey.leaf_raw, &survey.leaf_outside}) {
    for (const double share : *shares) out.put(share);
  }
  out.put_count(survey.views.size());
  for (const SurveyedView& view : survey.views) {
    out.put(view.position);
    out.put(view.yaw_rad);
    out.put(view.gimbal_pitch_rad);
    out.put_count(view.finds.size());
    std::uint32_t last = 0;
    for (const std::uint32_t voxel : view.finds) {
      out.put_count(voxel - last);
      last = voxel;
    }
  }
  return std::move(out.bytes);
}

std::optional<ViewSurvey> survey_from(std::string_view bytes) {
  Reader in(bytes);
  ViewSurvey survey;
  for (auto* shares : {&survey.leaf_raw, &survey.leaf_outside}) {
    for (double& share : *shares) share = in.get<double>();
  }
  for (std::uint64_t views = in.get_count(); views > 0 && in.is_good(); --views) {
    SurveyedView& view = survey.views.emplace_back();
    view.position = in.get<std::uint32_t>();
    view.yaw_rad = in.get<double>();
    view.gimbal_pitch_rad = in.get<double>();
    std::uint32_t voxel = 0;
    for (std::uint64_t finds = in.get_count(); finds > 0 && in.is_good(); --finds) {
      voxel += static_cast<std::uint32_t>(in.get_count());
      view.finds.push_back(voxel);
    }
  }
  if (!in.is_good() || !in.is_at_end()) return std::nullopt;
  return survey;
}

ViewSurvey cached_survey(const std::string& key, const Scenario& scenario, const RayScene& scene,
                         const LegalViewpoints& legal, const SurfaceReference& reference,
                         int threads, const HeedStop& stop) {
  if (const auto stored = load_cached(kSurveyKind, key)) {
    if (auto survey = survey_from(*stored)) return std::move(*survey);
  }
  ViewSurvey survey = survey_views(scenario, scene, legal, reference, threads, stop);
  store_cached(kSurveyKind, key, bytes_of(survey));
  return survey;
}

}  // namespace gnbv
