// Laws of films: whole or not there.
#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/core/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/render/movie.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Image grey(int width_px, int height_px) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width_px * height_px), 128)};
}

bool has_ffmpeg() { return std::system("command -v ffmpeg >/dev/null") == 0; }

TEST(Movie, AppearsWholeUnderNamesThatFfmpegWouldReadOtherwise) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TempFolder temp;
  const fs::path before = fs::current_path();
  fs::current_path(temp.path());
  for (const char* const name : {"http:film.mp4", "-film.mp4"}) {
    Movie movie(name, 32, 24, 24);
    movie.add(grey(32, 24));
    EXPECT_FALSE(fs::exists(name));
    movie.finish();
    EXPECT_GT(fs::file_size(name), 100U);
  }
  fs::current_path(before);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp.path()), {}), 2);  // no parts are left
}

TEST(Movie, HalfWrittenLeavesNothing) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TempFolder temp;
  {
    Movie movie(temp.path() / "film.gif", 32, 24, 24);
    movie.add(grey(32, 24));
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
}

TEST(Movie, WithoutFfmpegNamesThePackage) {
  const TempFolder temp;
  const char* const path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", temp.path().c_str(), 1);
  std::string complaint;
  try {
    const Movie movie(temp.path() / "film.mp4", 32, 24, 24);
  } catch (const BadInput& error) {
    complaint = error.what();
  }
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_NE(complaint.find("Debian package ffmpeg"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(temp.path()));
  EXPECT_THROW(Movie(temp.path() / "film.avi", 32, 24, 24), BadInput);
}

}  // namespace
}  // namespace gnbv
