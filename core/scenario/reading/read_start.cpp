// SPDX-License-Identifier: Apache-2.0
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <utility>

namespace dust::scenario {
namespace {

namespace fs = std::filesystem;

constexpr char k_at = '@';

/// A path is seen from the file that it stands in; that of a command line from the working
/// directory.
fs::path seen_from(const Mark& where, const std::string& path) {
  const fs::path folder = where.line > 0 ? fs::path(where.file).parent_path() : fs::path();
  fs::path seen = fs::absolute(folder / path).lexically_normal();
  return seen.filename().empty() ? seen.parent_path() : seen;
}

}  // namespace

/// `start_from: RUN` or `start_from: RUN@TIME`. Whether there is such a run, whoever runs the
/// scenario finds out: it may be still to come.
void read_start(Reading& reading, MapReader& top) {
  const Entry* entry = top.optional("start_from");
  if (entry == nullptr) return;
  const Node& value = entry->value;
  if (!value.is_text() || value.text.empty() || value.text.front() == k_at) {
    reading.error(value.where,
                  "start_from: the folder of a run's results is expected, like results/steady or "
                  "'results/steady@0.5 s', not " +
                      kind_text(value));
    return;
  }
  StartSpec start{.folder = {}, .time = {}, .written = {}, .where = value.where};
  std::string path = value.text;
  const std::size_t at = path.rfind(k_at);
  // A folder may have the character in its name.
  const bool has_time = at != std::string::npos && path.find('/', at) == std::string::npos &&
                        !fs::is_directory(seen_from(value.where, path));
  if (has_time) {
    std::string problem;
    const auto written = split_number(std::string_view(path).substr(at + 1), problem);
    if (written) start.time = to_si(*written, sdk::dimension::time, problem);
    if (!start.time) {
      reading.error(value.where, "start_from: '" + printable(path.substr(at + 1)) +
                                     "' behind the @ is no time, like 0.5 s" +
                                     (problem.empty() ? "" : ": " + problem));
      return;
    }
    path.resize(at);
  }
  start.folder = seen_from(value.where, path);
  start.written = start.folder.string();
  if (start.time) start.written += k_at + number_text(*start.time) + " s";
  add(reading.written, "start_from", written_value(start.written));
  reading.start.from = std::move(start);
}

}  // namespace dust::scenario
