// SPDX-License-Identifier: Apache-2.0
#include "base/log.hpp"

#include "base/write_error.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <memory>
#include <string>

namespace dust::base {
namespace {

/// The level in front of a line, unless the line names its place, and the level behind it.
class Level final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& line) override {
    const std::string_view text(message.payload.data(), message.payload.size());
    const auto name = spdlog::level::to_string_view(message.level);
    const std::string level(name.data(), name.size());
    if (text.find(": " + level + ": ") != std::string_view::npos) return;
    const std::string head = level + ": ";
    line.append(head.data(), head.data() + head.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<Level>();
  }
};

std::unique_ptr<spdlog::formatter> terminal_formatter() {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<Level>('*').set_pattern("%*%v");
  return formatter;
}

spdlog::logger& logger() {
  static const auto instance = [] {
    auto terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    terminal->set_level(spdlog::level::warn);
    terminal->set_formatter(terminal_formatter());
    auto made = std::make_shared<spdlog::logger>("dust", terminal);
    made->set_level(spdlog::level::info);
    // Lines are few, and who follows a run wants the last ones: also of a run that was killed.
    made->flush_on(spdlog::level::info);
    // A log that cannot grow on a full disk is not what the user has to read about.
    made->set_error_handler([](const std::string&) {});
    return made;
  }();
  return *instance;
}

}  // namespace

void log_to_file(const std::filesystem::path& file, bool append) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !append);
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
    logger().sinks().push_back(std::move(sink));
  } catch (const spdlog::spdlog_ex&) {
    throw WriteError(file, errno);
  }
}
void log_to_terminal(bool is_verbose) {
  logger().sinks().front()->set_level(is_verbose ? spdlog::level::info : spdlog::level::warn);
}
void log_info(std::string_view text) { logger().info(text); }
void log_warning(std::string_view text) { logger().warn(text); }
void log_warning_to_file(std::string_view text) {
  spdlog::sinks::sink& terminal = *logger().sinks().front();
  const auto level = terminal.level();
  terminal.set_level(spdlog::level::err);
  logger().warn(text);
  terminal.set_level(level);
}
void log_error(std::string_view text) { logger().error(text); }

}  // namespace dust::base
