// Where a picture is taken from: cameras, what they show, and how users name them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "sim/core/pose.hpp"

namespace gnbv {

/// A pinhole camera with square pixels and its picture. Optical frame: x right, y down, z forward.
struct RenderView {
  int width_px = 1280;
  int height_px = 720;
  Isometry T_world_camera = Isometry::Identity();
  double fov_y_rad = deg_to_rad(30.0);
  double focus_m = 10.0;                       // depth of the subject: where a scale bar is true
  Vec3 to_light_world = Vec3(0.3, -0.5, 0.8);  // towards the key light, any length
};

/// Camera at `eye` looking at `target` with world z up in the picture (north up for a plumb view).
Isometry look_at(const Vec3& eye_world_m, const Vec3& target_world_m);

/// Towards a key light over the camera's left shoulder, 52 degrees above the horizon.
Vec3 key_light(const Isometry& T_world_camera);

/// From where to look, as seen from the subject: azimuth about z from east (+x), elevation above
/// the horizon.
struct ViewAngles {
  double azimuth_rad = deg_to_rad(-120.0);
  double elevation_rad = deg_to_rad(28.0);
};

/// The unit vector from the subject towards a camera there.
Vec3 to_camera(const ViewAngles& angles);

/// Free borders, as parts of the picture's width (left, right) or height (top, bottom).
struct FrameMargins {
  double left = 0.03;
  double right = 0.03;
  double top = 0.03;
  double bottom = 0.03;
};

/// The nearest camera of that direction and size that shows every point inside the margins. The key
/// light stands over the camera's left shoulder. Throws BadInput without points, with a size under
/// 1 px, or with margins that leave nothing.
RenderView frame_points(std::span<const Vec3> points_world_m, const ViewAngles& angles,
                        int width_px, int height_px, const FrameMargins& margins = {});

/// Picture coordinates in px (0, 0 is the top left corner, pixel centres at halves) and depth in m;
/// nothing behind the camera.
std::optional<Vec3> project(const RenderView& view, const Vec3& p_world_m);

/// Corner i lies at the upper end along x, y, z where its bit 0, 1, 2 is set.
std::array<Vec3, 8> corners_m(const Box3& box_m);

/// Whether the picture holds that place, hidden or not.
bool is_within(const RenderView& view, const Vec3& p_world_m);

/// Pixels a metre at the depth of the view's subject.
double px_per_m_at_focus(const RenderView& view);

/// A direction by name, or a camera of its own.
struct CameraChoice {
  ViewAngles angles;
  std::optional<RenderView> camera = {};
};

/// iso (from the south-west, above), front (from the south), back, left (from the west), right, or
/// top: these frame what is to be seen by themselves. Anything else is a JSON file with position_m
/// [x, y, z], target_m [x, y, z] and optionally fov_y_deg (30). Throws BadInput naming the presets,
/// or file and key.
CameraChoice choose_camera(const std::string& name_or_file);

}  // namespace gnbv
