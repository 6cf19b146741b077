// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "live/bulletin.hpp"

#include <memory>

namespace dust::live {

/// Serves a bulletin to browsers of this machine: bound to 127.0.0.1, answers GET and HEAD only,
/// and refuses requests under another name than localhost (a page of elsewhere could otherwise
/// reach it under a name of its own).
///
///   /               the page that watches the run (live.html)
///   /progress.json  how far it is
///   /report.html    the report so far
///   /report.json    what that is made of
class Server {
 public:
  /// Takes the port; 0 takes any free one. Throws base::UserError where that is not possible.
  explicit Server(int port);
  /// Ends it; answers under way are broken off.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Begins to answer out of `bulletin`, which outlives the server.
  void begin(Bulletin& bulletin);
  [[nodiscard]] int port() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::live
