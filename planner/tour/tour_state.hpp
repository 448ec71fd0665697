// All that the tour planner knows and means to do, as one value; and the orienteering problem that
// follows from it, whose solution is the tour.
#pragma once

#include <span>
#include <vector>

#include "planner/tour/orienteering.hpp"
#include "planner/tour/visibility_cache.hpp"

namespace gnbv {

struct PlannerModel;

/// A view that a tour may hold.
struct TourView {
  Roadmap::Node node = kNoNode;
  ViewPose pose;

  bool operator==(const TourView& other) const {
    return node == other.node && is_same_view(pose, other.pose);
  }
};

struct TourState {
  TourState(const TourConfig& config, const PlannerModel& model);

  // the surface, and what it lacks
  SurfaceCells cells;
  std::vector<Patch> patches;
  std::size_t points_taken = 0;  // of the cloud
  std::size_t ranged_taken = 0;  // of what LIDARs saw
  std::size_t frames_taken = 0;  // of the frames
  GainCalibration calibration;

  // where views may be taken from, and what they would see
  OpenSpace space;
  Roadmap roadmap;
  VisibilityCache visibility;
  SearchedCubes searched;  // for nodes off the lattice

  // the tour
  std::vector<TourView> tour;          // what is left of it, in order
  std::vector<ViewPose> refused;       // taken lately, or found to be out of reach now
  Roadmap::Node at = Roadmap::here();  // where the last view was taken
  int views_since_replan = 0;
  bool is_due = true;        // the tour has to be made anew
  double cost_factor = 1.0;  // of what a metre costs: halved while what is left does not pay
  std::uint64_t searches = 0;
  double voxels_at_look = 0.0;  // expected when it was last looked into the hull of the surface
  int looks_in_vain = 0;        // since such a look brought surface

  bool is_refused(const ViewPose& pose) const;
  /// Of each patch, whether a view from any reachable node sees it.
  std::vector<std::uint8_t> seen_from_anywhere() const;
  /// Small voxels that one observation of each patch that any view sees can be expected to bring.
  double voxels_in_reach() const;
};

/// All surface that is believed to be there, seen or not.
struct ExpectedSurface {
  double voxels = 0.0;  // small ones, those that hold a point included
  Box3 box_m;           // around their cells; empty without any
  /// Of a tour twice as long as the box's sides together, which is what tours come to: 144 m for
  /// the paper's aircraft, flown in 140 to 160 m. The same for a model of it on any scale.
  double voxels_a_metre() const;
};
ExpectedSurface expected_surface(const SurfaceCells& cells);

struct TourProblem {
  OrienteeringProblem problem;
  std::vector<TourView> views;  // of the problem, in its order
};

/// All views of reachable nodes that may pay when a unit of way has to bring `price` small voxels.
/// Of more than 12,000 patches one in so many stands for its share. Its `row_m` is left to the
/// caller.
TourProblem make_tour_problem(const TourConfig& config, const TourState& state, double price,
                              const HeedStop& stop);

/// Between nodes of the lattice: a quarter of the cameras' range, but at least eight across the
/// navigation box, and no more nodes than can be planned over at that.
double automatic_step_m(std::span<const CameraModel> cameras, const Box3& navigation_m);
constexpr double kMostAutomaticNodes = 2e4;

/// Bytes that the arrays of the tour take for each voxel of the map (OpenSpace) and each cell of
/// the surface's lattice (SurfaceCells), once every page of them is written. Not in it: what grows
/// with the surface.
double tour_bytes(const TourConfig& config, const Box3& workspace_m, double resolution_m);

}  // namespace gnbv
