#include <algorithm>
#include <limits>
#include <numeric>

#include "tools/exports/formats.hpp"

namespace gnbv {
namespace {

struct ColouredSighting {
  std::uint32_t point = 0;
  Sighting at;
  Rgb8 rgb{};
};

std::vector<Vec3f> thinned(std::span<const Vec3f> points_world_m, std::size_t max_points) {
  const std::size_t every = points_world_m.empty() ? 1
                                                   : 1 + (points_world_m.size() - 1) /
                                                             std::max<std::size_t>(max_points, 1);
  std::vector<Vec3f> kept;
  for (std::size_t i = 0; i < points_world_m.size(); i += every) kept.push_back(points_world_m[i]);
  return kept;
}

std::vector<ColouredSighting> sightings_of(const std::vector<Vec3f>& points_world_m,
                                           const FrameSight& sight, double blur_m) {
  std::vector<ColouredSighting> seen;
  for (std::uint32_t i = 0; i < points_world_m.size(); ++i) {
    const auto at = sight.sees(points_world_m[i].cast<double>(), blur_m);
    if (at) seen.push_back({i, *at, sight.colour_at(*at)});
  }
  return seen;
}

}  // namespace

std::size_t SparseModel::observation_count() const {
  return std::accumulate(
      observations.begin(), observations.end(), std::size_t{0},
      [](std::size_t sum, const auto& of_frame) { return sum + of_frame.size(); });
}

SparseModel make_sparse_model(std::span<const Vec3f> points_world_m, const FrameRecord& frames,
                              const SparseModelOptions& options) {
  constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();
  const std::vector<Vec3f> candidates = thinned(points_world_m, options.max_points);
  std::vector<std::vector<ColouredSighting>> seen(frames.frames.size());
  for_each_frame(frames, options.threads, options.progress,
                 [&](std::size_t frame, const FrameSight& sight) {
                   seen[frame] = sightings_of(candidates, sight, options.blur_m);
                 });

  std::vector<std::uint32_t> times_seen(candidates.size(), 0);
  std::vector<double> nearest_m(candidates.size(), std::numeric_limits<double>::infinity());
  std::vector<Rgb8> colours(candidates.size());
  for (const auto& of_frame : seen) {
    for (const ColouredSighting& s : of_frame) {
      ++times_seen[s.point];
      if (s.at.z_m >= nearest_m[s.point]) continue;
      nearest_m[s.point] = s.at.z_m;
      colours[s.point] = s.rgb;
    }
  }

  SparseModel model;
  std::vector<std::uint32_t> number(candidates.size(), kLeftOut);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (times_seen[i] < 2) continue;
    number[i] = static_cast<std::uint32_t>(model.points_world_m.size());
    model.points_world_m.push_back(candidates[i]);
    model.colours.push_back(colours[i]);
  }
  model.observations.resize(frames.frames.size());
  for (std::size_t frame = 0; frame < seen.size(); ++frame) {
    for (const ColouredSighting& s : seen[frame]) {
      if (number[s.point] == kLeftOut) continue;
      model.observations[frame].push_back({number[s.point], s.at.u_px, s.at.v_px});
    }
  }
  return model;
}

}  // namespace gnbv
