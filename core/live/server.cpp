// SPDX-License-Identifier: Apache-2.0
#include "live/server.hpp"

#include "base/error.hpp"
#include "report/page.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <thread>

namespace dust::live {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr auto k_patience = std::chrono::seconds(30);

Response answer(http::status status, const char* kind, std::string text) {
  Response response{status, 11};
  response.set(http::field::content_type, kind);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  // The report stands in a frame of the page that watches, and in nobody else's.
  response.set("X-Frame-Options", "SAMEORIGIN");
  response.keep_alive(false);
  response.body() = std::move(text);
  return response;
}

/// Whether the browser was sent here as to this machine.
bool is_local(const Request& request, int port) {
  const auto host = request[http::field::host];
  const std::string number = ":" + std::to_string(port);
  return host == "127.0.0.1" + number || host == "localhost" + number;
}

Response content(Bulletin& bulletin, const std::string& path) {
  constexpr const char* k_html = "text/html; charset=utf-8";
  constexpr const char* k_json = "application/json";
  if (path == "/") {
    return answer(http::status::ok, k_html,
                  report::page_of(report::Templates(), "live.html", nlohmann::json::object()));
  }
  if (path == "/progress.json") {
    return answer(http::status::ok, k_json, bulletin.progress().dump() + "\n");
  }
  const bool is_page = path == "/report.html";
  if (!is_page && path != "/report.json") {
    return answer(http::status::not_found, "text/plain", "nothing is here\n");
  }
  std::string text = is_page ? bulletin.page() : bulletin.document();
  if (text.empty()) {
    return answer(http::status::service_unavailable, "text/plain", "no frame is written yet\n");
  }
  return answer(http::status::ok, is_page ? k_html : k_json, std::move(text));
}

Response answer_to(Bulletin& bulletin, const Request& request, int port) {
  if (!is_local(request, port)) {
    return answer(http::status::forbidden, "text/plain", "ask for 127.0.0.1\n");
  }
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    Response response =
        answer(http::status::method_not_allowed, "text/plain", "this is only to be read\n");
    response.set(http::field::allow, "GET, HEAD");
    return response;
  }
  const std::string target(request.target());
  try {
    return content(bulletin, target.substr(0, target.find('?')));
  } catch (const std::exception& e) {
    return answer(http::status::internal_server_error, "text/plain", std::string(e.what()) + "\n");
  }
}

/// One request and its answer.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(asio::ip::tcp::socket socket, Bulletin& bulletin, int port)
      : stream_(std::move(socket)), bulletin_(bulletin), port_(port) {}

  void begin() {
    stream_.expires_after(k_patience);
    http::async_read(stream_, buffer_, request_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->reply();
                     });
  }

 private:
  void reply() {
    response_ = answer_to(bulletin_, request_, port_);
    response_.prepare_payload();
    if (request_.method() == http::verb::head) response_.body().clear();
    stream_.expires_after(k_patience);
    http::async_write(
        stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
          beast::error_code ignored;
          self->stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{16 * 1024};  // a request that needs more is none of ours
  Request request_;
  Response response_;
  Bulletin& bulletin_;
  int port_;
};

}  // namespace

class Server::Impl {
 public:
  explicit Impl(int port) : acceptor_(context_) {
    const auto number = static_cast<std::uint16_t>(port);
    try {
      const asio::ip::tcp::endpoint here(asio::ip::address_v4::loopback(), number);
      acceptor_.open(here.protocol());
      acceptor_.set_option(asio::socket_base::reuse_address(true));
      acceptor_.bind(here);
      acceptor_.listen();
    } catch (const std::exception& e) {
      throw base::UserError("error: --live: port " + std::to_string(port) +
                            " of 127.0.0.1 cannot be used (" + e.what() +
                            "); leave --live-port out to take any free one");
    }
    port_ = acceptor_.local_endpoint().port();
  }
  ~Impl() {
    context_.stop();
    for (std::thread& thread : threads_) {
      if (thread.joinable()) thread.join();
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void begin(Bulletin& bulletin) {
    bulletin_ = &bulletin;
    accept();
    for (std::thread& thread : threads_) thread = std::thread([this] { context_.run(); });
  }
  [[nodiscard]] int port() const { return port_; }

 private:
  void accept() {
    acceptor_.async_accept(context_, [this](beast::error_code error, asio::ip::tcp::socket peer) {
      if (!error) std::make_shared<Visit>(std::move(peer), *bulletin_, port_)->begin();
      if (acceptor_.is_open()) accept();
    });
  }

  Bulletin* bulletin_ = nullptr;
  asio::io_context context_;
  asio::ip::tcp::acceptor acceptor_;
  int port_ = 0;
  // One may make a page while the other tells how far the run is.
  std::array<std::thread, 2> threads_;
};

Server::Server(int port) : impl_(std::make_unique<Impl>(port)) {}
Server::~Server() = default;
void Server::begin(Bulletin& bulletin) { impl_->begin(bulletin); }
int Server::port() const { return impl_->port(); }

}  // namespace dust::live
