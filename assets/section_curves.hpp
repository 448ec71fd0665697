// Curves the parts are drawn with: smooth lines through stations, straight ones, aerofoils.
#pragma once

#include <cstddef>
#include <vector>

#include "assets/mesh_builder.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Piecewise cubic through (x, y) without overshoot: slopes are the weighted harmonic means of
/// Fritsch and Butland (1984). Constant outside the stations.
class MonotoneCurve {
 public:
  struct Station {
    double x, y;
  };
  /// At least two stations, x ascending.
  explicit MonotoneCurve(std::vector<Station> stations);
  double operator()(double x) const;

 private:
  std::vector<Station> stations_;
  std::vector<double> slopes_;
};

/// One aerofoil section of a wing-like part.
struct AerofoilSection {
  Vec3 leading_edge_m, trailing_edge_m;
  Vec3 up;                        // unit length, across the chord
  double half_thickness_m = 0.0;  // at 30 % of the chord
  double camber_m = 0.0;          // highest point of the mean line, at 40 % of the chord
};

/// Fraction of the chord at point k of n of one side; denser towards the leading edge.
double chord_fraction(std::size_t k, std::size_t n);

/// Point of the section at fraction s of the chord: side 1 is the upper surface, -1 the lower one,
/// 0 the mean line.
Vec3 aerofoil_point_m(const AerofoilSection& section, double s, double side);

/// 2 n points: leading edge, upper side, trailing edge (point n), lower side. Thickness is the NACA
/// four-digit one with a closed trailing edge, camber its mean line (NACA Report 460).
Ring aerofoil_ring(const AerofoilSection& section, std::size_t n);

/// The section at fraction t of the way from a to b.
AerofoilSection between(const AerofoilSection& a, const AerofoilSection& b, double t);

/// Appends `steps` rings after `a` up to and including `b`.
void add_span(std::vector<Ring>& rings, const AerofoilSection& a, const AerofoilSection& b,
              std::size_t steps, std::size_t n);

}  // namespace gnbv
