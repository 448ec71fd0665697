#include "sim/core/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporary = ".part-";
constexpr std::size_t kMostOfAPipe = std::size_t{1} << 30;  // bytes

/// Where links lead, so that they stay. Throws BadInput for a device or a pipe, whose place a
/// renamed file would take.
fs::path behind_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux follows
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, ignored); ++i) {
    path = path.parent_path() / fs::read_symlink(path);
  }
  if (!fs::is_other(path, ignored)) return path;
  throw BadInput(fmt::format("{}: is a device or a pipe, not a file", path.string()));
}

/// Named after the process and its machine, since others may write the same file. The extension
/// stays last: some libraries choose the format by it.
fs::path temporary_of(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}{}{}-{}{}", path.stem().string(), kTemporary,
                                          host_name(), getpid(), path.extension().string());
}

/// Whether its writer still runs. A writer on another machine counts as dead.
bool has_living_writer(const fs::path& temporary) {
  const std::string name = temporary.filename().string();
  const std::string host = std::string(kTemporary) + host_name() + "-";
  const std::size_t at = name.rfind(host);
  if (at == std::string::npos) return false;
  pid_t process = 0;
  const char* const first = name.data() + at + host.size();
  const auto [end, error] = std::from_chars(first, name.data() + name.size(), process);
  if (error != std::errc{} || process <= 0 || process == getpid()) return false;
  return kill(process, 0) == 0 || errno == EPERM;
}

/// Whether the path still names the open file: a holder of the lock may have removed it.
bool is_still_there(int descriptor, const fs::path& path) {
  struct stat open_file {};
  struct stat named_file {};
  return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named_file) == 0 &&
         open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

void refuse_to_write(const fs::path& path, int error_number, std::string_view what) {
  if (error_number == 0) throw OutputFailed(fmt::format("{}: {}", path.string(), what));
  const std::string sentence =
      fmt::format("{}: {}: {}", path.string(), what, std::strerror(error_number));
  for (const int of_the_machine :
       {ENOSPC, EDQUOT, EIO, EFBIG, EMFILE, ENFILE, ENOMEM, EPIPE, ESTALE}) {
    if (error_number == of_the_machine) throw OutputFailed(sentence);
  }
  throw BadInput(sentence);
}

std::string extension_of(const fs::path& path) {
  std::string out = path.extension().string();
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::ifstream open_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw BadInput(fmt::format("{}: is a directory, not a file", path.string()));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
  return in;
}

void need_whole(const std::istream& in, const fs::path& path) {
  if (in.bad()) throw BadInput(fmt::format("{}: {}", path.string(), std::strerror(errno)));
}

std::string read_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_character_file(path, ignored)) {
    throw BadInput(fmt::format("{}: is a device, not a file", path.string()));
  }
  std::ifstream in = open_file(path);
  const bool is_pipe = !fs::is_regular_file(path, ignored);
  std::string content;
  std::array<char, std::size_t{1} << 16> block{};
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (is_pipe && content.size() > kMostOfAPipe) {
      throw BadInput(fmt::format("{}: goes on after 1 GiB", path.string()));
    }
  }
  need_whole(in, path);
  return content;
}

void write_file_atomically(const fs::path& path, std::string_view content, Lasting lasting) {
  const auto write = [&](const fs::path& part) {
    errno = 0;
    std::ofstream out(part, std::ios::binary);
    out << content;
    out.close();
    if (!out) refuse_to_write(path, errno);
  };
  write_file_atomically(path, write, lasting);
}

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write,
                           Lasting lasting) {
  const fs::path file = behind_links(path);
  const fs::path part = temporary_of(file.parent_path() / path.filename());
  try {
    write(part);
    if (lasting == Lasting::power_failures) sync_to_disk(part);
    fs::rename(part, file);
    if (lasting == Lasting::power_failures) sync_to_disk(file.parent_path());
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    try {
      throw;
    } catch (const fs::filesystem_error& error) {
      refuse_to_write(path, error.code().value());
    }
  }
}

bool is_temporary(const fs::path& name) {
  const std::string text = name.filename().string();
  return text.starts_with('.') && text.find(kTemporary) != std::string::npos;
}

void remove_stale_temporaries(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (!is_temporary(entry.path()) || has_living_writer(entry.path())) continue;
    fs::remove(entry.path(), ignored);
  }
}

void sync_to_disk(const fs::path& path) {
  const int file = open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse_to_write(path, errno);
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  // some file systems cannot sync and say so: no reason to give up
  for (const int excused : {0, EINVAL, ENOTSUP, EROFS, EBADF}) {
    if (error == excused) return;
  }
  refuse_to_write(path, error);
}

void sync_all_to_disk(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() || entry.is_directory()) sync_to_disk(entry.path());
  }
  sync_to_disk(folder);
}

bool make_folder(const fs::path& folder) {
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) refuse_to_write(folder, error.value(), "cannot make the folder");
  return is_new;
}

std::optional<FileLock> FileLock::take(const fs::path& path) {
  // again, since is_locked() of another process holds the lock for a moment
  for (int attempt = 0; attempt < 5; ++attempt) {
    FileLock lock(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0) refuse_to_write(path, errno);
    if (flock(lock.descriptor_, LOCK_EX | LOCK_NB) == 0) {
      if (is_still_there(lock.descriptor_, path)) return lock;
      continue;
    }
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw BadInput(fmt::format("{}: cannot lock: {}", path.string(), std::strerror(errno)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool is_locked(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);  // it may be another user's
  if (descriptor < 0) return false;
  const bool is_free = flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  close(descriptor);
  return !is_free;
}

}  // namespace gnbv
