// Laws of the plots of a flight: they show its path.
#include "tools/plots/flight_plot.hpp"

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/traces.hpp"
#include "tools/plots/tracking_plot.hpp"

namespace gnbv {
namespace {

/// Flown along x at 8 m a second, then turned back: speeds are those of the path.
TEST(Plots, FlightIsThatOfThePath) {
  const auto plot = flight_plot(made_record());
  ASSERT_TRUE(plot.has_value());
  const auto rows = block(plot->body, "samples");
  ASSERT_EQ(rows.size(), 2U);  // from the first view, at 3 s, to the last sample
  EXPECT_EQ(rows[1][0], 4.0);
  EXPECT_EQ(rows[1][2], -4.0);
  EXPECT_NEAR(rows[1][7], std::sqrt(65.0), 1e-9);
  EXPECT_EQ(rows[1][6], 0.0);
  // from above to below
  std::size_t at = 0;
  for (const char* const heading :
       {"position", "yaw", "roll", "pitch", "speed", "distance from planned leg"}) {
    const std::size_t next = plot->body.find(std::string("'") + heading);
    ASSERT_NE(next, std::string::npos) << heading;
    EXPECT_GT(next, at) << heading;
    at = next;
  }
  expect_drawable(*plot);
}

TEST(Traces, AreTheirSamplesWhereTheseAreFew) {
  const Traces traces({{0.0, 5.0}, {1.0, 7.0}});
  EXPECT_EQ(block(traces.data(), "samples"), (std::vector<std::vector<double>>{{0, 5}, {1, 7}}));
  EXPECT_EQ(traces.data().find("$bands"), std::string::npos);
  EXPECT_TRUE(traces.key().empty());
  EXPECT_EQ(traces.range(1, 1), std::pair(5.0, 7.0));
}

/// A sawtooth of period 10 on a slope: each band holds all of it, and its mean is the slope's.
TEST(Traces, ManySamplesBecomeBandsThatHoldThem) {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 24000; ++i) {
    rows.push_back({0.1 * i, 0.001 * i, static_cast<double>((i + 5) % 10)});
  }
  const Traces traces(rows);
  const auto bands = block(traces.data(), "bands");
  ASSERT_EQ(bands.size(), 240U);
  for (const auto& band : bands) {
    ASSERT_EQ(band.size(), 9U);
    EXPECT_EQ(band[5], 0.0);
    EXPECT_EQ(band[7], 9.0);
    EXPECT_EQ(band[8], 9.0);
    EXPECT_NEAR(band[6], 4.5, 0.05);  // of some 100 samples
    EXPECT_NEAR(band[2], 0.01 * band[0], 0.002);
    for (const auto& row : rows) {
      if (std::abs(row[0] - band[0]) > 4.9) continue;  // an edge's samples may be the next one's
      EXPECT_GE(row[1], band[1]);
      EXPECT_LE(row[1], band[3]);
    }
  }
  EXPECT_EQ(traces.key().front().text, "mean of each 10 s");
  EXPECT_EQ(traces.key().back().text, "least to most");
  const std::string plot = "plot " + traces.drawn(1, 2) + "\n";
  expect_drawable({.name = "bands", .body = traces.data() + plot});
}

/// Of 100 samples from 0 to 99 in each step: the 5th to the 95th, and the most beside them.
TEST(Traces, BandsOfAShareLeaveOutTheExtremes) {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 24000; ++i) rows.push_back({0.1 * i, static_cast<double>((37 * i) % 100)});
  const Traces traces(rows, 0.9);
  for (const auto& band : block(traces.data(), "bands")) {
    EXPECT_NEAR(band[1], 5.0, 1.0);
    EXPECT_NEAR(band[3], 94.0, 1.0);
    EXPECT_NEAR(band[4], 99.0, 1.0);
  }
  EXPECT_LT(traces.range(1, 1).second, 96.0);
  EXPECT_EQ(traces.key().back().text, "5 to 95 %");
}

/// A vehicle that looks at 180 degrees trembles on both sides of them: one line, beyond 180. It
/// breaks where yaw goes on past 190.
TEST(FlightPlot, YawBreaksOnceWhereItGoesAround) {
  const std::vector<std::array<double, 2>> yaw = {{0, 170},  {1, 179},  {2, -179}, {3, 179.5},
                                                  {4, -172}, {5, -150}, {6, -178}, {7, 178}};
  EXPECT_EQ(yaw_block(yaw),
            "$yaw << EOD\n0 170\n1 179\n2 181\n3 179.5\n4 188\n\n5 -150\n6 -178\n7 -182\nEOD\n");
}

TEST(TrackingPlot, ShowsTheDistanceFromEachLegAndTheTilt) {
  RunRecord record = made_record();  // views at 3 s (4, 4, 1), 4 s (-4, 4, 2) and 5 s (-4, -4, 3)
  record.views[1].decision.via_world_m = {Vec3(0, 4, 1)};
  TrajectorySample leaning = made_sample(3.5, {2, 4.3, 1.4});  // 0.5 m beside the first leg
  leaning.T_world_body.rotate(Eigen::AngleAxisd(deg_to_rad(12.0), Vec3(0.6, 0.8, 0.0)));
  record.path = {made_sample(2.9, {9, 9, 9}), leaning, made_sample(4.5, {-4, 0, 2.5}),
                 made_sample(5.1, {9, 9, 9})};
  const auto plot = tracking_plot(record);
  ASSERT_TRUE(plot.has_value());
  const auto rows = block(plot->body, "samples");
  ASSERT_EQ(rows.size(), 2U);  // only between the first view and the last
  const std::vector<std::vector<double>> expected = {{3.5, 0.5, 12.0},
                                                     {4.5, 1e-5, 0.0}};  // on the axis's end
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rows[i][k], expected[i][k], 1e-6) << i << k;
  }
  // 0.8 m less the hull's 0.384 m
  EXPECT_NE(plot->body.find("plot 0.416 with lines"), std::string::npos);
  EXPECT_NE(plot->body.find("'safety margin, 0.42 m'"), std::string::npos);
  EXPECT_NE(plot->body.find("'tracking error (distance from the planned leg, m)'"),
            std::string::npos);
  EXPECT_NE(plot->body.find("set yrange [1e-5:1e0]\nset ytics ('0.00001' 1e-5,"),
            std::string::npos);
  EXPECT_NE(plot->body.find("'mission time (s)'"), std::string::npos);
  EXPECT_EQ(plot->body.find("gusts"), std::string::npos);
  record.scenario.wind.gust_w20_m_s = 7.7;
  EXPECT_NE(tracking_plot(record)->body.find("gusts of 7.7 m/s at 20 ft"), std::string::npos);
  expect_drawable(*plot);
  record.views.resize(1);
  EXPECT_FALSE(tracking_plot(record).has_value());
}

}  // namespace
}  // namespace gnbv
