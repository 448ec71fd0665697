// Results that are dear to compute, kept on disk by the content they were computed from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
/// make room when the cache would exceed its limit. A cache that cannot be written is no error: the
/// result is just not kept.
void store_cached(std::string_view kind, std::string_view key, std::string_view content,
                  std::string_view program = scoring_source_id());

/// What the cache holds, as `unpacked(bytes)` reads it, or else `make()`, kept as `packed(result)`.
template <typename Result, typename Make>
Result cached(std::string_view kind, std::string_view key,
              std::optional<Result> (*unpacked)(std::string_view),
              std::string (*packed)(const Result&), const Make& make) {
  if (const auto bytes = load_cached(kind, key)) {
    if (auto result = unpacked(*bytes)) return *std::move(result);
  }
  Result result = make();
  store_cached(kind, key, packed(result));
  return result;
}

inline constexpr std::uint64_t kDefaultCacheLimit_bytes = std::uint64_t{2} << 30;

/// $GNBV_CACHE_LIMIT, bytes; the default when it is not set or empty. Throws BadInput for anything
/// but a whole number.
std::uint64_t cache_limit_bytes();

/// Results and their bytes.
struct CacheUse {
  std::size_t results = 0;
  std::uint64_t bytes = 0;
};

/// What is kept of one kind of result.
struct CacheKind {
  std::string kind;
  CacheUse use;
};

/// What the folder holds, kinds in the order of their names; nothing of a folder that is not there.
/// Only files that begin as every result does are ever counted or removed.
std::vector<CacheKind> cache_kinds(const std::filesystem::path& folder);

/// Removes the results that were not used for longest until at most so many bytes are left, and
/// what writers left that were killed an hour ago or earlier; what was removed. Programs that run
/// meanwhile lose no more than the result: who reads a file keeps it open, who comes later computes
/// anew. What cannot be removed stays.
CacheUse prune_cache(const std::filesystem::path& folder, std::uint64_t limit_bytes);

}  // namespace gnbv
