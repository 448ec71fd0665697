// How much the cache may hold (bench/score/content_cache.hpp), and what goes when it is more.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// What the file of every result begins with, whatever version stored it. No other file of the
/// folder is ever counted or removed, but an empty .part.
inline constexpr std::string_view kCacheFirstWords = "gnbv cache ";

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
std::vector<CacheKind> cache_kinds(const std::filesystem::path& folder);

/// Removes the results that were not used for longest until at most so many bytes are left, and
/// what writers left that were killed an hour ago or earlier; what was removed. Programs that run
/// meanwhile lose no more than the result: who reads a file keeps it open, who comes later computes
/// anew. What cannot be removed stays.
CacheUse prune_cache(const std::filesystem::path& folder, std::uint64_t limit_bytes);

/// A result was used now.
void mark_used(const std::filesystem::path& result);

}  // namespace gnbv
