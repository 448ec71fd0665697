// Results that are dear to compute, kept on disk by the content they were computed from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/sha256.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// $GNBV_CACHE, else $XDG_CACHE_HOME/gnbv, else $HOME/.cache/gnbv. Empty, and nothing is kept, when
/// GNBV_CACHE is set to the empty string or none of them is.
std::filesystem::path cache_folder();

/// Adds a mesh to a key.
void add_mesh(Sha256& sha, const TriangleMesh& mesh);

/// What was stored under the key; nothing when there is none, or when it is damaged (its SHA-256 is
/// checked). `kind` names the computation and its version ("surface_reference-1"), `key` is the
/// SHA-256 of all that it depends on.
std::optional<std::string> load_cached(std::string_view kind, std::string_view key);

/// Stores by rename. A cache that cannot be written is no error: the result is just not kept.
void store_cached(std::string_view kind, std::string_view key, std::string_view content);

}  // namespace gnbv
