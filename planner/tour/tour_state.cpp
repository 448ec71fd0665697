#include "planner/tour/tour_state.hpp"

#include <algorithm>
#include <bit>

#include "planner/core/belief.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoItem = 0xffffffffU;
constexpr float kLeastVoxels = 0.25F;  // a patch that can be expected to bring less is left alone
constexpr float kSuccessMax = 0.98F;   // nothing is certain
constexpr std::uint8_t kViewsPerItem = 8;  // the search chooses among so many of the best
// patches that the search weighs one by one: more of them double its time and gain nothing, since
// neighbours are seen by the same views
constexpr std::size_t kMostItems = 12000;
constexpr std::size_t kMostTimedItems = 4000;  // a search in seconds asks more often

/// Gives the patches that matter their numbers and weights; all others kNoItem.
std::vector<std::uint32_t> choose_items(const TourConfig& config, const TourState& state,
                                        OrienteeringProblem& problem) {
  const ObservationYield& yield = state.calibration.yield();
  std::vector<PatchId> active;
  for (PatchId id = 0; id < state.patches.size(); ++id) {
    if (yield.face_on_gain(state.patches[id]) >= kLeastVoxels) active.push_back(id);
  }
  const std::size_t most = config.cost == TourCost::seconds ? kMostTimedItems : kMostItems;
  const std::size_t one_in = std::max<std::size_t>(1, (active.size() + most - 1) / most);
  std::vector<std::uint32_t> item_of(state.patches.size(), kNoItem);
  for (const PatchId id : active) {
    if (one_in > 1 && mix_bits(id) % one_in != 0) continue;
    item_of[id] = static_cast<std::uint32_t>(problem.weight.size());
    const Patch& patch = state.patches[id];
    const float worth = config.double_cover ? patch.missing : yield.face_on_gain(patch);
    problem.weight.push_back(worth * static_cast<float>(one_in));
  }
  return item_of;
}

/// A view that may be in a tour.
struct Offer {
  double gain;
  TourView view;
  std::vector<ItemObservation> observations;
};

std::vector<Offer> find_offers(const TourConfig& config, const TourState& state,
                               const OrienteeringProblem& problem,
                               const std::vector<std::uint32_t>& item_of, const HeedStop& stop) {
  const double least = 0.5 * problem.price * problem.way_per_view;
  std::vector<Offer> offers;
  std::vector<ItemObservation> observations;
  for (const Roadmap::Node node : state.roadmap.reachable()) {
    heed(stop);
    for (int heading = 0; heading < state.visibility.headings(); ++heading) {
      observations.clear();
      double gain = 0.0;
      for (const SeenPatch& seen : state.visibility.seen(node, heading)) {
        const std::uint32_t item = item_of[seen.patch];
        if (item == kNoItem) continue;
        // without a double cover, what it may miss is in the weight
        const float share = config.double_cover
                                ? state.calibration.yield().share(state.patches[seen.patch], seen)
                                : 1.0F;
        observations.push_back({item, std::min(kSuccessMax, share)});
        gain += problem.weight[item] * observations.back().success;
      }
      if (observations.empty() || gain < least) continue;
      const ViewPose pose = state.visibility.pose(state.roadmap.p_world_m(node), heading);
      if (!state.is_refused(pose)) offers.push_back({gain, {node, pose}, observations});
    }
  }
  return offers;
}

/// Of the views that see an item those that bring the most, and the tour's; what sees only items
/// that many better views see is left out.
void keep_best(std::span<const TourView> tour, std::vector<Offer>& offers, std::size_t items) {
  std::stable_sort(offers.begin(), offers.end(),
                   [](const Offer& a, const Offer& b) { return a.gain > b.gain; });
  std::vector<std::uint8_t> views_of(items, 0);
  std::erase_if(offers, [&](const Offer& offer) {
    const bool is_needed =
        std::find(tour.begin(), tour.end(), offer.view) != tour.end() ||
        std::any_of(offer.observations.begin(), offer.observations.end(),
                    [&](const auto& one) { return views_of[one.item] < kViewsPerItem; });
    for (const ItemObservation& one : offer.observations) {
      if (is_needed && views_of[one.item] < kViewsPerItem) ++views_of[one.item];
    }
    return !is_needed;
  });
}

}  // namespace

TourState::TourState(const TourConfig& config, const PlannerModel& model)
    : cells(model.workspace_m, config.detail_m),
      calibration(config.detail_m),
      space(model.geometry(), model.navigation_m, model.no_fly, model.validity.collision_radius_m),
      roadmap(model.geometry(), model.navigation_m,
              config.lattice_step_m > 0.0 ? config.lattice_step_m
                                          : automatic_step_m(model.sights, model.navigation_m)),
      visibility(config, model.sights, model.pitches_rad, model.workspace_m) {}

bool TourState::is_refused(const ViewPose& pose) const {
  return std::any_of(refused.begin(), refused.end(),
                     [&](const ViewPose& other) { return is_same_view(other, pose); });
}

std::vector<std::uint8_t> TourState::seen_from_anywhere() const {
  std::vector<std::uint8_t> is_seen(patches.size(), 0);
  for (const Roadmap::Node node : roadmap.reachable()) {
    for (int heading = 0; heading < visibility.headings(); ++heading) {
      for (const SeenPatch& seen : visibility.seen(node, heading)) is_seen[seen.patch] = 1;
    }
  }
  return is_seen;
}

double TourState::voxels_in_reach() const {
  const std::vector<std::uint8_t> is_seen = seen_from_anywhere();
  double sum = 0.0;
  for (PatchId id = 0; id < patches.size(); ++id) {
    if (is_seen[id] != 0) sum += calibration.yield().face_on_gain(patches[id]);
  }
  return sum;
}

double ExpectedSurface::voxels_a_metre() const {
  return box_m.isEmpty() ? 0.0 : voxels / (2.0 * box_m.sizes().sum());
}

ExpectedSurface expected_surface(const SurfaceCells& cells) {
  ExpectedSurface surface;
  const Vec3 half_m = Vec3::Constant(0.5 * cells.edge_m());
  for (const SurfaceCell& cell : cells.cells()) {
    if (cell.expected == 0) continue;
    surface.voxels += std::popcount(cell.expected);
    const Vec3 center_m = cells.lattice().center_m(cell.key);
    surface.box_m.extend(Box3(center_m - half_m, center_m + half_m));
  }
  return surface;
}

TourProblem make_tour_problem(const TourConfig& config, const TourState& state, double price,
                              const HeedStop& stop) {
  TourProblem made;
  OrienteeringProblem& problem = made.problem;
  problem.start = Roadmap::here();
  problem.price = price;
  problem.way_per_view =
      config.cost == TourCost::seconds ? config.seconds_per_view : config.metres_per_view;
  const std::vector<std::uint32_t> item_of = choose_items(config, state, problem);
  std::vector<Offer> offers = find_offers(config, state, problem, item_of, stop);
  keep_best(state.tour, offers, problem.weight.size());
  for (Offer& offer : offers) {
    problem.observations.push_back(std::move(offer.observations));
    problem.node.push_back(offer.view.node);
    made.views.push_back(offer.view);
  }
  return made;
}

double automatic_step_m(std::span<const CameraModel> cameras, const Box3& navigation_m) {
  double range_m = 0.0;
  for (const CameraModel& camera : cameras)
    range_m = std::max(range_m, return_end_m(camera.config));
  const Vec3 size_m = navigation_m.sizes();
  double step_m = std::min(0.25 * range_m, size_m.head<2>().minCoeff() / 8.0);
  while ((size_m / step_m + Vec3::Ones()).prod() > kMostAutomaticNodes) step_m *= 1.1;
  return step_m;
}

double tour_bytes(const TourConfig& config, const Box3& workspace_m, double resolution_m) {
  constexpr double kVoxel_bytes = 5.125;  // OpenSpace
  constexpr double kCell_bytes = 4.0;     // SurfaceCells
  const auto count = [&](double edge_m) {
    return (workspace_m.sizes() / edge_m + Vec3::Ones()).prod();
  };
  return kVoxel_bytes * count(resolution_m) +
         kCell_bytes * count(SurfaceCell::kSide * config.detail_m);
}

}  // namespace gnbv
