// SPDX-License-Identifier: Apache-2.0
#include "run/branch/used_models.hpp"

#include "base/error.hpp"
#include "dust/sdk/cohesion_law.hpp"
#include "dust/sdk/contact_law.hpp"
#include "io/input_files.hpp"
#include "run/summary/summary_models.hpp"

#include <algorithm>

namespace dust::run {
namespace {

/// A column per model: its numbers per contact, then its version, a letter a number.
std::string column_of(const UsedModel& model) { return model.kind + "." + model.name; }

/// The digest of its library, a letter a number.
std::string library_column_of(const UsedModel& model) { return column_of(model) + ".library"; }

template <class Law>
void note_history(const registry::Registry& registry, const scenario::ModelChoice& choice,
                  std::vector<UsedModel>& models) {
  for (UsedModel& model : models) {
    if (model.kind != choice.kind || model.name != choice.name) continue;
    const std::int64_t size = registry.create_as<Law>(choice)->history_size();
    model.history_size = std::max(model.history_size, size);
  }
}

/// A model of which nothing but its name is known.
UsedModel without_past(const UsedModel& model) {
  return {.kind = model.kind,
          .name = model.name,
          .version = {},
          .history_size = 0,
          .file = {},
          .sha256 = {}};
}

std::string version_text(const UsedModel& model, const UsedModel& other) {
  std::string text = "of version " + model.version;
  if (model.history_size != other.history_size) {
    text += " with " + std::to_string(model.history_size) +
            (model.history_size == 1 ? " number per contact" : " numbers per contact");
  }
  return text;
}

}  // namespace

std::vector<UsedModel> used_models(const scenario::ReadResult& read,
                                   const registry::Registry& registry) {
  std::vector<UsedModel> models;
  for (const auto& plugin : plugins_json(read.setup, read.dust, registry)) {
    UsedModel model{.kind = plugin.at("kind").get<std::string>(),
                    .name = plugin.at("name").get<std::string>(),
                    .version = plugin.at("version").get<std::string>(),
                    .history_size = 0,
                    .file = {},
                    .sha256 = {}};
    const registry::Entry& entry = *registry.find(model.kind, model.name);
    model.file = entry.file;
    if (!entry.is_shipped && !entry.file.empty()) model.sha256 = io::content_sha256(entry.file);
    models.push_back(std::move(model));
  }
  for (const scenario::InteractionSpec& pair : read.setup.interactions) {
    note_history<sdk::ContactLaw>(registry, pair.contact, models);
    if (pair.rolling) note_history<sdk::RollingLaw>(registry, *pair.rolling, models);
    if (pair.cohesion) note_history<sdk::CohesionLaw>(registry, *pair.cohesion, models);
  }
  return models;
}

void save_models(const std::vector<UsedModel>& models, sdk::ArchiveWriter& archive) {
  for (const UsedModel& model : models) {
    std::vector<std::int64_t> values = {model.history_size};
    for (const char letter : model.version) values.push_back(static_cast<unsigned char>(letter));
    archive.integers(column_of(model), values);
    if (model.sha256.empty()) continue;
    archive.integers(library_column_of(model),
                     std::vector<std::int64_t>(model.sha256.begin(), model.sha256.end()));
  }
}

std::string ChangedModel::text() const {
  return now.kind + "/" + now.name + " was " + version_text(then, now) + ", and is " +
         version_text(now, then) + " here" +
         (now.file.empty() ? std::string() : " (" + now.file.string() + ")");
}

std::string ChangedModel::rebuilt_text() const {
  constexpr std::size_t k_digits_shown = 12;
  return now.kind + "/" + now.name + " of version " + now.version +
         " is another library than before (" + now.file.string() + ", sha256 " +
         then.sha256.substr(0, k_digits_shown) + " then, " + now.sha256.substr(0, k_digits_shown) +
         " now): where its law differs, give it another version";
}

std::vector<ChangedModel> changed_models(const io::StoredState& state,
                                         const std::vector<UsedModel>& now) {
  std::vector<ChangedModel> changed;
  for (const UsedModel& model : now) {
    if (!state.has(k_models_part, column_of(model))) continue;
    UsedModel then = without_past(model);
    state.read({{k_models_part, [&](sdk::ArchiveReader& a) {
                   const auto values = a.integers(column_of(model));
                   for (std::size_t n = 0; n < values.size(); ++n) {
                     if (n == 0) {
                       then.history_size = values[n];
                     } else {
                       then.version += static_cast<char>(values[n]);
                     }
                   }
                 }}});
    if (then.version == model.version && then.history_size == model.history_size) continue;
    changed.push_back({std::move(then), model});
  }
  return changed;
}

std::vector<ChangedModel> rebuilt_models(const io::StoredState& state,
                                         const std::vector<UsedModel>& now) {
  std::vector<ChangedModel> rebuilt;
  for (const UsedModel& model : now) {
    const std::string column = library_column_of(model);
    if (model.sha256.empty() || !state.has(k_models_part, column)) continue;
    UsedModel then = without_past(model);
    state.read({{k_models_part, [&](sdk::ArchiveReader& a) {
                   for (const std::int64_t letter : a.integers(column)) {
                     then.sha256 += static_cast<char>(letter);
                   }
                 }}});
    if (then.sha256 != model.sha256) rebuilt.push_back({std::move(then), model});
  }
  return rebuilt;
}

void refuse_changed_models(const std::filesystem::path& checkpoint,
                           const std::vector<UsedModel>& now) {
  if (!std::filesystem::exists(checkpoint)) return;
  const io::StoredState state(checkpoint, "start again with --force");
  const auto changed = changed_models(state, now);
  if (changed.empty()) return;
  std::string lines;
  for (const ChangedModel& change : changed) {
    if (!lines.empty()) lines += "\n";
    lines += "error: " + checkpoint.string() + ": " + change.text() +
             ": go on with the plugin of version " + change.then.version +
             " (--plugin-path), start again with --force, or take the state into another run with "
             "start_from";
  }
  throw base::UserError(lines);
}

}  // namespace dust::run
