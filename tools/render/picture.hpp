// What every kind of picture of a run has in common. A kind is two functions of a run: what to
// frame, and what to draw when the camera is known.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/scene/run_source.hpp"
#include "tools/scene/scene.hpp"

namespace gnbv {

/// What a user may choose.
struct PictureOptions {
  int width_px = 1280;
  int height_px = 720;
  std::optional<ViewAngles> angles = {};  // nothing: as suits the kind
  std::optional<RenderView> camera = {};  // instead of the angles: its pose and opening
  std::optional<int> iteration = {};      // of a view; nothing: the last, or as the kind says
  int every = 0;             // draw each n-th frustum, take each n-th snapshot; 0: by itself
  bool has_profile = false;  // show the profile's flight, wide around the structure
  bool has_caption = true;   // pictures under 320 x 240 px never have one
  std::string title = {};    // empty: scenario and utility
  double letters = 1.0;      // how large words and marks are, of what suits a picture of its own
  /// path: what stands there instead of the structure, of pieces no longer than given (m).
  std::function<SurfaceItem(RunSource&, double)> surface = {};
  /// coverage: from where the second panel looks, where several pictures share that.
  std::optional<ViewAngles> second_angles = {};
  /// What the two ends of the colours stand for, where several pictures share them.
  std::optional<std::array<double, 2>> colour_range = {};
};

/// Appends the structure, or what the map's voxels may reach around it.
void frame_structure_alone(RunSource& run, const PictureOptions& options,
                           std::vector<Vec3>& points_world_m);
void frame_map(RunSource& run, const PictureOptions& options, std::vector<Vec3>& points_world_m);

struct PictureKind {
  std::string_view name;  // also of the file
  std::string_view shows;
  int panels = 1;
  ViewAngles angles = {};  // unless others are asked for
  int legend_rows = 1;     // of a picture of 1280 units
  bool has_inset = false;  // as large as a camera's picture
  /// From where it is best seen, for lack of an answer by the user; null: from `angles`.
  ViewAngles (*best_angles)(std::span<RunSource* const> runs,
                            const PictureOptions& options) = nullptr;
  /// Appends the points that have to be seen.
  void (*frame)(RunSource& run, const PictureOptions& options,
                std::vector<Vec3>& points_world_m) = frame_structure_alone;
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

std::span<const PictureKind* const> picture_kinds();

/// Throws BadInput naming all kinds.
const PictureKind& picture_kind(std::string_view name);

/// The options with what the ends of the colours stand for in all of those runs, so that a colour
/// means the same in each picture. Runs that lack what it takes are left out.
PictureOptions with_shared_colours(const PictureKind& kind, std::span<RunSource* const> runs,
                                   PictureOptions options);

/// The options with one direction for the second panels of all of those runs, so that pictures in a
/// row can be compared. `view` is that of the first panels.
PictureOptions with_shared_angles(const PictureKind& kind, std::span<RunSource* const> runs,
                                  PictureOptions options, const RenderView& view);

/// Whether a picture is large enough for words, and shows any.
bool has_words(const PictureOptions& options);

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

/// " after 7 of 12 views (iteration 6)" where one was asked for.
std::string words_on_iteration(const RunRecord& record, const PictureOptions& options);

/// The points that the cloud had by the view that was asked for, or has.
std::span<const Vec3f> points_by(RunSource& run, const PictureOptions& options);

}  // namespace gnbv
