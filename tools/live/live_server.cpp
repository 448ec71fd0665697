#include "tools/live/live_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <mutex>
#include <thread>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr int kPatience_s = 5;         // with who neither sends nor takes
constexpr std::size_t kListeners = 8;  // at once; others wait
constexpr std::size_t kMostBody_bytes = 1024;

constexpr const char* kNothing = "default-src 'none'";  // may be loaded or run

struct Shown {
  // looks again by itself until there is a page
  std::string html =
      "<!doctype html><meta http-equiv=\"refresh\" content=\"1\"><title>gnbv</title>"
      "<p>Nothing flown yet.";
  std::string policy = kNothing;
  std::string views = "0";
};

/// In the place of any before: of two, a browser would keep both.
void set_policy(const std::string& policy, httplib::Response& response) {
  constexpr const char* kName = "Content-Security-Policy";
  response.headers.erase(kName);
  response.set_header(kName, policy + "; frame-ancestors 'none'");
}

void set_headers(httplib::Response& response) {
  set_policy(kNothing, response);
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Cache-Control", "no-store");
}

void answer(int status, const std::string& text, httplib::Response& response) {
  response.status = status;
  response.set_content(text, "text/plain; charset=utf-8");
}

}  // namespace

struct LiveServer::Impl {
  httplib::Server server;
  int port = 0;
  std::mutex mutex;  // of `shown`, held only to copy the pointer
  std::shared_ptr<const Shown> shown = std::make_shared<Shown>();
  std::thread thread;

  std::shared_ptr<const Shown> now() {
    const std::lock_guard lock(mutex);
    return shown;
  }

  /// A name of another site that was made to point here asks for itself.
  bool is_for_us(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    const std::string end = fmt::format(":{}", port);
    const auto is = [&](const std::string& name) {
      return host == name + end || (port == 80 && host == name);  // browsers leave that one out
    };
    return is(kHost) || is("localhost");
  }

  httplib::Server::HandlerResponse refuse(const httplib::Request& request,
                                          httplib::Response& response) {
    using Done = httplib::Server::HandlerResponse;
    set_headers(response);
    if (!is_for_us(request)) {
      answer(403, "asked by another name\n", response);
    } else if (request.method != "GET" && request.method != "HEAD") {
      answer(405, "GET and HEAD only\n", response);
    } else {
      return Done::Unhandled;
    }
    return Done::Handled;
  }
};

LiveServer::LiveServer(int port) : impl_(std::make_unique<Impl>()) {
  Impl& impl = *impl_;
  httplib::Server& server = impl.server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kListeners); };
  server.set_read_timeout(kPatience_s);
  server.set_write_timeout(kPatience_s);
  server.set_keep_alive_timeout(kPatience_s);
  server.set_payload_max_length(kMostBody_bytes);
  server.set_pre_routing_handler(
      [&impl](const auto& request, auto& response) { return impl.refuse(request, response); });
  server.Get("/", [&impl](const httplib::Request&, httplib::Response& response) {
    const std::shared_ptr<const Shown> shown = impl.now();  // the page and its policy of one moment
    set_policy(shown->policy, response);
    response.set_content(shown->html, "text/html; charset=utf-8");
  });
  server.Get("/views", [&impl](const httplib::Request&, httplib::Response& response) {
    answer(200, impl.now()->views + "\n", response);
  });
  // a port is not shared with who listens there already, as the library would
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  impl.port = port;
  if (port == 0) impl.port = server.bind_to_any_port(kHost);
  if (impl.port <= 0 || (port != 0 && !server.bind_to_port(kHost, port))) {
    throw BadInput(
        fmt::format("--live {}: this port of {} cannot be had: it is taken, or yours "
                    "begin at 1024; 0 takes a free one",
                    port, kHost));
  }
  impl.thread = std::thread([&impl] { impl.server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::yield();  // a stop() before that stops nothing
}

LiveServer::~LiveServer() {
  impl_->server.stop();
  impl_->thread.join();
}

std::string LiveServer::url() const { return fmt::format("http://{}:{}/", kHost, impl_->port); }

void LiveServer::show(std::string html, std::string policy, std::size_t views, bool is_finished) {
  auto shown = std::make_shared<const Shown>(
      Shown{.html = std::move(html),
            .policy = std::move(policy),
            .views = fmt::format("{}{}", views, is_finished ? " finished" : "")});
  const std::lock_guard lock(impl_->mutex);
  impl_->shown = std::move(shown);
}

}  // namespace gnbv
