#include "bench/limits/ceiling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/limits/seen_surface.hpp"
#include "bench/score/content_cache.hpp"
#include "bench/score/packed_numbers.hpp"
#include "scenarios/load.hpp"
#include "sensors/sights.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kKind = "ceiling";

Ceiling compute(const Scenario& scenario, const World& world, const RayScene& scene,
                const LegalViewpoints& legal, int threads,
                const std::function<void(double)>& on_progress) {
  const SurfaceReference reference =
      cached_surface_reference(world, scene, reference_config(scenario), threads);
  const SeenSurface seen =
      find_seen_surface(scenario, world, scene, legal, reference, threads, on_progress);
  Ceiling ceiling{.area_samples = reference.area_samples, .positions = legal.size()};
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const VoxelSet seen_of_size = coarser(seen.voxels, kCoverageFactors[size]);
    const VoxelSet kept = covered_voxels(seen.kept_world_m, size);
    VoxelSet kept_and_seen;  // the neighbour that gets a leaf need not be seen
    std::set_intersection(kept.begin(), kept.end(), seen_of_size.begin(), seen_of_size.end(),
                          std::back_inserter(kept_and_seen));
    ceiling.raw[size] = coverage(reference.raw[size], seen_of_size);
    ceiling.counted[size] = coverage(reference.counted[size], seen_of_size);
    ceiling.leaf_raw[size] = coverage(reference.raw[size], kept_and_seen);
    ceiling.leaf_counted[size] = coverage(reference.counted[size], kept_and_seen);
  }
  return ceiling;
}

std::string bytes_of(const Ceiling& ceiling) {
  std::string bytes;
  put_count(bytes, ceiling.area_samples);
  put_count(bytes, ceiling.positions);
  for (const auto* shares :
       {&ceiling.raw, &ceiling.counted, &ceiling.leaf_raw, &ceiling.leaf_counted}) {
    append_bytes(bytes, *shares);
  }
  return bytes;
}

std::optional<Ceiling> ceiling_in(std::string_view bytes) {
  PackedNumbers in(bytes);
  Ceiling ceiling;
  ceiling.area_samples = in.take_count();
  ceiling.positions = in.take_count();
  for (auto* shares : {&ceiling.raw, &ceiling.counted, &ceiling.leaf_raw, &ceiling.leaf_counted}) {
    *shares = in.take<std::array<double, 3>>();
  }
  if (!in.is_read()) return std::nullopt;
  return ceiling;
}

/// The rows of the report: a name for readers, one for programs, and the shares.
struct Row {
  std::string text;
  std::string key;
  std::array<double, 3> share;
};

std::array<Row, 4> rows_of(const Ceiling& ceiling) {
  const bool is_outside = ceiling.area_samples == 0;
  const std::string name = reference_name(ceiling.area_samples);
  return {{{is_outside ? "seen, of the surface visible from outside" : "seen, of the area samples",
            name, ceiling.counted},
           {"seen, of all surface", "raw", ceiling.raw},
           {is_outside ? "kept by the cloud, visible from outside"
                       : "kept by the cloud, of the area samples",
            "leaf_" + name, ceiling.leaf_counted},
           {"kept by the cloud, of all surface", "leaf_raw", ceiling.leaf_raw}}};
}

}  // namespace

Ceiling find_ceiling(const Scenario& scenario, const World& world, const RayScene& scene,
                     const ViewPose& start, int threads,
                     const std::function<void(double)>& on_progress) {
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  return cached(kKind, ceiling_key(scenario, world, legal), ceiling_in, bytes_of,
                [&] { return compute(scenario, world, scene, legal, threads, on_progress); });
}

std::optional<Ceiling> known_ceiling(const Scenario& scenario, const World& world,
                                     const RayScene& scene, const ViewPose& start, int threads) {
  if (!has_cached(kKind)) return std::nullopt;
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  const auto stored = load_cached(kKind, ceiling_key(scenario, world, legal));
  return stored ? ceiling_in(*stored) : std::nullopt;
}

ReferenceConfig reference_config(const Scenario& scenario) {
  const ScoreConfig& score = scenario.score;
  const bool by_samples = score.reference == ScoreReference::area_samples;
  return {.floor_z_m = scenario.planner.floor_z_m,
          .area_samples = by_samples ? static_cast<std::size_t>(score.area_samples) : 0,
          .region_m = score.region_m};
}

Scenario what_a_ceiling_depends_on(const Scenario& scenario) {
  Scenario out;
  out.seed = scenario.seed;  // moves the start
  out.workspace_m = scenario.workspace_m;
  out.structure = scenario.structure;
  out.terrain = scenario.terrain;
  out.obstacles = scenario.obstacles;
  std::erase_if(out.obstacles, [](const auto& o) { return !o.motion.waypoints.empty(); });
  out.no_fly = scenario.no_fly;
  out.score.reference = scenario.score.reference;
  out.score.region_m = scenario.score.region_m;
  if (out.score.reference == ScoreReference::area_samples)
    out.score.area_samples = scenario.score.area_samples;
  out.start = scenario.start;
  out.lidars = scenario.lidars;
  for (LidarConfig& lidar : out.lidars) {
    const LidarConfig usual;
    lidar.preset = usual.preset;
    lidar.name = usual.name;
    // one that looks is an image of as many columns
    if (!looks_at_views(lidar, !scenario.cameras.empty())) lidar.beams = usual.beams;
    lidar.rate_hz = usual.rate_hz;
    lidar.range_sigma_m = usual.range_sigma_m;
    lidar.rolling = usual.rolling;
  }
  out.cameras = scenario.cameras;
  for (CameraConfig& camera : out.cameras) {
    const CameraConfig usual;
    camera.preset = usual.preset;
    camera.name = usual.name;
    camera.rate_hz = usual.rate_hz;
    camera.drop_probability = usual.drop_probability;
    camera.noise = usual.noise;
  }
  const PlannerConfig& planner = scenario.planner;
  out.planner.map.resolution_m = planner.map.resolution_m;
  out.planner.cloud.leaf_m = planner.cloud.leaf_m;
  out.planner.floor_z_m = planner.floor_z_m;
  out.planner.profiling = planner.profiling;
  out.planner.validity.collision_radius_m = planner.validity.collision_radius_m;
  out.planner.validity.z_min_m = planner.validity.z_min_m;
  out.portable = scenario.portable;
  return out;
}

std::string ceiling_key(const Scenario& scenario, const World& world,
                        const LegalViewpoints& legal) {
  Sha256 sha;
  for (const TriangleMesh* mesh : {&world.structure, &world.obstacles, &world.terrain}) {
    add_mesh(sha, *mesh);
  }
  Scenario rest = what_a_ceiling_depends_on(scenario);
  rest.structure = {};
  rest.structure.ground = world.has_ground;
  rest.obstacles = {};
  rest.terrain = {};
  rest.seed = Scenario{}.seed;
  rest.planner.profiling.file.clear();
  if (rest.planner.profiling.method == ProfilingMethod::none) rest.start = {};
  sha.add(to_yaml(rest));
  sha.add(legal.step_m);
  sha.add(std::uint64_t{legal.size()});
  for (const Vec3& p_m : legal.p_world_m) sha.add(std::span<const double>(p_m.data(), 3));
  for (const auto& cell : legal.cell) sha.add(std::span<const std::int32_t>(cell));
  return sha.hex();
}

std::string ceiling_json(const Scenario& scenario, const Ceiling& ceiling, double wall_s) {
  nlohmann::ordered_json out = {{"schema", "gnbv-ceiling-1"},
                                {"scenario", scenario.name},
                                {"structure", structure_name(scenario.structure)},
                                {"seed", scenario.seed},
                                {"positions", ceiling.positions}};
  for (const Row& row : rows_of(ceiling)) {
    out[row.key] = {{"0.05", row.share[0]}, {"0.10", row.share[1]}, {"0.50", row.share[2]}};
  }
  out["wall_s"] = wall_s;
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string ceiling_text(const Ceiling& ceiling, double wall_s) {
  std::string text =
      fmt::format("{:<44}{:>9}{:>9}{:>9}\n", "share of the voxels", "0.05 m", "0.10 m", "0.50 m");
  for (const Row& row : rows_of(ceiling)) {
    text += fmt::format("{:<44}{:>7.1f} %{:>7.1f} %{:>7.1f} %\n", row.text, 100.0 * row.share[0],
                        100.0 * row.share[1], 100.0 * row.share[2]);
  }
  text += fmt::format(
      "{} legal positions and the places between them, {:.1f} s\n"
      "of exact sensors, the profile's LIDAR among them: noise can lift a mission above it\n"
      "a voxel counts with surface of a tenth of its face\n",
      ceiling.positions, wall_s);
  if (ceiling.area_samples > 0) {
    text += fmt::format("area samples: voxels {}\n", reference_words(ceiling.area_samples));
  }
  return text;
}

}  // namespace gnbv
