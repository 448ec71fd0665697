#include "bench/score/cache_limit.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours kStaleAfter{1};

struct CacheFile {
  fs::file_time_type used;
  fs::path path;
  std::uint64_t bytes = 0;
};

bool is_part(const fs::path& path) { return path.extension() == ".part"; }

/// Of a part not even these may be there yet.
bool begins_as_ours(const fs::path& path) {
  std::string words(kCacheFirstWords.size(), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(words.data(), static_cast<std::streamsize>(words.size()));
  words.resize(static_cast<std::size_t>(in.gcount()));
  return is_part(path) ? kCacheFirstWords.starts_with(words) : words == kCacheFirstWords;
}

/// What others remove meanwhile is left out.
std::vector<CacheFile> files_in(const fs::path& kind) {
  std::vector<CacheFile> files;
  std::error_code error;
  for (fs::directory_iterator at(kind, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (!fs::is_regular_file(at->symlink_status(gone)) || gone) continue;
    if (!begins_as_ours(at->path())) continue;
    CacheFile file = {.used = at->last_write_time(gone), .path = at->path()};
    if (gone) continue;
    file.bytes = at->file_size(gone);
    if (!gone) files.push_back(std::move(file));
  }
  return files;
}

std::vector<fs::path> kinds_in(const fs::path& folder) {
  std::vector<fs::path> kinds;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (fs::is_directory(at->symlink_status(gone)) && !gone) kinds.push_back(at->path());
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

/// The bytes that this freed.
std::uint64_t remove_file(const CacheFile& file) {
  std::error_code error;
  return fs::remove(file.path, error) ? file.bytes : 0;
}

}  // namespace

std::uint64_t cache_limit_bytes() {
  const char* const asked = std::getenv("GNBV_CACHE_LIMIT");
  if (asked == nullptr || *asked == '\0') return kDefaultCacheLimit_bytes;
  const std::string_view text = asked;
  std::uint64_t bytes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bytes);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw BadInput(fmt::format("GNBV_CACHE_LIMIT={}: has to be a whole number of bytes", text));
  }
  return bytes;
}

std::vector<CacheKind> cache_kinds(const fs::path& folder) {
  std::vector<CacheKind> kinds;
  for (const fs::path& path : kinds_in(folder)) {
    CacheKind kind = {.kind = path.filename().string(), .use = {}};
    for (const CacheFile& file : files_in(path)) {
      if (is_part(file.path)) continue;
      ++kind.use.results;
      kind.use.bytes += file.bytes;
    }
    if (kind.use.results > 0) kinds.push_back(std::move(kind));
  }
  return kinds;
}

CacheUse prune_cache(const fs::path& folder, std::uint64_t limit_bytes) {
  CacheUse removed;
  std::vector<CacheFile> results;
  std::uint64_t bytes = 0;
  const auto stale = fs::file_time_type::clock::now() - kStaleAfter;
  for (const fs::path& kind : kinds_in(folder)) {
    for (CacheFile& file : files_in(kind)) {
      if (!is_part(file.path)) {
        bytes += file.bytes;
        results.push_back(std::move(file));
      } else if (file.used < stale) {
        removed.bytes += remove_file(file);  // of a program that was killed: no result
      }
    }
  }
  std::sort(results.begin(), results.end(), [](const CacheFile& a, const CacheFile& b) {
    return std::tie(a.used, a.path) < std::tie(b.used, b.path);
  });
  for (const CacheFile& result : results) {
    if (bytes <= limit_bytes) break;
    std::error_code error;
    const std::uint64_t freed = remove_file(result);
    if (freed > 0 || !fs::exists(result.path, error)) bytes -= result.bytes;
    if (freed == 0) continue;
    ++removed.results;
    removed.bytes += freed;
  }
  return removed;
}

void mark_used(const fs::path& result) {
  std::error_code cannot_be_helped;
  fs::last_write_time(result, fs::file_time_type::clock::now(), cannot_be_helped);
}

}  // namespace gnbv
