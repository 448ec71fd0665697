#include "tools/report/run_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/compare/paper_figures.hpp"
#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/report/packed_json.hpp"
#include "tools/report/thinning.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxFaces = 120'000;
constexpr std::size_t kFewFaces = 100;  // are never too many

template <typename Value>
Json column(const std::vector<ViewRecord>& views, const Value& value_of) {
  Json values = Json::array();
  for (const ViewRecord& view : views) values.push_back(value_of(view));
  return values;
}

Json matrix_json(const Isometry& T) {  // column by column
  Json json = Json::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) json.push_back(T(r, c));
  }
  return json;
}

/// Of all cameras, as the gimbal had them.
Json mountings_json(const Scenario& scenario, const ViewRecord& view) {
  Json all = Json::array();
  for (const CameraConfig& camera : scenario.cameras) {
    const double pitch_rad = view.decision.view.gimbal_pitch_rad;
    all.push_back(matrix_json(turned(make_camera_model(camera), pitch_rad).T_body_camera));
  }
  return all;
}

/// A column a key; seconds and metres from the first view on, the latter as planned.
Json views_json(const RunRecord& record) {
  const std::vector<ViewRecord>& views = record.views;
  const double begin_s = views.empty() ? 0.0 : views.front().time_s;
  const auto of = [&](const auto& value_of) { return column(views, value_of); };
  using V = const ViewRecord&;
  Json json = {{"x", of([](V v) { return v.decision.view.p_world_m.x(); })},
               {"y", of([](V v) { return v.decision.view.p_world_m.y(); })},
               {"z", of([](V v) { return v.decision.view.p_world_m.z(); })},
               {"yaw", of([](V v) { return v.decision.view.yaw_rad; })},
               {"time", of([](V v) { return v.time_s; })},
               {"seconds", of([&](V v) { return v.time_s - begin_s; })},
               {"metres", of([](V v) { return v.straight_m; })},
               {"sampler", of([](V v) { return traits_of(v.decision.sampler).name; })},
               {"candidates", of([](V v) { return v.decision.candidates; })},
               {"valid", of([](V v) { return v.decision.valid; })},
               {"utility", of([](V v) { return v.decision.score.value; })},
               {"information", of([](V v) { return v.decision.score.information; })},
               {"density_term", of([](V v) { return v.decision.score.density; })},
               {"prediction", of([](V v) { return v.decision.score.prediction; })},
               {"distance_factor", of([](V v) { return v.decision.score.distance; })},
               {"entropy", of([](V v) { return v.entropy_nat; })},
               {"density", of([](V v) { return v.density_points_per_voxel; })},
               {"points", of([](V v) { return v.cloud_points; })}};
  if (gimbal_of(record.scenario.cameras)) {
    json["T_body_camera"] = of([&](V v) { return mountings_json(record.scenario, v); });
  }
  return json;
}

Json figures_json(const RunFigures& f) {
  return {{"termination", f.termination},
          {"iterations", f.iterations},
          {"entropy_reduction", f.entropy_reduction_nat},
          {"straight_m", f.straight_m},
          {"profile_m", f.before.profile_m},
          {"flight_time_s", f.flight_time_s},
          {"energy_wh", f.energy_wh},
          {"coverage", f.coverage_final},
          {"f_5cm", f.distances.at[1].f},
          {"density", f.density_points_per_voxel},
          {"version", f.version},
          {"result_sha256", f.result_sha256},
          {"curve", {{"coverage", f.curve.coverage}}}};
}

/// Where the paper's mission of this utility ended, to mark it in the plots; null without one.
Json paper_json(const RunRecord& record) {
  if (!record.figures || !has_papers_setting(record.scenario)) return nullptr;
  const PaperTable* const paper = find_paper_table(record.scenario.name);
  if (paper == nullptr || !is_papers_structure(*paper, record.figures->structure)) return nullptr;
  const PaperRow* const row = find_row(*paper, record.scenario.planner.utility.name);
  if (row == nullptr || !row->iterations) return nullptr;
  Json json = {{"label", row->label}, {"views", *row->iterations}};
  if (row->distance_m) json["metres"] = *row->distance_m;
  if (row->time_min) json["seconds"] = 60.0 * *row->time_min;
  if (row->coverage_percent) json["coverage_percent"] = *row->coverage_percent;
  json["is_doubtful"] = is_doubtful(*row);
  if (row->density_points_per_voxel) json["density"] = *row->density_points_per_voxel;
  return json;
}

Json cameras_json(const Scenario& scenario) {
  Json cameras = Json::array();
  for (const CameraConfig& config : scenario.cameras) {
    cameras.push_back({{"name", config.name},
                       {"fov_x", config.fov_x_rad},
                       {"fov_y", config.fov_y_rad},
                       {"range_m", config.range_max_m},
                       {"T_body_camera", matrix_json(make_camera_model(config).T_body_camera)}});
  }
  return cameras;
}

Json vehicle_json(const Scenario& scenario) {
  Json rotors = Json::array();
  for (const RotorMount& rotor : scenario.vehicle.airframe.rotors) {
    rotors.push_back({rotor.p_body_m.x(), rotor.p_body_m.y(), rotor.p_body_m.z()});
  }
  return {{"rotors", rotors}, {"radius_m", scenario.vehicle.airframe.hull_radius_m}};
}

/// Without the backticks that mark it in a sentence: the page gives it a place of its own.
std::string bare_command_to_fly_again(const std::filesystem::path& folder,
                                      const std::string& options) {
  const std::string marked = command_to_fly_again(folder, options);
  return marked.substr(1, marked.size() - 2);
}

}  // namespace

Json table_json(const TextTable& table) {
  Json json = {{"title", table.title}, {"columns", Json::array()}, {"rows", Json::array()}};
  const auto says_nothing = [&](std::size_t column) {
    return std::all_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return row[column].text == "-"; });
  };
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (says_nothing(i)) continue;
    const TableColumn& c = table.columns[i];
    shown.push_back(i);
    json["columns"].push_back({{"head", c.head}, {"is_number", c.kind != ColumnKind::text}});
  }
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const std::size_t i : shown) cells.push_back(row[i].text);
    json["rows"].push_back(cells);
  }
  json["notes"] = table.notes;
  return json;
}

Json mesh_json(const TriangleMesh& mesh, std::size_t max_bytes, BytePack& bytes) {
  const auto bytes_of = [](const TriangleMesh& m) {
    return 12 * m.faces.size() + 6 * m.vertices_m.size() + 3;
  };
  TriangleMesh small = with_fewer_faces(mesh, kMaxFaces);
  while (bytes_of(small) > max_bytes && small.faces.size() > kFewFaces) {
    small = with_fewer_faces(mesh, small.faces.size() / 4 * 3);
  }
  Json json = {{"vertices", points_json(pack_points(small.vertices_m, bytes))},
               {"all_faces", mesh.faces.size()},
               {"parts", Json::array()}};
  for (std::size_t m = 0; m < small.materials.size(); ++m) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < small.faces.size(); ++i) {
      if ((small.face_material.empty() ? 0 : small.face_material[i]) != m) continue;
      corners.insert(corners.end(), small.faces[i].begin(), small.faces[i].end());
    }
    if (corners.empty()) continue;
    const Material& material = small.materials[m];
    Json rgb = Json::array();  // linear; what the eye makes of a pattern from afar
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_plain = material.pattern == Pattern::plain;
      rgb.push_back(is_plain ? material.rgb[k] : 0.7F * material.rgb[k] + 0.3F * material.rgb_2[k]);
    }
    json["parts"].push_back({{"rgb", rgb}, {"corners", slice_json(bytes.add(corners))}});
  }
  return json;
}

Json true_voxels_json(const TrueVoxels& voxels, BytePack& bytes) {
  if (voxels.codes.empty()) return nullptr;
  return {{"size_m", voxels.size_m}, {"index", slice_json(bytes.add(voxel_indices(voxels)))}};
}

Json run_json(const RunRecord& record, const std::string& label, const PackedRun& packed,
              int mesh) {
  const Scenario& scenario = record.scenario;
  Json missing = record.missing;
  for (const std::string& sentence : packed.missing) missing.push_back(sentence);
  Json json = {
      {"label", label},
      {"structure", structure_name(scenario.structure)},
      {"utility", utility_label(scenario.planner.utility)},
      {"preset", scenario.planner.preset},
      {"seed", scenario.seed},
      {"folder", record.folder.string()},
      {"command",
       bare_command_to_fly_again(record.folder, packed.cameras.empty() ? "" : "--frames")},
      {"yaml", read_file(record.folder / kScenarioFile)},
      {"missing", missing},
      {"workspace",
       {{"min", vector_json(scenario.workspace_m.min().cast<float>())},
        {"max", vector_json(scenario.workspace_m.max().cast<float>())}}},
      {"has_ground", has_flat_ground(scenario)},
      {"profile_end_s", record.profile_end_s ? Json(*record.profile_end_s) : Json(nullptr)},
      {"views_begin_s", record.views_begin_s ? Json(*record.views_begin_s) : Json(nullptr)},
      {"mesh", mesh},
      {"cameras", cameras_json(scenario)},
      {"vehicle", vehicle_json(scenario)},
      {"views", views_json(record)},
      {"figures", record.figures ? figures_json(*record.figures) : Json(nullptr)},
      {"paper", paper_json(record)}};
  json.update(packed_json(packed, scenario.planner.map.resolution_m));
  return json;
}

}  // namespace gnbv
