#include "planner/tour/tour_problem.hpp"

#include <algorithm>
#include <bit>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoItem = 0xffffffffU;
constexpr float kLeastVoxels = 0.25F;  // a patch that can be expected to bring less is left alone
constexpr float kSuccessMax = 0.98F;   // nothing is certain
constexpr std::uint8_t kViewsPerItem = 8;  // the search chooses among so many of the best
// patches that the search weighs one by one: more of them double its time and gain nothing, since
// neighbours are seen by the same views
constexpr std::size_t kMostItems = 12000;

float expected_gain(const Patch& patch, const TourState& state) {
  return patch.missing * state.calibration.yield().share(patch, 0);
}

/// Gives the patches that matter their numbers and weights; all others kNoItem.
std::vector<std::uint32_t> choose_items(const TourConfig& config, const TourState& state,
                                        OrienteeringProblem& problem) {
  std::vector<PatchId> active;
  for (PatchId id = 0; id < state.patches.size(); ++id) {
    if (expected_gain(state.patches[id], state) >= kLeastVoxels) active.push_back(id);
  }
  const std::size_t one_in =
      std::max<std::size_t>(1, (active.size() + kMostItems - 1) / kMostItems);
  std::vector<std::uint32_t> item_of(state.patches.size(), kNoItem);
  for (const PatchId id : active) {
    if (one_in > 1 && mix_bits(id) % one_in != 0) continue;
    item_of[id] = static_cast<std::uint32_t>(problem.weight.size());
    const Patch& patch = state.patches[id];
    const float share = config.double_cover ? 1.0F : state.calibration.yield().share(patch, 0);
    problem.weight.push_back(patch.missing * share * static_cast<float>(one_in));
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
                               const std::vector<std::uint32_t>& item_of) {
  const double least = 0.5 * problem.cost_per_m * config.metres_per_view;
  const bool is_certain = !config.double_cover;  // what it may miss is in the weight
  std::vector<Offer> offers;
  std::vector<ItemObservation> observations;
  for (Roadmap::Node node = 1; node < state.roadmap.size(); ++node) {
    if (!state.roadmap.is_reachable(node)) continue;
    for (int heading = 0; heading < state.visibility.headings(); ++heading) {
      observations.clear();
      double gain = 0.0;
      for (const SeenPatch& seen : state.visibility.seen(node, heading)) {
        const std::uint32_t item = item_of[seen.patch];
        if (item == kNoItem) continue;
        const float share =
            state.calibration.yield().share(state.patches[seen.patch], seen.incidence);
        observations.push_back({item, std::min(kSuccessMax, is_certain ? 1.0F : share)});
        gain += static_cast<double>(problem.weight[item] * observations.back().success);
      }
      if (observations.empty() || gain < least) continue;
      const ViewPose pose = state.visibility.pose(state.roadmap.p_world_m(node), heading);
      const auto is_pose = [&](const ViewPose& other) { return is_same_view(other, pose); };
      if (std::any_of(state.refused.begin(), state.refused.end(), is_pose)) continue;
      offers.push_back({gain, {node, pose}, observations});
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
    bool is_needed = std::any_of(tour.begin(), tour.end(), [&](const TourView& view) {
      return view.node == offer.view.node && is_same_view(view.pose, offer.view.pose);
    });
    for (const ItemObservation& one : offer.observations) {
      is_needed = is_needed || views_of[one.item] < kViewsPerItem;
    }
    if (!is_needed) return true;
    for (const ItemObservation& one : offer.observations) {
      views_of[one.item] = std::min<std::uint8_t>(views_of[one.item] + 1, kViewsPerItem);
    }
    return false;
  });
}

}  // namespace

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

std::vector<std::uint8_t> seen_from_anywhere(const TourState& state) {
  std::vector<std::uint8_t> is_seen(state.patches.size(), 0);
  for (Roadmap::Node node = 1; node < state.roadmap.size(); ++node) {
    if (!state.roadmap.is_reachable(node)) continue;
    for (int heading = 0; heading < state.visibility.headings(); ++heading) {
      for (const SeenPatch& seen : state.visibility.seen(node, heading)) is_seen[seen.patch] = 1;
    }
  }
  return is_seen;
}

double voxels_in_reach(const TourState& state) {
  const std::vector<std::uint8_t> is_seen = seen_from_anywhere(state);
  double sum = 0.0;
  for (PatchId id = 0; id < state.patches.size(); ++id) {
    if (is_seen[id] != 0) sum += static_cast<double>(expected_gain(state.patches[id], state));
  }
  return sum;
}

TourProblem make_tour_problem(const TourConfig& config, const TourState& state, double cost_per_m) {
  TourProblem made;
  OrienteeringProblem& problem = made.problem;
  problem.start = Roadmap::here();
  problem.cost_per_m = cost_per_m;
  problem.metres_per_view = config.metres_per_view;
  const std::vector<std::uint32_t> item_of = choose_items(config, state, problem);
  std::vector<Offer> offers = find_offers(config, state, problem, item_of);
  keep_best(state.tour, offers, problem.weight.size());
  for (Offer& offer : offers) {
    problem.observations.push_back(std::move(offer.observations));
    problem.node.push_back(offer.view.node);
    made.views.push_back(offer.view);
  }
  return made;
}

}  // namespace gnbv
