// One page over HTTP, for browsers of this machine. The only file that knows cpp-httplib is its
// .cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace gnbv {

/// Serves on 127.0.0.1 from threads of its own: `/` is the page, `/views` the number of views it
/// shows, with " finished" behind when they are all. Answers nothing but GET and HEAD, and only to
/// those who asked for this machine by name, so that no page of another site can read it. Who is
/// silent is dropped after seconds; eight who trickle keep others waiting, and its end as long.
class LiveServer {
 public:
  /// Port 0: any free one. Throws BadInput when the port cannot be had.
  explicit LiveServer(int port);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  std::string url() const;

  /// What is served from now on. `policy` is the page's own Content-Security-Policy.
  void show(std::string html, std::string policy, std::size_t views, bool is_finished);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnbv
