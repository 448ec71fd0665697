// Nothing is kept or found between the searches of a test.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace gnbv::test {

/// GNBV_CACHE is empty while it lives, and then as it was.
class NoCache {
 public:
  NoCache() {
    if (const char* const before = std::getenv("GNBV_CACHE")) before_ = before;
    setenv("GNBV_CACHE", "", 1);
  }
  ~NoCache() {
    if (before_) {
      setenv("GNBV_CACHE", before_->c_str(), 1);
    } else {
      unsetenv("GNBV_CACHE");
    }
  }
  NoCache(const NoCache&) = delete;
  NoCache& operator=(const NoCache&) = delete;

 private:
  std::optional<std::string> before_;
};

}  // namespace gnbv::test
