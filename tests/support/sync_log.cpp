// Preloaded into the program under test: a line in $SYNC_LOG for each file or folder that is synced
// ("sync PATH"), for each that is renamed ("rename TO") or removed ("remove PATH").
#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void note(const std::string& line) {
  const char* const log = std::getenv("SYNC_LOG");
  std::FILE* const file = log == nullptr ? nullptr : std::fopen(log, "a");
  if (file == nullptr) return;
  std::fputs((line + "\n").c_str(), file);
  std::fclose(file);
}

}  // namespace

extern "C" int fsync(int descriptor) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  if (readlink(link.c_str(), path.data(), path.size() - 1) > 0) {
    note("sync " + std::string(path.data()));
  }
  using Sync = int (*)(int);
  static const auto next = reinterpret_cast<Sync>(dlsym(RTLD_NEXT, "fsync"));
  return next(descriptor);
}

extern "C" int remove(const char* path) {
  using Remove = int (*)(const char*);
  static const auto next = reinterpret_cast<Remove>(dlsym(RTLD_NEXT, "remove"));
  const int failed = next(path);
  if (failed == 0) note("remove " + std::string(path));
  return failed;
}

extern "C" int rename(const char* from, const char* to) {
  using Rename = int (*)(const char*, const char*);
  static const auto next = reinterpret_cast<Rename>(dlsym(RTLD_NEXT, "rename"));
  note("rename " + std::string(to));
  return next(from, to);
}
