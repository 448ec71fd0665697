#include "tools/render/picture.hpp"

#include <algorithm>

#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/render/caption.hpp"
#include "tools/scene/structure.hpp"

namespace gnbv {
namespace {

constexpr std::array<const PictureKind*, 7> kKinds = {
    &kPathPicture,   &kProfilePicture,    &kCloudPicture, &kCoveragePicture,
    &kVoxelsPicture, &kCandidatesPicture, &kPlanPicture};

}  // namespace

void frame_structure_alone(RunSource& run, const PictureOptions&,
                           std::vector<Vec3>& points_world_m) {
  frame_structure(run, points_world_m);
}

void frame_map(RunSource& run, const PictureOptions&, std::vector<Vec3>& points_world_m) {
  const Vec3 beside_m = Vec3::Constant(run.record().scenario.planner.map.resolution_m);
  for (const Vec3f& v : run.world().structure.vertices_m) {
    const auto reach = corners_m(Box3(v.cast<double>() - beside_m, v.cast<double>() + beside_m));
    points_world_m.insert(points_world_m.end(), reach.begin(), reach.end());
  }
}

std::span<const PictureKind* const> picture_kinds() { return kKinds; }

const PictureKind& picture_kind(std::string_view name) {
  std::vector<std::string_view> names;
  for (const PictureKind* kind : kKinds) {
    if (kind->name == name) return *kind;
    names.push_back(kind->name);
  }
  names.insert(names.end(), {"snapshots", "movie", "all"});
  throw BadInput("--what {}: no such picture ({}there are: {})", name, did_you_mean(name, names),
                 join(names));
}

PictureOptions with_shared_colours(const PictureKind& kind, std::span<RunSource* const> runs,
                                   PictureOptions options) {
  if (kind.colour_range == nullptr || options.colour_range) return options;
  const PictureOptions alone = options;
  for (RunSource* const run : runs) {
    try {
      const std::array<double, 2> own = kind.colour_range(*run, alone);
      const std::array<double, 2> all = options.colour_range.value_or(own);
      options.colour_range = {std::min(all[0], own[0]), std::max(all[1], own[1])};
    } catch (const BadInput&) {  // of what the run lacks; its picture will say so
    }
  }
  return options;
}

PictureOptions with_shared_angles(const PictureKind& kind, std::span<RunSource* const> runs,
                                  PictureOptions options, const RenderView& view) {
  if (kind.second_angles != nullptr && runs.size() > 1) {
    options.second_angles = kind.second_angles(runs, options, view);
  }
  return options;
}

bool has_words(const PictureOptions& options) {
  return options.has_caption && options.width_px >= 320 && options.height_px >= 240;
}

double unit_px(const PictureOptions& options) {
  return options.letters * layout_unit_px(options.width_px, options.height_px);
}

double layout_unit_m(const RenderView& view) {
  return layout_unit_px(view.width_px, view.height_px) / px_per_m_at_focus(view);
}

std::size_t iteration_of(const RunRecord& record, const PictureOptions& options,
                         std::size_t otherwise) {
  if (record.views.empty()) throw BadInput("{}: took no view yet", record.folder.string());
  const std::size_t count = record.views.size();
  if (!options.iteration) return std::min(otherwise, count - 1);
  const auto iteration = static_cast<std::size_t>(*options.iteration);
  if (*options.iteration < 0 || iteration >= count) {
    throw BadInput("--iteration {}: {} has iterations 0 to {}", *options.iteration,
                   record.folder.string(), count - 1);
  }
  return iteration;
}

std::string views_so_far(const RunRecord& record, std::size_t iteration) {
  const std::size_t all = record.views.size();
  if (iteration + 1 == all) return counted(all, "view");
  return fmt::format("{} of {} (iteration {})", grouped(iteration + 1), counted(all, "view"),
                     iteration);
}

std::string words_on_iteration(const RunRecord& record, const PictureOptions& options) {
  if (!options.iteration) return "";
  return " after " + views_so_far(record, iteration_of(record, options, 0));
}

std::span<const Vec3f> points_by(RunSource& run, const PictureOptions& options) {
  const std::span<const Vec3f> all = run.cloud().points_world_m;
  if (!options.iteration) return all;
  return all.first(run.cloud().view_points[iteration_of(run.record(), options, 0)]);
}

}  // namespace gnbv
