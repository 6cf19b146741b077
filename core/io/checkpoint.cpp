// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/write_error.hpp"
#include "dust/sdk/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_files.hpp"
#include "io/scenario_leaves.hpp"
#include "io/stored_state.hpp"

#include <array>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace dust::io {
namespace {

/// Raised when the meaning of what stands in a checkpoint changes.
constexpr std::int64_t k_checkpoint_format = 7;
constexpr const char* k_format = "format";
constexpr const char* k_scenario = "resolved_yaml";
constexpr const char* k_parts = "parts";

std::string in_part(std::string_view group, std::string_view name) {
  return std::string(k_parts) + "/" + std::string(group) + "/" + std::string(name);
}

class GroupWriter final : public sdk::ArchiveWriter {
 public:
  GroupWriter(hid_t file, std::string group) : file_(file), group_(std::move(group)) {}
  void numbers(std::string_view name, std::span<const double> values) override {
    write_array(file_, in_part(group_, name), H5T_NATIVE_DOUBLE, values.data(), {values.size()},
                Storage::checked, {"SI", "state of the model"});
  }
  void integers(std::string_view name, std::span<const std::int64_t> values) override {
    write_array(file_, in_part(group_, name), H5T_NATIVE_INT64, values.data(), {values.size()},
                Storage::checked, {"1", "state of the model"});
  }

 private:
  hid_t file_;
  std::string group_;
};

/// H5Lexists needs every group on the way to exist.
bool has_dataset(hid_t file, const std::string& path) {
  for (std::size_t cut = path.find('/'); cut != std::string::npos; cut = path.find('/', cut + 1)) {
    if (H5Lexists(file, path.substr(0, cut).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

class GroupReader final : public sdk::ArchiveReader {
 public:
  GroupReader(hid_t file, std::string group) : file_(file), group_(std::move(group)) {}
  std::vector<double> numbers(std::string_view name) override {
    return values<double>(name, H5T_NATIVE_DOUBLE, H5T_FLOAT);
  }
  std::vector<std::int64_t> integers(std::string_view name) override {
    return values<std::int64_t>(name, H5T_NATIVE_INT64, H5T_INTEGER);
  }

 private:
  template <class T>
  std::vector<T> values(std::string_view name, hid_t type, H5T_class_t wanted) {
    const std::string path = in_part(group_, name);
    if (!has_dataset(file_, path)) {
      throw sdk::ModelError("the checkpoint holds no '" + std::string(name) + "' of " + group_ +
                            "; it was written by another version");
    }
    const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const Handle stored(H5Dget_type(dataset.get()), H5Tclose, path);
    if (H5Tget_class(stored.get()) != wanted) {
      throw sdk::ModelError(
          "'" + std::string(name) + "' of " + group_ +
          " has another type in the checkpoint; it was written by another version");
    }
    std::vector<T> result(extents_of(file_, path).at(0));
    if (!result.empty()) read_array(file_, path, type, result.data());
    return result;
  }

  hid_t file_;
  std::string group_;
};

/// What may change when a run is resumed: how long it goes on and what it writes on the way.
constexpr std::array<std::string_view, 4> k_free_on_resume = {
    "time.end", "time.output_every", "time.checkpoint_every", "time.keep_every"};

std::string read_string(hid_t file, const std::string& name) {
  std::vector<char> bytes(extents_of(file, name).at(0));
  if (!bytes.empty()) read_array(file, name, H5T_NATIVE_CHAR, bytes.data());
  return {bytes.begin(), bytes.end()};
}

}  // namespace

void write_checkpoint(
    const std::filesystem::path& file, const std::string& resolved_yaml,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveWriter&)>>>& parts) {
  const QuietHdf5 quiet;
  Handle out = create_file(temporary_name(file), true);
  write_attribute(out.get(), k_format, k_checkpoint_format);
  write_array(out.get(), k_scenario, H5T_NATIVE_CHAR, resolved_yaml.data(), {resolved_yaml.size()},
              Storage::checked, {"1", "the scenario as run"});
  create_group(out.get(), k_parts);
  for (const auto& [name, save] : parts) {
    GroupWriter writer(out.get(), name);
    save(writer);
  }
  out.close("cannot write " + file.string());
  move_into_place(file, true);
}

struct StoredState::Open {
  Handle file;
};

StoredState::StoredState(std::filesystem::path file, std::string remedy)
    : file_(std::move(file)), remedy_(std::move(remedy)) {
  const QuietHdf5 quiet;
  try {
    open_ = std::make_unique<Open>(Open{open_file(file_)});
    const std::vector<double> format = read_attribute(open_->file.get(), k_format);
    if (format.size() != 1 || format[0] != static_cast<double>(k_checkpoint_format)) {
      refuse("a checkpoint of another version");
    }
    resolved_yaml_ = read_string(open_->file.get(), k_scenario);
  } catch (const base::RunError& e) {
    refuse(std::string("damaged checkpoint: ") + e.what());
  }
}

StoredState::~StoredState() = default;

bool StoredState::has(const std::string& part, const std::string& column) const {
  const QuietHdf5 quiet;
  return has_dataset(open_->file.get(), in_part(part, column));
}

void StoredState::read(const Parts& parts) const {
  const QuietHdf5 quiet;
  try {
    for (const auto& [name, load] : parts) {
      GroupReader reader(open_->file.get(), name);
      load(reader);
    }
  } catch (const base::RunError& e) {
    refuse(std::string("damaged checkpoint: ") + e.what());
  } catch (const sdk::ModelError& e) {
    refuse(e.what());
  }
}

void StoredState::refuse(const std::string& problem) const {
  throw base::UserError("error: " + file_.string() + ": " + problem + "; " + remedy_);
}

void keep_checkpoint(const std::filesystem::path& file, const std::filesystem::path& as) {
  namespace fs = std::filesystem;
  make_folder(as.parent_path());
  const fs::path temporary = temporary_name(as);
  std::error_code problem;
  fs::remove(temporary, problem);
  // The checkpoint is replaced and never changed: a second name for it takes no room.
  fs::create_hard_link(file, temporary, problem);
  if (problem) fs::copy_file(file, temporary, fs::copy_options::overwrite_existing, problem);
  if (problem) throw base::WriteError(as, problem.value());
  move_into_place(as, false);
}

void read_checkpoint(
    const std::filesystem::path& file, const std::string& resolved_yaml,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>& parts) {
  const std::string start = "error: " + file.string();
  if (!std::filesystem::exists(file)) {
    throw base::UserError(start + ": no checkpoint to resume from; run without --resume");
  }
  const std::string remedy = "start again with --force";
  const StoredState state(file, remedy);
  std::string difference;
  try {
    difference = ScenarioLeaves(state.resolved_yaml())
                     .differences(ScenarioLeaves(resolved_yaml), k_free_on_resume);
  } catch (const base::RunError& e) {
    throw base::UserError(start + ": damaged checkpoint: " + e.what() + "; " + remedy);
  }
  if (!difference.empty()) {
    throw base::UserError(start + " belongs to another scenario: " + difference +
                          "; only time.end and how often is written (time.output_every, "
                          "checkpoint_every, keep_every) may change when a run is resumed; "
                          "start_from takes the state into another scenario");
  }
  state.read(parts);
}

}  // namespace dust::io
