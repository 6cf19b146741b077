// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "dust/sdk/error.hpp"
#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_files.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
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
    if (!exists(path)) {
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

  /// H5Lexists needs every group on the way to exist.
  [[nodiscard]] bool exists(const std::string& path) const {
    for (std::size_t cut = path.find('/'); cut != std::string::npos;
         cut = path.find('/', cut + 1)) {
      if (H5Lexists(file_, path.substr(0, cut).c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
  }

  hid_t file_;
  std::string group_;
};

/// The leaves of a scenario as "path: value" in the order of the document, without `time.end`.
/// Leaves and not lines of text: the same settings may be broken into lines in another way.
void collect(const YAML::Node& node, const std::string& path, std::vector<std::string>& leaves) {
  if (path == "time.end") return;
  if (node.IsMap() && node.size() > 0) {
    for (const auto& entry : node) {
      collect(entry.second, (path.empty() ? "" : path + ".") + entry.first.Scalar(), leaves);
    }
  } else if (node.IsSequence() && node.size() > 0) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      collect(node[i], path + "[" + std::to_string(i) + "]", leaves);
    }
  } else {
    leaves.push_back(path + ": " + (node.IsScalar() ? node.Scalar() : "nothing"));
  }
}

std::vector<std::string> leaves_of(const std::string& yaml) {
  std::vector<std::string> leaves;
  try {
    collect(YAML::Load(yaml), "", leaves);
  } catch (const YAML::Exception& e) {
    throw base::RunError(std::string("its scenario cannot be read: ") + e.what());
  }
  return leaves;
}

/// Empty when both describe the same run; otherwise the first difference.
std::string first_difference(const std::string& stored, const std::string& given) {
  const std::vector<std::string> a = leaves_of(stored);
  const std::vector<std::string> b = leaves_of(given);
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (in_a == a.end() && in_b == b.end()) return "";
  const auto show = [](auto leaf, auto end) {
    return leaf == end ? std::string("nothing more") : "'" + *leaf + "'";
  };
  return show(in_a, a.end()) + " in the checkpoint, " + show(in_b, b.end()) + " now";
}

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

void read_checkpoint(
    const std::filesystem::path& file, const std::string& resolved_yaml,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>& parts) {
  const QuietHdf5 quiet;
  const std::string start = "error: " + file.string();
  if (!std::filesystem::exists(file)) {
    throw base::UserError(start + ": no checkpoint to resume from; run without --resume");
  }
  try {
    const Handle in = open_file(file);
    const std::vector<double> format = read_attribute(in.get(), k_format);
    if (format.size() != 1 || format[0] != static_cast<double>(k_checkpoint_format)) {
      throw base::UserError(start + ": a checkpoint of another version; start again with --force");
    }
    const std::string difference =
        first_difference(read_string(in.get(), k_scenario), resolved_yaml);
    if (!difference.empty()) {
      throw base::UserError(start + " belongs to another scenario: " + difference +
                            "; only time.end may change when a run is resumed");
    }
    for (const auto& [name, load] : parts) {
      GroupReader reader(in.get(), name);
      load(reader);
    }
  } catch (const base::RunError& e) {
    throw base::UserError(start + ": damaged checkpoint: " + e.what() +
                          "; start again with --force");
  } catch (const sdk::ModelError& e) {
    throw base::UserError(start + ": " + e.what() + "; start again with --force");
  }
}

}  // namespace dust::io
