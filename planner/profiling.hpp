// The initial rough scan: where to fly it (paper section 2.2, Fig. 4).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/motion/config.hpp"

namespace gnbv {

struct LidarModel;
struct LidarScan;

/// bounding_box: the paper's eight descents. circular: the released "circular adaptive": climbs on
/// a circle while surface is seen. saved: reads the map of an earlier profile. none: no profile.
enum class ProfilingMethod { bounding_box, circular, saved, none };

struct ProfilingConfig {
  ProfilingMethod method = ProfilingMethod::bounding_box;
  bool scan_in_transit = true;  // LIDAR on between the descents too
  double flight_rate_hz = 0.0;  // sweeps a second between the views, of each LIDAR; 0: none
  std::string file;             // saved: profile.map of an earlier run
  int circle_stations = 5;      // circular: evenly spread
  double climb_step_m = 1.0;    // circular: how far it climbs before it asks again
};

/// One straight leg of the profile.
struct ProfileLeg {
  ViewPose goal;
  bool is_scan = false;  // flown at profiling speed with the LIDAR on; otherwise a transit
};

/// Eight descents on the faces of the navigation box: four corners and four side middles, from top
/// to bottom, facing the centre, in order around the box from the one nearest to `start`, in the
/// direction of the nearer neighbour. A descent that `no_fly` cuts keeps its longest piece.
std::vector<ProfileLeg> bounding_box_profile(const Box3& navigation_m, const ViewPose& start,
                                             const NoFly& no_fly = {});

/// Hands out the legs of a profile, one after the other. Where `no_fly` forbids a leg, transits
/// lead around it (way_around()); a leg whose end is forbidden, or that no way leads to, is left
/// out.
class ProfileRoute {
 public:
  ProfileRoute(const ProfilingConfig& config, const Box3& navigation_m, const ViewPose& start,
               NoFly no_fly = {});

  /// The next leg; nothing when the profile is over. `saw_surface`: whether the LIDARs had returns
  /// above the floor since the leg before was handed out.
  std::optional<ProfileLeg> next(bool saw_surface);
  /// Share of the profile that is done, 0 to 1; of an adaptive one, of its stations.
  double share_done() const;

 private:
  bool plan_on_circle(bool saw_surface);

  ProfilingConfig config_;
  Box3 navigation_m_;
  NoFly no_fly_;
  Vec3 at_m_;                       // where the legs so far end
  std::vector<ProfileLeg> legs_;    // as the method plans them
  std::size_t next_leg_ = 0;        // of them
  std::vector<ProfileLeg> detour_;  // legs to hand out before those, the last one first
  // circular
  double bearing_rad_;  // of the first station, from the box's centre
  int station_ = -1;    // where it climbs
  double z_m_;          // how far it has climbed
};

/// Whether any of the sweeps had a return above the floor.
bool sees_surface(std::span<const LidarScan> scans, std::span<const LidarModel> lidars,
                  double floor_z_m);

}  // namespace gnbv
