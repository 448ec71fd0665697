// Files that are either whole or not there, and locks on files.
#pragma once

#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace gnbv {

/// The machine failed to write: a full disk, a quota, a broken device, too many open files (exit
/// code 1). A place that nobody can write to is BadInput.
class OutputFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws OutputFailed or BadInput naming the path and the cause; `error_number` is errno's, 0 when
/// unknown.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error_number,
                                  std::string_view what = "cannot write");

/// The extension in lower case, with its dot: ".obj"; empty without one.
std::string extension_of(const std::filesystem::path& path);

/// Of this machine.
std::string host_name();

/// Opens a file or pipe to read its bytes. Throws BadInput naming the path.
std::ifstream open_file(const std::filesystem::path& path);
/// Throws BadInput naming the path when reading it failed, rather than ended.
void need_whole(const std::istream& in, const std::filesystem::path& path);

/// The whole file, or pipe of up to 1 GiB. Throws BadInput naming the path when it cannot be read
/// or is a device.
std::string read_file(const std::filesystem::path& path);

/// What a written file outlasts. A power failure costs some milliseconds a file.
enum class Lasting { the_process, power_failures };

/// Writes beside `path` and renames: a reader sees the old file or the new one, never a part.
/// Throws as refuse_to_write().
void write_file_atomically(const std::filesystem::path& path, std::string_view content,
                           Lasting lasting = Lasting::power_failures);

/// The same, where `write` fills the temporary file.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write,
                           Lasting lasting = Lasting::power_failures);

/// Whether a file of that name is a temporary one of write_file_atomically().
bool is_temporary(const std::filesystem::path& name);

/// Removes the temporary files that killed writers left in the folder, if there is one.
void remove_stale_temporaries(const std::filesystem::path& folder);

/// Lets a file, or the list of names in a folder, outlast power failures. Throws as
/// refuse_to_write().
void sync_to_disk(const std::filesystem::path& path);

/// The same for a folder with all that is in it.
void sync_all_to_disk(const std::filesystem::path& folder);

/// Makes the folder and those above it. Returns whether it is new. Throws as refuse_to_write().
bool make_folder(const std::filesystem::path& folder);

/// Appends the bytes of a number, the lowest first.
template <typename T>
void append_bytes(std::string& out, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  out.append(bytes.data(), bytes.size());
}

/// An exclusive lock on a file. The kernel releases it with the last process that has the file
/// open: a mission keeps the lock on its cell when its sweep is killed.
class FileLock {
 public:
  /// Makes the file if need be. Nothing when another holder has the lock. Throws BadInput when the
  /// file cannot be made or its file system has no locks.
  static std::optional<FileLock> take(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

  /// Closed in processes that this one starts, unless they are told to keep it.
  int descriptor() const { return descriptor_; }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Whether somebody holds the lock now.
bool is_locked(const std::filesystem::path& path);

}  // namespace gnbv
