// Ours beside every number and sentence of the paper that can be checked against missions, as parts
// of the paper's document (paper.schema.json).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/compare/paper_figures.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/paper/missions.hpp"

namespace gnbv {

/// What the numbers of a row are, in their order: head with the unit, decimals.
nlohmann::ordered_json compared_columns();

/// Whether a limit of ours (views, metres, time, battery) ended the mission before it had as many
/// views as the row.
bool is_cut(const PaperMission& mission, const PaperRow& row);

/// The rows of a table and its profile, ours beside the paper's, and all pairs of planners by the
/// figures that the paper prints of both. Ours is taken after as many views as the paper's row
/// took, or after all of them where there are fewer: the paper's planners stopped by themselves at
/// numbers of their own.
nlohmann::ordered_json compared_table(const PaperMaterial& material, const PaperTable& table);

/// The sentences of the paper that the scenarios' missions can answer, in the order of its figures.
nlohmann::ordered_json checked_claims(const PaperMaterial& material);

/// Points a voxel over the views (Fig. 9): a group a row, without those that nobody flew.
std::vector<DrawnGroup> mean_densities(const PaperMaterial& material, const PaperTable& table);

}  // namespace gnbv
