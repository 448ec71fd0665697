#include "planner/tour/tour_task.hpp"

#include <algorithm>
#include <bit>

#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

constexpr std::uint32_t kNoItem = 0xffffffffU;
constexpr float kLeastVoxels = 0.25F;  // a patch that can be expected to bring less is left alone
constexpr float kSuccessMax = 0.98F;   // nothing is certain
constexpr std::uint8_t kViewsPerItem = 8;  // the search chooses among so many of the best

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
    const Patch& patch = k.patches[id];
    const float share = k.config.double_cover ? 1.0F : k.success.share(patch, 0);
    task.weight.push_back(patch.missing * share * static_cast<float>(one_in));
  }
  return item_of;
}

/// A view that may be in a tour.
struct Offer {
  double gain;
  TourView view;
  std::vector<ItemLook> looks;
};

std::vector<Offer> find_offers(const TourKnowledge& k, const PrizeTask& task,
                               const std::vector<std::uint32_t>& item_of) {
  const double least = 0.5 * task.price_per_m * k.config.metres_per_view;
  const bool certain = !k.config.double_cover;  // what it may miss is in the weight
  std::vector<Offer> offers;
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
        looks.push_back({item, std::min(kSuccessMax, certain ? 1.0F : share)});
        gain += static_cast<double>(task.weight[item] * looks.back().success);
      }
      if (looks.empty() || gain < least) continue;
      const ViewPose pose = k.catalogue.pose(k.places.p_world_m(place), heading);
      const auto is_pose = [&](const ViewPose& other) { return is_same_view(other, pose); };
      if (std::any_of(k.refused.begin(), k.refused.end(), is_pose)) continue;
      offers.push_back({gain, {place, pose}, looks});
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
      return view.place == offer.view.place && is_same_view(view.pose, offer.view.pose);
    });
    for (const ItemLook& look : offer.looks) {
      is_needed = is_needed || views_of[look.item] < kViewsPerItem;
    }
    if (!is_needed) return true;
    for (const ItemLook& look : offer.looks) {
      views_of[look.item] = std::min<std::uint8_t>(views_of[look.item] + 1, kViewsPerItem);
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

std::vector<std::uint8_t> seen_from_anywhere(const TourKnowledge& k) {
  std::vector<std::uint8_t> is_seen(k.patches.size(), 0);
  for (TourPlaces::Place place = 1; place < k.places.size(); ++place) {
    if (!k.places.is_reachable(place)) continue;
    for (int heading = 0; heading < k.catalogue.headings(); ++heading) {
      for (const SeenPatch& seen : k.catalogue.seen(place, heading)) is_seen[seen.patch] = 1;
    }
  }
  return is_seen;
}

double voxels_in_reach(const TourKnowledge& k) {
  const std::vector<std::uint8_t> is_seen = seen_from_anywhere(k);
  double sum = 0.0;
  for (PatchId id = 0; id < k.patches.size(); ++id) {
    const Patch& patch = k.patches[id];
    if (is_seen[id] != 0) sum += static_cast<double>(patch.missing * k.success.share(patch, 0));
  }
  return sum;
}

TourTask make_tour_task(const TourKnowledge& k, double price_per_m) {
  TourTask made;
  PrizeTask& task = made.prizes;
  task.start = TourPlaces::here();
  task.price_per_m = price_per_m;
  task.metres_per_view = k.config.metres_per_view;
  const std::vector<std::uint32_t> item_of = choose_items(k, task);
  std::vector<Offer> offers = find_offers(k, task, item_of);
  keep_best(k.tour, offers, task.weight.size());
  for (Offer& offer : offers) {
    task.looks.push_back(std::move(offer.looks));
    task.place.push_back(offer.view.place);
    made.views.push_back(offer.view);
  }
  return made;
}

}  // namespace gnbv
