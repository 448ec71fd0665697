// albedo() of sim/mesh/triangle_mesh.hpp.
#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/core/rng.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {
namespace {

using Colour = std::array<float, 3>;
using Cell = std::array<std::int64_t, 3>;

// Shares of the pattern's size.
constexpr float kPanelJoint = 0.02F;
constexpr float kCourseHeight = 1.0F / 3.0F;
constexpr float kMortar = 0.05F;
constexpr float kSheetContrast = 0.12F;  // lightest to darkest sheet, of its colour

/// Bands and cubes begin off the origin by this share of their size: a face at a round coordinate
/// does not lie on a border, where rounding would choose the colour.
constexpr float kPhase = 0.381966F;

Colour mix(const Colour& a, const Colour& b, float share_b) {
  const auto channel = [&](std::size_t i) { return a[i] + share_b * (b[i] - a[i]); };
  return {channel(0), channel(1), channel(2)};
}

/// Uniform in [0, 1), one number a cell.
float number_of(const Cell& cell) {
  // fractional parts of the square roots of 2, 3 and 5, made odd: no small cells share a sum
  const std::uint64_t sum = static_cast<std::uint64_t>(cell[0]) * 0x6a09e667f3bcc909ULL +
                            static_cast<std::uint64_t>(cell[1]) * 0xbb67ae8584caa73bULL +
                            static_cast<std::uint64_t>(cell[2]) * 0x3c6ef372fe94f82bULL;
  return static_cast<float>(mix_bits(sum) >> 40) * 0x1.0p-24F;
}

std::int64_t floor_of(float x) { return static_cast<std::int64_t>(std::floor(x)); }
float part_of(float x) { return x - std::floor(x); }

/// Value noise: random numbers at the corners of unit cubes, smoothly blended in between.
float value_noise(const Vec3f& p) {
  const Cell low = {floor_of(p.x()), floor_of(p.y()), floor_of(p.z())};
  Vec3f share;
  for (int i = 0; i < 3; ++i) {
    const float t = part_of(p[i]);
    share[i] = t * t * (3.0F - 2.0F * t);
  }
  float sum = 0.0F;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Cell cell = low;
    float weight = 1.0F;
    for (unsigned i = 0; i < 3; ++i) {
      const bool is_high = (corner >> i & 1U) != 0;
      cell[i] += is_high ? 1 : 0;
      const float s = share[static_cast<Eigen::Index>(i)];
      weight *= is_high ? s : 1.0F - s;
    }
    sum += weight * number_of(cell);
  }
  return sum;
}

/// In [0, 1]: octaves of value noise, each of half the size and half the weight.
float clouds(const Vec3f& p) {
  constexpr int kOctaves = 4;
  float sum = 0.0F;
  float weight = 0.5F;
  float weights = 0.0F;
  Vec3f at = p;
  for (int octave = 0; octave < kOctaves; ++octave) {
    sum += weight * value_noise(at);
    weights += weight;
    weight *= 0.5F;
    at = 2.0F * at + Vec3f::Constant(17.3F);  // so that the lattices share no corner
  }
  return sum / weights;
}

/// Coordinates in the plane of a surface: across, and up unless it is level.
struct InPlane {
  int normal_axis;
  float across, up;
};

InPlane in_plane(const Vec3f& p, const Vec3f& normal) {
  int axis = 2;
  normal.cwiseAbs().maxCoeff(&axis);
  return {axis, axis == 0 ? p.y() : p.x(), axis == 2 ? p.y() : p.z()};
}

Colour panels(const Material& m, const Vec3f& p, const Vec3f& normal) {
  const InPlane at = in_plane(p, normal);
  if (part_of(at.across) < kPanelJoint || part_of(at.up) < kPanelJoint) return m.rgb_2;
  const float number = number_of({at.normal_axis, floor_of(at.across), floor_of(at.up)});
  Colour sheet = m.rgb;
  for (float& channel : sheet) {
    channel = std::min(1.0F, channel * (1.0F + kSheetContrast * (number - 0.5F)));
  }
  return sheet;
}

Colour bricks(const Material& m, const Vec3f& p, const Vec3f& normal) {
  const InPlane at = in_plane(p, normal);
  const float course = at.up / kCourseHeight;
  const bool is_shifted = (floor_of(course) & 1) != 0;
  const float along = at.across + (is_shifted ? 0.5F : 0.0F);
  const bool is_mortar = part_of(along) < kMortar || part_of(course) * kCourseHeight < kMortar;
  return is_mortar ? m.rgb_2 : m.rgb;
}

bool is_odd(float x) { return (floor_of(x + kPhase) & 1) != 0; }

}  // namespace

Colour albedo(const Material& material, const Vec3f& p_world_m, const Vec3f& normal_world) {
  const Vec3f p = p_world_m / material.pattern_size_m;
  switch (material.pattern) {
    case Pattern::plain:
      return material.rgb;
    case Pattern::noise:
      return mix(material.rgb, material.rgb_2, clouds(p));
    case Pattern::panels:
      return panels(material, p, normal_world);
    case Pattern::bricks:
      return bricks(material, p, normal_world);
    case Pattern::stripes:
      return is_odd(p.z()) ? material.rgb_2 : material.rgb;
    case Pattern::checker:
      return is_odd(p.x()) ^ is_odd(p.y()) ^ is_odd(p.z()) ? material.rgb_2 : material.rgb;
  }
  throw BrokenInvariant("pattern outside its enumeration");
}

}  // namespace gnbv
