// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/write_error.hpp"
#include "io/atomic_file.hpp"
#include "io/run_files.hpp"
#include "io/way_on.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>

namespace dust::io {
namespace {

/// RFC 4180: a field with a comma, quote or line break is quoted.
void append_field(std::string& text, const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  text += '"';
}

std::string header_of(std::span<const std::string> names) {
  std::string line;
  for (const std::string& name : names) {
    if (!line.empty()) line += ',';
    append_field(line, name);
  }
  return line + '\n';
}

/// The names of a header, as header_of() wrote it.
std::vector<std::string> fields_of(const std::string& header) {
  std::vector<std::string> names(1);
  bool is_quoted = false;
  for (std::size_t n = 0; n < header.size() && header[n] != '\n'; ++n) {
    const bool is_quote = header[n] == '"';
    if (is_quote && is_quoted && n + 1 < header.size() && header[n + 1] == '"') {
      names.back() += header[++n];
    } else if (is_quote) {
      is_quoted = !is_quoted;
    } else if (header[n] == ',' && !is_quoted) {
      names.emplace_back();
    } else {
      names.back() += header[n];
    }
  }
  return names;
}

/// What a row has otherwise than the first: "'probe/m [kg]' is gone".
std::string difference(const std::vector<std::string>& before, std::span<const std::string> names) {
  for (std::size_t n = 0; n < std::min(before.size(), names.size()); ++n) {
    if (before[n] == names[n]) continue;
    const auto has = [](const auto& all, const std::string& name) {
      return std::find(all.begin(), all.end(), name) != all.end();
    };
    if (!has(names, before[n]) && has(before, names[n])) return "'" + before[n] + "' is gone";
    if (!has(before, names[n]) && has(names, before[n])) return "'" + names[n] + "' is new";
    return "'" + before[n] + "' is '" + names[n] + "' now";
  }
  return before.size() > names.size() ? "'" + before[names.size()] + "' is gone"
                                      : "'" + names[before.size()] + "' is new";
}

}  // namespace

struct SeriesFile::Impl {
  std::filesystem::path file;
  std::string header;  ///< with its line end; empty before the first row
  std::int64_t rows = 0;
  int descriptor = -1;

  ~Impl() {
    if (descriptor >= 0) ::close(descriptor);
  }

  /// Keeps the header and the first `wanted` rows. A row cut short by a kill has no line end and
  /// is not counted.
  void cut_back(std::int64_t wanted) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::size_t end = text.find('\n');
    if (end != std::string::npos) header = text.substr(0, end + 1);
    std::size_t kept = header.size();
    while (rows < wanted && kept < text.size() &&
           (end = text.find('\n', kept)) != std::string::npos) {
      kept = end + 1;
      ++rows;
    }
    if (rows < wanted) {
      throw base::UserError("error: " + file.string() + " holds " + std::to_string(rows) +
                            " rows, the checkpoint needs " + std::to_string(wanted) + "; " +
                            way_on_from_checkpoint(file.parent_path()));
    }
    write_text(file, text.substr(0, kept));
  }

  /// One write per row: what a kill leaves is whole rows and at most one cut short.
  void write_line(const std::string& line) {
    std::size_t done = 0;
    while (done < line.size()) {
      const ssize_t part = ::write(descriptor, line.data() + done, line.size() - done);
      if (part < 0 && errno != EINTR) {
        throw base::WriteError(file, errno);
      }
      done += static_cast<std::size_t>(std::max<ssize_t>(part, 0));
    }
  }
};

SeriesFile::SeriesFile(std::filesystem::path file, std::int64_t resume_rows)
    : impl_(std::make_unique<Impl>()) {
  impl_->file = std::move(file);
  if (resume_rows < 0) {
    write_text(impl_->file, "");
  } else {
    impl_->cut_back(resume_rows);
  }
  impl_->descriptor = ::open(impl_->file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (impl_->descriptor < 0) {
    throw base::WriteError(impl_->file, errno);
  }
}

SeriesFile::~SeriesFile() = default;

void SeriesFile::append(std::span<const std::string> names_with_units,
                        std::span<const double> values) {
  const std::string header = header_of(names_with_units);
  if (impl_->header.empty()) {
    impl_->write_line(header);
    impl_->header = header;
  }
  if (header != impl_->header) {
    throw base::RunError("the columns of " + impl_->file.string() + " changed during the run: " +
                         difference(fields_of(impl_->header), names_with_units) +
                         "; a sensor's columns (SENSOR/COLUMN) must be the same in every row");
  }
  if (names_with_units.size() != values.size()) {
    throw base::RunError(impl_->file.string() + ": " + std::to_string(values.size()) +
                         " numbers for " + std::to_string(names_with_units.size()) + " columns");
  }
  std::string line;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (n > 0) line += ',';
    // What has no value, a mean of nothing, is an empty field.
    if (!std::isnan(values[n])) line += base::shortest_text(values[n]);
  }
  impl_->write_line(line + '\n');
  ++impl_->rows;
}

void SeriesFile::sync() {
  if (::fsync(impl_->descriptor) != 0) throw base::WriteError(impl_->file, errno);
}

std::int64_t SeriesFile::rows() const { return impl_->rows; }

}  // namespace dust::io
