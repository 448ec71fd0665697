#include "bench/speed/speed_rows.hpp"

#include <algorithm>
#include <ctime>

namespace gnbv {

double ratio(const SpeedRow& row) {
  return row.is_limit ? row.ours / row.reference : row.reference / row.ours;
}

std::optional<double> competent_ratio(const SpeedRow& row) {
  if (!row.competent) return std::nullopt;
  return *row.competent / row.ours;
}

bool is_met(const SpeedRow& row) {
  return row.identical && (row.is_limit ? ratio(row) <= row.target : ratio(row) >= row.target);
}

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
