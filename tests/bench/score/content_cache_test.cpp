#include "bench/score/content_cache.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The cache in a folder of the test's own.
class ContentCache : public testing::Test {
 protected:
  ContentCache() { setenv("GNBV_CACHE", temp_.path().c_str(), 1); }
  ~ContentCache() override { unsetenv("GNBV_CACHE"); }

  TempFolder temp_;
};

const std::string kBytes("a\0b\n\xff", 5);

TEST_F(ContentCache, ReturnsWhatWasStoredAndNothingElse) {
  EXPECT_EQ(load_cached("kind-1", "00"), std::nullopt);
  store_cached("kind-1", "00", kBytes);
  EXPECT_EQ(load_cached("kind-1", "00"), kBytes);
  store_cached("kind-1", "00", "");
  EXPECT_EQ(load_cached("kind-1", "00"), "");
  EXPECT_EQ(load_cached("kind-1", "01"), std::nullopt);
}

TEST_F(ContentCache, TwoKindsDoNotCollide) {
  store_cached("kind-1", "00", "one");
  EXPECT_EQ(load_cached("kind-2", "00"), std::nullopt);
  store_cached("kind-2", "00", "two");
  EXPECT_EQ(load_cached("kind-1", "00"), "one");
  EXPECT_EQ(load_cached("kind-2", "00"), "two");
}

TEST_F(ContentCache, WhatAnotherProgramStoredIsNotReturned) {
  store_cached("kind-1", "00", "old", "old sources");
  EXPECT_EQ(load_cached("kind-1", "00"), std::nullopt);
  store_cached("kind-1", "00", "new");
  EXPECT_EQ(load_cached("kind-1", "00"), "new");
  EXPECT_EQ(load_cached("kind-1", "00", scoring_source_id()), "new");
  EXPECT_EQ(load_cached("kind-1", "00", "old sources"), std::nullopt);
}

TEST_F(ContentCache, AFileWithAnyByteWrongMissingOrAddedIsNotReturned) {
  store_cached("kind-1", "00", kBytes);
  const fs::path file = temp_.path() / "kind-1" / "00";
  const std::string whole = read_file(file);
  const auto content_with = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    return load_cached("kind-1", "00");
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_EQ(content_with(damaged), std::nullopt) << "byte " << i;
    EXPECT_EQ(content_with(whole.substr(0, i)), std::nullopt) << "cut to " << i;
  }
  EXPECT_EQ(content_with(whole + "x"), std::nullopt);
  EXPECT_EQ(content_with(whole), kBytes);
}

TEST_F(ContentCache, NothingButWholeFilesIsLeftBehind) {
  for (int i = 0; i < 3; ++i) store_cached("kind-1", "00", kBytes);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp_.path() / "kind-1"), {}), 1);
}

TEST_F(ContentCache, EmptyVariableKeepsNothing) {
  setenv("GNBV_CACHE", "", 1);
  EXPECT_TRUE(cache_folder().empty());
  store_cached("kind-1", "00", kBytes);
  EXPECT_EQ(load_cached("kind-1", "00"), std::nullopt);
}

TEST_F(ContentCache, AFolderThatCannotBeWrittenIsNoError) {
  std::ofstream(temp_.path() / "file") << "x";
  setenv("GNBV_CACHE", (temp_.path() / "file").c_str(), 1);
  store_cached("kind-1", "00", kBytes);
  EXPECT_EQ(load_cached("kind-1", "00"), std::nullopt);
}

TEST_F(ContentCache, FolderFollowsTheEnvironment) {
  EXPECT_EQ(cache_folder(), temp_.path());
  unsetenv("GNBV_CACHE");
  const char* const xdg = std::getenv("XDG_CACHE_HOME");
  const std::string before = xdg == nullptr ? "" : xdg;
  setenv("XDG_CACHE_HOME", "/x", 1);
  EXPECT_EQ(cache_folder(), "/x/gnbv");
  unsetenv("XDG_CACHE_HOME");
  if (const char* const home = std::getenv("HOME")) {
    EXPECT_EQ(cache_folder(), fs::path(home) / ".cache" / "gnbv");
  }
  if (xdg != nullptr) setenv("XDG_CACHE_HOME", before.c_str(), 1);
}

TEST_F(ContentCache, AKeyThatLeavesTheFolderIsABrokenInvariant) {
  EXPECT_THROW(store_cached("kind-1", "../00", kBytes), BrokenInvariant);
  EXPECT_THROW(load_cached("", "00"), BrokenInvariant);
}

}  // namespace
}  // namespace gnbv
