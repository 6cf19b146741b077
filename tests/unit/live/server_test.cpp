// SPDX-License-Identifier: Apache-2.0
#include "live/server.hpp"
#include "base/error.hpp"
#include "support/text.hpp"
#include "unit/report/fake_run.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

using dust::live::Bulletin;
using dust::live::Server;
using dust::test::holds;
using dust::test::RunFolder;
using nlohmann::json;

namespace {

/// A connection to `address`; negative where nobody listens there.
int connect_to(const char* address, int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address, &there.sin_addr);
  if (::connect(socket, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0) return socket;
  ::close(socket);
  return -1;
}

/// What comes back for the bytes of a request.
std::string answer_to(int port, const std::string& request) {
  const int socket = connect_to("127.0.0.1", port);
  REQUIRE(socket >= 0);
  REQUIRE(::write(socket, request.data(), request.size()) == static_cast<ssize_t>(request.size()));
  std::string text;
  char part[4096];
  for (ssize_t n = 0; (n = ::read(socket, part, sizeof part)) > 0;) {
    text.append(part, static_cast<std::size_t>(n));
  }
  ::close(socket);
  return text;
}

std::string ask(int port, const std::string& method, const std::string& path,
                std::string host = "") {
  if (host.empty()) host = "127.0.0.1:" + std::to_string(port);
  return answer_to(port, method + " " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
}

std::string body_of(const std::string& answer) {
  return answer.substr(answer.find("\r\n\r\n") + 4);
}

/// A server with a bulletin over an invented run.
struct Fixture {
  Fixture() {
    folder.write("scenario.yaml", "name: transfer_point\n");
    folder.write_h5({});
    server.begin(bulletin);
  }
  RunFolder folder;
  Bulletin bulletin{folder.path()};
  Server server{0};
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a live run shall tell how far it is") {
  bulletin.publish_progress({{"time_s", 0.25}, {"status", "running"}});
  const std::string answer = ask(server.port(), "GET", "/progress.json");
  CHECK(holds(answer, "200 OK"));
  const json progress = json::parse(body_of(answer));
  CHECK(progress["time_s"] == 0.25);
  CHECK(progress["states"] == 0);
}

TEST_CASE_FIXTURE(Fixture, "the report of a live run shall come with its first frame and grow") {
  CHECK(holds(ask(server.port(), "GET", "/report.html"), "503"));
  json summary = dust::test::fake_summary();
  summary["simulated_s"] = 0.125;
  bulletin.publish_state(summary, json::object());
  const json first = json::parse(body_of(ask(server.port(), "GET", "/report.json")));
  CHECK(first["kind"] == "run");
  CHECK(first["summary"]["simulated_s"] == 0.125);
  CHECK(first["grains"]["frames"].size() == 3);
  folder.write_h5({.frames = 5});
  summary["simulated_s"] = 0.5;
  bulletin.publish_state(summary, json::object());
  // A page is made anew at most every sixth of the time.
  json second = first;
  for (int k = 0; k < 100 && second["summary"]["simulated_s"] != 0.5; ++k) {
    ::usleep(50000);
    second = json::parse(body_of(ask(server.port(), "GET", "/report.json")));
  }
  CHECK(second["grains"]["frames"].size() == 5);
  CHECK(dust::test::page_data(body_of(ask(server.port(), "GET", "/report.html")))["kind"] == "run");
  // What a run has not written yet it does not write for this.
  CHECK_FALSE(std::filesystem::exists(folder.path() / "summary.json"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "report.json"));
}

TEST_CASE_FIXTURE(Fixture, "a live run shall be read only") {
  for (const char* method : {"POST", "PUT", "DELETE"}) {
    CAPTURE(method);
    CHECK(holds(ask(server.port(), method, "/progress.json"), "405"));
  }
  const std::string head = ask(server.port(), "HEAD", "/progress.json");
  CHECK(holds(head, "200 OK"));
  CHECK(body_of(head).empty());
  CHECK(holds(ask(server.port(), "GET", "/../scenario.yaml"), "404"));
  CHECK(holds(ask(server.port(), "GET", "/scenario.yaml"), "404"));
}

TEST_CASE_FIXTURE(Fixture, "a live run shall be seen from this machine only") {
  CHECK(connect_to("127.0.0.2", server.port()) < 0);  // listens on one address alone
  CHECK(holds(ask(server.port(), "GET", "/", "elsewhere.example"), "403"));
  CHECK(holds(ask(server.port(), "GET", "/", "localhost:" + std::to_string(server.port())), "200"));
}

TEST_CASE_FIXTURE(Fixture, "what is no request shall not end a live run") {
  CHECK_FALSE(holds(answer_to(server.port(), "nonsense\r\n\r\n"), "200"));
  CHECK_FALSE(
      holds(answer_to(server.port(), "GET /" + std::string(100000, 'a') + "\r\n\r\n"), "200"));
  CHECK(holds(ask(server.port(), "GET", "/progress.json"), "200"));
}

TEST_CASE("a port that is taken shall be refused with a remedy") {
  const Server first(0);
  try {
    const Server second(first.port());
    FAIL("two servers on one port");
  } catch (const dust::base::UserError& error) {
    CHECK(holds(error.lines().at(0), std::to_string(first.port())));
    CHECK(holds(error.lines().at(0), "--live-port"));
  }
}
