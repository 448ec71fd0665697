// What the picture of a decision says of its candidates in words.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "planner/core/plan.hpp"
#include "tools/render/picture.hpp"

namespace gnbv {

/// The candidates of a decision, counted.
struct CandidateTally {
  std::vector<std::size_t> rejected;         // by reason
  std::vector<std::size_t> rejected_unseen;  // of them, in no panel: beyond all, or hidden
  std::size_t valid = 0;
  std::size_t unseen = 0;                                // of all
  double low = std::numeric_limits<double>::infinity();  // utility, of those valid
  double high = -std::numeric_limits<double>::infinity();
};

/// A pin of that length: from where the view stands towards where it looks.
Vec3 pin_end(const ViewPose& view, double length_m);

/// Of the pins of rejected candidates, whose balls are at their ends, and of balls (layout units).
constexpr double kRejectedPin = 12.0;
constexpr double kRejectedBall = 4.8;
constexpr double kValidBall = 6.6;

/// A panel's camera, and how many metres a layout unit has there.
struct PanelView {
  RenderView view;
  double unit_m = 0.0;
};

/// Whether one of the panels shows the near side of its pin's ball.
bool is_shown(const Candidate& candidate, const OccupancyGrid& grid,
              std::span<const PanelView> panels);

/// As those panels show them.
CandidateTally tally(const Plan& plan, const OccupancyGrid& grid,
                     std::span<const PanelView> panels);

/// A share of the way from the lowest score to the highest: where these are one, it is the highest.
Rgb colour_of_score(const CandidateTally& all, double score);

/// Whether one was sampled around clusters, and whether such a one was chosen.
bool has_frontier_views(const Plan& plan);
bool is_chosen_at_frontier(const Plan& plan);

/// "104 candidates as pins, 64 hidden or outside the picture"
std::string note_on(const Plan& plan, const CandidateTally& all);

/// What hides things, and from where each panel is seen.
struct Sight {
  const OccupancyGrid& grid;
  std::span<const PanelView> panels;
};

/// A row of those rejected ("collision: 74 of 132" that it shows), one of what could be chosen and
/// what of the map is to be seen, one of the chosen view. Of lines, balls and clusters nothing that
/// no panel shows.
std::vector<LegendItem> legend_of(const Plan& plan, const CandidateTally& all,
                                  std::span<const Panel> panels, const Sight& sight,
                                  bool is_unknown_seen);

extern const Rgb kOccupiedVoxels, kUnknownVoxels;

}  // namespace gnbv
