// Nearest neighbours in a point set. The only file that knows nanoflann is its .cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "sim/core/pose.hpp"

namespace gnbv {

struct Neighbour {
  std::uint32_t point = 0;
  float distance_m = 0.0F;
};

/// Const after construction: any number of threads may query at once.
class PointTree {
 public:
  /// Keeps the span, not the points.
  explicit PointTree(std::span<const Vec3f> points_m);
  ~PointTree();
  PointTree(const PointTree&) = delete;

  /// Fills `found` with the nearest points, nearest first and the lower index first among equals;
  /// returns the part of it that is filled, which is less than asked for only when fewer points lie
  /// nearer than `below_m`.
  std::span<const Neighbour> nearest(const Vec3f& p_m, std::span<Neighbour> found,
                                     float below_m = std::numeric_limits<float>::infinity()) const;

  /// The nearest of all; nothing without points.
  std::optional<Neighbour> nearest(const Vec3f& p_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnbv
