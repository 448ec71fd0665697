// Files larger than what is held of them.
#include "sim/mesh/chunked_file.hpp"

#include <gtest/gtest.h>

#include "tests/sim/mesh/mesh_files.hpp"

namespace gnbv {
namespace {

using namespace test;

/// 3 MB of numbered lines of three words, one of them as long as all others together.
std::vector<std::string> many_lines() {
  std::vector<std::string> lines;
  for (int i = 0; i < 100'000; ++i) lines.push_back(fmt::format("line {} {}", i, 7 * i % 1009));
  lines[40'000] = "a " + std::string(1'500'000, 'x') + " z";
  lines[50'000] = "";
  return lines;
}

TEST_F(MeshFile, LinesAndWordsAreWholeAcrossChunks) {
  const std::vector<std::string> lines = many_lines();
  for (const char* end : {"", "\n"}) {
    const auto path = write("t", fmt::format("{}{}", fmt::join(lines, "\n"), end));
    ChunkedFile by_line(path);
    std::vector<std::string> found;
    while (const auto line = by_line.line()) found.emplace_back(*line);
    EXPECT_TRUE(found == lines);
    EXPECT_EQ(by_line.bytes_left(), 0U);
    ChunkedFile by_word(path);
    std::string words;
    for (std::string_view word = by_word.word(); !word.empty(); word = by_word.word()) {
      words += std::string(word) + ' ';
    }
    found.erase(found.begin() + 50'000);
    EXPECT_TRUE(words == fmt::format("{} ", fmt::join(found, " ")));
  }
}

TEST_F(MeshFile, BytesAreWholeAcrossChunks) {
  const std::string content = fmt::format("{}", fmt::join(many_lines(), "\n"));
  ChunkedFile file(write("t", content));
  std::string found;
  for (std::size_t step = 1; file.bytes_left() >= step; step = step % 23 + 1) {
    found.append(file.bytes(step), step);
  }
  const std::size_t rest = file.bytes_left();
  EXPECT_EQ(file.bytes(rest + 1), nullptr);
  found.append(file.bytes(rest), rest);
  EXPECT_TRUE(found == content);
}

TEST_F(MeshFile, AChunkMayEndAnywhere) {
  for (const std::size_t length : {(1U << 20) - 2, (1U << 20) - 1, 1U << 20, (1U << 20) + 1}) {
    const auto path = write("t", std::string(length, 'x') + "\ny");
    ChunkedFile by_word(path);
    EXPECT_EQ(by_word.word().size(), length);
    EXPECT_EQ(by_word.word(), "y");
    ChunkedFile by_line(path);
    EXPECT_EQ(by_line.line()->size(), length);
    EXPECT_EQ(by_line.line(), "y");
  }
}

TEST_F(MeshFile, FilesThatCannotBeReadAreNamed) {
  EXPECT_THROW(ChunkedFile{folder_}, BadInput);
  EXPECT_THROW(ChunkedFile{folder_ / "absent"}, BadInput);
  ChunkedFile empty(write("t", ""));
  EXPECT_FALSE(empty.line());
  EXPECT_TRUE(empty.word().empty());
}

}  // namespace
}  // namespace gnbv
