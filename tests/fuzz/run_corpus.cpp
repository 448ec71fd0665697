// Runs a fuzz target over the files of a folder, where libFuzzer is not to be had.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sim/core/file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} CORPUS\n", argv[0]);
    return 2;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const std::string text = gnbv::read_file(entry.path());
    // exactly as large as its content, so that a sanitizer sees a read behind the end
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    ++files;
  }
  fmt::print("{} inputs\n", files);
  return files > 0 ? 0 : 1;
}
