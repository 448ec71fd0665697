#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assets/catalog.hpp"
#include "bench/reference/kd_density_twin.hpp"
#include "bench/reference/pcl_twin.hpp"
#include "bench/speed/speed_rows.hpp"
#include "planner/map/surface_cloud.hpp"
#include "sensors/capture.hpp"

namespace gnbv {
namespace {

constexpr int kViewsBefore = 90;  // 1.4 million points, as halfway through the paper's mission
constexpr int kViewsTimed = 15;

/// Views all over the structure, a few metres off its faces and towards them.
class Views {
 public:
  Views()
      : world_{make_builtin_structure("aircraft"), true}, scene_(world_), cameras_(camera_pair()) {}

  std::vector<FrameRays> take(int view) const {
    const ViewPose pose = pose_of(view);
    std::vector<FrameRays> rays(cameras_.size());
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const DepthFrame frame =
          capture_depth(scene_, cameras_[c], static_cast<int>(c), T_world_body(pose), {}, 1);
      compute_frame_rays(frame, cameras_[c], kFloor_m, rays[c]);
    }
    return rays;
  }

 private:
  ViewPose pose_of(int view) const {
    constexpr std::size_t kStride = 7919;  // a prime: every face in turn, far from the last one
    const TriangleMesh& mesh = world_.structure;
    const auto& face = mesh.faces[static_cast<std::size_t>(view) * kStride % mesh.faces.size()];
    const Vec3 a = mesh.vertices_m[face[0]].cast<double>();
    const Vec3 b = mesh.vertices_m[face[1]].cast<double>();
    const Vec3 c = mesh.vertices_m[face[2]].cast<double>();
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const Vec3 level(normal.x(), normal.y(), 0.0);
    const Vec3 away = level.norm() > 1e-3 ? Vec3(level.normalized()) : Vec3::UnitX();
    Vec3 p_m = (a + b + c) / 3.0 + 4.5 * away + 2.0 * normal.z() * Vec3::UnitZ();
    p_m.z() = std::max(p_m.z(), 1.0);
    return {p_m, std::atan2(-away.y(), -away.x())};
  }

  World world_;
  RayScene scene_;
  std::array<CameraModel, 2> cameras_;
};

struct CloudSums {
  std::vector<std::uint32_t> points;
  std::vector<std::uint64_t> neighbours;

  bool operator==(const CloudSums&) const = default;
};

template <typename Cloud>
CloudSums sums_of(const Cloud& cloud, const GridGeometry& grid) {
  CloudSums sums;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    sums.points.push_back(cloud.point_count(v));
    sums.neighbours.push_back(cloud.neighbour_sum(v));
  }
  return sums;
}

std::vector<Vec3f> hits_of(std::span<const FrameRays> frames) {
  std::vector<Vec3f> hits_m;
  for (const FrameRays& rays : frames) {
    for (std::size_t i = 0; i < rays.kind.size(); ++i) {
      if (rays.kind[i] != PixelRay::hits) continue;
      hits_m.push_back(rays.end_world_m(i));
    }
  }
  return hits_m;
}

/// SurfaceCloud, PCL and the competent way side by side.
class Race {
 public:
  Race()
      : grid_(kWorkspace_m, 0.2),
        cloud_(CloudConfig{}, grid_),
        pcl_(cloud_.search_radius_m()),
        kd_(leaf_m_, cloud_.search_radius_m(), grid_) {}

  void prepare(std::span<const FrameRays> frames) {
    cloud_.add(frames);
    kd_.add(hits_of(frames));
  }

  void run(std::span<const FrameRays> frames) {
    const CloudSums before = sums_of(cloud_, grid_);
    ours_ms_.push_back(time_ms([&] { cloud_.add(frames); }));
    const std::vector<Vec3f> hits_m = hits_of(frames);
    competent_ms_.push_back(time_ms([&] { kd_.add(hits_m); }));
    is_identical_ = is_identical_ && sums_of(kd_, grid_) == sums_of(cloud_, grid_);
    pcl_.append(cloud_.points_world_m().subspan(pcl_.size()));
    time_reference(hits_m, before);
  }

  SpeedRow row() const {
    return {.name = "leaf_filter_and_density",
            .ours = median(ours_ms_),
            .reference = median(reference_ms_),
            .competent = median(competent_ms_),
            .unit = "ms",
            .identical = is_identical_,
            .target = 50.0};
  }

 private:
  VoxelIndex voxel_of(std::size_t point) const {
    return grid_.index_of(grid_.key_of(cloud_.points_world_m()[point]));
  }

  /// The paper's way asks for the points of the voxels that received some.
  void time_reference(const std::vector<Vec3f>& hits_m, const CloudSums& before) {
    const CloudSums after = sums_of(cloud_, grid_);
    CloudSums by_pcl = after;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < pcl_.size(); ++i) {
      const VoxelIndex v = voxel_of(i);
      if (after.points[v] == before.points[v]) continue;
      asked.push_back(i);
      by_pcl.points[v] = 0;
      by_pcl.neighbours[v] = 0;
    }
    const PclCloud batch(hits_m);
    std::optional<PclCloud> filtered;
    std::vector<std::uint32_t> counts(asked.size());
    reference_ms_.push_back(time_ms([&] {
      filtered = batch.filtered(leaf_m_);
      pcl_.build();
      for (std::size_t i = 0; i < asked.size(); ++i) counts[i] = pcl_.count(asked[i]);
    }));
    for (std::size_t i = 0; i < asked.size(); ++i) {
      ++by_pcl.points[voxel_of(asked[i])];
      by_pcl.neighbours[voxel_of(asked[i])] += counts[i];
    }
    is_identical_ =
        is_identical_ && by_pcl == after && filtered->size() == leaf_filter(hits_m, leaf_m_).size();
  }

  double leaf_m_ = CloudConfig{}.leaf_m;
  GridGeometry grid_;
  SurfaceCloud cloud_;
  PclNeighbours pcl_;
  KdDensityTwin kd_;
  std::vector<double> ours_ms_, reference_ms_, competent_ms_;
  bool is_identical_ = true;
};

}  // namespace

std::vector<SpeedRow> cloud_speed() {
  const Views views;
  Race race;
  for (int view = 0; view < kViewsBefore; ++view) race.prepare(views.take(view));
  for (int view = kViewsBefore; view < kViewsBefore + kViewsTimed; ++view) {
    race.run(views.take(view));
  }
  return {race.row()};
}

}  // namespace gnbv
