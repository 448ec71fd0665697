#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/core/error.hpp"
#include "tools/render/pictures.hpp"

namespace gnbv {
namespace {

constexpr int kLeastPanel_px = 4;

/// So many columns; nothing where they leave no panel worth the name.
std::optional<PanelLayout> in_columns(const LayoutNeeds& needs, const PictureOptions& options,
                                      int columns) {
  PanelLayout layout{.columns = columns, .rows = (needs.panels + columns - 1) / columns};
  const double u = unit_px(options);
  const auto px = [&](double units) { return static_cast<int>(std::lround(units * u)); };
  layout.gap_px = std::max(2, px(6.0));
  if (has_words(options)) {
    layout.head_px = px(74.0);
    layout.note_px = needs.panels > 1 ? px(26.0) : 0;
    const double foot = legend_paper_height(needs.legend_rows, options.width_px / u);
    if (needs.legend_rows > 0) layout.foot_px = std::min(options.height_px / 4, px(foot));
  }
  const auto shared = [](int whole_px, int parts, int gaps_px) {
    return (whole_px - gaps_px + parts - 1) / parts;
  };
  layout.view.width_px = shared(options.width_px, columns, (columns - 1) * layout.gap_px);
  const int rest_px = options.height_px - layout.head_px - layout.foot_px;
  const int between_px =
      layout.note_px > 0 ? layout.rows * layout.note_px : (layout.rows - 1) * layout.gap_px;
  layout.view.height_px = shared(rest_px, layout.rows, between_px);
  const bool is_none =
      layout.view.width_px < kLeastPanel_px || layout.view.height_px < kLeastPanel_px;
  return is_none ? std::nullopt : std::optional(layout);
}

/// The nearest view of that panel whose scale and inset hide none of the points.
std::optional<RenderView> framed(std::span<const Vec3> points_world_m, const LayoutNeeds& needs,
                                 const PictureOptions& options, const RenderView& panel) {
  const double u = unit_px(options);
  const bool has_inset = needs.inset_aspect > 0.0;
  const double inset_px[] = {
      kInsetShare * options.width_px + (kInsetBorder + 6.0) * u,
      needs.inset_aspect * kInsetShare * options.width_px + (kInsetBorder + kInsetWords + 6.0) * u};
  const auto is_covered = [&](const RenderView& view) {
    return std::any_of(points_world_m.begin(), points_world_m.end(), [&](const Vec3& p_world_m) {
      const std::optional<Vec3> p = project(view, p_world_m);
      return p && p->x() > view.width_px - inset_px[0] && p->y() < inset_px[1];
    });
  };
  std::optional<RenderView> best;
  constexpr int kSteps = 4;
  for (int right = 0; right <= (has_inset ? kSteps : 0); ++right) {
    for (int top = 0; top <= (has_inset ? kSteps : 0); ++top) {
      FrameMargins margins;
      if (has_words(options)) margins.bottom = 36.0 * u / panel.height_px;  // the scale's
      margins.right += inset_px[0] / panel.width_px * right / kSteps;
      margins.top += inset_px[1] / panel.height_px * top / kSteps;
      if (margins.left + margins.right >= 1.0 || margins.top + margins.bottom >= 1.0) continue;
      const RenderView view = frame_points(points_world_m, options.angles.value_or(needs.angles),
                                           panel.width_px, panel.height_px, margins);
      if (best && px_per_m_at_focus(view) <= px_per_m_at_focus(*best)) continue;
      if (!has_inset || !is_covered(view)) best = view;
    }
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

PanelLayout lay_out(std::span<const Vec3> points_world_m, const LayoutNeeds& needs,
                    const PictureOptions& options) {
  std::optional<PanelLayout> best;
  for (int columns = 1; columns <= needs.panels; ++columns) {
    std::optional<PanelLayout> layout = in_columns(needs, options, columns);
    if (!layout) continue;
    const std::optional<RenderView> view = framed(points_world_m, needs, options, layout->view);
    if (!view) continue;
    layout->view = *view;
    const bool is_larger = !best || px_per_m_at_focus(layout->view) > px_per_m_at_focus(best->view);
    if (is_larger) best = layout;
  }
  if (!best && needs.inset_aspect > 0.0) {  // where it leaves no room, it may hide something
    LayoutNeeds bare = needs;
    bare.inset_aspect = 0.0;
    return lay_out(points_world_m, bare, options);
  }
  GNBV_CHECK(best.has_value(), "{} x {} px: no room for a panel", options.width_px,
             options.height_px);
  if (options.camera) {
    RenderView view = *options.camera;
    view.width_px = best->view.width_px;
    view.height_px = best->view.height_px;
    best->view = view;
  }
  return *best;
}

PanelLayout lay_out(const PictureKind& kind, std::span<RunSource* const> runs,
                    const PictureOptions& asked) {
  PictureOptions options = asked;
  if (kind.best_angles != nullptr && !options.angles && !options.camera) {
    options.angles = kind.best_angles(runs, asked);
  }
  LayoutNeeds needs{.panels = kind.panels, .legend_rows = kind.legend_rows, .angles = kind.angles};
  std::vector<Vec3> points;
  for (RunSource* const run : runs) {
    kind.frame(*run, options, points);
    const std::vector<CameraConfig>& cameras = run->record().scenario.cameras;
    if (!kind.has_inset || !has_words(options) || cameras.empty()) continue;
    const CameraConfig& camera = cameras.front();
    needs.inset_aspect =
        std::max(needs.inset_aspect, 1.0 * camera.height_px / std::max(1, camera.width_px));
  }
  return lay_out(points, needs, options);
}

}  // namespace gnbv
