#include "bench/score/content_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The cache in a folder of the test's own.
class ContentCache : public testing::Test {
 protected:
  ContentCache() { setenv("GNBV_CACHE", folder().c_str(), 1); }
  ~ContentCache() override {
    unsetenv("GNBV_CACHE");
    unsetenv("GNBV_CACHE_LIMIT");
  }

  fs::path folder() const { return temp_.path() / "cache"; }
  fs::path file(const std::string& key) const { return folder() / "kind" / key; }

  /// A result that is so many seconds old.
  void store(const std::string& key, int age_s) const {
    store_cached("kind", key, std::string(1000, 'x'));
    grow_old(file(key), age_s);
  }
  static void grow_old(const fs::path& path, int age_s) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(age_s));
  }
  std::uint64_t size_of_one() const { return fs::file_size(file("a")); }
  /// The names of the kind's files, one letter each.
  std::string kept() const {
    std::string names;
    for (const auto& entry : fs::directory_iterator(folder() / "kind")) {
      names += entry.path().filename().string();
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TempFolder temp_;
};

const std::string kBytes("a\0b\n\xff", 5);

TEST_F(ContentCache, ReturnsWhatThisProgramStoredUnderKindAndKey) {
  EXPECT_EQ(load_cached("kind", "00"), std::nullopt);
  for (const std::string& bytes : {kBytes, std::string()}) {
    store_cached("kind", "00", bytes);
    EXPECT_EQ(load_cached("kind", "00"), bytes);
  }
  EXPECT_EQ(load_cached("kind", "01"), std::nullopt);
  EXPECT_EQ(load_cached("kind-2", "00"), std::nullopt);
  store_cached("kind-2", "00", "two");
  EXPECT_EQ(load_cached("kind", "00"), "");
  store_cached("kind", "00", "old", "old sources");
  EXPECT_EQ(load_cached("kind", "00"), std::nullopt);
  store_cached("kind", "00", "new");
  EXPECT_EQ(load_cached("kind", "00", scoring_source_id()), "new");
  EXPECT_EQ(load_cached("kind", "00", "old sources"), std::nullopt);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "kind"), {}), 1);  // no .part
}

TEST_F(ContentCache, AFileWithAnyByteWrongMissingOrAddedIsNotReturned) {
  store_cached("kind", "00", kBytes);
  const fs::path file = this->file("00");
  const std::string whole = read_file(file);
  const auto content_with = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    return load_cached("kind", "00");
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

TEST_F(ContentCache, WithoutAFolderNothingIsKept) {
  std::ofstream(temp_.path() / "file") << "x";
  for (const std::string& nowhere : {std::string(), (temp_.path() / "file").string()}) {
    setenv("GNBV_CACHE", nowhere.c_str(), 1);
    EXPECT_EQ(cache_folder(), nowhere);
    store_cached("kind", "00", kBytes);
    EXPECT_EQ(load_cached("kind", "00"), std::nullopt);
  }
}

TEST_F(ContentCache, FolderFollowsTheEnvironment) {
  EXPECT_EQ(cache_folder(), folder());
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
  EXPECT_THROW(store_cached("kind", "../00", kBytes), BrokenInvariant);
  EXPECT_THROW(load_cached("", "00"), BrokenInvariant);
}

TEST_F(ContentCache, WhatWasNotUsedForLongestGoesFirst) {
  store("a", 30);
  store("b", 50);
  store("c", 40);
  const std::uint64_t one = size_of_one();
  EXPECT_EQ(prune_cache(folder(), 3 * one).results, 0U);
  EXPECT_EQ(kept(), "abc");
  const CacheUse removed = prune_cache(folder(), 3 * one - 1);
  EXPECT_EQ(removed.results, 1U);
  EXPECT_EQ(removed.bytes, one);
  EXPECT_EQ(kept(), "ac");
  EXPECT_TRUE(load_cached("kind", "c"));  // which is using it
  prune_cache(folder(), one);
  EXPECT_EQ(kept(), "c");
  prune_cache(folder(), 0);
  EXPECT_EQ(kept(), "");
}

TEST_F(ContentCache, StoringNeverExceedsIt) {
  store("a", 50);
  store("b", 40);
  const std::uint64_t one = size_of_one();
  setenv("GNBV_CACHE_LIMIT", std::to_string(2 * one + 5).c_str(), 1);
  store("c", 0);
  EXPECT_EQ(kept(), "bc");
  setenv("GNBV_CACHE_LIMIT", std::to_string(one - 1).c_str(), 1);
  store_cached("kind", "d", std::string(1000, 'x'));  // larger than all that may be kept
  EXPECT_EQ(kept(), "bc");
  setenv("GNBV_CACHE_LIMIT", "0", 1);
  store_cached("kind", "d", "");
  EXPECT_EQ(kept(), "bc");
}

TEST_F(ContentCache, OnlyResultsAndLeftPartsAreRemoved) {
  store("a", 50);
  std::ofstream(folder() / "kind" / "thesis.txt") << "mine";
  std::ofstream(folder() / "kind" / "movie.part") << "mine";
  std::ofstream(folder() / "thesis.txt") << "gnbv cache 2 of mine";
  std::ofstream(file("d.1-0.part")) << "gnbv cache 2 0123";
  std::ofstream(file("e.1-0.part")) << "gnbv cache 2 0123";
  for (const auto* name : {"thesis.txt", "movie.part", "d.1-0.part"}) {
    grow_old(folder() / "kind" / name, 2 * 3600);
  }
  EXPECT_EQ(prune_cache(folder(), 0).results, 1U);  // a; the part that nobody writes is none
  EXPECT_TRUE(fs::exists(folder() / "kind" / "thesis.txt"));
  EXPECT_TRUE(fs::exists(folder() / "kind" / "movie.part"));
  EXPECT_TRUE(fs::exists(folder() / "thesis.txt"));
  EXPECT_TRUE(fs::exists(file("e.1-0.part")));
  EXPECT_FALSE(fs::exists(file("d.1-0.part")));
  EXPECT_FALSE(fs::exists(file("a")));
}

TEST_F(ContentCache, TheFolderSaysWhatItHolds) {
  EXPECT_TRUE(cache_kinds(folder()).empty());
  store("a", 1);
  store("b", 1);
  store_cached("another", "c", "");
  const std::vector<CacheKind> kinds = cache_kinds(folder());
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0].kind, "another");
  EXPECT_EQ(kinds[0].use.results, 1U);
  EXPECT_EQ(kinds[1].use.results, 2U);
  EXPECT_EQ(kinds[1].use.bytes, 2 * size_of_one());
}

/// Whoever loads while others prune and store gets the whole result or none.
TEST_F(ContentCache, PruningBesideReadersAndWriters) {
  const std::string content(20'000, 'x');
  std::atomic<bool> is_over = false;
  std::atomic<int> wrong = 0;
  std::atomic<int> found = 0;
  std::thread reader([&] {
    while (!is_over) {
      const auto loaded = load_cached("kind", "a");
      if (loaded && *loaded != content) ++wrong;
      if (loaded) ++found;
    }
  });
  std::thread pruner([&] {
    while (!is_over) prune_cache(folder(), 0);
  });
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  for (int i = 0; i < 300 || (found < 3 && std::chrono::steady_clock::now() < until); ++i) {
    store_cached("kind", "a", content);
  }
  is_over = true;
  reader.join();
  pruner.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(found, 3);
}

TEST_F(ContentCache, IsAWholeNumberOfBytes) {
  EXPECT_EQ(cache_limit_bytes(), kDefaultCacheLimit_bytes);
  setenv("GNBV_CACHE_LIMIT", "", 1);
  EXPECT_EQ(cache_limit_bytes(), kDefaultCacheLimit_bytes);
  setenv("GNBV_CACHE_LIMIT", "123456789012", 1);
  EXPECT_EQ(cache_limit_bytes(), 123456789012U);
  for (const char* wrong : {"-1", "nan", "1e9", "2GiB", " 5", "99999999999999999999"}) {
    setenv("GNBV_CACHE_LIMIT", wrong, 1);
    EXPECT_THROW(cache_limit_bytes(), BadInput) << wrong;
  }
}

}  // namespace
}  // namespace gnbv
