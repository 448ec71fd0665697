#include "bench/score/coverage_curve.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

/// The voxels of a reference that no point has met yet: open addressing, at most half full.
class UnmetVoxels {
 public:
  UnmetVoxels(const VoxelSet& raw, const VoxelSet& outside)
      : shift_(64 - static_cast<int>(std::bit_width(2 * raw.size() + 1))),
        slots_(std::size_t{1} << (64 - shift_)) {
    auto next = outside.begin();
    for (const std::uint64_t code : raw) {
      const bool is_outside = next != outside.end() && *next == code;
      if (is_outside) ++next;
      Slot& slot = slots_[find(code)];
      slot = {code, is_outside ? kOutside : kHidden};
    }
    GNBV_CHECK(next == outside.end(), "voxel {} is outside and not in raw", *next);
  }

  enum State : std::uint8_t { kFree, kHidden, kOutside, kMet };

  /// What the voxel was until now; it is met from now on.
  State meet(std::uint64_t code) {
    Slot& slot = slots_[find(code)];
    const State was = slot.state;
    if (was != kFree) slot.state = kMet;
    return was;
  }

 private:
  struct Slot {
    std::uint64_t code = 0;
    State state = kFree;
  };

  /// The slot of the code, or the free one where it would be (Knuth's multiplicative hash).
  std::size_t find(std::uint64_t code) const {
    std::size_t i = (code * 0x9e3779b97f4a7c15ULL) >> shift_;
    while (slots_[i].state != kFree && slots_[i].code != code) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  int shift_;
  std::vector<Slot> slots_;
};

double share_of(std::size_t met, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(met) / static_cast<double>(all);
}

}  // namespace

std::vector<CoverageShares> coverage_of_prefixes(const SurfaceReference& reference,
                                                 std::span<const Vec3f> cloud_world_m,
                                                 std::span<const std::size_t> prefixes,
                                                 int threads) {
  GNBV_CHECK(std::is_sorted(prefixes.begin(), prefixes.end()), "prefixes shrink");
  GNBV_CHECK(prefixes.empty() || prefixes.back() <= cloud_world_m.size(), "{} of {} points",
             prefixes.back(), cloud_world_m.size());
  std::vector<CoverageShares> shares(prefixes.size());
  parallel_for(threads, kCoverageSizes_m.size(), [&](std::size_t size) {
    const VoxelSet& raw = reference.raw[size];
    const VoxelSet& outside = reference.outside[size];
    UnmetVoxels unmet(raw, outside);
    std::size_t met_hidden = 0;
    std::size_t met_outside = 0;
    std::size_t point = 0;
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      for (; point < prefixes[i]; ++point) {
        const auto was = unmet.meet(voxel_code(cloud_world_m[point], kCoverageSizes_m[size]));
        if (was == UnmetVoxels::kHidden) ++met_hidden;
        if (was == UnmetVoxels::kOutside) ++met_outside;
      }
      shares[i].raw[size] = share_of(met_hidden + met_outside, raw.size());
      shares[i].outside[size] = share_of(met_outside, outside.size());
    }
  });
  return shares;
}

double CoverageMeter::share_of(std::span<const Vec3f> cloud_world_m) {
  GNBV_CHECK(cloud_world_m.size() >= looked_at_, "a cloud shrank from {} to {} points", looked_at_,
             cloud_world_m.size());
  for (; looked_at_ < cloud_world_m.size(); ++looked_at_) {
    unmet_.erase(voxel_code(cloud_world_m[looked_at_], size_m_));
  }
  return gnbv::share_of(all_ - unmet_.size(), all_);
}

}  // namespace gnbv
