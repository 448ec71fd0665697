#include "tools/render/panel_layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kLeastPanel_px = 4;

bool leaves_room(const FrameMargins& margins) {
  return margins.left + margins.right < 1.0 && margins.top + margins.bottom < 1.0;
}

/// What has to be seen in a picture of one panel, and the corners that are taken.
struct Lone {
  const PictureKind& kind;
  const PictureOptions& options;
  std::vector<Vec3> points_world_m;
  std::array<double, 2> title_px;  // from the upper left corner
  std::array<double, 2> inset_px;  // from the upper right one
};

/// Whether something that has to be seen lies behind the title, or the inset.
bool is_covered(const Lone& lone, const RenderView& view) {
  const auto& all = lone.points_world_m;
  return std::any_of(all.begin(), all.end(), [&](const Vec3& p_world_m) {
    const std::optional<Vec3> p = project(view, p_world_m);
    if (!p) return false;
    const bool meets_title = p->x() < lone.title_px[0] && p->y() < lone.title_px[1];
    const bool meets_inset = p->x() > view.width_px - lone.inset_px[0] && p->y() < lone.inset_px[1];
    return meets_title || meets_inset;
  });
}

/// Those of the whole picture first; then, step by step, more above, as far as below title and
/// inset, and more at the right, as far as beside the inset.
std::vector<FrameMargins> margins_to_try(const Lone& lone) {
  if (!has_words(lone.options)) return {FrameMargins{}};
  const int width_px = lone.options.width_px;
  const int height_px = lone.options.height_px;
  const double u = unit_px(lone.options);
  const FrameMargins whole = caption_margins(width_px, height_px, u, lone.kind.legend_rows);
  const double beside_px = 4.0 * u;
  const double below = (lone.title_px[1] + beside_px) / height_px;
  const double below_all = (std::max(lone.title_px[1], lone.inset_px[1]) + beside_px) / height_px;
  constexpr int kSteps = 4;
  std::vector<FrameMargins> all;
  for (int right = 0; right <= (lone.kind.has_inset ? kSteps : 0); ++right) {
    for (const double top : {whole.top, below, 0.5 * (below + below_all), below_all}) {
      FrameMargins margins = whole;
      margins.top = std::max(whole.top, top);
      margins.right += lone.inset_px[0] / width_px * right / kSteps;
      if (leaves_room(margins)) all.push_back(margins);
    }
  }
  return all;
}

/// The largest of those that nothing covers; or else the first.
std::optional<RenderView> framed_alone(const Lone& lone) {
  const PictureOptions& options = lone.options;
  std::optional<RenderView> first;
  std::optional<RenderView> best;
  for (const FrameMargins& margins : margins_to_try(lone)) {
    const RenderView view =
        frame_points(lone.points_world_m, options.angles.value_or(lone.kind.angles),
                     options.width_px, options.height_px, margins);
    if (!first) first = view;
    if (best && px_per_m_at_focus(view) <= px_per_m_at_focus(*best)) continue;
    if (!is_covered(lone, view)) best = view;
  }
  return best ? best : first;
}

Lone lone_picture(const PictureKind& kind, std::span<RunSource* const> runs,
                  const PictureOptions& options, std::vector<Vec3> points_world_m) {
  Lone lone{kind, options, std::move(points_world_m), {0.0, 0.0}, {0.0, 0.0}};
  if (!has_words(options)) return lone;
  const double u = unit_px(options);
  lone.title_px = {kind.words_width * u, 78.0 * u};
  if (!kind.has_inset) return lone;
  lone.inset_px[0] = kInsetShare * options.width_px + (kInsetBorder + 2.0) * u;
  for (RunSource* const run : runs) {
    const CameraConfig& camera = run->record().scenario.cameras.front();
    const double height_px = kInsetShare * options.width_px * camera.height_px / camera.width_px;
    lone.inset_px[1] =
        std::max(lone.inset_px[1], height_px + (kInsetBorder + kInsetWords + 2.0) * u);
  }
  return lone;
}

/// So many columns; nothing where they leave no panel worth the name.
std::optional<PanelLayout> in_columns(const PictureKind& kind, const PictureOptions& options,
                                      int columns) {
  PanelLayout layout{.columns = columns, .rows = (kind.panels + columns - 1) / columns, .view = {}};
  const double u = unit_px(options);
  const auto px = [&](double units) { return static_cast<int>(std::lround(units * u)); };
  layout.gap_px = std::max(2, px(6.0));
  if (has_words(options)) {
    layout.head_px = px(74.0);
    layout.note_px = px(26.0);
    layout.foot_px = std::min(options.height_px / 4,
                              px(legend_paper_height(kind.legend_rows, options.width_px / u)));
  }
  const auto shared = [](int whole_px, int parts, int gaps_px) {
    return (whole_px - gaps_px + parts - 1) / parts;
  };
  layout.view.width_px = shared(options.width_px, columns, (columns - 1) * layout.gap_px);
  const int rest_px = options.height_px - layout.head_px - layout.foot_px;
  const int between_px =
      has_words(options) ? layout.rows * layout.note_px : (layout.rows - 1) * layout.gap_px;
  layout.view.height_px = shared(rest_px, layout.rows, between_px);
  const bool is_none =
      layout.view.width_px < kLeastPanel_px || layout.view.height_px < kLeastPanel_px;
  return is_none ? std::nullopt : std::optional(layout);
}

/// As seen from that direction, or from the one near it that shows the most where it may be turned.
std::optional<RenderView> framed_panel(const PictureKind& kind, const PictureOptions& options,
                                       const RenderView& panel,
                                       const std::vector<Vec3>& points_world_m) {
  const double u = unit_px(options);
  FrameMargins margins;
  if (has_words(options)) margins.bottom = 36.0 * u / panel.height_px;  // the scale's
  if (!leaves_room(margins)) return std::nullopt;
  std::optional<RenderView> best;
  for (const double share : {0.0, 0.5, 1.0}) {
    ViewAngles angles = options.angles.value_or(kind.angles);
    if (!options.angles) angles.azimuth_rad += share * kind.turn_rad;
    const RenderView view =
        frame_points(points_world_m, angles, panel.width_px, panel.height_px, margins);
    if (!best || px_per_m_at_focus(view) > px_per_m_at_focus(*best)) best = view;
  }
  return best;
}

}  // namespace

std::array<int, 2> PanelLayout::place_px(std::size_t i) const {
  const int column = static_cast<int>(i) % columns;
  const int row = static_cast<int>(i) / columns;
  const int between_px = note_px > 0 ? note_px : gap_px;
  return {column * (view.width_px + gap_px),
          head_px + note_px + row * (view.height_px + between_px)};
}

double panel_unit_m(const PictureOptions& options, const RenderView& panel) {
  constexpr double kThinner = 0.7;
  return kThinner * unit_px(options) / px_per_m_at_focus(panel);
}

bool has_words(const PictureOptions& options) {
  return options.has_caption && fits_caption(options.width_px, options.height_px);
}

PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& asked) {
  PictureOptions options = asked;
  if (kind.best_angles != nullptr && !options.angles && !options.camera) {
    options.angles = kind.best_angles(runs, asked);
  }
  std::vector<Vec3> points;
  for (RunSource* const run : runs) kind.frame(*run, options, points);
  std::optional<PanelLayout> best;
  for (int columns = 1; columns <= kind.panels; ++columns) {
    std::optional<PanelLayout> layout =
        kind.panels > 1 ? in_columns(kind, options, columns) : PanelLayout{};
    if (!layout) continue;
    const std::optional<RenderView> view =
        kind.panels > 1 ? framed_panel(kind, options, layout->view, points)
                        : framed_alone(lone_picture(kind, runs, options, points));
    if (!view) continue;
    layout->view = *view;
    const bool is_larger = !best || px_per_m_at_focus(layout->view) > px_per_m_at_focus(best->view);
    if (is_larger) best = layout;
  }
  GNBV_CHECK(best.has_value(), "{} x {} px: no room for a panel", options.width_px,
             options.height_px);
  if (options.camera) {
    RenderView& view = best->view;
    view.T_world_camera = options.camera->T_world_camera;
    view.fov_y_rad = options.camera->fov_y_rad;
    view.focus_m = options.camera->focus_m;
    view.to_light_world = options.camera->to_light_world;
  }
  return *best;
}

}  // namespace gnbv
