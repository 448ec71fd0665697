#include "bench/score/content_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// What the file of every result begins with, whatever version stored it.
constexpr std::string_view kCacheFirstWords = "gnbv cache ";
constexpr std::string_view kVersion = "2 ";
constexpr std::size_t kDigestLength = 64;
constexpr std::size_t kHeaderLength = kCacheFirstWords.size() + kVersion.size() + kDigestLength + 1;

std::string header_of(std::string_view program, std::string_view content) {
  const std::string digest = sha256_of(fmt::format("{}\n{}", program, content));
  return fmt::format("{}{}{}\n", kCacheFirstWords, kVersion, digest);
}

fs::path path_of(const fs::path& folder, std::string_view kind, std::string_view key) {
  GNBV_CHECK(!kind.empty() && !key.empty(), "kind '{}', key '{}'", kind, key);
  GNBV_CHECK(kind.find('/') == kind.npos && key.find('/') == key.npos, "kind '{}', key '{}'", kind,
             key);
  return folder / kind / key;
}

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

/// What is in the folder; what others remove meanwhile is left out.
std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
  std::vector<fs::directory_entry> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    entries.push_back(*at);
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<CacheFile> files_in(const fs::path& kind) {
  std::vector<CacheFile> files;
  for (const fs::directory_entry& entry : entries_of(kind)) {
    std::error_code gone;
    if (!fs::is_regular_file(entry.symlink_status(gone)) || !begins_as_ours(entry.path())) continue;
    CacheFile file = {.used = entry.last_write_time(gone), .path = entry.path()};
    if (gone) continue;
    file.bytes = entry.file_size(gone);
    if (!gone) files.push_back(std::move(file));
  }
  return files;
}

std::vector<fs::path> kinds_in(const fs::path& folder) {
  std::vector<fs::path> kinds;
  for (const fs::directory_entry& entry : entries_of(folder)) {
    std::error_code gone;
    if (fs::is_directory(entry.symlink_status(gone))) kinds.push_back(entry.path());
  }
  return kinds;
}

/// The bytes that this freed.
std::uint64_t remove_file(const CacheFile& file) {
  std::error_code error;
  return fs::remove(file.path, error) ? file.bytes : 0;
}

}  // namespace

fs::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  if (std::getenv("GNBV_CACHE") != nullptr) return variable("GNBV_CACHE");
  if (!variable("XDG_CACHE_HOME").empty()) return fs::path(variable("XDG_CACHE_HOME")) / "gnbv";
  if (!variable("HOME").empty()) return fs::path(variable("HOME")) / ".cache" / "gnbv";
  return {};
}

void add_mesh(Sha256& sha, const TriangleMesh& mesh) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  sha.add(std::uint64_t{mesh.vertices_m.size()});
  sha.add_bytes(std::as_bytes(std::span(mesh.vertices_m)));
  sha.add(std::uint64_t{mesh.faces.size()});
  sha.add_bytes(std::as_bytes(std::span(mesh.faces)));
}

std::optional<std::string> load_cached(std::string_view kind, std::string_view key,
                                       std::string_view program) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return std::nullopt;
  const fs::path path = path_of(folder, kind, key);
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) return std::nullopt;
  std::string content(size, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(content.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  if (content.size() < kHeaderLength) return std::nullopt;
  const std::string header = content.substr(0, kHeaderLength);
  content.erase(0, kHeaderLength);
  if (header != header_of(program, content)) return std::nullopt;
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // used
  return content;
}

bool has_cached(std::string_view kind) {
  const fs::path folder = cache_folder();
  std::error_code error;
  return !folder.empty() && fs::exists(folder / kind, error);
}

void store_cached(std::string_view kind, std::string_view key, std::string_view content,
                  std::string_view program) {
  const fs::path folder = cache_folder();
  const std::uint64_t limit_bytes = cache_limit_bytes();
  const std::uint64_t bytes = kHeaderLength + content.size();
  if (folder.empty() || bytes > limit_bytes) return;
  prune_cache(folder, limit_bytes - bytes);
  const fs::path path = path_of(folder, kind, key);
  // a name of its own for every writer: two may store the same result at the same time
  static std::atomic<unsigned> count{0};
  const fs::path part = path.string() + fmt::format(".{}-{}.part", getpid(), count++);
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) return;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out << header_of(program, content);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (out) fs::rename(part, path, error);
  if (!out || error) fs::remove(part, error);
}

std::uint64_t cache_limit_bytes() {
  const char* const asked = std::getenv("GNBV_CACHE_LIMIT");
  if (asked == nullptr || *asked == '\0') return kDefaultCacheLimit_bytes;
  if (const auto bytes = number_in<std::uint64_t>(asked)) return *bytes;
  throw BadInput("GNBV_CACHE_LIMIT={}: has to be a whole number of bytes", asked);
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

}  // namespace gnbv
