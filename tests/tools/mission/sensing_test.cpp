// When the sensors measure, from where, and what pose the measurement carries.
#include "tools/mission/sensing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sensors/shapes.hpp"

namespace gnbv {
namespace {

/// A vehicle that slides along x at constant speed and believes to be a metre further in y.
class Sliding final : public Flight {
 public:
  explicit Sliding(double speed_m_s) : speed_m_s_(speed_m_s) {}
  std::unique_ptr<Flight> clone() const override { return std::make_unique<Sliding>(*this); }
  std::int64_t tick() const override { return tick_; }
  VehicleState state() const override {
    VehicleState state;
    state.T_world_body.translate(Vec3(speed_m_s_ * static_cast<double>(tick_) * kTick_s, 0.0, 0.0));
    state.v_world_m_s = Vec3(speed_m_s_, 0.0, 0.0);
    return state;
  }
  VehicleState estimate() const override {
    VehicleState estimate = state();
    estimate.T_world_body.translation().y() += 1.0;
    return estimate;
  }
  void command(const Setpoint&) override {}
  void step() override { ++tick_; }
  bool has_collided() const override { return false; }
  double energy_wh() const override { return 0.0; }
  void leave_ground() override {}
  void land() override {}
  bool has_landed() const override { return false; }

 private:
  double speed_m_s_;
  std::int64_t tick_ = 0;
};

World sphere_world() { return test::world_of(test::sphere(Vec3::Zero(), 5.0), false); }

LidarModel lidar_at(double rate_hz, bool rolling) {
  LidarConfig lidar;
  lidar.beams = 91;
  lidar.rate_hz = rate_hz;
  lidar.pitch_rad = 0.0;
  lidar.rolling = rolling;
  return make_lidar_model(lidar);
}

std::vector<LidarScan> scan_for(double seconds, double speed_m_s,
                                const std::vector<LidarModel>& lidars) {
  const World world = sphere_world();
  const RayScene scene(world);
  ProfileScanner scanner(scene, lidars, 1);
  Sliding flight(speed_m_s);
  while (static_cast<double>(flight.tick()) * kTick_s < seconds) {
    flight.step();
    scanner.tick(flight, true);
  }
  return scanner.scans();
}

TEST(DueTicks, ComeAsOftenAsTheRateSays) {
  for (const double rate_hz : {0.0, 0.5, 7.0, 40.0, 250.0}) {
    int count = 0;
    for (std::int64_t tick = 1; tick <= 20 * kTicksPerSecond; ++tick)
      count += is_due(rate_hz, tick);
    EXPECT_EQ(count, static_cast<int>(20.0 * rate_hz));
  }
}

TEST(ProfileScan, GivesEachLidarItsOwnRate) {
  const auto scans = scan_for(2.0, 0.0, {lidar_at(40.0, false), lidar_at(5.0, false)});
  int count[2] = {0, 0};
  for (const LidarScan& scan : scans) ++count[scan.lidar];
  EXPECT_EQ(count[0], 80);
  EXPECT_EQ(count[1], 10);
}

TEST(ProfileScan, LosesNoSweepThatBeginsBeforeTheLastOneEnds) {
  for (const double rate_hz : {10.0, 40.0, 50.0}) {
    LidarConfig config = lidar_at(rate_hz, true).config;
    config.fov_rad = 2.0 * kPi;  // a sweep lasts for the whole period
    const auto scans = scan_for(2.0, 1.0, {make_lidar_model(config)});
    // at the end, one or two are still under way
    EXPECT_GE(scans.size(), static_cast<std::size_t>(2.0 * rate_hz) - 2) << rate_hz;
  }
}

TEST(ProfileScan, CarriesTheBelievedPoseOfItsFirstBeam) {
  for (const bool rolling : {false, true}) {
    const auto scans = scan_for(0.1, 1.0, {lidar_at(40.0, rolling)});
    ASSERT_FALSE(scans.empty());
    const Vec3 p = scans[0].T_world_lidar.translation();
    EXPECT_NEAR(p.x(), 7 * kTick_s, 1e-12);  // 40 Hz falls due at tick 7: 28 ms
    EXPECT_EQ(p.y(), 1.0);
  }
}

TEST(ProfileScan, SkewsByTheWayFlownDuringTheSweep) {
  // from inside a sphere the beam straight ahead, in the middle of the fan, comes half a sweep
  // after the first one, 6.25 ms, along the very line it would have taken at once
  for (const double speed_m_s : {0.0, 2.0}) {
    const auto frozen = scan_for(0.1, speed_m_s, {lidar_at(40.0, false)});
    const auto rolling = scan_for(0.1, speed_m_s, {lidar_at(40.0, true)});
    EXPECT_EQ(rolling[0].range_m == frozen[0].range_m, speed_m_s == 0.0);
    EXPECT_NEAR(frozen[0].range_m[45] - rolling[0].range_m[45], speed_m_s * 0.0125 / 2.0,
                1e-5);  // float32 ranges
  }
}

TEST(ProfileScan, BeginsNoSweepWhileItIsOff) {
  const World world = sphere_world();
  const RayScene scene(world);
  const std::vector<LidarModel> lidars = {lidar_at(40.0, true)};
  ProfileScanner scanner(scene, lidars, 1);
  Sliding flight(1.0);
  for (int i = 0; i < 250; ++i) {
    flight.step();
    scanner.tick(flight, i < 7);  // the first sweep has begun, and is finished
  }
  EXPECT_EQ(scanner.scans().size(), 1U);
}

TEST(DepthFrames, AreSeenFromTheTruePoseAndCarryTheBelievedOne) {
  const World world = sphere_world();
  const RayScene scene(world);
  const CameraModel camera = make_camera_model({.width_px = 31, .height_px = 21});
  const Sliding flight(0.0);
  const DepthFrame frame = sense_depth(scene, camera, 0, flight, 1, 1);
  EXPECT_EQ(frame.T_world_camera.translation(), Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(frame.depth_m[10 * 31 + 15], 5.0, 0.02);  // the sphere's centre is the true place
}

TEST(DroppedFrames, AreAsManyAsTheyShouldBeAndCameraByCameraTheirOwn) {
  CameraConfig camera;
  camera.drop_probability = 0.3;
  constexpr int kFrames = 20000;
  int dropped = 0, both = 0;
  for (int tick = 0; tick < kFrames; ++tick) {
    const bool first = is_dropped(camera, 0, tick, 1);
    dropped += first;
    both += first && is_dropped(camera, 1, tick, 1);
    EXPECT_EQ(first, is_dropped(camera, 0, tick, 1));
  }
  const auto tolerance = [](double p) { return 4.0 * std::sqrt(p * (1.0 - p) / kFrames); };
  EXPECT_NEAR(dropped / double{kFrames}, 0.3, tolerance(0.3));  // binomial
  EXPECT_NEAR(both / double{kFrames}, 0.09, tolerance(0.09));
  for (const double probability : {0.0, 1.0}) {
    camera.drop_probability = probability;
    for (int tick = 0; tick < 1000; ++tick) {
      EXPECT_EQ(is_dropped(camera, 0, tick, 1), probability == 1.0);
    }
  }
}

}  // namespace
}  // namespace gnbv
