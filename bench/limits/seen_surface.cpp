#include "bench/limits/seen_surface.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <span>
#include <tuple>

#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/lidar_sight.hpp"
#include "bench/limits/sight_search.hpp"
#include "bench/score/surface_pieces.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/motion/config.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kSpacing_m = 0.0125;     // of the samples
constexpr std::size_t kPointsAsked = 24;  // of a voxel, of either kind

/// Of a voxel that the lattice does not show so many points are searched for closely: what a
/// power plant's voxels get within a minute, more where there are few.
constexpr std::size_t kLeastPointsOfOutside = 4;
constexpr std::size_t kPointsOfAllOutside = 1000000;
constexpr std::size_t kFewerOfRaw = 4;  // times: most of this is buried
constexpr std::size_t kPointsOfLidar = 4;
constexpr std::size_t kFewestOfPiece = 6;

// A leaf keeps one point, the centroid of what its first frame puts there: a handful of pixels,
// which may lie in a voxel that has less than half of the leaf's surface. What has less than this
// share of it is not credited with the leaf.
constexpr double kLeastLeafShare = 0.25;

struct Sample {
  Vec3f p_world_m;
  std::uint64_t voxel;
  LeafKey leaf;
  bool may_keep_leaf;  // the voxel has its share of the leaf
  Vec3f kept_world_m;  // in a voxel that has, if this one has not
  std::uint32_t rank;  // in its piece
  std::uint64_t block = 0;
};

bool has(const VoxelSet& set, std::uint64_t code) {
  return std::binary_search(set.begin(), set.end(), code);
}

/// Whether a leaf lies in a voxel of the finest size.
bool is_inside(const LeafKey& leaf, std::uint64_t voxel, double leaf_m) {
  constexpr double kRounding_m = 1e-6;
  const std::array<std::int64_t, 3> index = index_of(voxel);
  for (std::size_t a = 0; a < 3; ++a) {
    const double low_m = static_cast<double>(leaf[a]) * leaf_m;
    const double voxel_m = static_cast<double>(index[a]) * kCoverageSizes_m[0];
    if (low_m < voxel_m - kRounding_m ||
        low_m + leaf_m > voxel_m + kCoverageSizes_m[0] + kRounding_m) {
      return false;
    }
  }
  return true;
}

/// The surface (m2) that a voxel has of a leaf that reaches beyond it.
using LeafParts = std::map<std::pair<LeafKey, std::uint64_t>, double>;

/// The middle of what a leaf and a voxel have in common.
Vec3f middle_m(const LeafKey& leaf, std::uint64_t voxel, double leaf_m) {
  const std::array<std::int64_t, 3> index = index_of(voxel);
  Vec3f middle;
  for (std::size_t a = 0; a < 3; ++a) {
    const double leaf_low_m = leaf_m * static_cast<double>(leaf[a]);
    const double voxel_low_m = kCoverageSizes_m[0] * static_cast<double>(index[a]);
    const double low_m = std::max(leaf_low_m, voxel_low_m);
    const double high_m = std::min(leaf_low_m + leaf_m, voxel_low_m + kCoverageSizes_m[0]);
    middle[static_cast<Eigen::Index>(a)] = static_cast<float>(0.5 * (low_m + high_m));
  }
  return middle;
}

/// Decides who keeps the samples in leaves that reach beyond a voxel.
void share_leaves(const LeafParts& parts_m2, double leaf_m, std::span<Sample> samples) {
  for (Sample& sample : samples) {
    if (sample.may_keep_leaf) continue;
    double all_m2 = 0.0, own_m2 = 0.0, most_m2 = 0.0;
    std::uint64_t most = sample.voxel;
    for (auto part = parts_m2.lower_bound({sample.leaf, 0});
         part != parts_m2.end() && part->first.first == sample.leaf; ++part) {
      const auto& [key, area_m2] = *part;
      all_m2 += area_m2;
      if (key.second == sample.voxel) own_m2 = area_m2;
      if (area_m2 <= most_m2) continue;
      most_m2 = area_m2;
      most = key.second;
    }
    constexpr double kRounding = 1.0 - 1e-6;  // four equal parts are a quarter each
    sample.may_keep_leaf = own_m2 >= kRounding * kLeastLeafShare * all_m2;
    if (!sample.may_keep_leaf) sample.kept_world_m = middle_m(sample.leaf, most, leaf_m);
  }
}

/// Of one slab, by blocks of the coarsest voxels, in them by voxels, in these one of each piece
/// before the next of any: it may be one small face that is seen. Behind its own samples a voxel of
/// the reference has those beside it that cover it.
std::vector<Sample> samples_of(const TriangleMesh& mesh, const Slabs& slabs, std::size_t index,
                               double floor_z_m, double leaf_m, const SurfaceReference& reference) {
  const LeafLattice lattice(leaf_m);
  std::vector<Sample> samples;
  LeafParts parts_m2;
  for (const std::uint32_t face : slabs.faces[index]) {
    for_each_piece(mesh, face, slabs.slab(index), floor_z_m, [&](const SurfacePiece& piece) {
      const std::size_t count = std::max(points_on(piece, kSpacing_m), kFewestOfPiece);
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3f p_m = point_on(piece, k);
        const LeafKey leaf = lattice.key_of(p_m);
        for (const std::uint64_t voxel : covered_by(p_m, 0)) {
          const bool is_own = voxel == piece.voxel;
          if (!is_own && !has(reference.counted[0], voxel) && !has(reference.raw[0], voxel))
            continue;
          samples.push_back({p_m, voxel, leaf, is_inside(leaf, voxel, leaf_m), p_m,
                             static_cast<std::uint32_t>(is_own ? k : k + kPointsAsked)});
        }
      }
      for_each_part(piece, leaf_m, [&](const std::array<std::int64_t, 3>& cell, double area_m2) {
        const auto at = [&](std::size_t a) { return static_cast<std::int32_t>(cell[a]); };
        const LeafKey leaf = {at(0), at(1), at(2)};
        if (!is_inside(leaf, piece.voxel, leaf_m)) parts_m2[{leaf, piece.voxel}] += area_m2;
      });
    });
  }
  share_leaves(parts_m2, leaf_m, samples);
  for (Sample& sample : samples) sample.block = coarser_code(sample.voxel, kCoverageFactors[2]);
  const auto order = [](const Sample& s) { return std::tuple(s.block, s.voxel, s.rank); };
  std::stable_sort(samples.begin(), samples.end(),
                   [&](const Sample& a, const Sample& b) { return order(a) < order(b); });
  return samples;
}

/// A voxel's samples: those in leaves that it may keep, and the others.
struct Voxel {
  std::uint64_t code = 0;
  std::array<std::vector<Vec3f>, 2> points_m;  // the former first; of each kind not too many
  std::array<std::vector<Vec3f>, 2> kept_m;    // where the cloud keeps each
  bool is_seen = false;
};

class SlabSearch {
 public:
  SlabSearch(const SightSearch& cameras, const LidarSight& lidars,
             const SurfaceReference& reference)
      : cameras_(cameras),
        lidars_(lidars),
        reference_(reference),
        points_of_outside_(std::max(
            kLeastPointsOfOutside,
            kPointsOfAllOutside / std::max<std::size_t>(1, reference.counted[0].size()))) {}

  SeenSurface search(std::span<const Sample> samples) const {
    SeenSurface out;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
      while (end < samples.size() && samples[end].block == samples[begin].block) ++end;
      const std::span<const Sample> block = samples.subspan(begin, end - begin);
      Eigen::AlignedBox3d box_m;
      for (const Sample& sample : block) box_m.extend(sample.p_world_m.cast<double>());
      const std::vector<Vec3> near_m = cameras_.positions_near(box_m);
      std::vector<Voxel> voxels = voxels_of(block);
      settle(near_m, voxels, 0, out.kept_world_m);
      settle(near_m, voxels, 1, out.kept_world_m);
      settle_rest(near_m, voxels, out.kept_world_m);
      for (const Voxel& voxel : voxels) {
        if (voxel.is_seen) out.voxels.push_back(voxel.code);
      }
    }
    return out;
  }

 private:
  static std::vector<Voxel> voxels_of(std::span<const Sample> block) {
    std::vector<Voxel> voxels;
    for (const Sample& sample : block) {
      if (voxels.empty() || voxels.back().code != sample.voxel)
        voxels.push_back({sample.voxel, {}, {}});
      const std::size_t kind = sample.may_keep_leaf ? 0 : 1;
      auto& points_m = voxels.back().points_m[kind];
      if (points_m.size() == kPointsAsked) continue;
      points_m.push_back(sample.p_world_m);
      voxels.back().kept_m[kind].push_back(sample.kept_world_m);
    }
    return voxels;
  }

  /// Asks the samples of one kind of all voxels that are not seen yet; `kept_m` gets where the
  /// cloud keeps one of each that is.
  void settle(std::span<const Vec3> near_m, std::vector<Voxel>& voxels, std::size_t kind,
              std::vector<Vec3f>& kept_m) const {
    std::vector<SightItem> items;
    std::vector<Voxel*> of;
    for (Voxel& voxel : voxels) {
      if (voxel.is_seen || voxel.points_m[kind].empty()) continue;
      items.push_back({.points_world_m = voxel.points_m[kind]});
      of.push_back(&voxel);
    }
    cameras_.look_from_lattice(near_m, SightSearch::Positions::first_few, items);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const bool is_outside = has(reference_.counted[0], of[i]->code);
      // buried surface is asked once, by the better kind of its points
      const bool is_worth = is_outside || (has(reference_.raw[0], of[i]->code) &&
                                           (kind == 0 || of[i]->points_m[0].empty()));
      if (!items[i].is_seen() && is_worth) search_closely(is_outside, items[i]);
      if (items[i].is_seen()) keep(*of[i], kind, items[i].seen, kept_m);
    }
  }

  /// Asks all samples of the voxels of the outside that are still not seen from all positions.
  void settle_rest(std::span<const Vec3> near_m, std::vector<Voxel>& voxels,
                   std::vector<Vec3f>& kept_m) const {
    std::vector<Voxel*> of;
    std::vector<std::vector<Vec3f>> points_m;
    for (Voxel& voxel : voxels) {
      if (voxel.is_seen || !has(reference_.counted[0], voxel.code)) continue;
      of.push_back(&voxel);
      auto& both_m = points_m.emplace_back(voxel.points_m[0]);
      both_m.insert(both_m.end(), voxel.points_m[1].begin(), voxel.points_m[1].end());
    }
    std::vector<SightItem> items;
    for (const auto& some_m : points_m) items.push_back({.points_world_m = some_m});
    cameras_.look_from_lattice(near_m, SightSearch::Positions::others, items);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::size_t first = of[i]->points_m[0].size();
      const std::size_t kind = items[i].seen < first ? 0 : 1;
      if (items[i].is_seen()) keep(*of[i], kind, items[i].seen - kind * first, kept_m);
    }
  }

  static void keep(Voxel& voxel, std::size_t kind, std::size_t point, std::vector<Vec3f>& kept_m) {
    voxel.is_seen = true;
    kept_m.push_back(voxel.kept_m[kind][point]);
  }

  void search_closely(bool is_outside, SightItem& item) const {
    const std::size_t points = item.points_world_m.size();
    const std::size_t by_cameras =
        is_outside ? points_of_outside_ : points_of_outside_ / kFewerOfRaw;
    bool is_open = is_outside;
    for (std::size_t k = 0; k < std::min(by_cameras, points) && !item.is_seen(); ++k) {
      const SightSearch::Look look = cameras_.look_out(item.points_world_m[k], k);
      if (look == SightSearch::Look::seen) item.seen = k;
      is_open = is_open || look == SightSearch::Look::open;
    }
    const std::size_t by_lidars = is_open ? kPointsOfLidar : 0;
    for (std::size_t k = 0; k < std::min(by_lidars, points) && !item.is_seen(); ++k) {
      if (lidars_.is_seen(item.points_world_m[k])) item.seen = k;
    }
  }

  const SightSearch& cameras_;
  const LidarSight& lidars_;
  const SurfaceReference& reference_;
  std::size_t points_of_outside_;
};

}  // namespace

SeenSurface find_seen_surface(const Scenario& scenario, const World& world, const RayScene& scene,
                              const LegalViewpoints& legal, const SurfaceReference& reference,
                              int threads, const std::function<void(double)>& on_progress) {
  const ValidityConfig& validity = scenario.planner.validity;
  const double leaf_m = scenario.planner.cloud.leaf_m;
  const double floor_z_m = scenario.planner.floor_z_m;
  const SightSearch cameras(scene, exact_cameras(scenario), legal,
                            navigation_box_m(validity, scenario.workspace_m),
                            validity.collision_radius_m);
  const LidarSight lidars(scenario, scene);
  const SlabSearch search(cameras, lidars, reference);
  const Slabs slabs = make_slabs(world.structure, floor_z_m);
  std::vector<SeenSurface> parts(slabs.faces.size());
  std::mutex progress;
  std::size_t done = 0;
  parallel_for(threads, parts.size(), [&](std::size_t slab) {
    parts[slab] =
        search.search(samples_of(world.structure, slabs, slab, floor_z_m, leaf_m, reference));
    const std::scoped_lock lock(progress);
    ++done;
    if (on_progress) on_progress(static_cast<double>(done) / static_cast<double>(parts.size()));
  });
  SeenSurface all;
  for (const SeenSurface& part : parts) {
    all.voxels.insert(all.voxels.end(), part.voxels.begin(), part.voxels.end());
    all.kept_world_m.insert(all.kept_world_m.end(), part.kept_world_m.begin(),
                            part.kept_world_m.end());
  }
  std::sort(all.voxels.begin(), all.voxels.end());  // those beside a slab are in two
  all.voxels.erase(std::unique(all.voxels.begin(), all.voxels.end()), all.voxels.end());
  return all;
}

}  // namespace gnbv
