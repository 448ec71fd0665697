// The vehicle as a thing to draw.
#pragma once

#include "sim/flight/vehicle_config.hpp"
#include "tools/render/scene.hpp"

namespace gnbv {

extern const Rgb kFrontRotors;  // the others are grey

/// Distance between the rotors that are farthest apart.
double rotor_span_m(const AirframeParameters& airframe);

/// Hull, arms and the discs of its rotors, `scale` times as large as in truth; the front rotors
/// are orange.
void add_vehicle(const AirframeParameters& airframe, const Isometry& T_world_body, double scale,
                 RenderScene& scene);

}  // namespace gnbv
