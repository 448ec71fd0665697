// Laws of the figures of a flight: they show its path.
#include "tests/tools/figures/figure_support.hpp"
#include "tools/figures/run_figures.hpp"

namespace gnbv {
namespace {

using Values = std::vector<double>;

/// Flown along x at 8 m a second, then turned back: speeds are those of the path.
TEST(FlightFigures, AFlightIsThatOfThePath) {
  const auto figure = flight_figure(made_record());
  ASSERT_TRUE(figure.has_value());
  EXPECT_EQ(series_of(*figure, "x").x, (Values{3, 4}));  // from the first view to the last sample
  EXPECT_EQ(series_of(*figure, "y").y, (Values{4, -4}));
  EXPECT_NEAR(series_of(*figure, "speed").y[1], std::sqrt(65.0), 1e-9);
  EXPECT_EQ(series_of(*figure, "yaw").y[1], 0.0);
  const std::vector<std::string> expected = {"position (m)", "yaw (deg), each sample",
                                             "roll (deg)",   "pitch (deg)",
                                             "speed (m/s)",  "distance from planned leg (m)"};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(figure->panels.at(i).heading, expected[i]);
  }
  RunRecord still = made_record();
  still.views.resize(1);
  EXPECT_FALSE(flight_figure(still).has_value());
}

TEST(Traces, AreTheirSamplesWhereTheseAreFew) {
  const Series few = trace("", {0.0, 1.0}, {5.0, 7.0}, 0);
  EXPECT_EQ(few.y, (Values{5, 7}));
  EXPECT_TRUE(few.low.empty());
}

/// A sawtooth of period 10 in steps of some 100 samples: of all, and of nine in ten.
TEST(Traces, ManySamplesBecomeBandsThatHoldThem) {
  Values times_s, sawtooth, hundred;
  for (int i = 0; i < 24000; ++i) {
    times_s.push_back(0.1 * i);
    sawtooth.push_back((i + 5) % 10);
    hundred.push_back((37 * i) % 100);
  }
  const Series all = trace("", times_s, sawtooth, 0);
  const Series most = trace("", times_s, hundred, 0, 0.05, 0.95);
  ASSERT_EQ(all.y.size(), 240U);
  for (std::size_t i = 0; i < 240; ++i) {
    EXPECT_NEAR(all.x[i], 10.0 * static_cast<double>(i) + 5.0, 0.2);
    EXPECT_EQ(all.low[i], 0.0);
    EXPECT_EQ(all.high[i], 9.0);
    EXPECT_NEAR(all.y[i], 4.5, 0.05);
    EXPECT_NEAR(most.low[i], 5.0, 1.0);
    EXPECT_NEAR(most.high[i], 94.0, 1.0);
  }
}

/// A vehicle that looks at 180 degrees trembles on both sides of them: one line, beyond 180. It
/// breaks where yaw goes on past 190.
TEST(FlightFigures, YawBreaksOnceWhereItGoesAround) {
  const Series yaw = yaw_series(Values{0, 1, 2, 3, 4, 5, 6, 7},
                                Values{170, 179, -179, 179.5, -172, -150, -178, 178});
  EXPECT_EQ(yaw.x, (Values{0, 1, 2, 3, 4, 5, 5, 6, 7}));
  ASSERT_TRUE(std::isnan(yaw.y[5]));
  Values known = yaw.y;
  known.erase(known.begin() + 5);
  EXPECT_EQ(known, (Values{170, 179, 181, 179.5, 188, -150, -178, -182}));
}

TEST(FlightFigures, TrackingIsTheDistanceFromEachLegAndTheTilt) {
  RunRecord record = made_record();  // views at 3 s (4, 4, 1), 4 s (-4, 4, 2) and 5 s (-4, -4, 3)
  record.views[1].decision.via_world_m = {Vec3(0, 4, 1)};
  TrajectorySample leaning = made_sample(3.5, {2, 4.3, 1.4});  // 0.5 m beside the first leg
  leaning.T_world_body.rotate(Eigen::AngleAxisd(deg_to_rad(12.0), Vec3(0.6, 0.8, 0.0)));
  record.path = {made_sample(2.9, {9, 9, 9}), leaning, made_sample(4.5, {-4, 0, 2.5}),
                 made_sample(5.1, {9, 9, 9})};
  const auto figure = tracking_figure(record);
  ASSERT_TRUE(figure.has_value());
  const Series error = series_of(*figure, "tracking error");
  EXPECT_EQ(error.x, (Values{3.5, 4.5}));  // only between the first view and the last
  EXPECT_NEAR(error.y[0], 0.5, 1e-6);
  EXPECT_EQ(error.y[1], 1e-5);  // none lies on the axis's end
  EXPECT_NEAR(series_of(*figure, "tilt").y[0], 12.0, 1e-6);
  EXPECT_NEAR(series_of(*figure, "safety margin").y[0], 0.416, 5e-4);  // 0.8 m less the hull's
  EXPECT_TRUE(figure->panels[0].y.is_log);
  EXPECT_EQ(figure->title.find("gusts"), std::string::npos);
  record.scenario.wind.gust_w20_m_s = 7.7;
  EXPECT_NE(tracking_figure(record)->title.find("gusts of 7.7 m/s at 20 ft"), std::string::npos);
}

/// Nobody planned its straight lines, and the way that was planned stands in no file.
TEST(FlightFigures, ASmoothWayIsMeasuredFromNoLeg) {
  RunRecord record = made_record();
  record.scenario.guidance.trajectory = Trajectory::smooth;
  EXPECT_EQ(flight_figure(record)->panels.back().heading, "speed (m/s)");
  const Figure tracking = tracking_figure(record).value();
  ASSERT_EQ(tracking.panels.size(), 1U);
  EXPECT_EQ(tracking.panels[0].series.at(0).name, "tilt");
  EXPECT_NE(tracking.notes.at(0).find("path_error_m"), std::string::npos);
}

}  // namespace
}  // namespace gnbv
