// Wing and tail of the laboratory's airplane: fixed surfaces with a slot along the hinge, and the
// control surfaces that move in it.
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/lab_airplane_parts.hpp"
#include "assets/section_curves.hpp"

namespace gnbv::lab_airplane {
namespace {

/// One section of a surface: `span_m` is x of a wing, z of a fin.
struct Row {
  double span_m, leading_y_m, trailing_y_m, z_m, half_thickness_m, camber_m;
};

constexpr std::array<Row, 5> kWing = {{{0.063, -0.564, 0.120, 0.353, 0.047, 0.009},
                                       {0.240, -0.528, 0.104, 0.364, 0.043, 0.009},
                                       {1.380, -0.378, -0.010, 0.449, 0.021, 0.005},
                                       {1.455, -0.338, -0.020, 0.456, 0.016, 0.003},
                                       {1.497, -0.262, -0.045, 0.462, 0.006, 0.000}}};
constexpr std::array<Row, 4> kTailplane = {{{0.023, 1.405, 1.835, 0.6120, 0.021, 0.0},
                                            {0.100, 1.432, 1.840, 0.6155, 0.020, 0.0},
                                            {0.555, 1.588, 1.861, 0.6310, 0.011, 0.0},
                                            {0.603, 1.655, 1.848, 0.6325, 0.004, 0.0}}};
constexpr std::array<Row, 4> kFin = {{{0.595, 1.290, 1.917, 0.0, 0.027, 0.0},
                                      {0.693, 1.376, 1.941, 0.0, 0.025, 0.0},
                                      {0.955, 1.617, 1.997, 0.0, 0.014, 0.0},
                                      {0.997, 1.724, 1.975, 0.0, 0.005, 0.0}}};

enum class Kind { wing, fin };

template <std::size_t n>
AerofoilSection section_at(const std::array<Row, n>& rows, double span_m, Kind kind) {
  std::size_t i = 1;
  while (i + 1 < n && rows[i].span_m < span_m) ++i;
  const auto section = [&](const Row& row) -> AerofoilSection {
    if (kind == Kind::fin)
      return {{0.0, row.leading_y_m, row.span_m},
              {0.0, row.trailing_y_m, row.span_m},
              Vec3::UnitX(),
              row.half_thickness_m,
              row.camber_m};
    return {{row.span_m, row.leading_y_m, row.z_m},
            {row.span_m, row.trailing_y_m, row.z_m},
            Vec3::UnitZ(),
            row.half_thickness_m,
            row.camber_m};
  };
  const double width_m = rows[i].span_m - rows[i - 1].span_m;
  return between(section(rows[i - 1]), section(rows[i]), (span_m - rows[i - 1].span_m) / width_m);
}

/// A fixed surface ends here at the trailing edge, or at a slot.
struct Station {
  double span_m;
  bool slotted;
};

constexpr double kSlot = 0.715, kShroud = 0.695;  // of the chord: the skin's edge, the slot's floor
constexpr double kNose = 0.728;                   // of a control surface
constexpr std::size_t kPoints = 11;

/// 2 kPoints points, as aerofoil_ring(); the last but one on each side is the edge of the skin, the
/// others lie at the same fractions with and without a slot.
Ring fixed_ring(const AerofoilSection& section, bool slotted) {
  const auto at = [&](std::size_t k, double side) {
    const double edge = slotted ? kSlot : 0.94;
    const double s = k + 1 < kPoints ? 0.64 * chord_fraction(k, kPoints - 2) : edge;
    return aerofoil_point_m(section, s, side);
  };
  Ring ring = {section.leading_edge_m};
  for (std::size_t k = 1; k < kPoints; ++k) ring.push_back(at(k, 1.0));
  ring.push_back(slotted ? aerofoil_point_m(section, kShroud, 0.0) : section.trailing_edge_m);
  for (std::size_t k = kPoints - 1; k > 0; --k) ring.push_back(at(k, -1.0));
  return ring;
}

constexpr std::array<double, 4> kControlFractions = {0.745, 0.80, 0.87, 0.94};

Ring control_ring(const AerofoilSection& section) {
  Ring ring = {aerofoil_point_m(section, kNose, 0.0)};
  for (const double s : kControlFractions) ring.push_back(aerofoil_point_m(section, s, 1.0));
  ring.push_back(section.trailing_edge_m);
  for (std::size_t k = kControlFractions.size(); k > 0; --k)
    ring.push_back(aerofoil_point_m(section, kControlFractions[k - 1], -1.0));
  return ring;
}

/// On x = 0 a ring is the mirror image of its half, to the bit.
Ring placed(Ring ring, Kind kind) {
  if (kind == Kind::wing) return ring;
  const auto half = static_cast<std::ptrdiff_t>(ring.size() / 2);
  return mirror_ring(std::vector<Vec3>(ring.begin(), ring.begin() + half + 1));
}

/// Ends are fans about a point of the mean line: unlike a zipper they look the same in a mirror.
Cap end_cap(const AerofoilSection& section, double fraction) {
  return {aerofoil_point_m(section, fraction, 0.0)};
}

template <std::size_t n>
Part fixed_surface(const std::array<Row, n>& rows, const std::vector<Station>& stations, Kind kind,
                   Paint paint) {
  std::vector<Ring> rings;
  for (const Station& station : stations)
    rings.push_back(
        placed(fixed_ring(section_at(rows, station.span_m, kind), station.slotted), kind));
  const auto cap = [&](const Station& station) {
    return end_cap(section_at(rows, station.span_m, kind), 0.4);
  };
  return loft(rings, cap(stations.front()), cap(stations.back()),
              [&](std::size_t ring, std::size_t side) -> std::uint16_t {
                const bool end = ring + 1 == rings.size();
                return !end && (side < 3 || side + 4 > 2 * kPoints) ? kLeadingEdge : paint;
              });
}

/// Between two stations, `droop_rad` down at the trailing edge.
template <std::size_t n>
Part control_surface(const std::array<Row, n>& rows, double from_m, double to_m, Kind kind,
                     double droop_rad, Paint paint) {
  constexpr std::size_t kSteps = 6;
  std::vector<Ring> rings;
  const auto section = [&](double t) {
    return section_at(rows, from_m + (to_m - from_m) * t, kind);
  };
  for (std::size_t i = 0; i <= kSteps; ++i)
    rings.push_back(placed(control_ring(section(static_cast<double>(i) / double{kSteps})), kind));
  Part part = loft(rings, end_cap(section(0.0), 0.85), end_cap(section(1.0), 0.85), uniform(paint));
  if (droop_rad == 0.0) return part;
  const Vec3 hinge_m = aerofoil_point_m(section(0.0), kNose, 0.0);
  const Vec3 axis = (aerofoil_point_m(section(1.0), kNose, 0.0) - hinge_m).normalized();
  const Eigen::AngleAxisd turn(-droop_rad, axis);
  for (Vec3& p : part.points_m) p = hinge_m + turn * (p - hinge_m);
  return part;
}

/// A slotted bay between two ribs, with stations every 10 cm or so.
void add_bay(std::vector<Station>& stations, double from_m, double to_m) {
  constexpr double kRib_m = 0.005;
  stations.push_back({from_m - kRib_m, false});
  const int steps = std::max(1, static_cast<int>((to_m - from_m) / 0.1));
  for (int i = 0; i <= steps; ++i) stations.push_back({from_m + (to_m - from_m) * i / steps, true});
  stations.push_back({to_m + kRib_m, false});
}

/// A blade of diamond sections on x = 0, upright or hanging.
Part blade(const std::vector<Row>& rows, Paint paint) {
  std::vector<Ring> rings;
  const auto middle_m = [](const Row& row) -> Vec3 {
    return {0.0, 0.5 * (row.leading_y_m + row.trailing_y_m), row.span_m};
  };
  for (const Row& row : rows) {
    const double chord_m = row.trailing_y_m - row.leading_y_m;
    rings.push_back(
        mirror_ring({{0.0, row.leading_y_m, row.span_m},
                     {row.half_thickness_m, row.leading_y_m + 0.3 * chord_m, row.span_m},
                     {0.7 * row.half_thickness_m, row.leading_y_m + 0.7 * chord_m, row.span_m},
                     {0.0, row.trailing_y_m, row.span_m}}));
  }
  return loft(rings, {middle_m(rows.front())}, {middle_m(rows.back())}, uniform(paint));
}

}  // namespace

std::vector<Part> wings() {
  std::vector<Station> stations = {{0.063, false}};
  add_bay(stations, 0.242, 0.858);  // flap
  add_bay(stations, 0.902, 1.362);  // aileron
  for (const double x_m : {1.410, 1.455, 1.482, 1.497}) stations.push_back({x_m, false});
  std::vector<Station> tail_stations = {{0.023, false}};
  add_bay(tail_stations, 0.092, 0.528);
  for (const double x_m : {0.555, 0.583, 0.603}) tail_stations.push_back({x_m, false});
  return {fixed_surface(kWing, stations, Kind::wing, kWingSkin),
          control_surface(kWing, 0.251, 0.849, Kind::wing, deg_to_rad(17.0), kControlSurface),
          control_surface(kWing, 0.911, 1.353, Kind::wing, 0.0, kControlSurface),
          fixed_surface(kTailplane, tail_stations, Kind::wing, kWingSkin),
          control_surface(kTailplane, 0.100, 0.520, Kind::wing, deg_to_rad(-6.0), kControlSurface)};
}

std::vector<Part> centre_fins() {
  std::vector<Station> stations = {{0.595, false}};
  add_bay(stations, 0.685, 0.942);
  for (const double z_m : {0.965, 0.985, 0.997}) stations.push_back({z_m, false});
  std::vector<Part> parts = {fixed_surface(kFin, stations, Kind::fin, kTailStripes),
                             control_surface(kFin, 0.693, 0.934, Kind::fin, 0.0, kControlSurface),
                             // the strakes before the fin and under the tail
                             blade({{0.643, 0.94, 1.70, 0.0, 0.013, 0.0},
                                    {0.716, 1.09, 1.70, 0.0, 0.011, 0.0},
                                    {0.757, 1.31, 1.70, 0.0, 0.009, 0.0},
                                    {0.793, 1.45, 1.70, 0.0, 0.007, 0.0}},
                                   kSkinRed),
                             blade({{0.545, 1.28, 1.83, 0.0, 0.011, 0.0},
                                    {0.437, 1.42, 1.80, 0.0, 0.009, 0.0},
                                    {0.391, 1.57, 1.77, 0.0, 0.005, 0.0}},
                                   kSkinRed)};
  struct Antenna {
    double y_m, root_z_m, tip_z_m, chord_m;
  };
  for (const Antenna& at :
       {Antenna{-1.05, 0.665, 0.752, 0.075}, Antenna{-0.86, 0.343, 0.243, 0.065},
        Antenna{0.42, 0.345, 0.232, 0.070}}) {
    parts.push_back(blade(
        {{at.root_z_m, at.y_m, at.y_m + at.chord_m, 0.0, 0.008, 0.0},
         {at.tip_z_m, at.y_m + 0.6 * at.chord_m, at.y_m + 1.05 * at.chord_m, 0.0, 0.005, 0.0}},
        kStrut));
  }
  return parts;
}

}  // namespace gnbv::lab_airplane
