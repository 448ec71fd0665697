// Laws of drawing: names mean nothing to gnuplot, and every format is what its name says.
#include <chrono>
#include <thread>

#include "sim/core/file.hpp"
#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/run_plots.hpp"
#include "tools/plots/terms_plot.hpp"

namespace gnbv {
namespace {

TEST(Plots, TextsMeanNothingToGnuplot) {
  EXPECT_EQ(gnuplot_text("it's"), "'it''s'");
  EXPECT_EQ(gnuplot_text("a\nset output \"x\""), "'a set output \"x\"'");
  EXPECT_EQ(gnuplot_text("caf\xc3\xa9 \xff\xc3"), "'caf\xc3\xa9 \xef\xbf\xbd\xef\xbf\xbd'");
}

TEST(Plots, EveryFormatIsWhatItSaysEvenWithHostileNames) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  const std::filesystem::path touched = temp.path() / "touched";
  RunRecord record = scored_record();
  record.scenario.name = "a_b^{c} 'q' \"d\" `touch " + touched.string() +
                         "` \\n @x %d $y <b>&amp;\n!touch " + touched.string();
  const std::vector<Plot> plots = {*density_entropy_plot(record), *terms_plot(record)};
  for (const Plot& plot : plots) {
    for (const auto& [format, magic] : {std::pair{PlotFormat::svg, "<?xml"},
                                        {PlotFormat::png, "\x89PNG"},
                                        {PlotFormat::pdf, "%PDF"}}) {
      const std::filesystem::path picture = temp.path() / "picture";
      draw_plot(plot_script(plot, format, {.width_px = 400}), picture);
      const std::string content = read_file(picture);
      EXPECT_TRUE(content.starts_with(magic));
      EXPECT_GT(content.size(), 3000U);
      if (format != PlotFormat::svg) continue;
      EXPECT_NE(content.find("a_b^{c} 'q'"), std::string::npos);  // as it stands, not as markup
      EXPECT_EQ(content.find("<b>"), std::string::npos);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(touched));
}

TEST(Plots, APdfDoesNotSayWhenItWasDrawn) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  const std::string script =
      plot_script(*density_entropy_plot(scored_record()), PlotFormat::pdf, {.width_px = 400});
  draw_plot(script, temp.path() / "one.pdf");
  const std::string content = read_file(temp.path() / "one.pdf");
  EXPECT_NE(content.find("/CreationDate (D:20000101000000"), std::string::npos);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  draw_plot(script, temp.path() / "two.pdf");
  EXPECT_EQ(content, read_file(temp.path() / "two.pdf"));
}

TEST(Plots, ARefusedScriptLeavesNothing) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  TempFolder temp;
  try {
    draw_plot("plot nonsense(\n", temp.path() / "picture.svg");
    FAIL() << "accepted";
  } catch (const BrokenInvariant& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(temp.path()));
}

}  // namespace
}  // namespace gnbv
