// All that the tour planner knows and means to do, as one value.
#pragma once

#include <span>
#include <vector>

#include "planner/tour/gain_calibration.hpp"
#include "planner/tour/surface_nodes.hpp"
#include "planner/tour/visibility_cache.hpp"

namespace gnbv {

struct PlannerModel;

/// A view that a tour may hold.
struct TourView {
  Roadmap::Node node = kNoNode;
  ViewPose pose;
};

struct TourState {
  TourState(const TourConfig& config, const PlannerModel& model);

  // the surface, and what it lacks
  SurfaceCells cells;
  std::vector<Patch> patches;
  std::size_t points_taken = 0;  // of the cloud
  GainCalibration calibration;

  // where views may be taken from, and what they would see
  OpenSpace space;
  Roadmap roadmap;
  VisibilityCache visibility;
  std::vector<CameraModel> cameras;  // at each pitch of their gimbal
  SearchedCubes searched;            // for nodes off the lattice

  // the tour
  std::vector<TourView> tour;          // what is left of it, in order
  std::vector<ViewPose> refused;       // taken lately, or found to be out of reach now
  Roadmap::Node at = Roadmap::here();  // where the last view was taken
  int views_since_replan = 0;
  bool is_due = true;        // the tour has to be made anew
  double cost_factor = 1.0;  // of what a metre costs: halved while what is left does not pay
  std::uint64_t searches = 0;
};

/// Between nodes of the lattice: a quarter of the cameras' range, but at least eight across the
/// navigation box, and no more nodes than can be planned over at that.
double automatic_step_m(std::span<const CameraModel> cameras, const Box3& navigation_m);

/// The most nodes that a lattice may have whose step is given, and that one has whose step is not.
constexpr double kMostLatticeNodes = 5e5;
constexpr double kMostAutomaticNodes = 2e4;

/// Bytes that the arrays of the tour take for each voxel of the map (OpenSpace) and each cell of
/// the surface's lattice (SurfaceCells), once every page of them is written. Not in it: what grows
/// with the surface.
double tour_bytes(const TourConfig& config, const Box3& workspace_m, double resolution_m);

}  // namespace gnbv
