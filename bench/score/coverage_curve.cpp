#include "bench/score/coverage_curve.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

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
                                                 std::span<const std::size_t> prefixes, int threads,
                                                 std::span<const double> distances_m,
                                                 double reach_m) {
  GNBV_CHECK(std::is_sorted(prefixes.begin(), prefixes.end()), "prefixes shrink");
  GNBV_CHECK(prefixes.empty() || prefixes.back() <= cloud_world_m.size(), "{} of {} points",
             prefixes.back(), cloud_world_m.size());
  GNBV_CHECK(distances_m.empty() || distances_m.size() == cloud_world_m.size(),
             "{} distances of {} points", distances_m.size(), cloud_world_m.size());
  std::vector<CoverageShares> shares(prefixes.size());
  parallel_for(threads, kCoverageSizes_m.size(), [&](std::size_t size) {
    const VoxelSet& raw = reference.raw[size];
    const VoxelSet& counted = reference.counted[size];
    const double accurate_m = kAccurateShare * kCoverageSizes_m[size];
    struct Kinds {
      bool is_raw = false, is_counted = false, is_accurate = false;
    };
    std::unordered_map<std::uint64_t, Kinds> unmet;  // by no point yet
    unmet.reserve(raw.size());
    for (const std::uint64_t code : raw) unmet[code].is_raw = true;
    for (const std::uint64_t code : counted) {
      Kinds& kinds = unmet[code];
      kinds.is_counted = kinds.is_accurate = true;
    }
    std::size_t met_raw = 0, met_counted = 0, met_accurate = 0;
    std::size_t point = 0;
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      for (; point < prefixes[i]; ++point) {
        const bool is_near = distances_m.empty() || distances_m[point] <= accurate_m;
        for (const std::uint64_t code : covered_by(cloud_world_m[point], size, reach_m)) {
          const auto found = unmet.find(code);
          if (found == unmet.end()) continue;
          Kinds& kinds = found->second;
          met_raw += std::exchange(kinds.is_raw, false) ? 1 : 0;
          met_counted += std::exchange(kinds.is_counted, false) ? 1 : 0;
          met_accurate += is_near && kinds.is_accurate ? 1 : 0;
          if (is_near || !kinds.is_accurate) unmet.erase(found);
        }
      }
      shares[i].raw[size] = share_of(met_raw, raw.size());
      shares[i].counted[size] = share_of(met_counted, counted.size());
      shares[i].accurate[size] = share_of(met_accurate, counted.size());
    }
  });
  return shares;
}

double CoverageMeter::share_of(std::span<const Vec3f> cloud_world_m) {
  GNBV_CHECK(cloud_world_m.size() >= looked_at_, "a cloud shrank from {} to {} points", looked_at_,
             cloud_world_m.size());
  for (; looked_at_ < cloud_world_m.size(); ++looked_at_) {
    for (const std::uint64_t code : covered_by(cloud_world_m[looked_at_], size_)) {
      unmet_.erase(code);
    }
  }
  return gnbv::share_of(all_ - unmet_.size(), all_);
}

}  // namespace gnbv
