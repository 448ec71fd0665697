// What was measured of the surface: points, the voxels that hold them, the surface made of them;
// and what of the true one was found.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "bench/score/cloud_metrics.hpp"
#include "bench/score/sized_coverage.hpp"
#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/parallel.hpp"
#include "tools/page/packs.hpp"
#include "tools/run/file_names.hpp"
#include "tools/scene/colour.hpp"

namespace gnbv {
namespace {

constexpr const char* kSurfaceFile = "surface.glb";

/// Where the points of each state end: after the profile, and after each view. What came after the
/// last view counts to it.
std::vector<std::size_t> ends_of(const RunCloud& cloud) {
  std::vector<std::size_t> ends = {cloud.profile_points};
  ends.insert(ends.end(), cloud.view_points.begin(), cloud.view_points.end());
  ends.back() = cloud.points_world_m.size();
  return ends;
}

page::VoxelData voxels_of_size(const RunCloud& cloud, double size_m, page::Arrays& arrays) {
  std::vector<std::int16_t> index;
  std::vector<std::uint32_t> after;
  std::vector<std::uint32_t> gains;
  std::vector<std::uint32_t> gains_after;
  std::unordered_map<std::uint64_t, std::uint32_t> voxel_of_code;
  std::vector<std::uint32_t> gained;   // by voxel, since the last state
  std::vector<std::uint32_t> touched;  // the voxels that gained
  std::size_t point = 0;
  for (const std::size_t end : ends_of(cloud)) {
    for (; point < end; ++point) {
      const std::uint64_t code = voxel_code(cloud.points_world_m[point], size_m);
      const auto [place, is_new] = voxel_of_code.emplace(code, as_count(gained.size()));
      if (is_new) {
        for (const std::int64_t k : index_of(code)) {
          GNBV_CHECK(std::abs(k) < std::numeric_limits<std::int16_t>::max(), "voxel {} of {} m", k,
                     size_m);
          index.push_back(static_cast<std::int16_t>(k));
        }
        gained.push_back(0);
      }
      if (gained[place->second]++ == 0) touched.push_back(place->second);
    }
    std::sort(touched.begin(), touched.end());
    std::uint32_t before = 0;
    for (const std::uint32_t voxel : touched) {
      gains.insert(gains.end(), {voxel - before, std::exchange(gained[voxel], 0)});
      before = voxel;
    }
    touched.clear();
    after.push_back(as_count(gained.size()));
    gains_after.push_back(as_count(gains.size()));
  }
  return {.size_m = size_m,
          .index = arrays.add<3>(index),
          .after = arrays.add(after),
          .gains = arrays.add_numbers(gains),
          .gains_after = arrays.add(gains_after)};
}

/// Whether the bytes are a binary glTF 2.0 as long as it says, with a JSON chunk within.
bool is_whole_glb(const std::string& glb) {
  constexpr std::size_t kHead = 20;  // magic, version, length; length and type of the first chunk
  if (glb.size() < kHead || !glb.starts_with("glTF") || glb.compare(16, 4, "JSON") != 0) {
    return false;
  }
  std::array<std::uint32_t, 4> head{};
  std::memcpy(head.data(), glb.data(), sizeof(head));
  return head[1] == 2 && head[2] == glb.size() && kHead + head[3] <= glb.size();
}

constexpr double kErrorStep_m = 0.001;
constexpr std::int64_t kMostIndex = std::numeric_limits<std::int16_t>::max();

bool fits_16_bits(const VoxelSet& codes) {
  return std::all_of(codes.begin(), codes.end(), [](std::uint64_t code) {
    const auto index = index_of(code);
    return std::all_of(index.begin(), index.end(),
                       [](std::int64_t k) { return -kMostIndex <= k && k < kMostIndex; });
  });
}

}  // namespace

TrueVoxels true_voxels(const SurfaceReference& reference, std::size_t max_voxels) {
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const VoxelSet& codes = reference.counted[size];
    if (codes.size() <= max_voxels && fits_16_bits(codes)) {
      return {.size_m = kCoverageSizes_m[size], .codes = codes};
    }
  }
  return {};
}

std::vector<std::uint16_t> views_until_found(const TrueVoxels& voxels, const RunCloud& cloud) {
  GNBV_CHECK(cloud.view_points.size() < kNeverFound, "{} views", cloud.view_points.size());
  const std::size_t size = papers_size(voxels.size_m).value();
  std::vector<std::uint16_t> until(voxels.codes.size(), kNeverFound);
  std::size_t point = 0;
  std::uint16_t state = 0;
  for (const std::size_t end : ends_of(cloud)) {
    for (; point < end; ++point) {
      for (const std::uint64_t code : covered_by(cloud.points_world_m[point], size)) {
        const auto voxel = std::lower_bound(voxels.codes.begin(), voxels.codes.end(), code);
        if (voxel == voxels.codes.end() || *voxel != code) continue;
        std::uint16_t& found = until[static_cast<std::size_t>(voxel - voxels.codes.begin())];
        found = std::min(found, state);
      }
    }
    ++state;
  }
  return until;
}

std::vector<std::uint8_t> point_errors(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                       int threads) {
  constexpr double kMost = kNotOfStructure - 1;
  std::vector<std::uint8_t> errors(points_world_m.size());
  const std::vector<std::uint8_t> is_its = points_of_structure(scene, points_world_m, threads);
  constexpr std::size_t kPoints = 4096;  // a task
  parallel_for_chunks(
      threads, points_world_m.size(), kPoints, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const double off_m =
              scene.distance_to_structure_m(points_world_m[i].cast<double>(), kMost * kErrorStep_m);
          const double steps = std::min(kMost, std::round(off_m / kErrorStep_m));
          errors[i] = is_its[i] != 0 ? static_cast<std::uint8_t>(steps) : kNotOfStructure;
        }
      });
  return errors;
}

page::CloudData pack_cloud(const RunCloud& cloud, const ThinnedPoints& thin, const RayScene* scene,
                           int threads, page::Arrays& arrays) {
  std::vector<Vec3f> points;
  for (const std::size_t i : thin.kept) points.push_back(cloud.points_world_m[i]);
  std::vector<std::uint32_t> after;
  for (const std::size_t end : ends_of(cloud)) {
    const auto kept = std::lower_bound(thin.kept.begin(), thin.kept.end(), end);
    after.push_back(as_count(static_cast<std::size_t>(kept - thin.kept.begin())));
  }
  page::CloudData out{.points = arrays.add_points(points),
                      .after = arrays.add(after),
                      .all_points = cloud.points_world_m.size(),
                      .cell_m = thin.cell_m};
  if (scene == nullptr) return out;
  const std::vector<std::uint8_t> errors = point_errors(*scene, points, threads);
  std::vector<double> known_m;
  for (const std::uint8_t error : errors) {
    if (error != kNotOfStructure) known_m.push_back(kErrorStep_m * error);
  }
  const ErrorScale scale = error_scale(known_m);
  out.error = arrays.add(errors);
  out.error_most_mm = 1000.0 * scale.most_m;
  out.error_median_mm = 1000.0 * scale.median_m;
  return out;
}

page::VoxelData pack_voxels(const RunCloud& cloud, double size_m, std::size_t max_bytes,
                            page::Arrays& arrays) {
  const std::size_t before = arrays.bytes().size();
  for (;; size_m *= 2.0) {
    const page::VoxelData voxels = voxels_of_size(cloud, size_m, arrays);
    const bool fits = arrays.bytes().size() - before <= max_bytes;
    if (fits || voxels.index.rows <= kLeastElements) return voxels;
    arrays.cut(before);
  }
}

std::optional<page::Array<std::uint8_t>> pack_surface(const RunRecord& record,
                                                      std::size_t max_bytes, page::Arrays& arrays) {
  const std::filesystem::path path = record.folder / kSurfaceFolder / kSurfaceFile;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string glb = read_file(path);
  if (!is_whole_glb(glb)) {
    throw BadInput("{}: is no whole binary glTF; `gnbv surface {}` writes it anew", path.string(),
                   record.folder.string());
  }
  if (glb.size() > max_bytes) {
    throw BadInput(
        "{}: {:.1f} MB are too many for the page, {:.1f} MB are left; `gnbv surface {} "
        "--texture-px 2048 --simplify-m 0.05` makes a smaller one",
        path.string(), 1e-6 * static_cast<double>(glb.size()),
        1e-6 * static_cast<double>(max_bytes), record.folder.string());
  }
  return arrays.add(std::vector<std::uint8_t>(glb.begin(), glb.end()));
}

}  // namespace gnbv
