#include "scenarios/builtin.hpp"
#include "scenarios/fields.hpp"
#include "scenarios/presets.hpp"

namespace gnbv {
namespace {

constexpr EnumNames<DepthNoise, 5> kDepthNoises = {{{DepthNoise::none, "none"},
                                                    {DepthNoise::released, "released"},
                                                    {DepthNoise::khoshelham, "khoshelham"},
                                                    {DepthNoise::nguyen, "nguyen"},
                                                    {DepthNoise::stereo, "stereo"}}};

/// Has to be the first key: naming another preset brings its values, those of the keys after it
/// override them.
template <typename Config>
void preset(FieldVisitor& v, Config& c, std::string_view folder) {
  const std::string before = c.preset;
  v.choice("preset", c.preset, builtin_names(folder),
           "Sets the other values, mounting aside, to this sensor's.");
  if (c.preset != before) c = with_preset_values(c);
}

constexpr Range kPitch_deg = between(-90, 90);
constexpr std::string_view kPitchMeaning = "Turn about body y, the second: positive tilts it down.";

void pitch(FieldVisitor& v, LidarConfig& c) {
  v.angle("pitch_deg", c.pitch_rad, kPitch_deg, kPitchMeaning);
}

void pitch(FieldVisitor& v, CameraConfig& c) {
  v.angle_or_section("pitch_deg", c.pitch_rad, kPitch_deg, c.gimbal, kPitchMeaning,
                     "A gimbal: the pitches that every view may choose from.");
  if (c.gimbal) c.pitch_rad = nearest_pitch_rad(*c.gimbal, 0.0);
}

template <typename Config>
void mounting(FieldVisitor& v, Config& c) {
  v.number("p_body_m", c.p_body_m, between(-10, 10), "Where it sits, body FLU.");
  v.angle("roll_deg", c.roll_rad, between(-180, 180), "Turn about body x, the first.");
  pitch(v, c);
  v.angle("yaw_deg", c.yaw_rad, between(-180, 180),
          "Turn about body z, the last: positive turns it left.");
}

}  // namespace

void fields(FieldVisitor& v, DepthNoiseConfig& c) {
  v.choice("model", c.model, kDepthNoises,
           "Law of the standard deviation over depth (sensors/depth_noise.hpp).");
  const bool is_stereo = c.model == DepthNoise::stereo;
  v.only_if(is_stereo, ".model")
      .number("baseline_m", c.baseline_m, between(1e-3, 10), "stereo: between the two lenses.");
  v.only_if(is_stereo, ".model")
      .number("disparity_noise_px", c.disparity_noise_px, between(0, 10),
              "stereo: standard deviation of a disparity.");
}

void fields(FieldVisitor& v, GimbalConfig& c) {
  v.angle("min", c.min_rad, between(-90, 90), "The first pitch, degrees; negative looks up.");
  v.angle("max", c.max_rad, between(-90, 90), "No pitch is above.");
  v.angle("step", c.step_rad, between(1, 180), "From one pitch to the next.");
}

void fields(FieldVisitor& v, CameraConfig& c) {
  preset(v, c, "cameras");
  v.word("name", c.name, "Name of the camera, unlike that of any other.");
  v.integer("width_px", c.width_px, between(1, 8192), "Pixels a row.");
  v.integer("height_px", c.height_px, between(1, 8192), "Pixels a column.");
  v.angle("fov_x_deg", c.fov_x_rad, between(1, 170), "Horizontal field of view.");
  v.angle("fov_y_deg", c.fov_y_rad, between(1, 170), "Vertical field of view.");
  v.number("range_min_m", c.range_min_m, between(0, 1e3),
           "Along the optical axis; nearer returns are invalid.");
  v.number("range_max_m", c.range_max_m, above_upto(0, 1e3),
           "Along the optical axis; beyond there is no return.");
  v.number("rate_hz", c.rate_hz, between(0, 250),
           "Frames a second in flight, at most one a tick; 0: one at each view, none between.");
  v.number("drop_probability", c.drop_probability, between(0, 1),
           "That a frame is lost, at a view and in flight alike.");
  mounting(v, c);
  v.section("noise", c.noise, "Noise of the depth.");
}

void fields(FieldVisitor& v, LidarConfig& c) {
  preset(v, c, "lidars");
  v.word("name", c.name, "Name of the LIDAR, unlike that of any other.");
  v.integer("beams", c.beams, between(1, 1e5), "Beams a sweep, spread evenly over the fan.");
  v.angle("fov_deg", c.fov_rad, between(0, 360), "Angle from the first beam to the last.");
  v.number("rate_hz", c.rate_hz, above_upto(0, 250), "Sweeps a second, at most one a tick.");
  v.number("range_min_m", c.range_min_m, between(0, 1e3), "Nearer returns are invalid.");
  v.number("range_max_m", c.range_max_m, above_upto(0, 1e3), "Beyond there is no return.");
  mounting(v, c);
  v.number("range_sigma_m", c.range_sigma_m, between(0, 10), "Standard deviation of a range.");
  v.flag("rolling", c.rolling,
         "Whether a sweep's beams follow one another while the vehicle moves, or all at once.");
}

}  // namespace gnbv
