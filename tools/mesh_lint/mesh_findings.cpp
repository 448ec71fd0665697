// findings_of() of mesh_report.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/problems.hpp"
#include "sim/core/text.hpp"
#include "tools/mesh_lint/mesh_places.hpp"
#include "tools/mission/load_world.hpp"

namespace gnbv {
namespace {

using Findings = std::vector<Finding>;

std::string name_of_unit(double unit_m) {
  for (const Unit& unit : kUnits) {
    if (std::abs(unit_m / unit.unit_m - 1.0) < 1e-6) return std::string(unit.name);
  }
  return fmt::format("units of {:.4g} m", unit_m);
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string size_text(const Vec3& size_m) {
  const auto text = [](double x_m) {
    return x_m < 1e4 ? fmt::format("{:.4g}", x_m) : fmt::format("{:.0f}", x_m);
  };
  return fmt::format("{} x {} x {} m", text(size_m.x()), text(size_m.y()), text(size_m.z()));
}

std::string flag(const std::string& set) {
  return set.empty() ? "" : fmt::format("--set {}", shell_word(set));
}

/// Two decimals, and no minus before a zero.
std::string metres(double x_m) {
  return fmt::format("{:.2f}", std::round(x_m * 100.0) / 100.0 + 0.0);
}

Finding tallied(std::string_view check, std::size_t count, Severity if_any, std::string_view none,
                std::string what, std::string fix) {
  if (count == 0) return {check, Severity::ok, std::string(none), ""};
  return {check, if_any, std::move(what), std::move(fix)};
}

Finding units_finding(const MeshReading& reading, const Scenario& scenario) {
  const MeshFileConfig& file = scenario.structure.file;
  const std::string unit = name_of_unit(reading.unit_m);
  std::string what = file.unit_m > 0.0         ? fmt::format("{}, by structure.file.unit_m", unit)
                     : reading.declared.unit_m ? fmt::format("{}, as the file declares", unit)
                                               : "the file declares none: taken as metres";
  if (file.unit_m > 0.0 && reading.declared.unit_m && *reading.declared.unit_m != reading.unit_m) {
    what += fmt::format("; the file declares {}", name_of_unit(*reading.declared.unit_m));
  }
  if (file.scale != 1.0) what += fmt::format("; scaled by {}", file.scale);
  return {"units", Severity::ok, what, ""};
}

Finding size_finding(const MeshReport& report, const Advice& advice) {
  const Vec3 size_m = report.lint.box_m.sizes();
  if (!advice.resize) return {"size", Severity::ok, size_text(size_m), ""};
  return {"size", Severity::warning,
          fmt::format("{}: suspiciously {}; is the unit right?", size_text(size_m),
                      size_m.maxCoeff() > kLargest_m ? "large" : "small"),
          advice.resize->text};
}

Finding up_axis_finding(const MeshReport& report, const Scenario& scenario, const Advice& advice) {
  const std::optional<LikelyUp>& likely = advice.likely_up;
  const MeshReading& reading = report.reading;
  const bool is_set = scenario.structure.file.up_axis != "auto";
  const std::string_view origin = is_set                     ? "by structure.file.up_axis"
                                  : reading.declared.up_axis ? "as the file declares"
                                                             : "as assumed, the file declares none";
  std::string what = fmt::format("{} is up, {}", reading.up_axis, origin);
  if (reading.declared.is_law) return {"up axis", Severity::ok, what, ""};
  if (!likely) return {"up axis", Severity::ok, what + "; its shape does not tell", ""};
  if (likely->axis == reading.up_axis)
    return {"up axis", Severity::ok, what + "; its shape agrees", ""};
  return {
      "up axis", is_set ? Severity::note : Severity::warning,
      fmt::format("{}, but by its shape it stands on {} = 0 or is flat there", what, likely->axis),
      advice.up_axis.empty() ? ""
      : likely->is_sure      ? flag(advice.up_axis)
                             : "if it lies on its side: " + flag(advice.up_axis)};
}

Finding place_finding(const MeshReport& report, const Scenario& scenario, const Advice& advice,
                      bool bounds_auto) {
  const Box3& box = report.lint.box_m;
  const Vec3 lo = box.min();
  const Vec3 hi = box.max();
  const std::string span =
      fmt::format("x {} to {}, y {} to {}, z {} to {} m", metres(lo.x()), metres(hi.x()),
                  metres(lo.y()), metres(hi.y()), metres(lo.z()), metres(hi.z()));
  const double away_m = farthest_m(box);
  const std::string nearer = advice.is_far ? flag(advice.offset) : "put the size right first";
  if (away_m > reach_m(scenario)) {
    return {
        "place", Severity::error,
        fmt::format("{}: the map reaches only {:.0f} m from the origin", span, reach_m(scenario)),
        nearer};
  }
  if (away_m > kGroundReach_m) {
    return {"place", Severity::warning,
            fmt::format("{}: the ground ends {:.0f} m from the origin, and float coordinates are "
                        "{:.1g} m apart there",
                        span, kGroundReach_m, away_m * 0x1p-23),
            nearer};
  }
  if (bounds_auto) return {"place", Severity::ok, span + ", a workspace around it", ""};
  if (!is_inside_workspace(scenario, bounds_m(report.reading.mesh))) {
    return {"place", Severity::note,
            fmt::format("{}: outside the workspace of the scenario '{}'", span, scenario.name),
            advice.needs_bounds ? "--bounds auto, which lays the workspace around it" : ""};
  }
  return {"place", Severity::ok, span, ""};
}

/// What stands in the way of a workspace around it, or of the scenario's start.
void add_flight_findings(const Advice& advice, bool bounds_auto, Findings& out) {
  if (!advice.start_fault.empty()) {
    out.push_back({"start", Severity::warning, advice.start_fault, "--bounds auto"});
  }
  const Severity severity = bounds_auto ? Severity::error : Severity::warning;
  if (!advice.bounds_fault.empty()) {
    out.push_back({"map", severity, advice.bounds_fault, ""});
  } else if (!advice.resolution.empty()) {
    out.push_back({"map", severity, advice.resolution_fault, flag(advice.resolution)});
  }
}

Finding ground_finding(const MeshReport& report, const Scenario& scenario, const Advice& advice) {
  const Box3& box_m = report.lint.box_m;
  const double lowest_m = box_m.min().z();
  if (!scenario.terrain.path.empty()) {
    return {"ground", Severity::ok, "the terrain takes its place", ""};
  }
  if (!scenario.structure.ground) {
    return {"ground", Severity::ok, "structure.ground is off", ""};
  }
  if (lowest_m < -may_sink_m(box_m)) {
    return {"ground", Severity::warning,
            fmt::format("reaches {:.3g} m below the ground (z = 0), with {} of its surface",
                        -lowest_m, percent(share_below(report.lint, report.reading.mesh, 0.0))),
            flag(advice.offset)};
  }
  if (lowest_m > may_float_m(box_m)) {
    return {"ground", Severity::note, fmt::format("floats {:.3g} m above the ground", lowest_m),
            advice.offset.empty() ? "" : "if it should stand: " + flag(advice.offset)};
  }
  return {"ground", Severity::ok, fmt::format("lowest point at z = {} m", metres(lowest_m)), ""};
}

Finding floor_finding(const MeshReport& report, const Scenario& scenario, const Advice& advice) {
  const double floor_m = scenario.planner.floor_z_m;
  const double share = share_below(report.lint, report.reading.mesh, floor_m);
  const std::string what = fmt::format(
      "{} of the surface lies below planner.floor_z_m = {} m, where nothing is mapped or counted",
      percent(share), floor_m);
  const std::string fix =
      advice.floor.empty() ? "" : flag(advice.floor) + ", or raise it with structure.file.offset_m";
  if (share < 0.01) return {"floor", Severity::ok, what, fix};
  if (share < 0.5) return {"floor", Severity::note, what, fix};
  return {"floor", share < 1.0 ? Severity::warning : Severity::error, what, fix};
}

void add_face_findings(const MeshReport& report, Findings& out) {
  const MeshLint& lint = report.lint;
  const double area_m2 = std::max(lint.sound.area_m2, 1e-300);
  const std::size_t flat = lint.repeated_corners + lint.flat_faces;
  out.push_back(tallied(
      "flat faces", flat, Severity::note, "every face has an area",
      fmt::format("{} without area ({} a point twice), left out when the file is read",
                  counted(flat, "face", "faces"), counted(lint.repeated_corners, "names", "name")),
      ""));
  out.push_back(
      tallied("duplicates", lint.duplicate.count, Severity::note, "no face is there twice",
              fmt::format("{} another one ({} of the surface)",
                          counted(lint.duplicate.count, "face repeats", "faces repeat"),
                          percent(lint.duplicate.area_m2 / area_m2)),
              "none needed; MeshLab: Filters > Cleaning and Repairing > Remove Duplicate Faces"));
  out.push_back(tallied("two-sided", lint.two_sided.count, Severity::note,
                        "no face lies back to back with another",
                        fmt::format("{} back to back ({} of the surface): the sheet counts twice "
                                    "in the area, once in the coverage",
                                    counted(lint.two_sided.count, "face lies", "faces lie"),
                                    percent(lint.two_sided.area_m2 / area_m2)),
                        ""));
  out.push_back(tallied(
      "edges", lint.open_edges + lint.crowded_edges, Severity::note,
      "closed: every edge joins two faces",
      fmt::format("of {} {} open, {} more than two faces; nothing here needs a closed mesh",
                  counted(lint.edges, "edge", "edges"), counted(lint.open_edges, "is", "are"),
                  counted(lint.crowded_edges, "joins", "join")),
      ""));
}

/// Which pictures were found, and what they take.
void add_texture_finding(const TriangleMesh& mesh, Findings& out) {
  if (mesh.face_looks.empty()) return;
  constexpr std::size_t kMostNamed = 8;
  const std::vector<const Texture*> textures = textures_of(mesh);
  std::string names;
  for (std::size_t i = 0; i < std::min(textures.size(), kMostNamed); ++i) {
    const Image& image = *textures[i]->image;
    names += fmt::format("{}{} {} x {}", i == 0 ? ": " : ", ", textures[i]->name, image.width_px,
                         image.height_px);
  }
  if (textures.size() > kMostNamed) names += fmt::format(", {} more", textures.size() - kMostNamed);
  const std::size_t of_corners = mesh.face_looks.size() * sizeof(mesh.face_looks[0]);
  out.push_back({"textures", Severity::ok,
                 fmt::format("{}, {:.1f} MB of pixels, and {:.1f} MB of what corners look like{}",
                             counted(textures.size(), "picture", "pictures"),
                             1e-6 * static_cast<double>(bytes_of(textures)),
                             1e-6 * static_cast<double>(of_corners), names),
                 ""});
}

Finding vertices_finding(const MeshReport& report) {
  const MeshLint& lint = report.lint;
  const double slack_m = 1e-3;  // as in load_world()
  const Box3 around(Vec3(lint.box_m.min() - Vec3::Constant(slack_m)),
                    Vec3(lint.box_m.max() + Vec3::Constant(slack_m)));
  const bool widens =
      lint.unreferenced_vertices > 0 && !around.contains(bounds_m(report.reading.mesh));
  return tallied(
      "vertices", lint.unreferenced_vertices, widens ? Severity::warning : Severity::note,
      "every vertex belongs to a face",
      fmt::format("{} to no face{}",
                  counted(lint.unreferenced_vertices, "vertex belongs", "vertices belong"),
                  widens ? ", which widens the box of the structure" : ""),
      "Blender: Mesh > Clean Up > Delete Loose; MeshLab: Filters > Cleaning and Repairing > Remove "
      "Unreferenced Vertices");
}

void add_view_findings(const MeshReport& report, Findings& out) {
  const OutsideView& view = report.outside;
  const FaceTally& behind = view.from_behind;
  const double share = behind.area_m2 / view.area_m2;
  out.push_back(
      tallied("facing", behind.count, share > 0.05 ? Severity::warning : Severity::note,
              "no face shows only its back to the outside",
              fmt::format("{}{} only the back to the outside ({} of the surface); the sensors see "
                          "both sides, other programs may not",
                          view.is_estimate ? "about " : "",
                          counted(behind.count, "face shows", "faces show"), percent(share)),
              "Blender: Edit Mode, Mesh > Normals > Recalculate Outside"));
  const double hidden = view.hidden_area_m2 / view.area_m2;
  const std::string what =
      fmt::format("{} of the surface cannot be seen from anywhere outside{}", percent(hidden),
                  hidden < 0.01 ? "" : "; only the raw reference counts it");
  if (hidden < 0.5) {
    out.push_back({"hidden", hidden < 0.01 ? Severity::ok : Severity::note, what, ""});
  } else {
    out.push_back({"hidden", Severity::warning, what,
                   "if the inside is not wanted, delete it (MeshLab: ambient occlusion, then "
                   "select the dark faces)"});
  }
}

}  // namespace

std::vector<Finding> findings_of(const MeshReport& report, const Scenario& scenario,
                                 bool bounds_auto) {
  Findings out;
  for (const std::string& warning : report.reading.warnings) {
    out.push_back({"file", Severity::warning, warning, "export the mesh again, if it matters"});
  }
  const MeshLint& lint = report.lint;
  const std::size_t lost = report.reading.lost_faces;
  const std::size_t held = lost + report.reading.mesh.faces.size();
  if (has_lost_more(report.reading, scenario.structure.file.lost_max)) {
    out.push_back({"lost", Severity::error,
                   fmt::format("{} of {} could not be used: this is not the shape that was meant",
                               lost, counted(held, "face", "faces")),
                   "export the mesh again"});
  }
  out.push_back(tallied(
      "coordinates", lint.not_finite_vertices, Severity::error, "all are finite numbers",
      fmt::format(
          "{} of {} NaN or infinite: {}", counted(lint.not_finite_vertices, "vertex", "vertices"),
          counted(lint.not_finite_faces, "face is", "faces are"), report.reading.not_finite),
      "export the mesh again, or delete these vertices"));
  if (lint.sound.count == 0) {
    out.push_back({"faces", Severity::error, "no face has an area", ""});
    return out;
  }
  out.push_back(units_finding(report.reading, scenario));
  const Advice& advice = report.advice;
  out.push_back(size_finding(report, advice));
  out.push_back(up_axis_finding(report, scenario, advice));
  out.push_back(place_finding(report, scenario, advice, bounds_auto));
  out.push_back(ground_finding(report, scenario, advice));
  out.push_back(floor_finding(report, scenario, advice));
  add_flight_findings(advice, bounds_auto, out);
  if (const std::string note = clearing_note(scenario); !note.empty()) {
    out.push_back({"returns", Severity::warning, note, flag("planner.map.no_return=unknown")});
  }
  add_texture_finding(report.reading.mesh, out);
  out.push_back(vertices_finding(report));
  add_face_findings(report, out);
  add_view_findings(report, out);
  return out;
}

}  // namespace gnbv
