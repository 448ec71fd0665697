// What every kind of picture of a run has in common. A kind is three functions of a run: what to
// frame, and what to draw when the camera is known.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/render/caption.hpp"
#include "tools/render/run_source.hpp"
#include "tools/render/scene.hpp"

namespace gnbv {

/// What a user may choose.
struct PictureOptions {
  int width_px = 1280;
  int height_px = 720;
  std::optional<ViewAngles> angles = {};  // nothing: as suits the kind
  std::optional<RenderView> camera;       // instead of the angles: its pose and opening
  std::optional<int> iteration;           // of a view; nothing: the last one, or as the kind says
  int every = 0;             // draw each n-th frustum, take each n-th snapshot; 0: by itself
  bool has_profile = false;  // show the profile's flight, wide around the structure
  bool has_caption = true;   // pictures under 320 x 240 px never have one
  std::string title;         // empty: scenario and utility
  double letters = 1.0;      // how large words and marks are, of what suits a picture of its own
  /// path: what stands there instead of the structure, of pieces no longer than given (m).
  std::function<SurfaceItem(RunSource&, double)> surface = {};
  /// coverage: from where the second panel looks, where several pictures share that.
  std::optional<ViewAngles> second_angles = {};
  /// What the two ends of the colours stand for, where several pictures share them.
  std::optional<std::array<double, 2>> colour_range = {};
};

/// Words beside a place in the world; or on it, white on a badge of a colour, or on a badge that a
/// line joins to it, where no end of a line and no other such badge is.
struct PlaceLabel {
  Vec3 p_world_m;
  std::string text;
  std::optional<Rgb8> badge = {};
  bool is_aside = false;
};

/// A line between two places that shows through everything, edged in white; a dot where they are
/// one.
struct PlaceLine {
  Vec3 from_world_m, to_world_m;
  Rgb8 colour;
  double width = 0.0;  // layout units
};

/// One scene of a picture that may hold several, side by side.
struct Panel {
  RenderScene scene;
  std::string note = {};                // over the panel
  std::vector<PlaceLine> lines = {};    // over the scene, the last one uppermost
  std::vector<PlaceLabel> labels = {};  // over everything
  std::optional<RenderView> view = {};  // instead of the layout's, of its size
};

struct Picture {
  std::vector<Panel> panels = {};
  std::string detail = {};  // one line of figures
  std::vector<LegendItem> legend = {};
  Image inset = {};              // small, in the upper right corner; empty: none
  std::string inset_words = {};  // under it
  bool has_sheet = false;        // under the title, where the scene may reach behind it
};

constexpr double kInsetShare = 0.25;   // of the picture's width
constexpr double kInsetBorder = 18.0;  // layout units
constexpr double kInsetWords = 22.0;   // of the paper below it

struct PictureKind {
  std::string_view name;  // also of the file
  std::string_view shows;
  int panels = 1;
  ViewAngles angles = {};      // unless others are asked for
  double turn_rad = 0.0;       // its angles may be turned so far about z to show more
  int legend_rows = 1;         // of a picture of 1280 units
  double words_width = 520.0;  // layout units that title and figures take, about
  bool has_inset = false;
  /// From where it is best seen, for lack of an answer by the user; null: from `angles`.
  ViewAngles (*best_angles)(std::span<RunSource* const> runs,
                            const PictureOptions& options) = nullptr;
  /// Appends the points that have to be seen.
  void (*frame)(RunSource& run, const PictureOptions& options, std::vector<Vec3>& points_world_m);
  /// What the two ends of the colours stand for in a picture of its own; null: nothing that runs
  /// could share.
  std::array<double, 2> (*colour_range)(RunSource& run, const PictureOptions& options) = nullptr;
  /// Of several runs, from where a second panel shows the most of all; null: nothing is shared.
  std::optional<ViewAngles> (*second_angles)(std::span<RunSource* const> runs,
                                             const PictureOptions& options,
                                             const RenderView& view) = nullptr;
  /// Lines are as thick as suits `view`. Throws BadInput naming what is missing.
  Picture (*draw)(RunSource& run, const PictureOptions& options, const RenderView& view);
};

// one file each: picture_NAME.cpp
extern const PictureKind kPathPicture;
extern const PictureKind kProfilePicture;
extern const PictureKind kCloudPicture;
extern const PictureKind kCoveragePicture;
extern const PictureKind kVoxelsPicture;
extern const PictureKind kCandidatesPicture;
extern const PictureKind kPlanPicture;

/// Of the structure as add_ghost() draws it.
extern const Rgb kGhostColour;

/// Pixels of a layout unit (caption.hpp) of a picture with letters as large as asked for.
double unit_px(const PictureOptions& options);

/// Metres, at the view's subject, of a layout unit (caption.hpp).
double layout_unit_m(const RenderView& view);

/// The view that was asked for. Throws BadInput naming --iteration for one that the run did not
/// take, or a run without views.
std::size_t iteration_of(const RunRecord& record, const PictureOptions& options,
                         std::size_t otherwise);

/// "12 views", or "7 of 12 views (iteration 6)": views are counted from 1, iterations from 0, as in
/// the run's files and by --iteration.
std::string views_so_far(const RunRecord& record, std::size_t iteration);

/// Frames the structure.
void frame_structure(RunSource& run, std::vector<Vec3>& points_world_m);

/// The structure's surface in its own colours, the obstacles in one, the no_fly boxes as ghosts,
/// and the ground or the terrain if the scenario has one.
void add_structure(RunSource& run, RenderScene& scene);
/// Of that what stands around the structure, without the ground.
void add_surroundings(RunSource& run, RenderScene& scene);
/// Lays over it what the cameras see of it, which is more than the mesh's own colours.
void paint_structure(RunSource& run, const RenderView& view, RenderScene& scene);
/// Of what add_structure() puts around the structure.
std::vector<LegendItem> legend_of_surroundings(RunSource& run);
/// Structure and obstacles as pale ghosts, with the ground.
void add_ghost(RunSource& run, float opacity, RenderScene& scene);
void add_ground(RunSource& run, RenderScene& scene);

}  // namespace gnbv
