// The error of each source against its own law, over many missions at once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/flight/disturbances.hpp"

namespace gnbv {
namespace {

constexpr int kMissions = 600;

VehicleState moving(double x_m, double speed_m_s) {
  VehicleState state;
  state.T_world_body = T_world_body({Vec3(x_m, 2.0, 3.0), 0.7});
  state.v_world_m_s = Vec3(speed_m_s, 0.0, 0.0);
  return state;
}

Vec3 position_error_m(const VehicleState& estimate, const VehicleState& truth) {
  return estimate.T_world_body.translation() - truth.T_world_body.translation();
}

/// Sigma of `samples` lies within 4 standard errors of the wanted one, 4 / sqrt(2 n) of it.
void expect_sigma(double sum_of_squares, int samples, double sigma) {
  EXPECT_NEAR(std::sqrt(sum_of_squares / samples) / sigma, 1.0, 4.0 / std::sqrt(2.0 * samples));
}

TEST(StateEstimate, NoneIsTheTruth) {
  const VehicleState truth = moving(1.0, 2.0);
  StateEstimator estimator({EstimateModel::none}, 1, truth);
  const VehicleState estimate = estimator.step(truth);
  EXPECT_EQ(estimate.T_world_body.matrix(), truth.T_world_body.matrix());
  EXPECT_EQ(estimate.v_world_m_s, truth.v_world_m_s);
}

TEST(StateEstimate, MocapErrsByAMillimetreAndATenthOfADegreeAfreshAtEveryTick) {
  const VehicleState truth = moving(0.0, 0.0);
  StateEstimator estimator({EstimateModel::mocap}, 1, truth);
  double position = 0.0, angle = 0.0, lagged = 0.0, before = 0.0;
  constexpr int kTicks = 20000;
  for (int i = 0; i < kTicks; ++i) {
    const VehicleState estimate = estimator.step(truth);
    const Vec3 error_m = position_error_m(estimate, truth);
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(estimate.T_world_body.linear() * truth.T_world_body.linear().transpose()));
    position += error_m.squaredNorm();
    angle += turn.angle() * turn.angle();
    lagged += before * error_m.x();
    before = error_m.x();
  }
  expect_sigma(position, 3 * kTicks, 0.001);
  expect_sigma(angle, 3 * kTicks, deg_to_rad(0.1));
  EXPECT_LT(std::abs(lagged / kTicks), 4.0 * 1e-6 / std::sqrt(kTicks));
}

TEST(StateEstimate, GnssErrsByHalfAMetreAndTwoDegreesFromTheStartOn) {
  const VehicleState truth = moving(0.0, 0.0);
  for (const int ticks : {1, 10000}) {  // a stationary law holds at any time
    double position = 0.0, heading = 0.0;
    for (int seed = 0; seed < kMissions / (ticks == 1 ? 1 : 3); ++seed) {
      StateEstimator estimator({EstimateModel::gnss}, static_cast<std::uint64_t>(seed), truth);
      VehicleState estimate;
      for (int i = 0; i < ticks; ++i) estimate = estimator.step(truth);
      position += position_error_m(estimate, truth).squaredNorm();
      const double yaw_rad = wrap_angle_rad(yaw_of(estimate.T_world_body) - 0.7);
      heading += yaw_rad * yaw_rad;
    }
    const int missions = kMissions / (ticks == 1 ? 1 : 3);
    expect_sigma(position, 3 * missions, 0.5);
    expect_sigma(heading, missions, deg_to_rad(2.0));
  }
}

/// Fixes of 2 s and floats of 1 s on average, which wander fast.
EstimateConfig fast_rtk() {
  return {.model = EstimateModel::rtk,
          .rtk = {.correlation_s = 2.0, .fixed_mean_s = 2.0, .float_mean_s = 1.0}};
}

TEST(StateEstimate, VelocityErrorBySatellitesIsThePositionErrorsDerivative) {
  const VehicleState truth = moving(0.0, 0.0);
  for (const EstimateConfig& config : {EstimateConfig{EstimateModel::gnss}, fast_rtk()}) {
    StateEstimator estimator(config, 5, truth);
    VehicleState before = estimator.step(truth);
    for (int i = 0; i < 1000; ++i) {
      const VehicleState now = estimator.step(truth);
      const Vec3 rate_m_s =
          (position_error_m(now, truth) - position_error_m(before, truth)) / kTick_s;
      ASSERT_LT((rate_m_s - now.v_world_m_s).norm(), 1e-9);  // rounding of a 4 ms difference
      before = now;
    }
  }
}

/// Critically damped of frequency w, the errors t apart correlate by (1 + w t) exp(-w t), w = 2 /
/// correlation_s.
TEST(StateEstimate, RtkErrsWhileFixedByItsSigmasWhichLastAsLongAsAsked) {
  EstimateConfig config = fast_rtk();
  config.rtk.fixed_mean_s = 1e9;
  const VehicleState truth = moving(0.0, 0.0);
  for (const double w_t : {1.0, 2.0}) {
    const auto ticks = static_cast<int>(w_t * 0.5 * config.rtk.correlation_s / kTick_s);
    double level = 0.0, up = 0.0, heading = 0.0, both = 0.0;
    for (std::uint64_t seed = 0; seed < kMissions; ++seed) {
      StateEstimator estimator(config, seed, truth);
      const Vec3 first_m = position_error_m(estimator.step(truth), truth);
      VehicleState estimate;
      for (int i = 0; i < ticks; ++i) estimate = estimator.step(truth);
      const Vec3 last_m = position_error_m(estimate, truth);
      const double yaw_rad = wrap_angle_rad(yaw_of(estimate.T_world_body) - 0.7);
      level += last_m.head<2>().squaredNorm();
      up += last_m.z() * last_m.z();
      heading += yaw_rad * yaw_rad;
      both += first_m.head<2>().dot(last_m.head<2>());
    }
    expect_sigma(level, 2 * kMissions, 0.02);
    expect_sigma(up, kMissions, 0.035);
    expect_sigma(heading, kMissions, deg_to_rad(0.4));
    const double correlation = (1.0 + w_t) * std::exp(-w_t);
    EXPECT_NEAR(both / (2 * kMissions * 0.02 * 0.02), correlation,
                4.0 * std::sqrt((1.0 + correlation * correlation) / (2 * kMissions)));
  }
}

/// Without errors while fixed what is left is the float's, whose rate goes on by itself while there
/// is a fix, r' = r - dt (2 w r + w^2 e), and is driven by noise while there is none. Its mean
/// square is linear in that noise: float_m^2 times the share of time without a fix, each axis.
TEST(StateEstimate, RtkLosesItsFixAsOftenAndAsLongAsAskedAndThenErrsByDecimetres) {
  constexpr int kRuns = 200, kFrom = 10 * kTicksPerSecond, kTicks = 40 * kTicksPerSecond;
  constexpr double kFloat_rad_s = 0.5;
  EstimateConfig config = fast_rtk();
  config.rtk.horizontal_m = config.rtk.vertical_m = 0.0;
  const VehicleState truth = moving(0.0, 0.0);
  int at_start = 0, afloat = 0, losses = 0;
  double sum_m2 = 0.0, squares_m4 = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    StateEstimator estimator(config, seed, truth);
    VehicleState before = truth;
    double run_m2 = 0.0;
    for (int i = 0, was_afloat = 0; i < kTicks; ++i) {
      const VehicleState now = estimator.step(truth);
      const Vec3 v_m_s = before.v_world_m_s - truth.v_world_m_s;
      const Vec3 alone_m_s =
          v_m_s - kTick_s * (2.0 * kFloat_rad_s * v_m_s +
                             kFloat_rad_s * kFloat_rad_s * position_error_m(before, truth));
      const int is_afloat = (now.v_world_m_s - truth.v_world_m_s - alone_m_s).norm() > 1e-12;
      if (i == 0) at_start += is_afloat;
      if (i >= kFrom) {
        afloat += is_afloat;
        losses += is_afloat > was_afloat;
        run_m2 += position_error_m(now, truth).squaredNorm() / 3.0 / (kTicks - kFrom);
      }
      was_afloat = is_afloat;
      before = now;
    }
    sum_m2 += run_m2;
    squares_m4 += run_m2 * run_m2;
  }
  EXPECT_LT(at_start, 5);               // begins with a fix, which 1 of 500 lose in the first tick
  constexpr double kShare = 1.0 / 3.0;  // 1 s of every 3 s
  constexpr double kTime_s = kRuns * (kTicks - kFrom) * kTick_s;
  // states 2/3 s apart are independent
  EXPECT_NEAR(afloat * kTick_s / kTime_s, kShare,
              4.0 * std::sqrt(2.0 * kShare * (1.0 - kShare) * (2.0 / 3.0) / kTime_s));
  EXPECT_NEAR(losses, kTime_s / 3.0, 4.0 * std::sqrt(kTime_s / 3.0));
  const double mean_m2 = sum_m2 / kRuns;
  EXPECT_NEAR(mean_m2, kShare * 0.3 * 0.3,
              4.0 * std::sqrt((squares_m4 / kRuns - mean_m2 * mean_m2) / kRuns));
}

/// Mean square error of one axis after a path of length L under a drift of sigma a metre that
/// forgets itself over l metres: 2 sigma^2 l^2 (L/l - 1 + exp(-L/l)).
double drift_sigma_m(double path_m) {
  constexpr double kForget_m = 100.0;
  const double sigma = 0.01 / std::sqrt(3.0);
  const double x = path_m / kForget_m;
  return sigma * kForget_m * std::sqrt(2.0 * (x - 1.0 + std::exp(-x)));
}

TEST(StateEstimate, VioDriftsByAPercentOfTheShortPathAndByLessOfTheLongOne) {
  for (const double path_m : {10.0, 300.0}) {
    double sum = 0.0;
    for (int seed = 0; seed < kMissions; ++seed) {
      StateEstimator estimator({EstimateModel::vio}, static_cast<std::uint64_t>(seed),
                               moving(0.0, 2.0));
      constexpr int kSteps = 500;
      VehicleState truth, estimate;
      for (int i = 0; i <= kSteps; ++i) {
        truth = moving(path_m * i / kSteps, 2.0);
        estimate = estimator.step(truth);
      }
      sum += position_error_m(estimate, truth).squaredNorm();
    }
    expect_sigma(sum, 3 * kMissions, drift_sigma_m(path_m));
  }
  EXPECT_NEAR(std::sqrt(3.0) * drift_sigma_m(10.0), 0.1, 0.002);  // one percent of ten metres
}

TEST(StateEstimate, VioStandsStillWithTheVehicleAndKeepsRollAndPitch) {
  VehicleState truth = moving(0.0, 0.0);
  truth.T_world_body.rotate(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  StateEstimator estimator({EstimateModel::vio}, 3, truth);
  EXPECT_EQ(position_error_m(estimator.step(truth), truth), Vec3(Vec3::Zero()));
  for (int i = 1; i < 200; ++i) {
    truth.T_world_body.translation().x() += 0.1;
    const VehicleState estimate = estimator.step(truth);
    const Vec3 down_body = truth.T_world_body.linear().transpose() * Vec3::UnitZ();
    const Vec3 down_seen = estimate.T_world_body.linear().transpose() * Vec3::UnitZ();
    ASSERT_LT((down_body - down_seen).norm(), 1e-12);  // rounding
  }
}

/// The gnss errors of one mission with an outage from 4 s to 12 s, each tick to 16 s.
std::vector<Vec3> errors_with_outage_m(std::uint64_t seed, std::vector<GnssOutage> outages,
                                       double drift) {
  const VehicleState truth = moving(0.0, 0.0);
  StateEstimator estimator({EstimateModel::gnss, std::move(outages), drift}, seed, truth);
  std::vector<Vec3> errors_m;
  for (int i = 0; i < 16 * kTicksPerSecond; ++i) {
    errors_m.push_back(position_error_m(estimator.step(truth), truth));
  }
  return errors_m;
}

TEST(GnssOutage, WalksAtRandomWithAVarianceThatGrowsAsTheTime) {
  constexpr double kDrift = 0.4;
  constexpr std::array<int, 3> kSeconds = {1, 2, 8};
  std::array<double, 3> sums{};
  for (std::uint64_t seed = 0; seed < kMissions; ++seed) {
    const auto errors_m = errors_with_outage_m(seed, {{4.0, 8.0}}, kDrift);
    const std::size_t begin = 4 * kTicksPerSecond - 1;  // the first estimate is that of tick 1
    for (std::size_t i = 0; i < kSeconds.size(); ++i) {
      const auto after = begin + static_cast<std::size_t>(kSeconds[i] * kTicksPerSecond);
      sums[i] += (errors_m[after] - errors_m[begin]).squaredNorm();
    }
  }
  for (std::size_t i = 0; i < kSeconds.size(); ++i) {
    expect_sigma(sums[i], 3 * kMissions, kDrift * std::sqrt(kSeconds[i]));
  }
}

TEST(GnssOutage, ChangesNothingBeforeItAndFadesAfterIt) {
  const auto calm_m = errors_with_outage_m(7, {}, 0.4);
  const auto still_m = errors_with_outage_m(7, {{4.0, 8.0}}, 0.0);
  const auto walk_m = errors_with_outage_m(7, {{4.0, 8.0}}, 0.4);
  const auto at = [](double time_s) { return static_cast<std::size_t>(time_s / kTick_s) - 1; };
  EXPECT_EQ(walk_m[at(4.0)], calm_m[at(4.0)]);
  EXPECT_NE(walk_m[at(5.0)], calm_m[at(5.0)]);
  EXPECT_LT((still_m[at(12.0)] - still_m[at(4.0)]).norm(), 1e-12);  // stands still but for the walk
  // from then on only the walk tells them apart, and it fades
  const Vec3 left_m = walk_m[at(12.0)] - still_m[at(12.0)];
  const Vec3 later_m = walk_m[at(15.0)] - still_m[at(15.0)];
  EXPECT_GT(left_m.norm(), 0.1);
  EXPECT_LT((later_m - std::exp(-3.0 / kOutageFade_s) * left_m).norm(), 1e-9);
}

TEST(StateEstimate, IsKeyedByTheSeed) {
  const VehicleState truth = moving(0.0, 1.0);
  const auto first = [&](EstimateModel model, std::uint64_t seed) {
    return StateEstimator({model}, seed, moving(-1.0, 1.0))
        .step(truth)
        .T_world_body.matrix()
        .eval();
  };
  for (const EstimateModel model :
       {EstimateModel::mocap, EstimateModel::gnss, EstimateModel::rtk, EstimateModel::vio}) {
    EXPECT_EQ(first(model, 1), first(model, 1));
    EXPECT_NE(first(model, 1), first(model, 2));
  }
}

}  // namespace
}  // namespace gnbv
