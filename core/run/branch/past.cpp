// SPDX-License-Identifier: Apache-2.0
#include "run/branch/past.hpp"

#include "dust/sdk/error.hpp"

#include <cstdint>
#include <utility>

namespace dust::run {
namespace {

constexpr const char* k_warnings = "warnings";
constexpr const char* k_counts = "counts";
constexpr const char* k_plant = "plant";
constexpr const char* k_work = "work_before";
constexpr const char* k_changed = "changed_emitters";

/// Texts one behind the other, a letter a number and a zero behind each.
std::vector<std::int64_t> letters_of(const std::vector<std::string>& texts) {
  std::vector<std::int64_t> letters;
  for (const std::string& text : texts) {
    for (const char letter : text) letters.push_back(static_cast<unsigned char>(letter));
    letters.push_back(0);
  }
  return letters;
}

std::vector<std::string> texts_of(const std::vector<std::int64_t>& letters) {
  std::vector<std::string> texts;
  std::string text;
  for (const std::int64_t letter : letters) {
    if (letter != 0) {
      text += static_cast<char>(letter);
      continue;
    }
    texts.push_back(std::move(text));
    text.clear();
  }
  return texts;
}

StartFacts load_start(sdk::ArchiveReader& archive) {
  StartFacts start;
  const auto states = texts_of(archive.integers("state"));
  const auto counts = archive.integers(k_counts);
  if (states.size() != 1 || counts.size() != 4) {
    throw sdk::ModelError("what is saved of the run's beginning does not fit together");
  }
  start.state = states[0];
  start.time = archive.number("time");
  start.particles = counts[0];
  start.contacts = counts[1];
  start.without_past = counts[2];
  start.is_same = counts[3] != 0;
  start.sensors = texts_of(archive.integers("sensors"));
  return start;
}

void save_plant(const PlantBegin& plant, sdk::ArchiveWriter& archive) {
  std::vector<double> numbers{plant.time, plant.mass, plant.dust};
  std::vector<std::int64_t> ways;
  std::vector<std::string> names, classes;
  for (const PlantBegin::Counted& counted : plant.counted) {
    ways.push_back(static_cast<std::int64_t>(counted.key.way));
    names.push_back(counted.key.name);
    classes.push_back(counted.key.dust_class);
    numbers.push_back(counted.mass);
  }
  archive.numbers(k_plant, numbers);
  archive.integers("plant_ways", ways);
  archive.integers("plant_names", letters_of(names));
  archive.integers("plant_classes", letters_of(classes));
}

PlantBegin load_plant(sdk::ArchiveReader& archive) {
  const auto numbers = archive.numbers(k_plant);
  PlantBegin plant{numbers.at(0), numbers.at(1), numbers.at(2), {}};
  const auto ways = archive.integers("plant_ways");
  const auto names = texts_of(archive.integers("plant_names"));
  const auto classes = texts_of(archive.integers("plant_classes"));
  for (std::size_t n = 0; n < ways.size(); ++n) {
    plant.counted.push_back(
        {{static_cast<PlantBegin::Key::Way>(ways[n]), names.at(n), classes.at(n)},
         numbers.at(3 + n)});
  }
  return plant;
}

CountsBefore load_before(sdk::ArchiveReader& archive) {
  const auto work = archive.integers(k_work);
  return {.new_emitters = texts_of(archive.integers("new_emitters")),
          .work = {work.at(0), work.at(1), work.at(2), work.at(3), work.at(4)}};
}

std::vector<CountsBefore::ChangedEmitter> load_changed(sdk::ArchiveReader& archive) {
  std::vector<CountsBefore::ChangedEmitter> changed;
  const auto masses = archive.numbers("changed_emitter_masses");
  for (std::string& name : texts_of(archive.integers(k_changed))) {
    changed.push_back({std::move(name), masses.at(changed.size())});
  }
  return changed;
}

}  // namespace

void save_past(const Past& past, sdk::ArchiveWriter& archive) {
  archive.integers(k_warnings, letters_of(past.warnings));
  if (!past.start) return;
  const StartFacts& start = *past.start;
  archive.integers("state", letters_of({start.state}));
  archive.number("time", start.time);
  const std::int64_t counts[] = {start.particles, start.contacts, start.without_past,
                                 start.is_same ? 1 : 0};
  archive.integers(k_counts, counts);
  archive.integers("sensors", letters_of(start.sensors));
  const CountsBefore& before = start.before;
  const CountsBefore::Work& work = before.work;
  const std::int64_t work_before[] = {work.particle_steps, work.fine_steps, work.steps,
                                      work.fluid_sub_steps, work.dust_sub_steps};
  archive.integers(k_work, work_before);
  save_plant(before.plant, archive);
  archive.integers("new_emitters", letters_of(before.new_emitters));
  std::vector<std::string> changed;
  std::vector<double> masses;
  for (const CountsBefore::ChangedEmitter& emitter : before.changed_emitters) {
    changed.push_back(emitter.name);
    masses.push_back(emitter.mass);
  }
  archive.integers(k_changed, letters_of(changed));
  archive.numbers("changed_emitter_masses", masses);
}

Past load_past(const io::StoredState& state) {
  Past past;
  if (!state.has(k_past_part, k_warnings)) return past;
  state.read({{k_past_part, [&](sdk::ArchiveReader& a) {
                 past.warnings = texts_of(a.integers(k_warnings));
                 if (state.has(k_past_part, k_counts)) past.start = load_start(a);
                 if (state.has(k_past_part, k_work)) past.start->before = load_before(a);
                 // Older checkpoints do not hold it.
                 if (state.has(k_past_part, k_plant)) past.start->before.plant = load_plant(a);
                 if (state.has(k_past_part, k_changed)) {
                   past.start->before.changed_emitters = load_changed(a);
                 }
               }}});
  return past;
}

}  // namespace dust::run
