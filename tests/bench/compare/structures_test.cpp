// Laws of comparisons over several structures.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>

#include "sim/core/rng.hpp"
#include "tests/bench/compare/compared_runs.hpp"

namespace gnbv {
namespace {

/// Twelve scenarios of ten structures, three methods, up to four seeds; some missions are missing.
std::vector<ComparedRun> many_structures() {
  std::vector<ComparedRun> runs;
  for (std::uint64_t s = 0; s < 12; ++s) {
    const double size = 20.0 + 7.0 * static_cast<double>(s);
    for (std::uint64_t m = 0; m < 3; ++m) {
      for (std::uint64_t seed = 0; seed < 1 + s % 4; ++seed) {
        const auto drawn = [&](std::uint64_t what) {
          return uniform01({s, Stream::bench, 10 * m + seed, what});
        };
        if (m == 1 && drawn(0) < 0.1) continue;
        runs.push_back(climbing(fmt::format("m{}", m), seed, 7 + static_cast<int>(4 * drawn(1)),
                                size * (1.0 + drawn(2) + 0.5 * static_cast<double>(m))));
        RunFigures& figures = runs.back().figures;
        runs.back().scenario = fmt::format("s{}", s);
        figures.structure = fmt::format("structure {}", s % 10);
        figures.coverage_final[0] = drawn(3) + 0.3 * static_cast<double>(m);
      }
    }
  }
  return runs;
}

Ceilings ceilings_of_many() {
  Ceilings all;
  for (int s = 0; s < 12; ++s) all.merge(ceiling_at(1.0, fmt::format("s{}", s)));
  return all;
}

double slow_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

TEST(CompareStructures, OverStructuresTheTestIsOfTheirDifferences) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::vector<ComparedRun> runs = many_structures();
  const Comparison c = compare(runs, "m0", ceilings_of_many());
  ASSERT_EQ(c.structures, 10U);
  ASSERT_EQ(c.scenarios.back(), "all 10 structures");
  for (const auto& [metric, is_effort] : {std::pair(kCoverageMetric, false), {kTo90, true}}) {
    // a method's values by structure: of coverage the mean, of efforts the median
    const auto by_structure = [&](const std::string& method) {
      std::map<std::string, std::vector<double>> values;
      for (const ComparedRun& run : runs) {
        if (run.method != method) continue;
        const auto& curve = run.figures.curve;
        values[run.figures.structure].push_back(!is_effort ? 100.0 * run.figures.coverage_final[0]
                                                : curve.views() >= 9 ? curve.metres[9]
                                                                     : kNever);
      }
      std::map<std::string, double> all;
      for (const auto& [structure, of_runs] : values) {
        all[structure] = is_effort ? slow_median(of_runs) : mean_of(of_runs);
      }
      return all;
    };
    const auto base = by_structure("m0");
    std::array<double, 2> p{};
    for (const std::size_t m : {0U, 1U}) {
      std::vector<double> differences;
      for (const auto& [structure, value] : by_structure(fmt::format("m{}", m + 1))) {
        const double other = base.at(structure);
        differences.push_back(value == other ? 0.0 : value - other);
      }
      p[m] = wilcoxon_signed_rank(differences).p;  // that of all permutations: statistics_test.cpp
      const Contrast& contrast = *find_figure(c, 12, metric, m + 1)->contrast;
      EXPECT_EQ(contrast.difference.n, differences.size());
      EXPECT_NEAR(contrast.test.p, p[m], 1e-12) << metric;
    }
    for (const std::size_t m : {0U, 1U}) {
      EXPECT_NEAR(find_figure(c, 12, metric, m + 1)->contrast->p_holm,
                  std::min(1.0, std::max(p[m], 2.0 * std::min(p[0], p[1]))), 1e-12);
    }
  }
  // what one structure shows is told
  for (const MethodFigure& figure : c.figures) {
    if (figure.scenario == 12 || !figure.contrast) continue;
    EXPECT_EQ(figure.contrast->verdict, Verdict::told);
  }
  EXPECT_EQ(answers(c).size(), 2U);
  EXPECT_NE(answers(c)[1].find("n = 10 structures"), std::string::npos);
}

TEST(CompareStructures, AStructureIsItsMeshWhateverItsFileIsCalled) {
  const auto structures = [](const std::string& file, const std::string& sha256) {
    std::vector<MissionRow> rows;
    for (const std::string scenario : {"one", "two"}) {
      for (const std::string method : {"a", "b"}) {
        rows.push_back({.scenario = scenario, .method = method});
        rows.back().structure = file.empty() ? scenario : file;
        rows.back().structure_sha256 = sha256.empty() ? scenario : sha256;
        rows.back().figures["within_coverage_0.05"] = 0.9;
      }
    }
    return compare(rows, "a").structures;
  };
  EXPECT_EQ(structures("part.obj", ""), 2U);
  EXPECT_EQ(structures("", "1a2b"), 1U);
}

/// All figures by name, to the last bit.
std::map<std::string, std::vector<double>> named_figures(const Comparison& c) {
  std::map<std::string, std::vector<double>> all;
  for (const MethodFigure& f : c.figures) {
    std::vector<double>& values = all[fmt::format("{}, {}, {}", c.scenarios[f.scenario],
                                                  c.metrics[f.metric].name, c.methods[f.method])];
    values = {static_cast<double>(f.reached), f.estimate.mean, f.estimate.half_width.value_or(-1.0),
              f.median.value_or(-1.0), f.rank.value_or(-1.0)};
    if (!f.contrast) continue;
    const Contrast& k = *f.contrast;
    values.insert(values.end(),
                  {k.difference.mean, k.difference.half_width.value_or(-1.0), k.baseline_mean,
                   k.test.p, k.test.w_plus, k.p_holm, static_cast<double>(k.verdict)});
  }
  return all;
}

TEST(CompareStructures, NoFigureDependsOnTheOrderOfRunsMethodsAndScenarios) {
  std::vector<ComparedRun> runs = many_structures();
  const auto figures = named_figures(compare(runs, "m1", ceilings_of_many()));
  for (std::uint64_t turn = 0; turn < 5; ++turn) {
    for (std::size_t i = runs.size() - 1; i > 0; --i) {
      std::swap(runs[i], runs[random_bits({turn, Stream::bench, i, 0}) % (i + 1)]);
    }
    EXPECT_EQ(named_figures(compare(runs, "m1", ceilings_of_many())), figures) << turn;
  }
}

}  // namespace
}  // namespace gnbv
