#include "tools/python/env_observation.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/plan.hpp"
#include "planner/guided/view_sampling.hpp"

namespace gnbv {
namespace {

std::vector<float> coarse_map(const OccupancyGrid& grid) {
  const Key& size = grid.geometry().size();
  const std::span<const VoxelWord> words = grid.words();
  const auto [cells_z, cells_y, cells_x] = kCoarseCells;
  const std::size_t cells = cells_z * cells_y * cells_x;
  std::vector<float> shares(3 * cells);
  const auto cell_of = [](std::int32_t i, std::int32_t n, std::size_t count) {
    return static_cast<std::size_t>(i) * count / static_cast<std::size_t>(n);
  };
  std::vector<std::size_t> column_of;
  for (std::int32_t x = 0; x < size[0]; ++x) column_of.push_back(cell_of(x, size[0], cells_x));
  std::size_t v = 0;
  for (std::int32_t z = 0; z < size[2]; ++z) {
    for (std::int32_t y = 0; y < size[1]; ++y) {
      const std::size_t row =
          (cell_of(z, size[2], cells_z) * cells_y + cell_of(y, size[1], cells_y)) * cells_x;
      for (const std::size_t column : column_of) {
        shares[static_cast<std::size_t>(state_of(words[v++])) * cells + row + column] += 1.0F;
      }
    }
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const float all = shares[cell] + shares[cells + cell] + shares[2 * cells + cell];
    for (std::size_t state = 0; state < 3; ++state) {
      if (all > 0.0F) shares[state * cells + cell] /= all;
    }
  }
  return shares;
}

float bounded(double value) { return static_cast<float>(std::clamp(value, -1.0, 1.0)); }

}  // namespace

std::vector<float> top_view(const OccupancyGrid& grid) {
  const Key& size = grid.geometry().size();
  const std::span<const VoxelWord> words = grid.words();
  const std::size_t columns = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  const auto levels = static_cast<float>(size[2]);
  std::vector<float> out(2 * columns);
  for (std::size_t c = 0; c < columns; ++c) out[2 * c] = -1.0F;
  for (std::size_t v = 0; v < words.size(); ++v) {
    float* const column = &out[2 * (v % columns)];
    const VoxelState state = state_of(words[v]);
    if (state == VoxelState::unknown) column[1] += 1.0F / levels;
    if (state == VoxelState::occupied) column[0] = static_cast<float>(v / columns) / levels;
  }
  return out;
}

std::vector<float> local_crop(const Belief& belief, const Vec3& at_world_m, int edge) {
  const OccupancyGrid& grid = belief.grid;
  const GridGeometry& geometry = grid.geometry();
  const Key center = geometry.key_of(at_world_m);
  const auto cells = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge) *
                     static_cast<std::size_t>(edge);
  std::vector<float> out(2 * cells);
  std::size_t cell = 0;
  for (std::int32_t z = 0; z < edge; ++z) {
    for (std::int32_t y = 0; y < edge; ++y) {
      for (std::int32_t x = 0; x < edge; ++x, ++cell) {
        const Key key = {center[0] + x - edge / 2, center[1] + y - edge / 2,
                         center[2] + z - edge / 2};
        out[cell] = 0.5F;
        if (!geometry.contains(key)) continue;
        const VoxelIndex v = geometry.index_of(key);
        out[cell] = 1.0F / (1.0F + std::exp(-grid.log_odds(v)));
        out[cells + cell] = bounded(belief.cloud.density(v) / belief.cloud.density_max());
      }
    }
  }
  return out;
}

std::size_t EnvObserver::candidate_count() const {
  std::size_t count = 0;
  for (const double scale : scales_) {
    count += sample_agvs(config_.agvs, {}, scale, model_.pitches_rad).size();
  }
  return count;
}

EnvObservation EnvObserver::observe(const Belief& belief, const ViewPose& current,
                                    double first_entropy_nat, bool with_candidates) {
  EnvObservation out{.map = coarse_map(belief.grid), .views = {}, .mask = {}, .candidates = {}};
  const Box3& box_m = model_.navigation_m;
  const Vec3 at = (current.p_world_m - box_m.min()).cwiseQuotient(box_m.sizes());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.pose[axis] = bounded(2.0 * at[static_cast<Eigen::Index>(axis)] - 1.0);
  }
  out.pose[3] = bounded(std::sin(current.yaw_rad));
  out.pose[4] = bounded(std::cos(current.yaw_rad));
  out.entropy_left = bounded(belief.grid.total_entropy_nat() / std::max(first_entropy_nat, 1e-9));
  if (with_candidates) add_candidates(belief, current, out);
  return out;
}

void EnvObserver::add_candidates(const Belief& belief, const ViewPose& current,
                                 EnvObservation& out) {
  ViewChecker checker(model_.validity_around, model_.navigation_m, model_.no_fly, belief.grid, {},
                      current);
  const double most_voxels = std::log1p(model_.view_voxels);
  const double reach_m = model_.navigation_m.diagonal().norm();
  const auto share = [&](double count) { return bounded(std::log1p(count) / most_voxels); };
  const ViewOptions options = {.sparse_below =
                                   config_.fvs.frontier.density_share * belief.cloud.density_max()};
  for (const double scale : scales_) {
    for (const ViewPose& view : sample_agvs(config_.agvs, current, scale, model_.pitches_rad)) {
      Candidate candidate{.view = view, .sampler = Sampler::agvs};
      check(checker, model_, candidate);
      const Vec3& p_m = view.p_world_m;
      out.views.insert(out.views.end(),
                       {p_m.x(), p_m.y(), p_m.z(), view.yaw_rad, view.gimbal_pitch_rad});
      out.mask.push_back(candidate.rejected ? 0 : 1);
      const std::size_t first = out.candidates.size();
      out.candidates.resize(first + kCandidateFeatures);
      if (candidate.rejected) continue;
      const ViewStats s =
          evaluate_view(belief.grid, belief.cloud, model_.rays_at(view.gimbal_pitch_rad), view,
                        scratch_.marks.front(), options);
      const double density = s.occupied_voxels == 0 ? 0.0 : s.density_sum / s.occupied_voxels;
      const std::array<float, kCandidateFeatures> features = {
          share(s.free_voxels),
          share(s.unknown_voxels),
          share(s.occupied_voxels),
          share(s.predicted_voxels),
          share(s.sparse_voxels),
          share(s.entropy_nat),
          bounded(density / belief.cloud.density_max()),
          bounded(candidate.path_m / reach_m)};
      std::copy(features.begin(), features.end(),
                out.candidates.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }
}

}  // namespace gnbv
