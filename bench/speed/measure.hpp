// What the rows of the speed table are measured with.
#pragma once

#include <array>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// The paper's workspace and floor rule.
inline const Box3 kWorkspace_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));
constexpr double kFloor_m = 0.3;

/// Processor time of the calling thread.
double thread_time_ms();

/// What the task took of it.
template <typename Task>
double time_ms(Task&& task) {
  const double start_ms = thread_time_ms();
  task();
  return thread_time_ms() - start_ms;
}

/// The upper one of two middle values. Requires a value.
double median(std::vector<double> values);

/// The paper's pair: one camera looks down by 20 degrees, the other up.
std::array<CameraModel, 2> camera_pair();

}  // namespace gnbv
