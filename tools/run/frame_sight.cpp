#include "tools/run/frame_sight.hpp"

#include <algorithm>
#include <cmath>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr double kSteepest_rad = deg_to_rad(80.0);

}  // namespace

FrameSight::FrameSight(const FrameRecord& record, std::size_t frame)
    : camera_(record.cameras[record.frames[frame].camera]),
      T_camera_world_(record.frames[frame].T_world_camera.inverse()),
      colour_(read_colour(record, frame)),
      depth_(read_depth(record, frame)) {}

std::optional<Sighting> FrameSight::sees(const Vec3& p_world_m, double blur_m) const {
  const Vec3 p_camera_m = T_camera_world_ * p_world_m;
  const double z_m = p_camera_m.z();
  if (!(z_m > 0.0)) return std::nullopt;
  const Eigen::Vector2d px = pixel_of(camera_, p_camera_m);
  const Sighting sighting{px.x(), px.y(), z_m};
  const bool is_inside = sighting.u_px >= 0.0 && sighting.u_px < camera_.width_px &&
                         sighting.v_px >= 0.0 && sighting.v_px < camera_.height_px;
  if (!is_inside) return std::nullopt;
  const auto pixel =
      static_cast<std::size_t>(sighting.v_px) * static_cast<std::size_t>(camera_.width_px) +
      static_cast<std::size_t>(sighting.u_px);
  const std::uint16_t depth = depth_.values[pixel];
  if (depth == 0) return std::nullopt;
  const double slope_m =
      0.5 * z_m / std::min(camera_.fx_px, camera_.fy_px) * std::tan(kSteepest_rad);
  const double off_m = std::abs(depth * camera_.depth_scale_m - z_m);
  if (off_m > slope_m + blur_m + camera_.depth_scale_m) return std::nullopt;
  return sighting;
}

Rgb8 FrameSight::colour_at(const Sighting& sighting) const {
  return colour_.at(static_cast<int>(sighting.u_px), static_cast<int>(sighting.v_px));
}

void for_each_frame(const FrameRecord& record, int threads, const ShareDone& progress,
                    const std::function<void(std::size_t frame, const FrameSight& sight)>& look) {
  const std::size_t count = record.frames.size();
  const std::size_t batch = 16 * static_cast<std::size_t>(std::max(threads, 1));
  for (std::size_t first = 0; first < count; first += batch) {
    progress(static_cast<double>(first) / static_cast<double>(count));
    parallel_for(threads, std::min(batch, count - first),
                 [&](std::size_t i) { look(first + i, FrameSight(record, first + i)); });
  }
  progress(1.0);
}

}  // namespace gnbv
