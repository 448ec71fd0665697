#include "tools/render/frontier_items.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tools/render/flight_items.hpp"
#include "tools/render/lettering.hpp"
#include "tools/render/voxel_items.hpp"

namespace gnbv {

const FrontierLook kFrontierLook = {
    .frontier = srgb(0x56b4e9), .looked_at = srgb(0x0b5fa5), .layer = srgb(0x8a9fc0)};

namespace {

// Rings through the views around a cluster that stand in one layer (Fig. 6), as far as they lie
// within the bounds.
void add_layers(const Plan& plan, std::span<const FrontierCluster> clusters, double unit_m,
                RenderScene& scene) {
  using Layer = std::pair<int, long>;  // cluster, and millimetre of height
  std::map<Layer, std::vector<const Candidate*>> layers;
  for (const Candidate& candidate : plan.candidates) {
    if (candidate.cluster < 0) continue;
    layers[{candidate.cluster, std::lround(1000.0 * candidate.view.p_world_m.z())}].push_back(
        &candidate);
  }
  for (auto& [layer, views] : layers) {
    const auto cluster = static_cast<std::size_t>(layer.first);
    if (cluster >= clusters.size() || views.size() < 3) continue;
    const Vec3& centre_m = clusters[cluster].centroid_world_m;
    const auto angle_rad = [&](const Candidate* candidate) {
      const Vec3 away_m = candidate->view.p_world_m - centre_m;
      return std::atan2(away_m.y(), away_m.x());
    };
    std::sort(views.begin(), views.end(),
              [&](const Candidate* a, const Candidate* b) { return angle_rad(a) < angle_rad(b); });
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Candidate& a = *views[i];
      const Candidate& b = *views[(i + 1) % views.size()];
      const bool is_beyond =
          a.rejected == Rejection::out_of_bounds || b.rejected == Rejection::out_of_bounds;
      if (is_beyond) continue;
      scene.tubes.push_back(
          path_tube({a.view.p_world_m, b.view.p_world_m}, 0.5 * unit_m, kFrontierLook.layer));
    }
  }
}

// The numbers that can be read there: the first label before all others, then in their order.
std::vector<PlaceLabel> legible(const std::vector<PlaceLabel>& labels, const OccupancyGrid& grid,
                                const RenderView& view) {
  const double apart_px = 30.0 * layout_unit_px(view.width_px, view.height_px);
  std::vector<PlaceLabel> shown;
  std::vector<Vec3> places_px;
  for (const PlaceLabel& label : labels) {
    const std::optional<Vec3> px = project(view, label.p_world_m);
    // a frontier's centroid may lie within the surface
    if (!px || is_hidden(grid, view, label.p_world_m, 3.0 * grid.geometry().resolution_m()))
      continue;
    const bool has_room = std::all_of(places_px.begin(), places_px.end(), [&](const Vec3& other) {
      return (*px - other).head<2>().norm() >= apart_px;
    });
    if (!has_room) continue;
    places_px.push_back(*px);
    shown.push_back(label);
  }
  return shown;
}

}  // namespace

void add_frontiers(const FrontierConfig& config, const ReplayedDecision& decision, double unit_m,
                   const RenderView& view, Panel& panel) {
  RenderScene& scene = panel.scene;
  const Belief& belief = decision.belief;
  FrontierMarks marks(belief.grid.geometry().voxel_count());
  // those that could be tried, by their numbers, then the others
  std::vector<FrontierCluster> clusters = decision.plan.clusters;
  std::set<VoxelIndex> numbered;
  for (const FrontierCluster& cluster : clusters) numbered.insert(cluster.voxels.front());
  for (FrontierCluster& cluster : find_frontiers(config, belief.grid, belief.cloud, marks)) {
    if (!numbered.contains(cluster.voxels.front())) clusters.push_back(std::move(cluster));
  }
  const int chosen = decision.plan.chosen.empty()
                         ? -1
                         : decision.plan.candidates[decision.plan.chosen.front()].cluster;
  int tried = -1;
  for (const Candidate& candidate : decision.plan.candidates) {
    tried = std::max(tried, candidate.cluster);
  }
  std::vector<PlaceLabel> labels;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool is_chosen = static_cast<int>(i) == chosen;
    const std::vector<Rgb> colour = {is_chosen ? kFrontierLook.looked_at : kFrontierLook.frontier};
    // a hair larger than the map's own cubes, which may be as large as their voxels
    constexpr double kOver = 1.02;
    scene.surfaces.push_back(
        voxel_cubes(belief.grid.geometry(), clusters[i].voxels, colour, kOver));
    if (static_cast<int>(i) > tried) continue;
    const Vec3& centre_m = clusters[i].centroid_world_m;
    scene.balls.push_back({centre_m.cast<float>(),
                           static_cast<float>((is_chosen ? 6.0 : 4.5) * unit_m), colour.front()});
    const PlaceLabel label{centre_m, fmt::format("{}", i + 1), to_rgb8(kFrontierLook.looked_at),
                           true};
    labels.insert(is_chosen ? labels.begin() : labels.end(), label);
  }
  panel.labels = legible(labels, belief.grid, view);
  add_layers(decision.plan, clusters, unit_m, scene);
}

}  // namespace gnbv
