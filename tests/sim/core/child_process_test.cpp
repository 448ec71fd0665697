// Laws of child processes: what is said comes across, how they end is told, nobody is left behind.
#include "sim/core/child_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const ChildOptions kTalks = {.in = ChildStream::pipe, .out = ChildStream::pipe};

std::vector<std::string> sh(const std::string& script) { return {"sh", "-c", script}; }

TEST(ChildProcess, SaysBackWhatItIsTold) {
  ChildProcess cat({"cat"}, kTalks);
  const std::string bytes("a\0b\xff\n", 5);
  cat.write(bytes);
  std::string back(5, ' ');
  cat.read(back.data(), back.size());
  EXPECT_EQ(back, bytes);
  cat.write("a line\nand no more");
  EXPECT_EQ(cat.read_line(), "a line");
  EXPECT_TRUE(cat.is_open());
  EXPECT_TRUE(cat.end().is_success());
}

TEST(ChildProcess, TellsInWordsHowItEnded) {
  EXPECT_EQ(ChildProcess(sh("exit 7")).end().text(), "exit code 7");
  EXPECT_EQ(ChildProcess(sh("kill -9 $$")).end().text(), "killed by signal 9 (Killed)");
  ChildProcess none({"/no/such program"}, kTalks);
  EXPECT_EQ(none.start_error(), ENOENT);
  EXPECT_EQ(none.end().text(), "cannot be started: No such file or directory");
  none.write("into the void");
  EXPECT_EQ(none.read_line(), "");
}

TEST(ChildProcess, ThatEndedLosesWhatItIsToldAndNothingElse) {
  ChildProcess gone(sh("exit 0"), kTalks);
  ASSERT_TRUE(gone.ended_within(seconds(10)));
  gone.write(std::string(1'000'000, 'x'));
  EXPECT_EQ(gone.read_line(), "");
  EXPECT_FALSE(gone.is_open());
}

TEST(ChildProcess, AppendsToItsLogAndKeepsAFileOpenOnlyWhereAsked) {
  TempFolder temp;
  const auto log = temp.path() / "log";
  std::ofstream(log) << "before\n";
  const ChildOptions logs = {.out = ChildStream::log, .err = ChildStream::log, .log = log};
  EXPECT_TRUE(ChildProcess(sh("echo out; echo err >&2"), logs).end().is_success());
  std::ifstream in(log);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "before\nout\nerr\n");
  ChildOptions keeps;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  const auto has_it = sh("test -e /proc/self/fd/" + std::to_string(ends[1]));
  EXPECT_FALSE(ChildProcess(has_it, keeps).end().is_success());
  keeps.kept_open = ends[1];
  EXPECT_TRUE(ChildProcess(has_it, keeps).end().is_success());
}

TEST(ChildProcess, IsWaitedForNoLongerThanAsked) {
  ChildProcess slow({"sleep", "600"});
  EXPECT_FALSE(slow.ended_within(milliseconds(30)));
  slow.send(SIGTERM);
  EXPECT_EQ(slow.end().signal, SIGTERM);
  const auto begin = std::chrono::steady_clock::now();
  { ChildProcess stubborn(sh("trap '' TERM INT; while :; do sleep 0.01; done")); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20)) << "killed when it is let go";
}

TEST(ChildProcess, ThatIsApartHearsNothingOfTheTerminal) {
  const ChildOptions apart = {.in = ChildStream::pipe, .out = ChildStream::pipe, .is_apart = true};
  EXPECT_TRUE(ChildProcess(sh("test $(ps -o pgid= -p $$) -eq $$"), apart).end().is_success());
  ChildProcess child({"cat"}, apart);
  child.send(SIGTERM);  // as a scheduler sends it to all
  child.write("goes on\n");
  EXPECT_EQ(child.read_line(), "goes on");
  EXPECT_TRUE(child.end().is_success());
}

/// The process number of the grandchild that a child of ours starts before it is killed.
pid_t orphan(const ChildOptions& options) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const pid_t middle = fork();
  if (middle == 0) {
    ChildOptions tells = options;
    tells.out = ChildStream::pipe;
    ChildProcess child(sh("echo $$; exec sleep 600"), tells);
    const pid_t pid = std::stoi(child.read_line());
    (void)!write(ends[1], &pid, sizeof pid);
    kill(getpid(), SIGKILL);
  }
  pid_t pid = 0;
  EXPECT_EQ(read(ends[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
  EXPECT_EQ(waitpid(middle, nullptr, 0), middle);
  return pid;
}

TEST(ChildProcess, IsNoOrphanUnderASubreaperUnlessItMayBe) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // as systemd's user manager and containers' first processes
  int status = 0;
  const pid_t dies = orphan({});
  for (int i = 0; i < 1000 && waitpid(dies, &status, WNOHANG) == 0; ++i) usleep(10'000);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it lives on";
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  const pid_t lives = orphan({.dies_with_us = false});
  EXPECT_EQ(waitpid(lives, &status, WNOHANG), 0);
  kill(lives, SIGTERM);
  EXPECT_EQ(waitpid(lives, &status, 0), lives);
  prctl(PR_SET_CHILD_SUBREAPER, 0);
}

}  // namespace
}  // namespace gnbv
