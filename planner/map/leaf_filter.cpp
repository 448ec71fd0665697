#include "planner/map/leaf_filter.hpp"

#include <algorithm>

#include "sim/core/rng.hpp"

namespace gnbv {

void LeafSums::reset() {
  std::fill(slots_.begin(), slots_.end(), kEmpty);
  sums_.clear();
  last_ = kEmpty;
}

std::uint32_t& LeafSums::slot_of(const LeafKey& leaf) {
  const auto bits = [&](std::size_t a) { return std::uint64_t{leaf[a] & 0x1fffffU}; };
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = mix_bits(bits(0) | bits(1) << 21 | bits(2) << 42) & mask;
  while (slots_[slot] != kEmpty && sums_[slots_[slot]].leaf != leaf) slot = (slot + 1) & mask;
  return slots_[slot];
}

void LeafSums::add(const LeafKey& leaf, const Vec3f& p_m) {
  constexpr std::size_t kFewestSlots = 4096;
  if (last_ == kEmpty || sums_[last_].leaf != leaf) {
    if (2 * (sums_.size() + 1) > slots_.size()) {
      slots_.assign(std::max(kFewestSlots, 2 * slots_.size()), kEmpty);
      for (std::uint32_t i = 0; i < sums_.size(); ++i) slot_of(sums_[i].leaf) = i;
    }
    std::uint32_t& slot = slot_of(leaf);
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(sums_.size());
      sums_.push_back({leaf, 0, Vec3::Zero()});
    }
    last_ = slot;
  }
  sums_[last_].count += 1;
  sums_[last_].sum_m += p_m.cast<double>();
}

std::vector<Vec3f> LeafSums::centroids_m() const {
  std::vector<Vec3f> centroids(size());
  for (std::size_t i = 0; i < size(); ++i) centroids[i] = centroid_m(i);
  return centroids;
}

std::vector<Vec3f> leaf_filter(std::span<const Vec3f> points_m, double leaf_m) {
  const LeafLattice lattice(leaf_m);
  LeafSums sums;
  for (const Vec3f& p_m : points_m) sums.add(lattice.key_of(p_m), p_m);
  return sums.centroids_m();
}

}  // namespace gnbv
