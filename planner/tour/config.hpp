// Settings of the tour planner. Each part is a switch, so that an ablation is a comparison.
#pragma once

#include "sim/core/pose.hpp"

namespace gnbv {

/// How it is judged what a view would see: patches drawn as discs into a depth buffer, or a ray
/// through the voxels of the map to each patch.
enum class TourVisibility { splats, rays };

/// How the tour is made: by large-neighbourhood search, or view by view.
enum class TourSearch { neighbourhood, greedy };

/// Whether the share of a patch that a look brings is learned in flight.
enum class TourSuccess { learned, fixed };

struct TourConfig {
  double detail_m = 0.05;       // edge of the voxels that are to hold a point
  double lattice_step_m = 0.0;  // between views of the lattice; 0: a quarter of the
  // cameras' range, at most an eighth of the navigation box's shorter side
  double yaw_step_rad = deg_to_rad(45.0);
  double incidence_max_rad = deg_to_rad(80.0);  // beyond, a look counts for nothing
  TourVisibility visibility = TourVisibility::splats;
  TourSearch search = TourSearch::neighbourhood;
  TourSuccess success = TourSuccess::learned;
  bool double_cover = true;      // a second look is worth what the first may miss; else nothing
  bool explore = true;           // without a profile: where no surface pays, looks for space unseen
  double price = 0.09;           // what a metre has to bring, of ExpectedSurface::voxels_a_metre()
  double metres_per_view = 0.3;  // what a view costs beside its way
  int iterations = 250;          // of the search, a replan
  int views_per_replan = 6;
  double replan_below =
      0.5;                // replans early when a view brings less than this share of its promise
  int recasts = 80;       // places looked from again, a replan
  int items_max = 12000;  // patches that the search weighs one by one; of more it takes a sample
  // when no view pays, the price is halved, but not below this share of it, and not when no more
  // than so much of the expected voxels is left
  double end_price = 0.03;
  double end_share = 0.003;
  bool surface_views = true;  // views off the lattice for what is left after two looks
};

}  // namespace gnbv
