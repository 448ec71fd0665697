// Polygons with holes as polygons without.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Joins a polygon and its holes into one that touches itself: by the shortest bridges that cross
/// no edge, in the plane of its Newell normal.
class HoleBridges {
 public:
  using Ring = std::vector<std::uint32_t>;

  /// By corner.
  HoleBridges(std::vector<Vec3> vertices, const Ring& outer) : vertices_(std::move(vertices)) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 2; i < outer.size(); ++i) {
      normal += (vertices_[outer[i - 1]] - vertices_[outer[0]])
                    .cross(vertices_[outer[i]] - vertices_[outer[0]]);
    }
    normal.cwiseAbs().maxCoeff(&axis_);
  }

  Ring joined(Ring outer, std::vector<Ring> holes) const {
    for (Ring& hole : holes) {
      if ((area(hole) > 0.0) == (area(outer) > 0.0)) std::reverse(hole.begin(), hole.end());
    }
    while (!holes.empty()) {
      Bridge best;
      for (std::size_t h = 0; h < holes.size(); ++h) find_bridge(outer, holes, h, best);
      Ring hole = std::move(holes[best.hole]);
      holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(best.hole));
      const auto place = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
      std::rotate(hole.begin(), hole.begin() + place(best.to), hole.end());
      hole.push_back(hole.front());
      hole.push_back(outer[best.from]);
      outer.insert(outer.begin() + place(best.from) + 1, hole.begin(), hole.end());
    }
    return outer;
  }

 private:
  struct Bridge {
    std::size_t hole = 0, from = 0, to = 0;
    double length = std::numeric_limits<double>::infinity();
  };

  Eigen::Vector2d at(std::uint32_t corner) const {
    return {vertices_[corner][(axis_ + 1) % 3], vertices_[corner][(axis_ + 2) % 3]};
  }
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Eigen::Vector2d ab = at(b) - at(a), ac = at(c) - at(a);
    return ab.x() * ac.y() - ab.y() * ac.x();
  }
  double area(const Ring& corners) const {
    double sum = 0.0;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      sum += turn(corners[0], corners[i - 1], corners[i]);
    }
    return sum;
  }
  bool crosses(std::uint32_t a, std::uint32_t b, const Ring& corners) const {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t c = corners[i], d = corners[(i + 1) % corners.size()];
      if (turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0) return true;
    }
    return false;
  }
  void find_bridge(const Ring& outer, const std::vector<Ring>& holes, std::size_t hole,
                   Bridge& best) const {
    for (std::size_t i = 0; i < outer.size(); ++i) {
      for (std::size_t j = 0; j < holes[hole].size(); ++j) {
        const std::uint32_t a = outer[i], b = holes[hole][j];
        const double length = (at(a) - at(b)).norm();
        if (!(length < best.length) || crosses(a, b, outer)) continue;
        const bool is_blocked = std::any_of(
            holes.begin(), holes.end(), [&](const Ring& other) { return crosses(a, b, other); });
        if (!is_blocked) best = {hole, i, j, length};
      }
    }
  }

  std::vector<Vec3> vertices_;
  Eigen::Index axis_ = 2;
};

}  // namespace gnbv
