#include "bench/score/content_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

#include "bench/score/cache_limit.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVersion = "2 ";
constexpr std::size_t kDigestLength = 64;
constexpr std::size_t kHeaderLength = kCacheFirstWords.size() + kVersion.size() + kDigestLength + 1;

std::string header_of(std::string_view program, std::string_view content) {
  Sha256 sha;
  sha.add(program);
  sha.add("\n");
  sha.add(content);
  return fmt::format("{}{}{}\n", kCacheFirstWords, kVersion, sha.hex());
}

fs::path path_of(const fs::path& folder, std::string_view kind, std::string_view key) {
  GNBV_CHECK(!kind.empty() && !key.empty(), "kind '{}', key '{}'", kind, key);
  GNBV_CHECK(kind.find('/') == kind.npos && key.find('/') == key.npos, "kind '{}', key '{}'", kind,
             key);
  return folder / kind / key;
}

/// A name of its own for every writer: two may store the same result at the same time.
fs::path part_of(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  return path.string() + fmt::format(".{}-{}.part", getpid(), count++);
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
  mark_used(path);
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
  const fs::path part = part_of(path);
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

}  // namespace gnbv
