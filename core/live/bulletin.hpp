// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

namespace dust::live {

/// What a run says of itself while it goes on: written by the run between its steps, read by the
/// threads of the server.
class Bulletin {
 public:
  explicit Bulletin(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// How far the run is: plain numbers and texts.
  void publish_progress(nlohmann::json progress);
  /// summary.json and the run's part of report.json as they would be if the run ended now.
  void publish_state(nlohmann::json summary, nlohmann::json report);

  [[nodiscard]] nlohmann::json progress() const;
  /// The page of the run so far; made anew after a new state, but never so often that making it
  /// takes more than a sixth of the time. Throws base::UserError where the page cannot be made.
  [[nodiscard]] std::string page();
  /// The document the page is made of.
  [[nodiscard]] std::string document();

 private:
  struct Made {
    std::int64_t state = 0;
    std::string page, document;
    double seconds = 0.0;  ///< that making it took
    double at = 0.0;       ///< when it was done, on a clock of its own
  };
  void renew();

  std::filesystem::path folder_;
  mutable std::mutex mutex_;  ///< guards the three
  nlohmann::json progress_ = nlohmann::json::object();
  nlohmann::json summary_, report_;
  std::int64_t state_ = 0;
  std::mutex making_;  ///< guards made_
  Made made_;
};

}  // namespace dust::live
