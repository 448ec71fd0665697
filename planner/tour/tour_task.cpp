#include "planner/tour/tour_task.hpp"

#include <algorithm>
#include <bit>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoItem = 0xffffffffU;
constexpr float kLeastVoxels = 0.25F;  // a patch that can be expected to bring less is left alone
constexpr float kSuccessMax = 0.98F;   // nothing is certain

/// Gives the patches that matter their numbers and weights; all others kNoItem.
std::vector<std::uint32_t> choose_items(const TourKnowledge& k, PrizeTask& task) {
  std::vector<PatchId> active;
  for (PatchId id = 0; id < k.patches.size(); ++id) {
    const Patch& patch = k.patches[id];
    if (patch.missing * k.success.share(patch, 0) >= kLeastVoxels) active.push_back(id);
  }
  const auto most = static_cast<std::size_t>(k.config.items_max);
  const std::size_t one_in = std::max<std::size_t>(1, (active.size() + most - 1) / most);
  std::vector<std::uint32_t> item_of(k.patches.size(), kNoItem);
  for (const PatchId id : active) {
    if (one_in > 1 && mix_bits(id) % one_in != 0) continue;
    item_of[id] = static_cast<std::uint32_t>(task.weight.size());
    task.weight.push_back(k.patches[id].missing * static_cast<float>(one_in));
  }
  return item_of;
}

}  // namespace

double expected_voxels(const SurfaceCells& cells) {
  double sum = 0.0;
  for (const SurfaceCell& cell : cells.cells()) sum += std::popcount(cell.expected);
  return sum;
}

double voxels_in_reach(const TourKnowledge& knowledge) {
  double sum = 0.0;
  for (const Patch& patch : knowledge.patches) {
    sum += static_cast<double>(patch.missing * knowledge.success.share(patch, 0));
  }
  return sum;
}

TourTask make_tour_task(const TourKnowledge& k, double price_factor) {
  TourTask made;
  PrizeTask& task = made.prizes;
  task.start = TourPlaces::here();
  task.price_per_m = k.config.price_per_m * expected_voxels(k.cells) * price_factor;
  task.metres_per_view = k.config.metres_per_view;
  const std::vector<std::uint32_t> item_of = choose_items(k, task);
  const double least = 0.5 * task.price_per_m * k.config.metres_per_view;
  std::vector<ItemLook> looks;
  for (TourPlaces::Place place = 1; place < k.places.size(); ++place) {
    if (!k.places.is_reachable(place)) continue;
    for (int heading = 0; heading < k.catalogue.headings(); ++heading) {
      looks.clear();
      double gain = 0.0;
      for (const SeenPatch& seen : k.catalogue.seen(place, heading)) {
        const std::uint32_t item = item_of[seen.patch];
        if (item == kNoItem) continue;
        const float share = k.success.share(k.patches[seen.patch], seen.incidence);
        looks.push_back({item, std::min(kSuccessMax, share)});
        gain += static_cast<double>(task.weight[item] * looks.back().success);
      }
      if (looks.empty() || gain < least) continue;
      task.looks.push_back(looks);
      task.place.push_back(place);
      made.views.push_back({place, k.catalogue.pose(k.places.p_world_m(place), heading)});
    }
  }
  return made;
}

}  // namespace gnbv
