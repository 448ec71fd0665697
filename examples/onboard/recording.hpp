// Views that were taken in flight, in the order in which they were taken, from a file. Numbers are
// as the machine holds them: of each view the pose (x, y, z, yaw, gimbal pitch) as doubles and the
// number of frames; of each frame its camera, T_world_camera as 16 doubles, column by column, the
// number of pixels, and their depths as floats. Counts and camera are 32-bit.
#pragma once

#include <cstdint>
#include <fstream>
#include <gnbv/planner/onboard.hpp>
#include <optional>
#include <vector>

struct TakenView {
  gnbv::ViewPose pose;
  std::vector<gnbv::DepthFrame> frames;
};

class Recording {
 public:
  explicit Recording(const char* path) : in_(path, std::ios::binary) {}

  /// Nothing at the end of the file.
  std::optional<TakenView> next() {
    TakenView view;
    read(view.pose.p_world_m.data(), 3);
    read(&view.pose.yaw_rad, 1);
    read(&view.pose.gimbal_pitch_rad, 1);
    view.frames.resize(read_count());
    for (gnbv::DepthFrame& frame : view.frames) {
      frame.camera = static_cast<int>(read_count());
      read(frame.T_world_camera.data(), 16);
      frame.depth_m.resize(read_count());
      read(frame.depth_m.data(), frame.depth_m.size());
    }
    if (!in_) return std::nullopt;
    return view;
  }

 private:
  template <typename T>
  void read(T* values, std::size_t count) {
    in_.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
  }
  std::uint32_t read_count() {
    std::uint32_t count = 0;
    read(&count, 1);
    return count;
  }

  std::ifstream in_;
};
