#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scenarios/problems.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tools/mesh_lint/mesh_places.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/auto_bounds.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

constexpr double kLikelySmallest_m = 1.0;
constexpr double kLikelyLargest_m = 150.0;
constexpr double kLikely_m = 30.0;

/// The structure as the scenario places it, and as it would be otherwise.
class Placement {
 public:
  Placement(const MeshReport& report, const Scenario& scenario)
      : report_(report), file_(scenario.structure.file), up_(report.reading.up_axis) {}

  void resize(double factor) { factor_ *= factor; }
  void turn_up(char axis) { up_ = axis; }
  void move(const Vec3& shift_m) { shift_m_ += shift_m; }

  TriangleMesh mesh() const {
    const Eigen::Matrix3d R_turned = R_yaw(file_.yaw_rad);
    const Eigen::Matrix3d R =
        R_turned * R_z_up(up_) * R_z_up(report_.reading.up_axis).transpose() * R_turned.transpose();
    TriangleMesh out = report_.reading.mesh;
    for (Vec3f& v : out.vertices_m) {
      const Vec3 p_m = factor_ * (R * (v.cast<double>() - file_.offset_m));
      v = (p_m + file_.offset_m + shift_m_).cast<float>();
    }
    return out;
  }
  /// Around its sound faces.
  Box3 box_m() const {
    const TriangleMesh placed = mesh();
    Box3 box_m;
    for (std::size_t i = 0; i < placed.faces.size(); ++i) {
      if (!report_.lint.is_sound[i]) continue;
      for (const std::uint32_t v : placed.faces[i]) {
        box_m.extend(placed.vertices_m[v].cast<double>());
      }
    }
    return box_m;
  }
  Vec3 offset_m() const { return file_.offset_m + shift_m_; }

 private:
  const MeshReport& report_;
  const MeshFileConfig& file_;
  double factor_ = 1.0;
  char up_;
  Vec3 shift_m_ = Vec3::Zero();
};

std::optional<Resize> resize(const MeshReport& report, const Scenario& scenario,
                             Placement& placement) {
  const double largest_m = report.lint.box_m.sizes().maxCoeff();
  if (is_likely_size(largest_m)) return std::nullopt;
  const double in_units = largest_m / report.reading.unit_m;
  Resize advised;
  for (const Unit& unit : kUnits) {
    const double would_be_m = in_units * unit.unit_m;
    if (would_be_m < kLikelySmallest_m || would_be_m > kLikelyLargest_m) continue;
    const std::string set = fmt::format("structure.file.unit_m={}", unit.unit_m);
    if (advised.set.empty()) {
      advised.set = set;
      placement.resize(unit.unit_m / report.reading.unit_m);
    }
    advised.text += fmt::format("{}--set {} ({:.3g} m, if the file is in {})",
                                advised.text.empty() ? "" : ", or ", set, would_be_m, unit.name);
  }
  if (!advised.set.empty()) return advised;
  const double factor = std::pow(10.0, std::round(std::log10(kLikely_m / largest_m)));
  placement.resize(factor);
  advised.set = fmt::format("structure.file.scale={}", scenario.structure.file.scale * factor);
  advised.text = fmt::format("--set {} ({:.3g} m)", advised.set, largest_m * factor);
  return advised;
}

/// Where it should be moved: to the origin from afar, onto the ground from below or above.
void place(const Scenario& scenario, Placement& placement, Advice& advice) {
  const Box3 box_m = placement.box_m();
  advice.is_far = farthest_m(box_m) > std::min(kGroundReach_m, reach_m(scenario));
  const Vec3 to_origin_m(-box_m.center().x(), -box_m.center().y(), -box_m.min().z());
  if (advice.is_far) {
    placement.move(to_origin_m);
  } else if (has_flat_ground(scenario) && !stands_on_ground(box_m)) {
    placement.move({0.0, 0.0, to_origin_m.z()});
  } else {
    return;
  }
  constexpr double kRounding = 1000.0;  // to millimetres
  Vec3 offset_m = (placement.offset_m() * kRounding).array().round() / kRounding;
  placement.move(offset_m - placement.offset_m());
  for (double& x : offset_m) x += 0.0;  // no minus before a zero
  if (offset_m == scenario.structure.file.offset_m) return;
  advice.offset =
      fmt::format("structure.file.offset_m=[{}, {}, {}]", offset_m.x(), offset_m.y(), offset_m.z());
}

std::string fault_of(const std::function<void()>& attempt) {
  try {
    attempt();
  } catch (const BadInput& fault) {
    return fault.what();
  }
  return "";
}

/// A workspace around it, with a map so coarse that it can be held.
void lay_bounds(const Scenario& scenario, const TriangleMesh& mesh, Advice& advice) {
  constexpr int kTries = 40;
  constexpr double kStep = 1.15;
  Scenario laid = scenario;
  StructureExtent extent = extent_of(mesh);
  extent.around = scene_around(scenario);
  const auto fault = [&]() -> std::string {
    const std::vector<Problem> all = problems(with_bounds_around(laid, extent));
    return all.empty() ? "" : all.front().what;
  };
  advice.bounds_fault = fault();
  const std::string first_fault = advice.bounds_fault;
  for (int i = 0; i < kTries && !advice.bounds_fault.empty(); ++i) {
    double& resolution_m = laid.planner.map.resolution_m;
    resolution_m = std::ceil(resolution_m * kStep * 100.0) / 100.0;
    if (!fault().empty()) continue;
    advice.bounds_fault.clear();
    advice.resolution = fmt::format("planner.map.resolution_m={}", resolution_m);
    advice.resolution_fault = first_fault;
  }
}

}  // namespace

std::vector<std::string> Advice::sets() const {
  std::vector<std::string> all;
  const std::string turn = likely_up && likely_up->is_sure ? up_axis : "";
  for (const std::string& set :
       {resize ? resize->set : std::string(), turn, offset, floor, resolution}) {
    if (!set.empty()) all.push_back(set);
  }
  return all;
}

Advice advise(const MeshReport& report, const Scenario& scenario, bool bounds_auto) {
  Advice advice;
  Placement placement(report, scenario);
  advice.resize = resize(report, scenario, placement);
  const DeclaredAxes& declared = report.reading.declared;
  std::optional<LikelyUp>& up = advice.likely_up;
  if (!declared.is_law) up = likely_up_axis(in_file_axes(report, scenario), report.reading.up_axis);
  if (up && declared.up_axis) up->is_sure = false;
  if (up && up->axis != report.reading.up_axis && scenario.structure.file.up_axis == "auto") {
    advice.up_axis = fmt::format("structure.file.up_axis={}", up->axis);
    if (up->is_sure) placement.turn_up(up->axis);
  }
  place(scenario, placement, advice);

  World world{.structure = placement.mesh()};
  std::vector<std::string> not_of_this_mesh;  // what is wrong with the files of obstacles
  load_surroundings(scenario, world, not_of_this_mesh);
  const Box3 box_m = placement.box_m();
  Scenario flown = scenario;
  constexpr double kMostBelow = 0.5;
  double& floor_z_m = flown.planner.floor_z_m;
  if (share_below(report.lint, world.structure, floor_z_m) >= kMostBelow) {
    constexpr double kShareOfHeight = 0.05;
    constexpr double kRounding = 1e4;
    const auto rounded = [](double z_m) { return std::floor(z_m * kRounding) / kRounding + 0.0; };
    double floor_m = rounded(box_m.min().z() + kShareOfHeight * box_m.sizes().z());
    // much of it may lie flat on the ground
    if (share_below(report.lint, world.structure, floor_m) >= kMostBelow) {
      floor_m = rounded(box_m.min().z());
    }
    if (floor_m < floor_z_m) {
      floor_z_m = floor_m;
      advice.floor = fmt::format("planner.floor_z_m={}", floor_m);
    }
  }
  const Box3 whole_m = bounds_m(world.structure);
  const bool is_outside = !is_inside_workspace(flown, whole_m);
  if (!is_outside && !bounds_auto) {
    world.structure = sound_part(world.structure, report.lint);
    const RayScene scene(world);
    advice.start_fault =
        fault_of([&] { need_way_out(flown, scene, whole_m, start_pose(flown, scene), 1); });
  }
  advice.needs_bounds = bounds_auto || is_outside || !advice.start_fault.empty();
  if (advice.needs_bounds) lay_bounds(flown, world.structure, advice);
  return advice;
}

}  // namespace gnbv
