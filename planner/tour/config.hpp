// Settings of the tour planner.
#pragma once

#include "sim/core/pose.hpp"

namespace gnbv {

/// What a tour is to be short in.
enum class TourCost { metres, seconds };

struct TourConfig {
  TourCost cost = TourCost::metres;
  double detail_m = 0.05;       // edge of the voxels that are to hold a point
  double lattice_step_m = 0.0;  // between views of the lattice; 0: automatic_step_m()
  double yaw_step_rad = deg_to_rad(45.0);
  double incidence_max_rad = deg_to_rad(80.0);  // beyond, an observation counts for nothing
  bool double_cover = true;  // a second observation is worth what the first may miss; else nothing
  bool explore = true;       // without a profile: where no surface pays, looks for space unseen
  double price = 0.09;       // what a metre has to bring, of ExpectedSurface::voxels_a_metre()
  double metres_per_view = 0.3;  // what a view costs beside its way
  double seconds_per_view = 1.0;
  int iterations = 250;  // of the search, a replan
  int views_per_replan = 6;
  double replan_below = 0.5;  // replans early when a view brings less than this share of its gain
  double end_price = 0.03;    // when no view pays, the price is halved, down to this share of it
  bool surface_views = true;  // views off the lattice for what no view of the lattice sees
};

}  // namespace gnbv
