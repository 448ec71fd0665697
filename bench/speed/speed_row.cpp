#include "bench/speed/speed_row.hpp"

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

}  // namespace gnbv
