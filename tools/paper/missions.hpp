// The missions of the paper's evaluation: which they are, and what is read of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/run/run_record.hpp"
#include "tools/sweep/bench_runs.hpp"

namespace gnbv {

/// Which of it is made.
struct PaperRequest {
  std::vector<std::string> scenarios;  // of paper_tables(), in the paper's order
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> overrides;  // key=value, for all of them
};

/// Every row of the scenarios' tables with every seed: the missions of `gnbv table --no-oracle`, so
/// that both share them. Seed by seed, so that the first one shows all of it and what a mission
/// takes on average soon stands. Throws BadInput as cells_of().
std::vector<Cell> paper_cells(const PaperRequest& request);

/// A mission that came to an end.
struct PaperMission {
  std::string scenario;
  std::string utility;
  std::uint64_t seed = 0;
  RunRecord record;  // with figures
};

struct PaperMaterial {
  PaperRequest request;
  std::vector<PaperMission> missions = {};
  /// Of the labs with the first seed; their images texture the reconstructions (Figs 15 and 18).
  std::vector<PaperMission> with_images = {};
  std::vector<std::string> notes = {};  // what is missing of it, and why
  bool has_failures = false;
};

/// Flies what is missing and reads all. Throws as fly_cells().
PaperMaterial fly_paper(const PaperRequest& request, const BenchOptions& options);

/// The missions of a row, by seed.
std::vector<const PaperMission*> missions_of(const PaperMaterial& material,
                                             std::string_view scenario, std::string_view utility);

}  // namespace gnbv
