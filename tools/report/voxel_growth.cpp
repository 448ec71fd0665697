#include "tools/report/voxel_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using VoxelKey = std::array<std::int16_t, 3>;

std::uint64_t code_of(const VoxelKey& key) {
  std::uint64_t code = 0;
  for (const std::int16_t k : key) code = code << 16U | static_cast<std::uint16_t>(k);
  return code;
}

/// Appends the gain of a voxel, `step` voxels beyond that of the gain before.
void add_gain(std::size_t step, std::uint32_t points, VoxelGrowth& growth) {
  constexpr std::size_t kStep = std::numeric_limits<std::uint16_t>::max();
  constexpr std::uint32_t kPoints = std::numeric_limits<std::uint8_t>::max();
  const auto add = [&](std::size_t by, std::uint32_t gained) {
    growth.gain_step.push_back(static_cast<std::uint16_t>(by));
    growth.gain_points.push_back(static_cast<std::uint8_t>(gained));
  };
  for (; step > kStep; step -= kStep) add(kStep, 0);
  for (; points > kPoints; points -= kPoints) {
    add(step, kPoints);
    step = 0;
  }
  add(step, points);
}

/// The voxels of points as they come.
class Growing {
 public:
  explicit Growing(double size_m) : size_m_(size_m) {}

  void add(const Vec3f& p_m) {
    VoxelKey key{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto p = static_cast<double>(p_m[static_cast<Eigen::Index>(a)]);
      const double k = std::floor(p / size_m_);
      GNBV_CHECK(std::abs(k) < 32768.0, "point at {} m in voxels of {} m", p, size_m_);
      key[a] = static_cast<std::int16_t>(k);
    }
    const auto [place, is_new] = place_.emplace(code_of(key), gained_.size());
    if (is_new) {
      out_.index.insert(out_.index.end(), key.begin(), key.end());
      gained_.push_back(0);
    }
    if (gained_[place->second]++ == 0) touched_.push_back(place->second);
  }

  void end_state() {
    std::sort(touched_.begin(), touched_.end());
    std::size_t before = 0;
    for (const std::size_t voxel : touched_) {
      add_gain(voxel - before, gained_[voxel], out_);
      gained_[voxel] = 0;
      before = voxel;
    }
    touched_.clear();
    out_.after.push_back(static_cast<std::uint32_t>(gained_.size()));
    out_.gains_after.push_back(static_cast<std::uint32_t>(out_.gain_step.size()));
  }

  VoxelGrowth take() { return std::move(out_); }

 private:
  double size_m_;
  std::unordered_map<std::uint64_t, std::size_t> place_;
  std::vector<std::uint32_t> gained_;  // by voxel, since the last state
  std::vector<std::size_t> touched_;   // the voxels that gained
  VoxelGrowth out_;
};

}  // namespace

std::size_t VoxelGrowth::bytes() const {
  return 2 * index.size() + 4 * after.size() + 2 * gain_step.size() + gain_points.size() +
         4 * gains_after.size();
}

VoxelGrowth voxel_growth(const RunCloud& cloud, double size_m) {
  std::vector<std::size_t> ends = {cloud.profile_points};
  ends.insert(ends.end(), cloud.view_points.begin(), cloud.view_points.end());
  ends.back() = cloud.points_world_m.size();
  Growing growing(size_m);
  std::size_t point = 0;
  for (const std::size_t end : ends) {
    for (; point < end; ++point) growing.add(cloud.points_world_m[point]);
    growing.end_state();
  }
  return growing.take();
}

}  // namespace gnbv
