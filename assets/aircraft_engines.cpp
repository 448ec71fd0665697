// Turbofans on their pylons: a cowl (ring-shaped shell), a core that closes it at the fan, blades.
#include <array>
#include <cmath>
#include <numbers>

#include "assets/aircraft_parts.hpp"
#include "assets/section_curves.hpp"

namespace gnbv::aircraft {
namespace {

/// Middle of the intake lip's plane, on the engine's axis (parallel to y).
struct EngineMount {
  Vec3 lip_m;
};
const std::array<EngineMount, 2> kMounts = {{{{4.600, -4.45, 1.183}}, {{9.340, -1.44, 1.645}}}};

constexpr std::size_t kEngineSides = 28;
constexpr std::size_t kBlades = 26;

std::vector<RevolvedPoint> cowl_profile() {
  return {{0.000, 0.648}, {0.025, 0.678}, {0.120, 0.718}, {0.340, 0.753}, {0.700, 0.7655},
          {1.080, 0.761}, {1.420, 0.738}, {1.740, 0.697}, {2.030, 0.643}, {2.280, 0.584},  // rim
          {2.268, 0.566}, {1.900, 0.607}, {1.450, 0.637},                   // bypass duct
          {0.980, 0.638}, {0.620, 0.627}, {0.300, 0.603}, {0.080, 0.607}};  // intake
}
constexpr std::size_t kCowlLipEnd = 2, kCowlRim = 8, kCowlDuctEnd = 13, kCowlIntakeEnd = 15;

std::vector<RevolvedPoint> core_profile() {
  return {{0.420, 0.000}, {0.465, 0.060}, {0.580, 0.130}, {0.740, 0.187},
          {0.935, 0.212},                  // spinner ends
          {0.965, 0.440}, {0.995, 0.690},  // disc behind the fan
          {1.090, 0.690}, {1.120, 0.430},  // its back
          {1.530, 0.453}, {1.960, 0.438}, {2.380, 0.382}, {2.760, 0.305},
          {2.748, 0.288}, {2.560, 0.282}, {2.545, 0.205},   // core nozzle
          {2.800, 0.142}, {3.020, 0.066}, {3.140, 0.000}};  // plug
}
constexpr std::size_t kSpinnerEnd = 4, kDiscEnd = 8, kCoreRim = 12;

/// Blade at the top of the fan; thin, twisted from hub to tip.
Part fan_blade(double turn_rad) {
  struct Row {
    double radius_m, chord_m, stagger_deg;
  };
  constexpr std::array<Row, 3> kRows = {
      {{0.185, 0.110, 22.0}, {0.390, 0.150, 45.0}, {0.634, 0.165, 60.0}}};
  constexpr double kMiddle_m = 0.860, kHalfThickness_m = 0.006;
  const Vec3 out(std::sin(turn_rad), 0.0, std::cos(turn_rad));
  const Vec3 round(std::cos(turn_rad), 0.0, -std::sin(turn_rad));
  std::vector<Ring> rings;
  for (const Row& row : kRows) {
    const double stagger_rad = row.stagger_deg * std::numbers::pi / 180.0;
    const Vec3 along = std::cos(stagger_rad) * Vec3::UnitY() + std::sin(stagger_rad) * round;
    const Vec3 across = std::cos(stagger_rad) * round - std::sin(stagger_rad) * Vec3::UnitY();
    const Vec3 middle_m = row.radius_m * out + kMiddle_m * Vec3::UnitY();
    const Vec3 reach_m = 0.5 * row.chord_m * along, bulge_m = kHalfThickness_m * across;
    rings.push_back(
        {middle_m - reach_m, middle_m + bulge_m, middle_m + reach_m, middle_m - bulge_m});
  }
  return loft(rings, {}, {}, uniform(kFanBlade));
}

/// Horizontal cuts from inside the core up into the wing; y and z from the middle of the lip.
Part pylon() {
  constexpr std::size_t kPoints = 9;
  constexpr std::array<UprightRow, 6> kRows = {{{0.31, 1.62, 2.55, 0.100, 0},
                                                {0.55, 1.35, 3.20, 0.115, 1},
                                                {0.735, 0.72, 3.75, 0.120, 1},
                                                {0.800, 0.95, 4.00, 0.120, 1},
                                                {0.890, 1.75, 4.25, 0.115, 1},
                                                {0.953, 2.72, 4.35, 0.100, 1}}};
  return loft(upright_rings(kRows, kPoints), {}, {}, uniform(kFairingGrey));
}

std::uint16_t cowl_paint(std::size_t segment) {
  if (segment < kCowlLipEnd || segment >= kCowlIntakeEnd) return kBareMetal;
  if (segment < kCowlRim) return kNacelleBlue;
  return segment < kCowlDuctEnd ? kExhaust : kFairingGrey;
}

std::uint16_t core_paint(std::size_t segment) {
  if (segment < kSpinnerEnd) return kFairingGrey;
  if (segment < kDiscEnd) return kFanDark;
  return segment < kCoreRim ? kBareMetal : kExhaust;
}

}  // namespace

std::vector<Part> engines() {
  std::vector<Part> engine = {
      revolve_loop(cowl_profile(), kEngineSides,
                   [](std::size_t segment, std::size_t) { return cowl_paint(segment); }),
      revolve(core_profile(), kEngineSides,
              [](std::size_t segment, std::size_t) { return core_paint(segment); }),
      pylon()};
  for (std::size_t i = 0; i < kBlades; ++i)
    engine.push_back(
        fan_blade(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kBlades)));

  std::vector<Part> parts;
  for (const EngineMount& mount : kMounts)
    for (const Part& part : engine) parts.push_back(translated(part, mount.lip_m));
  return parts;
}

}  // namespace gnbv::aircraft
