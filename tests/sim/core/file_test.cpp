// Files that outlast what can go wrong with them.
#include "sim/core/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Files of this process end at so many bytes, as on a full disk.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(WriteFile, ThatDoesNotFitIsNoBadInputAndLeavesNothing) {
  const TempFolder temp;
  const fs::path file = temp.path() / "file";
  {
    const FileLimit limit(1000);
    try {
      write_file_atomically(file, std::string(5000, 'x'));
      FAIL();
    } catch (const OutputFailed& failed) {
      EXPECT_NE(std::string(failed.what()).find("file: cannot write: File too large"),
                std::string::npos)
          << failed.what();
    }
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
  EXPECT_THROW(write_file_atomically(temp.path() / "no/file", ""), BadInput);
}

TEST(WriteFile, WhatADeadWriterLeftIsRemovedAndALivingOnesStays) {
  const TempFolder temp;
  std::string of_this_process;
  write_file_atomically(temp.path() / "a.csv", [&](const fs::path& part) {
    of_this_process = part.filename();
    std::ofstream(part) << "x";
  });
  const auto with_process = [&](const std::string& process) {
    std::string name = of_this_process;
    const std::string own = std::to_string(getpid());
    return temp.path() / name.replace(name.find(own), own.size(), process);
  };
  const fs::path dead = with_process("999999999");
  const fs::path living = with_process(std::to_string(getppid()));
  for (const fs::path& file : {dead, living, temp.path() / ".other"}) std::ofstream(file) << "x";
  EXPECT_TRUE(is_temporary(dead));
  EXPECT_FALSE(is_temporary(temp.path() / "iterations.csv.part"));
  remove_stale_temporaries(temp.path());
  remove_stale_temporaries(temp.path() / "absent");
  EXPECT_FALSE(fs::exists(dead));
  for (const fs::path& file : {living, temp.path() / ".other", temp.path() / "a.csv"}) {
    EXPECT_TRUE(fs::exists(file)) << file;
  }
}

TEST(ReadFile, RefusesDevicesThatHaveNoEnd) {
  for (const char* device : {"/dev/zero", "/dev/urandom", "/dev/full"}) {
    EXPECT_THROW(read_file(device), BadInput) << device;
  }
}

TEST(FileLock, HasOneHolderAndNoneOnceItIsGone) {
  const TempFolder temp;
  const fs::path path = temp.path() / "lock";
  EXPECT_FALSE(is_locked(path));
  {
    const std::optional<FileLock> first = FileLock::take(path);
    ASSERT_TRUE(first.has_value());
    EXPECT_TRUE(is_locked(path));
    EXPECT_FALSE(FileLock::take(path).has_value());
    fs::remove(path);  // as a holder does that has done its work: the name is free
    const std::optional<FileLock> second = FileLock::take(path);
    EXPECT_TRUE(second.has_value());
    EXPECT_FALSE(FileLock::take(path).has_value());
  }
  EXPECT_TRUE(FileLock::take(path).has_value());
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("naïve → 5 µm\n\t"), "naïve → 5 µm\n\t");
  EXPECT_EQ(printable("\x1b[31m\r\x7f"), "\\x1b[31m\\x0d\\x7f");
  EXPECT_EQ(printable("\xff\xfe \xc2\x9b"), "\\xff\\xfe \\xc2\\x9b");
  EXPECT_EQ(printable("\xef\xbf\xbd"), "\xef\xbf\xbd");  // the replacement character itself
}

}  // namespace
}  // namespace gnbv
