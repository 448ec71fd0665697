#include "bench/speed/measure.hpp"

#include <algorithm>
#include <ctime>

namespace gnbv {

double thread_time_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::array<CameraModel, 2> camera_pair() {
  CameraConfig config;
  config.pitch_rad = deg_to_rad(20.0);
  const CameraModel down = make_camera_model(config);
  config.pitch_rad = -config.pitch_rad;
  return {down, make_camera_model(config)};
}

}  // namespace gnbv
