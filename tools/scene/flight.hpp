// A flight as things to draw: its path, its views, the vehicle.
#pragma once

#include <limits>
#include <span>

#include "sim/flight/vehicle_config.hpp"
#include "tools/run/run_record.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// What of a flight to draw, and how thick a layout unit is there.
struct FlightLook {
  double unit_m = 0.05;
  bool has_profile = true;
  double until_s = std::numeric_limits<double>::infinity();  // of the mission's time
  double thickness = 1.0;                                    // of lines and balls
};

/// The profile's flight in its colour, the planned one in the colours of its views' order, as
/// add_views() has them. Samples on straight lines are left out.
void add_flight(const RunRecord& record, const FlightLook& look, RenderScene& scene);

/// Of which views the cameras' pyramids are drawn: each `every`-th; 0: of some 40 in all.
std::size_t pyramid_step(std::size_t views, int every);

/// A ball at each view in the colours of their order, and at each pyramid_step() the pyramids.
void add_views(const RunRecord& record, int every, const FlightLook& look, RenderScene& scene);

/// How large the marks of a view are; 0 leaves one out.
struct ViewSize {
  double ball_m = 0.0;
  double pyramid_m = 0.0;
  double edge_m = 0.0;  // of the pyramids
  float face_opacity = 0.0F;
};

/// A ball where the view is, and the pyramids of its cameras; one that lies beside the view hangs
/// on a line.
void add_view(std::span<const CameraConfig> cameras, const ViewPose& view, const ViewSize& mark,
              const Rgb& colour, RenderScene& scene);

/// The pyramid of a camera on a body whose gimbal, if that is what the camera hangs on, has this
/// pitch; `length_m` long.
FrustumItem frustum_of(const CameraConfig& camera, const Isometry& T_world_body,
                       double gimbal_pitch_rad, double length_m, const Rgb& colour);

/// A path in one colour, its straight parts as one piece each.
TubeItem path_tube(const std::vector<Vec3>& path_world_m, double unit_m, const Rgb& colour);

/// Distance between the rotors that are farthest apart.
double rotor_span_m(const AirframeParameters& airframe);

/// Hull, arms and the discs of its rotors, `scale` times as large as in truth.
void add_vehicle(const AirframeParameters& airframe, const Isometry& T_world_body, double scale,
                 RenderScene& scene);

}  // namespace gnbv
