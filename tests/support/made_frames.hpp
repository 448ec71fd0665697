// Camera frames for the run directory of made_run.hpp, written by hand.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {

/// A frame of 64 x 48 px of one camera for each view of the made run, 2 m from what it sees.
inline void write_made_frames(const std::filesystem::path& run) {
  const std::filesystem::path folder = run / "frames";
  std::filesystem::create_directories(folder);
  std::string poses = "iteration,camera,time_s,x_m,y_m,z_m,qx,qy,qz,qw,rgb,depth\n";
  for (int view = 0; view < 3; ++view) {
    Image image{64, 48, {}};
    for (std::uint64_t i = 0; i < 3 * 64 * 48; ++i) {
      const double share = uniform01({9, Stream::bench, i, static_cast<std::uint64_t>(view)});
      image.rgb.push_back(static_cast<std::uint8_t>(255.0 * share));
    }
    const std::string name = fmt::format("{}.png", view);
    write_png(image, folder / name);
    const GreyImage16 depth{64, 48, std::vector<std::uint16_t>(64 * 48, 2000)};
    write_png(depth, folder / ("depth_" + name));
    poses += fmt::format("{},c,{},4,4,{},0,0,0,1,{},depth_{}\n", view, 3 + view, view, name, name);
  }
  write_file_atomically(folder / "poses.csv", poses);
  write_file_atomically(folder / "cameras.json",
                        R"([{"name": "c", "width_px": 64, "height_px": 48, "fx_px": 32,
                             "fy_px": 32, "cx_px": 32, "cy_px": 24, "depth_scale_m": 0.001}])");
}

}  // namespace gnbv
