#include "tools/run_files/cloud_colours.hpp"

#include <limits>

namespace gnbv {
namespace {

struct ColouredPoint {
  std::size_t point = 0;
  double z_m = 0.0;
  Rgb8 rgb{};
};

/// The points [begin, end) of the cloud.
void look_at(const RunCloud& cloud, std::size_t begin, std::size_t end, const FrameSight& sight,
             double blur_m, std::vector<ColouredPoint>& seen) {
  for (std::size_t i = begin; i < end; ++i) {
    const auto at = sight.sees(cloud.points_world_m[i].cast<double>(), blur_m);
    if (at) seen.push_back({i, at->z_m, sight.colour_at(*at)});
  }
}

}  // namespace

std::vector<Rgb8> colours_of_cloud(const RunRecord& record, const RunCloud& cloud,
                                   const FrameRecord& frames, double blur_m, int threads,
                                   const ShareDone& progress) {
  std::vector<std::vector<ColouredPoint>> seen(frames.frames.size());
  for_each_frame(frames, threads, progress, [&](std::size_t frame, const FrameSight& sight) {
    const std::size_t by_views =
        cloud.view_points.empty() ? cloud.profile_points : cloud.view_points.back();
    look_at(cloud, 0, cloud.profile_points, sight, blur_m, seen[frame]);
    look_at(cloud, by_views, cloud.points_world_m.size(), sight, blur_m, seen[frame]);
    for (std::size_t view = 0; view < record.views.size(); ++view) {
      if (record.views[view].iteration != frames.frames[frame].iteration) continue;
      const std::size_t begin = view == 0 ? cloud.profile_points : cloud.view_points[view - 1];
      look_at(cloud, begin, cloud.view_points[view], sight, blur_m, seen[frame]);
    }
  });
  std::vector<Rgb8> colours(cloud.points_world_m.size(), kNoColour);
  std::vector<double> nearest_m(colours.size(), std::numeric_limits<double>::infinity());
  for (const auto& of_frame : seen) {
    for (const ColouredPoint& s : of_frame) {
      if (s.z_m >= nearest_m[s.point]) continue;
      nearest_m[s.point] = s.z_m;
      colours[s.point] = s.rgb;
    }
  }
  return colours;
}

}  // namespace gnbv
