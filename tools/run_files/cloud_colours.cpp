#include "tools/run_files/cloud_colours.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gnbv {

double cloud_blur_m(const RunRecord& record) { return 0.5 * record.scenario.planner.cloud.leaf_m; }

CloudColours::CloudColours(const RunRecord& record, const RunCloud& cloud,
                           const FrameRecord& frames, std::span<const std::size_t> points)
    : record_(record),
      cloud_(cloud),
      frames_(frames),
      points_(points),
      blur_m_(cloud_blur_m(record)),
      seen_(frames.frames.size()) {}

void CloudColours::look(std::size_t frame, const FrameSight& sight) {
  // points [begin, end) of the cloud, as far as they are asked for
  const auto look_at = [&](std::size_t begin, std::size_t end) {
    auto i = std::lower_bound(points_.begin(), points_.end(), begin);
    for (; i != points_.end() && *i < end; ++i) {
      const auto at = sight.sees(cloud_.points_world_m[*i].cast<double>(), blur_m_);
      if (!at) continue;
      const auto point = static_cast<std::size_t>(i - points_.begin());
      seen_[frame].push_back({point, at->z_m, sight.colour_at(*at)});
    }
  };
  const std::vector<std::size_t>& ends = cloud_.view_points;
  look_at(0, cloud_.profile_points);
  look_at(ends.empty() ? cloud_.profile_points : ends.back(), cloud_.points_world_m.size());
  for (std::size_t view = 0; view < ends.size(); ++view) {
    if (record_.views[view].iteration != frames_.frames[frame].iteration) continue;
    look_at(view == 0 ? cloud_.profile_points : ends[view - 1], ends[view]);
  }
}

std::vector<Rgb8> CloudColours::colours(const Rgb8& unseen) const {
  std::vector<Rgb8> colours(points_.size(), unseen);
  std::vector<double> nearest_m(points_.size(), std::numeric_limits<double>::infinity());
  for (const auto& of_frame : seen_) {
    for (const Seen& s : of_frame) {
      if (s.z_m >= nearest_m[s.point]) continue;
      nearest_m[s.point] = s.z_m;
      colours[s.point] = s.rgb;
    }
  }
  return colours;
}

std::vector<Rgb8> colours_of_cloud(const RunRecord& record, const RunCloud& cloud,
                                   const FrameRecord& frames, int threads,
                                   const ShareDone& progress) {
  std::vector<std::size_t> all(cloud.points_world_m.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  CloudColours colours(record, cloud, frames, all);
  for_each_frame(frames, threads, progress,
                 [&](std::size_t frame, const FrameSight& sight) { colours.look(frame, sight); });
  return colours.colours(kNoColour);
}

}  // namespace gnbv
