#include "bench/score/coverage_curve.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

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
    const VoxelSet& counted = reference.counted[size];
    struct Kinds {
      bool is_raw = false, is_counted = false;
    };
    std::unordered_map<std::uint64_t, Kinds> unmet;  // by no point yet
    unmet.reserve(raw.size());
    for (const std::uint64_t code : raw) unmet[code].is_raw = true;
    for (const std::uint64_t code : counted) unmet[code].is_counted = true;
    std::size_t met_raw = 0;
    std::size_t met_counted = 0;
    std::size_t point = 0;
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      for (; point < prefixes[i]; ++point) {
        const auto found = unmet.find(voxel_code(cloud_world_m[point], kCoverageSizes_m[size]));
        if (found == unmet.end()) continue;
        met_raw += found->second.is_raw ? 1 : 0;
        met_counted += found->second.is_counted ? 1 : 0;
        unmet.erase(found);
      }
      shares[i].raw[size] = share_of(met_raw, raw.size());
      shares[i].counted[size] = share_of(met_counted, counted.size());
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
