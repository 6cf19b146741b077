// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/write_error.hpp"
#include "dust/sdk/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_files.hpp"
#include "io/scenario_leaves.hpp"
#include "io/stored_state.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace dust::io {
namespace {

/// Raised when the meaning of what stands in a checkpoint changes.
constexpr std::int64_t k_checkpoint_format = 8;
constexpr const char* k_format = "format";
constexpr const char* k_scenario = "resolved_yaml";
constexpr const char* k_inputs = "input_files";
constexpr const char* k_parts = "parts";
constexpr const char* k_start = "start_from";

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
                            ": save() did not write what load() asks for, or it was written by "
                            "another version");
    }
    const Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
    const Handle stored(H5Dget_type(dataset.get()), H5Tclose, path);
    if (H5Tget_class(stored.get()) != wanted) {
      throw sdk::ModelError("'" + std::string(name) + "' of " + group_ +
                            " has another type in the checkpoint: save() wrote it as another than "
                            "load() asks for, or "
                            "it was written by another version");
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

/// The files as one text: each as its digest, a space, its name and a zero, which no name holds.
std::string inputs_text(const std::vector<InputFile>& inputs) {
  std::string text;
  for (const InputFile& input : inputs) {
    text += input.sha256 + ' ' + input.written;
    text += '\0';
  }
  return text;
}

std::vector<InputFile> inputs_of_text(std::string_view text) {
  std::vector<InputFile> inputs;
  while (!text.empty()) {
    const std::string_view entry = text.substr(0, text.find('\0'));
    const std::size_t space = std::min(entry.find(' '), entry.size() - 1);
    inputs.push_back({std::string(entry.substr(space + 1)), std::string(entry.substr(0, space))});
    text.remove_prefix(std::min(entry.size() + 1, text.size()));
  }
  return inputs;
}

}  // namespace

void write_checkpoint(
    const std::filesystem::path& file, const ScenarioIdentity& scenario,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveWriter&)>>>& parts) {
  const QuietHdf5 quiet;
  Handle out = create_file(temporary_name(file), true);
  write_attribute(out.get(), k_format, k_checkpoint_format);
  const auto write_string = [&](const char* name, const std::string& text, const char* what) {
    write_array(out.get(), name, H5T_NATIVE_CHAR, text.data(), {text.size()}, Storage::checked,
                {"1", what});
  };
  write_string(k_scenario, scenario.resolved_yaml, "the scenario as run");
  write_string(k_inputs, inputs_text(scenario.inputs), "files that it reads, with their SHA-256");
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
    scenario_.resolved_yaml = read_string(open_->file.get(), k_scenario);
    // Checkpoints from before it was kept do not say what stood in the files.
    if (has_dataset(open_->file.get(), k_inputs)) {
      scenario_.inputs = inputs_of_text(read_string(open_->file.get(), k_inputs));
    }
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

namespace {

std::string short_digest(const std::string& sha256) { return "sha256 " + sha256.substr(0, 12); }

/// One line for each file in which something else stands than when the checkpoint was written.
void refuse_other_files(const std::filesystem::path& checkpoint,
                        const std::vector<ScenarioLeaves::FileChange>& files) {
  std::string lines;
  for (const ScenarioLeaves::FileChange& file : files) {
    if (!file.is_other() || file.path == k_start) continue;
    lines += (lines.empty() ? "error: " : "\nerror: ") + checkpoint.string() + ": " + file.path +
             ": " + file.now + " is not the file that the run began with" +
             (file.then == file.now ? std::string() : ", " + file.then) + " (" +
             short_digest(file.content_then) + " then, " + short_digest(file.content_now) +
             " now): one run would mix both; put the file of then in its place to go on, or start "
             "again with --force or another -o";
  }
  if (!lines.empty()) throw base::UserError(lines);
}

void note_files(const std::vector<ScenarioLeaves::FileChange>& files, Resumption& resumption) {
  for (const ScenarioLeaves::FileChange& file : files) {
    if (file.path == k_start && file.is_other()) {
      resumption.warnings.push_back(
          "start_from: another state than the run began with stands in " + file.now + " (" +
          short_digest(file.content_then) + " then, " + short_digest(file.content_now) +
          " now): the run goes on from its own checkpoint; begun anew it would differ");
    } else if (file.is_moved()) {
      resumption.log_lines.push_back(file.path + ": " + file.now + " in place of " + file.then +
                                     ", with the same content");
    } else if (file.content_then.empty()) {
      resumption.log_lines.push_back(file.path +
                                     ": the checkpoint, of an older version, does not " +
                                     "say what stood in " + file.then);
    }
  }
}

/// What the run goes on with: the files as they are, but the state that it began with as it was.
std::vector<InputFile> inputs_to_keep(const std::vector<ScenarioLeaves::FileChange>& files,
                                      std::vector<InputFile> inputs) {
  for (const ScenarioLeaves::FileChange& file : files) {
    if (file.path != k_start) continue;
    std::erase_if(inputs, [&](const InputFile& input) { return input.written == file.now; });
    if (!file.content_then.empty()) inputs.push_back({file.now, file.content_then});
  }
  return inputs;
}

}  // namespace

Resumption read_checkpoint(
    const std::filesystem::path& file, const ScenarioIdentity& scenario,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>& parts) {
  const std::string start = "error: " + file.string();
  if (!std::filesystem::exists(file)) {
    throw base::UserError(start + ": no checkpoint to resume from; run without --resume");
  }
  const std::string remedy = "start again with --force";
  const StoredState state(file, remedy);
  std::string difference;
  std::vector<ScenarioLeaves::FileChange> files;
  try {
    const ScenarioLeaves then(state.resolved_yaml(), state.inputs());
    const ScenarioLeaves now(scenario.resolved_yaml, scenario.inputs);
    files = now.files_since(then);
    std::vector<std::string_view> ignored(k_free_on_resume.begin(), k_free_on_resume.end());
    for (const ScenarioLeaves::FileChange& f : files) {
      // Nothing is read from there again, whatever has become of that run.
      if (f.path == k_start && f.then == f.now) ignored.emplace_back(k_start);
      if (f.is_other() && f.path != k_start) ignored.emplace_back(f.path);
    }
    difference = then.differences(now, ignored);
  } catch (const base::RunError& e) {
    throw base::UserError(start + ": damaged checkpoint: " + e.what() + "; " + remedy);
  }
  if (!difference.empty()) {
    throw base::UserError(start + " belongs to another scenario: " + difference +
                          "; only time.end and how often is written (time.output_every, "
                          "checkpoint_every, keep_every) may change when a run is resumed; "
                          "start_from takes the state into another scenario");
  }
  refuse_other_files(file, files);
  state.read(parts);
  Resumption resumption;
  note_files(files, resumption);
  resumption.inputs = inputs_to_keep(files, scenario.inputs);
  return resumption;
}

}  // namespace dust::io
