#include "sim/core/file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "sim/core/error.hpp"

namespace gnbv {

std::string extension_of(const std::filesystem::path& path) {
  std::string out = path.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw BadInput(fmt::format("{}: is a directory, not a file", path.string()));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  write_file_atomically(path, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.flush();
    if (!out)
      throw BadInput(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
  });
}

void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write) {
  // the extension stays last, since some libraries choose the format by it; the process and its
  // machine are named, since others may write the same file
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::filesystem::path part = path;
  part.replace_filename(fmt::format(".{}.part-{}-{}{}", path.stem().string(), host.data(), getpid(),
                                    path.extension().string()));
  try {
    write(part);
    std::filesystem::rename(part, path);
  } catch (const std::filesystem::filesystem_error& error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw BadInput(fmt::format("{}: cannot write: {}", path.string(), error.code().message()));
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

bool make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const bool is_new = std::filesystem::create_directories(folder, error);
  if (!error) return is_new;
  throw BadInput(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
}

}  // namespace gnbv
