// All that the program writes into a page. A struct is an object of the page's JSON, its Arrays lie
// in the block of bytes beside it. The page's TypeScript has the same types: tools/web/types.mjs
// makes them of this file when the page is bundled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/page/arrays.hpp"

/// The JSON of a struct: an object of the fields that are named, which have to be all of them.
#define GNBV_PAGE_FIELDS(Type, ...)                                                           \
  inline void to_json(nlohmann::ordered_json& nlohmann_json_j, const Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))                  \
  }

namespace gnbv::page {

using Vec3d = std::array<double, 3>;
using SceneJson = nlohmann::ordered_json;   // looks_json()
using FigureJson = nlohmann::ordered_json;  // a figure of figures_json(), its numbers as Arrays

struct Column {
  std::string head = {};
  bool is_number = false;
};
GNBV_PAGE_FIELDS(Column, head, is_number)

/// Title, columns, rows and notes as printed.
struct Table {
  std::string title = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<std::string>> rows = {};
  std::vector<std::string> notes = {};
};
GNBV_PAGE_FIELDS(Table, title, columns, rows, notes)

/// The voxels of the true surface that there are to find: each covers [index, index + 1) * size_m.
struct SurfaceData {
  double size_m = 0.0;
  Array<std::int16_t, 3> index = {};
};
GNBV_PAGE_FIELDS(SurfaceData, size_m, index)

/// The faces of one material.
struct MeshPart {
  Vec3d rgb{};  // linear; what the eye makes of a pattern from afar
  Array<std::uint32_t, 3> corners = {};
};
GNBV_PAGE_FIELDS(MeshPart, rgb, corners)

struct MeshData {
  Points vertices = {};
  std::optional<Array<std::uint16_t, 3>> colours = {};  // of vertices, linear shares of 65535
  std::size_t all_faces = 0;                            // before thinning
  std::vector<MeshPart> parts = {};                     // with `colours`, white
  std::optional<SurfaceData> surface = {};
};
GNBV_PAGE_FIELDS(MeshData, vertices, colours, all_faces, parts, surface)

/// A body that goes straight from corner to corner of its way, and stays at the last one or, where
/// the way is a loop, goes around again.
struct MoverData {
  int mesh = -1;  // among which structure, into PageData
  MeshData shape = {};
  std::vector<Vec3d> way = {};  // offsets from where the shape is, from 0 on
  double speed_m_s = 0.0;
  bool is_loop = false;
};
GNBV_PAGE_FIELDS(MoverData, mesh, shape, way, speed_m_s, is_loop)

struct CameraData {
  std::string name = {};
  double fov_x = 0.0;  // radians
  double fov_y = 0.0;
  double range_m = 0.0;
  std::vector<double> T_body_camera = {};  // 4 x 4, column by column; x right, y down, z forward
};
GNBV_PAGE_FIELDS(CameraData, name, fov_x, fov_y, range_m, T_body_camera)

/// A row a view. Seconds and metres count from the first view on, the latter as planned.
struct Views {
  Array<double, 4> pose = {};  // x, y, z, yaw
  Array<double> time = {};     // of the mission
  Array<double> seconds = {};
  Array<double> metres = {};
  std::vector<Array<double>> from_take_off = {};  // metres, seconds, Wh; after n views, from 0 on
  std::vector<std::string> sampler = {};
  Array<std::uint32_t> candidates = {};
  Array<std::uint32_t> valid = {};
  Array<std::uint32_t> plan_view =
      {};  // its number in its plan: what tells of decisions tells of 1
  std::optional<Array<double, 16>> T_body_camera = {};  // a row a camera; where a gimbal turns some
};
GNBV_PAGE_FIELDS(Views, pose, time, seconds, metres, from_take_off, sampler, candidates, valid,
                 plan_view, T_body_camera)

struct Figures {
  std::string termination = {};
  std::string version = {};
  std::string result_sha256 = {};
  Array<double> curve = {};  // (views + 1): coverage at 0.05 m
};
GNBV_PAGE_FIELDS(Figures, termination, version, result_sha256, curve)

/// One of what a run comes down to, as printed.
struct KeyFigure {
  std::string name = {};
  std::string value = {};
  std::string unit = {};
  std::string paper = {};  // of the paper's mission of the same utility; may be empty
};
GNBV_PAGE_FIELDS(KeyFigure, name, value, unit, paper)

struct CloudData {
  Points points = {};               // in the order of growth
  Array<std::uint32_t> after = {};  // (views + 1): how many there are after the first n views
  std::optional<Array<std::uint8_t, 3>> colour = {};  // sRGB, as the cameras saw them
  std::optional<Array<std::uint8_t>> error = {};  // mm off the structure; 255: not of the structure
  double error_most_mm = 0.0;                     // of the scale of their colours
  double error_median_mm = 0.0;
  std::size_t all_points = 0;  // before thinning
  double cell_m = 0.0;         // of the thinning; 0: none
};
GNBV_PAGE_FIELDS(CloudData, points, after, colour, error, error_most_mm, error_median_mm,
                 all_points, cell_m)

/// The map's voxels that hold points of the cloud, in the order in which they first did, and how
/// many of the whole cloud's points each held after every view. State n is that after n views; what
/// came after the last view counts to it.
struct VoxelData {
  double size_m = 0.0;  // the map's, or twice, four times ... that, so that the page can carry them
  Array<std::int16_t, 3> index = {};  // the voxel covers [index, index + 1) * size_m
  Array<std::uint32_t> after = {};    // (states): how many voxels there are; the first ones
  Numbers gains = {};  // of each voxel that got points on the way to a state, in their order: the
                       // step from the one before (the first from voxel 0), then the points
  Array<std::uint32_t> gains_after = {};  // (states): numbers in `gains` up to this state
};
GNBV_PAGE_FIELDS(VoxelData, size_m, index, after, gains, gains_after)

/// The flown path.
struct PathData {
  Points points = {};
  Array<float> time = {};                  // seconds
  Array<std::int16_t, 4> quaternion = {};  // x y z w in steps of 1 / 32767, body in world
};
GNBV_PAGE_FIELDS(PathData, points, time, quaternion)

/// What of a tour is still to come. Each plan's views stand in a row, so that what is left of one
/// is a range of them.
struct PlanData {
  Array<float, 7> poses = {};  // place of the body, then the first camera in the world, x y z w
  Array<std::uint32_t, 2> ranges =
      {};  // (views): begin and end of the poses to come after each view
};
GNBV_PAGE_FIELDS(PlanData, poses, ranges)

/// What became of a candidate that was not rejected; a Rejection's number otherwise.
constexpr std::uint8_t kKeptCandidate = 253;  // a view of a burst
constexpr std::uint8_t kValidCandidate = 254;
constexpr std::uint8_t kChosenCandidate = 255;

/// Of all decisions, in the order of their views, each as it was sampled.
struct CandidateData {
  Points points = {};
  Array<float, 2> angles = {};    // yaw, the gimbal's pitch
  Array<std::uint8_t> kind = {};  // see kValidCandidate
  Array<float, 5> terms = {};     // of those that were not rejected: utility, or in a burst the
                                  // points covered, information, density, prediction, distance
                                  // factor
  Array<std::uint32_t, 2> begins = {};  // (views + 1): the first one of the decision whose first
                                        // view each is, and of its terms; and the ends
};
GNBV_PAGE_FIELDS(CandidateData, points, angles, kind, terms, begins)

/// Cells of one kind, of each view's decision.
struct BeliefList {
  Numbers runs = {};  // of each run of cells the gap to the end of the one before, then its length
  Array<std::uint32_t> begins =
      {};  // (views + 1): the first number of each view's runs, and the end
  Array<std::uint32_t> counts = {};  // (views): how many of the map's voxels they are
  bool has_changes = false;  // runs are of the cells that are in the list of one of two views
                             // alone: the view, and the one before it that has any
};
GNBV_PAGE_FIELDS(BeliefList, runs, begins, counts, has_changes)

/// For whose sake each view was chosen. Cell i of the lattice covers [low + i, low + i + 1) *
/// size_m; cells count along x first, then y, then z. A list that holds nothing is not there.
struct BeliefData {
  double size_m = 0.0;  // the map's, or twice, four times ... that, so that the page can carry them
  double map_m = 0.0;
  std::array<int, 3> low{};
  std::array<int, 3> cells{};
  std::optional<BeliefList> unknown = {};
  std::optional<BeliefList> predicted = {};
  std::optional<BeliefList> frontier = {};
  std::optional<BeliefList> looked_at = {};
};
GNBV_PAGE_FIELDS(BeliefData, size_m, map_m, low, cells, unknown, predicted, frontier, looked_at)

/// A picture of a camera, colour and depth as JPEG.
struct FrameData {
  int view = 0;
  std::string camera = {};
  int width_px = 0;
  int height_px = 0;
  Array<std::uint8_t> jpeg = {};
  Array<std::uint8_t> depth_jpeg = {};
};
GNBV_PAGE_FIELDS(FrameData, view, camera, width_px, height_px, jpeg, depth_jpeg)

/// One of what a plot can show: figures of figures.schema.json by Effort, a line a run; and, where
/// runs differ in their seeds alone, their means.
struct PlotChoice {
  std::string label = {};
  std::vector<FigureJson> runs = {};
  std::vector<FigureJson> means = {};
};
GNBV_PAGE_FIELDS(PlotChoice, label, runs, means)

struct Plot {
  std::string title = {};
  std::string note = {};
  std::string chooses = {};  // what its choices are of
  std::vector<PlotChoice> choices = {};
};
GNBV_PAGE_FIELDS(Plot, title, note, chooses, choices)

struct RunData {
  std::string label = {};
  std::string colour = {};
  std::string structure = {};
  std::string preset = {};
  std::uint64_t seed = 0;
  std::string command = {};  // that flies it again
  std::string yaml = {};
  std::vector<std::string> missing = {};  // a sentence each
  Vec3d workspace_min{};
  Vec3d workspace_max{};
  double grid_m = 0.0;  // of lines on the ground: 8 to 20 each way
  bool has_ground = false;
  std::optional<double> profile_end_s = {};
  std::optional<double> views_begin_s = {};
  int mesh = -1;  // into PageData; -1: none
  std::vector<CameraData> cameras = {};
  std::vector<Vec3d> rotors = {};
  double radius_m = 0.0;  // of the vehicle
  Views views = {};
  std::optional<Figures> figures = {};
  std::vector<KeyFigure> key_figures = {};
  std::optional<CloudData> cloud = {};
  std::optional<Array<std::uint16_t>> found = {};  // see views_until_found()
  std::optional<CandidateData> candidates = {};
  std::optional<BeliefData> beliefs = {};
  std::optional<Array<std::uint8_t>> surface = {};  // surface.glb, as `gnbv surface` wrote it
  std::optional<VoxelData> voxels = {};
  std::optional<PathData> path = {};
  std::optional<PlanData> plan = {};
  std::vector<FrameData> frames = {};
};
GNBV_PAGE_FIELDS(RunData, label, colour, structure, preset, seed, command, yaml, missing,
                 workspace_min, workspace_max, grid_m, has_ground, profile_end_s, views_begin_s,
                 mesh, cameras, rotors, radius_m, views, figures, key_figures, cloud, found,
                 candidates, beliefs, surface, voxels, path, plan, frames)

struct PageData {
  std::string title = {};
  bool is_live = false;  // served while the mission flies
  std::string version = {};
  SceneJson scene = {};
  std::vector<Table> tables = {};
  std::vector<Plot> plots = {};
  std::vector<MeshData> meshes = {};
  std::vector<MoverData> movers = {};
  std::vector<RunData> runs = {};
};
GNBV_PAGE_FIELDS(PageData, title, is_live, version, scene, tables, plots, meshes, movers, runs)

}  // namespace gnbv::page
