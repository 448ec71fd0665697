// A flight as things to draw.
#pragma once

#include <limits>

#include "tools/render/scene.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

extern const Rgb kProfileColour;

/// What of a flight to draw, and how thick a layout unit is there.
struct FlightLook {
  double unit_m = 0.05;
  bool has_profile = true;
  double until_s = std::numeric_limits<double>::infinity();  // of the mission's time
  double thickness = 1.0;                                    // of lines and balls
};

/// The profile's flight in grey, the planned one in the colours of its views' order, as add_views()
/// has them. Samples on straight lines are left out.
void add_flight(const RunRecord& record, const FlightLook& look, RenderScene& scene);

/// Of which views the cameras' pyramids are drawn: each `every`-th; 0: of some 40 in all.
std::size_t pyramid_step(std::size_t views, int every);

/// A ball at each of the first `count` views in the colours of their order, and the pyramids of all
/// cameras at each n-th; 0: at about 40 in all.
void add_views(const RunRecord& record, std::size_t count, int every, const FlightLook& look,
               RenderScene& scene);

/// The pyramid, and where it lies beside its view the line that it hangs on.
void add_hung(const FrustumItem& frustum, const ViewPose& view, double unit_m, RenderScene& scene);

/// The pyramid of a camera on a body whose gimbal, if that is what the camera hangs on, has this
/// pitch; `length_m` long.
FrustumItem frustum_of(const CameraConfig& camera, const Isometry& T_world_body,
                       double gimbal_pitch_rad, double length_m, const Rgb& colour);

/// A path in one colour, its straight parts as one piece each.
TubeItem path_tube(const std::vector<Vec3>& path_world_m, double unit_m, const Rgb& colour);

}  // namespace gnbv
