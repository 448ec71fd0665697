// Laws of the plot of what a tour expected.
#include "tools/plots/predictions_plot.hpp"

#include "sim/core/file.hpp"
#include "tests/tools/plots/plot_support.hpp"
#include "tools/run/predictions_csv.hpp"

namespace gnbv {
namespace {

/// A dot a view and source, what is 0 on the axis's end; shares over all views.
TEST(PredictionsPlot, DotsAndSharesAreTheSumsOfTheFile) {
  TempFolder temp;
  RunRecord record = scored_record();
  record.folder = temp.path();
  EXPECT_FALSE(predictions_plot(record));
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::sampled, 0, 0, 2, 100.0, 90.0, 40.0}},
      {1, {PatchSource::sampled, 0, 1, 1, 20.0, 15.0, 5.0}},
      {1, {PatchSource::boundary, 4, 0, 1, 10.0, 5.0, 0.0}},
      {3, {PatchSource::sampled, 0, 0, 2, 60.0, 30.0, 40.0}}};
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv(outcomes));
  const auto plot = predictions_plot(record);
  ASSERT_TRUE(plot.has_value());
  using Rows = std::vector<std::vector<double>>;
  EXPECT_EQ(block(plot->body, "views_sampled_0"), (Rows{{105, 45}, {30, 40}}));
  EXPECT_EQ(block(plot->body, "views_frontier_0"), (Rows{{5, 0.5}}));
  EXPECT_EQ(block(plot->body, "share_sampled_0"), (Rows{{0, 50, 75}}));
  EXPECT_EQ(block(plot->body, "share_sampled_1"), (Rows{{0, 25, 75}}));
  EXPECT_EQ(block(plot->body, "share_frontier_0"), (Rows{{4, 0, 50}}));
  EXPECT_EQ(plot->body.find("opposite"), std::string::npos);  // neither dot nor key
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv({}));
  EXPECT_FALSE(predictions_plot(record));
  expect_drawable(*plot);
}

}  // namespace
}  // namespace gnbv
