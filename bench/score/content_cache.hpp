// Results that are dear to compute, kept on disk by the content they were computed from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bench/sources/source_ids.hpp"
#include "sim/core/sha256.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// $GNBV_CACHE, else $XDG_CACHE_HOME/gnbv, else $HOME/.cache/gnbv. Empty, and nothing is kept, when
/// GNBV_CACHE is set to the empty string or none of them is.
std::filesystem::path cache_folder();

/// Adds a mesh to a key.
void add_mesh(Sha256& sha, const TriangleMesh& mesh);

/// What this program stored under the key; nothing when there is none, when another program stored
/// it, or when it is damaged (a SHA-256 over program and content is checked). `kind` names the
/// computation ("surface_reference"), `key` is the SHA-256 of all input that it depends on. What
/// computes it is `program`: no number has to be raised when that changes.
std::optional<std::string> load_cached(std::string_view kind, std::string_view key,
                                       std::string_view program = scoring_source_id());

/// Whether anything of the kind is stored, by whatever program.
bool has_cached(std::string_view kind);

/// Stores by rename, in the place of another program's result. Those that were not used for longest
/// make room when the cache would exceed its limit (bench/score/cache_limit.hpp). A cache that
/// cannot be written is no error: the result is just not kept.
void store_cached(std::string_view kind, std::string_view key, std::string_view content,
                  std::string_view program = scoring_source_id());

}  // namespace gnbv
