// The missions of the paper's evaluation: which they are, and what is read of them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/run/run_record.hpp"
#include "tools/sweep/sweep.hpp"

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

/// Those whose images texture the reconstructions (Figs 15 and 18): the labs with the first seed.
std::vector<Cell> pictured_cells(const PaperRequest& request);

/// A mission that came to an end.
struct PaperMission {
  std::string scenario;
  std::string utility;
  std::uint64_t seed = 0;
  RunRecord record;  // with figures
};

struct PaperMaterial {
  PaperRequest request;
  std::vector<PaperMission> missions;     // scenario by scenario, row by row, seed by seed
  std::vector<PaperMission> with_images;  // of pictured_cells()
  std::vector<std::string> notes;         // what is missing of it, and why
};

/// The missions of a row, by seed.
std::vector<const PaperMission*> missions_of(const PaperMaterial& material,
                                             std::string_view scenario, std::string_view utility);

}  // namespace gnbv
