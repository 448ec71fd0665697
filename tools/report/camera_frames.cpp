#include "tools/report/camera_frames.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"
#include "tools/report/jpeg.hpp"

namespace gnbv {
namespace {

constexpr int kThumbnailWidth_px = 320;
constexpr int kJpegQuality = 72;
constexpr Rgb8 kNoColour = {150, 156, 164};
constexpr float kNear_m = 0.2F;
constexpr std::size_t kFramesAtOnce = 64;  // read between two steps of the progress bar

/// Of a point in the world, if the camera has it in its picture.
std::optional<Rgb8> colour_in(const Image& image, const FrameCamera& camera,
                              const Isometry& T_camera_world, const Vec3f& p_world_m) {
  const Vec3 p = T_camera_world * p_world_m.cast<double>();
  if (p.z() <= 0.0) return std::nullopt;
  const Eigen::Vector2d px = pixel_of(camera, p);
  const bool is_inside =
      px.minCoeff() >= 0.0 && px.x() < image.width_px && px.y() < image.height_px;
  if (!is_inside) return std::nullopt;
  return image.at(static_cast<int>(px.x()), static_cast<int>(px.y()));
}

/// The points asked for that a view brought: a range of `points`.
struct PointRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

PointRange points_of_view(const RunCloud& cloud, std::span<const std::size_t> points, int view) {
  const auto i = static_cast<std::size_t>(view);
  if (i >= cloud.view_points.size()) return {};
  const std::size_t before = i == 0 ? cloud.profile_points : cloud.view_points[i - 1];
  const auto at = [&](std::size_t point) {
    return static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), point) -
                                    points.begin());
  };
  return {at(before), at(cloud.view_points[i])};
}

/// What one frame gives.
struct FrameYield {
  Thumbnail thumbnail;
  PointRange range;
  std::vector<std::optional<Rgb8>> colours;  // of the range
};

FrameYield read_frame(const FrameRecord& frames, std::size_t index, const RunCloud& cloud,
                      std::span<const std::size_t> points) {
  const RecordedFrame& frame = frames.frames[index];
  const FrameCamera& camera = frames.cameras[frame.camera];
  const Image image = read_colour(frames, index);
  const Image small = shrunk(image, std::max(1, image.width_px / kThumbnailWidth_px));
  FrameYield yield{
      .thumbnail = {index, small.width_px, small.height_px, jpeg_bytes(small, kJpegQuality)},
      .range = points_of_view(cloud, points, frame.iteration),
      .colours = {}};
  const Isometry T_camera_world = frame.T_world_camera.inverse();
  for (std::size_t i = yield.range.begin; i < yield.range.end; ++i) {
    yield.colours.push_back(
        colour_in(image, camera, T_camera_world, cloud.points_world_m[points[i]]));
  }
  return yield;
}

/// Points without a colour take that of the first coloured one in their own or a neighbouring cell.
void colour_from_neighbours(const RunCloud& cloud, std::span<const std::size_t> points,
                            const std::vector<bool>& has_colour, std::vector<Rgb8>& colour) {
  using Cell = std::array<int, 3>;
  const auto cell_of = [&](std::size_t i) {
    const Vec3f p = cloud.points_world_m[points[i]] / kNear_m;
    return Cell{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
                static_cast<int>(std::floor(p.z()))};
  };
  std::map<Cell, std::size_t> coloured;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (has_colour[i]) coloured.emplace(cell_of(i), i);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (has_colour[i]) continue;
    const Vec3f p = cloud.points_world_m[points[i]];
    const Cell cell = cell_of(i);
    float nearest_m = 2.0F * kNear_m;
    for (int n = 0; n < 27; ++n) {
      const auto found =
          coloured.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      if (found == coloured.end()) continue;
      const float away_m = (cloud.points_world_m[points[found->second]] - p).norm();
      if (away_m >= nearest_m) continue;
      nearest_m = away_m;
      colour[i] = colour[found->second];
    }
  }
}

/// Keeps the thumbnails of every n-th view, with the least n that fits; none if none fit.
std::vector<Thumbnail> within(std::vector<Thumbnail> all, const FrameRecord& frames,
                              std::size_t max_bytes) {
  const auto most = static_cast<int>(frames.frames.size());
  for (int every = 1; every <= most; ++every) {
    std::size_t bytes = 0;
    const auto is_kept = [&](const Thumbnail& t) {
      return frames.frames[t.frame].iteration % every == 0;
    };
    for (const Thumbnail& t : all) {
      if (is_kept(t)) bytes += (t.jpeg.size() + 3) / 4 * 4;  // as BytePack aligns them
    }
    if (bytes > max_bytes) continue;
    std::erase_if(all, [&](const Thumbnail& t) { return !is_kept(t); });
    return all;
  }
  return {};
}

}  // namespace

CameraFrames read_camera_frames(const FrameRecord& frames, const RunCloud& cloud,
                                std::span<const std::size_t> points, std::size_t max_bytes,
                                int threads, const ReportProgress& progress) {
  CameraFrames out;
  out.colour.assign(points.size(), kNoColour);
  std::vector<bool> has_colour(points.size(), false);
  const std::size_t count = frames.frames.size();
  for (std::size_t begin = 0; begin < count; begin += kFramesAtOnce) {
    std::vector<FrameYield> yields(std::min(kFramesAtOnce, count - begin));
    parallel_for(threads, yields.size(),
                 [&](std::size_t i) { yields[i] = read_frame(frames, begin + i, cloud, points); });
    for (FrameYield& yield : yields) {
      out.thumbnails.push_back(std::move(yield.thumbnail));
      for (std::size_t i = 0; i < yield.colours.size(); ++i) {
        const std::size_t point = yield.range.begin + i;
        if (has_colour[point] || !yield.colours[i]) continue;
        out.colour[point] = *yield.colours[i];
        has_colour[point] = true;
      }
    }
    progress(static_cast<double>(begin + yields.size()) / static_cast<double>(count));
  }
  colour_from_neighbours(cloud, points, has_colour, out.colour);
  out.thumbnails = within(std::move(out.thumbnails), frames, max_bytes);
  return out;
}

}  // namespace gnbv
