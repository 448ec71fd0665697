#include "scenarios/fields.hpp"

namespace gnbv {

void fields(FieldVisitor& v, CameraConfig& c) {
  v.word("name", c.name, "Name of the camera, unlike that of any other.");
  v.integer("width_px", c.width_px, between(1, 8192), "Pixels a row.");
  v.integer("height_px", c.height_px, between(1, 8192), "Pixels a column.");
  v.angle("fov_x_deg", c.fov_x_rad, between(1, 170), "Horizontal field of view.");
  v.angle("fov_y_deg", c.fov_y_rad, between(1, 170), "Vertical field of view.");
  v.number("range_min_m", c.range_min_m, between(0, 1e3),
           "Along the optical axis; nearer returns are invalid.");
  v.number("range_max_m", c.range_max_m, above_upto(0, 1e3),
           "Along the optical axis; beyond there is no return.");
  v.number("p_body_m", c.p_body_m, between(-10, 10), "Where the camera sits, body FLU.");
  v.angle("pitch_deg", c.pitch_rad, between(-90, 90), "Tilt about body y: positive looks down.");
}

void fields(FieldVisitor& v, LidarConfig& c) {
  v.integer("beams", c.beams, between(1, 1e5), "Beams a sweep, spread evenly over the fan.");
  v.angle("fov_deg", c.fov_rad, between(0, 360), "Angle from the first beam to the last.");
  v.number("rate_hz", c.rate_hz, above_upto(0, 250), "Sweeps a second, at most one a tick.");
  v.number("range_min_m", c.range_min_m, between(0, 1e3), "Nearer returns are invalid.");
  v.number("range_max_m", c.range_max_m, above_upto(0, 1e3), "Beyond there is no return.");
  v.number("p_body_m", c.p_body_m, between(-10, 10), "Where the LIDAR sits, body FLU.");
  v.angle("pitch_deg", c.pitch_rad, between(-90, 90),
          "Tilt about body y: positive tilts the fan down.");
}

}  // namespace gnbv
