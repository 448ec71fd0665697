// Cameras that users name or write down.
#pragma once

#include <filesystem>
#include <string>

#include "tools/render/view.hpp"

namespace gnbv {

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
