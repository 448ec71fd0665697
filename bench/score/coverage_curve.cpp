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
    const VoxelSet& outside = reference.outside[size];
    GNBV_CHECK(std::includes(raw.begin(), raw.end(), outside.begin(), outside.end()),
               "a voxel is outside and not in raw");
    std::unordered_map<std::uint64_t, bool> unmet;  // by no point yet; whether it is outside
    unmet.reserve(raw.size());
    for (const std::uint64_t code : raw) unmet.emplace(code, false);
    for (const std::uint64_t code : outside) unmet[code] = true;
    std::size_t met_outside = 0;
    std::size_t point = 0;
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      for (; point < prefixes[i]; ++point) {
        const auto found = unmet.find(voxel_code(cloud_world_m[point], kCoverageSizes_m[size]));
        if (found == unmet.end()) continue;
        met_outside += found->second ? 1 : 0;
        unmet.erase(found);
      }
      shares[i].raw[size] = share_of(raw.size() - unmet.size(), raw.size());
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
