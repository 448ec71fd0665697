// Polygons with holes as polygons without.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Joins a polygon and its holes into one that touches itself: by short bridges that cross no edge,
/// in the plane of its Newell normal.
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

  /// Each hole by its outermost corner, and the outermost hole first: from there to the ring around
  /// it none of the others lies in the way (Eberly, Triangulation by Ear Clipping).
  Ring joined(Ring outer, std::vector<Ring> holes) const {
    const auto is_farther_in = [&](std::uint32_t a, std::uint32_t b) {
      const Eigen::Vector2d p = at(a), q = at(b);
      return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
    };
    const bool is_ccw = area(outer) > 0.0;
    for (Ring& hole : holes) {
      if ((area(hole) > 0.0) == is_ccw) std::reverse(hole.begin(), hole.end());
      std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), is_farther_in),
                  hole.end());
    }
    std::stable_sort(holes.begin(), holes.end(), [&](const Ring& a, const Ring& b) {
      return is_farther_in(b.front(), a.front());
    });
    for (std::size_t h = 0; h < holes.size(); ++h) {
      Ring hole = holes[h];
      const std::size_t from = end_of_bridge(outer, std::span(holes).subspan(h), is_ccw);
      hole.push_back(hole.front());
      hole.push_back(outer[from]);
      outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(from) + 1, hole.begin(), hole.end());
    }
    return outer;
  }

 private:
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
  /// Whether a bridge crosses an edge of the ring, or passes through a corner.
  bool crosses(std::uint32_t a, std::uint32_t b, const Ring& corners) const {
    const Eigen::Vector2d p = at(a), q = at(b);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t c = corners[i], d = corners[(i + 1) % corners.size()];
      const double of_c = turn(a, b, c);
      if (of_c == 0.0 && (at(c) - p).dot(at(c) - q) < 0.0) return true;
      if (of_c * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0) return true;
    }
    return false;
  }
  /// Whether the way from a corner of the ring to b begins on the ring's inside: a corner where
  /// bridges end is there once for each side of them.
  bool begins_inside(const Ring& outer, std::size_t i, std::uint32_t b, bool is_ccw) const {
    const std::uint32_t a = outer[i];
    const std::uint32_t before = outer[i > 0 ? i - 1 : outer.size() - 1];
    const std::uint32_t after = outer[i + 1 < outer.size() ? i + 1 : 0];
    const double sign = is_ccw ? 1.0 : -1.0;
    const bool is_left_of_last = sign * turn(before, a, b) >= 0.0;
    const bool is_left_of_next = sign * turn(a, after, b) >= 0.0;
    return sign * turn(before, a, after) > 0.0 ? is_left_of_last && is_left_of_next
                                               : is_left_of_last || is_left_of_next;
  }
  /// The nearest corner of the ring that the first hole's first one sees; the first one of those
  /// that see none.
  std::size_t end_of_bridge(const Ring& outer, std::span<const Ring> holes, bool is_ccw) const {
    const std::uint32_t b = holes.front().front();
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      nearest.emplace_back((at(outer[i]) - at(b)).squaredNorm(), i);
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto& [distance2, i] : nearest) {
      const std::uint32_t a = outer[i];
      const auto is_in_the_way = [&](const Ring& ring) { return crosses(a, b, ring); };
      if (begins_inside(outer, i, b, is_ccw) && !is_in_the_way(outer) &&
          std::none_of(holes.begin(), holes.end(), is_in_the_way)) {
        return i;
      }
    }
    return 0;
  }

  std::vector<Vec3> vertices_;
  Eigen::Index axis_ = 2;
};

}  // namespace gnbv
