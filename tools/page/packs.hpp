// The parts of a run as its page has them, each thinned until it takes at most so many bytes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensors/ray_scene.hpp"
#include "tools/page/page_data.hpp"
#include "tools/page/thinning.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

constexpr std::size_t kLeastElements = 16;  // whatever the room is

inline std::uint32_t as_count(std::size_t count) { return static_cast<std::uint32_t>(count); }

/// Every n-th sample and the last one, with the least n that fits.
page::PathData pack_path(std::span<const TrajectorySample> path, std::size_t max_bytes,
                         page::Arrays& arrays);

/// Of each plan of a tour as many views from its beginning as all of them have room for. Throws
/// BadInput as read_plans() does.
page::PlanData pack_plan(const RunRecord& record, std::size_t max_bytes, page::Arrays& arrays);

/// All or none: throws BadInput when they take more, or are damaged. Nothing for a run that kept
/// none.
std::optional<page::CandidateData> pack_candidates(const RunRecord& record, std::size_t max_bytes,
                                                   page::Arrays& arrays);

/// In cells that are larger where there is no room; a cell is of a list when any of its voxels is.
/// Nothing for a run that kept none. Throws BadInput when they are damaged.
std::optional<page::BeliefData> pack_beliefs(const RunRecord& record, std::size_t max_bytes,
                                             page::Arrays& arrays);

/// The sentence for a run that kept candidates, but not these: an older program's; empty otherwise.
std::string why_no_beliefs(const RunRecord& record);

/// In voxels of the lattice that stands at the origin, of the map's size or larger. Requires points
/// within 2^15 voxels of the origin.
page::VoxelData pack_voxels(const RunCloud& cloud, double size_m, std::size_t max_bytes,
                            page::Arrays& arrays);

/// The points that were kept; with their errors where the structure's scene is known.
page::CloudData pack_cloud(const RunCloud& cloud, const ThinnedPoints& thin, const RayScene* scene,
                           int threads, page::Arrays& arrays);

/// `surface.glb` of `gnbv surface`, where the run has one. Throws BadInput when it takes more, or
/// is no whole file of its kind.
std::optional<page::Array<std::uint8_t>> pack_surface(const RunRecord& record,
                                                      std::size_t max_bytes, page::Arrays& arrays);

}  // namespace gnbv
